"""The competing explanation that no effect of the catalogue is: a smooth function of the conditions.

It is a share of the reading, an addition to it, or a factor on one quantity of the chain, such as the film. Beside
smooth functions stand waves in time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.carriers import NOTHING, READING, Carriers, Typical, carriers
from mixedlub.diagnosis.features import Coordinates
from mixedlub.diagnosis.fit import Fit, Linear, linear_fit, settled
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.waves import CLOCK, frequencies, strongest

LENGTHS = (0.25, 0.7)
ROUGH = 0.08
"""Length of a form of one condition whose neighbouring levels are all but independent of one another."""
SIZES = (0.7, 2.0, 6.0, 20.0, 60.0)
"""How large a mismatch of the reading may be, in sigmas."""
FACTORS = (0.03, 0.1, 0.3, 1.0)
"""How large one of a quantity of the chain may be, in its logarithm."""
FULL = 6
SAME = {"surfaces", "composite_roughness_um"}
"""The roughness is a function of the surfaces: together they say no more than these."""


@dataclass(frozen=True)
class Shape:
    """One form an unnamed mismatch may have: along which axes, how smooth, how large, and what it rides on.

    No axes stand for all of them; most laws depend on one or two. A wave goes through ``waves`` periods of its axis.
    """

    axes: tuple[str, ...]
    length: float
    size: float
    carrier: str
    interactions: bool
    waves: float = 0.0


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


def shapes(space: Coordinates, waves: np.ndarray, carriers: Carriers) -> list[Shape]:
    """All shapes that are tried, of size one; ``waves`` are the periods over the recording."""
    found = [wave_of(w) for w in waves]
    for length in LENGTHS:
        for carrier in carriers:
            names = [axis.name for axis in space.axes]
            found.append(Shape((), length, 1.0, carrier, False))
            if len(names) == 1 and length == LENGTHS[0]:
                found.append(Shape((), ROUGH, 1.0, carrier, False))
            if len(names) > 1:
                found.append(Shape((), length, 1.0, carrier, True))
                found.extend(Shape((name,), length, 1.0, carrier, False) for name in names)
                if length == LENGTHS[0]:
                    found.extend(Shape((name,), ROUGH, 1.0, carrier, False) for name in names)
            if len(names) > 2:
                pairs = (two for two in combinations(names, 2) if set(two) != SAME)
                found.extend(Shape(two, length, 1.0, carrier, True) for two in pairs)
    return found


def wave_of(waves: float, size: float = 1.0) -> Shape:
    """A wave in time as a share of the reading."""
    return Shape((CLOCK,), 0.0, size, READING, False, float(waves))


def sizes(carrier: str) -> tuple[float, ...]:
    """The sizes that a shape on this carrier is tried with."""
    return SIZES if carrier in (READING, NOTHING) else FACTORS


def shape_columns(shape: Shape, space: Coordinates, values: list[np.ndarray], carriers: Carriers) -> np.ndarray:
    """The shape's columns in sigmas."""
    if shape.waves:
        place = space.place(shape.axes[0])
        columns = space.axes[place].wave(values[place], shape.waves)
    else:
        columns = space.columns(values, shape.length, shape.axes, shape.interactions)
    return shape.size * columns * carriers[shape.carrier][:, None]


