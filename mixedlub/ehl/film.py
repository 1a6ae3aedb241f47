"""A Newton step of pressure and approach, with cavitation behind the contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.ehl.flow import Flow, flow
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.linear import solved, times
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

LARGEST_STEP = 0.3
"""Largest change of a pressure in a step (Hertz pressures)."""
CLOSING = 0.8
"""Largest relative decrease of a gap in a step."""
LOAD = 0.5 * np.pi
"""Integral of the pressure, in Hertz units."""


def film_step(oil: Oil, contacts: Contacts, grid: Grid, state: State) -> tuple[State, np.ndarray]:
    """State after a Newton step at fixed temperatures, and the largest change of pressure before step limits.

    The film cavitates at nodes with negative pressure downstream of the pressure maximum; there, zero pressure replaces
    the balance of mass.
    """
    gap = state.gap(grid)
    now = flow(oil, contacts, grid, state, gap)
    matrix, rest = balance(grid, now)
    hold(matrix, rest, broken(matrix, rest, state.pressure), state.pressure)
    matrix[:, -1, :-1], rest[:, -1] = grid.weights, np.sum(grid.weights * state.pressure, axis=1) - LOAD
    change = -solved(matrix, rest)
    wanted, approach = change[:, :-1], change[:, -1]
    largest = np.max(np.abs(wanted), axis=1)
    opening = times(grid.kernel, wanted) + approach[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        closing = np.min(np.where(opening < 0.0, CLOSING * gap / -opening, np.inf), axis=1)
        step = np.minimum(np.minimum(1.0, LARGEST_STEP / largest), closing)
    pressure = np.maximum(state.pressure + step[:, None] * wanted, 0.0)
    new = replace(state, pressure=pressure, approach=state.approach + step * approach, stress=now.stress)
    return new, np.where(step < 1.0, np.inf, largest)


def balance(grid: Grid, now: Flow) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian and residual of the mass balance at each node; the last unknown is the approach."""
    cases, nodes = grid.x.shape
    matrix, rest = np.zeros((cases, nodes + 1, nodes + 1)), np.zeros((cases, nodes + 1))
    rest[:, 1 : nodes - 1] = np.diff(now.mass, axis=1)
    before, start, end = (slope[..., None] for slope in now.by_gap)
    cells = start * grid.kernel[:, :-1]
    cells += end * grid.kernel[:, 1:]
    cells[:, 1:] += before[:, 1:] * grid.kernel[:, :-2]
    place = np.arange(nodes - 1)
    for slope, node in zip(now.by_pressure, (place - 1, place, place + 1), strict=True):
        inside = node >= 0
        cells[:, place[inside], node[inside]] += slope[:, inside]
    np.subtract(cells[:, 1:], cells[:, :-1], out=matrix[:, 1 : nodes - 1, :nodes])
    matrix[:, 1 : nodes - 1, nodes] = np.diff(sum(now.by_gap), axis=1)
    return matrix, rest


def broken(matrix: np.ndarray, rest: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Nodes of zero pressure: both ends, and nodes of negative pressure downstream of the maximum."""
    nodes = pressure.shape[1]
    diagonal = np.abs(np.einsum("kii->ki", matrix)[:, :nodes])
    with np.errstate(divide="ignore", invalid="ignore"):
        trial = pressure - rest[:, :nodes] / diagonal
    found = (trial < 0.0) & (np.arange(nodes) > np.argmax(pressure, axis=1)[:, None])
    found[:, [0, -1]] = True
    return found


def hold(matrix: np.ndarray, rest: np.ndarray, held: np.ndarray, pressure: np.ndarray | float) -> None:
    """Replace the mass balance of nodes by a step of their pressure to zero, in place."""
    case, node = np.nonzero(held)
    matrix[case, node] = 0.0
    matrix[case, node, node] = 1.0
    rest[case, node] = np.broadcast_to(pressure, held.shape)[case, node]
