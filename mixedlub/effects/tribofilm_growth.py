"""A reaction film that grows on the surfaces."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, SinhNormal

SOFTNESS = 0.2


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "change", "-", SinhNormal(0.45), "relative change of friction under a complete film", null=0.0, symbol="c"
        ),
        Parameter(
            "time_constant",
            "-",
            LogNormal(0.3, 0.9),
            "time to cover 63 % of the bare track, as a share of the programme",
            symbol="q_c",
        ),
        Parameter(
            "induction",
            "-",
            LogNormal(0.02, 1.2),
            "induction time before the film starts, as a share of the programme",
            symbol="q_i",
        ),
        Parameter(
            "exponent",
            "-",
            LogNormal(1.0, 0.4),
            "growth exponent: 1 constant rate on bare track, 0.5 diffusion through the film, above 1 growing nuclei",
            symbol="n",
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,(1 + c\,\theta),\quad \theta = 1 - e^{-(g/q_c)^n},\quad "
    r"g = w\ln\frac{1 + e^{(q - q_i)/w}}{1 + e^{-q_i/w}},\ w = 0.2\,q_i",
    source="coverage of the first order after an induction time: H. Fujita, H. A. Spikes, Tribol. Trans. 48 (2005) "
    "567, films of zinc dithiophosphate; exponent of M. Avrami, J. Chem. Phys. 7 (1939) 1103; "
    "steady while most is bare: N. N. Gosvami et al., Science 348 (2015) 102",
    fingerprint={"sequence": "+"},
    special_cases={
        "first order": {"exponent": 1.0},
        "steady growth": {"time_constant": 5.0, "induction": 1e-6, "exponent": 1.0},
    },
    separated_by="an image or contact resistance of the track after each step shows coverage grow; running-in "
    "of heights shows in a profile and ends within the first per cent of the test",
)
def tribofilm_growth(
    boundary_friction: np.ndarray,
    sequence: np.ndarray,
    *,
    change: float,
    time_constant: float,
    induction: float,
    exponent: float,
) -> np.ndarray:
    """Additives form a solid film on the track; friction changes in proportion to the covered share.

    The start is smoothed over a fifth of the induction time, as nuclei do not all form at once.

    >>> film = dict(change=1.0, time_constant=0.05, induction=0.2, exponent=1.0)
    >>> tribofilm_growth(0.06, np.array([0.0, 1.0]), **film).round(4).tolist()
    [0.06, 0.12]
    """
    width = SOFTNESS * induction
    since = width * (np.logaddexp(0.0, (sequence - induction) / width) - np.logaddexp(0.0, -induction / width))
    grown = (np.maximum(since, 0.0) / time_constant) ** exponent
    return boundary_friction * (1.0 - change * np.expm1(-grown))
