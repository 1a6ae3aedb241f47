"""Stribeck friction of a drive."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="running_friction",
    parameters=(
        Parameter("excess", "-", LogNormal(0.3, 0.8), "static over Coulomb friction, less one", null=0.0, symbol="s"),
        Parameter(
            "speed_share",
            "-",
            LogNormal(0.1, 1.0),
            "Stribeck speed over the largest speed of the recording",
            symbol="q",
        ),
    ),
    equation=r"T_r \leftarrow T_r + s\,T_c\,e^{-|\omega|/(q\,\omega_0)}\operatorname{sgn}\omega",
    source="B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083; exponent one as in "
    "A. Tustin, J. IEE 94 (1947) 143",
    fingerprint={"speed": "-"},
    separated_by="points below a tenth of the largest speed, in both directions: friction falls with speed before "
    "it rises; a payload or an offset does not change sign with the direction",
    kinds=("friction_map",),
)
def stribeck(
    running_friction: np.ndarray,
    coulomb_torque: np.ndarray,
    drive_speed: np.ndarray,
    reference_speed: np.ndarray,
    *,
    excess: float,
    speed_share: float,
) -> np.ndarray:
    """At low speed the lubricant film collapses and friction rises above its dry level at speed.

    >>> x = stribeck(2.0, 2.0, np.array([1e-9, 100.0]), 100.0, excess=0.5, speed_share=0.1)
    >>> x.round(3).tolist()
    [3.0, 2.0]
    """
    share = np.abs(drive_speed) / (speed_share * reference_speed)
    return running_friction + excess * coulomb_torque * np.exp(-share) * np.sign(drive_speed)
