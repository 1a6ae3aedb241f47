"""Energy equation along the film: convection by the oil, and walls with memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl.across import COUNT, DERIVATIVE
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.line_contacts import Contacts, Solids
from mixedlub.ehl.linear import inverted, times
from mixedlub.ehl.oil.oil import Oil

ENDS = (0, -1)
"""Nodes on the walls."""


SLOW = 0.05
"""Velocity relative to the largest across the film, below which a layer is treated as partly reversed."""


@dataclass(frozen=True)
class Energy:
    """Linear energy equation of each column without convection along the film: matrix and right-hand side.

    ``capacity``: density times heat capacity times velocity (W/(m^2 K)). ``before``: present temperatures.
    """

    matrix: np.ndarray
    known: np.ndarray
    capacity: np.ndarray
    gap: np.ndarray
    before: np.ndarray


def march(oil: Oil, contacts: Contacts, grid: Grid, energy: Energy) -> tuple[np.ndarray, np.ndarray]:
    """Temperatures at nodes and across (K), and flux into the walls in the cell before each node (W/m^2).

    Oil enters at its inlet temperature and is convected in both directions by first-order upwind differences: in
    reverse flow, columns are eliminated from downstream, with the present temperatures of their walls. Walls are
    fast-moving half spaces that enter at their bulk temperature.
    """
    cases, nodes = grid.x.shape
    steps = (grid.steps * contacts.half_width[:, None])[..., None]
    forward = np.pad(np.maximum(energy.capacity[:, 1:], 0.0) / steps, ((0, 0), (1, 0), (0, 0)))
    backward = np.pad(np.maximum(-energy.capacity[:, :-1], 0.0) / steps, ((0, 0), (0, 1), (0, 0)))
    matrix, known = energy.matrix, energy.known
    place = np.arange(COUNT)
    matrix[..., place, place] += forward + backward
    forward[..., ENDS] = backward[..., ENDS] = 0.0
    outward = oil.conductivity * np.stack([DERIVATIVE[0], -DERIVATIVE[-1]]) / energy.gap[..., None, None]
    response = np.stack([_wall_response(contacts, grid, wall) for wall in (contacts.first, contacts.second)], axis=1)
    own = np.moveaxis(np.einsum("kwjj->kwj", response), 1, 2)[..., None]
    matrix[..., ENDS, :] = np.eye(COUNT)[ENDS, :] - own * outward
    known[..., ENDS] = energy.before[..., ENDS] - times(own * outward, energy.before)
    inverse = _eliminated(matrix, known, forward, backward)
    bulk = np.stack([contacts.first.temperature, contacts.second.temperature], axis=1)
    temperature = np.empty((cases, nodes, COUNT))
    temperature[:, 0] = contacts.oil_temperature[:, None]
    temperature[:, 0, ENDS] = bulk
    walls = np.zeros((cases, 2, nodes))
    for node in range(1, nodes):
        right = known[:, node] + forward[:, node] * temperature[:, node - 1]
        right[:, ENDS] = bulk + np.matmul(response[:, :, node, None, 1:node], walls[:, :, 1:node, None])[..., 0, 0]
        temperature[:, node] = times(inverse[:, node], right)
        walls[:, :, node] = times(outward[:, node], temperature[:, node])
    temperature[:, 0] += leaving(energy.capacity[:, 0]) * (temperature[:, 1] - temperature[:, 0])
    return temperature, walls


def leaving(flow: np.ndarray) -> np.ndarray:
    """Share of reverse flow in each layer: 0 or 1 except in slow layers, in which the sign may still change.

    >>> leaving(np.array([2.0, 0.0, -1.0])).round(3)
    array([0.001, 0.5  , 0.998])
    """
    slow = SLOW * np.max(np.abs(flow), axis=-1, keepdims=True)
    return 0.5 * (1.0 - flow / np.hypot(flow, slow))


def _eliminated(matrix: np.ndarray, known: np.ndarray, forward: np.ndarray, backward: np.ndarray) -> np.ndarray:
    """Inverse of each column's matrix after elimination of the downstream columns with reverse flow; in place."""
    back = np.nonzero(np.any(backward > 0.0, axis=(0, 2)))[0]
    last = int(back[-1]) if len(back) else 0
    inverse = np.empty_like(matrix)
    inverse[:, last + 1 :] = inverted(matrix[:, last + 1 :])
    for node in range(last, 0, -1):
        behind, share = inverse[:, node + 1], backward[:, node, :, None]
        known[:, node] += share[..., 0] * times(behind, known[:, node + 1])
        matrix[:, node] -= share * behind * forward[:, node + 1, None, :]
        inverse[:, node] = inverted(matrix[:, node])
    return inverse


def _wall_response(contacts: Contacts, grid: Grid, wall: Solids) -> np.ndarray:
    r"""Temperature rise of a wall at each node from a flux in the cell before each node (K m^2/W).

    .. math:: \Delta T(x) = \frac{1}{\sqrt{\pi k\rho c\,u}}\sum_j q_j\,2\left(\sqrt{x - x_{j-1}} - \sqrt{x - x_j}\right)

    Source: H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. (1959), section 2.9.
    """
    x = grid.x * contacts.half_width[:, None]
    root = np.sqrt(np.maximum(x[:, :, None] - x[:, None, :], 0.0))
    response = np.zeros_like(root)
    response[:, :, 1:] = 2.0 * (root[:, :, :-1] - root[:, :, 1:])
    return response / (np.sqrt(np.pi * wall.speed) * wall.effusivity)[:, None, None]
