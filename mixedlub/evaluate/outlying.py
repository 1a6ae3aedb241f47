"""Single samples far from those at the same place of the other turns, repeats or load stages: named, never left out."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.interpolate import Akima1DInterpolator
from scipy.ndimage import maximum_filter1d, minimum_filter1d
from scipy.stats import theilslopes

from mixedlub.schema.findings import finding, report

LIMIT = 10.0
"""Judgement. Robust standard deviations (1.4826 times the median absolute deviation) from which a sample is named."""
TO_SIGMA = 1.4826
"""Definition. Standard deviation over median absolute deviation of normal numbers."""
RESOLUTION = 5e-3
"""Judgement. Least robust standard deviation over the range of the signal: below 5 % of it nothing is wild."""
NEIGHBOURS = 3
"""Judgement. Samples of the median about an angle between which a signal may lie."""
NAMED = 3
"""Samples that a message names; it counts the others."""
SHORTEST = 4
"""Samples of a turn that an interpolation needs."""
LEAST_REPEATS = 3
"""Readings whose median bears one wrong one."""


def report_outlying(
    deviation: np.ndarray, floor: float, channel: str, place: Callable[[int], str], *, beyond: np.ndarray | None = None
) -> None:
    """Report the samples whose deviation from the others is implausibly large.

    The scale is that of all deviations (n,), nan where there is nothing to compare with, but ``floor`` at least.
    ``beyond`` (n,) is what counts of each deviation, all of it unless given. ``place`` names a sample by its number.
    """
    size = np.abs(deviation)
    if not np.isfinite(size).any():
        return
    scale = max(TO_SIGMA * float(np.nanmedian(size)), floor)
    counted = size if beyond is None else np.abs(beyond)
    far = np.flatnonzero(counted > LIMIT * scale)
    far = far[np.argsort(-counted[far], kind="stable")]
    told = "; ".join(f"{place(row)}: {counted[row] / scale:.3g}" for row in far[:NAMED])
    if far.size:
        more = f"; and {far.size - NAMED} more samples" if far.size > NAMED else ""
        text = f"far from the others, in robust standard deviations: {told}{more}; it is used as it is"
        report(finding("sample_outlying", text, channel))


def check_turns(turn: np.ndarray, angle: np.ndarray, signals: Mapping[str, np.ndarray], source: str) -> None:
    """Report samples of signals (n,) by channel that differ from the median of all turns at the same shaft angle.

    What counts is the distance from the medians at the angle and its neighbours, as a signal may change at once.
    Angles of one turn alone are left out. Two turns do not tell which is wrong: both are named.
    """
    order = np.lexsort((angle, turn))
    _, first = np.unique(turn[order], return_index=True)
    parts = [rows for rows in np.split(order, first[1:]) if rows.size >= SHORTEST]
    if len(parts) < 2:
        return
    step = float(np.median(np.diff(angle[order])))
    grid = np.arange(angle.min(), angle.max() + step, max(step, 1e-3))
    for channel, signal in signals.items():
        curves = [Akima1DInterpolator(angle[rows], signal[rows], method="makima") for rows in parts]
        each = np.stack([curve(grid) for curve in curves])
        several = np.isfinite(each).sum(axis=0) > 1
        centre = np.full(grid.size, np.nan)
        centre[several] = np.nanmedian(each[:, several], axis=0)
        low = minimum_filter1d(np.where(several, centre, np.inf), NEIGHBOURS)
        high = maximum_filter1d(np.where(several, centre, -np.inf), NEIGHBOURS)
        low, high = (np.where(several, one, np.nan) for one in (low, high))
        middle, low, high = (np.interp(angle, grid, one) for one in (centre, low, high))
        beyond = np.maximum(np.maximum(signal - high, low - signal), 0.0)
        floor = RESOLUTION * float(np.ptp(centre[several])) if several.any() else 0.0

        def place(row: int, signal: np.ndarray = signal) -> str:
            return f"revolution {turn[row]} at {angle[row]:.4g} deg (row {row + 1}) with {signal[row]:.4g}"

        report_outlying(signal - middle, floor, f"{source}, {channel}", place, beyond=beyond)


def check_repeats(value: np.ndarray, sd: np.ndarray, groups: np.ndarray, run: np.ndarray, channel: str) -> None:
    """Report readings that differ from the median of those at the same conditions, over that median.

    ``groups`` (n, k) are the levels of the conditions. Repeats are few: their scale is not below the stated ``sd``.
    """
    deviation = np.full(value.size, np.nan)
    for group in np.unique(groups, axis=0):
        rows = np.flatnonzero((groups == group).all(axis=1))
        middle = float(np.median(value[rows]))
        if rows.size >= LEAST_REPEATS and middle:
            deviation[rows] = value[rows] / middle - 1.0
    stated = float(np.median(sd / np.maximum(np.abs(value), np.median(np.abs(value)))))
    floor = max(RESOLUTION, stated)
    report_outlying(deviation, floor, channel, lambda row: f"run {run[row]} with {value[row]:.4g}")


def check_lines(
    x: np.ndarray, y: np.ndarray, series: np.ndarray, run: np.ndarray, channel: str, *, exponent: float
) -> None:
    """Report the reading of each series that is farthest off the median line, over the mean of that.

    Twice what a slope that changes with x by a power of ``exponent`` bends the line does not count.
    """
    deviation, beyond = np.full(y.size, np.nan), np.zeros(y.size)
    for one in np.unique(series):
        rows = np.flatnonzero((series == one) & (x > 0.0))
        if rows.size > LEAST_REPEATS and np.unique(x[rows]).size > 2:
            slope, start, *_ = theilslopes(y[rows], x[rows])
            line = start + slope * x[rows]
            deviation[rows] = (y[rows] - line) / line.mean()
            bend = 2.0 * exponent * np.abs(np.log(x[rows] / np.median(x[rows]))) * np.abs(line / line.mean())
            off = np.maximum(np.abs(deviation[rows]) - bend, 0.0)
            beyond[rows[np.argmax(off)]] = off.max()
    report_outlying(deviation, RESOLUTION, channel, lambda row: f"run {run[row]} with {y[row]:.4g}", beyond=beyond)
