"""Functions across the film, from the first wall (-1/2) to the second (1/2), at Chebyshev nodes."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev

COUNT = 11
"""Nodes across: friction agrees within 0.05 % with 13 nodes, within 0.7 % with 17 in fast thick films."""
NODES = -0.5 * np.cos(np.pi * np.arange(COUNT) / (COUNT - 1))
"""Positions across, in film thicknesses."""
_FROM_VALUES = np.linalg.inv(chebyshev.chebvander(2.0 * NODES, COUNT - 1))


def _matrix(change: np.ndarray) -> np.ndarray:
    """A linear operation on Chebyshev coefficients as a matrix on values at the nodes."""
    rows = chebyshev.chebvander(2.0 * NODES, change.shape[0] - 1)
    return rows @ change @ _FROM_VALUES


DERIVATIVE = _matrix(2.0 * chebyshev.chebder(np.eye(COUNT)))
"""Derivative at the nodes."""
SECOND = DERIVATIVE @ DERIVATIVE
"""Second derivative at the nodes."""
RUNNING = _matrix(0.5 * chebyshev.chebint(np.eye(COUNT), lbnd=-1))
"""Integral from the first wall to each node."""
WEIGHTS = RUNNING[-1]
"""Integral across: Clenshaw and Curtis."""


def mean(values: np.ndarray) -> np.ndarray:
    """Mean across the film; an axis of length one is a constant.

    >>> round(float(mean(NODES**4)), 9), float(mean(np.array([3.0])))   # 1/80
    (0.0125, 3.0)
    """
    return values[..., 0] if values.shape[-1] == 1 else values @ WEIGHTS
