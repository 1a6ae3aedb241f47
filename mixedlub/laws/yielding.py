"""Rough contact of asperities that yield: real area, and the pressure that they carry.

Summits of equal radius and Gaussian heights against a smooth plane, as Greenwood and Williamson have them; what one
asperity does is in `roughness.single_asperity`, the sums over heights are in `roughness.height_sums`.
"""

from __future__ import annotations

import numpy as np

from mixedlub.chain.slots import ASPERITY_AREA, ASPERITY_LOAD
from mixedlub.laws.contact import area_per_overlap, pressure_per_overlap, real_area_ratio
from roughness import single_asperity
from roughness.height_sums import AREA, LOAD, height_sum
from roughness.integrals import area_integral

CHANG_ETSION_BOGY = "asperities that keep their volume once they yield, of Chang, Etsion and Bogy"
ZHAO_MAIETTA_CHANG = "asperities elastic, elastic-plastic, then plastic, of Zhao, Maietta and Chang"
KOGUT_ETSION = "yielding asperities as Kogut and Etsion fitted finite elements"
JACKSON_GREEN = "yielding asperities as Jackson and Green fitted finite elements"
_DEEPEST = 10.0


def yield_overlap(
    hardness: np.ndarray | float, reduced_modulus: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray
) -> np.ndarray:
    r"""Overlap at which a summit begins to yield, over summit sigma (-), for a Poisson's ratio of 0.3.

    .. math:: w_c = \left(\frac{\pi K H}{E'}\right)^2\frac{R_s}{\sigma_s},\quad K = 0.454 + 0.41\,\nu = 0.577

    The plasticity index is :math:`(E^*/H)\sqrt{\sigma_s/R_s} = (\pi K/2)\,w_c^{-1/2}`, with E* = E'/2.
    Source: W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257.

    >>> index = 0.5 * np.pi * single_asperity.YIELD_FACTOR * yield_overlap(6e9, 226e9, 1e-5, 1e-7) ** -0.5
    >>> round(float(index / (113 / 6 * 0.01**0.5)), 12)
    1.0
    """
    return (np.pi * single_asperity.YIELD_FACTOR * hardness / reduced_modulus) ** 2 * summit_radius / summit_sigma


def mean_pressure_overlap(
    hardness: np.ndarray | float, reduced_modulus: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray
) -> np.ndarray:
    r"""Overlap at which the mean pressure on a summit reaches 0.4 H, over summit sigma (-).

    .. math:: w_1 = \left(\frac{3\pi k H}{4E^*}\right)^2\frac{R_s}{\sigma_s},\quad k = 0.4,\ E^* = E'/2

    Source: Y. Zhao, D. M. Maietta, L. Chang, J. Tribol. 122 (2000) 86.

    >>> round(float(mean_pressure_overlap(6e9, 226.374e9, 7.8332e-6, 0.48970e-6)), 5)
    0.03993
    """
    pressure = single_asperity.MEAN_OVER_HARDNESS * hardness
    return (1.5 * np.pi * pressure / reduced_modulus) ** 2 * summit_radius / summit_sigma


def strength_overlap(
    hardness: np.ndarray | float, reduced_modulus: np.ndarray, summit_radius: np.ndarray, summit_sigma: np.ndarray
) -> np.ndarray:
    r"""Overlap at which a summit begins to yield by its strength, over summit sigma (-), for a Poisson's ratio of 0.3.

    .. math:: w_c = \left(\frac{\pi C S_y}{E'}\right)^2\frac{R_s}{\sigma_s},\quad C = 1.295\,e^{0.736\,\nu} = 1.615,\
              S_y = \frac{H}{2.8}

    Source: R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343.

    >>> rough = (226.374e9, 7.8332e-6, 0.48970e-6)   # within 0.1 % of Chang, Etsion and Bogy's, as K H = C S_y there
    >>> round(float(strength_overlap(6e9, *rough) / yield_overlap(6e9, *rough)), 3)
    0.999
    """
    strength = hardness / single_asperity.HARDNESS_OVER_STRENGTH
    return (np.pi * single_asperity.ONSET_FACTOR * strength / reduced_modulus) ** 2 * summit_radius / summit_sigma


