"""An interference order that is miscounted above some film thickness."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogUniform, SignedLogNormal

SHARPNESS = 60.0


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "jump",
            "m",
            SignedLogNormal(1.9e-7, 0.25),
            "error of the reading: 160 to 230 nm per order of visible light, rarely two orders",
            null=0.0,
            symbol="j",
        ),
        Parameter(
            "onset",
            "m",
            LogUniform(1e-8, 2e-6),
            "film thickness above which the order is miscounted",
            n_scan=60,
            change_point=True,
            symbol="h_s",
        ),
    ),
    equation=r"y \leftarrow y + j\,\tfrac12[1 + \tanh(60\ln(h/h_s))]",
    source="spacer-layer interferometry: G. J. Johnston, R. Wayte, H. A. Spikes, Tribol. Trans. 34 (1991) 187; one is "
    "wavelength/(2 n)",
    fingerprint={"film_thickness": "+"},
    separated_by="the same speed approached from above and below, or another spacer: the jump moves with the order, "
    "the film does not",
    kinds=("film",),
)
def fringe_order(reading: np.ndarray, film_thickness: np.ndarray, *, jump: float, onset: float) -> np.ndarray:
    """All films above the miscounted order read one or more fringes too thick or too thin.

    A smaller jump is not a miscount; see `fringe_step`.

    >>> (fringe_order(np.array([1e-7, 1e-6]), np.array([1e-7, 1e-6]), jump=2e-7, onset=5e-7) * 1e9).round(1).tolist()
    [100.0, 1200.0]
    """
    beyond = 0.5 * (1.0 + np.tanh(SHARPNESS * np.log(film_thickness / onset)))
    return reading + jump * beyond
