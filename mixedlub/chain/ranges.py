"""Whether quantities are within the range in which a law or effect is known to hold."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Any

import numpy as np

SLACK = 1e-9
"""Rounding that a quantity may have beyond its range, over the end of it."""


def beyond(state: Mapping[str, Any], valid: Mapping[str, tuple[float, float]]) -> np.ndarray:
    """Where any quantity is outside its range, rounding aside, or is no number.

    >>> beyond({"slide_roll_ratio": np.array([2.0 + 1e-12, 2.1, np.nan])}, {"slide_roll_ratio": (0.0, 2.0)}).tolist()
    [False, True, True]
    """
    within = (
        (state[name] >= low - SLACK * abs(low)) & (state[name] <= high + SLACK * abs(high))
        for name, (low, high) in valid.items()
    )
    return ~reduce(np.logical_and, within, np.ones(1, bool))


def farthest_beyond(value: np.ndarray, ends: tuple[float, float], where: np.ndarray) -> np.ndarray:
    """The value that lies farthest beyond a range along the last axis, kept as one; NaN where none does.

    >>> where = np.array([True, True, False])
    >>> farthest_beyond(np.array([[3.0, 1.5, 9.0], [1.0, 2.0, 9.0]]), (0.0, 2.0), where).tolist()
    [[3.0], [nan]]
    """
    off = where & beyond({"value": value}, {"value": ends})
    value = np.broadcast_to(np.where(np.isnan(value), np.inf, value), off.shape)
    most = np.max(value, axis=-1, keepdims=True, where=off, initial=-np.inf)
    least = np.min(value, axis=-1, keepdims=True, where=off, initial=np.inf)
    return np.where(off.any(axis=-1, keepdims=True), np.where(most > ends[1], most, least), np.nan)
