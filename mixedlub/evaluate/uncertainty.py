"""Uncertainty of linear combinations of readings, with independent and common errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

NORMAL_90 = 1.6448536269514722
"""Half width of the 90 % interval of a normal distribution, in standard deviations."""


@dataclass(frozen=True, eq=False)
class Errors:
    """Errors of n readings: independent sd (n,), and effect of one sd of each common source on each reading."""

    independent: np.ndarray
    common: Mapping[str, np.ndarray] = field(default_factory=dict)

    def budget(self, weights: np.ndarray) -> dict[str, np.ndarray]:
        """Standard deviation of ``weights @ readings`` by source of error, for each row of ``weights``.

        >>> three = Errors(np.full(4, 0.2), {"offset": np.full(4, 0.3)})
        >>> print({name: round(float(sd), 3) for name, sd in three.budget(np.full(4, 0.25)).items()})
        {'readings': 0.1, 'offset': 0.3}
        """
        own = np.sqrt((weights * self.independent) ** 2 @ np.ones_like(self.independent))
        return {"readings": own, **{name: np.abs(weights @ moved) for name, moved in self.common.items()}}

    def sd(self, weights: np.ndarray) -> np.ndarray:
        """Standard deviation of ``weights @ readings``."""
        return combined(self.budget(weights))


def combined(budget: Mapping[str, np.ndarray]) -> np.ndarray:
    """Root of the sum of squares of the sources.

    >>> float(combined({"a": np.array(3.0), "b": np.array(4.0)}))
    5.0
    """
    return np.sqrt(sum((np.asarray(sd) ** 2 for sd in budget.values()), np.array(0.0)))


def interval(
    name: str, value: np.ndarray, sd: np.ndarray, own: np.ndarray | float = 0.0, wider: float = 1.0
) -> dict[str, np.ndarray]:
    """Columns of a value with standard deviation and 90 % interval.

    ``own``: part of ``sd`` estimated from few readings, widened by ``wider`` in the interval only.

    >>> found = interval("mean_friction", np.array([0.04]), np.array([0.002]), own=np.array([0.002]), wider=2.0)
    >>> print({name: round(float(one[0]), 4) for name, one in found.items()})
    {'mean_friction': 0.04, 'mean_friction_sd': 0.002, 'mean_friction_low90': 0.0334, 'mean_friction_high90': 0.0466}
    """
    half = NORMAL_90 * np.sqrt(np.square(sd) + (wider**2 - 1.0) * np.square(own))
    return {name: value, f"{name}_sd": sd, f"{name}_low90": value - half, f"{name}_high90": value + half}
