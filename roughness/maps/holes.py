"""Holes of a map: filled from their rims, coarse to fine."""

from __future__ import annotations

import numpy as np

from profiles import InputError

MOST_FILLED = 0.5
"""Judgement. Share of points without a height up to which a map is filled; beyond it more is invented than measured."""
ROUNDS, SUMS = (12, 300), 3_000_000
"""Cost limit. Fewest and most means over four neighbours a level, and their number in all: with few holes a level is
relaxed to its end."""


def filled(heights: np.ndarray, where: str = "map") -> np.ndarray:
    """Heights with holes closed by a smooth surface from rim to rim; the other heights are unchanged.

    Every hole gets the means of a map of half as many points a side, itself filled the same way, then means over its
    four neighbours, which tend to the surface of a stretched skin.

    >>> y, x = np.mgrid[0:64, 0:64]
    >>> plane = 1e-7 * (x + 2 * y)
    >>> holed = np.where((x - 30) ** 2 + (y - 30) ** 2 < 50, np.nan, plane)
    >>> bool(np.abs(filled(holed) - plane).max() < 0.3e-7)
    True
    """
    there = np.isfinite(heights)
    missing = heights.size - int(np.count_nonzero(there))
    if missing > MOST_FILLED * heights.size:
        rule = (
            f"has holes: {missing} of {heights.size} points have no height, more than {100 * MOST_FILLED:g} %, which "
            "is too much to fill; measure again, or cut the map to a part without"
        )
        raise InputError(rule, where=where)
    return _filled(np.where(there, heights, 0.0), there)


def _filled(z: np.ndarray, there: np.ndarray) -> np.ndarray:
    if there.all() or not there.any():
        return z
    shape = z.shape
    padded = [(0, n % 2) for n in shape]
    weights = _by_fours(np.pad(there.astype(float), padded))
    sums = _by_fours(np.pad(np.where(there, z, 0.0), padded))
    coarse = _filled(sums / np.maximum(weights, 1.0), weights > 0.0)
    rows, columns = np.nonzero(~there)
    z = z.copy()
    z[rows, columns] = _between(coarse, rows, columns)
    up, down = np.maximum(rows - 1, 0), np.minimum(rows + 1, shape[0] - 1)
    left, right = np.maximum(columns - 1, 0), np.minimum(columns + 1, shape[1] - 1)
    for _ in range(int(np.clip(SUMS // rows.size, *ROUNDS))):
        z[rows, columns] = 0.25 * (z[up, columns] + z[down, columns] + z[rows, left] + z[rows, right])
    return z


def _by_fours(values: np.ndarray) -> np.ndarray:
    """Sums over two by two points."""
    summed: np.ndarray = values[::2, ::2] + values[1::2, ::2] + values[::2, 1::2] + values[1::2, 1::2]
    return summed


def _between(coarse: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Values of a map of half as many points a side at places of the finer map, by straight lines."""
    from scipy.ndimage import map_coordinates

    # the middle of the first two by two points lies half a fine step inside
    found: np.ndarray = map_coordinates(coarse, ((rows - 0.5) / 2, (columns - 0.5) / 2), order=1, mode="nearest")
    return found
