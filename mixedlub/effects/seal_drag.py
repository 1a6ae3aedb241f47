"""Seal drag."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Parameter, effect
from mixedlub.laws.drag import seal_torque

_PIVOT = 20e-6
_SPEED = 200.0


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter(
            "strength", "-", LogNormal(0.5, 1.0), "factor on the torque: size and number of lips", null=0.0, symbol="c"
        ),
        Parameter("viscous", "-", Between(0.0, 0.6), "power of viscosity", symbol="k"),
        Parameter("gliding", "-", Between(0.0, 1.0), "power of speed over that of viscosity", symbol="g"),
    ),
    equation=r"P_L \leftarrow P_L + "
    r"c\,T_s\,(\omega_1+\omega_2)\left(\frac{\nu}{20\,\text{mm}^2/\text{s}}\right)^{k}"
    r"\left(\frac{\omega_1+\omega_2}{200\,\text{s}^{-1}}\right)^{kg},\quad "
    r"\nu = \frac{\eta_0}{\rho},\ T_s = 7.343\times10^{-5}\,r_1^2\ (\text{N m, mm})",
    source="ISO/TR 14179-2, P = 7.69e-6 d^2 n (k = 0); H. Linke, Stirnradverzahnung, 1996, lets it halve from "
    "40 to 90 C; a lip that glides on its film rubs as (nu n)^(1/3), F. Hirano, H. Ishiwata, Proc. IMechE 180 3B "
    "(1965) 187",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-"},
    separated_by="the seals off, or a run of the shafts alone: torque that hardly changes with speed; a zero error "
    "of the torque meter changes sign with the sense of rotation, a seal does not",
    contains={
        "ISO/TR 14179-2": {"viscous": 0.0},
        "Hirano and Ishiwata": {"viscous": 1.0 / 3.0, "gliding": 1.0},
    },
)
def seal_drag(
    power_loss: np.ndarray,
    pinion_radius: np.ndarray,
    pinion_speed: np.ndarray,
    gear_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    *,
    strength: float,
    viscous: float,
    gliding: float,
) -> np.ndarray:
    """A lip seal rubs on each shaft.

    Shafts as thick as the pinion's pitch radius, and most are thinner. The lip force, 20 mm^2/s and 200 1/s make the
    form belong to N/m, m^2/s and 1/s.

    >>> dry = dict(strength=1.0, viscous=0.0, gliding=0.0)
    >>> round(float(seal_drag(0.0, 0.036, 157.1, 102.7, 0.017, 850.0, **dry)), 1)
    24.7
    """
    speed = pinion_speed + gear_speed
    film = (viscosity / (oil_density * _PIVOT) * (speed / _SPEED) ** gliding) ** viscous
    return power_loss + strength * seal_torque(pinion_radius) * speed * film
