"""Friction that falls as fresh surfaces run in."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="contact",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "excess",
            "-",
            LogNormal(0.3, 0.8),
            "relative excess of friction of the fresh surfaces over the run-in ones",
            null=0.0,
            symbol="a",
        ),
        Parameter(
            "time_constant",
            "-",
            LogNormal(0.1, 1.2),
            "time in which the excess would vanish at its initial rate, as a share of the programme",
            symbol="q_r",
        ),
        Parameter(
            "tail", "-", LogNormal(4.0, 1.2), "shape of the decay: large exponential, 1 reciprocal of time", symbol="m"
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B\left[1 + a\left(1 + \frac{q}{m\,q_r}\right)^{-m}\right]",
    source="P. J. Blau, Tribol. Int. 38 (2005) 1007, the simplest of the running-in curves; with a tail as of wear "
    "whose pace falls with what is worn",
    fingerprint={"sequence": "-"},
    separated_by="a profile of the track before and after; a second run on the same track starts at the lower friction",
    kinds=("friction_history",),
)
def friction_run_in(
    boundary_friction: np.ndarray, sequence: np.ndarray, *, excess: float, time_constant: float, tail: float
) -> np.ndarray:
    """Asperity peaks wear off and the track conforms; friction falls to the level of run-in surfaces.

    >>> ends = dict(excess=0.2, time_constant=0.05)
    >>> friction_run_in(0.1, np.array([0.0, 1.0]), **ends, tail=100.0).round(3).tolist()
    [0.12, 0.1]
    >>> friction_run_in(0.1, np.array([0.0, 1.0]), **ends, tail=1.0).round(3).tolist()
    [0.12, 0.101]
    """
    worn = np.maximum(sequence, 0.0) / time_constant
    return boundary_friction * (1.0 + excess * np.exp(-tail * np.log1p(worn / tail)))
