"""Viscous drag of a drive that falls as its grease warms."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

FORTY_CELSIUS = 313.15
"""Reference temperature (K) of fall and convexity: 40 degC, where oils are graded."""
NEAREST = 5.0
"""Smallest distance (K) above the divergence temperature that is computed."""


@effect(
    stage="property",
    acts_on="viscous_torque",
    parameters=(
        Parameter(
            "fall_per_kelvin",
            "1/K",
            LogNormal(0.03, 0.5),
            "relative fall of viscous drag per kelvin at 40 degC",
            null=0.0,
            symbol="b",
        ),
        Parameter(
            "convexity",
            "-",
            Uniform(0.0, 3.4),
            "313.15 K over the distance of 40 degC from the divergence temperature of Vogel's law",
            symbol="m",
        ),
    ),
    equation=r"T_v \leftarrow T_v\,\exp\left[-\frac{b\,(\theta_{oil} - 40\,^\circ\text{C})}"
    r"{1 + m\,(\theta_{oil} - 40\,^\circ\text{C})/313\,\text{K}}\right]",
    source="A. C. Bittencourt, S. Gunnarsson, J. Dyn. Syst. Meas. Control 134 (2012) 051013; H. Vogel, Phys. Z. 22 "
    "(1921) 645, with m = 1 after E. N. da C. Andrade, Nature 125 (1930) 309, with m = 0 after O. Reynolds, Phil. "
    "Trans. R. Soc. 177 (1886) 157",
    fingerprint={"oil_temperature": "-"},
    separated_by="the same speeds warm and cold: the slope against speed changes, the dry level does not",
    kinds=("friction_map",),
    special_cases={"Andrade": {"convexity": 1.0}, "Reynolds": {"convexity": 0.0}},
)
def grease_temperature(
    viscous_torque: np.ndarray, oil_temperature: np.ndarray, *, fall_per_kelvin: float, convexity: float
) -> np.ndarray:
    """Warm grease is less viscous, so the part of friction that grows with speed falls.

    >>> round(float(grease_temperature(1.0, 333.15, fall_per_kelvin=0.03, convexity=0.0)), 3)
    0.549
    >>> vogel = {"fall_per_kelvin": 700.0 / 135.0**2, "convexity": 313.15 / 135.0}   # 700 K, diverging at -95 degC
    >>> round(float(grease_temperature(1.0, 333.15, **vogel)), 3)   # exp(700/155 - 700/135)
    0.512
    """
    warmer = oil_temperature - FORTY_CELSIUS
    distance = np.maximum(FORTY_CELSIUS + convexity * warmer, convexity * NEAREST) / FORTY_CELSIUS
    return viscous_torque * np.exp(-fall_per_kelvin * warmer / distance)
