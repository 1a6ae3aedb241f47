"""The verdict: probabilities, with what ties held against levels left out until nothing new ties."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.assessment.cross_validation import DEMERIT, HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.assessment.posterior import MARGIN, Posterior, posterior
from mixedlub.diagnosis.explanation import DISCREPANCY, Explanation
from mixedlub.diagnosis.inference.change_points import sudden_places
from mixedlub.diagnosis.inference.map_fit import outlier_chance
from mixedlub.diagnosis.search.search import Search

CANDIDATES = 6
"""Names held against levels left out, at most: each costs as many fits as there are levels."""


def judge(found: Search, test: Mismatch) -> tuple[Posterior, HeldOut]:
    """Probabilities, with the verdict and what ties with it first held against levels left out.

    When CANDIDATES names were tried, the others are taken to fail like the best of those that did. The unnamed
    mismatch is held against the first name, and hardly more probable where that clearly outdoes it. Where even the
    best of those tried leaves more there than noise, the odds between names are less sure.
    """
    levels = LevelsOut.of(found)
    names = sorted((key for key in found.scores if key.effects), key=lambda key: -found.log_weights[key])
    tried: dict[Explanation, tuple[HeldOut, float]] = {}
    unnamed: dict[Explanation, float] = {}
    while True:
        demerits = {key: demerit for key, (_, demerit) in tried.items()}
        if len(tried) >= CANDIDATES and all(demerits.values()):
            rest = min(demerits.values())
            demerits = {key: demerits.get(key, rest) for key in names}
        judged = posterior(found, test, demerits | unnamed)
        first = judged.verdict
        # What stands at one place is not for other levels to foretell.
        if first in tried and not sudden_places(found.problem, first):
            inflation = min(kept.inflation for kept, _ in tried.values())
            judged = posterior(found, test, demerits | unnamed, inflation)
        if names and DISCREPANCY in judged.tied and not unnamed:
            if names[0] not in tried:
                tried[names[0]] = _held_against(levels, found, names[0])
            unnamed = {DISCREPANCY: _behind(levels, found, names[0], tried[names[0]][0])}
            continue
        fresh = [key for key in judged.tied if key not in tried and key.effects]
        if not fresh or len(tried) >= CANDIDATES:
            key = judged.verdict
            return judged, (tried.get(key) or _held_against(levels, found, key))[0]
        tried[fresh[0]] = _held_against(levels, found, fresh[0])


def _behind(levels: LevelsOut, found: Search, name: Explanation, named: HeldOut) -> float:
    """What the unnamed mismatch loses in log odds against the first name, by what both foretell.

    A name that clearly outdoes it on inner levels ties with it, and stays behind it.
    """
    outliers = outlier_chance(found.unknown.fit.residual) > 0.5
    behind = levels.held(DISCREPANCY, outliers).behind(named)
    # Readings that only the name takes for wild are among those it has to foretell.
    if not levels.held(DISCREPANCY, outliers, inner=True).outdone(levels.held(name, outliers, inner=True)):
        return behind
    lead = found.log_weights[DISCREPANCY] - found.log_weights[name] - np.log(MARGIN)
    return max(behind, float(np.clip(lead, 0.0, DEMERIT)))


def _held_against(levels: LevelsOut, found: Search, key: Explanation) -> tuple[HeldOut, float]:
    """How an explanation predicts levels left out, and what a name loses by it."""
    residual = found.fit_of(key).residual
    outliers = outlier_chance(residual) > 0.5
    kept = levels.held(key, outliers)
    if not key.effects:
        return kept, 0.0
    good = residual[~outliers]
    return kept, kept.demerit(float(np.sqrt(np.mean(good**2))) if good.size else 1.0)
