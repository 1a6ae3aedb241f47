"""A surface state that varies irregularly."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal

TERMS = 12


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=tuple(
        Parameter(
            f"swing_{k}",
            "-",
            Normal(0.0, 0.3 / k),
            f"share of friction that swings {k / 2:g} times in the programme",
            null=0.0,
            symbol=f"a_{{{k}}}",
        )
        for k in range(1, TERMS + 1)
    ),
    equation=r"\mu_B \leftarrow \mu_B\,\exp\sum_{k=1}^{12} a_k\cos(k\pi q)",
    source="empirical: a cosine series, the most general history without a law; films that form and wear off in turn "
    "are described by H. Fujita, H. A. Spikes, Proc. IMechE J 218 (2004) 265",
    fingerprint={"sequence": "-"},
    separated_by="images of the track at the highs and lows; a second run shows whether the swings repeat",
    kinds=("friction_history",),
    prior_odds=0.3,
    descriptive=True,
)
def wandering_surface_state(
    boundary_friction: np.ndarray,
    sequence: np.ndarray,
    *,
    swing_1: float,
    swing_2: float,
    swing_3: float,
    swing_4: float,
    swing_5: float,
    swing_6: float,
    swing_7: float,
    swing_8: float,
    swing_9: float,
    swing_10: float,
    swing_11: float,
    swing_12: float,
) -> np.ndarray:
    """Friction follows an irregularly varying surface state: a descriptive form without an identified cause.

    >>> null = {f"swing_{k}": 0.0 for k in range(2, 13)}
    >>> wandering_surface_state(0.1, np.array([0.0, 1.0]), swing_1=0.1, **null).round(4).tolist()
    [0.1105, 0.0905]
    """
    swings = (
        swing_1,
        swing_2,
        swing_3,
        swing_4,
        swing_5,
        swing_6,
        swing_7,
        swing_8,
        swing_9,
        swing_10,
        swing_11,
        swing_12,
    )
    phase = np.pi * np.clip(sequence, 0.0, 1.0)
    return boundary_friction * np.exp(sum(a * np.cos(k * phase) for k, a in enumerate(swings, start=1)))
