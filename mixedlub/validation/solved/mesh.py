"""Cells along a line contact, and the deflection of two half spaces by a pressure that is constant in each cell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CELLS = 144
"""Cells of a contact: film and friction within some 0.5 % of twice as many (test_solved_contacts.py)."""


@dataclass(frozen=True)
class Mesh:
    """Cells in half widths: ends and middles, and the deflection (b^2/R) at the middles by unit pressures (p_h)."""

    ends: np.ndarray
    middles: np.ndarray
    kernel: np.ndarray

    @property
    def widths(self) -> np.ndarray:
        return np.diff(self.ends)

    @property
    def gaps(self) -> np.ndarray:
        """Distances between the places of pressure: cell middles, and both ends of the domain."""
        return np.diff(np.concatenate([self.ends[:1], self.middles, self.ends[-1:]]))

    @property
    def upstream(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Cell before each end, the cell before that, and the share of their difference that reaches the end."""
        count = len(self.middles)
        before = np.concatenate([[0], np.arange(count)])
        earlier = np.maximum(before - 1, 0)
        between = np.where(before > earlier, self.middles[before] - self.middles[earlier], 1.0)
        lean = np.where(before > earlier, (self.ends - self.middles[before]) / between, 0.0)
        return before, earlier, lean


def to_ends(values: np.ndarray) -> np.ndarray:
    """Values of cells (first axis) at the ends of cells: means of neighbours, the nearest at the ends of the domain."""
    padded = np.concatenate([values[:1], values, values[-1:]])
    return np.asarray(0.5 * (padded[1:] + padded[:-1]))


def kernel(ends: np.ndarray, middles: np.ndarray) -> np.ndarray:
    """-1/pi times the integral of ln|X - X'| over each cell, K. L. Johnson, Contact Mechanics (1985), chapter 2.

    >>> ends = np.linspace(-1, 1, 401)
    >>> middles = 0.5 * (ends[1:] + ends[:-1])
    >>> gap = middles**2 / 2 + kernel(ends, middles) @ np.sqrt(1 - middles**2)
    >>> bool(np.ptp(gap) < 1e-3)  # the gap of a Hertz contact is flat
    True
    """
    away = middles[:, None] - ends[None, :]
    moment = away * (np.log(np.abs(away)) - 1)
    return np.asarray((moment[:, 1:] - moment[:, :-1]) / np.pi)


def mesh(inlet: float, film: float, cells: int = CELLS) -> Mesh:
    """Cells from an inlet (half widths, below -1) for a film in b^2/R, fine where pressure rises and ends.

    Pressure rises over a length of the film to the power 2/3.
    """
    outlet = 1 + max(0.3, 1.5 * np.sqrt(film))
    fine = 0.5 * min(film, 1.0) ** (2 / 3)
    sample = np.linspace(inlet, outlet, 4001)
    density = 1 / (fine + np.abs(sample + 1)) + 1 / (fine + np.abs(sample - 1)) + 1.0
    count = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    ends = np.interp(np.linspace(0, count[-1], cells + 1), count, sample)
    middles = 0.5 * (ends[1:] + ends[:-1])
    return Mesh(ends, middles, kernel(ends, middles))
