"""Friction of film and asperities weighted by the load that each carries."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Uniform
from mixedlub.laws.mixture import load_weighted_friction, tallian_friction


@effect(
    stage="law",
    acts_on="friction",
    parameters=(
        Parameter(
            "share",
            "-",
            Uniform(0.0, 1.0),
            "share of the way from weights by area to weights by load",
            null=0.0,
            symbol="r",
            nominal=1.0,
        ),
    ),
    equation=r"\mu \leftarrow \mu + r\,(\mu_B - \mu_E)(L - P_B)",
    source="E. R. M. Gelinck, D. J. Schipper, Tribol. Int. 33 (2000) 175; on T. E. Tallian, Wear 21 (1972) 49",
    fingerprint={"oil_temperature": "+"},
    separated_by="boundary friction by itself at rest, and the film friction with smooth surfaces: between the two the "
    "weight is seen",
    replaces="friction of film and asperities together",
    special_cases={"weights by load": {"share": 1.0}},
)
def mixture_law(
    friction: np.ndarray,
    fluid_friction: np.ndarray,
    boundary_friction: np.ndarray,
    area_ratio: np.ndarray,
    asperity_load_share: np.ndarray,
    *,
    share: float,
) -> np.ndarray:
    """Film and asperity friction count by the load that each carries instead of the area that each covers.

    Asperities carry a larger share of the load than of the area, as their pressure is above the mean.

    >>> round(float(mixture_law(0.0363, 0.0236, 0.1, 0.1662, 0.91, share=1.0)), 4)
    0.0931
    """
    each = (fluid_friction, boundary_friction)
    return friction + share * (load_weighted_friction(*each, asperity_load_share) - tallian_friction(*each, area_ratio))
