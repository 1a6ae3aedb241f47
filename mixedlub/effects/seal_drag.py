"""Seal drag."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.drag import seal_torque

_PIVOT = 20e-6


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(0.5, 1.0),
            "factor on the torque, for size and number of lips",
            null=0.0,
            symbol="c",
            nominal=1.0,
        ),
        Parameter("viscous", "-", Uniform(0.0, 0.6), "exponent of viscosity", symbol="k"),
    ),
    equation=r"P_L \leftarrow P_L + "
    r"c\,T_s\,(\omega_1+\omega_2)\left(\frac{\nu}{20\,\text{mm}^2/\text{s}}\right)^{k},\quad "
    r"\nu = \frac{\eta_0}{\rho},\ T_s = 7.343\times10^{-5}\,r_1^2\ (\text{N m, mm})",
    source="ISO/TR 14179-2, P = 7.69e-6 d^2 n (k = 0); H. Linke, Stirnradverzahnung, 1996, lets it halve from "
    "40 to 90 C",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-"},
    separated_by="the seals off, or a run of the shafts alone: torque that hardly changes with speed; a zero error "
    "of the torque meter changes sign with the sense of rotation, a seal does not",
    special_cases={"ISO/TR 14179-2": {"viscous": 0.0}},
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
) -> np.ndarray:
    """A lip seal on each shaft adds friction.

    The diameter of both shafts at the lip is taken as the pinion's pitch radius, half its pitch diameter. The lip
    force and 20 mm^2/s make the form belong to N/m and m^2/s.

    >>> round(float(seal_drag(0.0, 0.036, 157.1, 102.7, 0.017, 850.0, strength=1.0, viscous=0.0)), 1)
    24.7
    """
    thinner = (viscosity / (oil_density * _PIVOT)) ** viscous
    return power_loss + strength * seal_torque(pinion_radius) * (pinion_speed + gear_speed) * thinner
