"""Friction of film and asperities with other weights than their areas."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.mixture import load_weighted_friction, tallian_friction


@effect(
    stage="law",
    acts_on="friction",
    parameters=(
        Parameter(
            "by_load",
            "-",
            Uniform(0.0, 1.0),
            "share of the way from weights by area to weights by load",
            null=0.0,
            symbol="r",
            nominal=1.0,
        ),
        Parameter(
            "by_film",
            "-",
            Uniform(0.0, 1.0),
            "share of the way from there to weights by the film over the roughness",
            null=0.0,
            symbol="k",
        ),
        Parameter("rate", "-", LogNormal(1.8, 0.4), "rate at which that weight falls", symbol="c"),
        Parameter("power", "-", LogNormal(1.2, 0.2), "power of the film over the roughness in it", symbol="d"),
        Parameter(
            "mean_roughness",
            "-",
            Uniform(0.0, 1.0),
            "exponent of the mean roughness of both surfaces over that of equal ones in the roughness of that weight",
            null=0.0,
            symbol="q",
        ),
        Parameter("end", "-", Uniform(0.0, 0.6), "how early that weight ends: 0 never, as an exponential", symbol="b"),
    ),
    equation=r"\mu \leftarrow \mu + (\mu_B - \mu_E)\left\{(1 - k)\left[(1 - r) P_B + r L\right] + "
    r"k\,w - P_B\right\},\quad "
    r"w = \max\left[1 - b\,c\,(h/\sigma_q)^d,\ 0\right]^{1/b},\ e^{-c(h/\sigma_q)^d}\ \text{for}\ b = 0,\quad "
    r"\sigma_q = \sigma\left[\sqrt{s_0/2} + \sqrt{(1 - s_0)/2}\right]^{q}",
    source="E. R. M. Gelinck, D. J. Schipper, Tribol. Int. 33 (2000) 175, by load; S. Aihara, J. Tribol. 109 (1987) "
    "471, by film, after N. Patir and H. S. Cheng; on T. E. Tallian, Wear 21 (1972) 49",
    fingerprint={"oil_temperature": "+"},
    separated_by="boundary friction by itself at rest, and the film friction with smooth surfaces: between the two the "
    "weight is seen",
    replaces="friction of film and asperities together",
    special_cases={
        "weights by load": {"by_load": 1.0, "by_film": 0.0},
        "Aihara": {"by_load": 0.0, "by_film": 1.0, "rate": 1.8, "power": 1.2, "mean_roughness": 0.0, "end": 0.0},
        "Doleschel": {"by_load": 0.0, "by_film": 1.0, "rate": 1.7725, "power": 1.0, "mean_roughness": 1.0, "end": 0.5},
    },
)
def mixture_law(
    friction: np.ndarray,
    fluid_friction: np.ndarray,
    boundary_friction: np.ndarray,
    area_ratio: np.ndarray,
    asperity_load_share: np.ndarray,
    film_thickness: np.ndarray,
    composite_roughness: np.ndarray,
    height_share: np.ndarray,
    *,
    by_load: float,
    by_film: float,
    rate: float,
    power: float,
    mean_roughness: float,
    end: float,
) -> np.ndarray:
    """Film and asperity friction count by the load that each carries, or by the film over the roughness.

    Asperities carry a larger share of the load than of the area, as their pressure is above the mean. Other weights are
    fits over the ratio of film to roughness; most fall as an exponential of a power of it near 1, some as a power of
    the distance to the film at which nothing touches. The roughness is composite or the mean of both surfaces.

    >>> state = (0.0363, 0.0236, 0.1, 0.1662, 0.91, 0.3e-6, 0.3e-6, 0.5)
    >>> form = {"rate": 1.8, "power": 1.2, "mean_roughness": 0.0, "end": 0.0}
    >>> round(float(mixture_law(*state, by_load=1.0, by_film=0.0, **form)), 4)
    0.0931
    >>> round(float(mixture_law(*state, by_load=0.0, by_film=1.0, **form)), 4)   # exp(-1.8) = 0.165
    0.0362
    """
    each = (fluid_friction, boundary_friction)
    area = tallian_friction(*each, area_ratio)
    weighed = area + by_load * (load_weighted_friction(*each, asperity_load_share) - area)
    if by_film != 0.0:
        mean = np.sqrt(0.5 * height_share) + np.sqrt(0.5 * (1.0 - height_share))
        fallen = rate * (film_thickness / (composite_roughness * mean**mean_roughness)) ** power
        weight = np.exp(-fallen) if end == 0.0 else np.maximum(1.0 - end * fallen, 0.0) ** (1.0 / end)
        weighed = weighed + by_film * (tallian_friction(*each, weight) - weighed)
    return friction + weighed - area
