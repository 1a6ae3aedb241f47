"""Predictions of an explanation at recorded or new conditions, with what its parameters leave uncertain."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.discrepancy.modulated import carrier
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.inference.change_points import Places, elsewhere, places, sudden_places, without
from mixedlub.diagnosis.inference.map_fit import Fit, covariance, linear_fit, settled
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.drift import wandering_variance
from mixedlub.diagnosis.search.search import ELASTIC, Search, bendable, elastic_columns, typical_size
from mixedlub.recording.noise import by_level, seen_noise
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted readings, their variance, and the base model at the same calibration.

    ``lean`` (2, rows) is how much more or less variance the lower and the upper end of an interval go by.
    """

    mean: np.ndarray
    variance: np.ndarray
    base: np.ndarray
    lean: np.ndarray | float = 0.0

    @property
    def ends(self) -> np.ndarray:
        """Variances (2, rows) that the ends of an interval go by."""
        return self.variance + np.zeros((2, 1)) + self.lean


@dataclass(frozen=True, eq=False)
class Refined:
    """A fit whose effects' forms may bend a little: coordinates, bend coefficients, joint covariance.

    Where sudden changes stand is no matter of slopes: ``places`` have it, and the covariance is that for one place.
    """

    fit: Fit
    z: np.ndarray
    bend: float
    coefficients: np.ndarray
    covariance: np.ndarray
    residual: np.ndarray
    typical: float
    places: tuple[Places, ...]

    @property
    def spread(self) -> np.ndarray:
        """Standard deviation of every coordinate."""
        own = np.diag(self.covariance)[: self.z.size]
        return np.asarray(np.sqrt(own + sum(p.variance for p in self.places)))


def refine(found: Search, fit: Fit) -> Refined:
    """Settle how much the effects' forms bend, and the coordinates with it."""
    problem = found.problem
    sudden, sloping = sudden_places(problem, fit.explanation), fit
    fit = replace(fit, slopes=without(fit.slopes, sudden))
    fixed = np.hstack([fit.slopes, problem.shared])
    net = (fit.prediction - found.none.prediction) / problem.sd
    typical = typical_size(net)
    columns = elastic_columns(net, typical, found.space, found.values)
    best, best_score = None, -np.inf
    for size, weight in ELASTIC:
        every = np.hstack([fixed, size * columns]) if size and columns.size else fixed
        linear = linear_fit(fit.anchor, every, fit.weight)
        score = linear.evidence + np.log(weight)
        if score > best_score:
            best, best_score, used, bend = linear, score, every, (size if size and columns.size else 0.0)
        if not bendable(fit.explanation):
            break
    assert best is not None
    spread = covariance(used, best.weight)
    spread[sudden, sudden] = 0.0
    wanted = best.coefficients[: fit.z.size].copy()
    wanted[sudden] = fit.z[sudden]
    stand = places(problem, sloping, used[:, fixed.shape[1] :])

    def bends(prediction: np.ndarray) -> np.ndarray:
        if not bend:
            return np.zeros((prediction.size, 0))
        net = (prediction - found.none.prediction) / problem.sd
        return np.asarray(bend * elastic_columns(net, typical, found.space, found.values))

    z, own = settled(problem, fit.explanation, fit.z, wanted, fit.common, bends, fit.weight)
    coefficients = np.concatenate([z, best.coefficients[z.size : fixed.shape[1]], own.coefficients])
    return Refined(fit, z, bend, coefficients, spread, own.residual, typical, stand)


