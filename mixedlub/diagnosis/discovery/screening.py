"""Screening of laws on the linearised model: every term on every quantity of the chain or of the reading."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.discovery.past_terms import is_bounded, past_products
from mixedlub.diagnosis.discovery.terms import Term, Variable, bounded_terms, single_terms
from mixedlub.diagnosis.discrepancy.modulated import log_slope
from mixedlub.diagnosis.inference.map_fit import whitening
from mixedlub.diagnosis.search.search import Search, spread_rows
from mixedlub.diagnosis.settings.discovery import (
    KEPT_OF_TARGET,
    OTHER_SHAPES,
    PRODUCT_PRIOR,
    SCREENED_ROWS,
    SUM_PRIOR,
)
from mixedlub.diagnosis.settings.discrepancy import NO_INFLUENCE, READING_SIZES
from mixedlub.recording.conditions import PASSING

QUANTITIES = {
    "film_thickness": "film",
    "viscosity": "property",
    "pressure_viscosity": "property",
    "shear_stress": "shear",
    "area_ratio": "contact",
    "boundary_friction": "boundary",
    "running_friction": "boundary",
    "friction": "boundary",
    "line_load": "load",
    "load_share": "load",
    "reading": "loss",
}
"""Quantities on which a law may act, with their stage."""
READING = "reading"
ADDED = ("friction", READING)
"""Quantities to which a term may be added."""
FACTOR, ADD, REPLACE = "factor", "add", "replace"


@dataclass(frozen=True, eq=False)
class Target:
    """A quantity, the form of the change, and the change of each reading in sd by a unit of it.

    ``constant``: value in SI in place of the quantity.
    """

    quantity: str
    form: str
    column: np.ndarray
    constant: float = 1.0


@dataclass(frozen=True, eq=False)
class Candidate:
    """A law to be fitted: target, one term or the sum of two, their amplitudes, and its log posterior over none."""

    target: Target
    terms: tuple[Term, ...]
    amplitudes: tuple[float, ...]
    score: float

    @property
    def kind(self) -> tuple[str, ...]:
        """Shapes and variables, which distinguish laws."""
        return tuple(sorted(f"{t.shape} of {' and '.join(t.variables)}" for t in self.terms))

    def is_bounded_by(self, name: str) -> bool:
        """Whether the law holds where a variable was recorded: it reads it, or undoes its part of the base model."""
        undone = self.target.form == REPLACE and name not in PASSING
        return undone or any(name in term.read for term in self.terms)


def targets(search: Search) -> list[Target]:
    """Every quantity on which the readings depend, as factor and as addition."""
    problem, fit = search.problem, search.discrepancy.base
    run = problem.run(fit.explanation, fit.z)
    found = []
    for name in QUANTITIES:
        if name == "reading":
            level = problem.inverse(run.prediction) / problem.d_inverse(run.prediction)
            slope: np.ndarray | None = np.asarray(level)
        else:
            slope = log_slope(problem, run, name)
        if slope is None:
            continue
        column = np.nan_to_num(slope / problem.sd, posinf=0.0, neginf=0.0)
        if np.max(np.abs(column)) <= NO_INFLUENCE:
            continue
        found.append(Target(name, FACTOR, column))
        if name in ADDED:
            if name == "reading":
                size = problem.inverse(run.prediction) / problem.forward.scale
            else:
                state = problem.forward.model((name,))(run.inputs, run.record.values)[name]
                size = np.atleast_2d(np.asarray(state, float)).mean(axis=-1)
            with np.errstate(all="ignore"):
                added = np.nan_to_num(column / size, posinf=0.0, neginf=0.0)
            found.append(Target(name, ADD, added))
    return found


def price(c: Candidate, count: int) -> float:
    """Log prior of a law: half of a term's prior is on powers, the rest on other shapes, over ``count`` variables."""
    found = np.log(SUM_PRIOR) * (len(c.terms) - 1)
    for term in c.terms:
        shapes = term.shape.split(" x ")
        found += np.log(PRODUCT_PRIOR) * (len(shapes) - 1)
        found += sum(np.log(0.5) if "power" in shape else np.log(0.5 / OTHER_SHAPES) for shape in shapes)
        found -= len(term.variables) * np.log(count)
    return float(found)


