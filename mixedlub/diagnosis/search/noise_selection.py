"""Selection of the noise model: stated, inflated or estimated, with correlation if residuals show it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.autocorrelation import variance_inflation, variance_inflation_under_null
from mixedlub.diagnosis.search.drift import search_correlated_error
from mixedlub.diagnosis.search.noise_inflation import (
    NoiseInflation,
    repeats_allow,
    search_estimated_noise,
    search_stated_noise,
)
from mixedlub.diagnosis.search.search import Progress, Search, continued, search, spread_rows
from mixedlub.diagnosis.search.setup_error import search_setup_error
from mixedlub.diagnosis.settings.search import MANY, SUBSET
from mixedlub.recording.conditions import SERIES, coordinates
from mixedlub.recording.correlated_error import UNCORRELATED, CorrelatedError
from mixedlub.recording.noise import estimated, is_stated, repeated
from mixedlub.recording.readings import rows_of


@dataclass(frozen=True, eq=False)
class NoiseSearch:
    """Search under the selected noise, its inflation, and a function that repeats the search under another noise.

    ``repeat`` takes the case, the number of readings per effective reading, and the correlated error.
    """

    search: Search
    inflation: NoiseInflation
    stated: bool
    repeat: Callable[[Case, float, CorrelatedError], Search]

    @property
    def noise_factor(self) -> float:
        """Total noise of a reading over the stated noise, including the correlated error."""
        return self.inflation.factor * self.search.problem.correlated_error.total_sd

    def null_search(self) -> Search:
        """Search with the autocorrelation of the residuals under the null hypothesis."""
        problem = self.search.problem
        n_under_null = variance_inflation_under_null(self.search)
        if n_under_null <= problem.n_per_effective:
            return self.search
        return self.repeat(problem.case, n_under_null, problem.correlated_error)


def search_under_noise(case: Case, forward: Forward, exclude: Sequence[str], progress: Progress) -> NoiseSearch:
    """Search all explanations under the stated noise, inflated where residuals demand it, or under estimated noise.

    Autocorrelated readings count as fewer; a slow drift is a correlated error that readings share. Autocorrelation is
    estimated before the drift in a logged series only, which is long enough. Each change of the noise continues the
    search.
    """
    space = coordinates(forward)
    values = space.values(forward)

    latest: Search | None = None

    def searched(problem: Problem, values: list[np.ndarray]) -> Search:
        nonlocal latest
        latest = search(problem, space, values, exclude, progress, latest)
        return latest

    def trial(case: Case, n_per_effective: float = 1.0, correlated_error: CorrelatedError = UNCORRELATED) -> Search:
        return searched(Problem.of(case, forward, n_per_effective, correlated_error), values)

    count = len(rows_of(case))
    few = spread_rows(values, count, SUBSET) if count > MANY else None

    def seek(case: Case, near: Search | None = None) -> Search:
        problem = Problem.of(case, forward)
        problem = problem if few is None else problem.take(few)
        if near is not None:
            return continued(near, problem, adding=False)
        return searched(problem, values if few is None else [v[few] for v in values])

    stated, inflation, most = is_stated(case), NoiseInflation(), np.inf
    if stated:
        group = repeated(case)
        if group is not None:
            whole = Problem.of(case, forward)
            most = repeats_allow(whole.y, whole.sd, group)
        result, inflation = search_stated_noise(case, seek, most)
        case = inflation.of(case)
    else:
        result = search_estimated_noise(estimated(case, forward.predict(), space, values), seek)
        case = result.problem.case
    if few is not None:
        result = trial(case)
    result, times = search_setup_error(result, 1.0 / inflation.factor if stated else 0.0, trial)
    inflation = replace(inflation, factor=inflation.factor * times) if stated else inflation
    case = result.problem.case
    n_per_effective = variance_inflation(result) if count >= SERIES else 1.0
    if n_per_effective > 1.0:
        result = trial(case, n_per_effective)
    result, inflation = search_correlated_error(
        result, inflation, most, partial(trial, n_per_effective=n_per_effective)
    )
    case, correlated_error = result.problem.case, result.problem.correlated_error
    if correlated_error.size and n_per_effective > 1.0:
        result = trial(case, correlated_error=correlated_error)
    longer = variance_inflation(result)
    if longer > result.problem.n_per_effective:
        result = trial(case, longer, correlated_error)
    return NoiseSearch(result, inflation, stated, trial)
