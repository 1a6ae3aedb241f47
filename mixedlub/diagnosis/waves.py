"""Waves in time: which are tried as an unnamed mismatch, and which ones a recording has."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mixedlub.diagnosis.features import NODES, Coordinates
from mixedlub.diagnosis.fit import Linear, linear_fit

CLOCK, TURNED = "time_s", "position_deg"
LEAST, MOST, STEP = 3.0, 200.0, 0.25
"""Periods over a recording that are tried: fewer are smooth."""
PEAKS = 3
FINER = np.linspace(-1.0, 1.0, 11)
CLIPPED = 3.0
"""Sizes of the usual residual beyond which a reading counts for no more in the first look."""
CYCLES = 0.5
"""Share of a wave that goes with a condition from which it is that condition's cycle."""


def frequencies(space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Periods over the recording, from slow ones to one over two readings; none where there is no clock.

    Where a shaft turns they would be waves of its position, which have a name; where a condition is cycled, its own.
    """
    names = [axis.name for axis in space.axes]
    if CLOCK not in names or TURNED in names:
        return np.zeros(0)
    place = names.index(CLOCK)
    levels = np.unique(values[place])
    if levels.size < 2.0 * LEAST:
        return np.zeros(0)
    most = min(0.5 * np.ptp(levels) / np.median(np.diff(levels)), 0.75 * levels.size, MOST)
    found = np.arange(most, LEAST, -STEP)
    cycled = [np.unique(v, return_inverse=True)[1] for i, v in enumerate(values) if i != place]
    cycled = [label for label in cycled if label.max() < min(NODES, 0.5 * label.size)]
    return np.array(
        [w for w in found if not any(_goes_with(space.axes[place].wave(values[place], w), label) for label in cycled)]
    )


def _goes_with(columns: np.ndarray, label: np.ndarray) -> bool:
    """Whether either column is told by the level of a condition."""
    centred = columns - columns.mean(axis=0)
    count = np.bincount(label)
    means = np.column_stack([np.bincount(label, weights=c) / np.maximum(count, 1) for c in centred.T])
    told = (count[:, None] * means**2).sum(axis=0)
    return bool(np.any(told > CYCLES * np.maximum((centred**2).sum(axis=0), 1e-9 * label.size)))


def strongest(
    target: np.ndarray, fixed: np.ndarray, columns_of: Callable[[float], np.ndarray], grid: np.ndarray
) -> tuple[float, Linear] | None:
    """The wave that readings show most, between the grid's, and the fit with it; None where none is tried.

    A smooth form takes the crests of a wave for outliers, so the first look counts all readings, none beyond a bound.
    """
    if not grid.size:
        return None
    left = linear_fit(target, fixed).residual
    bound = CLIPPED * max(1.4826 * float(np.median(np.abs(left))), 1.0)
    clipped = np.clip(left, -bound, bound)
    base, _ = np.linalg.qr(fixed) if fixed.size else (fixed, None)
    power = np.empty(grid.size)
    for i, w in enumerate(grid):
        own = columns_of(w)
        turn, _ = np.linalg.qr(own - base @ (base.T @ own))
        power[i] = np.sum((turn.T @ clipped) ** 2)
    peaks = np.argsort(power)[::-1][:PEAKS]
    tried = ((w, linear_fit(target, np.hstack([fixed, columns_of(w)]))) for k in peaks for w in grid[k] + STEP * FINER)
    return max(tried, key=lambda found: found[1].evidence)
