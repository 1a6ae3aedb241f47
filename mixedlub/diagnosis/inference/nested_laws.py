"""Spike-and-slab prior: half of an effect's prior mass lies on exactly the published law that it contains."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.inference.change_points import integrate_change_points
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.inference.map_fit import Fit, linear_fit, log_volume, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import (
    FIT_TOLERANCE,
    HOPELESS_LAW,
    LINEAR_ROUNDS,
    MOST_COORDINATE,
    NESTED_TOLERANCE,
    OUTLIER_WEIGHT,
    SPIKE,
)


def published_odds(
    problem: Problem, free: Fit, worst: float = np.inf, tolerance: float = FIT_TOLERANCE
) -> Iterator[tuple[str, str, float]]:
    """Effect, law and log odds of each law that an explanation's effects contain against all parameters free.

    The rest of the explanation is fitted again, its change points integrated. Log odds beyond ``worst`` against the law
    need not be resolved.
    """
    for effect, law, nested, kept in _nested(problem, free):
        fit = _nested_fit(nested, free, kept, worst, tolerance)
        yield effect, law, integrate_change_points(nested, fit).evidence - free.evidence


def published_gain(problem: Problem, free: Fit) -> float:
    """Change of an explanation's log evidence by the published laws of its effects; at least -log 2 for each effect.

    A published law must not be lost to free parameters that the readings do not need.
    """
    return _gain((effect, odds) for effect, _, odds in published_odds(problem, free, HOPELESS_LAW, NESTED_TOLERANCE))


def linearised_gain(problem: Problem, free: Fit) -> float:
    """Estimate of `published_gain` with the slopes of a free fit without change points."""
    found = ((effect, _linearised(nested, free, kept)[1]) for effect, _, nested, kept in _nested(problem, free))
    return _gain((effect, evidence - free.evidence) for effect, evidence in found)


def _gain(found: Iterable[tuple[str, float]]) -> float:
    odds: dict[str, list[float]] = {}
    for effect, log_odds in found:
        odds.setdefault(effect, []).append(log_odds)
    return sum(
        float(np.logaddexp(np.log1p(-SPIKE), np.log(SPIKE / len(logs)) + np.logaddexp.reduce(logs)))
        for logs in odds.values()
    )


def _nested(problem: Problem, free: Fit) -> Iterator[tuple[str, str, Problem, np.ndarray]]:
    """Effect, law, problem with the law's parameters fixed, and places of the other coordinates in the free fit."""
    place = problem.calibration_size
    for e in problem.effects(free.explanation):
        names = [p.name for p in e.parameters]
        for law, values in e.laws_within_reach.items():
            drop = [place + names.index(name) for name in values]
            nested = replace(problem, fixed={**problem.fixed, e.id: {**problem.fixed.get(e.id, {}), **values}})
            yield e.id, law, nested, np.delete(np.arange(free.z.size), drop)
        place += len(names)


def _linearised(nested: Problem, free: Fit, kept: np.ndarray) -> tuple[np.ndarray, float]:
    """Coordinates of the rest and log evidence there, the best of the free fit's and of rounds with its slopes.

    The slopes only find the coordinates; the misfit is by the nonlinear laws.
    """
    z, slopes = free.z[kept], free.slopes[:, kept]
    columns = np.hstack([slopes, nested.shared])
    found = [(z, -np.inf)]
    for _ in range(LINEAR_ROUNDS + 1):
        residual = (nested.y - nested.predict(free.explanation, z)) / nested.sd
        if not np.isfinite(residual).all():
            break
        shared = linear_fit(residual, nested.shared, free.weight)
        squares = float(z @ z + shared.coefficients @ shared.coefficients)
        volume = log_volume(columns, shared.weight)
        found.append((z, float(log_likelihood(shared.residual)[0].sum()) - 0.5 * (squares + volume)))
        linear = linear_fit(residual + slopes @ z, columns, shared.weight)
        z = np.clip(linear.coefficients[: z.size], -MOST_COORDINATE, MOST_COORDINATE)
    return max(found, key=lambda one: one[1])


def _nested_fit(nested: Problem, free: Fit, kept: np.ndarray, worst: float, tolerance: float) -> Fit:
    """Fit the rest of an explanation again, also from a distant start if the near start has more outliers."""
    fit = map_fit(
        nested,
        free.explanation,
        _linearised(nested, free, kept)[0],
        warm=True,
        slopes=free.slopes[:, kept],
        rival=free.evidence,
        hopeless=worst,
        tolerance=tolerance,
    )
    if fit.evidence < free.evidence - worst or np.count_nonzero(fit.weight < OUTLIER_WEIGHT) <= np.count_nonzero(
        free.weight < OUTLIER_WEIGHT
    ):
        return fit
    return max(fit, map_fit(nested, free.explanation, free.z[kept]), key=lambda one: one.evidence)
