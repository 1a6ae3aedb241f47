"""Model discrepancy: a function of the conditions without physics, weighed against the effects.

It is relative to the reading, added to it, or a factor on one quantity of the chain, such as film thickness.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.discrepancy.boxes import clearest_box
from mixedlub.diagnosis.discrepancy.modulated import ADDITIVE, READING, Scalings, TypicalSizes, scalings_of
from mixedlub.diagnosis.discrepancy.past import remembered_in
from mixedlub.diagnosis.discrepancy.screening import clearest, first_look
from mixedlub.diagnosis.discrepancy.smooth import DiscrepancyForm, candidate_forms, most_flexible
from mixedlub.diagnosis.inference.map_fit import Fit, Linear, covariance, damped_update, linear_fit, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.discrepancy import FITTED_IN_FULL
from mixedlub.recording.conditions import Coordinates


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """Evidence of the discrepancy, averaged over its forms, and the fit of its best form.

    It adds to the model of ``base``: nothing missing, or other laws of the base chain. ``scalings`` refer to the
    recording, in units of its ``typical`` sizes.
    """

    base: Fit
    evidence: float
    best: DiscrepancyForm
    scalings: Scalings
    typical: TypicalSizes
    fit: Linear
    covariance: np.ndarray
    z: np.ndarray


def fit_discrepancy(
    problem: Problem, base: Fit, space: Coordinates, values: list[np.ndarray], names: Collection[str]
) -> Discrepancy:
    """Marginal likelihood of a fitted model plus a discrepancy, averaged over its forms.

    Forms that are effects among ``names`` are left out. Each family of forms decides on outliers by its best form: a
    smooth form would take the crests of a wave, or the readings of a peak, for outliers.
    """
    target = base.anchor
    fixed = np.hstack([base.slopes, problem.shared])
    run = problem.run(base.explanation, base.z)
    typical = TypicalSizes.of(problem, run)
    pasts = remembered_in(space, values, problem.forward)
    scalings = {**scalings_of(problem, run, typical), **{past.key: factor for past, factor in pasts.items()}}

    def columns_of(shape: DiscrepancyForm) -> np.ndarray:
        return shape.columns(space, values, scalings)

    weighed, clipped = [], first_look(target, fixed)
    for family in candidate_forms(space, values, scalings, names, pasts):
        if family[0].form == "smooth":
            reference = linear_fit(target, np.hstack([fixed, columns_of(most_flexible(space))]))
        else:
            clear, reference = clearest(target, fixed, clipped, columns_of, family, lambda s: s.near(space, values))
            family = list(dict.fromkeys([*family, clear]))
        weighed.append(_family_evidence(target, fixed, columns_of, family, reference.weight))
    for family, cost in _boxes(clipped, space, values, scalings):
        _, reference = clearest(target, fixed, clipped, columns_of, family, lambda s: [s])
        weighed.append(_family_evidence(target, fixed, columns_of, family, reference.weight, cost))
    best, fit = max(((each.best, each.fit) for each in weighed), key=lambda pair: pair[1].evidence)
    form_columns = columns_of(best)
    all_columns = np.hstack([fixed, form_columns])
    spread = covariance(all_columns, fit.weight)
    count = base.z.size
    errors = fit.coefficients[count : fixed.shape[1]]
    common = problem.shared @ errors
    z, refitted = damped_update(
        problem, base.explanation, base.z, fit.coefficients[:count], common, lambda _: form_columns, fit.weight
    )
    coefficients = np.concatenate([z, errors, refitted.coefficients])
    return Discrepancy(
        base=base,
        evidence=_mean_over_shapes({shape: e for each in weighed for shape, e in each.evidence.items()}),
        best=best,
        scalings=scalings,
        typical=typical,
        fit=replace(fit, coefficients=coefficients, residual=refitted.residual, weight=refitted.weight),
        covariance=spread,
        z=z,
    )


@dataclass(frozen=True, eq=False)
class _FamilyEvidence:
    """Log evidence of the forms of one family in all sizes, and the fit of the best one."""

    evidence: dict[DiscrepancyForm, float]
    best: DiscrepancyForm
    fit: Linear


def _family_evidence(
    target: np.ndarray,
    fixed: np.ndarray,
    columns_of: Callable[[DiscrepancyForm], np.ndarray],
    family: list[DiscrepancyForm],
    weight: np.ndarray,
    cost: float = 0.0,
) -> _FamilyEvidence:
    """Evidence of forms at fixed weights, of the best few in full, less ``cost``, the log number of competing forms."""
    tried: list[DiscrepancyForm] = []
    quick: list[float] = []
    whitened = whitening(fixed, weight)
    for shape in family:
        tried.extend(replace(shape, size=size) for size in shape.sizes)
        quick.extend(evidence_by_size(target, whitened, columns_of(shape), np.array(shape.sizes)))
    order = np.argsort(quick)[::-1]
    full = {
        int(i): linear_fit(target, np.hstack([fixed, columns_of(tried[i])]), weight) for i in order[:FITTED_IN_FULL]
    }
    offset = full[int(order[0])].evidence - quick[order[0]]
    evidence = {s: (full[i].evidence if i in full else quick[i] + offset) - cost for i, s in enumerate(tried)}
    best = max(full, key=lambda i: full[i].evidence)
    return _FamilyEvidence(evidence, tried[best], full[best])


def _boxes(
    residual: np.ndarray, space: Coordinates, values: list[np.ndarray], scalings: Scalings
) -> Iterator[tuple[list[DiscrepancyForm], float]]:
    """The best relative and the best additive box, each as a family, with the log of the number of such boxes."""
    for modulated in (READING, ADDITIVE):
        clearest = clearest_box(space, values, residual, scalings[modulated]) if modulated in scalings else None
        if clearest is not None:
            box, cost = clearest
            yield [DiscrepancyForm(tuple(name for name, _, _ in box), 0.0, 1.0, modulated, False, box=box)], cost


def _mean_over_shapes(tried: dict[DiscrepancyForm, float]) -> float:
    """Log mean evidence: half the prior on forms of the reading, half on forms within the chain, if any.

    Within each half every kind of form (of all conditions, of one, of two, waves, local, history) has the same prior.
    """
    groups: dict[bool, dict[tuple[int, str], list[float]]] = {}
    for shape, value in tried.items():
        halves = groups.setdefault(shape.modulates in (READING, ADDITIVE), {})
        form = "local" if shape.at is not None else shape.form
        count = 0 if shape.past is not None else len(shape.axes)
        halves.setdefault((count, form), []).append(value)
    return _log_mean([_log_mean([_log_mean(logs) for logs in half.values()]) for half in groups.values()])


def _log_mean(logs: list[float]) -> float:
    return float(np.logaddexp.reduce(logs) - np.log(len(logs)))


def evidence_by_size(
    target: np.ndarray, whitened: Callable[[np.ndarray], np.ndarray], columns: np.ndarray, sizes: np.ndarray
) -> np.ndarray:
    """Gaussian log evidence for each size, relative to size zero."""
    whitened_columns = whitened(columns.T)
    power, vectors = np.linalg.eigh(whitened_columns @ columns)
    power = np.maximum(power, 0.0)
    projected = (vectors.T @ (whitened_columns @ target)) ** 2
    square = sizes[:, None] ** 2
    grown = 1.0 + square * power
    return 0.5 * (square * projected / grown - np.log(grown)).sum(axis=1)
