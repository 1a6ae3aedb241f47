"""Hypotheses of the user beside the catalogue: probability, odds, and error on left-out levels of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.cross_validation import LevelsOut
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import SMALLEST_P
from mixedlub.diagnosis.settings.inference import LIKELY


@dataclass(frozen=True)
class Hypothesis:
    """A hypothesis of the user.

    ``probability``: of the hypothesis in the explanation; ``log_odds``: of the best explanation that contains it
    against the verdict; ``heldout``: rms of (recorded - predicted)/sd on left-out levels with the hypothesis alone;
    ``parameters``: most probable values of the hypothesis alone. If no reading changes, only the prior probability
    is known.
    """

    id: str
    probability: float
    log_odds: float | None
    heldout: float | None
    parameters: Mapping[str, float]


def weigh(search: Search, judged: Posterior, levels: LevelsOut) -> tuple[Hypothesis, ...]:
    """The hypotheses of the case, the most probable first."""
    inclusion = judged.inclusion(search)
    found = [_weighed(name, inclusion[name], search, judged, levels) for name in search.problem.case.hypotheses]
    return tuple(sorted(found, key=lambda one: -one.probability))


def _weighed(name: str, probability: float, search: Search, judged: Posterior, levels: LevelsOut) -> Hypothesis:
    alone, fit = Explanation.of(name), search.fits.get(Explanation.of(name))
    if fit is None:
        return Hypothesis(name, probability, None, None, {})
    best = max(weight for key, weight in judged.weights.items() if name in key.effects)
    log_odds = float(np.log(max(best, SMALLEST_P) / judged.weights[judged.verdict]))
    kept = levels.held(alone, outlier_chance(fit.residual) > LIKELY)
    heldout = kept.single_reading_units(search.full_screen.problem.n_per_effective).after
    return Hypothesis(name, probability, log_odds, heldout, search.problem.parameters(alone, fit.z)[name])
