"""Search for a law of a mismatch without a name: screened, fitted through the whole model, proved on left-out levels."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.chain.effect import Effect
from mixedlub.chain.priors import LogNormal, Normal, Prior, Uniform
from mixedlub.diagnosis.assessment.cross_validation import HeldOut, LevelsOut
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import Refined, refine
from mixedlub.diagnosis.discovery.files import as_effect, law_data
from mixedlub.diagnosis.discovery.screening import QUANTITIES, Candidate, screened
from mixedlub.diagnosis.discovery.terms import Variable, variables
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.inference.map_fit import Fit, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.discovery import (
    EQUIVALENT_WITHIN,
    FIT_GAIN,
    FITTED,
    LEAST_GAIN,
    PROVED,
    SAME_WITHIN,
)
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.own_laws import check_usable, columns_read
from mixedlub.running.parallel import shared_out
from mixedlub.schema.table import BOOKKEEPING
from profiles.errors import InputError

NAME = "found_law"
"""Id of a found law."""


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

    ``values`` are its parameters with the ends of their 90 % intervals.
    """

    effect: Effect
    data: Mapping[str, Any]
    search: Search
    explanation: Explanation
    refined: Mapping[Explanation, Refined]
    heldout: HeldOut
    rivals: tuple[Rival, ...]
    ranges: Mapping[str, tuple[float, float]]

    @property
    def posterior(self) -> Posterior:
        """The law as the only explanation, for predictions."""
        weights = {self.explanation: 1.0, NOTHING: 0.0, DISCREPANCY: 0.0}
        return Posterior(weights, self.explanation, (self.explanation,))


def find_law(search: Search, levels: LevelsOut) -> FoundLaw | None:
    """The best law that predicts left-out levels clearly better than calibration; None if there is none."""
    full, search = search, search.full_screen
    every = variables(search)
    if not every:
        return None
    leaders = _distinct([c for c in screened(search, every) if c.score > FIT_GAIN])
    offered = _offered(search, leaders, every)
    if not offered:
        return None
    laws = {law.id: law for law, _, _ in offered}
    own = _with_laws(search.problem, laws)
    null, base = search.null_fit, search.discrepancy.base.explanation
    starts = search.fits.get(base, null)

    def fitted(item: tuple[Effect, dict[str, Any], Candidate]) -> Fit | None:
        law = item[0]
        key = Explanation.of(*base.effects, law.id)
        try:
            return map_fit(own, key, _start(own, key, law, starts, search.problem), warm=True)
        except (np.linalg.LinAlgError, FloatingPointError):
            return None

    fits = shared_out(fitted, offered)
    # The price of a law: how many of its class were tried, as the screening has it.
    weighed = [
        (fit.evidence + _price(c), fit, law, data, c)
        for fit, (law, data, c) in zip(fits, offered, strict=True)
        if fit is not None and np.isfinite(fit.evidence)
    ]
    weighed = sorted((w for w in weighed if w[0] > null.evidence + FIT_GAIN), key=lambda w: -w[0])
    if not weighed:
        return None
    proof = _levels_with(levels, own, laws, {w[1].explanation: w[1] for w in weighed})
    proved: list[tuple[float, HeldOut, tuple[Any, ...]]] = []
    for w in _diverse(weighed):
        kept = proof.held(w[1].explanation, outlier_chance(w[1].residual) > LIKELY)
        proved.append((kept.after, kept, w))
    # Evidence decides between laws; error on left-out levels whether one is a law at all, and between equal ones.
    best = max(w[0] for w in weighed)
    able = [p for p in proved if p[1].after <= LEAST_GAIN * p[1].before and p[1].score > p[1].score_before]
    if not able:
        return None
    after, kept, (score, fit, law, data, _) = max(able, key=lambda p: _rank(p[0], p[1], p[2][0] - best))
    single = search.problem.n_per_effective
    rivals = tuple(
        Rival(
            w[2],
            _renamed(w[3], own, w[1]),
            score - w[0],
            next((float(np.sqrt(single)) * p[0] for p in proved if p[2] is w), None),
            _is_equivalent(w, score, after, proved),
        )
        for w in weighed
        if w[2] is not law
    )
    final = _with_laws(full.problem, {law.id: law})
    if full is not search:
        fit = map_fit(final, fit.explanation, fit.z, warm=True)
    own_search = replace(
        full, problem=final, fits={**full.fits, fit.explanation: fit}, screen=None, scores={**full.scores}
    )
    refined = {fit.explanation: refine(own_search, fit), NOTHING: refine(own_search, full.null_fit)}
    ranges = {v.text: (float(v.values.min()), float(v.values.max())) for v in every if v.text in data["expression"]}
    return FoundLaw(
        law,
        _renamed(data, final, fit),
        own_search,
        fit.explanation,
        refined,
        kept.single_reading_units(single),
        rivals,
        ranges,
    )


