"""History of a condition as a factor of a discrepancy: last change, size of it, decay since it, or fading memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.discrepancy.local import DERIVED
from mixedlub.diagnosis.settings.discrepancy import (
    DEPENDENT,
    EXPLAINED_BY_PRESENT,
    FADING_TIMES,
    LEAST_PAST,
    SAME_PAST,
    SHORTEST_FADING,
    SLOWEST_FADING,
    SMOOTH_LENGTHS,
)
from mixedlub.kinds.history import Order, programme_of
from mixedlub.recording.conditions import NODES, PASSING, Coordinates
from mixedlub.recording.set_points import set_points
from mixedlub.schema.past import BEFORE, DIRECTION, MEMORY, SINCE, Past


@dataclass(frozen=True)
class Remembered:
    """A history coordinate as a number of order one.

    ``decay``: time constant of a decay since the last change. ``instead``: a memory in place of the present condition,
    else the difference of both.
    """

    past: Past
    decay: float = 0.0
    instead: bool = False

    @property
    def key(self) -> str:
        """Its name among scalings."""
        return f"{self.past.name} {self.decay:g} {self.instead}"

    def factor(self, space: Coordinates, forward: Forward) -> np.ndarray:
        """Its values in the rows of a model; differences are shares of the range of the condition."""
        found = forward.histories([self.past])[self.past.name]
        if self.past.what == DIRECTION:
            return found
        if self.past.what == SINCE:
            return np.exp(-found / self.decay)
        axis = space.axes[space.place(self.past.column)]
        present = np.asarray(forward.table[self.past.column], float)
        return axis.scale(found) - (0.5 if self.instead else axis.scale(present))


def fading_times(order: Order) -> tuple[float, ...]:
    """Round time constants from a few readings to a part of the recording, in the unit of its order.

    >>> fading_times(Order("time_s", np.arange(0.0, 1200.0, 10.0), np.zeros(120, int)))
    (20.0, 41.0, 84.0, 170.0, 360.0)
    """
    rows = np.lexsort((order.clock, order.part))
    steps = np.diff(order.clock[rows])[np.diff(order.part[rows]) == 0]
    low = SHORTEST_FADING * float(np.median(steps[steps > 0.0]))
    high = max(SLOWEST_FADING * order.span, low)
    return tuple(dict.fromkeys(float(f"{t:.2g}") for t in np.geomspace(low, high, FADING_TIMES)))


def remembered_in(space: Coordinates, values: list[np.ndarray], forward: Forward) -> dict[Remembered, np.ndarray]:
    """History coordinates that a recording can show, with their values.

    Left out are histories of conditions in random order, and functions of present conditions.
    """
    case = forward.case
    recorded = forward.table if case.recordings is None else case.recordings
    found: dict[Remembered, np.ndarray] = {}
    present: _Present | None = None
    for axis in space.axes:
        if axis.named or axis.name in (*PASSING, DERIVED) or axis.name not in recorded:
            continue
        programme = programme_of(recorded, axis.name, case.kind.is_history)
        if programme is None or not programme.planned:
            continue
        present = _Present.of(space, values) if present is None else present
        unit, times = programme.order.unit, fading_times(programme.order)
        tried = [
            Remembered(Past(axis.name, DIRECTION)),
            Remembered(Past(axis.name, BEFORE)),
            *(Remembered(Past(axis.name, SINCE, unit), time) for time in times),
            *(Remembered(Past(axis.name, MEMORY, unit, time)) for time in times),
            *(Remembered(Past(axis.name, MEMORY, unit, time), instead=True) for time in times),
        ]
        forward.histories(one.past for one in tried)
        for one in tried:
            factor = one.factor(space, forward)
            if np.std(factor) > LEAST_PAST and not present.explains(factor):
                found[one] = factor
    return _distinct(found)


def _distinct(found: dict[Remembered, np.ndarray]) -> dict[Remembered, np.ndarray]:
    """Coordinates that differ from all earlier ones in more than size."""
    kept: dict[Remembered, np.ndarray] = {}
    for one, factor in found.items():
        if all(abs(np.corrcoef(factor, other)[0, 1]) < SAME_PAST for other in kept.values()):
            kept[one] = factor
    return kept


@dataclass(frozen=True, eq=False)
class _Present:
    """Directions of sums of functions of each present condition, and the combination of levels of each reading."""

    directions: np.ndarray
    cell: np.ndarray

    @classmethod
    def of(cls, space: Coordinates, values: list[np.ndarray]) -> _Present:
        """The present conditions of a recording, without its clock; wide sweeps have as many levels as NODES."""
        count = values[0].size
        blocks, cell = [np.ones((count, 1))], np.zeros(count, int)
        for axis, own in zip(space.axes, values, strict=True):
            if axis.name in (*PASSING, DERIVED):
                continue
            levels, label = np.unique(set_points(own), return_inverse=True)
            if levels.size <= NODES or axis.named:
                blocks.append((label[:, None] == np.arange(levels.size - 1)).astype(float))
            else:
                blocks.append(axis.functions(own, SMOOTH_LENGTHS[0]))
                label = np.minimum((NODES * axis.scale(own)).astype(int), NODES - 1)
            cell = np.unique(cell * (int(label.max()) + 1) + label, return_inverse=True)[1]
        vectors, size, _ = np.linalg.svd(np.hstack(blocks), full_matrices=False)
        return cls(vectors[:, size > DEPENDENT * size.max(initial=0.0)], cell)

    def explains(self, factor: np.ndarray) -> bool:
        """Whether present conditions explain most of the variance of a history coordinate.

        A matrix in which conditions hardly ever come back cannot tell.
        """
        times = np.bincount(self.cell)
        again = times[self.cell] > 1
        if 2 * int(again.sum()) < factor.size:
            return True
        mean = np.bincount(self.cell, weights=factor) / np.maximum(times, 1)
        if _explained(factor[again], (factor - mean[self.cell])[again], int((times > 1).sum())):
            return True
        left = factor - self.directions @ (self.directions.T @ factor)
        return _explained(factor, left, self.directions.shape[1])


def _explained(factor: np.ndarray, left: np.ndarray, rank: int) -> bool:
    """Whether a fit with this rank leaves little of the variance."""
    free = factor.size - rank
    spread = float(np.var(factor)) * factor.size / max(factor.size - 1, 1)
    return free < 1 or float(left @ left) / free <= (1.0 - EXPLAINED_BY_PRESENT) * spread
