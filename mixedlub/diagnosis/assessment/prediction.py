"""Predictions of an explanation at recorded or new conditions, with what its parameters leave uncertain."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.discrepancy.modulated import scaling_of
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.inference.change_points import (
    ChangePointPosterior,
    average_over_change_points,
    change_point_coordinates,
    change_point_posterior,
    drop_columns,
)
from mixedlub.diagnosis.inference.map_fit import Fit, covariance, damped_update, linear_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.drift import correlated_error_variance
from mixedlub.diagnosis.search.search import Search, form_error_columns, n_inexact, rms
from mixedlub.diagnosis.settings.search import FORM_ERRORS
from mixedlub.recording.noise import fit_noise_model, transformed_noise
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted readings, their variance, and the base model at the same calibration.

    ``lean`` (2, rows) is added to the variance for the lower and the upper end of an interval.
    """

    mean: np.ndarray
    variance: np.ndarray
    base: np.ndarray
    lean: np.ndarray | float = 0.0

    @property
    def ends(self) -> np.ndarray:
        """Variances (2, rows) for the lower and the upper end of an interval."""
        return self.variance + np.zeros((2, 1)) + self.lean


@dataclass(frozen=True, eq=False)
class Refined:
    """A fit with an error of form: coordinates, its coefficients, joint covariance.

    Change points are not in the covariance; ``change_points`` has their posteriors.
    """

    fit: Fit
    z: np.ndarray
    bend: float
    coefficients: np.ndarray
    covariance: np.ndarray
    residual: np.ndarray
    typical: float
    change_points: tuple[ChangePointPosterior, ...]

    @property
    def spread(self) -> np.ndarray:
        """Standard deviation of every coordinate."""
        own = np.diag(self.covariance)[: self.z.size]
        return np.asarray(np.sqrt(own + sum(p.variance for p in self.change_points)))


def refine(search: Search, fit: Fit) -> Refined:
    """Fit the error of form, and the coordinates with it."""
    problem = search.problem
    at_change_points, sloping = change_point_coordinates(problem, fit.explanation), fit
    fit = replace(fit, slopes=drop_columns(fit.slopes, at_change_points))
    fixed = np.hstack([fit.slopes, problem.shared])
    net = (fit.prediction - search.null_fit.prediction) / problem.sd
    typical = rms(net)
    columns = form_error_columns(net, typical, search.space, search.values)
    best, best_score = None, -np.inf
    for size, weight in FORM_ERRORS:
        every = np.hstack([fixed, size * columns]) if size and columns.size else fixed
        linear = linear_fit(fit.anchor, every, fit.weight)
        score = linear.evidence + np.log(weight)
        if score > best_score:
            best, best_score, used, bend = linear, score, every, (size if size and columns.size else 0.0)
        if not n_inexact(fit.explanation):
            break
    assert best is not None
    spread = covariance(used, best.weight)
    spread[at_change_points, at_change_points] = 0.0
    wanted = best.coefficients[: fit.z.size].copy()
    wanted[at_change_points] = fit.z[at_change_points]
    stand = change_point_posterior(problem, sloping, used[:, fixed.shape[1] :])

    def bends(prediction: np.ndarray) -> np.ndarray:
        if not bend:
            return np.zeros((prediction.size, 0))
        net = (prediction - search.null_fit.prediction) / problem.sd
        return np.asarray(bend * form_error_columns(net, typical, search.space, search.values))

    z, own = damped_update(problem, fit.explanation, fit.z, wanted, fit.common, bends, fit.weight)
    coefficients = np.concatenate([z, best.coefficients[z.size : fixed.shape[1]], own.coefficients])
    return Refined(fit, z, bend, coefficients, spread, own.residual, typical, stand)


