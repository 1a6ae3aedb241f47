"""Predictions of an explanation at recorded or new conditions, with parameter uncertainty."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.inference.change_points import (
    ChangePointPosterior,
    average_over_change_points,
    change_point_coordinates,
    change_point_posterior,
    drop_columns,
)
from mixedlub.diagnosis.inference.map_fit import Fit, covariance, damped_update, linear_fit, square_root
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.drift import correlated_error_variance
from mixedlub.diagnosis.search.law_error import form_error_columns, n_inexact, rms
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.law_error import BASE_ERRORS, FORM_ERRORS
from mixedlub.recording.noise import fit_noise_model, transformed_noise
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted readings, their variance, and the base model at the same calibration.

    ``lean`` (2, rows) is added to the variance for the lower and the upper end of an interval. It has the growth of the
    discrepancy beyond the recorded range too: joint predictions have their own, which rows share. ``shared``: columns
    with a covariance of one, through which the rows share their uncertainty; the rest of the variance is of each row
    alone.
    """

    mean: np.ndarray
    variance: np.ndarray
    base: np.ndarray
    lean: np.ndarray | float = 0.0
    shared: Callable[[], np.ndarray] = lambda: np.zeros((0, 0))

    @property
    def ends(self) -> np.ndarray:
        """Variances (2, rows) for the lower and the upper end of an interval."""
        return self.variance + np.zeros((2, 1)) + self.lean


@dataclass(frozen=True, eq=False)
class Refined:
    """A fit with errors of its laws; ``change_points`` hold the posteriors that the covariance lacks.

    ``bend`` is the most probable relative size of the error of form, ``bend_rms`` the root mean square over all sizes,
    ``base_error`` the most probable relative size of the error of the base model. ``variance`` of each coordinate is
    over all sizes of both errors, the ``covariance`` at the most probable ones.
    """

    fit: Fit
    z: np.ndarray
    bend: float
    bend_rms: float
    base_error: float
    coefficients: np.ndarray
    covariance: np.ndarray
    variance: np.ndarray
    residual: np.ndarray
    typical: float
    change_points: tuple[ChangePointPosterior, ...]

    @property
    def spread(self) -> np.ndarray:
        """Standard deviation of every coordinate."""
        return np.asarray(np.sqrt(self.variance + sum(p.variance for p in self.change_points)))


def refine(search: Search, fit: Fit, sizes: Sequence[tuple[float, float]] = FORM_ERRORS) -> Refined:
    """Fit errors of form and of the base model together with the coordinates.

    ``sizes`` are relative sizes of the error of form with their weights.
    """
    problem = search.problem
    at_change_points, sloping = change_point_coordinates(problem, fit.explanation), fit
    fit = replace(fit, slopes=drop_columns(fit.slopes, at_change_points))
    fixed = np.hstack([fit.slopes, problem.shared])
    net = (fit.prediction - search.null_fit.prediction) / problem.sd
    typical = rms(net)
    form = form_error_columns(net, typical, search.space, search.values)
    base = search.base_error.columns(problem, search.null_fit, search.space, search.values)
    sizes = sizes if form.size and n_inexact(problem, fit.explanation) else ((0.0, 1.0),)
    best, best_score, scores = None, -np.inf, np.zeros((len(sizes), len(BASE_ERRORS)))
    tried: list[tuple[float, np.ndarray, np.ndarray]] = []
    for (i, (size, weight)), (j, (base_size, base_weight)) in product(enumerate(sizes), enumerate(BASE_ERRORS)):
        columns = np.hstack([fixed, base_size * base, size * form])
        linear = linear_fit(fit.anchor, columns, fit.weight)
        scores[i, j] = score = linear.evidence + np.log(weight) + np.log(base_weight)
        own = covariance(columns, linear.weight)
        tried.append((score, linear.coefficients[: fit.z.size], np.diag(own)[: fit.z.size]))
        if score > best_score:
            best, best_score, used, spread = linear, score, columns, own
            form_error_size, base_error_size = size, base_size
    assert best is not None
    shares = np.exp(scores - best_score).sum(axis=1)
    squares = np.array([size for size, _ in sizes]) ** 2
    bend_rms = float(np.sqrt(shares @ squares / shares.sum()))
    spread[at_change_points, at_change_points] = 0.0
    variance = _variance_over(tried)
    variance[at_change_points] = 0.0
    target_z = best.coefficients[: fit.z.size].copy()
    target_z[at_change_points] = fit.z[at_change_points]
    change_points = change_point_posterior(problem, sloping, used[:, fixed.shape[1] :])

    def law_errors(prediction: np.ndarray) -> np.ndarray:
        net = (prediction - search.null_fit.prediction) / problem.sd
        bent = form_error_columns(net, typical, search.space, search.values)
        return np.hstack([base_error_size * base, form_error_size * bent])

    z, errors = damped_update(problem, fit.explanation, fit.z, target_z, fit.common, law_errors, fit.weight)
    coefficients = np.concatenate([z, best.coefficients[z.size : fixed.shape[1]], errors.coefficients])
    return Refined(
        fit,
        z,
        form_error_size,
        bend_rms,
        base_error_size,
        coefficients,
        spread,
        variance,
        errors.residual,
        typical,
        change_points,
    )


def _variance_over(fits: Sequence[tuple[float, np.ndarray, np.ndarray]]) -> np.ndarray:
    """Variance of coordinates over fits: log weight, coordinates, and their variance in each.

    >>> _variance_over([(0.0, np.zeros(1), np.ones(1)), (0.0, np.full(1, 2.0), np.ones(1))]).tolist()
    [2.0]
    """
    scores, centres, variances = (np.array(each) for each in zip(*fits, strict=True))
    share = np.exp(scores - np.max(scores))
    share = share / share.sum()
    return np.asarray(share @ (variances + (centres - share @ centres) ** 2))


