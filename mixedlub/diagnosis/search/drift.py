"""Whether what readings are off by wanders in time: weighed with every explanation that leads, as noise is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discrepancy.waves import TURNED
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.inference.map_fit import linear_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.noise_inflation import ROUNDS, Raised, scaled
from mixedlub.diagnosis.search.search import Search
from mixedlub.recording.conditions import clock_of
from mixedlub.recording.correlated_error import Wander

FEWEST = 40
"""Readings from which wandering can be told."""
LENGTHS = (0.02, 0.04, 0.08)
"""Shares of a record over which it may forget itself: what lasts longer is a state of the surfaces, and no noise."""
SIZES = (0.5, 1.0, 2.0, 4.0)
QUIETER = (0.7, 0.5, 0.35)
"""Shares of the noise that may be that of single readings where the rest of it wanders."""
LEADERS = 6
"""Names that are weighed with it, beside nothing missing and the unnamed."""
MOST = 2.0
"""Times what neighbours differ by that noise may wander where nothing is missing: what swings farther is a state."""
CLEAR = 12.0
"""Gain in log probability from which it is believed, the best of very many being taken, or something is missing."""
ALIKE = 2.0
"""Standard errors by which neighbours have to be alike for it to be looked for."""


def under_wandering(found: Search, raised: Raised, most: float, trial: Callable[..., Search]) -> tuple[Search, Raised]:
    """The search under what readings are off by as it wanders, and how much of the noise is then that of single ones.

    ``raised`` is how much more than stated that was, and ``most`` what repeats allow; ``trial`` searches for a case
    and a ``wander``. Where nothing may be missing it wanders no farther than neighbours differ by.
    """
    for _ in range(ROUNDS):
        wander, times = wandering_of(found, 1.0 / raised.times)
        if wander == found.problem.wander or times * raised.times * wander.whole > most:
            break
        again = trial(scaled(found.problem.case, times), wander=wander)
        missing = max(again.log_weights.values()) > again.log_weights[NOTHING] + CLEAR
        if not missing and wander.size * times > _farthest(found):
            break
        found, raised = again, replace(raised, times=raised.times * times)
    return found, raised


def wandering_of(whole: Search, least: float) -> tuple[Wander, float]:
    """How what readings are off by wanders, and how many times the noise of single readings is then what it was.

    The best explanation with it has to beat the best one without. The noise may become ``least`` times as large at
    least: what was taken for that of single readings may be what wanders. Where a shaft turns, neighbours in time are
    neighbours in its position, and what they share may be that.
    """
    now, found = whole.problem.wander, whole.screened
    record, clock = clock_of(whole.problem.rows, ties=True), clock_of(found.problem.rows, ties=True)
    if record is None or clock is None or clock.size < FEWEST or TURNED in whole.problem.rows:
        return now, 1.0
    forms = [Wander.over(record, size, length) for length in LENGTHS for size in SIZES]
    weights, none, unknown = found.log_weights, found.none, found.unknown
    most, best = max(weights.values()) + CLEAR, (now, 1.0)
    named = sorted((m for m in found.fits if m.effects), key=weights.__getitem__)[-LEADERS:]
    own = unknown.best.columns(found.space, found.values, unknown.carriers)
    order = np.argsort(clock, kind="stable")
    farthest = _farthest(found)
    noise = [form for form in forms if form.size <= farthest]
    tried = [(weights[NOTHING], none.residual, none.anchor, none.slopes, noise)]
    for key in named:
        fit = found.fits[key]
        tried.append((weights[key] - found.scores[key] + fit.evidence, fit.residual, fit.anchor, fit.slopes, forms))
    tried.append((weights[DISCREPANCY], unknown.fit.residual, none.anchor, np.hstack([none.slopes, own]), forms))
    for weight, left, target, slopes, allowed in tried:
        if not allowed or not neighbours_alike(left[order]):
            continue
        gain, wander = _most_probable(found.problem, allowed, least, target, slopes)
        if weight + gain > most:
            most, best = weight + gain, wander
    return best


def wandering_variance(found: Search) -> float:
    """Variance of what wanders in that of single readings, as the most probable name leaves it."""
    if not found.problem.wander.size:
        return 0.0
    likely = found.likely
    own, every = found.problem.wander.columns(found.problem.rows), found.problem.shared
    errors = np.linalg.lstsq(every, likely.common, rcond=None)[0][-own.shape[1] :]
    left = found.problem.of_one(likely.residual) + own @ errors
    return max(float(likely.weight @ left**2 / likely.weight.sum()) - 1.0, 0.0)


def _farthest(whole: Search) -> float:
    """How far noise may wander where nothing is missing, in that of single readings."""
    found = whole.screened
    clock = clock_of(found.problem.rows, ties=True)
    assert clock is not None
    return MOST * jumping(found.problem.of_one(found.none.residual)[np.argsort(clock, kind="stable")])


def jumping(left: np.ndarray) -> float:
    """Standard deviation of what changes from one residual to the next.

    >>> bool(0.9 < jumping(np.random.default_rng(1).standard_normal(1000) + np.linspace(0.0, 50.0, 1000)) < 1.1)
    True
    """
    return float(np.median(np.abs(np.diff(left)))) * 1.4826 / np.sqrt(2.0)


def neighbours_alike(left: np.ndarray) -> bool:
    """Whether residuals in the order of their clock are more like their neighbours than chance makes them.

    >>> noise = np.random.default_rng(1).standard_normal(100)
    >>> neighbours_alike(noise), neighbours_alike(np.repeat(noise, 3))
    (False, True)
    """
    centred = np.clip(left - np.median(left), -3.0, 3.0)
    square = float(centred @ centred)
    return bool(float(centred[1:] @ centred[:-1]) * np.sqrt(left.size) > ALIKE * square)


def _most_probable(
    problem: Problem, forms: Sequence[Wander], least: float, target: np.ndarray, slopes: np.ndarray
) -> tuple[float, tuple[Wander, float]]:
    """The wandering, and the noise beside it, that make a linear model's readings most probable; first its gain.

    Where several readings count as one their noise is no longer that of single ones, and stays.
    """
    quieter = [*(q for q in QUIETER if q > least), *([least] if least < 1.0 else [])] if problem.together == 1.0 else []
    columns = np.hstack([slopes, problem.setups])
    now = linear_fit(target, np.hstack([slopes, problem.shared])).evidence
    most, best = -np.inf, (problem.wander, 1.0)
    for form in forms:
        own = form.columns(problem.rows) / np.sqrt(problem.together)
        for times in (1.0, *quieter):
            log = linear_fit(target / times, np.hstack([columns / times, own])).evidence
            log -= target.size * np.log(times)
            if log > most:
                most, best = log, (form, times)
    return most - now, best
