"""Candidates fitted through the whole model, as laws of their own."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.priors import LogNormal, Normal, Prior, Uniform
from mixedlub.diagnosis.discovery.files import LETTERS, as_effect, law_data
from mixedlub.diagnosis.discovery.screening import ADD, Candidate, Target, price
from mixedlub.diagnosis.discovery.terms import Variable
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import Fit, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search
from mixedlub.own_laws import check_usable
from mixedlub.running.parallel import shared_out
from mixedlub.schema.past import past_of
from profiles.errors import InputError

NAME = "found_law"
"""Id of a found law."""


@dataclass(frozen=True, eq=False)
class Weighed:
    """A fitted law: log evidence plus log prior, fit, effect, and the file with the fitted values."""

    log_weight: float
    fit: Fit
    effect: Effect
    data: Mapping[str, Any]
    candidate: Candidate


def by_weight(w: Weighed) -> float:
    """Key that sorts fitted laws, the best first."""
    return -w.log_weight


def on_other_quantities(w: Weighed, search: Search, tried: list[Candidate]) -> list[Candidate]:
    """The form of a fitted law on every other quantity, from the fitted parameters."""
    values = with_laws(search.problem, {w.effect.id: w.effect}).parameters(w.fit.explanation, w.fit.z)[w.effect.id]
    own = w.candidate.target
    found: list[Candidate] = []
    seen: list[Target] = []
    terms = tuple(replace(t, start={name: float(values[name]) for name in t.start}) for t in w.candidate.terms)
    for target in (c.target for c in tried):
        if target is own or any(target is one for one in seen):
            continue
        seen.append(target)
        if target.form == ADD and any(t.shape in ("power", "threshold") for t in terms):
            continue
        ratio = float(own.column @ target.column / (target.column @ target.column))
        amplitudes = tuple(ratio * float(values[letter]) for letter in LETTERS[: len(terms)])
        found.append(Candidate(target, terms, amplitudes, w.candidate.score))
    return found


def fitted_laws(search: Search, every: list[Variable], candidates: list[Candidate], before: int = 0) -> list[Weighed]:
    """Candidates fitted through the whole model, best first; ``before``: laws that have their ids."""
    offered = _offered(search, candidates, every, before)
    own = with_laws(search.problem, {law.id: law for law, _, _ in offered})
    base = search.discrepancy.base.explanation
    start = search.fits.get(base, search.null_fit)

    def fitted(item: tuple[Effect, dict[str, Any], Candidate]) -> Fit | None:
        key = Explanation.of(*base.effects, item[0].id)
        try:
            return map_fit(own, key, _start(own, key, item[0], start, search.problem), warm=True)
        except np.linalg.LinAlgError:
            return None

    found = [
        Weighed(fit.evidence + price(c, len(every)), fit, law, valued(data, own, fit), c)
        for fit, (law, data, c) in zip(shared_out(fitted, offered), offered, strict=True)
        if fit is not None and np.isfinite(fit.evidence)
    ]
    return sorted(found, key=by_weight)


def _offered(
    search: Search, leaders: list[Candidate], every: list[Variable], before: int
) -> list[tuple[Effect, dict[str, Any], Candidate]]:
    """The candidates as effects, without laws that cannot act in the chain."""
    problem = search.problem
    kind = problem.case.kind
    ranges = {v.text: [float(v.values.min()), float(v.values.max())] for v in every if _has_range(v.text, kind.numbers)}
    found: list[tuple[Effect, dict[str, Any], Candidate]] = []
    for c in leaders:
        number = before + len(found) + 1
        # A law found earlier, and now part of the base model, keeps its id.
        stem = f"{NAME}{len(problem.case.laws) or ''}"
        name = f"{stem}_{number}" if number > 1 else stem
        data = law_data(name, c, c.target.column, ranges)
        try:
            law = as_effect(data, kind.numbers)
            inputs = {**problem.forward.inputs, **problem.forward.columns_of([law])}
            check_usable(law, problem.forward.chain, inputs, "reading", kind.name)
        except InputError:
            continue
        found.append((law, data, c))
    return found


def _has_range(name: str, columns: Collection[str]) -> bool:
    """Whether a variable is a single present quantity, so that its range can be part of the file."""
    return re.fullmatch(r"\w+", name) is not None and past_of(name, columns) is None


def with_laws(problem: Problem, laws: Mapping[str, Effect]) -> Problem:
    """The problem of a case that has these laws too."""
    case = replace(problem.case, laws={**problem.case.laws, **laws})
    return replace(problem, case=case, forward=problem.forward.with_laws(case))


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


def valued(data: Mapping[str, Any], problem: Problem, fit: Fit) -> dict[str, Any]:
    """The file of a law with its fitted values."""
    values = problem.parameters(fit.explanation, fit.z)[data["id"]]
    parameters = {name: {**own, "value": float(f"{values[name]:.6g}")} for name, own in data["parameters"].items()}
    return {**data, "parameters": parameters}
