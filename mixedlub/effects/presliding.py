"""Presliding of a drive."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "speed_share",
            "-",
            LogNormal(0.003, 1.5),
            "speed at which friction is 63 % of its sliding value, over the largest speed of the recording",
            null=0.0,
            symbol="p",
            of="reference_speed",
        ),
    ),
    equation=r"T_r \leftarrow T_r\left(1 - e^{-|\omega|/(p\,\omega_0)}\right)",
    source="P. R. Dahl, A solid friction model, Aerospace Corp. TOR-0158 (1968), with exponent one and a travel in "
    "proportion to speed, as readings of equal duration have",
    fingerprint={"speed": "+"},
    separated_by="longer travel at the lowest speeds: friction reaches its sliding value once the contacts have given "
    "way; a film, or a loss that grows with speed, does not change with the travel",
    after=("stribeck", "load_dependent_friction", "fluid_drag", "direction_dependence"),
    kinds=("friction_map",),
)
def presliding(
    running_friction: np.ndarray, drive_speed: np.ndarray, reference_speed: np.ndarray, *, speed_share: float
) -> np.ndarray:
    """Near standstill the contacts only give elastically and friction has not yet reached its sliding value.

    Dahl's friction over a travel x is T (1 - exp(-k x/T)).

    >>> presliding(2.0, np.array([-0.1, 100.0]), 100.0, speed_share=0.001).round(3).tolist()
    [1.264, 2.0]
    """
    share = np.abs(drive_speed) / (np.maximum(speed_share, 1e-12) * reference_speed)
    return running_friction * (1.0 - np.exp(-share))
