"""The verdict: probabilities, corrected by cross-validation until no new explanation ties."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.assessment.posterior import Posterior, posterior
from mixedlub.diagnosis.assessment.step_evidence import outliers_after_steps
from mixedlub.diagnosis.explanation import DISCREPANCY, Explanation
from mixedlub.diagnosis.inference.change_points import change_point_coordinates
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import FAILED_PENALTY, FAILED_SHARE, MOST_PENALTY, VALIDATED
from mixedlub.diagnosis.settings.inference import LIKELY


def judge(search: Search, test: Mismatch, levels: LevelsOut) -> tuple[Posterior, HeldOut]:
    """Posterior probabilities, with cross-validation of the verdict and of all tied explanations.

    Beyond VALIDATED explanations, the others get the least penalty of these. The discrepancy is compared with the first
    effects. If even the best of them is overdispersed on left-out levels, the odds between effects are reduced. Each
    effect of a verdict must predict left-out levels better than the verdict without it. An explanation that takes a
    third of the readings, or readings after most steps of a condition, for outliers, fails.
    """
    failing = {key: count for key in search.fits if key.effects and (count := failures(search, key))}
    against_failed = dict.fromkeys(failing, FAILED_PENALTY)
    weights = search.log_weights
    names = sorted((key for key in search.scores if key.effects), key=lambda key: -weights[key])
    tried: dict[Explanation, tuple[HeldOut, float]] = {}
    discrepancy_penalty: dict[Explanation, float] = {}
    unearned: dict[Explanation, float] = {}
    sound = [key for key in names if key not in failing]
    while True:
        penalties = {key: log_odds_penalty for key, (_, log_odds_penalty) in tried.items()}
        if len(tried) >= VALIDATED and all(penalties.values()):
            rest = min(penalties.values())
            penalties = {key: penalties.get(key, rest) for key in names}
        penalties = {key: penalties.get(key, 0.0) + unearned.get(key, 0.0) for key in {**penalties, **unearned}}
        penalties |= against_failed
        judged = posterior(search, test, penalties | discrepancy_penalty)
        first = judged.verdict
        # Other levels cannot predict a change point.
        if first in tried and not change_point_coordinates(search.problem, first):
            overdispersion = min(kept.overdispersion for kept, _ in tried.values())
            judged = posterior(search, test, penalties | discrepancy_penalty, overdispersion)
        if sound and DISCREPANCY in judged.tied and not discrepancy_penalty:
            if sound[0] not in tried:
                tried[sound[0]] = _cross_validated(levels, search, sound[0])
            outliers = outlier_chance(search.discrepancy.fit.residual) > LIKELY
            against = levels.held(DISCREPANCY, outliers).penalty_against(tried[sound[0]][0])
            discrepancy_penalty = {DISCREPANCY: against}
            continue
        fresh = [key for key in judged.tied if key not in tried and key.effects]
        if fresh and len(tried) < VALIDATED:
            tried[fresh[0]] = _cross_validated(levels, search, fresh[0])
            continue
        verdict = judged.verdict
        kept = (tried.get(verdict) or _cross_validated(levels, search, verdict))[0]
        if len(verdict.effects) < 2 or verdict in unearned:
            if names and names[0] in failing and not verdict.effects:
                judged = replace(judged, failed=(names[0], failing[names[0]]))
            return judged, kept
        unearned[verdict] = _unearned(levels, search, verdict, kept)


def _unearned(levels: LevelsOut, search: Search, verdict: Explanation, kept: HeldOut) -> float:
    """Penalty in log odds of several effects that predict left-out levels worse than without one of them."""
    best = kept.score
    for name in verdict.effects:
        part = Explanation.of(*(one for one in verdict.effects if one != name))
        if part in search.fits and not change_point_coordinates(search.problem, Explanation.of(name)):
            best = max(best, _cross_validated(levels, search, part)[0].score)
    return min(best - kept.score, MOST_PENALTY)


def failures(search: Search, key: Explanation) -> int:
    """Number of readings that an explanation takes for outliers, if so many or so placed that it fails; else 0."""
    problem, residual = search.problem, search.fits[key].residual
    wrong = outlier_chance(problem.single_reading_units(residual)) > LIKELY
    names = [c.name for c in problem.case.kind.columns]
    if wrong.mean() > FAILED_SHARE or outliers_after_steps(problem.rows, names, wrong, residual):
        return int(wrong.sum())
    return 0


def _cross_validated(levels: LevelsOut, search: Search, key: Explanation) -> tuple[HeldOut, float]:
    """Cross-validation of an explanation, and its penalty in log odds."""
    residual = search.fit_of(key).residual
    outliers = outlier_chance(residual) > LIKELY
    kept = levels.held(key, outliers)
    if not key.effects:
        return kept, 0.0
    good = residual[~outliers]
    return kept, kept.log_odds_penalty(float(np.sqrt(np.mean(good**2))) if good.size else 1.0)
