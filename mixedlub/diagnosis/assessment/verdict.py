"""The verdict: probabilities, with a check of every named effect on left-out levels."""

from __future__ import annotations

from dataclasses import replace

from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.assessment.posterior import Posterior, posterior
from mixedlub.diagnosis.assessment.step_evidence import outliers_after_steps
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.change_points import change_point_coordinates
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import FAILED_PENALTY, FAILED_SHARE, MOST_PENALTY
from mixedlub.diagnosis.settings.inference import LIKELY


def judge(search: Search, test: Mismatch, levels: LevelsOut) -> tuple[Posterior, HeldOut]:
    """Posterior probabilities, and the error of the verdict on left-out levels.

    Each effect of a verdict must predict left-out levels better than the verdict without it; else its log odds fall by
    the difference. An explanation that takes a third of the readings, or readings after most steps of a condition, for
    outliers, fails.
    """
    failing = {key: count for key in search.fits if key.effects and (count := failures(search, key))}
    best_named = max((key for key in search.scores if key.effects), key=search.log_weights.__getitem__, default=NOTHING)
    penalties = dict.fromkeys(failing, FAILED_PENALTY)
    checked: set[Explanation] = set()
    while True:
        judged = posterior(search, test, penalties)
        verdict = judged.verdict
        kept = _cross_validated(levels, search, verdict)
        if not verdict.effects or verdict in checked:
            if best_named in failing and not verdict.effects:
                judged = replace(judged, failed=(best_named, failing[best_named]))
            return judged, kept
        checked.add(verdict)
        penalties[verdict] = penalties.get(verdict, 0.0) + _unearned(levels, search, verdict, kept)


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
