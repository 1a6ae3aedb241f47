"""Graded grid of a line contact, deflection of its solids, and load of a pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl.batch import Batch

EDGE_CELL, GROWTH, INNER_CELL = 0.06, 0.10, 0.04
"""Cell at the Hertz edges over film^(2/3), growth of cells away from the edges, largest cell between them."""
LEAST_INLET, INLET_FILMS = 2.5, 50.0
"""Smallest length of a flooded inlet (half widths), and its gap relative to the central film."""
LEAST_OUTLET = 0.25
"""Smallest length of the domain behind the Hertz edge (half widths)."""
SAMPLES = 4001
"""Samples of the cell size; the nodes are quantiles of its distribution."""


@dataclass(frozen=True)
class Grid(Batch):
    """Nodes (half widths), deflection by a pressure (b^2/R per p_h), and weights of the load."""

    x: np.ndarray
    kernel: np.ndarray
    weights: np.ndarray

    @property
    def steps(self) -> np.ndarray:
        """Distances between nodes."""
        return np.diff(self.x, axis=1)


def flooded_inlet(film: np.ndarray) -> np.ndarray:
    """Start of the domain of a flooded contact (half widths), for a central film in b^2/R."""
    return -np.maximum(LEAST_INLET, 1.0 + 1.5 * np.sqrt(INLET_FILMS * film))


def grid(inlet: np.ndarray, film: np.ndarray, nodes: int) -> Grid:
    """Grid of each contact from its inlet (half widths), graded for a central film in b^2/R.

    Every second node of 2n - 1 is a node of n, so that the grids make a Richardson pair.

    >>> fine, coarse = (grid(np.array([-3.0]), np.array([0.1]), n).x[0] for n in (241, 121))
    >>> bool(np.allclose(fine[::2], coarse))
    True
    """
    outlet = 1.0 + np.maximum(LEAST_OUTLET, 1.2 * np.sqrt(film))
    sample = inlet[:, None] + (outlet - inlet)[:, None] * np.linspace(0.0, 1.0, SAMPLES)
    edge = (EDGE_CELL * np.minimum(film, 1.0) ** (2.0 / 3.0))[:, None]
    away = np.minimum(np.abs(sample + 1.0), np.abs(sample - 1.0))
    cell = edge + GROWTH * np.maximum(away - 2.0 * edge, 0.0)
    cell = np.where(np.abs(sample) < 1.0, np.minimum(cell, INNER_CELL), cell)
    count = np.cumsum(0.5 * (1.0 / cell[:, 1:] + 1.0 / cell[:, :-1]) * np.diff(sample, axis=1), axis=1)
    count = np.pad(count, ((0, 0), (1, 0)))
    wanted = np.linspace(0.0, 1.0, nodes)
    x = np.empty((len(inlet), nodes))
    for case, (counted, place) in enumerate(zip(count, sample, strict=True)):
        x[case] = np.interp(wanted * counted[-1], counted, place)
    return Grid(x, deflection(x), load_weights(x))


def load_weights(x: np.ndarray) -> np.ndarray:
    """Weights of nodal pressures in the load: the trapezoidal rule."""
    half = 0.5 * np.diff(x, axis=1)
    return np.pad(half, ((0, 0), (1, 0))) + np.pad(half, ((0, 0), (0, 1)))


def deflection(x: np.ndarray) -> np.ndarray:
    r"""Matrix from nodal pressures (p_h) to the deflection of both solids (b^2/R), exact for linear pressure in cells.

    .. math:: \delta(X) = -\frac{1}{\pi}\int \ln|X - X'|\,P(X')\,dX'

    Source: two elastic half spaces in plane strain, K. L. Johnson, Contact Mechanics (1985), chapter 2; the moments of
    the logarithm over a cell are elementary.

    >>> x = np.linspace(-1.5, 1.5, 301)[None]
    >>> gap = deflection(x)[0] @ np.sqrt(np.maximum(1.0 - x[0] ** 2, 0.0)) + x[0] ** 2 / 2
    >>> bool(np.ptp(gap[np.abs(x[0]) <= 1.0]) < 5e-4)   # Hertz: the gap is flat
    True
    """
    away = x[:, :, None] - x[:, None, :]
    log = np.log(np.abs(away) + (away == 0.0))
    zeroth = away * (log - 1.0)
    first = 0.5 * away**2 * (log - 0.5)
    cell0, cell1 = zeroth[:, :, :-1] - zeroth[:, :, 1:], first[:, :, :-1] - first[:, :, 1:]
    width = np.diff(x, axis=1)[:, None, :]
    matrix = np.zeros_like(away)
    matrix[:, :, 1:] = (away[:, :, :-1] * cell0 - cell1) / width
    matrix[:, :, :-1] += (cell1 - away[:, :, 1:] * cell0) / width
    return matrix / -np.pi
