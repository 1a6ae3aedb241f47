"""Checks of arrays given to the gear room."""

from __future__ import annotations

import numpy as np

from profiles.errors import InputError


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
