"""The competing explanation that no effect of the catalogue is: a function of the conditions that nobody has named.

It is a share of the reading, an addition to it, or a factor on one quantity of the chain, such as the film.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.discrepancy.boxes import clearest_box
from mixedlub.diagnosis.discrepancy.modulated import ADDITIVE, READING, Carriers, Typical, carriers
from mixedlub.diagnosis.discrepancy.screening import clearest, first_look
from mixedlub.diagnosis.discrepancy.smooth import Shape, families, rich
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.inference.map_fit import Fit, Linear, covariance, linear_fit, settled, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.recording.conditions import Coordinates

FULL = 6
"""Shapes weighed again with their own weights of the readings; the others keep the distance of the quick weighing."""


@dataclass(frozen=True, eq=False)
class Unknown:
    """Evidence of the unnamed mismatch, averaged over its shapes, and its best shape's fit.

    ``carriers`` are those of the recording, counted by its ``typical`` sizes.
    """

    evidence: float
    best: Shape
    carriers: Carriers
    typical: Typical
    fit: Linear
    covariance: np.ndarray
    z: np.ndarray


def unknown_fit(
    problem: Problem, none: Fit, space: Coordinates, values: list[np.ndarray], names: Collection[str]
) -> Unknown:
    """Marginal likelihood of the base model plus an unnamed mismatch, averaged over its shapes.

    A form that is one of the ``names``, the effects that are tried, is not unnamed.

    Which readings are outliers is settled for each family of shapes by its own clearest: a smooth form takes the crests
    of a wave and the readings of a peak for outliers.
    """
    target = none.anchor
    fixed = np.hstack([none.slopes, problem.shared])
    base = problem.run(NOTHING, none.z)
    typical = Typical.of(problem, base)
    rides = carriers(problem, base, typical)

    def columns_of(shape: Shape) -> np.ndarray:
        return shape.columns(space, values, rides)

    weighed, clipped = [], first_look(target, fixed)
    for family in families(space, values, rides, names):
        if family[0].form == "smooth":
            reference = linear_fit(target, np.hstack([fixed, columns_of(rich(space))]))
        else:
            clear, reference = clearest(target, fixed, clipped, columns_of, family, lambda s: s.near(space, values))
            family = list(dict.fromkeys([*family, clear]))
        weighed.append(_weighed(target, fixed, columns_of, family, reference.weight))
    for family, cost in _boxes(clipped, space, values, rides):
        _, reference = clearest(target, fixed, clipped, columns_of, family, lambda s: [s])
        weighed.append(_weighed(target, fixed, columns_of, family, reference.weight, cost))
    best, fit = max(((each.best, each.fit) for each in weighed), key=lambda found: found[1].evidence)
    own = columns_of(best)
    every = np.hstack([fixed, own])
    spread = covariance(every, fit.weight)
    count = none.z.size
    errors = fit.coefficients[count : fixed.shape[1]]
    common = problem.shared @ errors
    z, beside = settled(problem, NOTHING, none.z, fit.coefficients[:count], common, lambda prediction: own, fit.weight)
    coefficients = np.concatenate([z, errors, beside.coefficients])
    return Unknown(
        evidence=_mean_over_shapes({shape: e for each in weighed for shape, e in each.evidence.items()}),
        best=best,
        carriers=rides,
        typical=typical,
        fit=replace(fit, coefficients=coefficients, residual=beside.residual, weight=beside.weight),
        covariance=spread,
        z=z,
    )


@dataclass(frozen=True, eq=False)
class _Weighed:
    """Log evidence of the shapes of one family in all their sizes, and the fit of the best of them."""

    evidence: dict[Shape, float]
    best: Shape
    fit: Linear


def _weighed(
    target: np.ndarray,
    fixed: np.ndarray,
    columns_of: Callable[[Shape], np.ndarray],
    family: list[Shape],
    weight: np.ndarray,
    cost: float = 0.0,
) -> _Weighed:
    """Weigh shapes at fixed weights of the readings, and the best few again in full.

    The ``cost`` is the log of how many shapes each of them was picked from.
    """
    tried: list[Shape] = []
    quick: list[float] = []
    whitened = whitening(fixed, weight)
    for shape in family:
        tried.extend(replace(shape, size=size) for size in shape.sizes)
        quick.extend(_evidence_by_size(target, whitened, columns_of(shape), np.array(shape.sizes)))
    order = np.argsort(quick)[::-1]
    full = {int(i): linear_fit(target, np.hstack([fixed, columns_of(tried[i])]), weight) for i in order[:FULL]}
    offset = full[int(order[0])].evidence - quick[order[0]]
    evidence = {s: (full[i].evidence if i in full else quick[i] + offset) - cost for i, s in enumerate(tried)}
    best = max(full, key=lambda i: full[i].evidence)
    return _Weighed(evidence, tried[best], full[best])


def _boxes(
    left: np.ndarray, space: Coordinates, values: list[np.ndarray], rides: Carriers
) -> Iterator[tuple[list[Shape], float]]:
    """The clearest box by each carrier of the reading, as a family of its own, and the log of how many are like it."""
    for carrier in (READING, ADDITIVE):
        found = clearest_box(space, values, left, rides[carrier]) if carrier in rides else None
        if found is not None:
            box, cost = found
            yield [Shape(tuple(name for name, _, _ in box), 0.0, 1.0, carrier, False, box=box)], cost


def _mean_over_shapes(tried: dict[Shape, float]) -> float:
    """Log mean evidence: half the weight on shapes of the reading, half on those inside the chain, if there are any.

    In each half those of all conditions, of one and of two, waves, and peaks and steps weigh the same, however many.
    """
    groups: dict[bool, dict[tuple[int, str], list[float]]] = {}
    for shape, value in tried.items():
        halves = groups.setdefault(shape.carrier in (READING, ADDITIVE), {})
        form = "local" if shape.at is not None else shape.form
        halves.setdefault((len(shape.axes), form), []).append(value)
    return _log_mean([_log_mean([_log_mean(alike) for alike in half.values()]) for half in groups.values()])


def _log_mean(logs: list[float]) -> float:
    return float(np.logaddexp.reduce(logs) - np.log(len(logs)))


def _evidence_by_size(
    target: np.ndarray, whitened: Callable[[np.ndarray], np.ndarray], own: np.ndarray, sizes: np.ndarray
) -> np.ndarray:
    """Gaussian log evidence for each size, relative to size zero, beside what is whitened away."""
    seen = whitened(own.T)
    power, turn = np.linalg.eigh(seen @ own)
    power = np.maximum(power, 0.0)
    along = (turn.T @ (seen @ target)) ** 2
    square = sizes[:, None] ** 2
    grown = 1.0 + square * power
    return 0.5 * (square * along / grown - np.log(grown)).sum(axis=1)