class NewRows:
    """Rows of another table of the same case: a problem without readings."""

    def __init__(self, search: Search, table: Table, level: np.ndarray | None = None) -> None:
        self.search = search
        scale = float(search.problem.forward.inputs["reading_scale"])
        self.forward = Forward(search.problem.case, table, scale)
        self.table = table
        self.values = search.space.values(self.forward)
        known = search.problem
        start = known.transform(self.forward.predict(known.calibration(search.null_fit.z))) if level is None else level
        self.sd, _ = _noise_at(known, table, start)
        null_fit = np.zeros((len(table), 0))
        self.problem = Problem(known.case, table, self.forward, start, self.sd, null_fit).with_n_per_effective(
            known.n_per_effective
        )

    def noise_at(self, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Noise of a reading at a transformed prediction, and the variance of the error that it shares with others."""
        single, setups = _noise_at(self.search.problem, self.table, seen)
        return single, setups + correlated_error_variance(self.search) * single**2

    def of_fit(self, refined: Refined) -> Prediction:
        """Prediction of effects or of nothing missing."""
        fit = refined.fit
        z = refined.z
        run = self.problem.run(fit.explanation, z)
        mean, slopes = run.prediction, self.problem.jacobian(fit.explanation, z, run)
        slopes = drop_columns(slopes, [p.index for p in refined.change_points])
        gain, apart = average_over_change_points(
            refined.change_points, z, partial(self.problem.predict, fit.explanation), mean
        )
        base = self.problem.base(z)
        columns = [slopes, np.zeros((len(self.table), self.search.problem.shared.shape[1]))]
        if refined.bend:
            net = (mean - self.problem.predict(NOTHING, self.search.null_fit.z)) / self.problem.sd
            own = refined.bend * form_error_columns(net, refined.typical, self.search.space, self.values)
            columns.append(own)
            mean = mean + self.problem.sd * (own @ refined.coefficients[-own.shape[1] :])
        every = np.hstack(columns)
        variance = np.einsum("ij,jk,ik->i", every, refined.covariance, every) * self.problem.sd**2
        return Prediction(mean + gain, variance + apart[0], base, apart[1:] - apart[0])

    def of_discrepancy(self) -> Prediction:
        """Prediction of the base model plus the discrepancy, which vanishes far from the recorded conditions."""
        found = self.search
        discrepancy = found.discrepancy
        run = self.problem.run(NOTHING, discrepancy.z)
        calibrated, slopes = run.prediction, self.problem.jacobian(NOTHING, discrepancy.z, run)
        name = discrepancy.best.modulates
        scalings = {
            name: scaling_of(self.problem, self.problem.run(NOTHING, found.null_fit.z), discrepancy.typical, name)
        }
        own = discrepancy.best.columns(found.space, self.values, scalings)
        shared = np.zeros((len(self.table), found.problem.shared.shape[1]))
        every = np.hstack([slopes, shared, own])
        mean = calibrated + self.problem.sd * (own @ discrepancy.fit.coefficients[-own.shape[1] :])
        variance = np.einsum("ij,jk,ik->i", every, discrepancy.covariance, every) + self._phase_variance()
        return Prediction(mean, variance * self.problem.sd**2, calibrated)

    def _phase_variance(self) -> np.ndarray:
        """Variance of a wave where its phase is unknown, in units of the noise."""
        discrepancy, rows = self.search.discrepancy, self.problem.rows
        if not discrepancy.best.waves:
            return np.zeros(len(rows))
        place = self.search.space.place(discrepancy.best.axes[0])
        kept = self.search.space.axes[place].phase_known(self.values[place], discrepancy.best.waves)
        height = discrepancy.best.size * np.linalg.norm(discrepancy.fit.coefficients[-2:])
        return 0.5 * (1.0 - kept**2) * height**2


def _noise_at(problem: Problem, table: Table, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Noise of a new reading at a transformed prediction, and the variance of its set-up's error."""
    own = f"{problem.case.quantity}_sd"
    level = problem.inverse(seen)
    if own in problem.rows and own not in table:
        relative, absolute = fit_noise_model(
            problem.single_sd * problem.d_inverse(problem.y), problem.inverse(problem.y)
        )
        typical = np.hypot(relative * level, absolute) / problem.d_inverse(seen)
    else:
        typical, _ = transformed_noise(problem.case, table, level)
    stated = problem.case.system.recording.noise
    if stated is None:
        return typical, np.zeros(len(table))
    size = np.abs(level) if problem.case.kind.logarithmic else 1.0
    return typical, ((stated.setup_relative * level) ** 2 + stated.setup_absolute**2) / size**2
