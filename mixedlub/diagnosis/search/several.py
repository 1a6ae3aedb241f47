"""Combinations: other laws of the base model, effects, and laws beneath a discrepancy."""

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
from mixedlub.diagnosis.search.prior_odds import PriorOdds
from mixedlub.diagnosis.settings.inference import STRONG_EVIDENCE
from mixedlub.diagnosis.settings.search import ADDED_TO, MOST_ADDED, MOST_EFFECTS, ROUNDS
from mixedlub.recording.conditions import Coordinates

CLOCKS = {"time", "sequence", "ageing"}
"""Quantities that change by themselves during a test."""


def one_in_time(several: Explanation, problem: Problem, null_fit: Fit) -> bool:
    """Whether effects are inseparable: one is a fault of the channel, and all depend on time alone.

    Their sum is then a single function of time, however good the fit. A drifting condition without influence on them or
    on the base model beyond noise separates nothing.
    """
    effects, inputs = problem.effects_of(several.effects), problem.forward.inputs
    inputs_read = {name for e in effects for name in e.reads if name in inputs and np.ptp(inputs[name]) > 0.0}
    still = np.ptp(null_fit.prediction) <= np.median(problem.sd)
    return any(e.stage == "measurement" for e in effects) and bool(still) and inputs_read <= CLOCKS


def fit_from(problem: Problem, starts: Sequence[tuple[Explanation, np.ndarray]], rival: float) -> list[Fit]:
    """Fits of explanations, each from one start, the most promising first."""
    return fit_best_first(lambda one, best: map_fit(problem, *one, rival=best), starts, rival)


def with_additions(
    problem: Problem, fits: dict[Explanation, Fit], draws: tuple[PriorDraws, ...]
) -> dict[Explanation, Fit]:
    """Fits with a further law or effect added to the leaders, as long as the leaders improve.

    All pairs of laws are tried. A further effect is added to laws, and to two effects, or an effect and a law, if no
    other explanation is much more probable.
    """
    prior = PriorOdds.of(s.id for s in draws)
    given = (*prior.laws, *prior.expected)
    laws = tuple(s for s in draws if s.id in given)
    others = tuple(s for s in draws if s.id not in given)

    def weight(fit: Fit) -> float:
        return fit.evidence + prior.log(fit.explanation)

    def needs_more(fit: Fit, best: float) -> bool:
        parts, effects = len(fit.explanation.effects), len(prior.effects_among(fit.explanation))
        return not effects or (effects < MOST_EFFECTS and parts > 1 and weight(fit) > best - STRONG_EVIDENCE)

    if max(fits.values(), key=weight).explanation == NOTHING:
        return fits
    leaders, most = [fits[Explanation.of(s.id)] for s in laws], len(laws) ** 2
    for _ in range(ROUNDS):
        added = promising_additions(problem, leaders, laws, most)
        best = max(weight(f) for f in fits.values())
        added += promising_additions(problem, [f for f in leaders if needs_more(f, best)], others, MOST_ADDED)
        fresh = [one for one in added if one[0] not in fits and not one_in_time(one[0], problem, fits[NOTHING])]
        found = fit_from(problem, fresh, max(f.evidence for f in fits.values()))
        fits |= {one.explanation: one for one in found}
        ranked = sorted((f for f in fits.values() if f.explanation.effects), key=lambda f: -weight(f))
        if leaders == ranked[:ADDED_TO]:
            break
        leaders, most = ranked[:ADDED_TO], MOST_ADDED
    return fits


def discrepancy_beside_laws(
    problem: Problem,
    fits: Mapping[Explanation, Fit],
    space: Coordinates,
    values: list[np.ndarray],
    names: Collection[str],
) -> Discrepancy:
    """Discrepancy added to the base model, or to its best other laws if more probable.

    The evidence sums both; base and form are taken from the more probable. Added to laws of the oil alone, as in a
    viscometer, a free function is an error of their form and not a discrepancy.
    """
    prior = PriorOdds.of(names)
    laws = set(prior.laws)
    laws = laws if any(e.stage == "law" for e in effects_of(laws)) else set()
    given = laws | set(prior.expected)
    weights = {m: f.evidence + prior.log_given(m) for m, f in fits.items() if given.issuperset(m.effects)}
    bases = dict.fromkeys([NOTHING, max(weights, key=weights.__getitem__)])
    found = []
    for base in bases:
        one = fit_discrepancy(problem, fits[base], space, values, names)
        found.append(replace(one, evidence=one.evidence + prior.log_given(base)))
    together = float(np.logaddexp.reduce([one.evidence for one in found]))
    return replace(max(found, key=lambda one: one.evidence), evidence=together)
