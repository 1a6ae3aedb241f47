"""From weights of explanations to probabilities, verdict and ties."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.effect import STAGES
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.problem import effects_of
from mixedlub.diagnosis.search.search import PRIOR, Search, priors

TIE = 0.1
"""Share of the verdict's probability from which an explanation ties with it."""
FLOOR = 1e-6
"""Nothing is told as certain."""
MARGIN = 1.25
"""Odds by which the test puts "nothing missing" behind the best explanation or ahead of it: just enough to be told."""


@dataclass(frozen=True)
class Posterior:
    """Probability of every explanation, the verdict first.

    Log odds between names were taken as ``inflation`` times smaller than the readings give them.
    """

    weights: Mapping[Explanation, float]
    verdict: Explanation
    tied: tuple[Explanation, ...]
    inflation: float = 1.0

    def inclusion(self, found: Search) -> dict[str, float]:
        """Probability that each effect is part of the explanation; none and unknown as explanations."""
        chance = {s.id: 0.0 for s in found.sampled} | untold(found)
        for key, weight in self.weights.items():
            for name in key.effects:
                chance[name] += weight
        alone = {name: self.weights.get(key, 0.0) for key in (NOTHING, DISCREPANCY) for name in key.ids}
        chance = {**alone, **chance}
        return {name: float(np.clip(value, FLOOR, 1.0 - FLOOR)) for name, value in chance.items()}

    def stages(self) -> dict[str, float]:
        """Probability that each stage of the chain is part of the explanation."""
        chance = dict.fromkeys(STAGES, 0.0)
        for key, weight in self.weights.items():
            for stage in {e.stage for e in effects_of(key.effects)}:
                chance[stage] += weight
        return {stage: float(np.clip(value, FLOOR, 1.0 - FLOOR)) for stage, value in chance.items()}


def untold(found: Search) -> dict[str, float]:
    """Chance of the effects that move no reading: as probable as they were before."""
    looked = (*found.sampled, *found.untestable)
    odds = {e.id: found.problem.forward.odds(e) for s in looked for e in effects_of((s.id,))}
    nothing, single, pair = priors(len(odds))
    single /= nothing + single + pair + PRIOR["discrepancy"]
    return {s.id: single * odds[s.id] / sum(odds.values()) for s in found.untestable}


def posterior(
    found: Search, test: Mismatch, demerits: Mapping[Explanation, float] | None = None, inflation: float = 1.0
) -> Posterior:
    """Normalised weights; whether anything is missing at all is for the test to decide.

    The evidence ranks the explanations, less the ``demerits`` of those that failed on levels left out. Where it
    and the test disagree on "none", its weight is moved just far enough that the most probable explanation agrees
    with the test. What scatters more than noise can, and follows nothing, is something unnamed. Where even the best
    name leaves readings ``inflation`` times their variance off, they tell names apart by that much less; the odds of
    the first name against what is none stay.
    """
    log = dict(found.log_weights)
    for key, demerit in (demerits or {}).items():
        log[key] -= demerit
    names = [key for key in log if key.effects]
    if names and inflation > 1.0:
        told = {k: found.scores[k] - (demerits or {}).get(k, 0.0) for k in names}
        foremost = max(log[key] for key in names)
        log |= {key: log[key] + value * (1.0 / inflation - 1.0) for key, value in told.items()}
        back = foremost - max(log[key] for key in names)
        log |= {key: log[key] + back for key in names}
    if test.unfollowed and log[NOTHING] > log[DISCREPANCY]:
        log[NOTHING], log[DISCREPANCY] = log[DISCREPANCY], log[NOTHING]
    others = [value for key, value in log.items() if key != NOTHING]
    best = max(others, default=-np.inf)
    if test.detected and log[NOTHING] >= best:
        log[NOTHING] = best - np.log(MARGIN)
    elif not test.detected and log[NOTHING] <= best:
        log[NOTHING] = best + np.log(MARGIN)
    top = max(log.values())
    total = sum(np.exp(v - top) for v in log.values())
    weights = {key: float(np.exp(v - top) / total) for key, v in sorted(log.items(), key=lambda item: -item[1])}
    verdict = next(iter(weights))
    tied = tuple(key for key, w in weights.items() if w >= TIE * weights[verdict])
    return Posterior(weights, verdict, tied, inflation)
