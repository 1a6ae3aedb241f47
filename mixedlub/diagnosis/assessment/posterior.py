"""From weights of explanations to probabilities, verdict and ties."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.effect import STAGES
from mixedlub.diagnosis.assessment.mismatch_test import Mismatch
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.search.prior_odds import PriorOdds
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import FLOOR, OUTSIDE, TEST_MARGIN, TIE


@dataclass(frozen=True)
class Posterior:
    """Probability of every explanation, the verdict first.

    ``failed``: the most probable explanation but for its outliers, with their number, if it names nothing therefore.
    """

    weights: Mapping[Explanation, float]
    verdict: Explanation
    tied: tuple[Explanation, ...]
    failed: tuple[Explanation, int] | None = None

    def inclusion(self, search: Search) -> dict[str, float]:
        """Probability that each effect is part of the explanation; none and unknown as explanations."""
        chance = {s.id: 0.0 for s in search.draws} | prior_of_untestable(search)
        for key, weight in self.weights.items():
            for name in key.effects:
                chance[name] += weight
        alone = {name: self.weights.get(key, 0.0) for key in (NOTHING, DISCREPANCY) for name in key.ids}
        chance = {**alone, **chance}
        return {name: float(np.clip(value, FLOOR, 1.0 - FLOOR)) for name, value in chance.items()}

    def stages(self, search: Search) -> dict[str, float]:
        """Probability that each stage of the chain is part of the explanation."""
        chance = dict.fromkeys(STAGES, 0.0)
        for key, weight in self.weights.items():
            for stage in {e.stage for e in search.problem.effects_of(key.effects)}:
                chance[stage] += weight
        return {stage: float(np.clip(value, FLOOR, 1.0 - FLOOR)) for stage, value in chance.items()}


def prior_of_untestable(search: Search) -> dict[str, float]:
    """Prior probability of the effects that change no reading."""
    looked = (*search.draws, *search.untestable)
    odds = PriorOdds.of(s.id for s in looked)
    return {s.id: odds.chance(s.id) for s in search.untestable}


def posterior(search: Search, test: Mismatch, penalties: Mapping[Explanation, float] | None = None) -> Posterior:
    """Normalised weights, in agreement with the test against nothing missing.

    Explanations are ranked by their evidence less the ``penalties`` in log odds. Where this and the test disagree on
    nothing missing, its weight is moved just far enough to agree. Scatter beyond any noise that no explanation follows
    counts as a discrepancy. So does the probability that no explanation considered holds.
    """
    log = dict(search.log_weights)
    for key, log_odds_penalty in (penalties or {}).items():
        log[key] -= log_odds_penalty
    if test.unexplained_scatter and log[NOTHING] > log[DISCREPANCY]:
        log[NOTHING], log[DISCREPANCY] = log[DISCREPANCY], log[NOTHING]
    others = [value for key, value in log.items() if key != NOTHING]
    best = max(others, default=-np.inf)
    if test.detected and log[NOTHING] >= best:
        log[NOTHING] = best - np.log(TEST_MARGIN)
    elif not test.detected and log[NOTHING] <= best:
        log[NOTHING] = best + np.log(TEST_MARGIN)
    top = max(log.values())
    total = sum(np.exp(v - top) for v in log.values())
    weights = {key: float(np.exp(v - top) / total) for key, v in sorted(log.items(), key=lambda item: -item[1])}
    verdict = next(iter(weights))
    tied = tuple(key for key, w in weights.items() if w >= TIE * weights[verdict])
    weights = {key: (1.0 - OUTSIDE) * w + OUTSIDE * key.is_discrepancy for key, w in weights.items()}
    return Posterior(weights, verdict, tied)
