"""Load shared between tooth pairs by another rule."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Uniform


@effect(
    stage="law",
    acts_on="load_share",
    parameters=(
        Parameter(
            "share",
            "-",
            Uniform(0.0, 1.0),
            "share of the way from the known sharing to this one",
            null=0.0,
            symbol="r",
            nominal=1.0,
        ),
        Parameter(
            "first",
            "-",
            Uniform(0.3, 0.55),
            "share of the load on a tooth pair at the start of its contact",
            symbol="s_A",
        ),
    ),
    equation=r"s \leftarrow (1 - r)\,s + r\,\frac{b}{b_w}\,s_t(\xi),\quad "
    r"s_t = s_A + (1 - 2 s_A)\frac{\xi}{1 - 1/\epsilon_\alpha}\ \text{before the single pair},\ 1\ \text{on it},\ "
    r"s_t(1 - \xi)\ \text{behind it}",
    source="ISO/TR 15144-1, load sharing factor from 1/3 to 2/3; equal shares: H. Ohlendorf, thesis, TU Munich 1958",
    fingerprint={"load": "+"},
    separated_by="the load share itself, from strain gauges in the tooth roots, or the transmission error",
    replaces="load sharing of the teeth",
    special_cases={
        "ISO/TR 15144-1": {"share": 1.0, "first": 1.0 / 3.0},
        "equal shares": {"share": 1.0, "first": 0.5},
    },
)
def load_sharing_law(
    load_share: np.ndarray,
    path_fraction: np.ndarray,
    contact_ratio: np.ndarray,
    contact_width: np.ndarray,
    face_width: np.ndarray,
    *,
    share: float,
    first: float,
) -> np.ndarray:
    """Two tooth pairs in contact share the load along straight lines over the path instead of by their stiffness.

    Published lines begin at a third (ISO) to a half (equal shares); less at the start is relief of the tips. For
    contact ratios between 1 and 2; with others the known sharing stays.

    >>> known = dict(contact_ratio=1.5, contact_width=0.014, face_width=0.014)
    >>> place = np.array([0.0, 1 / 3 - 1e-9, 0.5, 1.0])
    >>> iso = load_sharing_law(np.full(4, 0.5), place, **known, share=1.0, first=1 / 3)
    >>> iso.round(3).tolist()
    [0.333, 0.667, 1.0, 0.333]
    """
    place = np.minimum(path_fraction, 1.0 - path_fraction)
    double = 1.0 - 1.0 / np.asarray(contact_ratio)
    known = (double > 0.0) & (double < 0.5)
    line = first + (1.0 - 2.0 * first) * place / np.where(known, double, 1.0)
    straight = np.where(place < double, line, 1.0) * (contact_width / face_width)
    return np.where(known, load_share + share * (straight - load_share), load_share)
