"""Loss of a worm mesh as a law of a friction map, in the text of a law file."""

from __future__ import annotations

import math

from mixedlub.worm_gears.drive import Drive
from mixedlub.worm_gears.file import AGMA, CONSTANT
from mixedlub.worm_gears.laws import FOOT_PER_MINUTE, sliding_speed

FILE = "worm_mesh.toml"
TEXT = """# Loss of the mesh of a worm drive, for the folder hypotheses of a friction_map case. speed_rpm and
# the readings are of the worm; torque_Nm is of the wheel, with the sign of the speed where the worm drives.
id = "worm_mesh"
description = "The worm mesh of the drive has one friction coefficient, whether worm or wheel drives."
stage = "loss"
acts_on = "coulomb_torque"
form = "add"
expression = "{expression}"
source = "ISO/TR 14521: efficiency of a worm driving and of a wheel driving; friction of {friction}"

[parameters.factor]
unit = "-"
value = 1.0
sd = 0.3
null = 0.0
meaning = "factor on the friction coefficient"

[range]
drive_speed_rpm = [{slowest}, {fastest}]
"""


def _number(value: float) -> str:
    """Number without an exponent, which expressions would read as a name."""
    return f"{value:.15f}".rstrip("0").rstrip(".")


def _friction(drive: Drive) -> str:
    """Friction coefficient over the sliding speed ``v`` as an expression."""
    friction, factor = drive.file.friction, _number(drive.factor)
    per_rpm = float(sliding_speed(math.pi / 30.0, 1e-3 * drive.file.gears.worm_diameter_mm, drive.lead))
    speed = f"({_number(per_rpm)}*abs(speed_rpm))"
    base = {name: _number(value) for name, value in friction.base.items()}
    if friction.law == CONSTANT:
        return f"{factor}*{base['constant']}"
    if friction.law == AGMA:
        feet = f"({_number(per_rpm / FOOT_PER_MINUTE)}*abs(speed_rpm))"
        slow = f"0.124*exp(-0.074*{feet}^0.645)"
        fast = f"(0.103*exp(-0.110*{feet}^0.450) + 0.012)"
        return f"{factor}*({slow}*(1 - sign({feet} - 10)) + {fast}*(1 + sign({feet} - 10)))/2"
    fall = f"{base['gain']}/({speed} + {base['shift']})^{base['exponent']}"
    return f"{factor}*min({base['constant']} + {fall}, {base['largest']})"


def mesh_law(drive: Drive) -> str:
    r"""Law file of the friction torque that the mesh adds on the worm.

    .. math:: T_f = \frac{|T_2|}{i}\,\frac{r\,(1 + t^2)}{t\,(1 - s\,t\,r)},\ r = \mu/\cos\alpha_n,\ t = \tan\gamma

    with s = 1 where the worm drives and -1 where the wheel drives. It follows from both efficiencies: the worm needs
    T_2/(i eta) where it drives, and gets eta' T_2/i where the wheel does.
    """
    t = math.tan(drive.lead)
    r = f"(factor*({_friction(drive)})/{_number(math.cos(drive.pressure_angle))})"
    grown = _number((1.0 + t * t) / (t * drive.ratio))
    sense = f"sign(speed_rpm*torque_Nm)*{_number(t)}"
    fastest = max(drive.file.conditions.worm_speed_rpm)
    return TEXT.format(
        expression=f"abs(torque_Nm)*{grown}*{r}/(1 - {sense}*{r})",
        friction=drive.file.friction.law,
        slowest=-fastest,
        fastest=fastest,
    )
