"""A transient and a lasting change of the surfaces."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, SignedLogNormal, SinhNormal


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "passing",
            "-",
            SignedLogNormal(0.13, 0.7),
            "relative change at the peak of the transient state",
            null=0.0,
            symbol="a",
        ),
        Parameter("lasting", "-", SinhNormal(0.45), "final relative change of the slow state", null=0.0, symbol="b"),
        Parameter(
            "passing_time",
            "-",
            LogNormal(0.04, 0.8),
            "time of the transient's peak, as a share of the programme",
            symbol="q_1",
        ),
        Parameter(
            "lasting_time",
            "-",
            LogNormal(0.7, 0.8),
            "time to 63 % of the slow change, as a share of the programme",
            symbol="q_2",
        ),
        Parameter(
            "gathering",
            "-",
            LogNormal(1.4, 0.4),
            "Avrami exponent of the slow change: 1 full rate from the start, above 1 delayed",
            symbol="m",
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,[1 + a\,x e^{1 - x} + b(1 - e^{-(q/q_2)^m})],\quad x = q/q_1",
    source="P. J. Blau, Tribol. Int. 38 (2005) 1007: running-in curves with an early maximum, as a film that forms and "
    "is overtaken by the wear of the track; M. Avrami, J. Chem. Phys. 7 (1939) 1103 for a change that spreads",
    fingerprint={"sequence": "+"},
    separated_by="contact resistance and a wear scar measured at times: a film takes minutes, wear goes on",
    kinds=("friction_history",),
    prior_odds=0.5,
)
def two_time_scales(
    boundary_friction: np.ndarray,
    sequence: np.ndarray,
    *,
    passing: float,
    lasting: float,
    passing_time: float,
    lasting_time: float,
    gathering: float,
) -> np.ndarray:
    """A film forms and fades quickly while the track wears slowly; each changes friction by a separate share.

    >>> fast, slow = dict(passing=0.1, passing_time=0.02), dict(lasting=-0.3, lasting_time=0.5, gathering=1.0)
    >>> two_time_scales(0.1, np.array([0.02, 9.0]), **fast, **slow).round(3).tolist()
    [0.109, 0.07]
    """
    since = np.maximum(sequence, 0.0)
    fast = since / passing_time
    change = passing * fast * np.exp(1.0 - fast) - lasting * np.expm1(-((since / lasting_time) ** gathering))
    return boundary_friction * (1.0 + change)
