"""Parts of a grid of conditions, and their inputs."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

PIECE_POINTS = 80_000
"""Contact points computed at once: their arrays fit the cache."""
PIECE_PAIRINGS = 64

Block = tuple[slice, slice, slice, slice]
Inputs = Mapping[str, Any]


def split(shape: tuple[int, ...], reach: tuple[int, ...]) -> list[Block]:
    """Ranges that cover a grid, each at most ``reach`` long.

    >>> [tuple((s.start, s.stop) for s in b) for b in split((3, 1, 1, 1), (2, 1, 1, 1))]
    [((0, 2), (0, 1), (0, 1), (0, 1)), ((2, 3), (0, 1), (0, 1), (0, 1))]
    """
    along = ([slice(i, min(i + step, n)) for i in range(0, n, step)] for n, step in zip(shape, reach, strict=True))
    return [(p, o, t, s) for p, o, t, s in itertools.product(*along)]


def reach(shape: tuple[int, ...], points: int, most_points: int, most_pairings: int) -> tuple[int, ...]:
    """Length of a block along each axis: pairings are filled first, then speed, torque, oil temperature.

    >>> reach((21, 1, 3, 6), 48, 80_000, 64), reach((1000, 1, 10, 10), 100, 80_000, 64)
    ((21, 1, 3, 6), (64, 1, 1, 10))
    """
    pairings = min(shape[0], most_pairings, max(1, most_points // points))
    room = max(1, most_points // (points * pairings))
    found = [pairings, 1, 1, 1]
    for axis in (3, 2, 1):
        found[axis] = min(shape[axis], room)
        room //= shape[axis]
        if room < 1:
            break
    return tuple(found)


def taken(inputs: Inputs, ranges: Sequence[slice]) -> dict[str, Any]:
    """Inputs sliced along the leading axes; axes of length one are kept."""

    def part(value: Any) -> Any:
        if np.ndim(value) != 5:
            return value
        return value[tuple(r if n > 1 else slice(None) for r, n in zip(ranges, value.shape))]

    return {name: part(value) for name, value in inputs.items()}
