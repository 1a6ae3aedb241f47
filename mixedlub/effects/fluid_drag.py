"""Drag of the air or oil that a drive moves."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform


@effect(
    stage="loss",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(0.5, 1.2),
            "drag at the largest speed of the recording, relative to the typical reading",
            null=0.0,
            symbol="c",
            relative_to="reading_scale",
        ),
        Parameter("exponent", "-", Uniform(1.5, 2.0), "exponent of speed", symbol="k", published=(1.5, 2.0)),
    ),
    equation=r"T_r \leftarrow T_r + c\,y_0\,|\omega/\omega_0|^k\operatorname{sgn}\omega",
    source="H. Schlichting, Boundary-Layer Theory, 7th ed., 1979, chapters 5 and 21: a rotating disc has k = 1.5 in "
    "laminar and 1.8 in turbulent flow; 2 for what is thrown about, as by a fan",
    special_cases={
        "a laminar disc": {"exponent": 1.5},
        "a turbulent disc": {"exponent": 1.8},
        "a fan": {"exponent": 2.0},
    },
    fingerprint={"speed": "+"},
    separated_by="a coast-down with covers off or in another gas, or another oil level: drag of grease grows no "
    "faster than speed, and friction of surfaces falls with it",
    kinds=("friction_map",),
    prior_odds=0.5,
)
def fluid_drag(
    running_friction: np.ndarray,
    reading_scale: np.ndarray,
    drive_speed: np.ndarray,
    reference_speed: np.ndarray,
    *,
    strength: float,
    exponent: float,
) -> np.ndarray:
    """Moving parts accelerate air or oil; this drag grows more than linearly with speed, independently of load.

    >>> fluid_drag(2.0, 2.0, np.array([50.0, 100.0]), 100.0, strength=0.5, exponent=2.0).tolist()
    [2.25, 3.0]
    """
    share = np.abs(drive_speed) / reference_speed
    return running_friction + strength * reading_scale * share**exponent * np.sign(drive_speed)
