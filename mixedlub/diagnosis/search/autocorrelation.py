"""Autocorrelated residuals: number of readings per effective reading."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.inference import CLIPPED_AT, SIGNIFICANT
from mixedlub.diagnosis.settings.search import DRIFT_HALF_WAVES, LEAST_BATCHES
from mixedlub.recording.conditions import SERIES, clock_of


def variance_inflation(search: Search) -> float:
    """Readings per effective reading, from the residuals of the best explanation.

    It is the smaller value of the most probable effects and the discrepancy: residuals that either explains are not
    noise.
    """
    return min(_inflation_of(search, left) for left in (search.best_named.residual, search.discrepancy.fit.residual))


def variance_inflation_under_null(search: Search) -> float:
    """Readings per effective reading under the null hypothesis, from residuals of the calibrated base model.

    Only for a series at constant conditions or of very many readings: elsewhere neighbours share their conditions. Slow
    drift is removed, and the size of the noise is taken as known.
    """
    still = np.ptp(search.null_fit.prediction) <= np.median(search.problem.sd)
    if not still and len(search.problem.rows) < SERIES:
        return search.problem.n_per_effective
    return _inflation_of(search, _undrifted(search))


def _undrifted(search: Search) -> np.ndarray:
    """Residuals of the calibrated base model without slow drift, scaled down to the size of the noise."""
    residual = np.clip(search.problem.single_reading_units(search.null_fit.residual), -CLIPPED_AT, CLIPPED_AT)
    clock = clock_of(search.problem.rows)
    order = np.arange(residual.size) if clock is None else np.argsort(np.argsort(clock))
    swings = np.cos(np.pi * np.outer(order, np.arange(DRIFT_HALF_WAVES + 1)) / residual.size)
    residual = residual - swings @ np.linalg.lstsq(swings, residual, rcond=None)[0]
    return residual / max(float(np.sqrt(np.mean(residual**2))), 1.0) / np.sqrt(search.problem.n_per_effective)


def _inflation_of(search: Search, residual: np.ndarray) -> float:
    """Readings per effective reading of a search, from standardised residuals."""
    rows = search.problem.rows
    order = clock_of(rows)
    if order is None:
        if len(rows) < SERIES:
            return search.problem.n_per_effective
        # A series without a clock was logged in the order of its rows.
        order = np.arange(len(rows))
    return max(
        batch_means_inflation(search.problem.single_reading_units(residual), order), search.problem.n_per_effective
    )


def batch_means_inflation(residual: np.ndarray, clock: np.ndarray) -> float:
    r"""Variance inflation of sums over consecutive residuals, by the method of batch means; at least 1.

    ``residual`` is standardised. For independent residuals :math:`\sum_n z / \sqrt n` has variance one for batches of
    any length n. For autocorrelated residuals it is larger, and a slow trend is as uncertain as with so many times
    fewer readings. Single residuals that vary more than noise are a lack of fit, so their variance is the unit then.
    An excess within two standard errors is chance. Batch means: G. S. Fishman, Principles of Discrete Event Simulation
    (1978).

    >>> noise = np.random.default_rng(1).standard_normal(512)
    >>> batch_means_inflation(noise, np.arange(512.0))
    1.0
    >>> round(batch_means_inflation(np.repeat(noise, 8), np.arange(4096.0)))
    7
    >>> batch_means_inflation(1.4 * noise, np.arange(512.0))
    1.0
    """
    ordered = np.clip(residual, -CLIPPED_AT, CLIPPED_AT)[np.argsort(clock, kind="stable")]
    single = max(float(np.mean(ordered**2)), 1.0)
    largest, length = 1.0, 2
    while (count := ordered.size // length) >= LEAST_BATCHES:
        sums = ordered[: count * length].reshape(count, length).sum(axis=1)
        inflation = float(np.mean(sums**2)) / length / single
        if inflation > 1.0 + SIGNIFICANT * np.sqrt(2.0 / count):
            largest = max(largest, inflation)
        length *= 2
    return largest
