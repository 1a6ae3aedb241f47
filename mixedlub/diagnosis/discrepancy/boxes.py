"""Forms tied to a box of conditions: what is there only where two or more of them are in a range each."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.diagnosis.discrepancy.local import DERIVED, edges, made_of, thinned
from mixedlub.recording.conditions import PASSING, Coordinates
from mixedlub.recording.set_points import set_points

SEEDS = 12
"""Readings, those farthest off, from whose own conditions a box is grown."""
ROUNDS = 6
"""Times the ranges of a box are gone through at most."""

Box = tuple[tuple[str, float, float], ...]


def clearest_box(
    space: Coordinates, values: list[np.ndarray], left: np.ndarray, scale: np.ndarray
) -> tuple[Box, float] | None:
    """The box whose readings are most together on one side, and the log of how many there are like it.

    ``left`` are residuals in sigmas, ``scale`` is what a mismatch there goes by. A box of one condition is a step or
    a peak, and none is of so few readings that they may be outliers.
    """
    grid = _Grid.of(space, values)
    if len(grid.names) < 2:
        return None
    grown = (
        grid.grown(seed, left * scale, scale**2) for seed in np.argsort(np.abs(left * scale))[::-1][:SEEDS].tolist()
    )
    usable = [
        (worth, box) for worth, box in grown if grid.cut(box).sum() > 1 and made_of(grid.holds(box).astype(float), True)
    ]
    if not usable:
        return None
    _, best = max(usable, key=lambda found: found[0])
    return grid.named(best), grid.cost(best)


def inside(box: Box, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Which rows a box holds."""
    held = np.ones(values[0].size, bool)
    for name, low, high in box:
        v = values[space.place(name)]
        held &= (v >= low) & (v < high)
    return held


@dataclass(frozen=True, eq=False)
class _Grid:
    """Conditions, the edges between their levels, and the cell of each reading, shape (conditions, readings).

    A box is the first and last cell along each condition, shape (conditions, 2).
    """

    names: tuple[str, ...]
    edges: tuple[np.ndarray, ...]
    cells: np.ndarray

    @classmethod
    def of(cls, space: Coordinates, values: list[np.ndarray]) -> _Grid:
        """The grid of what was set and has a measure; open at all ends."""
        found = []
        for axis, v in zip(space.axes, values, strict=True):
            if axis.named or axis.name in (*PASSING, DERIVED):
                continue
            points = set_points(v)
            between = thinned(edges(np.unique(points))[1:])
            if between.size:
                every = np.concatenate([[-np.inf], between, [np.inf]])
                found.append((axis.name, every, np.searchsorted(between, points, side="right")))
        return cls(
            tuple(name for name, _, _ in found),
            tuple(at for _, at, _ in found),
            np.array([cell for _, _, cell in found]),
        )

    @cached_property
    def counts(self) -> np.ndarray:
        """Cells along each condition."""
        return np.array([at.size - 1 for at in self.edges])

    @cached_property
    def ranges(self) -> np.ndarray:
        """Log of how many ranges each condition has."""
        return np.log(self.counts * (self.counts + 1) / 2.0)

    def cut(self, box: np.ndarray) -> np.ndarray:
        """Along which conditions a box does not reach from end to end."""
        return np.asarray((box[:, 0] > 0) | (box[:, 1] < self.counts - 1))

    def cost(self, box: np.ndarray) -> float:
        """Log of how many boxes there are with ranges of the same conditions."""
        return float(self.ranges[self.cut(box)].sum())

    def holds(self, box: np.ndarray) -> np.ndarray:
        """Which readings a box holds."""
        return np.asarray(((self.cells >= box[:, :1]) & (self.cells <= box[:, 1:])).all(axis=0))

    def named(self, box: np.ndarray) -> Box:
        """The ranges of a box by the names of the conditions that it cuts."""
        ranges = zip(self.names, self.edges, box.tolist(), self.cut(box), strict=True)
        return tuple((name, float(at[low]), float(at[high + 1])) for name, at, (low, high), own in ranges if own)

    def grown(self, seed: int, pull: np.ndarray, power: np.ndarray) -> tuple[float, np.ndarray]:
        """Log likelihood gained by the box about a reading, less the log of the boxes like it, and the box.

        Each range in turn is made the best one with the others as they are.
        """
        box = np.column_stack([self.cells[:, seed]] * 2)
        worth = -np.inf
        for _ in range(ROUNDS):
            before = worth
            for k, count in enumerate(self.counts):
                box[k] = 0, count - 1
                held = self.holds(box)
                sums, squares = (
                    np.concatenate(
                        [[0.0], np.cumsum(np.bincount(self.cells[k][held], weights=x[held], minlength=count))]
                    )
                    for x in (pull, power)
                )
                low, high = np.triu_indices(count)
                gain = 0.5 * (sums[high + 1] - sums[low]) ** 2 / np.maximum(squares[high + 1] - squares[low], 1e-300)
                gain -= self.ranges[k] * ((low > 0) | (high < count - 1))
                gain -= self.cost(box)
                best = int(np.argmax(gain))
                box[k], worth = (low[best], high[best]), float(gain[best])
            if worth <= before + 1e-9:
                break
        return worth, box
