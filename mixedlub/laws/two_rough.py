"""Contact of two rough surfaces whose asperities meet off their tops: Greenwood and Tripp over summit planes.

Each surface has its own summits: density and radius of `roughness.mccool`, and a plane of the summits above its mean
plane. Greenwood and Tripp take both surfaces alike; unlike ones follow from the same integral over the lateral offset,
in which the overlap of two tops r apart is less by r^2/[2(R_1 + R_2)]. Their law over mean planes is in the effect
`asperity_law`.
"""

from __future__ import annotations

import numpy as np

from mixedlub.chain.slots import ASPERITY_AREA, ASPERITY_LOAD
from roughness.integrals import pair_area_integral, pair_load_integral
from roughness.mccool import plane_offset, summit_density, summit_radius, summit_sigma

GREENWOOD_TRIPP = (
    "Greenwood and Tripp over summit planes: elastic asperities on both surfaces, which meet off their tops; over mean "
    "planes it is a law of the effect asperity_law"
)


def _summits(m0: np.ndarray, m2: np.ndarray, m4: np.ndarray) -> tuple[np.ndarray, ...]:
    """Density, radius, sigma and plane offset of the summits of one surface."""
    return summit_density(m2, m4), summit_radius(m4), summit_sigma(m0, m2, m4), plane_offset(m0, m2, m4)


def _both(
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    height_share: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
) -> tuple[tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
    """Summits of the first and of the second surface."""
    first = _summits(m0 * height_share, m2 * slope_share, m4 * curvature_share)
    return first, _summits(m0 * (1.0 - height_share), m2 * (1.0 - slope_share), m4 * (1.0 - curvature_share))


@ASPERITY_AREA.offers("greenwood_tripp", GREENWOOD_TRIPP)
def two_rough_area_ratio(
    film_thickness: np.ndarray,
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    height_share: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
) -> np.ndarray:
    r"""Real over nominal contact area (-), held in [0, 1].

    .. math:: P_B = \pi^2 (D_1 R_1)(D_2 R_2)\,\sigma^2 F_2(t),\quad t = \frac{h - z_1 - z_2}{\sigma},\
              \sigma^2 = \sigma_1^2 + \sigma_2^2

    with density D, radius R, standard deviation and plane offset z of the summits of each surface. For like surfaces
    it is :math:`\pi^2 (\eta\beta\sigma)^2 F_2`. Source: J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 (1970) 625.

    >>> moments = (0.24292e-12, 0.005, 7.2e9)
    >>> round(float(two_rough_area_ratio(0.2214e-6, *moments, 0.5, 0.5, 0.5)), 3)   # one rough surface: 0.167
    0.253
    """
    (d1, r1, s1, z1), (d2, r2, s2, z2) = _both(m0, m2, m4, height_share, slope_share, curvature_share)
    sigma = np.hypot(s1, s2)
    area = pair_area_integral((film_thickness - z1 - z2) / sigma) * (np.pi**2 * d1 * r1 * d2 * r2 * sigma**2)
    return np.minimum(area, 1.0)


@ASPERITY_LOAD.offers("greenwood_tripp", GREENWOOD_TRIPP)
def two_rough_pressure(
    film_thickness: np.ndarray,
    m0: np.ndarray,
    m2: np.ndarray,
    m4: np.ndarray,
    height_share: np.ndarray,
    slope_share: np.ndarray,
    curvature_share: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Mean pressure that elastic asperities on both surfaces carry (Pa).

    .. math:: p_a = \frac{16\pi}{15} E^* D_1 D_2 \sqrt{R_1 R_2 (R_1 + R_2)}\;\sigma^{5/2} F_{5/2}(t),\quad E^* = E'/2

    For like surfaces it is :math:`\frac{16\sqrt2\pi}{15}(\eta\beta\sigma)^2\sqrt{\sigma/\beta}\,E^* F_{5/2}`.
    Source: J. A. Greenwood, J. H. Tripp, Proc. IMechE 185 (1970) 625.

    >>> moments = (0.24292e-12, 0.005, 7.2e9)
    >>> round(float(two_rough_pressure(0.2214e-6, *moments, 0.5, 0.5, 0.5, 226.374e9)) / 1e9, 1)   # one rough: 2.1
    3.5
    """
    (d1, r1, s1, z1), (d2, r2, s2, z2) = _both(m0, m2, m4, height_share, slope_share, curvature_share)
    sigma = np.hypot(s1, s2)
    scale = 8.0 / 15.0 * np.pi * reduced_modulus * d1 * d2 * np.sqrt(r1 * r2 * (r1 + r2)) * sigma**2.5
    return scale * pair_load_integral((film_thickness - z1 - z2) / sigma)
