"""Hertz contact of the bodies and Greenwood-Williamson contact of their asperities."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.chain.slots import ASPERITY_AREA, ASPERITY_LOAD
from roughness.integrals import area_integral, load_integral

GREENWOOD_WILLIAMSON = "elastic asperities of Greenwood and Williamson against a smooth plane"


def reduced_modulus(youngs_modulus: tuple[float, float], poisson_ratio: tuple[float, float]) -> float:
    r"""E' of the film formulas (Pa), twice the contact modulus: :math:`2/[(1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2]`.

    >>> round(reduced_modulus((206e9, 206e9), (0.3, 0.3)) / 1e9, 3)
    226.374
    """
    return 2.0 / sum((1.0 - nu**2) / young for nu, young in zip(poisson_ratio, youngs_modulus, strict=True))


def line_hertz_pressure(line_load: np.ndarray, radius: np.ndarray, reduced_modulus: np.ndarray) -> np.ndarray:
    r"""Largest pressure of a line contact (Pa), :math:`p_0 = \sqrt{w E' / (2\pi R)}`; Hertz 1881.

    >>> round(float(line_hertz_pressure(214.86e3, 8.3262e-3, 226.374e9)) / 1e9, 4)
    0.9642
    """
    return np.sqrt(line_load * reduced_modulus / (2.0 * np.pi * radius))


def point_mean_pressure(hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Mean pressure of a point contact (Pa), :math:`p_m = \tfrac23 p_0`; Hertz 1881.

    >>> float(point_mean_pressure(0.9e9))
    600000000.0
    """
    return hertz_pressure * (2.0 / 3.0)


