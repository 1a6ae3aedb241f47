"""Gaussian process with a quadratic mean, fitted to the values of a smooth function at scattered points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SCALES, NUGGETS = (0.1, 50.0), (1e-9, 0.1)
"""Cost limit. Length scales on the unit cube, and variances of scatter over that of the process, that are tried."""
STEPS = 60
"""Cost limit. Iterations of the search for length scales."""
AT_ONCE = 4096
"""Points evaluated together: their matrix of distances fits the cache."""


@dataclass(frozen=True, eq=False)
class Process:
    """Fitted process: points, length scales, coefficients of the quadratic mean, and weights of the points.

    ``spread``: standard deviation of the process; ``inverse``: inverse of the covariance of the points, over its
    square; ``left_out``: error at each point of the process without this point.
    """

    points: np.ndarray
    scales: np.ndarray
    mean: np.ndarray
    weights: np.ndarray
    left_out: np.ndarray

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Values at points, one per row.

        >>> places = np.random.default_rng(1).uniform(-1.0, 1.0, (60, 2))
        >>> found = fit(places, np.sin(places[:, 0] + 2.0 * places[:, 1]))
        >>> bool(abs(found(np.array([[0.3, 0.1]]))[0] - np.sin(0.5)) < 1e-3)
        True
        """
        values = np.empty(len(points))
        for start in range(0, len(points), AT_ONCE):
            part = slice(start, start + AT_ONCE)
            values[part] = quadratic(points[part]) @ self.mean
            values[part] += covariance(points[part], self.points, self.scales) @ self.weights
        return values


def quadratic(points: np.ndarray) -> np.ndarray:
    """Terms of a polynomial up to the second degree, a column each.

    >>> quadratic(np.array([[2.0, 3.0]])).tolist()
    [[1.0, 2.0, 3.0, 4.0, 6.0, 9.0]]
    """
    first, second = np.triu_indices(points.shape[1])
    return np.column_stack([np.ones(len(points)), points, points[:, first] * points[:, second]])


def covariance(points: np.ndarray, others: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Squared-exponential covariance of points with other points."""
    a, b = points / scales, others / scales
    half = a @ b.T
    half -= 0.5 * np.sum(a**2, axis=1)[:, None]
    half -= 0.5 * np.sum(b**2, axis=1)
    np.minimum(half, 0.0, out=half)
    found: np.ndarray = np.exp(half, out=half)
    return found


def fit(points: np.ndarray, values: np.ndarray) -> Process:
    """Process with the length scales and scatter of largest restricted likelihood.

    Source: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning (2006), sections 2.7 and 5.4.2.
    """
    from scipy.optimize import minimize

    count, size = points.shape
    start = np.log(np.append(np.ones(size), 1e-4))
    bounds = [tuple(np.log(SCALES))] * size + [tuple(np.log(NUGGETS))]
    search = minimize(
        _loss, start, (points, values), jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": STEPS}
    )
    scales, nugget = np.exp(search.x[:-1]), np.exp(search.x[-1])
    matrix = covariance(points, points, scales) + nugget * np.eye(count)
    inverse, mean, _ = _solved(matrix, quadratic(points), values)
    weights = inverse @ values
    return Process(points, scales, mean, weights, weights / np.diag(inverse))


def _solved(matrix: np.ndarray, terms: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Inverse of the covariance with the mean projected out, coefficients of the mean, and the loss."""
    from scipy.linalg import cho_factor, cho_solve

    factor = cho_factor(matrix, lower=True)
    whole = cho_solve(factor, np.eye(len(matrix)))
    of_terms = whole @ terms
    normal = terms.T @ of_terms
    inverse = whole - of_terms @ np.linalg.solve(normal, of_terms.T)
    mean = np.linalg.solve(normal, of_terms.T @ values)
    free = len(values) - terms.shape[1]
    power = max(float(values @ inverse @ values), np.finfo(float).tiny)
    loss = 0.5 * free * np.log(power) + np.sum(np.log(np.diag(factor[0]))) + 0.5 * np.linalg.slogdet(normal)[1]
    return inverse, mean, float(loss)


def _loss(log: np.ndarray, points: np.ndarray, values: np.ndarray) -> tuple[float, np.ndarray]:
    """Negative logarithm of the restricted likelihood, its variance maximised out, with the gradient."""
    scales, nugget = np.exp(log[:-1]), np.exp(log[-1])
    own = covariance(points, points, scales)
    inverse, _, loss = _solved(own + nugget * np.eye(len(own)), quadratic(points), values)
    weights = inverse @ values
    power = max(float(values @ weights), np.finfo(float).tiny)
    terms = len(quadratic(points[:1])[0])
    pull = inverse - (len(values) - terms) / power * np.outer(weights, weights)
    by_own = pull * own
    slopes = [
        0.5 * np.sum(by_own * (points[:, [axis]] - points[:, axis]) ** 2) / scales[axis] ** 2
        for axis in range(points.shape[1])
    ]
    return loss, np.array([*slopes, 0.5 * nugget * np.trace(pull)])
