"""Binning of values with more levels than a figure can show."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.labels import number
from mixedlub.recording.set_points import set_points


def together(values: np.ndarray, most: int, bins: int | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Group of each value, and the lower median of each group.

    A group is a printed level; beyond ``most`` levels, the groups are ``bins`` of one sign and about equal counts.

    >>> label, place = together(np.array([-9.0, -8.0, -7.0, 5.0, 6.0, 7.0]), 2)
    >>> label.tolist(), place.tolist()
    ([0, 0, 0, 1, 1, 1], [-8.0, 6.0])
    >>> together(np.array([25.01, 25.03, 30.0, 25.02]), 4)[0].tolist()
    [0, 0, 1, 0]
    """
    values = set_points(values)
    if values.dtype.kind in "US":
        levels, label = np.unique(values, return_inverse=True)
        return label, levels
    levels, label = np.unique([float(number(float(v))) for v in values], return_inverse=True)
    if levels.size > most:
        label = _binned(np.bincount(label), np.sign(levels), bins or most)[label]
    return label, np.array([_middle(values[label == k]) for k in range(label.max() + 1)])


def _binned(count: np.ndarray, sign: np.ndarray, bins: int) -> np.ndarray:
    """Bin of each level, from the number of values at each level; signs are kept separate."""
    sides = [sign < 0, sign == 0, sign > 0] if sign.min() < 0 < sign.max() else [np.ones(count.size, bool)]
    label = np.zeros(count.size)
    for index, side in enumerate(side for side in sides if side.any()):
        counts = count[side]
        share = max(1, round(bins * counts.sum() / count.sum()))
        rank = (np.cumsum(counts) - 0.5 * counts) / counts.sum()
        label[side] = index * (bins + 1) + np.floor(share * rank)
    return np.unique(label, return_inverse=True)[1]


def _middle(values: np.ndarray) -> float:
    return float(np.quantile(values, 0.5, method="lower"))
