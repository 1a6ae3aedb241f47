"""Search for errors that readings of one set-up share, where their size is not stated: specimens and laboratories."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.inference.map_fit import linear_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.noise_inflation import scaled
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.search import (
    DRIFT_CANDIDATES,
    DRIFT_GAIN,
    FINER_SHARES,
    SETUP_SHARES,
    SETUP_WHITE_SHARES,
)
from mixedlub.recording.noise import setups_differ
from mixedlub.recording.readings import rows_of
from mixedlub.schema import system_file


def with_setup_error(case: Case, relative: float, absolute: float) -> Case:
    """The case with an error of this size that readings of one set-up share."""
    recording = case.system.recording
    noise = recording.noise or system_file.Noise()
    noise = noise.model_copy(update={"setup_relative": float(relative), "setup_absolute": float(absolute)})
    recording = recording.model_copy(update={"noise": noise})
    return replace(case, system=case.system.model_copy(update={"recording": recording}))


def has_groups(case: Case) -> bool:
    """Whether a recording has several set-ups of several readings, and states no error between them."""
    rows = rows_of(case)
    if "setup" not in rows or setups_differ(case):
        return False
    count = np.unique(rows["setup"], return_counts=True)[1]
    return bool(count.size > 1 and np.count_nonzero(count > 1) > 1)


def search_setup_error(search: Search, least: float, trial: Callable[[Case], Search]) -> tuple[Search, float]:
    """Repeat the search with the most probable error of set-ups, if clearly probable; and the factor on the noise.

    Noise that was estimated or inflated with set-ups pooled holds their differences, and may shrink to ``least``.
    """
    if not has_groups(search.problem.case):
        return search, 1.0
    (relative, absolute), times = most_probable(search, least)
    if not (relative or absolute):
        return search, 1.0
    return trial(with_setup_error(scaled(search.problem.case, times), relative, absolute)), times


def most_probable(search: Search, least: float) -> tuple[tuple[float, float], float]:
    """Relative and absolute error of set-ups, and the factor on the noise left, at the largest log probability.

    The best explanation with the error must beat the best without it, so that set-ups do not stand in for physics that
    explains them.
    """
    screened = search.full_screen
    problem, weights, discrepancy = screened.problem, screened.log_weights, screened.discrepancy
    named = sorted((m for m in screened.fits if m.effects), key=weights.__getitem__)[-DRIFT_CANDIDATES:]
    flexible = discrepancy.best.columns(screened.space, screened.values, discrepancy.scalings)
    tried = [(weights[DISCREPANCY], discrepancy.base.anchor, np.hstack([discrepancy.base.slopes, flexible]))]
    for key in (NOTHING, *named):
        fit = screened.fits[key]
        tried.append((screened.published_log_weights[key], fit.anchor, fit.slopes))
    before = [linear_fit(anchor, slopes).evidence for _, anchor, slopes in tried]

    def log_probability(which: int, error: tuple[float, float], times: float) -> float:
        weight, anchor, slopes = tried[which]
        both = np.hstack([slopes, _columns(problem, screened.null_fit.prediction, *error)]) / times
        return weight + linear_fit(anchor / times, both).evidence - before[which] - anchor.size * float(np.log(times))

    shares = [share for share in SETUP_WHITE_SHARES if share >= least]
    forms = [(which, error, times) for which in range(len(tried)) for error in _sizes(problem) for times in shares]
    which, error, times = max(forms, key=lambda form: log_probability(*form))
    finer = [(which, error, min(factor * times, 1.0)) for factor in FINER_SHARES if factor * times >= least]
    best = max([(which, error, times), *finer], key=lambda form: log_probability(*form))
    if log_probability(*best) <= max(weights.values()) + DRIFT_GAIN:
        return (0.0, 0.0), 1.0
    return error, best[2]


def _sizes(problem: Problem) -> list[tuple[float, float]]:
    """Relative and absolute errors that are tried."""
    typical = float(np.median(np.abs(problem.inverse(problem.y))))
    sizes = [(share, 0.0) for share in SETUP_SHARES]
    return sizes if problem.case.kind.logarithmic else [*sizes, *((0.0, share * typical) for share in SETUP_SHARES)]


def _columns(problem: Problem, base: np.ndarray, relative: float, absolute: float) -> np.ndarray:
    """Columns of an error of set-ups, in standard deviations of the readings."""
    names = np.unique(problem.rows["setup"])
    member = problem.rows["setup"][:, None] == names
    size = relative if problem.case.kind.logarithmic else relative * np.abs(base) + absolute
    return np.asarray(member * (size / problem.sd)[:, None])
