"""An event in a history of friction."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, Normal, Uniform

TENTHS = 2.0 * np.log(9.0)
"""Width of a logistic step from 10 to 90 %, over its scale."""


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter("change", "-", Normal(0.0, 0.3), "natural logarithm of the factor on friction", null=0.0, symbol="c"),
        Parameter(
            "place", "-", Uniform(0.0, 1.0), "position in the programme", n_scan=120, change_point=True, symbol="q_e"
        ),
        Parameter(
            "width",
            "-",
            LogUniform(0.01, 0.12),
            "duration of the change from 10 to 90 %, as a share of the programme",
            symbol="w",
        ),
        Parameter("later", "-", Uniform(-1.5, 1.5), "later change relative to the first: -1 cancels it", symbol="l"),
        Parameter(
            "delay",
            "-",
            LogUniform(0.02, 1.0),
            "time to 63 % of the later change, as a share of the programme",
            symbol="d",
        ),
        Parameter(
            "abruptness",
            "-",
            LogNormal(1.5, 0.7),
            "onset of the later change: 1 immediate, above 1 delayed",
            symbol="k",
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B\exp\left\{c\left[\sigma(4.4\,(q - q_e)/w) + "
    r"l\,(1 - e^{-[\max(q - q_e,\,0)/d]^k})\right]\right\},\quad \sigma(x) = \frac{1}{1 + e^{-x}}",
    source="sudden transitions of friction in long tests, as of mild to severe wear: P. J. Blau, Friction Science and "
    "Technology, 2nd ed., CRC Press (2009), chapter 8",
    fingerprint={"sequence": "+"},
    separated_by="a log of the test: what was touched, refilled or restarted then; a film that breaks or a particle in "
    "the contact shows in contact resistance, noise or the track",
    applied_after=("tribofilm_growth", "friction_run_in", "two_time_scales"),
    kinds=("friction_history",),
    special_cases={"one step": {"later": 0.0}},
)
def friction_event(
    boundary_friction: np.ndarray,
    sequence: np.ndarray,
    *,
    change: float,
    place: float,
    width: float,
    later: float,
    delay: float,
    abruptness: float,
) -> np.ndarray:
    """The surfaces change within a short time, as when a film breaks or oil is renewed; the change may fade or grow.

    >>> step = dict(change=0.2, place=0.5, width=0.05)
    >>> place = np.array([0.2, 0.6, 0.9])
    >>> friction_event(0.1, place, **step, later=0.0, delay=0.1, abruptness=1.0).round(3).tolist()
    [0.1, 0.122, 0.122]
    >>> friction_event(0.1, place, **step, later=-1.0, delay=0.1, abruptness=3.0).round(3).tolist()
    [0.1, 0.108, 0.1]
    """
    since = np.clip(TENTHS * (sequence - place) / width, -500.0, 500.0)
    follows = -np.expm1(-((np.maximum(sequence - place, 0.0) / delay) ** abruptness))
    return boundary_friction * np.exp(change * (1.0 / (1.0 + np.exp(-since)) + later * follows))
