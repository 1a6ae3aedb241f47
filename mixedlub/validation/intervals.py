"""Means, medians and extremes over cases, with their 90 % intervals."""

from __future__ import annotations

import numpy as np


def reduced(values: np.ndarray, weights: np.ndarray, reduction: str) -> float:
    """Weighted mean, median or maximum of the values."""
    if not len(values):
        return float("nan")
    if reduction == "median":
        return float(np.median(values))
    return float(np.max(values) if reduction == "max" else np.average(values, weights=weights))


def interval(values: np.ndarray, weights: np.ndarray, reduction: str) -> tuple[float, float]:
    """90 % interval: Wilson's for a share, otherwise by bootstrap over cases.

    A bootstrap of hits alone has zero width. Wilson's interval ignores the correlation of errors within a case: if
    cases count for several readings, the interval is the hull of both.
    """
    if reduction != "share":
        return _bootstrap(values, weights, reduction)
    if not len(values):
        return float("nan"), float("nan")
    low, high = wilson(round(float(values @ weights)), round(float(weights.sum())))
    if np.all(weights == 1.0) or len(values) < 2:
        return low, high
    first, last = _bootstrap(values, weights, reduction)
    return min(low, first), max(high, last)


def wilson(hits: int, of: int) -> tuple[float, float]:
    """Wilson's 90 % score interval of a proportion.

    Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209.

    >>> [round(end, 3) for end in wilson(20, 20)]   # 1 / (1 + 1.645^2 / 20)
    [0.881, 1.0]
    """
    from scipy.stats import binomtest

    low, high = binomtest(hits, of).proportion_ci(0.90, "wilson")
    return float(low), float(high)


def _bootstrap(values: np.ndarray, weights: np.ndarray, reduction: str) -> tuple[float, float]:
    """90 % bootstrap interval over cases, from a fixed seed."""
    if len(values) < 2 or reduction == "max":
        return float("nan"), float("nan")
    rng = np.random.default_rng(len(values))
    picks = rng.integers(0, len(values), (400, len(values)))
    drawn = [reduced(values[pick], weights[pick], reduction) for pick in picks]
    low, high = np.quantile(drawn, [0.05, 0.95])
    return float(low), float(high)
