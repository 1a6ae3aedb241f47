"""Offset of the torque meter."""

from mixedlub.effect import Parameter, Wide, effect

_K_FACTOR = 2e-5
"""K factor of case-hardened gears over E', 4.5 MPa for steel: D. W. Dudley, Handbook of Practical Gear Design."""


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "offset", "-", Wide(5e-4), "torque read at no torque, over what gears of this size transmit", null=0.0
        ),
    ),
    equation=r"y \leftarrow y + T_0\,\omega_1,\quad T_0 = a\,K\,b_w\,\frac{2 r_1^2 r_2}{r_1 + r_2},\ "
    r"K = 2\times10^{-5} E'",
    source="power from torque times speed: an error of torque becomes one of power; a meter's zero is good to a share "
    "of the torque it is made for, here that of a usual K factor",
    fingerprint={"load": "-", "speed": "+", "roughness": "-"},
    separated_by="zero load in both senses of rotation, or drive and brake swapped: its sign changes",
    kinds=("gear_pair",),
    after=("heat_leak",),
)
def torque_offset(reading, pinion_speed, face_width, pinion_radius, gear_radius, reduced_modulus, *, offset):
    """A torque meter that does not read zero at rest adds a torque that is not there.

    Gears of 72 and 110 mm pitch diameter, 14 mm wide, transmit 99 N m; 5e-4 of that at 157 rad/s are 7.8 W.

    >>> round(torque_offset(100.0, 157.0, 0.014, 0.036, 0.055, 226.4e9, offset=5e-4), 2)
    107.8
    """
    transmitted = (
        _K_FACTOR * reduced_modulus * face_width * 2.0 * pinion_radius**2 / (1.0 + pinion_radius / gear_radius)
    )
    return reading + offset * transmitted * pinion_speed
