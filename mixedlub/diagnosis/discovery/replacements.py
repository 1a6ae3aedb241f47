"""Replacements: a quantity of the chain is a constant times powers of one or two variables, whatever the base model."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from mixedlub.case.forward import Run
from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.priors import Normal
from mixedlub.diagnosis.discovery.screening import (
    QUANTITIES,
    READING,
    REPLACE,
    Candidate,
    Target,
    constant_term,
)
from mixedlub.diagnosis.discovery.terms import Variable, single_terms
from mixedlub.diagnosis.inference.map_fit import log_volume, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search, spread_rows
from mixedlub.diagnosis.settings.assessment import VARIED_FROM
from mixedlub.diagnosis.settings.discovery import EXPONENT_SD, LOG_FACTOR_SD, SCREENED_ROWS
from mixedlub.diagnosis.settings.discrepancy import NO_INFLUENCE
from mixedlub.diagnosis.settings.inference import FINITE_STEP
from mixedlub.recording.conditions import PASSING


def replacements(search: Search, every: Sequence[Variable]) -> list[Candidate]:
    """Replacements by their log posterior over none, best first, on models linear about a constant quantity."""
    problem, base = search.problem, search.discrepancy.base
    rows = spread_rows(search.values, problem.y.size, SCREENED_ROWS)
    run = problem.run(base.explanation, base.z)
    fixed, weight = np.hstack([base.slopes, problem.shared])[rows], search.discrepancy.fit.weight[rows]
    _, before = _whitened(base.anchor[rows], fixed, weight)
    powers = [t for v in every if v.text not in PASSING for t in single_terms(v) if t.shape == "power"]
    found: list[Candidate] = []
    for name in QUANTITIES:
        held = None if name == READING else _held(problem, run, name)
        if held is None:
            continue
        target, change = held
        slope = target.column[rows]
        others = [t for t in powers if name not in t.read]
        for few in ((), *((t,) for t in others), *combinations(others, 2)):
            terms = (constant_term(problem.y.size), *few)
            sds = np.array([LOG_FACTOR_SD, *(EXPONENT_SD for _ in few)])
            columns = np.column_stack([t.values[rows] * slope for t in terms]) * sds
            white, evidence = _whitened(base.anchor[rows] - change[rows], np.hstack([fixed, columns]), weight)
            amplitudes = sds * (columns.T @ white)
            choices = len(few) * np.log(max(len(others), 1))
            found.append(Candidate(target, terms, tuple(map(float, amplitudes)), float(evidence - before - choices)))
    return sorted(found, key=lambda c: -c.score)


def _whitened(target: np.ndarray, columns: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, float]:
    """A target times the inverse covariance of noise plus columns, and its log evidence up to a constant."""
    white = whitening(columns, weight)(target[None])[0]
    return white, -0.5 * (float(target @ white) + log_volume(columns, weight))


def _held(problem: Problem, run: Run, name: str) -> tuple[Target, np.ndarray] | None:
    """A quantity held constant, and changes of readings in sd; None without effect or variation."""
    forward = problem.forward
    if name not in forward.inputs and name not in {step for step, _ in forward.chain}:
        return None
    state = forward.model((name,))(run.inputs, run.record.values)[name]
    size = np.atleast_2d(np.asarray(state, float)).mean(axis=-1)
    if not (size > 0.0).all() or np.ptp(np.log(size)) < VARIED_FROM:
        return None
    middle = float(f"{np.exp(np.mean(np.log(size))):.4g}")
    model = forward.model(("reading",), (_held_at(name, middle),))

    def seen(log_factor: float) -> np.ndarray:
        reading = np.asarray(model(run.inputs, {**run.record.values, "held": {"log_factor": log_factor}})["reading"])
        return problem.transform(np.broadcast_to(reading, (problem.y.size, 1))[:, 0] * forward.scale)

    with np.errstate(all="ignore"):
        there, moved = seen(0.0), seen(FINITE_STEP)
    column, change = (moved - there) / FINITE_STEP / problem.sd, (there - run.prediction) / problem.sd
    if not np.isfinite(column + change).all() or np.max(np.abs(column)) <= NO_INFLUENCE:
        return None
    return Target(name, REPLACE, column, middle), change


def _held_at(name: str, constant: float) -> Effect:
    def held(quantity: np.ndarray, *, log_factor: float) -> np.ndarray:
        return np.full_like(np.asarray(quantity, float), constant * np.exp(log_factor))

    return Effect(
        name="held",
        law=held,
        stage="property",
        acts_on=(name,),
        parameters=(Parameter("log_factor", "-", Normal(0.0, 1.0), "logarithm of the constant over its start"),),
        fingerprint={},
        separated_by="",
    )
