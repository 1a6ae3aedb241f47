"""Friction that differs with the direction of motion."""

import numpy as np

from mixedlub.effect import Normal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "asymmetry",
            "-",
            Normal(0.0, 0.2),
            "half the difference of the directions over their mean",
            null=0.0,
            symbol="a",
        ),
    ),
    equation=r"T_r \leftarrow T_r\,(1 + a\operatorname{sgn}\omega)",
    source="B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083, section 2.3",
    fingerprint={"speed": "0"},
    separated_by="the slope against speed in both directions: a payload shifts both branches alike, a different "
    "flank or preload also turns the slopes",
    after=("stribeck", "load_dependent_friction"),
    kinds=("friction_map",),
)
def direction_dependence(running_friction, drive_speed, *, asymmetry):
    """The two flanks of a drive rub differently, in proportion to all friction, viscous part included.

    >>> direction_dependence(np.array([2.0, -2.0]), np.array([1.0, -1.0]), asymmetry=0.1).tolist()
    [2.2, -1.8]
    """
    return running_friction * (1.0 + asymmetry * np.sign(drive_speed))