def yielded_area(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Area that yielding adds to elastic summits, over nominal area (-), :math:`\pi D R_s\sigma_s F_1(t + w_c)`.

    A summit beyond onset touches over pi R w (2 - w_c/w), that is pi R (w - w_c) more than an elastic one.
    Source: W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257.

    >>> rough = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> [round(float(yielded_area(*rough, hardness)), 4) for hardness in (6e6, 6e9, 6e12)]   # to none from all
    [0.1675, 0.1592, 0.0]
    """
    onset = yield_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    beyond = area_integral(np.minimum(separation + onset, _DEEPEST))
    return area_per_overlap(summit_density, summit_radius, summit_sigma) * beyond


@ASPERITY_AREA.offers("chang_etsion_bogy", CHANG_ETSION_BOGY)
def chang_etsion_bogy_area(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Real over nominal contact area (-), :math:`\pi D R_s\sigma_s[F_1(t) + F_1(t + w_c)]`, at most 1.

    Source: W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257.

    >>> round(float(chang_etsion_bogy_area(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9, 6e9)), 4)
    0.3267
    """
    summits = (summit_density, summit_radius, summit_sigma)
    added = yielded_area(separation, *summits, reduced_modulus, hardness)
    return np.minimum(real_area_ratio(separation, *summits) + added, 1.0)


@ASPERITY_LOAD.offers("chang_etsion_bogy", CHANG_ETSION_BOGY)
def chang_etsion_bogy_pressure(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Mean pressure that yielding asperities carry (Pa), each K H on the area pi R w (2 - w_c/w).

    .. math:: p_a = D\sigma_s\left\{\tfrac43 E^* R_s^{1/2}\sigma_s^{1/2}\int_0^{w_c} x^{3/2}\varphi(t+x)\,dx +
              \pi K H R_s\,[2F_1(t+w_c) + w_c F_0(t+w_c)]\right\}

    Source: W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257.

    >>> rough = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> [round(float(chang_etsion_bogy_pressure(*rough, h)) / 1e9, 2) for h in (600e9, 6e9)]   # elastic: 2.1
    [2.1, 1.13]
    """
    onset = yield_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _carried(
        single_asperity.chang_etsion_bogy(),
        separation,
        onset,
        summit_density,
        summit_radius,
        summit_sigma,
        reduced_modulus,
    )


@ASPERITY_AREA.offers("zhao_maietta_chang", ZHAO_MAIETTA_CHANG)
def zhao_maietta_chang_area(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Real over nominal contact area (-), :math:`\pi D R_s\sigma_s S_A(t, w_1)`, at most 1.

    Source: Y. Zhao, D. M. Maietta, L. Chang, J. Tribol. 122 (2000) 86.

    >>> round(float(zhao_maietta_chang_area(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9, 6e9)), 4)
    0.2543
    """
    onset = mean_pressure_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _touching(
        single_asperity.zhao_maietta_chang(), separation, onset, summit_density, summit_radius, summit_sigma
    )


@ASPERITY_LOAD.offers("zhao_maietta_chang", ZHAO_MAIETTA_CHANG)
def zhao_maietta_chang_pressure(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Mean pressure that yielding asperities carry (Pa), :math:`\tfrac43 E^* D R_s^{1/2}\sigma_s^{3/2} S_P(t, w_1)`.

    Source: Y. Zhao, D. M. Maietta, L. Chang, J. Tribol. 122 (2000) 86.

    >>> rough = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> round(float(zhao_maietta_chang_pressure(*rough, 6e9)) / 1e9, 2)
    1.37
    """
    onset = mean_pressure_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _carried(
        single_asperity.zhao_maietta_chang(),
        separation,
        onset,
        summit_density,
        summit_radius,
        summit_sigma,
        reduced_modulus,
    )


@ASPERITY_AREA.offers("kogut_etsion", KOGUT_ETSION)
def kogut_etsion_area(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Real over nominal contact area (-), :math:`\pi D R_s\sigma_s S_A(t, w_c)`, at most 1.

    Source: L. Kogut, I. Etsion, Tribol. Trans. 46 (2003) 383.

    >>> round(float(kogut_etsion_area(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9, 6e9)), 4)
    0.2555
    """
    onset = yield_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _touching(single_asperity.kogut_etsion(), separation, onset, summit_density, summit_radius, summit_sigma)


@ASPERITY_LOAD.offers("kogut_etsion", KOGUT_ETSION)
def kogut_etsion_pressure(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Mean pressure that yielding asperities carry (Pa), :math:`\tfrac43 E^* D R_s^{1/2}\sigma_s^{3/2} S_P(t, w_c)`.

    Source: L. Kogut, I. Etsion, Tribol. Trans. 46 (2003) 383.

    >>> rough = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> round(float(kogut_etsion_pressure(*rough, 6e9)) / 1e9, 2)
    1.3
    """
    onset = yield_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _carried(
        single_asperity.kogut_etsion(), separation, onset, summit_density, summit_radius, summit_sigma, reduced_modulus
    )


@ASPERITY_AREA.offers("jackson_green", JACKSON_GREEN)
def jackson_green_area(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Real over nominal contact area (-), :math:`\pi D R_s\sigma_s S_A(t, w_c)`, at most 1; yield strength H/2.8.

    Hardness and modulus are single numbers. Source: R. L. Jackson, I. Green, Tribol. Int. 39 (2006) 906.

    >>> round(float(jackson_green_area(0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9, 6e9)), 4)
    0.2999
    """
    one = _jackson_green(hardness, reduced_modulus)
    onset = strength_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _touching(one, separation, onset, summit_density, summit_radius, summit_sigma)


@ASPERITY_LOAD.offers("jackson_green", JACKSON_GREEN)
def jackson_green_pressure(
    separation: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
    hardness: np.ndarray | float,
) -> np.ndarray:
    r"""Mean pressure that yielding asperities carry (Pa), :math:`\tfrac43 E^* D R_s^{1/2}\sigma_s^{3/2} S_P(t, w_c)`.

    Yield strength H/2.8; hardness and modulus are single numbers.
    Source: R. L. Jackson, I. Green, Tribol. Int. 39 (2006) 906.

    >>> rough = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> round(float(jackson_green_pressure(*rough, 6e9)) / 1e9, 2)
    1.22
    """
    one = _jackson_green(hardness, reduced_modulus)
    onset = strength_overlap(hardness, reduced_modulus, summit_radius, summit_sigma)
    return _carried(one, separation, onset, summit_density, summit_radius, summit_sigma, reduced_modulus)


def _jackson_green(hardness: np.ndarray | float, reduced_modulus: np.ndarray) -> single_asperity.Asperity:
    """The asperity of a hardness and a modulus."""
    strength = float(hardness) / single_asperity.HARDNESS_OVER_STRENGTH
    return single_asperity.jackson_green(2.0 * strength / float(reduced_modulus))


def _touching(
    one: single_asperity.Asperity,
    separation: np.ndarray,
    onset: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
) -> np.ndarray:
    """Real over nominal area of such asperities, at most 1."""
    elastic = area_per_overlap(summit_density, summit_radius, summit_sigma)
    return np.minimum(elastic * height_sum(one, AREA, separation, onset), 1.0)


def _carried(
    one: single_asperity.Asperity,
    separation: np.ndarray,
    onset: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    summit_sigma: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    """Mean pressure that such asperities carry (Pa)."""
    elastic = pressure_per_overlap(summit_density, summit_radius, summit_sigma, reduced_modulus)
    return elastic * height_sum(one, LOAD, separation, onset)
