"""Heat leak."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "share", "-", LogNormal(0.05, 0.8), "share of the power lost through the shafts", null=0.0, symbol="c"
        ),
        Parameter(
            "wall",
            "1/K",
            LogNormal(0.003, 0.9),
            "share of the typical power lost through walls per kelvin",
            null=0.0,
            symbol="g",
            relative_to="reading_scale",
        ),
    ),
    equation=r"y \leftarrow (1 - c)\,y - G\,(\theta_{oil} - \theta_a),\quad G = g\,y_0",
    source="heat balance of a calorimetric rig; 5 to 8 % leave by the shafts at high speed (Measurement and Modelling "
    "of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s, eq. 8)",
    fingerprint={"load": "+", "speed": "+", "oil_temperature": "-", "roughness": "+"},
    separated_by="another ambient or bearing oil temperature at the same point; the torque-difference method beside it",
    kinds=("gear_pair",),
)
def heat_leak(
    reading: np.ndarray,
    oil_temperature: np.ndarray,
    ambient_temperature: np.ndarray,
    reading_scale: np.ndarray,
    *,
    share: float,
    wall: float,
) -> np.ndarray:
    """Heat lost through shafts and walls is missing from a power measured by the temperature rise of the oil.

    >>> round(heat_leak(100.0, 343.15, 298.15, 100.0, share=0.05, wall=0.002), 1)
    86.0
    """
    return reading * (1.0 - share) - wall * reading_scale * (oil_temperature - ambient_temperature)
