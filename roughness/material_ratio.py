"""The material ratio (Abbott) curve and its parameters of ISO 13565-2."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile
from roughness.parameters import evaluation_length, named_convention

SAMPLING_LENGTHS = 5
"""Sampling lengths of the evaluation length by default (ISO 4288, ISO 21920-3)."""
CORE_METHODS = ("least squares", "class levels")


@dataclass(frozen=True)
class CoreParameters:
    """Rk family: heights in m, ratios in percent, areas in m (height x ratio).

    ``s_shaped`` is False where the flattest 40 % lie at an end of the curve, as on a sine, or are level, as
    on a square wave: the parameters then mean nothing. ``length`` is the evaluated length (m).
    """

    Rk: float
    Rpk: float
    Rvk: float
    Mr1: float
    Mr2: float
    A1: float
    A2: float
    s_shaped: bool
    method: str
    length: float


@of_profile
def material_ratio_curve(profile: Profile) -> tuple[np.ndarray, np.ndarray]:
    """Heights from highest to lowest (m) and the percentage of the profile at or above each.

    >>> ratio, heights = material_ratio_curve(Profile(np.array([2.0, 0.0, 1.0, -1.0]), 1e-6))
    >>> ratio, heights
    (array([12.5, 37.5, 62.5, 87.5]), array([ 2.,  1.,  0., -1.]))
    """
    heights = np.sort(profile.heights[profile.valid])[::-1]
    return 100.0 * (np.arange(heights.size) + 0.5) / heights.size, heights


@of_profile
def material_ratio(profile: Profile, height: float) -> float:
    """Rmr(c): percentage of the profile at or above a height (m) over the zero line. ISO 4287, 4.5.2.

    >>> material_ratio(Profile(np.array([2.0, 0.0, 1.0, -1.0]), 1e-6), 0.5)
    50.0
    """
    return float(100.0 * np.mean(profile.heights[profile.valid] >= height))


@of_profile
def core_profile(profile: Profile, *, convention: str = "ISO 4287:1997", sections: int | None = None) -> Profile:
    """One evaluation length in the middle of a profile: five cut-offs, or as many as fit. ISO 13565-1, ISO 21920-3.

    A stated number of ``sections``, or a convention of the profile as a whole, makes the profile the evaluation length.

    >>> core_profile(Profile(np.zeros(4800), 1e-6, cutoffs={"cutoff": 0.8e-3})).heights.size
    4000
    """
    stated = sections is not None or not named_convention(convention).extremes_sectioned
    return profile if stated else evaluation_length(profile, SAMPLING_LENGTHS)


@of_profile
def core_parameters(profile: Profile, *, method: str = "least squares") -> CoreParameters:
    """Rk Rpk Rvk Mr1 Mr2 by the line through the flattest 40 % of the curve. ISO 13565-2, 4.

    ``least squares``: the full curve and the least-squares line over the flattest 40 %, as the standard
    says. ``class levels``: the curve counted at 100 equal levels and the secant of those 40 %, as some
    instruments do. They differ by up to 8 %. Rpk and Rvk are the triangles of equal area. The curve is one of the
    whole profile; ``core_profile`` cuts the evaluation length of the standard.
    """
    return core_of_curve(*material_ratio_curve(profile), method=method, length=profile.heights.size * profile.spacing)


def core_of_curve(
    ratio: np.ndarray, heights: np.ndarray, *, method: str = "least squares", length: float = math.nan
) -> CoreParameters:
    """Rk family of a material ratio curve: ratios (%), and heights from highest to lowest (m). ISO 13565-2, 4.

    >>> ratio = np.linspace(0.5, 99.5, 100)
    >>> round(core_of_curve(ratio, 1e-6 * (50.0 - ratio)).Rk * 1e6, 9)   # a straight curve is all core
    100.0
    """
    if method not in CORE_METHODS:
        raise InputError(f"must be known; {nearest(method, CORE_METHODS)}", where="Rk method", value=method)
    if method == "class levels":
        levels = np.linspace(heights[0], heights[-1], 101)
        ratio = np.searchsorted(-heights, -levels, side="right") * 100.0 / heights.size
        heights = levels
        start, slope, top = _flattest_secant(ratio, heights)
    else:
        start, slope, top = _flattest_line(ratio, heights)
    bottom = top + 100.0 * slope
    deciles = np.interp(10.0, ratio, heights) - np.interp(90.0, ratio, heights)
    mr1 = float(np.interp(-top, -heights, ratio))
    mr2 = float(np.interp(-bottom, -heights, ratio))
    a1 = float(_area(np.maximum(heights - top, 0.0), ratio))
    a2 = float(_area(np.maximum(bottom - heights, 0.0), ratio))
    return CoreParameters(
        Rk=float(top - bottom),
        Rpk=2.0 * a1 / (mr1 / 100.0) if a1 > 0 and mr1 > 0 else 0.0,
        Rvk=2.0 * a2 / (1.0 - mr2 / 100.0) if a2 > 0 and mr2 < 100.0 else 0.0,
        Mr1=mr1,
        Mr2=mr2,
        A1=a1,
        A2=a2,
        s_shaped=bool(1.0 < start < 59.0 and -40.0 * slope > 0.02 * deciles),
        method=method,
        length=float(length),
    )


def _flattest_line(ratio: np.ndarray, heights: np.ndarray) -> tuple[float, float, float]:
    """Start (%), slope (m per %) and height at 0 % of the least-squares line over the flattest 40 %."""
    width = round(0.4 * heights.size)
    first = int(np.argmin(heights[:-width] - heights[width:]))
    x, z = ratio[first : first + width + 1], heights[first : first + width + 1]
    centre = x.mean()
    slope = (x - centre) @ z / ((x - centre) @ (x - centre))
    return float(x[0]), float(slope), float(z.mean() - slope * centre)


def _flattest_secant(ratio: np.ndarray, heights: np.ndarray) -> tuple[float, float, float]:
    """The same by the secant with the least fall over 40 %, both its ends read between levels."""
    starts = ratio[ratio <= 60.0]
    tops = heights[: starts.size]
    falls = tops - np.interp(starts + 40.0, ratio, heights)
    first = int(np.argmin(falls))
    slope = -falls[first] / 40.0
    return float(starts[first]), float(slope), float(tops[first] - slope * starts[first])


def _area(excess: np.ndarray, ratio: np.ndarray) -> float:
    """Area under the curve's excess, over a ratio of 0 to 1, with the half step before the first point."""
    return np.trapezoid(excess, ratio / 100.0) + excess[0] * ratio[0] / 100.0 + excess[-1] * (1.0 - ratio[-1] / 100.0)
