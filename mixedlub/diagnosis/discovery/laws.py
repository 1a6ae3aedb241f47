"""Search for a law of a mismatch without a name: screened, fitted in the whole model, proved on left-out levels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import Refined, refine
from mixedlub.diagnosis.discovery.files import as_effect
from mixedlub.diagnosis.discovery.fitting import Weighed, by_weight, fitted_laws, on_other_quantities, valued, with_laws
from mixedlub.diagnosis.discovery.past_terms import past_terms, past_variables
from mixedlub.diagnosis.discovery.replacements import replacements
from mixedlub.diagnosis.discovery.screening import Candidate, Target, price, screened
from mixedlub.diagnosis.discovery.terms import variables
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.inference.map_fit import Fit, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import CHANCE_GAIN, COLLINEAR, OUTSIDE_OF_END
from mixedlub.diagnosis.settings.discovery import (
    EQUIVALENT_WITHIN,
    FAR_BEHIND,
    FIT_GAIN,
    FORMS_ELSEWHERE,
    FORMS_FITTED,
    LISTED_BEHIND,
    MOST_EXCESS,
    PROVED,
    REPLACEMENTS_FITTED,
    RIVALS,
    SAME_WITHIN,
)
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.recording.conditions import PASSING
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Rival:
    """Another law: its file, log evidence behind the best, and error on left-out levels if it was proved."""

    effect: Effect
    data: Mapping[str, Any]
    behind: float
    heldout: float | None
    equivalent: bool


@dataclass(frozen=True, eq=False)
class FoundLaw:
    """A law that predicts left-out levels better than calibration, with a search in which it is an explanation.

    ``data``: its file; ``ranges``: ends of its variables; ``weights``: probabilities of the law, of proved laws of
    another form that cannot be told apart from it, and of the discrepancy.
    """

    effect: Effect
    data: Mapping[str, Any]
    search: Search
    explanation: Explanation
    candidate: Candidate
    refined: Mapping[Explanation, Refined]
    heldout: HeldOut
    rivals: tuple[Rival, ...]
    ranges: Mapping[str, tuple[float, float]]
    weights: Mapping[Explanation, float]

    def holds(self, table: Table) -> np.ndarray:
        """Rows whose conditions are within the range of the recorded ones on which the law depends."""
        inside = np.ones(len(table), bool)
        for name, (low, high) in self.conditions.items():
            if name in table:
                slack = OUTSIDE_OF_END * (high - low)
                inside &= (table[name] >= low - slack) & (table[name] <= high + slack)
        return inside

    @property
    def conditions(self) -> dict[str, tuple[float, float]]:
        """Recorded ranges of the numeric conditions; of all if the law reads quantities of the chain."""
        rows = self.search.problem.rows
        names = [axis.name for axis in self.search.space.axes if not axis.named and axis.name in rows]
        own = [name for name in names if self.candidate.is_bounded_by(name)]
        alone = len(own) == len(self.ranges)
        used = own if alone else [name for name in names if name not in PASSING]
        return {name: (float(np.min(rows[name])), float(np.max(rows[name]))) for name in used}

    @property
    def written(self) -> Effect:
        """The law as an effect, with the fitted values in its file."""
        return as_effect({**self.data, "id": self.effect.id}, self.search.problem.case.kind.numbers)

    @property
    def alone(self) -> Posterior:
        """The law as the only explanation, for predictions within its range."""
        return self._averaging({self.explanation: 1.0})

    @property
    def one_of_several(self) -> Posterior:
        """The law among all that the readings leave possible, for predictions beyond its range."""
        return self._averaging(self.weights)

    def _averaging(self, weights: Mapping[Explanation, float]) -> Posterior:
        every = {**dict.fromkeys((*self.refined, DISCREPANCY), 0.0), **weights}
        return Posterior(every, self.explanation, (self.explanation,))


def find_law(search: Search, levels: LevelsOut) -> FoundLaw | None:
    """The best law that predicts left-out levels clearly better than calibration, and as well as a discrepancy."""
    full, search = search, search.full_screen
    present, pasts = variables(search), past_variables(search)
    every = [*present, *pasts.values()]
    if not every:
        return None
    every_candidate = screened(search, present, past_terms(search, pasts))
    tried = [c for c in every_candidate if c.score > FIT_GAIN]
    forms = fitted_laws(search, every, _kinds(tried, len(every)) if tried else [])
    elsewhere = [c for w in forms[:FORMS_ELSEWHERE] for c in on_other_quantities(w, search, tried)]
    every_replacement = replacements(search, present)
    least = max([FIT_GAIN, *(c.score - LISTED_BEHIND for c in tried[:1])])
    replacing = _leading_replacements(every_replacement, least)
    weighed = [*forms, *fitted_laws(search, every, [*elsewhere, *replacing], len(forms))]
    weighed = sorted((w for w in weighed if w.log_weight > search.null_fit.evidence + FIT_GAIN), key=by_weight)
    if not weighed:
        return None
    laws = {w.effect.id: w.effect for w in weighed}
    own = with_laws(search.problem, laws)
    proof = _levels_with(levels, own, laws, {w.fit.explanation: w.fit for w in weighed})
    held = {
        w.effect.id: proof.held(w.fit.explanation, outlier_chance(w.fit.residual) > LIKELY) for w in _leading(weighed)
    }
    # Evidence decides between laws; left-out levels decide whether one is a law at all.
    free = levels.held(DISCREPANCY, outlier_chance(search.discrepancy.fit.residual) > LIKELY).score
    best = next((w for w in weighed if w.effect.id in held and _is_law(held[w.effect.id], free)), None)
    if best is None or not _holds_along_its_conditions(best, search, levels.name, own, laws):
        return None
    kept, single = held[best.effect.id], search.problem.n_per_effective
    near = [w for w in weighed if w is not best and w.log_weight > best.log_weight - LISTED_BEHIND][:RIVALS]
    rivals = tuple(_rival(w, best, held, single) for w in near)
    proved = [w for w, rival in zip(near, rivals, strict=True) if rival.equivalent and rival.heldout is not None]
    alike = _distinct([best, *proved])
    final = with_laws(full.problem, {w.effect.id: w.effect for w in alike})
    fits = {w.fit.explanation: w.fit for w in alike}
    if full is not search:
        fits = {key: map_fit(final, key, fit.z, warm=True) for key, fit in fits.items()}
    own_search = replace(full, problem=final, fits={**full.fits, **fits}, screen=None, scores={**full.scores})
    refined = {key: refine(own_search, fit) for key, fit in {**fits, NOTHING: full.null_fit}.items()}
    key = best.fit.explanation
    ranges = {
        v.text: (float(v.values.min()), float(v.values.max())) for v in present if best.candidate.is_bounded_by(v.text)
    }
    # The evidence of the discrepancy has the odds of its base, and no choice of a quantity.
    prior = search.prior_odds.log_given(search.discrepancy.base.explanation)
    prior -= np.log(len({(c.target.quantity, c.target.form) for c in (*every_candidate, *every_replacement)}))
    return FoundLaw(
        best.effect,
        valued(best.data, final, fits[key]),
        own_search,
        key,
        best.candidate,
        refined,
        kept.single_reading_units(single),
        rivals,
        ranges,
        _shares({w.fit.explanation: w.log_weight + prior for w in alike} | {DISCREPANCY: search.discrepancy.evidence}),
    )


def _distinct(laws: list[Weighed]) -> list[Weighed]:
    """The first law of each form, where the changes of quantities look alike."""
    found: list[Weighed] = []
    for w in laws:
        own = w.candidate
        if not any(c.candidate.kind == own.kind and _alike(c.candidate.target, own.target) for c in found):
            found.append(w)
    return found


def _shares(logs: Mapping[Explanation, float]) -> dict[Explanation, float]:
    """Probabilities from log weights."""
    total = np.logaddexp.reduce(list(logs.values()))
    return {key: float(np.exp(log - total)) for key, log in logs.items()}


def _is_law(kept: HeldOut, free: float) -> bool:
    """Whether a law predicts left-out levels clearly better than calibration alone, most of the mismatch included.

    A law far behind the discrepancy, under which left-out levels have the log probability ``free``, follows only a part
    of the mismatch.
    """
    better = kept.score > kept.score_before + CHANCE_GAIN
    return _explains_most(kept) and better and kept.score > free - FAR_BEHIND


def _explains_most(kept: HeldOut) -> bool:
    """Whether a law predicts most of the mismatch of left-out levels, as far as their number tells."""
    excess = max(MOST_EXCESS * (kept.before**2 - 1.0), np.sqrt(2.0 / kept.readings))
    return bool(kept.after < kept.before and kept.after**2 - 1.0 <= excess)


def _holds_along_its_conditions(
    w: Weighed, search: Search, proved: str, problem: Problem, laws: Mapping[str, Effect]
) -> bool:
    """Whether a law also predicts left-out levels of each condition that it reads, where there are enough levels.

    A peak at a single level explains every reading, but the other levels do not predict it.
    """
    read = {name for term in w.candidate.terms for name in term.variables}
    names = [axis.name for axis in search.space.axes if axis.name in read - {proved} and not axis.named]
    for name in names:
        levels = LevelsOut.of(search, name)
        if levels.name == name:
            proof = _levels_with(levels, problem, laws, {w.fit.explanation: w.fit})
            kept = proof.held(w.fit.explanation, outlier_chance(w.fit.residual) > LIKELY)
            if not _explains_most(kept):
                return False
    return True


def _rival(w: Weighed, best: Weighed, held: Mapping[str, HeldOut], single: float) -> Rival:
    """Another law beside the best one; equal evidence and equal errors on left-out levels are no difference."""
    own, behind = held.get(w.effect.id), best.log_weight - w.log_weight
    error = None if own is None else own.single_reading_units(single).after
    limit = (1.0 + EQUIVALENT_WITHIN) * held[best.effect.id].after
    equivalent = abs(behind) <= SAME_WITHIN and (own is None or own.after <= limit)
    return Rival(w.effect, w.data, behind, error, equivalent)


def _kinds(tried: list[Candidate], count: int) -> list[Candidate]:
    """Forms to be fitted, on the best quantity and on the next one that differs: single terms, products and sums."""
    first = tried[0].target
    unlike = (c.target for c in tried if not _alike(c.target, first))
    found: list[Candidate] = []
    for target, share in ((first, 1.0), (next(unlike, None), 0.5)):
        own: dict[tuple[str, ...], Candidate] = {}
        for c in tried:
            if c.target is target:
                own.setdefault(c.kind, c)
        groups: dict[str, list[Candidate]] = {}
        for c in own.values():
            groups.setdefault(_group(c), []).append(c)
        for name, most in FORMS_FITTED.items():
            ranked = sorted(groups.get(name, []), key=lambda c: -c.score - price(c, count))
            found += ranked[: max(1, round(share * most))]
    return found


def _leading_replacements(ranked: list[Candidate], least: float) -> list[Candidate]:
    """Replacements to be fitted: the best above a score, and the best one with fewer powers."""
    near = [c for c in ranked if c.score > least][:REPLACEMENTS_FITTED]
    above = [c for c in ranked if c.score > least and c.target is near[0].target]
    fewer = next((c for c in above if set(c.kind) < set(near[0].kind)), None)
    return near if fewer is None or fewer in near else [*near, fewer]


def _group(c: Candidate) -> str:
    if len(c.terms) > 1:
        return "powers" if all(t.shape == "power" for t in c.terms) else "sum"
    return "product" if len(c.terms[0].variables) > 1 else "single"


def _alike(one: Target, other: Target) -> bool:
    """Whether changes of two quantities look alike in every reading."""
    size = np.linalg.norm(one.column) * np.linalg.norm(other.column)
    return bool(abs(one.column @ other.column) > COLLINEAR * size)


def _levels_with(
    levels: LevelsOut, problem: Problem, laws: Mapping[str, Effect], fits: Mapping[Explanation, Fit]
) -> LevelsOut:
    """The folds of an answer, with laws and their fits."""
    search = replace(levels.search, problem=problem, fits={**levels.search.fits, **fits})
    folds = tuple(replace(f, train=with_laws(f.train, laws), test=with_laws(f.test, laws)) for f in levels.folds)
    return replace(levels, search=search, folds=folds, refitted={})


def _leading(weighed: list[Weighed]) -> list[Weighed]:
    """The laws to prove: the best, and others that are not far behind, of other quantities first."""
    near = [w for w in weighed if w.log_weight > weighed[0].log_weight - FAR_BEHIND]
    first: dict[tuple[str, str], Weighed] = {}
    for w in near:
        first.setdefault((w.data["acts_on"], w.data["form"]), w)
    rest = [w for w in near if not any(w is one for one in first.values())]
    return sorted([*first.values(), *rest][:PROVED], key=by_weight)
