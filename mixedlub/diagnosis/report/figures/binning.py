"""Values taken together where a figure has no room for each."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.labels import number
from mixedlub.recording.set_points import set_points


def together(values: np.ndarray, most: int, bins: int | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Group of each value, and of each group the value in its middle, one that was recorded.

    A group is one level as it is printed; where there are more than ``most``, as many ``bins`` with even numbers of
    values, which never have both signs.

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
    """Bin of each level, by how many values each has and, where both are among them, by sign."""
    sides = [sign < 0, sign == 0, sign > 0] if sign.min() < 0 < sign.max() else [np.ones(count.size, bool)]
    found = np.zeros(count.size)
    for place, side in enumerate(side for side in sides if side.any()):
        own = count[side]
        share = max(1, round(bins * own.sum() / count.sum()))
        rank = (np.cumsum(own) - 0.5 * own) / own.sum()
        found[side] = place * (bins + 1) + np.floor(share * rank)
    return np.unique(found, return_inverse=True)[1]


def _middle(values: np.ndarray) -> float:
    return float(np.quantile(values, 0.5, method="lower"))