def _rank(after: float, kept: HeldOut, behind: float) -> float:
    """Merit of a proved law: log odds behind the best, and the gain in log probability on left-out levels."""
    return behind + (kept.score - kept.score_before)


def _is_equivalent(w: tuple[Any, ...], score: float, after: float, proved: list[Any]) -> bool:
    if score - w[0] > SAME_WITHIN:
        return False
    own = next((p[0] for p in proved if p[2] is w), None)
    return own is None or own <= (1.0 + EQUIVALENT_WITHIN) * after


def _price(c: Candidate) -> float:
    """Log prior of a candidate: parameters are priced by their own prior, the choice of terms by halves."""
    return -np.log(2.0) * sum(2 + len(t.variables) for t in c.terms)


def _distinct(candidates: list[Candidate]) -> list[Candidate]:
    """The best candidate of each kind on each quantity; the best kinds, and the best kind on other quantities."""
    best: dict[tuple[Any, ...], Candidate] = {}
    for c in candidates:
        best.setdefault((c.target.quantity, c.target.form, c.kind), c)
    found = list(best.values())
    first: list[Candidate] = []
    seen: dict[str, int] = {}
    for c in found:
        name = f"{c.target.quantity} {c.target.form}"
        if seen.get(name, 0) < 2:
            seen[name] = seen.get(name, 0) + 1
            first.append(c)
        if len(first) == FITTED:
            break
    return first


def _offered(
    search: Search, leaders: list[Candidate], every: list[Variable]
) -> list[tuple[Effect, dict[str, Any], Candidate]]:
    """The candidates as effects, without those that cannot act in the chain."""
    problem = search.problem
    kind = problem.case.kind
    columns = _columns(problem.case)
    ranges = {v.text: [float(v.values.min()), float(v.values.max())] for v in every if _has_range(v.text)}
    found = []
    for c in leaders:
        name = f"{NAME}_{len(found) + 1}" if found else NAME
        data = law_data(name, c, c.target.column, ranges)
        try:
            law = as_effect(data, columns)
            inputs = {**problem.forward.inputs, **columns_read([law], problem.rows.columns)}
            check_usable(law, problem.forward.chain, inputs, "reading", kind.name)
        except InputError:
            continue
        found.append((law, data, c))
    return found


def _has_range(name: str) -> bool:
    """Whether a variable is a quantity of its own, so that its range can be part of the file."""
    return re.fullmatch(r"\w+", name) is not None


def _columns(case: Case) -> list[str]:
    return [c.name for c in (*BOOKKEEPING, *case.kind.columns) if c.dtype == "number"]


def _with_laws(problem: Problem, laws: Mapping[str, Effect]) -> Problem:
    """The problem of a case that has these laws too."""
    case = replace(problem.case, laws={**problem.case.laws, **laws})
    return replace(problem, case=case, forward=problem.forward.with_laws(case))


def _levels_with(
    levels: LevelsOut, problem: Problem, laws: Mapping[str, Effect], fits: Mapping[Explanation, Fit]
) -> LevelsOut:
    """The folds of an answer, with laws and their fits."""
    search = replace(levels.search, problem=problem, fits={**levels.search.fits, **fits})
    folds = tuple(replace(f, train=_with_laws(f.train, laws), test=_with_laws(f.test, laws)) for f in levels.folds)
    return replace(levels, search=search, folds=folds, refitted={})


def _diverse(weighed: list[tuple[Any, ...]]) -> list[tuple[Any, ...]]:
    """The laws to prove: the best ones."""
    return weighed[:PROVED]


def _start(problem: Problem, key: Explanation, law: Effect, base: Fit, plain: Problem) -> np.ndarray:
    """Coordinates of the base fit and of the screened parameters."""
    own = plain.own_coordinates(base.explanation, base.z)
    parts = [base.z[: problem.calibration_size]]
    for e in problem.effects(key):
        parts.append(np.array([_coordinate(p.prior, p.usual) for p in e.parameters]) if e.id == law.id else own[e.id])
    return np.concatenate(parts)


def _coordinate(prior: Prior, value: float) -> float:
    """Standard-normal coordinate of a value under a prior of a found law."""
    from statistics import NormalDist

    if isinstance(prior, Normal):
        return (value - prior.mean) / prior.sd
    if isinstance(prior, LogNormal):
        return float(np.log(value / prior.median)) / prior.spread
    assert isinstance(prior, Uniform)
    share = (value - prior.low) / (prior.high - prior.low)
    return NormalDist().inv_cdf(min(max(share, 1e-3), 1.0 - 1e-3))


def _renamed(data: Mapping[str, Any], problem: Problem, fit: Fit) -> dict[str, Any]:
    """The file of a law with its fitted values."""
    values = problem.parameters(fit.explanation, fit.z)[data["id"]]
    parameters = {name: {**own, "value": float(f"{values[name]:.6g}")} for name, own in data["parameters"].items()}
    return {**data, "parameters": parameters}


__all__ = ["QUANTITIES", "FoundLaw", "Rival", "find_law"]
