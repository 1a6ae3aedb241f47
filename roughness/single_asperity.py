"""One asperity pressed flat by a hard plane, elastic at first and yielding later: its contact area and its load.

Every law is given by two factors on the area :math:`\\pi R\\omega` and the load
:math:`\\tfrac43 E^* R^{1/2}\\omega^{3/2}` that Hertz has at the same overlap :math:`\\omega`. They depend on
:math:`\\xi = \\omega/\\omega_c`, the overlap over that at which the law leaves Hertz or begins to yield.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

Factor = Callable[[np.ndarray], np.ndarray]

POISSON_RATIO = 0.3
"""Poisson's ratio of hard metals; the effect of hardness in the laws depends on it weakly."""
YIELD_FACTOR = 0.454 + 0.41 * POISSON_RATIO
"""K, the largest pressure at the onset of yield over hardness."""
ONSET_FACTOR = 1.295 * np.exp(0.736 * POISSON_RATIO)
"""C, the largest pressure at the onset of yield over yield strength; Jackson and Green's."""
HARDNESS_OVER_STRENGTH = 2.8
"""Hardness of a blunt indenter over yield strength; D. Tabor, The Hardness of Metals (1951)."""
MEAN_OVER_HARDNESS = 0.4
"""k, the mean pressure at the onset of yield over hardness by Zhao, Maietta and Chang."""


@dataclass(frozen=True)
class Asperity:
    """An asperity that yields: factors on the area and the load of Hertz from the first of ``edges`` on. ``edges``:
    overlaps, over the overlap at onset, at which the factors change form."""

    edges: tuple[float, ...]
    area: Factor
    load: Factor


def chang_etsion_bogy() -> Asperity:
    r"""Volume kept below onset: :math:`A = \pi R\omega(2 - 1/\xi)`, :math:`P = K H A` for :math:`\xi > 1`.

    The load jumps by a half at onset, where Hertz has two thirds of K H on the mean.
    Source: W. R. Chang, I. Etsion, D. B. Bogy, J. Tribol. 109 (1987) 257.

    >>> one = chang_etsion_bogy()
    >>> float(one.area(1.0)), float(one.load(1.0))
    (1.0, 1.5)
    """
    return _CHANG_ETSION_BOGY


_CHANG_ETSION_BOGY = Asperity((1.0,), lambda xi: 2.0 - 1.0 / xi, lambda xi: 1.5 * (2.0 - 1.0 / xi) / np.sqrt(xi))


def zhao_maietta_chang() -> Asperity:
    r"""Elastic, then elastic-plastic for :math:`1 < \xi < 54`, then plastic; area and load without a jump.

    .. math:: A = \pi R\omega\,(1 - 2s^3 + 3s^2),\quad s = \frac{\xi - 1}{53},\quad
              P = A H\left[1 - 0.6\left(1 - \frac{\ln\xi}{\ln 54}\right)\right]

    Beyond, A = 2 pi R omega and P = A H. Source: Y. Zhao, D. M. Maietta, L. Chang, J. Tribol. 122 (2000) 86.

    >>> one = zhao_maietta_chang()
    >>> [round(float(one.load(xi)), 9) for xi in (1.0, 54.0)], round(5 / 54**0.5, 9)
    ([1.0, 0.680413817], 0.680413817)
    """
    return _ZHAO_MAIETTA_CHANG


_PLASTIC = 54.0


def _zmc_area(xi: np.ndarray) -> np.ndarray:
    s = np.minimum((xi - 1.0) / (_PLASTIC - 1.0), 1.0)
    return 1.0 + (3.0 - 2.0 * s) * s**2


def _zmc_load(xi: np.ndarray) -> np.ndarray:
    left = 1.0 - np.log(np.minimum(xi, _PLASTIC)) / np.log(_PLASTIC)
    return _zmc_area(xi) * (1.0 - (1.0 - MEAN_OVER_HARDNESS) * left) / (MEAN_OVER_HARDNESS * np.sqrt(xi))


_ZHAO_MAIETTA_CHANG = Asperity((1.0, _PLASTIC), _zmc_area, _zmc_load)


def kogut_etsion() -> Asperity:
    r"""Fits of finite elements: powers of :math:`\xi` from 1 to 6 and from 6 to 110, fully plastic beyond.

    .. math:: \frac{P}{P_c} = 1.03\,\xi^{1.425},\ 1.40\,\xi^{1.263},\ \frac{3}{K}\xi,\quad
              \frac{A}{A_c} = 0.93\,\xi^{1.136},\ 0.94\,\xi^{1.146},\ 2\xi

    with :math:`P_c = \tfrac23 K H\pi\omega_c R` and :math:`A_c = \pi\omega_c R`. The pieces do not meet: the load
    jumps by 3, 2 and 7 %, the area by 7, 3 and 7 %.
    Source: L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657.

    >>> one = kogut_etsion()
    >>> [round(float(one.load(xi) * xi**1.5), 3) for xi in (2.0, 10.0)], round(1.03 * 2**1.425, 3)
    ([2.766, 25.652], 2.766)
    """
    return _KOGUT_ETSION


def _ke_area(xi: np.ndarray) -> np.ndarray:
    return np.where(xi < 6.0, 0.93 * xi**0.136, np.where(xi < 110.0, 0.94 * xi**0.146, 2.0))


def _ke_load(xi: np.ndarray) -> np.ndarray:
    middle = np.where(xi < 6.0, 1.03 * xi**-0.075, 1.40 * xi**-0.237)
    return np.where(xi < 110.0, middle, 3.0 / (YIELD_FACTOR * np.sqrt(xi)))


_KOGUT_ETSION = Asperity((1.0, 6.0, 110.0), _ke_area, _ke_load)


@cache
def jackson_green(yield_strain: float) -> Asperity:
    r"""Fits of finite elements in which hardness falls as the contact widens; Hertz up to :math:`\xi = 1.9`.

    .. math:: A = \pi R\omega\left(\frac{\xi}{1.9}\right)^B,\quad
              \frac{P}{P_c} = e^{-\xi^{5/12}/4}\,\xi^{3/2} +
              \frac{4 H_G}{C S_y}\left(1 - e^{-\xi^{5/9}/25}\right)\xi

    with :math:`e_y = S_y/E^*` (``yield_strain``), :math:`B = 0.14\,e^{23 e_y}`,
    :math:`H_G/S_y = 2.84[1 - \exp(-0.82\,(a/R)^{-0.7})]` and
    :math:`a/R = \tfrac12\pi C e_y\sqrt{\xi(\xi/1.9)^B}`. Their solutions end at a/R of about 0.4.
    Source: R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343.

    >>> one = jackson_green(0.01)
    >>> round(float(one.area(1.9)), 3), round(float(one.load(1.9)), 3)   # half a percent above Hertz there
    (1.0, 1.005)
    """
    growth = 0.14 * np.exp(23.0 * yield_strain)

    def area(xi: np.ndarray) -> np.ndarray:
        return (xi / _LAST_HERTZ) ** growth

    def load(xi: np.ndarray) -> np.ndarray:
        radius = 0.5 * np.pi * ONSET_FACTOR * yield_strain * np.sqrt(xi * area(xi))
        hardness = 2.84 * (1.0 - np.exp(-0.82 * radius**-0.7))
        plastic = 4.0 * hardness / ONSET_FACTOR * (1.0 - np.exp(-(xi ** (5 / 9)) / 25.0)) / np.sqrt(xi)
        return np.exp(-0.25 * xi ** (5 / 12)) + plastic

    return Asperity((_LAST_HERTZ,), area, load)


_LAST_HERTZ = 1.9
