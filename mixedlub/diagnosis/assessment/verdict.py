"""The verdict: probabilities, with a check of every named effect on left-out levels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.assessment.posterior import Posterior, posterior
from mixedlub.diagnosis.assessment.step_evidence import outliers_after_steps
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.change_points import change_point_coordinates
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import CHANCE_GAIN, FAILED_PENALTY, FAILED_SHARE, MOST_PENALTY, VALIDATED
from mixedlub.diagnosis.settings.inference import LIKELY


def judge(search: Search, test: Mismatch, levels: LevelsOut) -> tuple[Posterior, HeldOut]:
    """Posterior probabilities, and the error of the verdict on left-out levels.

    The explanations that tie are compared by the log probability of left-out levels: beyond a gain by chance, the
    others lose the difference in log odds. Each effect of a verdict must predict left-out levels better than the
    verdict without it. An explanation that takes a third of the readings, or readings after most steps of a condition,
    for outliers, fails.
    """
    failing = {key: count for key in search.fits if key.effects and (count := failures(search, key))}
    best_named = max((key for key in search.scores if key.effects), key=search.log_weights.__getitem__, default=NOTHING)
    scores: dict[Explanation, float] = {}
    unearned: dict[Explanation, float] = {}
    while True:
        most = max(scores.values(), default=0.0) - CHANCE_GAIN
        penalties = dict.fromkeys(failing, FAILED_PENALTY)
        for key, score in scores.items():
            lost = float(np.clip(most - score, 0.0, MOST_PENALTY))
            penalties[key] = penalties.get(key, 0.0) + max(lost, unearned.get(key, 0.0))
        judged = posterior(search, test, penalties)
        verdict = judged.verdict
        fresh = [key for key in judged.tied if key not in scores]
        if fresh and (len(scores) < VALIDATED or verdict in fresh):
            scores[fresh[0]] = _cross_validated(levels, search, fresh[0]).score
            continue
        kept = _cross_validated(levels, search, verdict)
        if verdict.effects and verdict not in unearned:
            unearned[verdict] = _unearned(levels, search, verdict, kept)
            continue
        if best_named in failing and not verdict.effects:
            judged = replace(judged, failed=(best_named, failing[best_named]))
        return judged, kept


def _unearned(levels: LevelsOut, search: Search, verdict: Explanation, kept: HeldOut) -> float:
    """Penalty in log odds of effects that predict left-out levels worse than without one of them."""
    best = kept.score
    for name in verdict.effects:
        part = Explanation.of(*(one for one in verdict.effects if one != name))
        if part in search.fits and not change_point_coordinates(search.problem, Explanation.of(name)):
            best = max(best, _cross_validated(levels, search, part).score)
    return min(best - kept.score, MOST_PENALTY)


def failures(search: Search, key: Explanation) -> int:
    """Number of readings that an explanation takes for outliers, if so many or so placed that it fails; else 0."""
    problem, residual = search.problem, search.fits[key].residual
    wrong = outlier_chance(problem.single_reading_units(residual)) > LIKELY
    names = [c.name for c in problem.case.kind.columns]
    if wrong.mean() > FAILED_SHARE or outliers_after_steps(problem.rows, names, wrong, residual):
        return int(wrong.sum())
    return 0


def _cross_validated(levels: LevelsOut, search: Search, key: Explanation) -> HeldOut:
    """Cross-validation of an explanation."""
    return levels.held(key, outlier_chance(search.fit_of(key).residual) > LIKELY)
