"""Numerical integration over change points: the slope at one place does not predict other places."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.inference.map_fit import Fit, covariance, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import (
    CHANGE_POINT_QUANTILES,
    INTERVAL_ENDS,
    MOST_COORDINATE,
    MOST_HALVINGS,
    MOST_LOG_RATIO,
    NEGLIGIBLE_DENSITY,
    NINETY,
    REFIT_GAIN,
    SCAN_PLACES,
    SCANNED_TO,
    STEEP,
)


@dataclass(frozen=True, eq=False)
class ChangePointPosterior:
    """Posterior of the change point at coordinate ``index`` of a fit, at m places.

    ``where`` are the places, in rising order, ``chance`` their probabilities, and ``steps`` (m, size) the steps of the
    coordinates to there.
    """

    index: int
    where: np.ndarray
    steps: np.ndarray
    chance: np.ndarray

    def at(self, share: float) -> float:
        """Quantile ``share`` of the change point.

        >>> ChangePointPosterior(0, np.array([0.0, 1.0, 2.0]), np.zeros((3, 1)), np.array([0.25, 0.5, 0.25])).at(0.5)
        1.0
        """
        return float(np.interp(share, self._below, self.where))

    @property
    def even(self) -> np.ndarray:
        """Steps (20, size) to places of equal probability."""
        return np.stack([np.interp(CHANGE_POINT_QUANTILES, self._below, step) for step in self.steps.T], axis=1)

    @property
    def variance(self) -> np.ndarray:
        """Variance of every coordinate due to the change point."""
        return np.asarray(self.chance @ (self.steps - self.chance @ self.steps) ** 2)

    @property
    def _below(self) -> np.ndarray:
        return np.cumsum(self.chance) - 0.5 * self.chance


def change_point_coordinates(problem: Problem, explanation: Explanation) -> list[int]:
    """Indices of the coordinates of an explanation that are change points."""
    parameters = [p for e in problem.effects(explanation) for p in e.parameters]
    return [i for i, p in enumerate(parameters, problem.calibration_size) if p.change_point]


def profile_change_point(
    problem: Problem,
    fit: Fit,
    index: int,
    further: np.ndarray,
    follow: np.ndarray | None = None,
    extra_columns: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Profile of the log density over one change point: coordinates (m, size) in rising order, and m log densities.

    Places are denser where the density is steep; ``further`` are added. The other coordinates keep their values, or
    ``follow`` in proportion if more probable. The ``extra_columns`` are fitted at each place.
    """
    alone = np.eye(fit.z.size)[index]
    directions = [alone] if follow is None else [alone, follow]
    columns = np.zeros((problem.y.size, 0)) if extra_columns is None else extra_columns
    weighted = columns.T * fit.weight
    taken = np.linalg.solve(np.eye(columns.shape[1]) + weighted @ columns, weighted)
    here = problem.run(fit.explanation, fit.z)

    def evaluated(where: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        every = [
            np.clip(fit.z + np.outer(where - fit.z[index], direction), -MOST_COORDINATE, MOST_COORDINATE)
            for direction in directions
        ]
        logs = np.array([[density(z) for z in tried] for tried in every])
        return np.array(every)[logs.argmax(axis=0), np.arange(where.size)], logs.max(axis=0)

    def density(z: np.ndarray) -> float:
        residual = (problem.y - problem.predict(fit.explanation, z, here)) / problem.sd - fit.common
        extra = taken @ residual
        squares = float(z @ z - fit.z @ fit.z + fit.z[index] ** 2 + extra @ extra)
        log = float(log_likelihood(residual - columns @ extra)[0].sum()) - 0.5 * squares
        return log if np.isfinite(log) else -np.inf

    where = np.unique(
        np.clip(
            np.append(np.linspace(-SCANNED_TO, SCANNED_TO, SCAN_PLACES), further), -MOST_COORDINATE, MOST_COORDINATE
        )
    )
    tried, log = evaluated(where)
    for _ in range(MOST_HALVINGS):
        steep = np.abs(np.diff(np.maximum(log, log.max() - NEGLIGIBLE_DENSITY))) > STEEP
        if not steep.any():
            break
        between, its_log = evaluated(0.5 * (tried[1:, index] + tried[:-1, index])[steep])
        tried, log = np.vstack([tried, between]), np.append(log, its_log)
        order = np.argsort(tried[:, index], kind="stable")
        tried, log = tried[order], log[order]
    return tried, log


def integrate_change_points(problem: Problem, fit: Fit) -> Fit:
    """The fit with its evidence integrated over all places of its change points, where Laplace uses one place only.

    Where another place is more probable the fit is repeated from there, because the density is flat between readings.
    """
    gained = 0.0
    for index in change_point_coordinates(problem, fit.explanation):
        tried, log = profile_change_point(problem, fit, index, fit.z[[index]])
        if log.max() > _height(fit, index) + REFIT_GAIN:
            refitted = map_fit(problem, fit.explanation, tried[np.argmax(log)], warm=True)
            if _height(refitted) > _height(fit) + REFIT_GAIN:
                return integrate_change_points(problem, refitted)
        curvature = 1.0 + float(fit.weight @ fit.slopes[:, index] ** 2)
        integral = np.trapezoid(np.exp(np.minimum(log - _height(fit, index), MOST_LOG_RATIO)), tried[:, index])
        gained += float(np.log(max(integral, 1e-300)) - 0.5 * np.log(2.0 * np.pi / curvature))
    return replace(fit, evidence=fit.evidence + gained)


def _height(fit: Fit, index: int | None = None) -> float:
    """Log density of the readings and of a fit's coordinates, or of one of them."""
    z = fit.z if index is None else fit.z[[index]]
    return float(log_likelihood(fit.residual)[0].sum() - 0.5 * z @ z)


def change_point_posterior(
    problem: Problem, fit: Fit, extra_columns: np.ndarray | None = None
) -> tuple[ChangePointPosterior, ...]:
    """Posterior of each change point of a fit, its other coordinates and the ``extra_columns`` adapted."""
    posteriors = []
    all_columns = fit.slopes if extra_columns is None else np.hstack([fit.slopes, extra_columns])
    for index in change_point_coordinates(problem, fit.explanation):
        open_by = covariance(all_columns, fit.weight)[index, : fit.z.size]
        tried, log = profile_change_point(problem, fit, index, fit.z[index], open_by / open_by[index], extra_columns)
        where = tried[:, index]
        chance = np.where(log > log.max() - NEGLIGIBLE_DENSITY, np.exp(log - log.max()), 0.0) * np.gradient(where)
        probable = chance > 0.0
        posteriors.append(
            ChangePointPosterior(index, where[probable], tried[probable] - fit.z, chance[probable] / chance.sum())
        )
    return tuple(posteriors)


def drop_columns(slopes: np.ndarray, at_change_points: Sequence[int]) -> np.ndarray:
    """Jacobian with the change-point columns set to zero; change points are averaged over separately."""
    return np.where(np.isin(np.arange(slopes.shape[1]), at_change_points), 0.0, slopes)


def average_over_change_points(
    posteriors: Sequence[ChangePointPosterior],
    z: np.ndarray,
    predict: Callable[[np.ndarray], np.ndarray],
    here: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Change of predictions ``here``, at coordinates z, by averaging over change points, and variances (3, n) of it.

    A prediction before and after a change is bimodal. The second and third variance therefore make a normal 90 %
    interval end at the lower and upper quantile.
    """
    gain, variances = np.zeros(here.size), np.zeros((3, here.size))
    for p in posteriors:
        predicted = np.array([predict(np.clip(z + step, -MOST_COORDINATE, MOST_COORDINATE)) for step in p.even])
        predicted = np.where(np.isfinite(predicted), predicted, here)
        mean = np.mean(predicted, axis=0)
        ends = np.quantile(predicted, INTERVAL_ENDS, axis=0, method="hazen")
        gain += mean - here
        variances += np.vstack([np.var(predicted, axis=0), ((ends - mean) / NINETY) ** 2])
    return gain, variances
