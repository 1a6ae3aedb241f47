"""Checks of numbers and arrays given to the gear room."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from profiles.errors import InputError


def number(key: str, value: Any, low: float, high: float, rule: str, scale: float = 1.0) -> float:
    """A finite float strictly between ``low`` and ``high``; messages show it in the unit of its key."""
    if isinstance(value, (bool, str, bytes)):
        raise InputError(rule, where=key, value=value)
    try:
        finite = float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(rule, where=key, value=value) from None
    if not (math.isfinite(finite) and low < finite < high):
        raise InputError(rule, where=key, value=round(finite * scale, 9))
    return finite


def whole(key: str, value: Any, low: int, high: int) -> int:
    """A whole number from ``low`` to ``high``."""
    if isinstance(value, bool) or not hasattr(value, "__index__") or not low <= value <= high:
        raise InputError(f"a whole number from {low} to {high}", where=key, value=value)
    return int(value)


def two(key: str, values: Any) -> tuple[Any, Any]:
    """The two entries, pinion first, of a quantity of both wheels."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise InputError("two values are needed, pinion first", where=key, value=values)
    entries = tuple(values)
    if len(entries) != 2:
        raise InputError("two values are needed, pinion first", where=key, value=entries)
    return entries


def torques_above_zero(torque: object) -> np.ndarray:
    """Torques (N m) as an array of the shape given, each finite and above zero."""
    try:
        torques = np.asarray(torque, dtype=float)
    except (TypeError, ValueError):
        raise InputError("torques are numbers in N m", where="torque_Nm", value=torque) from None
    wrong = ~(np.isfinite(torques) & (torques > 0))
    if np.any(wrong):
        raise InputError("a torque is finite and above zero", where="torque_Nm", value=float(torques[wrong].flat[0]))
    return torques


def column(key: str, values: object) -> np.ndarray:
    """A finite one-dimensional copy of a column of a table."""
    try:
        column = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError("a column of numbers is needed", where=key, value=values) from None
    if column.ndim != 1 or column.size == 0:
        raise InputError("a column of numbers is needed", where=key, value=column.shape)
    if not np.all(np.isfinite(column)):
        raise InputError("every row needs a finite number", where=key, value=int(np.argmin(np.isfinite(column))))
    return column
