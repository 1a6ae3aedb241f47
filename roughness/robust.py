"""Profile filters robust to outliers and steps: robust Gaussian regression and spline."""

from __future__ import annotations

import numpy as np

from profiles import InputError
from roughness.filters import gaussian_kernel, local_regression

_BIWEIGHT = 4.4478
"""Cut of the biweight over the median absolute residual: three sigma of a Gaussian (ISO 16610-31, eq. 5)."""


def robust_mean_line(
    heights: np.ndarray,
    spacing: float,
    cutoff: float,
    *,
    valid: np.ndarray | None = None,
    order: int = 2,
    tolerance: float = 1e-4,
    most: int = 60,
) -> np.ndarray:
    r"""Robust Gaussian regression mean line (m): deep valleys and spikes lose their weight.

    .. math:: \delta_l = [1 - ((z_l - w_l)/c_B)^2]^2 \ \text{within}\ c_B = 4.4478\,\mathrm{med}|z - w|

    Local polynomials of ``order`` 0, 1 or 2 under Gaussian times biweight, repeated until the median changes
    by less than ``tolerance``. On Gaussian roughness the biweight lowers the transmission at the cut-off from
    0.50 to 0.39. No length is lost. Every sum is a convolution: n log n a round.
    ISO 16610-31:2010, eq. 1 to 5. The local polynomial passes more of the long waves than the plain
    Gaussian: order 2 would transmit 85 % at the cut-off, so the standard widens its weights by 1.556.

    >>> z = np.zeros(400); z[200:210] = -5e-6
    >>> bool(np.abs(robust_mean_line(z + 1e-9 * np.sin(np.arange(400)), 1e-6, 80e-6)).max() < 1e-8)
    True
    """
    if order not in (0, 1, 2):
        raise InputError("must be 0, 1 or 2", where="order of the robust filter", value=order)
    kernel = regression_kernel(cutoff, spacing, order)
    weights = np.ones(heights.size) if valid is None else valid.astype(float)
    known = weights.copy()
    mean_line = local_regression(heights, weights, kernel, order=order)
    before = np.inf
    for _ in range(most):
        residual = heights - mean_line
        middle = float(np.median(np.abs(residual[known > 0])))
        if middle <= 1e-12 * float(np.ptp(heights)) or abs(middle - before) <= tolerance * middle:
            return mean_line
        before = middle
        share = residual / (_BIWEIGHT * middle)
        weights = known * np.where(np.abs(share) < 1.0, (1.0 - share**2) ** 2, 0.0)
        mean_line = local_regression(heights, weights, kernel, order=order)
    return mean_line


def spline_mean_line(heights: np.ndarray, spacing: float, cutoff: float) -> np.ndarray:
    r"""Cubic smoothing spline mean line (m), open profile, ends free.

    .. math:: (1 + \alpha^4 Q)\,w = z, \qquad \alpha = \frac{1}{2\sin(\pi\Delta x/\lambda_c)}

    Q is the product of second differences with themselves, natural at the ends; half transmission at the
    cut-off, :math:`1/[1 + (\sin(\pi\Delta x/\lambda)/\sin(\pi\Delta x/\lambda_c))^4]` elsewhere.
    Banded Cholesky, linear in the number of points. ISO 16610-22:2015, eq. 1 to 3.

    >>> x = np.arange(4000)
    >>> left = np.sin(2 * np.pi * x / 400) - spline_mean_line(np.sin(2 * np.pi * x / 400), 1.0, 400.0)
    >>> round(float(left[1000:3000].max()), 3)
    0.5
    """
    from scipy.linalg import solveh_banded

    if not 2.0 * spacing < cutoff:
        raise InputError(
            f"must be above two points of {spacing * 1e6:g} um",
            where="filter cut-off (um)",
            value=cutoff * 1e6,
        )
    stiffness = (2.0 * np.sin(np.pi * spacing / cutoff)) ** -4.0
    n = heights.size
    bands = np.zeros((3, n))
    bands[0, 2:] = stiffness
    bands[1, 1:] = -4.0 * stiffness
    bands[1, [1, -1]] = -2.0 * stiffness
    bands[2] = 6.0 * stiffness
    bands[2, [1, -2]] = 5.0 * stiffness
    bands[2, [0, -1]] = stiffness
    bands[2] += 1.0
    return solveh_banded(bands, heights, check_finite=False)


def regression_kernel(cutoff: float, spacing: float, order: int) -> np.ndarray:
    """Gaussian weights for a local polynomial that transmits one half at the cut-off.

    For orders 0 and 1 the plain Gaussian does. Order 2 transmits (1 + t) exp(-t), t = pi (alpha g lc/l)^2: t = 1.67835
    at one half, and g = sqrt(t / ln 2).
    """
    return gaussian_kernel(cutoff * (1.5560 if order == 2 else 1.0), spacing)
