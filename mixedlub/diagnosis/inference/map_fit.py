"""Most probable parameters of an explanation and its evidence, with readings that may be outliers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from mixedlub.case.forward import Run
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.likelihood import log_likelihood
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import (
    DAMPING_FALL,
    DAMPING_RETRY,
    DAMPING_RISE,
    DAMPING_START,
    DAMPING_TRIALS,
    EVIDENCE_BOUND_FACTOR,
    FINITE_STEP,
    FIT_TOLERANCE,
    FITTED_FIRST,
    GAUSS_NEWTON_STEPS,
    HOPELESS_BEHIND,
    HUBER_BOUND,
    LEAST_DAMPING,
    LONGEST_STEP,
    MOST_COORDINATE,
    PRECISION_BEHIND,
    PREFIT_TOLERANCE,
    REWEIGHTINGS,
    SAME_FIT_WITHIN,
    STEP_LENGTHS,
    STEPS_BEFORE_GIVING_UP,
    WEIGHTS_CONVERGED,
)
from mixedlub.recording.noise import MAD_TO_SD
from mixedlub.running.parallel import shared_out

Item = TypeVar("Item")


@dataclass(frozen=True, eq=False)
class Fit:
    """An explanation at its most probable coordinates ``z``.

    ``residual`` is (y - prediction)/sd less ``common``, the errors shared within set-ups; ``slopes`` its negative
    derivative with respect to z where the last step began, ``weight`` the precision of each reading after the chance
    that it is an outlier, ``evidence`` the Laplace estimate of the log marginal likelihood (up to a constant common to
    all explanations of a problem).
    """

    explanation: Explanation
    z: np.ndarray
    prediction: np.ndarray
    residual: np.ndarray
    common: np.ndarray
    slopes: np.ndarray
    weight: np.ndarray
    evidence: float

    def in_sigmas(self, scale: np.ndarray, evidence: float) -> Fit:
        """The same fit under another noise: residuals are ``scale`` times as large."""
        residual = self.residual * scale
        weight = log_likelihood(residual)[1]
        slopes, common = self.slopes * scale[:, None], self.common * scale
        return replace(self, residual=residual, common=common, slopes=slopes, weight=weight, evidence=evidence)

    def at(self, problem: Problem, explanation: Explanation, z: np.ndarray) -> Fit:
        """Another explanation at given coordinates, not fitted, with the weights of this fit."""
        run = problem.run(explanation, z)
        residual = (problem.y - run.prediction) / problem.sd - self.common
        slopes = problem.jacobian(explanation, z, run)
        return replace(self, explanation=explanation, z=z, prediction=run.prediction, residual=residual, slopes=slopes)

    @property
    def anchor(self) -> np.ndarray:
        """Residual of the linearised model at the prior mean."""
        return self.residual + self.common + self.slopes @ self.z


@dataclass(frozen=True, eq=False)
class Linear:
    """A linear model at its most probable coefficients."""

    evidence: float
    coefficients: np.ndarray
    residual: np.ndarray
    weight: np.ndarray


def linear_fit(
    target: np.ndarray, columns: np.ndarray, weight: np.ndarray | None = None, rounds: int = REWEIGHTINGS
) -> Linear:
    """Coefficients with standard-normal priors of ``target ~ columns``, outliers weighted down as they show."""
    coefficients = np.zeros(columns.shape[1])
    w = np.ones(target.size) if weight is None else weight
    eye = np.eye(columns.shape[1])
    for _ in range(rounds):
        scaled = columns * w[:, None]
        curvature = eye + columns.T @ scaled
        found = np.linalg.solve(curvature, scaled.T @ target)
        residual = target - columns @ found
        value, new = log_likelihood(residual)
        done = np.max(np.abs(new - w)) < WEIGHTS_CONVERGED
        coefficients, w = found, new
        if done:
            break
    log_det = np.linalg.slogdet(curvature)[1]
    evidence = float(value.sum() - 0.5 * coefficients @ coefficients - 0.5 * log_det)
    return Linear(evidence, coefficients, residual, w)


def covariance(columns: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Covariance of coordinates with standard-normal priors and these columns (slopes in sigmas), at given weights.

    >>> covariance(np.ones((3, 1)), np.ones(3)).tolist()
    [[0.25]]
    """
    return np.linalg.inv(_precision(columns, weight))


