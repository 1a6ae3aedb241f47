"""Sudden changes tried over all places where they may stand: their slope at one place tells nothing of the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import NINETY, Fit, covariance, log_likelihood, map_fit
from mixedlub.diagnosis.problem import REACH, Problem

FAR, COUNT = 3.0, 121
"""Coordinates between which a place is tried, and how often."""
HALVED, STEP, NEVER = 12, 0.7, 15.0
"""How often the gap between two places is halved, from what change of the log density on, and what is never so."""
BETTER = 0.5
"""Gain in log density from which another place is climbed from."""
SHARES = (np.arange(20) + 0.5) / 20.0
"""Shares of the chance of a place below those that stand for all."""


@dataclass(frozen=True, eq=False)
class Places:
    """Where the change at coordinate ``index`` of a fit may stand: steps (m, size) of its coordinates to there.

    ``where`` are the places, in rising order, ``chance`` is that of each.
    """

    index: int
    where: np.ndarray
    steps: np.ndarray
    chance: np.ndarray

    def at(self, share: float) -> float:
        """The place below which the change stands with a chance of ``share``.

        >>> Places(0, np.array([0.0, 1.0, 2.0]), np.zeros((3, 1)), np.array([0.25, 0.5, 0.25])).at(0.5)
        1.0
        """
        return float(np.interp(share, self._below, self.where))

    @property
    def even(self) -> np.ndarray:
        """Steps (20, size) to places of equal chance."""
        return np.stack([np.interp(SHARES, self._below, step) for step in self.steps.T], axis=1)

    @property
    def variance(self) -> np.ndarray:
        """Variance of every coordinate by where the change stands."""
        return np.asarray(self.chance @ (self.steps - self.chance @ self.steps) ** 2)

    @property
    def _below(self) -> np.ndarray:
        return np.cumsum(self.chance) - 0.5 * self.chance


def sudden_places(problem: Problem, explanation: Explanation) -> list[int]:
    """Which coordinates of an explanation are places of sudden changes."""
    parameters = [p for e in problem.effects(explanation) for p in e.parameters]
    return [i for i, p in enumerate(parameters, problem.calibration_size) if p.sudden]


def anywhere(
    problem: Problem,
    fit: Fit,
    place: int,
    more: np.ndarray,
    follow: np.ndarray | None = None,
    beside: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """A fit's coordinates (m, size) with one of its places moved over the range and to ``more``, in rising order.

    With them (m) the log density of the readings and of what is moved. Where that changes much places stand closer.
    The other coordinates stay, or ``follow`` by so much each where the readings like that better; columns fitted
    ``beside`` take up what they can.
    """
    still = np.eye(fit.z.size)[place]
    ways = [still] if follow is None else [still, follow]
    columns = np.zeros((problem.y.size, 0)) if beside is None else beside
    weighted = columns.T * fit.weight
    taken = np.linalg.solve(np.eye(columns.shape[1]) + weighted @ columns, weighted)

    def told(where: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        every = [np.clip(fit.z + np.outer(where - fit.z[place], way), -REACH, REACH) for way in ways]
        logs = np.array([[density(z) for z in tried] for tried in every])
        return np.array(every)[logs.argmax(axis=0), np.arange(where.size)], logs.max(axis=0)

    def density(z: np.ndarray) -> float:
        left = (problem.y - problem.predict(fit.explanation, z)) / problem.sd - fit.common
        own = taken @ left
        squares = float(z @ z - fit.z @ fit.z + fit.z[place] ** 2 + own @ own)
        log = float(log_likelihood(left - columns @ own)[0].sum()) - 0.5 * squares
        return log if np.isfinite(log) else -np.inf

    where = np.unique(np.clip(np.append(np.linspace(-FAR, FAR, COUNT), more), -REACH, REACH))
    tried, log = told(where)
    for _ in range(HALVED):
        steep = np.abs(np.diff(np.maximum(log, log.max() - NEVER))) > STEP
        if not steep.any():
            break
        between, its_log = told(0.5 * (tried[1:, place] + tried[:-1, place])[steep])
        tried, log = np.vstack([tried, between]), np.append(log, its_log)
        order = np.argsort(tried[:, place], kind="stable")
        tried, log = tried[order], log[order]
    return tried, log


def placed(problem: Problem, fit: Fit) -> Fit:
    """The fit with the evidence of all places where its sudden changes may stand: Laplace sees but the slope at one.

    Where another place is more probable the fit climbs anew from there: between two readings a slope leads no further.
    """
    gained = 0.0
    for place in sudden_places(problem, fit.explanation):
        tried, log = anywhere(problem, fit, place, fit.z[[place]])
        if log.max() > _height(fit, place) + BETTER:
            again = map_fit(problem, fit.explanation, tried[np.argmax(log)], warm=True)
            if _height(again) > _height(fit) + BETTER:
                return placed(problem, again)
        curvature = 1.0 + float(fit.weight @ fit.slopes[:, place] ** 2)
        whole = np.trapezoid(np.exp(np.minimum(log - _height(fit, place), 50.0)), tried[:, place])
        gained += float(np.log(max(whole, 1e-300)) - 0.5 * np.log(2.0 * np.pi / curvature))
    return replace(fit, evidence=fit.evidence + gained)


def _height(fit: Fit, place: int | None = None) -> float:
    """Log density of the readings and of a fit's coordinates, or of one of them."""
    z = fit.z if place is None else fit.z[[place]]
    return float(log_likelihood(fit.residual)[0].sum() - 0.5 * z @ z)


def places(problem: Problem, fit: Fit, beside: np.ndarray | None = None) -> tuple[Places, ...]:
    """Where each sudden change of a fit may stand, its other coordinates and columns ``beside`` going with it."""
    found = []
    every = fit.slopes if beside is None else np.hstack([fit.slopes, beside])
    for index in sudden_places(problem, fit.explanation):
        open_by = covariance(every, fit.weight)[index, : fit.z.size]
        tried, log = anywhere(problem, fit, index, fit.z[index], open_by / open_by[index], beside)
        where = tried[:, index]
        chance = np.where(log > log.max() - NEVER, np.exp(log - log.max()), 0.0) * np.gradient(where)
        kept = chance > 0.0
        found.append(Places(index, where[kept], tried[kept] - fit.z, chance[kept] / chance.sum()))
    return tuple(found)


def without(slopes: np.ndarray, sudden: Sequence[int]) -> np.ndarray:
    """Slopes less those of places: what stands anywhere is not foretold by them."""
    return np.where(np.isin(np.arange(slopes.shape[1]), sudden), 0.0, slopes)


def elsewhere(
    found: Sequence[Places], z: np.ndarray, predict: Callable[[np.ndarray], np.ndarray], here: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """What predictions ``here``, at coordinates z, gain by where sudden changes may stand, and variances (3, n) of it.

    Before and after a change are two values, seldom as far from their mean: beside the variance stand those that a
    normal 90 % interval would need to end below and above where that of the places does.
    """
    gain, variances = np.zeros(here.size), np.zeros((3, here.size))
    for p in found:
        seen = np.array([predict(np.clip(z + step, -REACH, REACH)) for step in p.even])
        seen = np.where(np.isfinite(seen), seen, here)
        mean = np.mean(seen, axis=0)
        ends = np.quantile(seen, (0.05, 0.95), axis=0, method="hazen")
        gain += mean - here
        variances += np.vstack([np.var(seen, axis=0), ((ends - mean) / NINETY) ** 2])
    return gain, variances
