"""Noise that lasts over several readings: how many of them tell as much as one."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.search.search import Search
from mixedlub.recording.conditions import SERIES, clock_of

FEWEST = 16
"""Stretches of a series from which the variance of their sums can be told."""
SLOW = 2
"""Half swings over a recording that are a drift."""
WILD = 3.0
"""Sigmas to which a residual counts: wild readings do not last."""


def lasting(found: Search) -> float:
    """How many readings tell as much as one, by what the explanation that follows them best leaves over.

    What the most probable name or the unnamed still follows is no noise.
    """
    return min(_together(found, left) for left in (found.likely.residual, found.unknown.fit.residual))


def lasting_alone(found: Search) -> float:
    """The same by what the calibrated base model leaves over: as it would be if nothing were missing.

    That is of a series at held conditions, or of very many readings: elsewhere what follows one another was run
    alike. What drifts over the whole of it is no noise that lasts, and how large noise is has been said.
    """
    still = np.ptp(found.none.prediction) <= np.median(found.problem.sd)
    if not still and len(found.problem.rows) < SERIES:
        return found.problem.together
    return _together(found, _undrifted(found))


def _undrifted(found: Search) -> np.ndarray:
    """What the calibrated base model leaves over, less slow swings, no larger in the mean than noise."""
    left = np.clip(found.problem.of_one(found.none.residual), -WILD, WILD)
    clock = clock_of(found.problem.rows)
    order = np.arange(left.size) if clock is None else np.argsort(np.argsort(clock))
    swings = np.cos(np.pi * np.outer(order, np.arange(SLOW + 1)) / left.size)
    left = left - swings @ np.linalg.lstsq(swings, left, rcond=None)[0]
    return left / max(float(np.sqrt(np.mean(left**2))), 1.0) / np.sqrt(found.problem.together)


def _together(found: Search, left: np.ndarray) -> float:
    """How many readings tell as much as one under a search, by residuals in its sigmas."""
    rows = found.problem.rows
    order = clock_of(rows)
    if order is None:
        if len(rows) < SERIES:
            return found.problem.together
        # A series without a clock was logged in the order of its rows.
        order = np.arange(len(rows))
    return max(together(found.problem.of_one(left), order), found.problem.together)


def together(left: np.ndarray, clock: np.ndarray) -> float:
    r"""How many times their variance sums of neighbours in time vary; 1 or more.

    ``left`` are residuals in sigmas. Independent ones make :math:`\sum_n z / \sqrt n` vary as one does, for stretches
    of any n; noise that lasts makes it vary more, and what goes slowly over the series is known as if there were so
    many times fewer readings. An excess within two standard errors is chance.
    Batch means: G. S. Fishman, Principles of Discrete Event Simulation (1978).

    >>> noise = np.random.default_rng(1).standard_normal(512)
    >>> together(noise, np.arange(512.0)), round(together(np.repeat(noise, 8), np.arange(4096.0)))
    (1.0, 7)
    """
    ordered = np.clip(left, -WILD, WILD)[np.argsort(clock, kind="stable")]
    most, length = 1.0, 2
    while (count := ordered.size // length) >= FEWEST:
        sums = ordered[: count * length].reshape(count, length).sum(axis=1)
        times = float(np.mean(sums**2)) / length
        if times > 1.0 + 2.0 * np.sqrt(2.0 / count):
            most = max(most, times)
        length *= 2
    return most
