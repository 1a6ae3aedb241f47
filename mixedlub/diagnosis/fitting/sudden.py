"""Sudden changes tried over all places where they may stand: their slope at one place tells nothing of the others."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.fitting.fit import Fit, log_likelihood
from mixedlub.diagnosis.fitting.problem import REACH, Explanation, Problem

FAR, COUNT = 3.0, 121
"""Coordinates between which a place is tried, and how often."""


def sudden_places(problem: Problem, explanation: Explanation) -> list[int]:
    """Which coordinates of an explanation are places of sudden changes."""
    parameters = [p for e in problem.effects(explanation) for p in e.parameters]
    return [i for i, p in enumerate(parameters, problem.calibration_size) if p.sudden]


def anywhere(problem: Problem, fit: Fit, place: int, more: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A fit's coordinates (m, size) with one of its places moved over the range and to ``more``, in rising order.

    With them (m) the log density of the readings and of the place.
    """
    where = np.unique(np.clip(np.append(np.linspace(-FAR, FAR, COUNT), more), -REACH, REACH))
    tried = np.repeat(fit.z[None, :], where.size, axis=0)
    tried[:, place] = where
    left = np.array([(problem.y - problem.predict(fit.explanation, z)) / problem.sd for z in tried]) - fit.common
    log = log_likelihood(left)[0].sum(axis=1) - 0.5 * where**2
    return tried, np.where(np.isfinite(log), log, -np.inf)
