"""Lowest temperature of a balance, bracketed from below for many conditions at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

STEP = 10.0
"""Grid. First step (K) upwards in search of a bracket; each further one is twice as long."""
NARROW = 1e-11
"""Grid. Width (K) of a bracket that is not narrowed any more."""
STEPS = 60
"""Cost limit. Most evaluations of a balance in its bracket; a dozen are usual."""
Excess = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Heat out less heat in, and heat in, of conditions by number at a temperature each."""


def lowest_root(excess: Excess, start: np.ndarray, end: np.ndarray, closed: float) -> tuple[np.ndarray, np.ndarray]:
    """Lowest temperatures from start to end with as much heat out as in, and whether one exists.

    Steps upwards find a bracket, so that no condition is evaluated far above its balance; false position (the
    Illinois form) narrows it until the excess over the heat in is ``closed``. Without a balance: ``end``.
    """
    every = np.arange(start.size)
    low, high, step = start.copy(), start.copy(), np.full(start.shape, STEP)
    below, heat = excess(every, start)
    above, found = below.copy(), below >= -closed * heat
    live = every[~found & (end > start)]
    while live.size:
        high[live] = np.minimum(low[live] + step[live], end[live])
        step[live] *= 2.0
        above[live], heat[live] = excess(live, high[live])
        found[live] = above[live] >= -closed * heat[live]
        live = live[~found[live]]
        low[live], below[live] = high[live], above[live]
        live = live[high[live] < end[live]]
    root = np.where(found, high, end)
    live, side = every[found & (above > closed * heat) & (below < 0.0)], np.zeros(start.shape)
    for _ in range(STEPS):
        if not live.size:
            break
        a, b, fa, fb = low[live], high[live], below[live], above[live]
        middle = (a * fb - b * fa) / (fb - fa)
        own, heat_in = excess(live, middle)
        root[live] = middle
        left = own < 0.0
        # Illinois: the end that stays twice counts half, so that both ends move.
        below[live] = np.where(left, own, np.where(side[live] < 0.0, 0.5 * fa, fa))
        above[live] = np.where(left, np.where(side[live] > 0.0, 0.5 * fb, fb), own)
        low[live], high[live] = np.where(left, middle, a), np.where(left, b, middle)
        side[live] = np.where(left, 1.0, -1.0)
        live = live[(np.abs(own) > closed * heat_in) & (high[live] - low[live] > NARROW)]
    return root, found
