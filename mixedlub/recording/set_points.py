"""Set points of a condition, from measured values that scatter about them."""

from __future__ import annotations

import numpy as np

NEAR_SIZE = 0.015
"""Judgement. Distance of neighbours, as a share of their size, up to which they may belong to one set point."""
NEAR_SPAN = 0.005
"""Judgement. The same as a share of the whole span."""
WIDEST = 2.0
"""Judgement. Largest width of a set point in units of those distances; a wider range was swept."""


def set_points(values: np.ndarray) -> np.ndarray:
    """Each value replaced by the roundest number of its set point, unless the condition was swept.

    >>> set_points(np.array([2.996, 8.994, 3.001, 9.003])).tolist()
    [3.0, 9.0, 3.0, 9.0]
    >>> set_points(np.array([1000.0, 1010.0, 1000.0, 1010.0])).tolist()   # set
    [1000.0, 1010.0, 1000.0, 1010.0]
    >>> set_points(np.array([0.101, 0.13, 0.17, 2.2, 0.1, 0.131, 0.169, 2.21])).tolist()   # swept up and down
    [0.1, 0.13, 0.17, 2.2, 0.1, 0.13, 0.17, 2.2]
    >>> set_points(np.array([1.0, 1.01, 1.02, 1.03, 1.04, 1.05])).tolist()   # swept
    [1.0, 1.01, 1.02, 1.03, 1.04, 1.05]
    """
    if values.dtype.kind in "US" or values.size < 2:
        return values
    order = np.argsort(values, kind="stable")
    ranked = values[order].astype(float)
    for near in (NEAR_SPAN * (ranked[-1] - ranked[0]), 0.0):
        points = _clusters(ranked, near)
        if points is not None:
            found = np.empty(values.size)
            found[order] = points
            return found
    return values


def near_values(values: np.ndarray) -> np.ndarray:
    """Index of the set point of each value; in a swept condition, of each distinct value.

    >>> near_values(np.array([0.5, 0.1, 0.1001, 0.2])).tolist()
    [2, 0, 0, 1]
    """
    ranked = np.sort(values).astype(float)
    label = _labels(ranked, 0.0) if ranked.size else None
    if label is None:
        return np.unique(values, return_inverse=True)[1]
    return label[np.searchsorted(ranked, values)]


def _labels(ranked: np.ndarray, least: float) -> np.ndarray | None:
    """Cluster of each ranked value, with neighbours nearer than ``least`` joined; None if a cluster is too wide."""
    label = np.concatenate([[0], np.cumsum(np.diff(ranked) > np.maximum(NEAR_SIZE * np.abs(ranked[1:]), least))])
    first = np.searchsorted(label, np.arange(label[-1] + 1))
    last = np.searchsorted(label, np.arange(label[-1] + 1), side="right") - 1
    allowed = WIDEST * np.maximum(NEAR_SIZE * np.abs(ranked[first]), least)
    return None if np.any(ranked[last] - ranked[first] > allowed) else label


def _clusters(ranked: np.ndarray, least: float) -> np.ndarray | None:
    """Set points of ranked values, with neighbours nearer than ``least`` joined; None for a swept condition."""
    label = _labels(ranked, least)
    if label is None or 2 * (label[-1] + 1) > ranked.size:
        return None
    count = np.bincount(label)
    last = np.cumsum(count) - 1
    first = last - count + 1
    if np.array_equal(ranked[first], ranked[last]):
        return None
    exact, times = np.unique(ranked, return_counts=True)
    repeated = np.searchsorted(ranked, exact[times > 1])
    if np.unique(label[repeated]).size < repeated.size:
        return None  # two repeated values in one cluster are two set points
    return np.array([roundest(low, high) for low, high in zip(ranked[first], ranked[last], strict=True)])[label]


def roundest(low: float, high: float) -> float:
    """The number of fewest digits within a range, nearest to its middle.

    >>> roundest(2.996, 3.001), roundest(59.2, 60.4), roundest(0.1234, 0.1234)
    (3.0, 60.0, 0.1234)
    """
    if low <= 0.0 <= high:
        return 0.0
    middle = 0.5 * (low + high)
    tried = (float(f"{middle:.{digits}g}") for digits in range(1, 16))
    return next((x for x in tried if low <= x <= high), float(middle))


def one_point(low: float, high: float) -> float | None:
    """Set point of a range, or None for a range wider than a set point.

    >>> one_point(2.996, 3.001), one_point(3.0, 9.0)
    (3.0, None)
    """
    if high - low > WIDEST * NEAR_SIZE * max(abs(low), abs(high)):
        return None
    return low if low == high else roundest(low, high)
