"""Unknowns: pressure, approach, temperature across the film, and shear stress."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl.batch import Batch
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.linear import times


@dataclass(frozen=True)
class State(Batch):
    """Pressure (Hertz pressures) at nodes, approach (b^2/R), temperature (K) at nodes and across, and stress (Pa).

    The stress is taken in the middle of the film, at the left and right side of each cell.
    """

    pressure: np.ndarray
    approach: np.ndarray
    temperature: np.ndarray
    stress: np.ndarray

    def gap(self, grid: Grid) -> np.ndarray:
        """Gap at nodes (b^2/R)."""
        return self.approach[:, None] + 0.5 * grid.x**2 + times(grid.kernel, self.pressure)
