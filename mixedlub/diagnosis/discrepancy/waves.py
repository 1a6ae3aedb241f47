"""Waves in time as forms of a discrepancy."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.settings.discrepancy import (
    LEAST_PERIODS,
    MOST_PERIODS,
    PERIOD_STEP,
    PERIODS_PER_LEVEL,
    STEPPED_SHARE,
    WAVE_CONFOUNDED,
)
from mixedlub.recording.conditions import NODES, Coordinates

CLOCK, TURNED = "time_s", "position_deg"


def frequencies(space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Numbers of periods over the recording, up to the Nyquist limit; empty without a clock.

    Excluded are recordings of a turning shaft, because its position is an effect, and rates at which a condition is
    cycled.
    """
    names = [axis.name for axis in space.axes]
    if CLOCK not in names or TURNED in names:
        return np.zeros(0)
    index = names.index(CLOCK)
    levels = np.unique(values[index])
    if levels.size < 2.0 * LEAST_PERIODS:
        return np.zeros(0)
    highest = min(0.5 * np.ptp(levels) / np.median(np.diff(levels)), PERIODS_PER_LEVEL * levels.size, MOST_PERIODS)
    tried = np.arange(highest, LEAST_PERIODS, -PERIOD_STEP)
    stepped = stepped_levels(values, index)
    return np.array(
        [
            w
            for w in tried
            if not any(is_explained_by(space.axes[index].wave(values[index], w), label) for label in stepped)
        ]
    )


def stepped_levels(values: list[np.ndarray], index: int) -> list[np.ndarray]:
    """Level index of each reading in the other conditions with few levels."""
    labels = [np.unique(v, return_inverse=True)[1] for i, v in enumerate(values) if i != index]
    return [label for label in labels if label.max() < min(NODES, STEPPED_SHARE * label.size)]


def is_explained_by(columns: np.ndarray, label: np.ndarray, share: float = WAVE_CONFOUNDED) -> bool:
    """Whether the levels of a condition explain more than a ``share`` of any column's variance."""
    centred = columns - columns.mean(axis=0)
    count = np.bincount(label)
    means = np.column_stack([np.bincount(label, weights=c) / np.maximum(count, 1) for c in centred.T])
    explained = (count[:, None] * means**2).sum(axis=0)
    return bool(np.any(explained > share * np.maximum((centred**2).sum(axis=0), 1e-9 * label.size)))