def unknown_fit(problem: Problem, none: Fit, space: Coordinates, values: list[np.ndarray]) -> Unknown:
    """Marginal likelihood of the base model plus an unnamed smooth mismatch, averaged over its shapes.

    Which readings are outliers is settled first, under the richest shape or the clearest wave; shapes and sizes are
    then weighed with those weights, and the best few again in full.
    """
    target = none.anchor
    fixed = np.hstack([none.slopes, problem.shared])
    base = problem.run((), none.z)
    typical = Typical.of(problem, base)
    rides = carriers(problem, base, typical)

    def columns_of(shape: Shape) -> np.ndarray:
        return shape_columns(shape, space, values, rides)

    rich = Shape((), LENGTHS[0], 6.0, READING, len(space.axes) > 1)
    reference = linear_fit(target, np.hstack([fixed, columns_of(rich)]))
    periods = frequencies(space, values)
    clear = strongest(target, fixed, lambda w: columns_of(wave_of(w, rich.size)), periods)
    if clear is not None:
        periods[np.argmin(np.abs(periods - clear[0]))] = clear[0]
        reference = max(reference, clear[1], key=lambda fit: fit.evidence)
    tried: list[Shape] = []
    weighed: list[float] = []
    for shape in shapes(space, periods, rides):
        steps = sizes(shape.carrier)
        tried.extend(replace(shape, size=size) for size in steps)
        weighed.extend(_evidence_by_size(target, fixed, columns_of(shape), reference.weight, np.array(steps)))
    order = np.argsort(weighed)[::-1]
    full = {
        int(i): linear_fit(target, np.hstack([fixed, columns_of(tried[i])]), reference.weight) for i in order[:FULL]
    }
    first = int(order[0])
    offset = full[first].evidence - weighed[first]
    evidence = np.array([full[i].evidence if i in full else weighed[i] + offset for i in range(len(tried))])
    best = max(full, key=lambda i: full[i].evidence)
    own = columns_of(tried[best])
    every = np.hstack([fixed, own])
    fit = full[best]
    covariance = np.linalg.inv(np.eye(every.shape[1]) + every.T @ (every * fit.weight[:, None]))
    count = none.z.size
    errors = fit.coefficients[count : fixed.shape[1]]
    common = problem.shared @ errors
    z, beside = settled(problem, (), none.z, fit.coefficients[:count], common, lambda prediction: own, fit.weight)
    coefficients = np.concatenate([z, errors, beside.coefficients])
    return Unknown(
        evidence=_mean_over_shapes(tried, evidence),
        best=tried[best],
        carriers=rides,
        typical=typical,
        fit=replace(fit, coefficients=coefficients, residual=beside.residual, weight=beside.weight),
        covariance=covariance,
        z=z,
    )


def _mean_over_shapes(tried: list[Shape], evidence: np.ndarray) -> float:
    """Log mean evidence: half the weight on shapes of the reading, half on those inside the chain, if there are any.

    In each half those of all conditions, of one and of two, and waves weigh the same, however many there are.
    """
    groups: dict[bool, dict[tuple[int, bool], list[float]]] = {}
    for shape, value in zip(tried, evidence, strict=True):
        halves = groups.setdefault(shape.carrier in (READING, NOTHING), {})
        halves.setdefault((len(shape.axes), shape.waves > 0.0), []).append(value)
    return _log_mean([_log_mean([_log_mean(alike) for alike in half.values()]) for half in groups.values()])


def _log_mean(logs: list[float]) -> float:
    return float(np.logaddexp.reduce(logs) - np.log(len(logs)))


def _evidence_by_size(
    target: np.ndarray, fixed: np.ndarray, own: np.ndarray, weight: np.ndarray, sizes: np.ndarray
) -> np.ndarray:
    """Gaussian log evidence for each size, relative to size zero, at fixed weights."""
    scaled = fixed * weight[:, None]
    inner = np.linalg.inv(np.eye(fixed.shape[1]) + fixed.T @ scaled)
    across = scaled.T @ own
    overlap = (own * weight[:, None]).T @ own - across.T @ inner @ across
    pull = (own * weight[:, None]).T @ target - across.T @ (inner @ (scaled.T @ target))
    power, turn = np.linalg.eigh(overlap)
    power = np.maximum(power, 0.0)
    along = (turn.T @ pull) ** 2
    square = sizes[:, None] ** 2
    grown = 1.0 + square * power
    return 0.5 * (square * along / grown - np.log(grown)).sum(axis=1)
