"""Film readings that step where the interference order changes."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter("step", "m", SinhNormal(1e-8), "step of the reading per interference order", null=0.0, symbol="a"),
    ),
    equation=r"y \leftarrow y + a\,(N - N_0)",
    source="spacer-layer interferometry: G. J. Johnston, R. Wayte, H. A. Spikes, Tribol. Trans. 34 (1991) 187; a film "
    "is read from the colour within an order, and an error of phase, index or spacer differs from order to order",
    fingerprint={"fringe_order": "+"},
    separated_by="the same film read in two orders, by another spacer or at a place where both are in sight",
    kinds=("film",),
)
def fringe_step(
    reading: np.ndarray, fringe_order: np.ndarray, first_fringe_order: np.ndarray, *, step: float
) -> np.ndarray:
    """Each change of the interference order shifts the reading by the same small part of a fringe.

    >>> round(fringe_step(120e-9, 4.0, 3.0, step=-20e-9) * 1e9, 1)
    100.0
    """
    return reading + step * (fringe_order - first_fringe_order)
