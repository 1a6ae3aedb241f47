"""Other laws of the base model: several at once, beside effects, and beneath a discrepancy."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discrepancy.model import Discrepancy, fit_discrepancy
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.additions import promising_additions
from mixedlub.diagnosis.inference.initial_guesses import PriorDraws
from mixedlub.diagnosis.inference.map_fit import Fit, fit_best_first, map_fit
from mixedlub.diagnosis.problem import Problem, effects_of
from mixedlub.diagnosis.search.prior_odds import PriorOdds, log_odds_of_laws
from mixedlub.diagnosis.settings.search import LAW_LEADERS, LAW_ROUNDS, LAWS_ADDED
from mixedlub.recording.conditions import Coordinates


def fit_from(problem: Problem, starts: Sequence[tuple[Explanation, np.ndarray]], rival: float) -> list[Fit]:
    """Fits of explanations from a start each, the most promising first."""
    return fit_best_first(lambda one, best: map_fit(problem, *one, rival=best), starts, rival)


def with_more_laws(
    problem: Problem, fits: dict[Explanation, Fit], draws: tuple[PriorDraws, ...]
) -> dict[Explanation, Fit]:
    """The fits with pairs of laws, leaders beside further laws, and laws beside an effect, as long as one improves."""
    prior = PriorOdds.of(s.id for s in draws)
    laws = tuple(s for s in draws if s.id in prior.laws)
    others = tuple(s for s in draws if s.id not in prior.laws)

    def weight(fit: Fit) -> float:
        return fit.evidence + prior.log(fit.explanation)

    best = max(fits.values(), key=weight)
    if not laws or best.explanation == NOTHING:
        return fits
    leaders = [fits[Explanation.of(s.id)] for s in laws]
    most = len(laws) ** 2
    for _ in range(LAW_ROUNDS):
        alone = [f for f in leaders if set(prior.laws).issuperset(f.explanation.effects)]
        added = promising_additions(problem, leaders, laws, most)
        added += promising_additions(problem, alone, others, LAWS_ADDED)
        fresh = [item for item in added if item[0] not in fits]
        found = fit_from(problem, fresh, max(f.evidence for f in fits.values()))
        fits |= {one.explanation: one for one in found}
        ranked = sorted((f for f in fits.values() if f.explanation.effects), key=lambda f: -weight(f))
        if leaders == ranked[:LAW_LEADERS]:
            break
        leaders, most = ranked[:LAW_LEADERS], LAWS_ADDED
    return fits


def discrepancy_beside_laws(
    problem: Problem,
    fits: Mapping[Explanation, Fit],
    space: Coordinates,
    values: list[np.ndarray],
    names: Collection[str],
) -> Discrepancy:
    """The discrepancy added to the base model, or to the best other laws of it where they are more probable.

    Its evidence counts both; what it is added to, and its form, are those of the more probable one. Beside laws of the
    oil alone, as a viscometer reads them, a free function is an error of their form and no discrepancy.
    """
    laws = set(PriorOdds.of(names).laws)
    laws = laws if any(e.stage == "law" for e in effects_of(laws)) else set()
    weights = {m: f.evidence + log_odds_of_laws(len(m.effects)) for m, f in fits.items() if laws.issuperset(m.effects)}
    bases = dict.fromkeys([NOTHING, max(weights, key=weights.__getitem__)])
    found = []
    for base in bases:
        one = fit_discrepancy(problem, fits[base], space, values, names)
        found.append(replace(one, evidence=one.evidence + log_odds_of_laws(len(base.effects))))
    together = float(np.logaddexp.reduce([one.evidence for one in found]))
    return replace(max(found, key=lambda one: one.evidence), evidence=together)
