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
AT_ONCE = 256
"""Points evaluated together: their matrix of distances fits the cache."""
SQUARINGS = 4
"""Cost limit. The covariance is a rational quadratic with the exponent 2 to this number, 16: the errors at left-out
solutions are those of the squared exponential, and a point costs a third of its time."""


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
        values = quadratic(points) @ self.trend
        for start in range(0, len(points), AT_ONCE):
            part = slice(start, start + AT_ONCE)
            values[part] += covariance(points[part], self.points, self.scales) @ self.weights
        return np.asarray(np.clip(values, *self.bounds))

    def slopes(self, points: np.ndarray) -> np.ndarray:
        """Derivatives of the values by the coordinates, one row per point; zero where a value is at its bounds.

        >>> places = np.random.default_rng(1).uniform(-1.0, 1.0, (60, 2))
        >>> found = fit(places, np.sin(places[:, 0] + 2.0 * places[:, 1]))
        >>> (found.slopes(np.array([[0.3, 0.1]]))[0] / np.cos(0.5)).round(1).tolist()
        [1.0, 2.0]
        """
        linear, curved = self.trend[1 : points.shape[1] + 1], np.zeros((points.shape[1],) * 2)
        curved[np.triu_indices(points.shape[1])] = self.trend[points.shape[1] + 1 :]
        found = linear + points @ (curved + curved.T)
        pulls = np.column_stack([self.weights, self.weights[:, None] * self.points])
        for start in range(0, len(points), AT_ONCE):
            part, own = points[start : start + AT_ONCE], found[start : start + AT_ONCE]
            near = nearness(part, self.points, self.scales)
            held = powered(near)
            values = quadratic(part) @ self.trend + held @ self.weights
            pulled = np.multiply(held, near, out=near) @ pulls
            own += (pulled[:, 1:] - part * pulled[:, :1]) / self.scales**2
            own[(values <= self.bounds[0]) | (values >= self.bounds[1])] = 0.0
        return np.asarray(found)


def quadratic(points: np.ndarray) -> np.ndarray:
    """Terms of a polynomial up to the second degree, a column each.

    >>> quadratic(np.array([[2.0, 3.0]])).tolist()
    [[1.0, 2.0, 3.0, 4.0, 6.0, 9.0]]
    """
    first, second = np.triu_indices(points.shape[1])
    return np.column_stack([np.ones(len(points)), points, points[:, first] * points[:, second]])


def nearness(points: np.ndarray, others: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Reciprocal of 1 + r^2/(2 a) of points and other points, with their distance r in scales and the exponent a."""
    a, b, exponent = points / scales, others / scales, 2.0**SQUARINGS
    one = np.ones((1, 1))
    left = np.hstack([a, exponent + 0.5 * np.sum(a**2, axis=1, keepdims=True), one.repeat(len(a), axis=0)])
    right = np.hstack([-b, one.repeat(len(b), axis=0), 0.5 * np.sum(b**2, axis=1, keepdims=True)])
    size = left @ right.T
    return np.asarray(np.divide(exponent, np.maximum(size, exponent, out=size), out=size))


def covariance(points: np.ndarray, others: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Rational quadratic covariance of points with other points.

    >>> near, far = np.zeros((1, 1)), np.array([[2.0]])
    >>> round(float(covariance(near, far, np.ones(1))[0, 0] * (1.0 + 4.0 / 32.0) ** 16), 12)
    1.0
    """
    return powered(nearness(points, others, scales))


def powered(near: np.ndarray) -> np.ndarray:
    """Covariance of a nearness."""
    found = near
    for _ in range(SQUARINGS):
        found = np.multiply(found, found, out=None if found is near else found)
    return found


def fit(points: np.ndarray, values: np.ndarray) -> Process:
    """Process with the length scales and scatter of largest restricted likelihood.

    Combinations of terms that hardly differ at the points, as of features that depend on each other, have no part in
    the trend. Source: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning (2006), sections 2.7,
    4.2.1 and 5.4.
    """
    from scipy.optimize import minimize

    size = points.shape[1]
    every = quadratic(points)
    _, large, across = np.linalg.svd(every, full_matrices=False)
    basis = across[large > DISTINCT * large[0]].T
    terms = every @ basis
    # The likelihood does not depend on a trend in the values, and values without it round off less.
    plain = np.linalg.lstsq(terms, values)[0]
    rest = values - terms @ plain
    start = np.log(np.append(np.ones(size), 1e-4))
    bounds = [tuple(np.log(SCALES))] * size + [tuple(np.log(NUGGETS))]
    search = minimize(
        _loss, start, (points, terms, rest), jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": STEPS}
    )
    scales, nugget = np.exp(search.x[:-1]), float(np.exp(search.x[-1]))
    inverse, mean, _ = solved(covariance(points, points, scales) + nugget * np.eye(len(points)), terms, rest)
    weights = inverse @ rest
    margin = MARGIN * np.ptp(values)
    ends = np.array([np.min(values) - margin, np.max(values) + margin])
    return Process(points, scales, weights, basis @ (plain + mean), ends, weights / np.diag(inverse))


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
    near = nearness(points, points, scales)
    own = powered(near)
    inverse, _, half = solved(own + nugget * np.eye(len(own)), terms, values)
    weights = inverse @ values
    power = max(float(values @ weights), EXACT * float(values @ values))
    free = len(values) - terms.shape[1]
    pull = inverse - free / power * np.outer(weights, weights)
    by_own = pull * own * near
    slopes = [
        0.5 * np.sum(by_own * (points[:, [axis]] - points[:, axis]) ** 2) / scales[axis] ** 2
        for axis in range(points.shape[1])
    ]
    return 0.5 * free * np.log(power) + half, np.array([*slopes, 0.5 * nugget * np.trace(pull)])
