"""Tip relief."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

_STIFFNESS = 1.4e10
_TYPICAL = 2e5


@effect(
    stage="load",
    acts_on="load_share",
    parameters=(
        Parameter(
            "relief",
            "m",
            LogNormal(15e-6, 0.6),
            "tip relief missing from the known load sharing",
            null=0.0,
            symbol="C_a",
        ),
        Parameter(
            "length", "-", Uniform(0.05, 0.35), "length of the relief relative to the path of contact", symbol=r"\ell"
        ),
        Parameter(
            "fade",
            "-",
            Uniform(0.0, 1.0),
            "exponent of load with which tooth deflection reduces it, 1 for equal springs",
            symbol="f",
        ),
    ),
    equation=r"s \leftarrow \frac{s\,e^{-z}}{1 - s_b\,(1 - e^{-z})},\quad "
    r"s_b = \min(s\,b_w/b,\ 1),\ z = 2x\,[g(\xi) - g(\xi')],\quad "
    r"x = \frac{C_a c'}{w_r}\left(\frac{w_r b_w}{F_t}\right)^{f},\ c' = 14\,\text{GPa},\ w_r = 200\,\text{N/mm},\quad "
    r"g(\xi) = e^{-(\xi/\ell)^2} + e^{-((1-\xi)/\ell)^2},\ "
    r"\xi' = \xi \pm 1/\epsilon_\alpha\ (+\ \text{where}\ \xi < \tfrac12)",
    source="load divides by compliance and gap (T. F. Conry, A. Seireg, J. Eng. Ind. 95 (1973) 1115) with c' "
    "= 14 N/(mm um) (ISO 6336-1); xi' is the place of the other tooth pair in contact",
    fingerprint={"load": "+", "speed": "-", "roughness": "+"},
    separated_by="the load share itself, from strain gauges or transmission error, or elastic teeth in the model where "
    "they were taken as rigid; the effect fades with torque, that of a heat leak does not",
    applied_after=("load_sharing_law",),
    prior_odds=0.5,
)
def tip_relief(
    load_share: np.ndarray,
    path_fraction: np.ndarray,
    contact_ratio: np.ndarray,
    transmitted_force: np.ndarray,
    contact_width: np.ndarray,
    face_width: np.ndarray,
    *,
    relief: float,
    length: float,
    fade: float,
) -> np.ndarray:
    """Tip relief shifts load to the tooth pair in the middle of the path of contact, where sliding is small.

    The shares of two pairs in contact still add up to one, and a single pair carries all. A small relief removes half
    of x from the share at the tip, as for two equal springs; a large one removes all of it. The load share of a gear
    program usually includes the relief already. For equal springs its influence falls as 1/F (f = 1); where relief and
    tooth bending extend along the path the share changes less with load. The tooth
    stiffness and the line load w_r = 200 N/mm make the form belong to Pa and N/m.

    >>> known = dict(contact_ratio=1.5, transmitted_force=3000.0, contact_width=0.014, face_width=0.014)
    >>> share = np.array([0.4, 1.0, 0.6])   # start of contact, middle, and where the next pair starts
    >>> relieved = tip_relief(share, np.array([0.0, 0.5, 2 / 3]), **known, relief=15e-6, length=0.2, fade=1.0)
    >>> relieved.round(2).tolist(), round(float(relieved[0] + relieved[2]), 9)
    ([0.1, 1.0, 0.9], 1.0)
    """
    share = load_share * (face_width / contact_width)
    size = relief * _STIFFNESS / (_TYPICAL * (transmitted_force / (face_width * _TYPICAL)) ** fade)
    step = 1.0 / contact_ratio
    partner = np.where(path_fraction < 0.5, path_fraction + step, path_fraction - step)
    odds = np.expm1(-2.0 * size * (_gap(path_fraction, length) - _gap(partner, length)))
    return load_share * (1.0 + odds) / (1.0 + np.minimum(share, 1.0) * odds)


def _gap(place: np.ndarray, length: float) -> np.ndarray:
    """Relief at a position on the path of contact, relative to that at the tips."""
    return np.exp(-((place / length) ** 2)) + np.exp(-(((1.0 - place) / length) ** 2))
