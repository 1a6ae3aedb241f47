"""Detection of single samples far from other turns, repeats or load stages; they are reported, never removed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pandas as pd
from scipy.interpolate import Akima1DInterpolator
from scipy.ndimage import maximum_filter1d, minimum_filter1d
from scipy.stats import theilslopes

from mixedlub.schema.findings import finding, report

LIMIT = 10.0
"""Judgement. Least deviation reported, in robust standard deviations (1.4826 median absolute deviations)."""
TO_SIGMA = 1.4826
"""Definition. Standard deviation over median absolute deviation of a normal distribution."""
RESOLUTION = 5e-3
"""Judgement. Least robust standard deviation over the range of the signal: deviations below 5 % are not reported."""
NEIGHBOURS = 3
"""Judgement. Adjacent angles with medians that bound a signal."""
NAMED = 3
"""Judgement. Samples named in a message; the others are counted."""
NEAR = 15
"""Judgement. Consecutive angles for an estimate of local scatter."""
SHORTEST = 4
"""Definition. Fewest samples of a turn for interpolation."""
LEAST_REPEATS = 3
"""Definition. Fewest readings with a median robust against one wrong reading."""


def report_outlying(
    deviation: np.ndarray,
    floor: float | np.ndarray,
    channel: str,
    place: Callable[[int], str],
    *,
    beyond: np.ndarray | None = None,
) -> None:
    """Report samples with an implausibly large deviation from the others.

    Scale: robust standard deviation of all deviations (n,), at least ``floor``; deviations without comparison are nan.
    ``beyond`` (n,): part of each deviation that counts, by default all. ``place``: name of a sample by index.
    """
    size = np.abs(deviation)
    if not np.isfinite(size).any():
        return
    scale = np.maximum(TO_SIGMA * float(np.nanmedian(size)), floor)
    counted = (size if beyond is None else np.abs(beyond)) / scale
    far = np.flatnonzero(counted > LIMIT)
    far = far[np.argsort(-counted[far], kind="stable")]
    if far.size:
        told = ", ".join(f"{place(row)} is {counted[row]:.3g}" for row in far[:NAMED])
        more = f"; so are {far.size - NAMED} more samples" if far.size > NAMED else ""
        used = "it is used as it is" if far.size == 1 else "they are used as they are"
        text = f"{told} robust standard deviations from the others{more}; {used}"
        report(finding("sample_outlying", text, channel))


def _scatter_near(deviation: np.ndarray, order: np.ndarray, count: int) -> np.ndarray:
    """Largest robust standard deviation (n,) among windows of ``count`` samples, in ``order``, around each sample."""
    scatter = np.empty(deviation.size)
    near = pd.Series(np.abs(deviation[order])).rolling(count, center=True, min_periods=1).median()
    scatter[order] = TO_SIGMA * near.rolling(count, center=True, min_periods=1).max()
    return scatter


def check_turns(turn: np.ndarray, angle: np.ndarray, signals: Mapping[str, np.ndarray], source: str) -> None:
    """Report samples (n,) of each channel that differ from the median of all turns at the same shaft angle.

    Deviations are from the range of the medians at neighbouring angles, since a signal may step, in units of the
    scatter of the turn or of nearby angles, whichever is larger. Angles of a single turn are left out, and the first
    and last step unless two turns begin or end alike. With two turns both samples are named, since either may be wrong.
    """
    order = np.lexsort((angle, turn))
    _, first = np.unique(turn[order], return_index=True)
    parts = [rows for rows in np.split(order, first[1:]) if rows.size >= SHORTEST]
    if len(parts) < 2:
        return
    start = float(np.sort([angle[rows[0]] for rows in parts])[1])
    end = float(np.sort([angle[rows[-1]] for rows in parts])[-2])
    if start >= end:
        return
    step = float(np.median(np.diff(angle[order])))
    grid = np.linspace(start, end, 1 + math.ceil((end - start) / max(step, 1e-3)))
    along = np.argsort(angle, kind="stable")
    before = np.clip(np.searchsorted(grid, angle) - 1, 0, grid.size - 2)
    alike = [np.count_nonzero(angle == one) > 1 for one in (start, end)]
    told = (angle >= (start if alike[0] else start + step)) & (angle <= (end if alike[1] else end - step))
    for channel, signal in signals.items():
        curves = [Akima1DInterpolator(angle[rows], signal[rows], method="makima") for rows in parts]
        each = np.stack([curve(grid) for curve in curves])
        several = np.isfinite(each).sum(axis=0) > 1
        centre = np.full(grid.size, np.nan)
        centre[several] = np.nanmedian(each[:, several], axis=0)
        low = minimum_filter1d(np.where(several, centre, np.inf), NEIGHBOURS)
        high = maximum_filter1d(np.where(several, centre, -np.inf), NEIGHBOURS)
        low, high = (np.where(several, one, np.nan) for one in (low, high))
        low, high = np.minimum(low[before], low[before + 1]), np.maximum(high[before], high[before + 1])
        middle = np.interp(angle, grid, centre, np.nan, np.nan)
        beyond = np.where(told, np.maximum(np.maximum(signal - high, low - signal), 0.0), np.nan)
        least = RESOLUTION * float(np.ptp(centre[several])) if several.any() else 0.0
        floor = np.maximum(least, _scatter_near(signal - middle, along, NEAR * len(parts)))

        def place(row: int, signal: np.ndarray = signal) -> str:
            return f"row {row + 1}, revolution {turn[row]} at {angle[row]:.4g} deg ({signal[row]:.4g})"

        report_outlying(signal - middle, floor, f"{source}, {channel}", place, beyond=beyond)


def check_repeats(value: np.ndarray, sd: np.ndarray, groups: np.ndarray, run: np.ndarray, channel: str) -> None:
    """Report readings that differ from the median at the same conditions, relative to the median.

    ``groups`` (n, k): levels of the conditions. The scale is at least the stated ``sd``, since repeats are few.
    """
    deviation = np.full(value.size, np.nan)
    for group in np.unique(groups, axis=0):
        rows = np.flatnonzero((groups == group).all(axis=1))
        middle = float(np.median(value[rows]))
        if rows.size >= LEAST_REPEATS and middle:
            deviation[rows] = value[rows] / middle - 1.0
    stated = float(np.median(sd / np.maximum(np.abs(value), np.median(np.abs(value)))))
    floor = max(RESOLUTION, stated)
    report_outlying(deviation, floor, channel, lambda row: f"run {run[row]} ({value[row]:.4g})")


def check_lines(
    x: np.ndarray, y: np.ndarray, series: np.ndarray, run: np.ndarray, channel: str, *, exponent: float
) -> None:
    """Report the reading of each series farthest from the median line, relative to the mean of the line.

    Allowed is twice the bend of a line with a slope that varies as x to the power ``exponent``; no bend at x = 0.
    """
    deviation, beyond = np.full(y.size, np.nan), np.zeros(y.size)
    for one in np.unique(series):
        rows = np.flatnonzero(series == one)
        if rows.size > LEAST_REPEATS and np.unique(x[rows]).size > 2:
            slope, start, *_ = theilslopes(y[rows], x[rows], method="joint")
            line = start + slope * x[rows]
            deviation[rows] = (y[rows] - line) / line.mean()
            middle = np.median(x[rows][x[rows] > 0.0])
            away = np.abs(np.log(np.where(x[rows] > 0.0, x[rows] / middle, 1.0)))
            bend = 2.0 * exponent * away * np.abs(line / line.mean())
            off = np.maximum(np.abs(deviation[rows]) - bend, 0.0)
            beyond[rows[np.argmax(off)]] = off.max()
    report_outlying(deviation, RESOLUTION, channel, lambda row: f"run {run[row]} ({y[row]:.4g})", beyond=beyond)
