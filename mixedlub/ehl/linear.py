"""Linear algebra of many matrices; a singular matrix does not affect the others."""

from __future__ import annotations

import numpy as np


def times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Product of each matrix with its vector."""
    return np.matmul(matrix, vector[..., None])[..., 0]


def solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Solution of each system; NaN for a singular matrix.

    >>> solved(np.array([[[2.0]], [[0.0]]]), np.array([[1.0], [1.0]])).ravel()
    array([0.5, nan])
    """
    try:
        return np.linalg.solve(matrix, right[..., None])[..., 0]
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan) if matrix.ndim == 2 else np.stack(list(map(solved, matrix, right)))


def inverted(matrix: np.ndarray) -> np.ndarray:
    """Inverse of each matrix; NaN if singular.

    >>> inverted(np.array([[[2.0]], [[0.0]]])).ravel()
    array([0.5, nan])
    """
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return np.full_like(matrix, np.nan) if matrix.ndim == 2 else np.stack(list(map(inverted, matrix)))
