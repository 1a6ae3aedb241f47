"""Viscous drag of a drive that falls as its grease warms."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect

REFERENCE = 313.15


@effect(
    stage="property",
    acts_on="viscous_torque",
    parameters=(
        Parameter(
            "fall_per_kelvin",
            "1/K",
            LogNormal(0.03, 0.5),
            "relative fall of viscous drag a kelvin",
            null=0.0,
            symbol="b",
        ),
    ),
    equation=r"T_v \leftarrow T_v\,e^{-b\,(\theta_{oil} - 40\,^\circ\text{C})}",
    source="A. C. Bittencourt, S. Gunnarsson, J. Dyn. Syst. Meas. Control 134 (2012) 051013; exponential as in "
    "O. Reynolds, Phil. Trans. R. Soc. 177 (1886) 157",
    fingerprint={"oil_temperature": "-"},
    separated_by="the same speeds warm and cold: the slope against speed changes, the dry level does not",
    kinds=("friction_map",),
)
def grease_temperature(
    viscous_torque: np.ndarray, oil_temperature: np.ndarray, *, fall_per_kelvin: float
) -> np.ndarray:
    """Warm grease shears more easily, so the part of friction that grows with speed shrinks.

    >>> round(float(grease_temperature(1.0, 333.15, fall_per_kelvin=0.03)), 3)
    0.549
    """
    return viscous_torque * np.exp(-fall_per_kelvin * (oil_temperature - REFERENCE))