def mean_hertz_pressure(hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Mean pressure of a line contact (Pa), :math:`p_m = \pi p_0 / 4`; Hertz 1881.

    >>> round(float(mean_hertz_pressure(0.9642e9)) / 1e9, 4)
    0.7573
    """
    return 0.25 * np.pi * hertz_pressure


def line_hertz_half_width(line_load: np.ndarray, radius: np.ndarray, reduced_modulus: np.ndarray) -> np.ndarray:
    r"""Half width of a line contact (m), :math:`b = \sqrt{8 w R / (\pi E')}`; Hertz 1881.

    >>> round(float(line_hertz_half_width(381.2e3, 7.601e-3, 227.253e9)) * 1e3, 3)
    0.18
    """
    return np.sqrt(8.0 * line_load * radius / (np.pi * reduced_modulus))


def point_hertz_half_width(
    load: np.ndarray, radius: np.ndarray, transverse_radius: np.ndarray, reduced_modulus: np.ndarray
) -> np.ndarray:
    r"""Half width of a point contact along the motion (m), from complete elliptic integrals; Hertz 1881.

    >>> round(float(point_hertz_half_width(20.0, 9.525e-3, 9.525e-3, 2 * 64.1e9)) * 1e6, 1)
    130.6
    """
    return _ellipse(load, radius, transverse_radius, reduced_modulus)[0]


def point_hertz_pressure(
    load: np.ndarray, radius: np.ndarray, transverse_radius: np.ndarray, reduced_modulus: np.ndarray
) -> np.ndarray:
    r"""Largest pressure of a point contact (Pa), :math:`p_0 = 3F/(2\pi a b)`; Hertz 1881.

    >>> round(float(point_hertz_pressure(20.0, 9.525e-3, 9.525e-3, 2 * 64.1e9)) / 1e9, 3)
    0.56
    """
    along, across = _ellipse(load, radius, transverse_radius, reduced_modulus)
    return 1.5 * load / (np.pi * along * across)


def _ellipse(
    load: np.ndarray, radius: np.ndarray, transverse_radius: np.ndarray, reduced_modulus: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Semi-axes along and across the motion (m)."""
    from scipy.special import ellipe, ellipkm1

    small, large = np.minimum(radius, transverse_radius), np.maximum(radius, transverse_radius)
    wanted = large / small
    ratio = wanted ** (2.0 / 3.0)
    for _ in range(30):
        complement = ratio**-2.0
        k, e = ellipkm1(complement), ellipe(1.0 - complement)
        with np.errstate(invalid="ignore", divide="ignore"):
            found = np.where(ratio > 1.0 + 1e-9, (ratio**2 * e - k) / (k - e), 1.0)
        ratio = np.maximum(ratio * (wanted / found) ** 0.6, 1.0)
    e = ellipe(1.0 - ratio**-2.0)
    both = 1.0 / (1.0 / small + 1.0 / large)
    long = (6.0 * ratio**2 * e * load * both / (np.pi * reduced_modulus)) ** (1.0 / 3.0)
    short = long / ratio
    shorter_along = radius <= transverse_radius
    return np.where(shorter_along, short, long), np.where(shorter_along, long, short)


def composite_roughness(m0: np.ndarray) -> np.ndarray:
    r"""Composite rms roughness of the pair (m), :math:`\sigma = \sqrt{m_{0,1} + m_{0,2}}`.

    Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 5.

    >>> round(float(composite_roughness(0.046**2 + 0.151**2)), 3)   # their table 5, pair 0036-0122
    0.158
    """
    return np.sqrt(m0)


MEAN_OF_NORMAL = float(np.sqrt(2.0 / np.pi))
"""Ra over Rq of normal heights."""


def mean_roughness(m0: np.ndarray, height_share: np.ndarray, mean_over_rms: np.ndarray) -> np.ndarray:
    r"""Arithmetic mean roughness, mean of both surfaces (m).

    .. math:: R_a = \kappa\,\tfrac12(\sqrt{m_{0,1}} + \sqrt{m_{0,2}}),\quad
              \kappa = \frac{R_{a,1} + R_{a,2}}{\sqrt{m_{0,1}} + \sqrt{m_{0,2}}}

    with ``height_share`` the part of the first surface in the summed m_0, and kappa of the measured surfaces, or
    sqrt(2/pi) of normal heights. Source: ISO 4287.

    >>> round(float(mean_roughness(2 * 0.07**2, 0.5, MEAN_OF_NORMAL)), 3)   # Rq of 0.07 um on both
    0.056
    """
    return 0.5 * mean_over_rms * (np.sqrt(m0 * height_share) + np.sqrt(m0 * (1.0 - height_share)))


def summit_separation(film_thickness: np.ndarray, plane_offset: np.ndarray, summit_sigma: np.ndarray) -> np.ndarray:
    r"""Gap between the summits' mean plane and the smooth one, over summit sigma: :math:`t = (h-z_s)/\sigma_s`.

    The film is the separation of the surfaces' mean planes. Source: J. I. McCool, Wear 107 (1986) 37.

    >>> round(float(summit_separation(0.2214e-6, 0.13298e-6, 0.48970e-6)), 4)
    0.1806
    """
    return (film_thickness - plane_offset) / summit_sigma


def area_per_overlap(summit_density: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray) -> np.ndarray:
    r"""Real over nominal contact area per mean overlap of the summits in their sigma (-), :math:`\pi D R_s \sigma_s`.

    A sphere pressed in elastically by d touches over pi R d; the mean overlap is F_1(t) for normal heights.
    Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300.

    >>> round(float(area_per_overlap(4.4106e10, 7.8332e-6, 0.48970e-6)), 4)
    0.5315
    """
    return np.pi * summit_density * summit_radius * summit_sigma


def pressure_per_overlap(
    summit_density: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray, reduced_modulus: np.ndarray
) -> np.ndarray:
    r"""Pressure of elastic summits per mean overlap to the power 3/2 (Pa).

    .. math:: \tfrac43 E^* D R_s^{1/2}\sigma_s^{3/2},\quad E^* = E'/2

    A sphere pressed in elastically by d carries 4/3 E* R^(1/2) d^(3/2).
    Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300.

    >>> round(float(pressure_per_overlap(4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)) / 1e9, 3)
    6.384
    """
    return 2.0 / 3.0 * reduced_modulus * summit_density * np.sqrt(summit_radius) * power(summit_sigma, 1.5)


@ASPERITY_AREA.offers("greenwood_williamson", GREENWOOD_WILLIAMSON)
def real_area_ratio(
    separation: np.ndarray, summit_density: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray
) -> np.ndarray:
    r"""Real over nominal contact area (-), :math:`\pi D R_s \sigma_s F_1(t)`, held in [0, 1].

    Elastic, independent asperities: trustworthy below about 0.3.
    Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300.

    >>> round(float(real_area_ratio(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6)), 4)
    0.1675
    """
    area = area_integral(separation) * area_per_overlap(summit_density, summit_radius, summit_sigma)
    return np.minimum(area, 1.0, out=area if np.ndim(area) else None)


@ASPERITY_LOAD.offers("greenwood_williamson", GREENWOOD_WILLIAMSON)
def asperity_pressure(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Mean pressure elastic asperities would carry at this gap (Pa).

    .. math:: p_a = \tfrac43 E^* D R_s^{1/2} \sigma_s^{3/2} F_{3/2}(t),\quad E^* = E'/2

    Above the Hertz pressure the imposed gap cannot be: the film and the asperities then carry more than the load.
    Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300.

    >>> p = asperity_pressure(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> round(float(p) / 1e9, 1)
    2.1
    """
    return pressure_per_overlap(summit_density, summit_radius, summit_sigma, reduced_modulus) * load_integral(
        separation
    )


def asperity_load_ratio(asperity_pressure: np.ndarray, mean_pressure: np.ndarray) -> np.ndarray:
    r"""Pressure that asperities would carry at an imposed gap, over the mean Hertz pressure (-), :math:`p_a/p_m`.

    >>> round(float(asperity_load_ratio(2.1e9, 0.757e9)), 2)
    2.77
    """
    return asperity_pressure / mean_pressure


def asperity_real_pressure(asperity_pressure: np.ndarray, area_ratio: np.ndarray) -> np.ndarray:
    r"""Mean pressure on the real contact area of the asperities (Pa), :math:`p_a/A`; 0 where none touch.

    >>> asperity_real_pressure(np.array([2.1e9, 0.0]), np.array([0.5, 0.0])).tolist()
    [4200000000.0, 0.0]
    """
    touching = np.broadcast_to(area_ratio > 0.0, np.broadcast_shapes(np.shape(asperity_pressure), np.shape(area_ratio)))
    return np.divide(asperity_pressure, area_ratio, out=np.zeros(touching.shape), where=touching)


def asperity_load_share(asperity_pressure: np.ndarray, mean_pressure: np.ndarray) -> np.ndarray:
    r"""Share of the load that asperities carry (-), :math:`p_a/p_m` with the mean Hertz pressure, at most 1.

    >>> float(asperity_load_share(0.3785e9, 0.757e9)), float(asperity_load_share(2.1e9, 0.757e9))
    (0.5, 1.0)
    """
    return np.minimum(asperity_load_ratio(asperity_pressure, mean_pressure), 1.0)
