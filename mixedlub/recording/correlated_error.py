"""Correlated error: a slow drift of the readings with an exponential autocorrelation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.recording.conditions import clock_of
from mixedlub.schema.table import Table

READINGS_PER_COLUMN = 3
"""Judgement. Readings to each of its columns: faster components cannot be separated from white noise."""
MOST_COLUMNS = 48
"""Cost limit. Most columns."""
NEWTON_STEPS = 20
"""Judgement. Newton steps to the roots of the frequency equation: more than double precision needs."""


@dataclass(frozen=True)
class CorrelatedError:
    r"""A correlated error of ``size`` times the noise of a single reading; zero is none.

    Its covariance is :math:`s^2 e^{-|q - q'|/l}` with q the share of the record and l the ``length``: an
    Ornstein-Uhlenbeck process, an autoregression of order one at equal steps (G. E. Uhlenbeck, L. S. Ornstein, Phys.
    Rev. 36 (1930) 823). The record is from ``start`` over ``span`` on its clock, and has ``count`` columns.
    """

    size: float = 0.0
    length: float = 1.0
    start: float = 0.0
    span: float = 1.0
    count: int = 1

    @classmethod
    def over(cls, clock: np.ndarray, size: float, length: float) -> CorrelatedError:
        """The error over the record of a clock, with as many columns as its readings can resolve."""
        count = max(min(clock.size // READINGS_PER_COLUMN, MOST_COLUMNS), 1)
        return cls(size, length, float(clock.min()), float(np.ptp(clock)), count)

    @property
    def total_sd(self) -> float:
        """Total standard deviation of a reading, relative to the white noise."""
        return float(np.hypot(1.0, self.size))

    @property
    def correlation_time(self) -> float:
        """Correlation time on the clock."""
        return self.length * self.span

    def columns(self, rows: Table) -> np.ndarray:
        """Columns (n, m), in the noise of a single reading, with standard-normal coefficients."""
        clock = clock_of(rows, ties=True) if self.size else None
        if clock is None:
            return np.zeros((len(rows), 0))
        return self.size * karhunen_loeve_columns((clock - self.start) / self.span, self.length, self.count)


UNCORRELATED = CorrelatedError()
"""No correlated error."""


def karhunen_loeve_columns(share: np.ndarray, length: float, count: int) -> np.ndarray:
    r"""Leading Karhunen-Loeve components over shares 0 to 1, each times its standard deviation; total variance one.

    .. math:: \sqrt{\lambda}\,\frac{\cos(\omega x)}{\sqrt{(1 + \sin\omega/\omega)/2}},\quad
              \lambda = \frac{2 l}{1 + (\omega l)^2},\quad x = q - \tfrac12

    and sines with a minus sign between them; omega = m pi + 2 arctan(1/(omega l)). Karhunen-Loeve expansion of the
    exponential covariance: R. G. Ghanem, P. D. Spanos, Stochastic Finite Elements, Springer (1991), section 2.3. A
    truncated series is a little smoother, and is scaled to the whole variance.

    >>> columns = karhunen_loeve_columns(np.array([0.2, 0.5, 0.6]), 0.2, 400)
    >>> (columns @ columns.T)[1].round(2).tolist()   # exp(-1.5), 1, exp(-0.5)
    [0.22, 1.0, 0.61]
    """
    order = np.arange(count)
    omega = np.pi * (order + 1.0)
    for _ in range(NEWTON_STEPS):
        over = omega - np.pi * order - 2.0 * np.arctan(1.0 / (omega * length))
        omega = omega - over / (1.0 + 2.0 * length / (1.0 + (omega * length) ** 2))
    even = order % 2 == 0
    phase = omega * (share[:, None] - 0.5)
    variance = 2.0 * length / (1.0 + (omega * length) ** 2)
    square = 0.5 * (1.0 + np.where(even, 1.0, -1.0) * np.sin(omega) / omega)
    return np.where(even, np.cos(phase), np.sin(phase)) * np.sqrt(variance / (square * variance.sum()))
