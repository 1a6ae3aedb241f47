"""Search for a correlated error: a slow drift of the instrument, fitted together with each leading explanation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discrepancy.waves import TURNED
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.inference.map_fit import linear_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.noise_inflation import NoiseInflation, scaled
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.inference import CLIPPED_AT, SIGNIFICANT
from mixedlub.diagnosis.settings.search import (
    CORRELATION_SHARES,
    DRIFT_CANDIDATES,
    DRIFT_GAIN,
    DRIFT_READINGS,
    ERROR_SIZES,
    INFLATION_ROUNDS,
    MOST_UNDER_NULL,
    WHITE_SHARES,
)
from mixedlub.recording.conditions import clock_of
from mixedlub.recording.correlated_error import CorrelatedError
from mixedlub.recording.noise import successive_difference_sd


def search_correlated_error(
    search: Search, inflation: NoiseInflation, largest: float, trial: Callable[..., Search]
) -> tuple[Search, NoiseInflation]:
    """Repeat the search with a correlated (Ornstein-Uhlenbeck) error, and return the inflation of the white noise left.

    ``inflation`` is the inflation of the stated noise so far, ``largest`` the largest that repeats allow. ``trial``
    searches for a case and a correlated error. If nothing may be missing, the error is no larger than the scatter
    between neighbours.
    """
    for _ in range(INFLATION_ROUNDS):
        correlated_error, times = estimate_correlated_error(search, 1.0 / inflation.factor)
        if (
            correlated_error == search.problem.correlated_error
            or times * inflation.factor * correlated_error.total_sd > largest
        ):
            break
        retried = trial(scaled(search.problem.case, times), correlated_error=correlated_error)
        missing = max(retried.log_weights.values()) > retried.log_weights[NOTHING] + DRIFT_GAIN
        if not missing and correlated_error.size * times > _largest_under_null(search):
            break
        search, inflation = retried, replace(inflation, factor=inflation.factor * times)
    return search, inflation


def estimate_correlated_error(search: Search, least: float) -> tuple[CorrelatedError, float]:
    """Most probable correlated error, and the factor on the remaining white noise.

    The best explanation with this error must beat the best without it. The white noise may shrink by the factor
    ``least``: part of it may have been the correlated error. No error is fitted for a turning shaft, because neighbours
    in time then share their position.
    """
    present, screened = search.problem.correlated_error, search.full_screen
    record, clock = clock_of(search.problem.rows, ties=True), clock_of(screened.problem.rows, ties=True)
    if record is None or clock is None or clock.size < DRIFT_READINGS or TURNED in search.problem.rows:
        return present, 1.0
    forms = [CorrelatedError.over(record, size, length) for length in CORRELATION_SHARES for size in ERROR_SIZES]
    weights, null_fit, discrepancy = screened.log_weights, screened.null_fit, screened.discrepancy
    best_log, best = max(weights.values()) + DRIFT_GAIN, (present, 1.0)
    named = sorted((m for m in screened.fits if m.effects), key=weights.__getitem__)[-DRIFT_CANDIDATES:]
    discrepancy_columns = discrepancy.best.columns(screened.space, screened.values, discrepancy.scalings)
    order = np.argsort(clock, kind="stable")
    largest = _largest_under_null(screened)
    noise = [form for form in forms if form.size <= largest]
    exact = screened.published_log_weights
    tried = [(exact[NOTHING], null_fit.residual, null_fit.anchor, null_fit.slopes, noise)]
    for key in named:
        fit = screened.fits[key]
        tried.append((exact[key], fit.residual, fit.anchor, fit.slopes, forms))
    flexible = np.hstack([discrepancy.base.slopes, discrepancy_columns])
    tried.append((exact[DISCREPANCY], discrepancy.fit.residual, discrepancy.base.anchor, flexible, forms))
    for weight, residual, target, slopes, allowed in tried:
        if not allowed or not is_autocorrelated(residual[order]):
            continue
        gain, correlated_error = _most_probable(screened.problem, allowed, least, target, slopes)
        if weight + gain > best_log:
            best_log, best = weight + gain, correlated_error
    return best


def correlated_error_variance(search: Search) -> float:
    """Variance of the correlated error over the white noise, from residuals of the most probable effects."""
    if not search.problem.correlated_error.size:
        return 0.0
    best_named = search.best_named
    drift_columns, shared = search.problem.correlated_error.columns(search.problem.rows), search.problem.shared
    errors = np.linalg.lstsq(shared, best_named.common, rcond=None)[0][-drift_columns.shape[1] :]
    residual = search.problem.single_reading_units(best_named.residual) + drift_columns @ errors
    return max(float(best_named.weight @ residual**2 / best_named.weight.sum()) - 1.0, 0.0)


def _largest_under_null(search: Search) -> float:
    """Largest correlated error if nothing is missing, over the noise of single readings."""
    screened = search.full_screen
    clock = clock_of(screened.problem.rows, ties=True)
    assert clock is not None
    return MOST_UNDER_NULL * successive_difference_sd(
        screened.problem.single_reading_units(screened.null_fit.residual)[np.argsort(clock, kind="stable")]
    )


def is_autocorrelated(residual: np.ndarray) -> bool:
    """Whether residuals in order of time have a significant lag-1 autocorrelation.

    >>> noise = np.random.default_rng(1).standard_normal(100)
    >>> is_autocorrelated(noise), is_autocorrelated(np.repeat(noise, 3))
    (False, True)
    """
    centred = np.clip(residual - np.median(residual), -CLIPPED_AT, CLIPPED_AT)
    square = float(centred @ centred)
    return bool(float(centred[1:] @ centred[:-1]) * np.sqrt(residual.size) > SIGNIFICANT * square)


def _most_probable(
    problem: Problem, forms: Sequence[CorrelatedError], least: float, target: np.ndarray, slopes: np.ndarray
) -> tuple[float, tuple[CorrelatedError, float]]:
    """Gain in log evidence by the best correlated error and white noise (fixed if several readings count as one)."""
    smaller_noise = (
        [*(q for q in WHITE_SHARES if q > least), *([least] if least < 1.0 else [])]
        if problem.n_per_effective == 1.0
        else []
    )
    columns = np.hstack([slopes, problem.setups])
    present = linear_fit(target, np.hstack([slopes, problem.shared])).evidence
    best_log, best = -np.inf, (problem.correlated_error, 1.0)
    for form in forms:
        drift_columns = form.columns(problem.rows) / np.sqrt(problem.n_per_effective)
        for times in (1.0, *smaller_noise):
            log = linear_fit(target / times, np.hstack([columns / times, drift_columns])).evidence
            log -= target.size * np.log(times)
            if log > best_log:
                best_log, best = log, (form, times)
    return best_log - present, best