class Rows:
    """New rows of the same case: a problem without readings."""

    def __init__(self, found: Search, table: Table, level: np.ndarray | None = None) -> None:
        self.found = found
        scale = float(found.problem.forward.inputs["reading_scale"])
        self.forward = Forward(found.problem.case, table, scale)
        self.table = table
        self.values = found.space.values(self.forward)
        known = found.problem
        start = known.seen(self.forward.predict(known.calibration(found.none.z))) if level is None else level
        self.sd, _ = _noise_at(known, table, start)
        none = np.zeros((len(table), 0))
        self.problem = Problem(known.case, table, self.forward, start, self.sd, none).with_together(known.together)

    def noise_at(self, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Noise of a reading where a prediction is seen, and the variance of what it shares with others."""
        single, setups = _noise_at(self.found.problem, self.table, seen)
        return single, setups + wandering_variance(self.found) * single**2

    def of_fit(self, refined: Refined) -> Prediction:
        """Prediction of a catalogue explanation."""
        fit = refined.fit
        z = refined.z
        run = self.problem.run(fit.explanation, z)
        mean, slopes = run.prediction, self.problem.jacobian(fit.explanation, z, run)
        slopes = without(slopes, [p.index for p in refined.places])
        gain, apart = elsewhere(refined.places, z, partial(self.problem.predict, fit.explanation), mean)
        base = self.problem.base(z)
        columns = [slopes, np.zeros((len(self.table), self.found.problem.shared.shape[1]))]
        if refined.bend:
            net = (mean - self.problem.predict(NOTHING, self.found.none.z)) / self.problem.sd
            own = refined.bend * elastic_columns(net, refined.typical, self.found.space, self.values)
            columns.append(own)
            mean = mean + self.problem.sd * (own @ refined.coefficients[-own.shape[1] :])
        every = np.hstack(columns)
        variance = np.einsum("ij,jk,ik->i", every, refined.covariance, every) * self.problem.sd**2
        return Prediction(mean + gain, variance + apart[0], base, apart[1:] - apart[0])

    def of_unknown(self) -> Prediction:
        """Prediction of the base model plus the unnamed mismatch; far from the recordings it fades out."""
        found = self.found
        unknown = found.unknown
        run = self.problem.run(NOTHING, unknown.z)
        calibrated, slopes = run.prediction, self.problem.jacobian(NOTHING, unknown.z, run)
        name = unknown.best.carrier
        rides = {name: carrier(self.problem, self.problem.run(NOTHING, found.none.z), unknown.typical, name)}
        own = unknown.best.columns(found.space, self.values, rides)
        shared = np.zeros((len(self.table), found.problem.shared.shape[1]))
        every = np.hstack([slopes, shared, own])
        mean = calibrated + self.problem.sd * (own @ unknown.fit.coefficients[-own.shape[1] :])
        variance = np.einsum("ij,jk,ik->i", every, unknown.covariance, every) + self._lost_wave()
        return Prediction(mean, variance * self.problem.sd**2, calibrated)

    def _lost_wave(self) -> np.ndarray:
        """Variance, in sigmas, of a wave where it is no longer foretold."""
        unknown, rows = self.found.unknown, self.problem.rows
        if not unknown.best.waves:
            return np.zeros(len(rows))
        place = self.found.space.place(unknown.best.axes[0])
        kept = self.found.space.axes[place].kept(self.values[place], unknown.best.waves)
        height = unknown.best.size * np.linalg.norm(unknown.fit.coefficients[-2:])
        return 0.5 * (1.0 - kept**2) * height**2


def _noise_at(problem: Problem, table: Table, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Noise of a new reading where a prediction is ``seen``, and the variance of its set-up's error."""
    own = f"{problem.case.quantity}_sd"
    level = problem.level(seen)
    if own in problem.rows and own not in table:
        relative, absolute = by_level(problem.one_sd * problem.unit_size(problem.y), problem.level(problem.y))
        typical = np.hypot(relative * level, absolute) / problem.unit_size(seen)
    else:
        typical, _ = seen_noise(problem.case, table, level)
    stated = problem.case.system.recording.noise
    if stated is None:
        return typical, np.zeros(len(table))
    size = np.abs(level) if problem.case.kind.logarithmic else 1.0
    return typical, ((stated.setup_relative * level) ** 2 + stated.setup_absolute**2) / size**2
