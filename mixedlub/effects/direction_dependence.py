"""Friction that differs with the direction of motion."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "asymmetry",
            "-",
            Normal(0.0, 0.2),
            "half the difference between the directions, relative to their mean",
            null=0.0,
            symbol="a",
        ),
        Parameter(
            "viscous_asymmetry",
            "-",
            Normal(0.0, 0.2),
            "asymmetry of the viscous part less that of the dry part",
            null=0.0,
            symbol="b",
        ),
    ),
    equation=r"T_r \leftarrow T_r\,(1 + a\operatorname{sgn}\omega) + b\,T_v\,|\omega|/\omega_0",
    source="B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083, section 2.3: either "
    "direction has its own dry and its own viscous friction",
    fingerprint={"speed": "0"},
    separated_by="the slope against speed in both directions: a payload shifts both branches alike, a different "
    "flank or preload also turns the slopes",
    applied_after=("stribeck", "load_dependent_friction", "fluid_drag"),
    kinds=("friction_map",),
)
def direction_dependence(
    running_friction: np.ndarray,
    viscous_torque: np.ndarray,
    drive_speed: np.ndarray,
    reference_speed: np.ndarray,
    *,
    asymmetry: float,
    viscous_asymmetry: float,
) -> np.ndarray:
    """The two directions of a drive differ in friction; the viscous part may have a different asymmetry.

    >>> alike = dict(asymmetry=0.1, viscous_asymmetry=0.0)
    >>> direction_dependence(np.array([2.0, -2.0]), 1.0, np.array([1.0, -1.0]), 1.0, **alike).round(9).tolist()
    [2.2, -1.8]
    >>> apart = dict(asymmetry=0.1, viscous_asymmetry=0.2)   # 1.0 dry, 1.0 viscous: 1.1 + 1.3, 0.9 + 0.7
    >>> direction_dependence(np.array([2.0, -2.0]), 1.0, np.array([1.0, -1.0]), 1.0, **apart).round(3).tolist()
    [2.4, -1.6]
    """
    viscous = viscous_torque * np.abs(drive_speed) / reference_speed
    return running_friction * (1.0 + asymmetry * np.sign(drive_speed)) + viscous_asymmetry * viscous
