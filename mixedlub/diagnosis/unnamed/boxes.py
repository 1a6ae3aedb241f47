"""Forms tied to a box of conditions: what is there only where two or three of them are in a range each."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.recording.features import PASSING, Coordinates
from mixedlub.diagnosis.recording.levels import set_points
from mixedlub.diagnosis.unnamed.places import DERIVED, TURNED, edges, made_of, thinned

SEEDS = 12
"""Readings, those farthest off, from whose own conditions a box is grown."""
ROUNDS = 6
"""Times the ranges of a box are gone through at most."""

Box = tuple[tuple[str, float, float], ...]


def clearest_box(
    space: Coordinates, values: list[np.ndarray], left: np.ndarray, scale: np.ndarray
) -> tuple[Box, float] | None:
    """The box whose readings are most together on one side, and the log of how many there are like it.

    ``left`` are residuals in sigmas, ``scale`` is what a mismatch there goes by. A box of one condition has a
    name already, as a step or a peak; none is of so few readings that they may be outliers.
    """
    axes = [
        (axis.name, *_cells(v))
        for axis, v in zip(space.axes, values, strict=True)
        if not axis.named and axis.name not in (*PASSING, DERIVED, TURNED)
    ]
    axes = [(name, at, cell) for name, at, cell in axes if at.size > 2]
    if len(axes) < 2:
        return None
    cells = np.array([cell for _, _, cell in axes])
    counts = [at.size - 1 for _, at, _ in axes]
    costs = np.array([np.log(n * (n + 1) / 2.0) for n in counts])
    found: tuple[float, np.ndarray] | None = None
    for seed in np.argsort(np.abs(left * scale))[::-1][:SEEDS]:
        worth, box = _grown(cells, counts, costs, cells[:, seed], left * scale, scale**2)
        inside = _inside(cells, box)
        cut = (box[:, 0] > 0) | (box[:, 1] < np.array(counts) - 1)
        if cut.sum() > 1 and made_of(inside.astype(float), True) and (found is None or worth > found[0]):
            found = worth, box
    if found is None:
        return None
    box = found[1]
    cut = (box[:, 0] > 0) | (box[:, 1] < np.array(counts) - 1)
    ranges = tuple(
        (name, float(at[low]), float(at[high + 1]))
        for (name, at, _), (low, high), own in zip(axes, box, cut, strict=True)
        if own
    )
    return ranges, float(costs[cut].sum())


def inside(box: Box, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Which rows a box holds."""
    held = np.ones(values[0].size, bool)
    for name, low, high in box:
        v = values[space.place(name)]
        held &= (v >= low) & (v < high)
    return held


def _cells(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges between the levels of a condition, open at both ends, and the level of each reading."""
    points = set_points(values)
    between = thinned(edges(np.unique(points))[1:])
    at = np.concatenate([[-np.inf], between, [np.inf]])
    return at, np.searchsorted(between, points, side="right")


def _grown(
    cells: np.ndarray, counts: list[int], costs: np.ndarray, seed: np.ndarray, pull: np.ndarray, power: np.ndarray
) -> tuple[float, np.ndarray]:
    """Log likelihood gained by a box about a reading, less the log of the boxes like it, and its ranges of levels.

    Each range in turn is the best one with the others as they are.
    """
    box = np.column_stack([seed, seed])
    worth = -np.inf
    for _ in range(ROUNDS):
        before = worth
        for k, count in enumerate(counts):
            others = np.delete(np.arange(len(counts)), k)
            held = _inside(cells[others], box[others])
            sums, squares = (np.bincount(cells[k][held], weights=x[held], minlength=count) for x in (pull, power))
            low, high = np.triu_indices(count)
            sums, squares = (np.concatenate([[0.0], np.cumsum(x)]) for x in (sums, squares))
            pulled, size = sums[high + 1] - sums[low], squares[high + 1] - squares[low]
            gain = 0.5 * pulled**2 / np.maximum(size, 1e-300) - costs[k] * ((low > 0) | (high < count - 1))
            best = int(np.argmax(gain))
            box[k] = low[best], high[best]
            uncut = [(box[i, 0] == 0) & (box[i, 1] == counts[i] - 1) for i in others]
            worth = float(gain[best] - costs[others][~np.array(uncut, bool)].sum())
        if worth <= before + 1e-9:
            break
    return worth, box


def _inside(cells: np.ndarray, box: np.ndarray) -> np.ndarray:
    return np.asarray(((cells >= box[:, :1]) & (cells <= box[:, 1:])).all(axis=0))
