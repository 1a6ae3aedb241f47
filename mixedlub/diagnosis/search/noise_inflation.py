"""Search under the stated noise, inflated if residuals demand it, or under estimated noise."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.search import (
    BOUND_LEVEL,
    EXTRA_SHARES,
    FIRST_SHARE,
    INFLATION_FACTORS,
    INFLATION_GAIN,
    INFLATION_ROUNDS,
    LEAST_FREEDOM,
    MIXTURE_FACTORS,
    OVERSTATED_VARIANCE,
    SHARE_GAIN,
)
from mixedlub.recording.noise import MIXTURE_GAIN, PARTS, medians, pooled_sd, with_noise
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.table import Table


class Trial(Protocol):
    """Function that searches a case, or weighs a ``near`` search again under its noise."""

    def __call__(self, case: Case, near: Search | None = None) -> Search: ...


@dataclass(frozen=True)
class NoiseInflation:
    """Noise used instead of the stated one: ``extra_relative`` added in quadrature, then multiplied by ``factor``."""

    factor: float = 1.0
    extra_relative: float = 0.0

    def of(self, case: Case) -> Case:
        """Case with this noise."""
        if self.extra_relative:
            sd = rows_of(case)[f"{case.quantity}_sd"].astype(float)
            case = _with_sds(case, np.hypot(sd, self.extra_relative * np.abs(readings_of(case))))
        return scaled(case, self.factor)


def search_stated_noise(case: Case, trial: Trial, most: float) -> tuple[Search, NoiseInflation]:
    """Search under the stated noise, or under inflated noise if the readings clearly demand it.

    Every explanation, the discrepancy included, is weighed again with its residuals under more noise. Inflation is
    accepted if the best of them beats the best under the stated noise: residuals that vary smoothly with conditions are
    a discrepancy, the rest is noise. Repeats at equal conditions bound the factor by ``most``. Without repeats a column
    of standard deviations may be repeatability only, and a share of the reading is added.
    """
    accepted, inflation = trial(case), NoiseInflation()
    if f"{case.quantity}_sd" in rows_of(case) and np.isinf(most):
        accepted, inflation = _with_share(case, trial, accepted)
    for needed in (INFLATION_GAIN, *[0.0] * (INFLATION_ROUNDS - 1)):
        gain, factor = best_inflation(accepted)
        if gain <= needed or inflation.factor * factor > most:
            break
        inflation = replace(inflation, factor=inflation.factor * factor)
        accepted = trial(inflation.of(case))
    return accepted, inflation


def _with_share(case: Case, trial: Trial, search: Search) -> tuple[Search, NoiseInflation]:
    """Search with the extra relative noise that makes the readings most probable.

    Hill climbs start from a typical share, and from the share suggested by the residuals. Shares in between are weighed
    from the nearest finished search; the best share is then searched in full.
    """
    tried = {-1: search, FIRST_SHARE: trial(NoiseInflation(extra_relative=EXTRA_SHARES[FIRST_SHARE]).of(case))}

    def log_probability(i: int) -> float:
        if i not in tried:
            near = min((j for j in tried if j >= 0), key=lambda j: abs(j - i))
            tried[i] = trial(NoiseInflation(extra_relative=EXTRA_SHARES[i]).of(case), near=tried[near])
        return tried[i].log_probability

    gain, suggested = _lacking(search)
    for i in (FIRST_SHARE, suggested) if gain > SHARE_GAIN else (FIRST_SHARE,):
        neighbours = [j for j in (i - 1, i + 1) if 0 <= j < EXTRA_SHARES.size]
        step = max(neighbours, key=log_probability) - i
        while 0 <= i + step < EXTRA_SHARES.size and log_probability(i + step) > log_probability(i):
            i += step
    best = max(tried, key=log_probability)
    if best < 0 or log_probability(best) <= log_probability(-1) + SHARE_GAIN:
        return search, NoiseInflation()
    inflation = NoiseInflation(extra_relative=float(EXTRA_SHARES[best]))
    searched = tried[best] if best == FIRST_SHARE else trial(inflation.of(case))
    accepted = searched.log_probability > log_probability(-1) + SHARE_GAIN
    return (searched, inflation) if accepted else (search, NoiseInflation())


def _lacking(search: Search) -> tuple[float, int]:
    """Gain in log probability by extra relative noise, and the index of the best share."""
    sd = search.problem.single_sd * search.problem.d_inverse(search.problem.y)
    size = np.abs(search.problem.inverse(search.problem.y))
    return _under_other_noise(search, np.hypot(1.0, EXTRA_SHARES[:, None] * size / sd))


def repeats_allow(y: np.ndarray, sd: np.ndarray, group: np.ndarray) -> float:
    """Largest noise inflation that the scatter of repeated readings allows (0.1 % level).

    >>> jumping = 0.1 * np.tile([0.8, 1.0, 1.25, 1.0], 5)
    >>> y = 100.0 + 0.1 * np.random.default_rng(1).standard_normal(20)
    >>> repeats_allow(y, jumping, np.repeat(np.arange(5), 4)) < 2.0
    True
    """
    from scipy.special import chdtri

    freedom = group.size - int(group.max()) - 1
    deviation = (y - medians(y, group)[group]) / sd
    return float(pooled_sd(deviation, group) * np.sqrt(freedom / chdtri(freedom, 1.0 - BOUND_LEVEL)))


def best_inflation(search: Search) -> tuple[float, float]:
    """Gain in log probability of the best explanation by noise inflation, and the factor."""
    gain, best = _under_other_noise(search, INFLATION_FACTORS[:, None])
    return gain, float(INFLATION_FACTORS[best])


def _under_other_noise(search: Search, times: np.ndarray) -> tuple[float, int]:
    """Gain in log probability of the best explanation by noise ``times`` (m, readings) as large, and the best of m."""
    weights = search.log_weights
    best_log, best = -np.inf, 0
    for key, weight in weights.items():
        fit = search.fit_of(key)
        form_error_gain = search.scores.get(key, fit.evidence) - fit.evidence
        # The evidence of a fit far behind is carried over from another noise: it is no more than its likelihood.
        carried = max(fit.evidence - float(log_likelihood(fit.residual)[0].sum()), 0.0)
        gains = inflation_gains(fit.residual, times)
        if weight - form_error_gain - carried + gains.max() > best_log:
            best_log, best = weight - form_error_gain - carried + float(gains.max()), int(np.argmax(gains))
    return best_log - max(weights.values()), best


def search_estimated_noise(case: Case, trial: Trial) -> Search:
    """Search under estimated noise; residuals give its relative and absolute part better than a few repeats."""
    fitted = trial(case)
    gain, other = _other_parts(fitted)
    if gain < MIXTURE_GAIN:
        return fitted
    retried = trial(other)
    return retried if retried.log_probability > fitted.log_probability + MIXTURE_GAIN else fitted


def _other_parts(search: Search) -> tuple[float, Case]:
    """Gain in log probability by the best other mixture of relative and absolute noise, and the case with it."""
    problem = search.problem
    best = search.best_named
    size = problem.noise_size(best.prediction)
    typical = float(np.median(size))
    scales = MIXTURE_FACTORS * float(np.median(problem.sd * problem.d_inverse(best.prediction))) / typical
    noises = [(k * relative, k * absolute * typical) for k in scales for relative, absolute in PARTS]
    sds = np.array([np.hypot(relative * size, absolute) for relative, absolute in noises])
    sds /= problem.d_inverse(best.prediction)
    gain, which = _under_other_noise(search, np.maximum(sds, 1e-300) / problem.sd)
    return gain, with_noise(problem.case, *noises[which])


def inflation_gains(residual: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Gains (m,) of the log likelihood of residuals by noise ``times`` (m, readings) as large."""
    logs = np.broadcast_to(np.log(times), (len(times), residual.size))
    return np.asarray((log_likelihood(residual / times)[0] - logs).sum(axis=1) - log_likelihood(residual)[0].sum())


def noise_overstated(search: Search) -> bool:
    """Whether residuals of the base model, which has few coordinates, are below half of the stated noise."""
    freedom = search.null_fit.residual.size - search.null_fit.z.size
    residual = search.problem.single_reading_units(search.null_fit.residual)
    return freedom >= LEAST_FREEDOM and float(residual @ residual) < OVERSTATED_VARIANCE * freedom


def scaled(case: Case, factor: float) -> Case:
    """The case with ``factor`` times the noise of a single reading."""
    name, rows = f"{case.quantity}_sd", rows_of(case)
    if name in rows:
        return _with_sds(case, factor * rows[name])
    noise = case.system.recording.noise
    assert noise is not None
    return with_noise(case, factor * noise.relative, factor * noise.absolute)


def _with_sds(case: Case, sd: np.ndarray) -> Case:
    rows = rows_of(case)
    return replace(case, recordings=Table({**rows.columns, f"{case.quantity}_sd": sd}, rows.source))