class NewRows:
    """Rows of another table of the same case: a problem without readings."""

    def __init__(self, search: Search, table: Table, level: np.ndarray | None = None) -> None:
        self.search = search
        scale = float(search.problem.forward.inputs["reading_scale"])
        self.forward = Forward(search.problem.case, table, scale)
        self.table = table
        self.values = search.space.values(self.forward)
        recorded = search.problem
        if level is None:
            level = recorded.transform(self.forward.predict(recorded.calibration(search.null_fit.z)))
        self.sd, _ = _noise_at(recorded, table, level)
        null_fit = np.zeros((len(table), 0))
        self.problem = Problem(recorded.case, table, self.forward, level, self.sd, null_fit).with_n_per_effective(
            recorded.n_per_effective
        )

    def noise_at(self, transformed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Noise of a reading at a transformed prediction, and the variance of its error shared with others."""
        single, setups = _noise_at(self.search.problem, self.table, transformed)
        return single, setups + correlated_error_variance(self.search) * single**2

    def of_fit(self, refined: Refined) -> Prediction:
        """Prediction of effects or of nothing missing."""
        fit = refined.fit
        z = refined.z
        run = self.problem.run(fit.explanation, z)
        mean, slopes = run.prediction, self.problem.jacobian(fit.explanation, z, run)
        slopes = drop_columns(slopes, [p.index for p in refined.change_points])
        gain, variances = average_over_change_points(
            refined.change_points, z, partial(self.problem.predict, fit.explanation), mean
        )
        search = self.search
        shared = np.zeros((len(self.table), search.problem.shared.shape[1]))
        base_error = search.base_error.columns(self.problem, search.null_fit, search.space, self.values)
        net = (mean - self.problem.predict(NOTHING, search.null_fit.z)) / self.problem.sd
        form_error = form_error_columns(net, refined.typical, search.space, self.values)
        errors = np.hstack([refined.base_error * base_error, refined.bend * form_error])
        weights = refined.coefficients[z.size + shared.shape[1] :]
        of_base = self.problem.sd * (errors[:, : base_error.shape[1]] @ weights[: base_error.shape[1]])
        base = self.problem.base(z) + of_base
        mean = mean + self.problem.sd * (errors @ weights)
        all_columns = np.hstack([slopes, shared, errors])
        variance = np.einsum("ij,jk,ik->i", all_columns, refined.covariance, all_columns) * self.problem.sd**2
        lean = variances[1:] - variances[0]
        spread = self._shared(all_columns, refined.covariance)
        return Prediction(mean + gain, variance + variances[0], base, lean, spread)

    def _shared(self, columns: np.ndarray, spread: np.ndarray) -> Callable[[], np.ndarray]:
        """Columns through which the rows share an uncertainty, computed where wanted."""

        def shared() -> np.ndarray:
            return np.asarray((columns @ square_root(spread)) * self.problem.sd[:, None])

        return shared

    def of_discrepancy(self) -> Prediction:
        """Prediction of the base fit plus the discrepancy.

        Far from the recorded conditions its mean vanishes, and its interval is as wide as before any reading.
        """
        search = self.search
        discrepancy, base = search.discrepancy, search.discrepancy.base
        run = self.problem.run(base.explanation, discrepancy.z)
        calibrated, slopes = run.prediction, self.problem.jacobian(base.explanation, discrepancy.z, run)
        at_base = self.problem.run(base.explanation, base.z)
        scalings = discrepancy.best.scalings_at(self.problem, at_base, discrepancy.typical, search.space)
        form = discrepancy.best.columns(search.space, self.values, scalings)
        shared = np.zeros((len(self.table), search.problem.shared.shape[1]))
        all_columns = np.hstack([slopes, shared, form])
        mean = calibrated + self.problem.sd * (form @ discrepancy.fit.coefficients[-form.shape[1] :])
        variance = np.einsum("ij,jk,ik->i", all_columns, discrepancy.covariance, all_columns) + self._phase_variance()
        spread = self._shared(all_columns, discrepancy.covariance)
        faded = discrepancy.best.faded(search.space, search.values, self.values, scalings)
        return Prediction(mean, variance * self.problem.sd**2, calibrated, faded * self.problem.sd**2, spread)

    def _phase_variance(self) -> np.ndarray:
        """Variance of a wave due to its unknown phase, in units of the noise."""
        discrepancy, rows = self.search.discrepancy, self.problem.rows
        if not discrepancy.best.waves:
            return np.zeros(len(rows))
        index = self.search.space.place(discrepancy.best.axes[0])
        phase_known = self.search.space.axes[index].phase_known(self.values[index], discrepancy.best.waves)
        height = discrepancy.best.size * np.linalg.norm(discrepancy.fit.coefficients[-2:])
        return 0.5 * (1.0 - phase_known**2) * height**2


def _noise_at(problem: Problem, table: Table, transformed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Noise of a new reading at a transformed prediction, and the variance of the error of its set-up."""
    sd_column = f"{problem.case.quantity}_sd"
    level = problem.inverse(transformed)
    if sd_column in problem.rows and sd_column not in table:
        relative, absolute = fit_noise_model(
            problem.single_sd * problem.d_inverse(problem.y), problem.inverse(problem.y)
        )
        typical = np.hypot(relative * level, absolute) / problem.d_inverse(transformed)
    else:
        typical, _ = transformed_noise(problem.case, table, level)
    stated = problem.case.system.recording.noise
    if stated is None:
        return typical, np.zeros(len(table))
    size = np.abs(level) if problem.case.kind.logarithmic else 1.0
    return typical, ((stated.setup_relative * level) ** 2 + stated.setup_absolute**2) / size**2
