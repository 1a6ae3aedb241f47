"""Functional parameters of a map: core, peaks and valleys of its material ratio curve, and volumes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles.maps import HeightMap
from roughness.maps.heights import known_heights
from roughness.material_ratio import core_of_curve

PEAK, VALLEY = 10.0, 80.0
"""Source. ISO 25178-3: material ratios (%) that part peaks from core and core from valleys."""
EXTREME = 2.5, 50.0
"""Source. ISO 25178-3: material ratios (%) of the extreme peak height."""


@dataclass(frozen=True)
class MaterialParameters:
    """Functional parameters: lengths in m, ratios in percent, volumes in m3 over m2, which is m.

    ``s_shaped`` is False where the curve has no core line, as on a sine; Sk, Spk, Svk, Smr1 and Smr2 then mean nothing.
    """

    Sk: float
    Spk: float
    Svk: float
    Smr1: float
    Smr2: float
    Sxp: float
    Vmp: float
    Vmc: float
    Vvc: float
    Vvv: float
    s_shaped: bool


def areal_ratio_curve(area: HeightMap) -> tuple[np.ndarray, np.ndarray]:
    """Percentage of the surface at or above each height, and the heights from highest to lowest (m).

    >>> ratio, heights = areal_ratio_curve(HeightMap(np.array([[2.0, 0.0], [1.0, -1.0]]), 1e-6, 1e-6))
    >>> ratio.tolist(), heights.tolist()
    ([12.5, 37.5, 62.5, 87.5], [1.5, 0.5, -0.5, -1.5])
    """
    heights = np.sort(known_heights(area))[::-1]
    return 100.0 * (np.arange(heights.size) + 0.5) / heights.size, heights


def material_volume(heights: np.ndarray, percent: float) -> float:
    r"""Vm(p): volume of material above the height at a material ratio (%), over the area (m).

    .. math:: V_m(p) = \int_0^p [S_{mc}(q) - S_{mc}(p)]\,\mathrm{d}q

    ``heights`` fall from highest to lowest. ISO 25178-2:2012, 4.4.

    >>> material_volume(np.array([3.0, 2.0, 1.0, 0.0]), 50.0)   # height 1.5 at 50 %
    0.5
    """
    level = _height_at(heights, percent)
    count = int(np.searchsorted(-heights, -level))
    return float(heights[:count].sum() - count * level) / heights.size


def void_volume(heights: np.ndarray, percent: float) -> float:
    r"""Vv(p): volume of void below the height at a material ratio (%), over the area (m).

    .. math:: V_v(p) = \int_p^{100\,\%} [S_{mc}(p) - S_{mc}(q)]\,\mathrm{d}q

    ``heights`` fall from highest to lowest. ISO 25178-2:2012, 4.4.

    >>> void_volume(np.array([3.0, 2.0, 1.0, 0.0]), 50.0)
    0.5
    """
    level = _height_at(heights, percent)
    count = int(np.searchsorted(-heights, -level))
    return float((heights.size - count) * level - heights[count:].sum()) / heights.size


def material_parameters(area: HeightMap) -> MaterialParameters:
    """Functional parameters of a map, holes left out.

    Sk, Spk, Svk, Smr1 and Smr2 by the line through the flattest 40 % of the curve as for a profile (ISO 25178-2:2012,
    4.4, after ISO 13565-2); volumes between material ratios of 10 and 80 %: Vmp above 10 %, Vmc between, Vvc between
    and Vvv below 80 %. Sxp is the height from 50 to 2.5 %.

    >>> noise = np.random.default_rng(0).normal(size=(300, 300))
    >>> p = material_parameters(HeightMap(1e-6 * noise, 1e-6, 1e-6))
    >>> round(p.Sxp * 1e6, 1), round((p.Vmc + p.Vmp) * 1e6, 1)
    (2.0, 1.0)
    """
    ratio, heights = areal_ratio_curve(area)
    core = core_of_curve(ratio, heights)
    peaks = material_volume(heights, PEAK)
    valleys = void_volume(heights, VALLEY)
    return MaterialParameters(
        Sk=core.Rk,
        Spk=core.Rpk,
        Svk=core.Rvk,
        Smr1=core.Mr1,
        Smr2=core.Mr2,
        Sxp=_height_at(heights, EXTREME[0]) - _height_at(heights, EXTREME[1]),
        Vmp=peaks,
        Vmc=material_volume(heights, VALLEY) - peaks,
        Vvc=void_volume(heights, PEAK) - valleys,
        Vvv=valleys,
        s_shaped=core.s_shaped,
    )


def _height_at(heights: np.ndarray, percent: float) -> float:
    """Height at a material ratio (%), between two heights by a straight line."""
    place = percent / 100.0 * heights.size - 0.5
    low = int(np.clip(np.floor(place), 0, heights.size - 1))
    high = min(low + 1, heights.size - 1)
    share = float(np.clip(place - low, 0.0, 1.0))
    return float((1.0 - share) * heights[low] + share * heights[high])
