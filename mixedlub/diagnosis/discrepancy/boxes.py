"""Discrepancy within a box: a shift within ranges of two or more conditions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.diagnosis.discrepancy.local import DERIVED, edges, is_identifiable, thinned
from mixedlub.diagnosis.settings.discrepancy import BOX_SEEDS, BOX_SWEEPS
from mixedlub.recording.conditions import PASSING, Coordinates
from mixedlub.recording.set_points import set_points

Box = tuple[tuple[str, float, float], ...]


def clearest_box(
    space: Coordinates, values: list[np.ndarray], residual: np.ndarray, scale: np.ndarray
) -> tuple[Box, float] | None:
    """The box with the largest log likelihood gain, and the log of the number of equivalent boxes.

    ``residual`` is standardised, ``scale`` multiplies the discrepancy. Excluded are boxes of one condition, which are
    steps or peaks, and boxes of so few readings that they may be outliers.
    """
    grid = _Grid.of(space, values)
    if len(grid.names) < 2:
        return None
    grown = (
        grid.grown(seed, residual * scale, scale**2)
        for seed in np.argsort(np.abs(residual * scale))[::-1][:BOX_SEEDS].tolist()
    )
    usable = [
        (worth, box)
        for worth, box in grown
        if grid.cut(box).sum() > 1 and is_identifiable(grid.holds(box).astype(float), True)
    ]
    if not usable:
        return None
    _, best = max(usable, key=lambda item: item[0])
    return grid.named(best), grid.cost(best)


def inside(box: Box, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Rows within a box."""
    within = np.ones(values[0].size, bool)
    for name, low, high in box:
        v = values[space.place(name)]
        within &= (v >= low) & (v < high)
    return within


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
        """The grid of all numeric conditions that were set, open at all ends."""
        axes = []
        for axis, v in zip(space.axes, values, strict=True):
            if axis.named or axis.name in (*PASSING, DERIVED):
                continue
            points = set_points(v)
            between = thinned(edges(np.unique(points))[1:])
            if between.size:
                limits = np.concatenate([[-np.inf], between, [np.inf]])
                axes.append((axis.name, limits, np.searchsorted(between, points, side="right")))
        return cls(
            tuple(name for name, _, _ in axes),
            tuple(at for _, at, _ in axes),
            np.array([cell for _, _, cell in axes]),
        )

    @cached_property
    def counts(self) -> np.ndarray:
        """Cells along each condition."""
        return np.array([at.size - 1 for at in self.edges])

    @cached_property
    def ranges(self) -> np.ndarray:
        """Log of the number of ranges of each condition."""
        return np.log(self.counts * (self.counts + 1) / 2.0)

    def cut(self, box: np.ndarray) -> np.ndarray:
        """Conditions along which a box does not span the whole range."""
        return np.asarray((box[:, 0] > 0) | (box[:, 1] < self.counts - 1))

    def cost(self, box: np.ndarray) -> float:
        """Log of the number of boxes with ranges of the same conditions."""
        return float(self.ranges[self.cut(box)].sum())

    def holds(self, box: np.ndarray) -> np.ndarray:
        """Readings within a box."""
        return np.asarray(((self.cells >= box[:, :1]) & (self.cells <= box[:, 1:])).all(axis=0))

    def named(self, box: np.ndarray) -> Box:
        """The ranges of a box by the names of the conditions that it cuts."""
        ranges = zip(self.names, self.edges, box.tolist(), self.cut(box), strict=True)
        return tuple((name, float(at[low]), float(at[high + 1])) for name, at, (low, high), is_cut in ranges if is_cut)

    def grown(self, seed: int, pull: np.ndarray, power: np.ndarray) -> tuple[float, np.ndarray]:
        """Penalised log likelihood gain of the box grown from a reading, and the box.

        Each range in turn is optimised with the others fixed; the penalty is the log of the number of such boxes.
        """
        box = np.column_stack([self.cells[:, seed]] * 2)
        worth = -np.inf
        for _ in range(BOX_SWEEPS):
            before = worth
            for k, count in enumerate(self.counts):
                box[k] = 0, count - 1
                within = self.holds(box)
                sums, squares = (
                    np.concatenate(
                        [[0.0], np.cumsum(np.bincount(self.cells[k][within], weights=x[within], minlength=count))]
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
