"""Presliding of a drive."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

LIMIT_WITHIN = 1e-6
"""Distance of the exponent from one below which the limit is used."""


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "speed_share",
            "-",
            LogNormal(0.003, 1.5),
            "speed at which the initial slope reaches sliding friction, over the largest speed recorded",
            null=0.0,
            symbol="p",
            relative_to="reference_speed",
        ),
        Parameter(
            "exponent",
            "-",
            Uniform(0.0, 2.0),
            "Dahl's exponent: 0 linear until sliding, 1 exponential, 2 long tail",
            symbol="i",
        ),
    ),
    equation=r"T_r \leftarrow T_r\left\{1 - [1 + (i - 1)\,x]^{-1/(i - 1)}\right\},\quad "
    r"x = |\omega|/(p\,\omega_0);\ i = 1:\ T_r\,(1 - e^{-x})",
    source="P. R. Dahl, A solid friction model, Aerospace Corp. TOR-0158 (1968), with a travel in proportion to "
    "speed, as readings of equal duration have",
    special_cases={"Dahl, exponent one": {"exponent": 1.0}},
    fingerprint={"speed": "+"},
    separated_by="longer travel at the lowest speeds: friction reaches its sliding value once the contacts have given "
    "way; a film, or a loss that grows with speed, does not change with the travel",
    applied_after=("stribeck", "load_dependent_friction", "fluid_drag", "direction_dependence"),
    kinds=("friction_map",),
)
def presliding(
    running_friction: np.ndarray,
    drive_speed: np.ndarray,
    reference_speed: np.ndarray,
    *,
    speed_share: float,
    exponent: float,
) -> np.ndarray:
    """Near standstill the contacts deform elastically; friction has not yet reached its sliding value.

    Dahl's stiffness is proportional to (1 - F/T)^i; with i = 1 friction over a travel x is T (1 - exp(-k x/T)).

    >>> presliding(2.0, np.array([-0.1, 100.0]), 100.0, speed_share=0.001, exponent=1.0).round(3).tolist()
    [1.264, 2.0]
    >>> presliding(2.0, np.array([-0.1, 0.3]), 100.0, speed_share=0.001, exponent=2.0).round(3).tolist()
    [1.0, 1.5]
    """
    travel = np.abs(drive_speed) / (np.maximum(speed_share, 1e-12) * reference_speed)
    tail = exponent - 1.0
    if abs(tail) < LIMIT_WITHIN:
        return running_friction * -np.expm1(-travel)
    left = np.maximum(1.0 + tail * travel, 0.0)
    with np.errstate(divide="ignore"):
        return running_friction * (1.0 - left ** (-1.0 / tail))
