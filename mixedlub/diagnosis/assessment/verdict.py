"""The verdict: probabilities, corrected by cross-validation until no new explanation ties."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.assessment.posterior import Posterior, posterior
from mixedlub.diagnosis.explanation import DISCREPANCY, Explanation
from mixedlub.diagnosis.inference.change_points import change_point_coordinates
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import VALIDATED
from mixedlub.diagnosis.settings.inference import LIKELY


def judge(search: Search, test: Mismatch, levels: LevelsOut) -> tuple[Posterior, HeldOut]:
    """Posterior probabilities, with cross-validation of the verdict and of all tied explanations.

    Beyond VALIDATED explanations, the others get the least penalty of these. The discrepancy is compared with the first
    effects. If even the best of them is overdispersed on left-out levels, the odds between effects are reduced.
    """
    weights = search.log_weights
    names = sorted((key for key in search.scores if key.effects), key=lambda key: -weights[key])
    tried: dict[Explanation, tuple[HeldOut, float]] = {}
    discrepancy_penalty: dict[Explanation, float] = {}
    while True:
        penalties = {key: log_odds_penalty for key, (_, log_odds_penalty) in tried.items()}
        if len(tried) >= VALIDATED and all(penalties.values()):
            rest = min(penalties.values())
            penalties = {key: penalties.get(key, rest) for key in names}
        judged = posterior(search, test, penalties | discrepancy_penalty)
        first = judged.verdict
        # Other levels cannot predict a change point.
        if first in tried and not change_point_coordinates(search.problem, first):
            overdispersion = min(kept.overdispersion for kept, _ in tried.values())
            judged = posterior(search, test, penalties | discrepancy_penalty, overdispersion)
        if names and DISCREPANCY in judged.tied and not discrepancy_penalty:
            if names[0] not in tried:
                tried[names[0]] = _cross_validated(levels, search, names[0])
            outliers = outlier_chance(search.discrepancy.fit.residual) > LIKELY
            against = levels.held(DISCREPANCY, outliers).penalty_against(tried[names[0]][0])
            discrepancy_penalty = {DISCREPANCY: against}
            continue
        fresh = [key for key in judged.tied if key not in tried and key.effects]
        if not fresh or len(tried) >= VALIDATED:
            key = judged.verdict
            return judged, (tried.get(key) or _cross_validated(levels, search, key))[0]
        tried[fresh[0]] = _cross_validated(levels, search, fresh[0])


def _cross_validated(levels: LevelsOut, search: Search, key: Explanation) -> tuple[HeldOut, float]:
    """Cross-validation of an explanation, and its penalty in log odds."""
    residual = search.fit_of(key).residual
    outliers = outlier_chance(residual) > LIKELY
    kept = levels.held(key, outliers)
    if not key.effects:
        return kept, 0.0
    good = residual[~outliers]
    return kept, kept.log_odds_penalty(float(np.sqrt(np.mean(good**2))) if good.size else 1.0)
