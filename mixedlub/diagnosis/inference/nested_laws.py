"""Spike-and-slab prior: half of an effect's prior mass lies on exactly the published law that it contains."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.inference.change_points import integrate_change_points
from mixedlub.diagnosis.inference.map_fit import Fit, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import FIT_TOLERANCE, HOPELESS_LAW, NESTED_TOLERANCE, OUTLIER_WEIGHT, SPIKE


def published_odds(
    problem: Problem, free: Fit, worst: float = np.inf, tolerance: float = FIT_TOLERANCE
) -> Iterator[tuple[str, str, float]]:
    """Effect, law and log odds of each law that an explanation's effects contain against all parameters free.

    The rest of the explanation is fitted again, its change points integrated. Log odds beyond ``worst`` against the law
    need not be resolved.
    """
    place = problem.calibration_size
    for e in problem.effects(free.explanation):
        names = [p.name for p in e.parameters]
        for law, values in e.laws_within_reach.items():
            drop = [place + names.index(name) for name in values]
            nested = replace(problem, fixed={**problem.fixed, e.id: {**problem.fixed.get(e.id, {}), **values}})
            fit = _nested_fit(nested, free, drop, worst, tolerance)
            yield e.id, law, integrate_change_points(nested, fit).evidence - free.evidence
        place += len(names)


def _nested_fit(nested: Problem, free: Fit, drop: list[int], worst: float, tolerance: float) -> Fit:
    """Fit the rest of an explanation again, also from a distant start if the near start has more outliers."""
    start, slopes = np.delete(free.z, drop), np.delete(free.slopes, drop, axis=1)
    fit = map_fit(
        nested,
        free.explanation,
        start,
        warm=True,
        slopes=slopes,
        rival=free.evidence,
        hopeless=worst,
        tolerance=tolerance,
    )
    if fit.evidence < free.evidence - worst or np.count_nonzero(fit.weight < OUTLIER_WEIGHT) <= np.count_nonzero(
        free.weight < OUTLIER_WEIGHT
    ):
        return fit
    return max(fit, map_fit(nested, free.explanation, start), key=lambda one: one.evidence)


def published_gain(problem: Problem, free: Fit) -> float:
    """Change of an explanation's log evidence by the published laws of its effects; at least -log 2 for each effect.

    A published law must not be lost to free parameters that the readings do not need.
    """
    odds: dict[str, list[float]] = {}
    for name, _, log_odds in published_odds(problem, free, HOPELESS_LAW, NESTED_TOLERANCE):
        odds.setdefault(name, []).append(log_odds)
    return sum(
        float(np.logaddexp(np.log1p(-SPIKE), np.log(SPIKE / len(logs)) + np.logaddexp.reduce(logs)))
        for logs in odds.values()
    )