def log_volume(columns: np.ndarray, weight: np.ndarray) -> float:
    """Log determinant of noise plus columns with standard-normal priors, over the noise alone.

    >>> round(log_volume(np.ones((3, 1)), np.ones(3)), 3)   # log 4
    1.386
    """
    return float(np.linalg.slogdet(_precision(columns, weight))[1])


def _precision(columns: np.ndarray, weight: np.ndarray) -> np.ndarray:
    return np.asarray(np.eye(columns.shape[1]) + columns.T @ (columns * weight[:, None]))


def square_root(spread: np.ndarray) -> np.ndarray:
    """Columns with a covariance of one that give this covariance.

    >>> square_root(np.diag([4.0, 0.0])).round(3).tolist()
    [[0.0, 2.0], [0.0, 0.0]]
    """
    size, vectors = np.linalg.eigh(spread)
    return np.asarray(vectors * np.sqrt(np.maximum(size, 0.0)))


def whitening(columns: np.ndarray, weight: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """A function that multiplies rows by the inverse covariance of noise plus columns with standard-normal priors.

    >>> whitening(np.ones((2, 1)), np.ones(2))(np.array([[1.0, 1.0], [1.0, -1.0]])).round(3).tolist()
    [[0.333, 0.333], [1.0, -1.0]]
    """
    weighted = columns * weight[:, None]
    inner = covariance(columns, weight)

    def whitened(rows: np.ndarray) -> np.ndarray:
        scaled = rows * weight
        return np.asarray(scaled - ((scaled @ columns) @ inner) @ weighted.T)

    return whitened


def map_fit(
    problem: Problem,
    explanation: Explanation,
    start: np.ndarray,
    *,
    warm: bool = False,
    slopes: np.ndarray | None = None,
    rival: float = -np.inf,
    hopeless: float = HOPELESS_BEHIND,
    tolerance: float = FIT_TOLERANCE,
) -> Fit:
    """Gauss-Newton with damping to the most probable coordinates, then Laplace's evidence.

    Unless the start is ``warm``, a robust (Huber) prefit comes first, because far from the solution every reading looks
    like an outlier. The first step uses ``slopes`` of a nearby fit if given. A fit that must stay ``hopeless`` behind
    the evidence of a ``rival`` is given up.
    """
    state = _initial_state(problem, explanation, start, slopes)
    state = state if warm else _robust_prefit(problem, explanation, state)
    return _laplace_fit(problem, explanation, state, rival, hopeless, tolerance)


def map_fits(
    problem: Problem, explanation: Explanation, starts: Sequence[np.ndarray], rival: float = -np.inf
) -> list[Fit]:
    """`map_fit` from several starts; starts whose prefits agree are continued once."""
    found: list[Fit] = []
    places: list[np.ndarray] = []
    for start in starts:
        state = _robust_prefit(problem, explanation, _initial_state(problem, explanation, start))
        if all(np.max(np.abs(state.z - z)) > SAME_FIT_WITHIN for z in places):
            places.append(state.z)
            found.append(_laplace_fit(problem, explanation, state, rival))
    return found


def fit_best_first(fit: Callable[[Item, float], Fit], items: Sequence[Item], rival: float) -> list[Fit]:
    """Fits of items in order of promise: the best of the first few is the rival of the others.

    ``fit`` takes an item and the evidence of the rival. The result does not depend on the number of processors.
    """
    first = shared_out(lambda item: fit(item, rival), items[:FITTED_FIRST])
    best = max([rival, *(one.evidence for one in first)])
    return first + shared_out(lambda item: fit(item, best), items[FITTED_FIRST:])


def _initial_state(
    problem: Problem, explanation: Explanation, start: np.ndarray, slopes: np.ndarray | None = None
) -> _State:
    z, shared = np.clip(start, -MOST_COORDINATE, MOST_COORDINATE), np.zeros(problem.shared.shape[1])
    run = problem.run(explanation, z)
    cost, weight = _cost(problem, run.prediction, z, shared, log_likelihood)
    at_start = problem.jacobian(explanation, z, run) if slopes is None else slopes
    return _State(z, shared, run, at_start, cost, weight, exact=slopes is None)


def _robust_prefit(problem: Problem, explanation: Explanation, state: _State) -> _State:
    """Huber prefit from a distant start."""
    first = bounded((problem.y - state.run.prediction) / problem.sd)
    return _gauss_newton(problem, explanation, state, first, tolerance=PREFIT_TOLERANCE)


def _laplace_fit(
    problem: Problem,
    explanation: Explanation,
    state: _State,
    rival: float = -np.inf,
    hopeless: float = HOPELESS_BEHIND,
    tolerance: float = FIT_TOLERANCE,
) -> Fit:
    """Most probable coordinates, and Laplace's evidence there."""
    state = _gauss_newton(
        problem, explanation, state, log_likelihood, tolerance=tolerance, rival=rival, hopeless=hopeless
    )
    evidence = -state.cost - 0.5 * log_volume(np.hstack([state.slopes, problem.shared]), state.weight)
    prediction = state.run.prediction
    common = problem.shared @ state.shared
    residual = (problem.y - prediction) / problem.sd - common
    return Fit(explanation, state.z, prediction, residual, common, state.slopes, state.weight, evidence)


def damped_update(
    problem: Problem,
    explanation: Explanation,
    start: np.ndarray,
    wanted: np.ndarray,
    common: np.ndarray,
    columns_at: Callable[[np.ndarray], np.ndarray],
    weight: np.ndarray,
) -> tuple[np.ndarray, Linear]:
    """The step from ``start`` towards ``wanted`` that gains most under the nonlinear laws, and the linear fit there.

    ``wanted`` solves the linearised laws, which may be poor where a law is curved. ``columns_at`` gives the columns
    that are fitted in addition to a prediction.
    """
    best: tuple[np.ndarray, Linear] | None = None
    least = np.inf
    for part in STEP_LENGTHS:
        z = np.clip(start + part * (wanted - start), -MOST_COORDINATE, MOST_COORDINATE)
        prediction = problem.predict(explanation, z)
        left = (problem.y - prediction) / problem.sd - common
        if not np.isfinite(left).all():
            continue
        linear = linear_fit(left, columns_at(prediction), weight)
        squares = float(z @ z + linear.coefficients @ linear.coefficients)
        cost = 0.5 * squares - float(log_likelihood(linear.residual)[0].sum())
        if cost < least:
            best, least = (z, linear), cost
    assert best is not None
    return best


Likelihood = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


def bounded(start: np.ndarray) -> Likelihood:
    """Huber log density and weights of residuals, bounded at a multiple of the median of ``start``.

    >>> density, weight = bounded(np.zeros(9))(np.array([2.0, 40.0]))
    >>> density.tolist(), weight.tolist()
    ([-2.0, -187.5], [1.0, 0.125])
    """
    typical = MAD_TO_SD * float(np.median(np.abs(start))) if np.isfinite(start).all() else np.inf
    bound = HUBER_BOUND * max(typical, 1.0)

    def likelihood(residual: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        size = np.maximum(np.abs(residual), 1e-12)
        inside = np.minimum(size, bound)
        return -inside * (size - 0.5 * inside), np.minimum(1.0, bound / size)

    return likelihood


@dataclass(frozen=True, eq=False)
class _State:
    z: np.ndarray
    shared: np.ndarray
    run: Run
    slopes: np.ndarray
    cost: float
    weight: np.ndarray
    exact: bool = True
    """Whether all slopes were computed at these coordinates."""


def _gauss_newton(
    problem: Problem,
    explanation: Explanation,
    state: _State,
    likelihood: Likelihood,
    *,
    tolerance: float,
    rival: float = -np.inf,
    hopeless: float = HOPELESS_BEHIND,
) -> _State:
    """Damped Gauss-Newton steps until the gain is below the tolerance, or the fit is hopelessly behind its rival.

    Every second Jacobian is only corrected along the step, and the others reuse the columns of small corrections to
    base laws; only the last step has a full Jacobian, which the result keeps. A fit given up keeps its last slopes.
    """
    z, shared, run, slopes = state.z, state.shared, state.run, state.slopes
    cost, weight = _cost(problem, run.prediction, z, shared, likelihood)
    damping, exact, secant = DAMPING_START, state.exact, False
    for step_number in range(GAUSS_NEWTON_STEPS):
        columns = np.hstack([slopes, problem.shared])
        scaled = columns * weight[:, None]
        curvature = np.eye(columns.shape[1]) + columns.T @ scaled
        residual = (problem.y - run.prediction) / problem.sd - problem.shared @ shared
        slope = scaled.T @ residual - np.concatenate([z, shared])
        _project_active_bounds(curvature, slope, z)
        if step_number >= STEPS_BEFORE_GIVING_UP and _evidence_bound(cost, slope, curvature) < rival - hopeless:
            break
        for _ in range(DAMPING_TRIALS):
            step = np.linalg.solve(curvature + damping * np.diag(np.diag(curvature)), slope)
            step *= min(1.0, LONGEST_STEP / max(np.max(np.abs(step[: z.size]), initial=0.0), 1e-12))
            moved = np.clip(z + step[: z.size], -MOST_COORDINATE, MOST_COORDINATE)
            moved_shared = shared + step[z.size :]
            tried = problem.run(explanation, moved, run)
            new_cost, new_weight = _cost(problem, tried.prediction, moved, moved_shared, likelihood)
            if np.isfinite(new_cost) and new_cost <= cost:
                break
            damping = max(damping * DAMPING_RISE, DAMPING_RETRY)
        else:
            if exact:
                break
            slopes, exact, secant, damping = problem.jacobian(explanation, z, run), True, False, DAMPING_START
            continue
        near = cost - new_cost < max(tolerance, PRECISION_BEHIND * (rival + cost))
        done, moves, change = near and exact, moved - z, (tried.prediction - run.prediction) / problem.sd
        z, shared, run, cost, weight, exact = moved, moved_shared, tried, new_cost, new_weight, near and not exact
        if done:
            break
        # The secant of a very short step is noise.
        secant = not (near or secant or float(np.max(np.abs(moves), initial=0.0)) < FINITE_STEP)
        damping = max(damping / DAMPING_FALL, LEAST_DAMPING)
        if secant:
            slopes = _secant(slopes, moves, change)
        elif exact:
            slopes, damping = problem.jacobian(explanation, z, run), min(damping, DAMPING_START)
        else:
            slopes = problem.jacobian(explanation, z, run, slopes)
    else:
        slopes, exact = (slopes if exact else problem.jacobian(explanation, z, run)), True
    return _State(z, shared, run, slopes, cost, weight, exact)


def _secant(slopes: np.ndarray, step: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Jacobian after Broyden's update, which reproduces the change of the last step."""
    return slopes + np.outer(change - slopes @ step, step) / float(step @ step)


def _evidence_bound(cost: float, slope: np.ndarray, curvature: np.ndarray) -> float:
    """Bound on the log evidence of a fit: EVIDENCE_BOUND_FACTOR times the gain predicted by the linearised laws."""
    gain = 0.5 * float(slope @ np.linalg.solve(curvature, slope))
    return EVIDENCE_BOUND_FACTOR * gain - cost - 0.5 * float(np.linalg.slogdet(curvature)[1])


def _project_active_bounds(curvature: np.ndarray, slope: np.ndarray, z: np.ndarray) -> None:
    """Remove coordinates at an active bound from the step, in place, so that the others keep their full step."""
    held = np.flatnonzero((np.abs(z) >= MOST_COORDINATE) & (slope[: z.size] * z > 0))
    slope[held] = 0.0
    curvature[held, :] = 0.0
    curvature[:, held] = 0.0
    curvature[held, held] = 1.0


def _cost(
    problem: Problem, prediction: np.ndarray, z: np.ndarray, shared: np.ndarray, likelihood: Likelihood
) -> tuple[float, np.ndarray]:
    residual = (problem.y - prediction) / problem.sd - problem.shared @ shared
    value, weight = likelihood(residual)
    return float(-value.sum() + 0.5 * z @ z + 0.5 * shared @ shared), weight
