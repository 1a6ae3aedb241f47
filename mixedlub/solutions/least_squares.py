"""Ordinary least squares of readings over named columns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.stats import t as student


@dataclass(frozen=True, eq=False)
class LinearFit:
    """Ordinary least squares: coefficients with standard errors by name, residuals, and leverages of the readings."""

    coefficients: pd.Series
    standard_errors: pd.Series
    residuals: np.ndarray
    leverages: np.ndarray
    total_squares: float

    @property
    def freedom(self) -> int:
        """Number of readings less that of coefficients."""
        return len(self.residuals) - len(self.coefficients)

    @property
    def squares(self) -> float:
        """Sum of squared residuals."""
        return float(self.residuals @ self.residuals)

    @property
    def p_values(self) -> pd.Series:
        """Two-sided p-values of the coefficients."""
        t_values = (self.coefficients / self.standard_errors).abs()
        return pd.Series(2.0 * student.sf(t_values, self.freedom), index=t_values.index)

    @property
    def standardised_residuals(self) -> np.ndarray:
        """Internally studentised residuals."""
        return self.residuals / np.sqrt(self.squares / self.freedom * (1.0 - self.leverages))


def least_squares(design: pd.DataFrame, wanted: np.ndarray) -> LinearFit:
    """Ordinary least squares of readings over the columns of a design, one of which is constant.

    >>> x = np.arange(4.0)
    >>> fit = least_squares(pd.DataFrame({"one": 1.0, "x": x}), np.array([1.0, 3.1, 4.9, 7.0]))
    >>> fit.coefficients.round(2).tolist(), fit.standard_errors.round(4).tolist(), fit.p_values.round(4).tolist()
    ([1.03, 1.98], [0.0794, 0.0424], [0.0059, 0.0005])
    """
    values = design.to_numpy()
    inverse = np.linalg.pinv(values)
    found = inverse @ wanted
    residuals = wanted - values @ found
    variance = residuals @ residuals / (len(wanted) - len(found))
    return LinearFit(
        pd.Series(found, index=design.columns),
        pd.Series(np.sqrt(variance * (inverse**2).sum(axis=1)), index=design.columns),
        residuals,
        np.einsum("ij,ji->i", values, inverse),
        float(((wanted - wanted.mean()) ** 2).sum()),
    )
