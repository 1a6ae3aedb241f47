"""Waves in time: which are tried as an unnamed mismatch."""

from __future__ import annotations

import numpy as np

from mixedlub.recording.conditions import NODES, Coordinates

CLOCK, TURNED = "time_s", "position_deg"
LEAST, MOST, STEP = 3.0, 200.0, 0.25
"""Periods over a recording that are tried: fewer are smooth."""
FINER = STEP * np.linspace(-1.0, 1.0, 11)
"""Steps between the periods that are tried."""
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
    stepped = stepped_levels(values, place)
    return np.array(
        [w for w in found if not any(goes_with(space.axes[place].wave(values[place], w), label) for label in stepped)]
    )


def stepped_levels(values: list[np.ndarray], place: int) -> list[np.ndarray]:
    """Level of each reading in the other conditions that have few of them."""
    found = [np.unique(v, return_inverse=True)[1] for i, v in enumerate(values) if i != place]
    return [label for label in found if label.max() < min(NODES, 0.5 * label.size)]


def goes_with(columns: np.ndarray, label: np.ndarray, share: float = CYCLES) -> bool:
    """Whether the level of a condition tells that share of any column's variance."""
    centred = columns - columns.mean(axis=0)
    count = np.bincount(label)
    means = np.column_stack([np.bincount(label, weights=c) / np.maximum(count, 1) for c in centred.T])
    told = (count[:, None] * means**2).sum(axis=0)
    return bool(np.any(told > share * np.maximum((centred**2).sum(axis=0), 1e-9 * label.size)))