def screened(search: Search, every: Sequence[Variable], past: Sequence[Term] = ()) -> list[Candidate]:
    """Candidates by their log posterior over none, best first; ``past``: terms of the history of conditions."""
    problem, base = search.problem, search.discrepancy.base
    rows = spread_rows(search.values, problem.y.size, SCREENED_ROWS)
    fixed = np.hstack([base.slopes, problem.shared])[rows]
    weight, target = search.discrepancy.fit.weight[rows], base.anchor[rows]
    singles = [*(term for v in every for term in single_terms(v)), *past]
    few = {v.text: bounded_terms(v) for v in every if v.text not in PASSING}
    products = [
        one.times(two)
        for first, second in combinations(few.values(), 2)
        for one in first
        for two in second
        if set(one.variables).isdisjoint(two.variables)
    ] + past_products(past, [v for v in every if v.text in few])
    added = [*(term for terms in few.values() for term in terms), *filter(is_bounded, past)]
    flat = constant_term(problem.y.size)
    found: list[Candidate] = []
    whitened = _Whitened(fixed, weight, target)
    for t in targets(search):
        groups = [(added if t.form == ADD else singles, 0.0), (products, np.log(PRODUCT_PRIOR))]
        groups = [([flat], 0.0), *groups] if t.form == ADD else groups
        best: list[Candidate] = []
        for terms, prior in groups:
            if not terms:
                continue
            columns = np.array([term.values[rows] for term in terms]) * t.column[rows]
            evidence, amplitude = whitened.evidence(columns)
            score = evidence - np.log(len(terms)) + prior
            for i in np.argsort(-score, kind="stable")[: 4 * KEPT_OF_TARGET]:
                best.append(Candidate(t, (terms[i],), (float(amplitude[i]),), float(score[i])))
        best.sort(key=lambda c: -c.score)
        found += best
        seconds = [flat, *added] if t.form == ADD else singles
        found += _sums(t, [c for c in best if len(c.terms[0].variables) < 2], seconds, fixed, weight, target, rows)
    return sorted(found, key=lambda c: -c.score)


def _sums(
    t: Target,
    singles: Sequence[Candidate],
    terms: Sequence[Term],
    fixed: np.ndarray,
    weight: np.ndarray,
    target: np.ndarray,
    rows: np.ndarray,
) -> list[Candidate]:
    """Sums of two terms of a target: the first is the power of each variable, or one of the best terms."""
    own = t.column[rows]
    columns = np.array([term.values[rows] for term in terms]) * own
    alone = _Whitened(fixed, weight, target)
    evidence, amplitude = alone.evidence(columns)
    firsts: dict[tuple[str, ...], int] = {}
    for i in np.argsort(-evidence, kind="stable"):
        kind = Candidate(t, (terms[i],), (0.0,), 0.0).kind
        if terms[i].shape == "power" or len(firsts) < KEPT_OF_TARGET:
            firsts.setdefault(kind, int(i))
    found: list[Candidate] = []
    for i in firsts.values():
        first = columns[i][:, None]
        scale = READING_SIZES[-1] / max(float(np.sqrt(np.mean(first**2))), 1e-300)
        more, second = _Whitened(np.hstack([fixed, scale * first]), weight, target).evidence(columns)
        score = evidence[i] + more - 2.0 * np.log(len(terms)) + np.log(SUM_PRIOR)
        kinds: set[str] = set()
        for k in np.argsort(-score, kind="stable"):
            own_kind = f"{terms[k].shape} {terms[k].variables}"
            if own_kind not in kinds and (k != i or terms[k].start):
                kinds.add(own_kind)
                both = (terms[i].numbered(1), terms[k].numbered(2))
                found.append(Candidate(t, both, (float(amplitude[i]), float(second[k])), float(score[k])))
            if len(kinds) == KEPT_OF_TARGET:
                break
    return found


class _Whitened:
    """Evidence of single columns beside fixed columns with standard-normal priors."""

    def __init__(self, fixed: np.ndarray, weight: np.ndarray, target: np.ndarray) -> None:
        self.whiten, self.target = whitening(fixed, weight), target

    def evidence(self, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Log evidence of each column over none, averaged over sizes, and its amplitude."""
        size = np.sqrt(np.mean(columns**2, axis=1))
        size = np.where(size > 0.0, size, np.inf)
        each = columns / size[:, None]
        white = self.whiten(each)
        power = np.maximum(np.einsum("ij,ij->i", white, each), 1e-12)
        pull = white @ self.target
        square = np.array(READING_SIZES)[:, None] ** 2
        grown = 1.0 + square * power
        value = 0.5 * (square * pull**2 / grown - np.log(grown))
        log_evidence = np.logaddexp.reduce(value, axis=0) - np.log(len(READING_SIZES))
        return log_evidence, pull / (power + 1.0 / READING_SIZES[-1] ** 2) / size


def constant_term(count: int) -> Term:
    """The term one."""
    return Term("constant", (), "1", {}, {}, np.ones(count))
