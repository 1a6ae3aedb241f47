"""Waves in time that are tried as a discrepancy."""

from __future__ import annotations

import numpy as np

from mixedlub.recording.conditions import NODES, Coordinates

CLOCK, TURNED = "time_s", "position_deg"
LEAST_PERIODS = 3.0
"""Periods over a recording from which a wave is tried; the smooth form follows fewer."""
MOST_PERIODS = 200.0
"""Periods over a recording up to which a wave is tried: a limit on cost."""
PERIOD_STEP = 0.25
"""Step in the number of periods: a quarter period keeps a wave in phase over the record."""
FINER = PERIOD_STEP * np.linspace(-1.0, 1.0, 11)
"""Refinement of the number of periods about the best wave."""
CONFOUNDED = 0.5
"""Share of the variance of a wave that the levels of a condition explain, from which it is left to them. Judgement."""


def frequencies(space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Numbers of periods over the recording, up to the Nyquist limit; none where there is no clock.

    None where a shaft turns, whose position is an effect, or where a condition is cycled at the same rate.
    """
    names = [axis.name for axis in space.axes]
    if CLOCK not in names or TURNED in names:
        return np.zeros(0)
    place = names.index(CLOCK)
    levels = np.unique(values[place])
    if levels.size < 2.0 * LEAST_PERIODS:
        return np.zeros(0)
    most = min(0.5 * np.ptp(levels) / np.median(np.diff(levels)), 0.75 * levels.size, MOST_PERIODS)
    found = np.arange(most, LEAST_PERIODS, -PERIOD_STEP)
    stepped = stepped_levels(values, place)
    return np.array(
        [
            w
            for w in found
            if not any(is_explained_by(space.axes[place].wave(values[place], w), label) for label in stepped)
        ]
    )


def stepped_levels(values: list[np.ndarray], place: int) -> list[np.ndarray]:
    """Level index of each reading in the other conditions with few levels."""
    found = [np.unique(v, return_inverse=True)[1] for i, v in enumerate(values) if i != place]
    return [label for label in found if label.max() < min(NODES, 0.5 * label.size)]


def is_explained_by(columns: np.ndarray, label: np.ndarray, share: float = CONFOUNDED) -> bool:
    """Whether the levels of a condition explain that share of any column's variance."""
    centred = columns - columns.mean(axis=0)
    count = np.bincount(label)
    means = np.column_stack([np.bincount(label, weights=c) / np.maximum(count, 1) for c in centred.T])
    explained = (count[:, None] * means**2).sum(axis=0)
    return bool(np.any(explained > share * np.maximum((centred**2).sum(axis=0), 1e-9 * label.size)))
