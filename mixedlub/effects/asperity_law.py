"""Real contact area by another elastic theory."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.laws.contact import area_per_overlap, real_area_ratio
from mixedlub.laws.two_rough import two_rough_area_ratio
from roughness.integrals import area_integral

_DEEPEST = 10.0


@effect(
    stage="law",
    acts_on="area_ratio",
    parameters=(
        Parameter("factor", "-", LogNormal(1.0, 0.5), "contact area over that of the base law", null=1.0, symbol="f"),
        Parameter(
            "offset",
            "-",
            Normal(0.0, 0.5),
            "separation beyond that of the base law, in standard deviations of summit height",
            null=0.0,
            symbol="d",
        ),
        Parameter(
            "both_rough",
            "-",
            Normal(0.5, 0.5),
            "share of the way from one equivalent rough surface to two rough ones of Greenwood and Tripp",
            null=0.0,
            symbol="r",
        ),
    ),
    equation=r"P_B \leftarrow \min\left\{1,\ P_B + \pi D R_s\sigma_s\left[f F(t + d) - F(t)\right] + "
    r"r\left[P_{GT} - \pi D R_s\sigma_s F(t)\right]\right\},\quad "
    r"P_{GT} = \text{area of two rough surfaces},\quad "
    r"F(t) = \int_t^\infty (z - t)\,\frac{e^{-z^2/2}}{\sqrt{2\pi}}\,dz",
    source="J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 (1970) 625; other elastic theories, A. W. Bush, R. D. "
    "Gibson, T. R. Thomas, Wear 35 (1975) 87, as a factor and an offset",
    fingerprint={"speed": "-", "oil_temperature": "+", "roughness": "+"},
    separated_by="contact resistance or the real area itself over the film thickness",
    applied_after=("skewed_heights", "asperity_plasticity"),
    prior_odds=0.5,
    special_cases={"Greenwood and Tripp": {"factor": 1.0, "offset": 0.0, "both_rough": 1.0}},
)
def asperity_law(
    area_ratio: np.ndarray,
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    film_thickness: np.ndarray,
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    height_share: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
    *,
    factor: float,
    offset: float,
    both_rough: float,
) -> np.ndarray:
    """Elastic asperities touch over another area than Greenwood and Williamson's theory gives.

    Theories of elastic contact agree on the shape over the separation and differ in scale and in the plane from which
    it is measured. Asperities that yield are `asperity_plasticity`.

    >>> moments = (0.24292e-12, 0.005, 7.2e9, 0.5, 0.5, 0.5)
    >>> rough = (0.1675, 0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 0.2214e-6, *moments)
    >>> tripp = asperity_law(*rough, factor=1.0, offset=0.0, both_rough=1.0)
    >>> round(float(tripp), 3), round(float(asperity_law(*rough, factor=2.0, offset=0.0, both_rough=0.0)), 3)
    (0.253, 0.335)
    """
    summits = (summit_density, summit_radius, summit_sigma)
    base = real_area_ratio(separation, *summits)
    changed = area_ratio - base
    changed = changed + factor * area_per_overlap(*summits) * area_integral(
        np.clip(separation + offset, -4.0, _DEEPEST)
    )
    if both_rough != 0.0:
        surfaces = (m0, m2, m4, height_share, slope_share, curvature_share)
        changed = changed + both_rough * (two_rough_area_ratio(film_thickness, *surfaces) - base)
    return np.clip(changed, 0.0, 1.0)
