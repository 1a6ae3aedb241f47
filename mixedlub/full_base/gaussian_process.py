"""Gaussian process with a quadratic trend, fitted to the values of a smooth function at scattered points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SCALES, NUGGETS = (0.1, 50.0), (1e-8, 0.1)
"""Cost limit. Length scales on the unit cube, and ratios of the variance of scatter to the process, for the search."""
STEPS = 60
"""Cost limit. Iterations of the search for length scales."""
DISTINCT = 1e-3
"""Judgement. Singular value of the terms of the trend over the largest one below which terms count as one."""
EXACT = 1e-20
"""Rounding error. Share of the values' square below which they are constant."""
MARGIN = 0.25
"""Judgement. Share of the span of the values by which predictions may leave it."""
AT_ONCE = 4096
"""Points evaluated together: their matrix of distances fits the cache."""


@dataclass(frozen=True, eq=False)
class Process:
    """Fitted process: points, length scales, weights of the points, trend, and bounds of predictions.

    ``trend``: coefficients of the quadratic terms; ``left_out``: error at each point of a process without this point.
    """

    points: np.ndarray
    scales: np.ndarray
    weights: np.ndarray
    trend: np.ndarray
    bounds: np.ndarray
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
            values[part] = quadratic(points[part]) @ self.trend
            values[part] += covariance(points[part], self.points, self.scales) @ self.weights
        return np.clip(values, *self.bounds)


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

    Combinations of terms that hardly differ at the points, as of features that depend on each other, have no part in
    the trend. Source: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning (2006), sections 2.7
    and 5.4.
    """
    from scipy.optimize import minimize

    size = points.shape[1]
    every = quadratic(points)
    _, large, across = np.linalg.svd(every, full_matrices=False)
    basis = across[large > DISTINCT * large[0]].T
    terms = every @ basis
    start = np.log(np.append(np.ones(size), 1e-4))
    bounds = [tuple(np.log(SCALES))] * size + [tuple(np.log(NUGGETS))]
    search = minimize(
        _loss, start, (points, terms, values), jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": STEPS}
    )
    scales, nugget = np.exp(search.x[:-1]), float(np.exp(search.x[-1]))
    inverse, mean, _ = solved(covariance(points, points, scales) + nugget * np.eye(len(points)), terms, values)
    weights = inverse @ values
    margin = MARGIN * np.ptp(values)
    ends = np.array([np.min(values) - margin, np.max(values) + margin])
    return Process(points, scales, weights, basis @ mean, ends, weights / np.diag(inverse))


def solved(matrix: np.ndarray, terms: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Inverse of a covariance with the trend projected out, coefficients of the trend, and half the logarithms of the
    determinants."""
    from scipy.linalg import cho_factor, cho_solve

    factor = cho_factor(matrix, lower=True)
    whole = cho_solve(factor, np.eye(len(matrix)))
    of_terms = whole @ terms
    normal = terms.T @ of_terms
    inverse = whole - of_terms @ np.linalg.solve(normal, of_terms.T)
    half = np.sum(np.log(np.diag(factor[0]))) + 0.5 * np.linalg.slogdet(normal)[1]
    return inverse, np.linalg.solve(normal, of_terms.T @ values), float(half)


def _loss(log: np.ndarray, points: np.ndarray, terms: np.ndarray, values: np.ndarray) -> tuple[float, np.ndarray]:
    """Negative logarithm of the restricted likelihood at its most probable variance, with the gradient."""
    scales, nugget = np.exp(log[:-1]), float(np.exp(log[-1]))
    own = covariance(points, points, scales)
    inverse, _, half = solved(own + nugget * np.eye(len(own)), terms, values)
    weights = inverse @ values
    power = max(float(values @ weights), EXACT * float(values @ values))
    free = len(values) - terms.shape[1]
    pull = inverse - free / power * np.outer(weights, weights)
    by_own = pull * own
    slopes = [
        0.5 * np.sum(by_own * (points[:, [axis]] - points[:, axis]) ** 2) / scales[axis] ** 2
        for axis in range(points.shape[1])
    ]
    return 0.5 * free * np.log(power) + half, np.array([*slopes, 0.5 * nugget * np.trace(pull)])
