"""The search under the noise that is stated, under more where the readings ask for it, under theirs where none is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.diagnosis.inference.map_fit import log_likelihood
from mixedlub.diagnosis.search.search import Search
from mixedlub.recording.noise import BOTH, PARTS, medians, pooled_sd, with_noise
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.table import Table

FACTORS = np.array([1.1, 1.25, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 4.0, 6.0, 10.0])
"""How many times the stated noise may be meant."""
SHARES = np.array([0.003, 0.006, 0.01, 0.015, 0.02, 0.03, 0.05])
"""Shares of the reading by which a rig may scatter beyond the sds in a column, which are often those of one setting."""
USUAL, WEAKER = 2, 4.0
"""Which of them is usual; gain from which one is believed: sds in a column say less than a noise someone states."""
SIZES = np.geomspace(0.3, 3.0, 13)
"""Of an estimated noise, how many times as much another mixture of its parts may have."""
CLEAR = 8.0
"""Gain in log probability from which stated noise is not believed; under nothing but noise it stays below 3."""
ROUNDS = 4
"""Times the noise is raised at most: fits under too little noise follow it, so one step seldom suffices."""
MOST = 4.0
"""How many times the stated noise a rig may have: what scatters more is no noise, though nothing follows it."""
UNLIKELY = 1e-3
"""Chance of repeats that scatter as little as these under the noise that bounds it."""
MULTIPLES, NEARLY, STEPS = np.geomspace(0.25, 2.0, 31), 0.1, 5
"""Of an estimated noise, how much less or more it may be meant, how near is near enough, how often that is asked."""
ENOUGH = 10
"""Readings, beyond the coordinates of the base model, from which their scatter is known well enough to judge."""


class Trial(Protocol):
    """A search for a case, or what it makes of a ``near`` one under its noise."""

    def __call__(self, case: Case, near: Search | None = None) -> Search: ...


@dataclass(frozen=True)
class Raised:
    """Noise that is taken for the stated: ``times`` as much, after a ``share`` of the reading beside it."""

    times: float = 1.0
    share: float = 0.0

    def of(self, case: Case) -> Case:
        """The case with it."""
        if self.share:
            sd = rows_of(case)[f"{case.quantity}_sd"].astype(float)
            case = _with_sds(case, np.hypot(sd, self.share * np.abs(readings_of(case))))
        return scaled(case, self.times)


def stated_or_more(case: Case, trial: Trial, most: float) -> tuple[Search, Raised]:
    """The search under the stated noise, or under more where the readings say so clearly, and how much more.

    Every explanation is weighed again with its residuals against more noise. That is believed where the best of
    them beats the best one under the stated noise, the unnamed mismatch among them: what goes smoothly with the
    conditions is a mismatch, what goes with none is noise. Fits under too little noise follow it, and hide a part.
    Repeats at equal conditions bound it by ``most``: what they agree on is no noise. Without such, a column of sds may
    hold what one setting repeats to, and a share of the reading is lacking.
    """
    found, raised = trial(case), Raised()
    if f"{case.quantity}_sd" in rows_of(case) and np.isinf(most):
        found, raised = _with_share(case, trial, found)
    for needed in (CLEAR, *[0.0] * (ROUNDS - 1)):
        gain, factor = more(found)
        if gain <= needed or raised.times * factor > most:
            break
        raised = replace(raised, times=raised.times * factor)
        found = trial(raised.of(case))
    return found, raised


def _with_share(case: Case, trial: Trial, found: Search) -> tuple[Search, Raised]:
    """The search under the share of the reading, beside the sds told, that makes the readings most probable.

    Looked for uphill from a usual share and from the one that residuals under the sds ask for. Shares in between are
    weighed from where the search of the nearest one stands; that of the best one is then made whole.
    """
    tried = {-1: found, USUAL: trial(Raised(share=SHARES[USUAL]).of(case))}

    def height(i: int) -> float:
        if i not in tried:
            near = min((j for j in tried if j >= 0), key=lambda j: abs(j - i))
            tried[i] = trial(Raised(share=SHARES[i]).of(case), near=tried[near])
        return tried[i].log_probability

    gain, asked = _lacking(found)
    for i in (USUAL, asked) if gain > WEAKER else (USUAL,):
        beside = [j for j in (i - 1, i + 1) if 0 <= j < SHARES.size]
        step = max(beside, key=height) - i
        while 0 <= i + step < SHARES.size and height(i + step) > height(i):
            i += step
    best = max(tried, key=height)
    if best < 0 or height(best) <= height(-1) + WEAKER:
        return found, Raised()
    raised = Raised(share=float(SHARES[best]))
    whole = tried[best] if best == USUAL else trial(raised.of(case))
    return (whole, raised) if whole.log_probability > height(-1) + WEAKER else (found, Raised())


def _lacking(found: Search) -> tuple[float, int]:
    """Gain in log probability by a share of the reading beside the sds told, and which share is the best."""
    sd = found.problem.one_sd * found.problem.unit_size(found.problem.y)
    size = np.abs(found.problem.level(found.problem.y))
    return _under_other_noise(found, np.hypot(1.0, SHARES[:, None] * size / sd))


def repeats_allow(y: np.ndarray, sd: np.ndarray, group: np.ndarray) -> float:
    """How many times their sd readings could have whose repeats form these groups, at most.

    >>> jumping = 0.1 * np.tile([0.8, 1.0, 1.25, 1.0], 5)
    >>> y = 100.0 + 0.1 * np.random.default_rng(1).standard_normal(20)
    >>> repeats_allow(y, jumping, np.repeat(np.arange(5), 4)) < 2.0
    True
    """
    from scipy.special import chdtri

    spare = group.size - int(group.max()) - 1
    apart = (y - medians(y, group)[group]) / sd
    return float(pooled_sd(apart, group) * np.sqrt(spare / chdtri(spare, 1.0 - UNLIKELY)))


def more(found: Search) -> tuple[float, float]:
    """Gain in log probability of the best explanation by more noise over the best without, and the factor."""
    gain, best = _under_other_noise(found, FACTORS[:, None])
    return gain, float(FACTORS[best])


def _under_other_noise(found: Search, times: np.ndarray) -> tuple[float, int]:
    """Gain in log probability of the best explanation under noise ``times`` (m, readings) as large, and which of m."""
    weights = found.log_weights
    most, best = -np.inf, 0
    for key, weight in weights.items():
        fit = found.fit_of(key)
        bent = found.scores.get(key, fit.evidence) - fit.evidence
        # The evidence of a fit far behind is carried over from another noise: it is no more than its likelihood.
        carried = max(fit.evidence - float(log_likelihood(fit.residual)[0].sum()), 0.0)
        gains = _gains(fit.residual, times)
        if weight - bent - carried + gains.max() > most:
            most, best = weight - bent - carried + float(gains.max()), int(np.argmax(gains))
    return most - max(weights.values()), best


def shown(case: Case, trial: Trial) -> Search:
    """The search under the estimated noise, or as much less or more as makes the readings most probable.

    What is left over then says how much of it goes in proportion to the reading and how much is alike for all: few
    repeats tell that less well than all readings do.
    """
    found = _fitting(case, trial)
    gain, other = _other_parts(found)
    if gain < BOTH:
        return found
    again = trial(other)
    return again if again.log_probability > found.log_probability + BOTH else found


def _other_parts(found: Search) -> tuple[float, Case]:
    """Gain in log probability by the best other mixture of the parts of noise, and the case with it."""
    problem = found.problem
    best = found.likely
    size = problem.noise_size(best.prediction)
    typical = float(np.median(size))
    scales = SIZES * float(np.median(problem.sd * problem.unit_size(best.prediction))) / typical
    noises = [(k * own, k * common * typical) for k in scales for own, common in PARTS]
    sds = np.array([np.hypot(own * size, common) for own, common in noises]) / problem.unit_size(best.prediction)
    gain, which = _under_other_noise(found, np.maximum(sds, 1e-300) / problem.sd)
    return gain, with_noise(problem.case, *noises[which])


def _fitting(case: Case, trial: Trial) -> Search:
    """The search under the multiple of the case's noise that its own residuals ask for.

    What is left over under one noise asks for the next, which is kept while the readings are more probable under it;
    half the way is tried where it is not. A start far too low stays there, for what is then fitted follows the noise:
    the estimate from a smooth fit is none.
    """
    found = trial(case)
    for _ in range(STEPS):
        _, best = _under_other_noise(found, MULTIPLES[:, None])
        asked = float(MULTIPLES[best])
        for step in (asked, np.sqrt(asked)):
            if abs(np.log(step)) < NEARLY:
                return found
            again = trial(scaled(found.problem.case, float(step)))
            if again.log_probability > found.log_probability:
                break
        else:
            return found
        found = again
    return found


def under_its_own(found: Search, trial: Callable[[Case], Search]) -> Search:
    """The search under the noise that the calibrated base model would need if nothing were missing."""
    gain, times = louder(found.none.residual)
    return trial(scaled(found.problem.case, times)) if gain > 0.0 else found


def louder(residual: np.ndarray) -> tuple[float, float]:
    """Largest gain of the log likelihood of residuals (in sigmas) by more noise, and how many times the noise.

    >>> gain, times = louder(2.0 * np.random.default_rng(1).standard_normal(100))
    >>> bool(gain > 20.0), times
    (True, 1.6)
    >>> bool(louder(np.random.default_rng(1).standard_normal(100))[0] < 1.0)
    True
    """
    gains = _gains(residual, FACTORS[:, None])
    return float(gains.max()), float(FACTORS[int(np.argmax(gains))])


def _gains(residual: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Gains (m,) of the log likelihood of residuals by noise ``times`` (m, readings) as large."""
    logs = np.broadcast_to(np.log(times), (len(times), residual.size))
    return np.asarray((log_likelihood(residual / times)[0] - logs).sum(axis=1) - log_likelihood(residual)[0].sum())


def quiet(found: Search) -> bool:
    """Whether readings scatter by less than half of their noise about the calibrated base model alone.

    That model has few coordinates to follow noise with: so little is left only if the noise is overstated.
    """
    spare = found.none.residual.size - found.none.z.size
    left = found.problem.of_one(found.none.residual)
    return spare >= ENOUGH and float(left @ left) < 0.25 * spare


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
