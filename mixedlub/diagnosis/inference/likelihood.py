"""Likelihood of residuals: normal noise with rare wide errors."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.settings.inference import OUTLIER_SHARE, OUTLIER_WIDTH

_LOG_IN = np.log1p(-OUTLIER_SHARE)
_LOG_OUT = np.log(OUTLIER_SHARE / OUTLIER_WIDTH * np.sqrt(2.0 / np.pi))


def log_likelihood(residual: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Log density of residuals under normal noise with rare Cauchy errors, and each one's precision weight.

    The Cauchy tail bounds the influence of a single outlier on the fit.

    >>> bool(log_likelihood(np.array([8.0]))[1][0] < 0.02)
    True
    """
    inside, outside = _log_parts(residual)
    total = np.logaddexp(inside, outside)
    chance = np.exp(outside - total)
    return total, 1.0 - chance * (1.0 - 2.0 / (OUTLIER_WIDTH**2 + residual**2))


def _log_parts(residual: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Log density as good reading and as outlier, both with the same constant left out."""
    return _LOG_IN - 0.5 * residual**2, _LOG_OUT - np.log1p((residual / OUTLIER_WIDTH) ** 2)


def outlier_chance(residual: np.ndarray) -> np.ndarray:
    """Probability that each residual came from the wide errors.

    >>> outlier_chance(np.array([0.0, 6.0])).round(3).tolist()
    [0.001, 1.0]
    """
    inside, outside = _log_parts(residual)
    return np.exp(outside - np.logaddexp(inside, outside))
