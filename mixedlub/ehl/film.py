"""One step of Newton's method on pressure and approach, with a film that may break behind the contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.ehl.contacts import Contacts
from mixedlub.ehl.flow import Flow, flow
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.linear import solved, times
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

LARGEST_STEP = 0.3
"""Largest change of a pressure in one step (Hertz pressures)."""
CLOSING = 0.8
"""Largest share of a gap that closes in one step."""
LOAD = 0.5 * np.pi
"""Integral of the pressure, in Hertz units."""


def film_step(oil: Oil, contacts: Contacts, grid: Grid, state: State) -> tuple[State, np.ndarray]:
    """The state after one step at its temperatures, and the largest change of pressure that Newton's method wants.

    The film is broken where pressure would be negative, and only behind the place of the largest pressure; there the
    pressure is zero in place of the balance of mass.
    """
    gap = state.gap(grid)
    now = flow(oil, contacts, grid, state, gap)
    matrix, rest = _balance(grid, now)
    _break_film(matrix, rest, state.pressure)
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


def _balance(grid: Grid, now: Flow) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian and residual of the balance of mass at each node; the last unknown is the approach."""
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


def broken(pressure: np.ndarray, trial: np.ndarray) -> np.ndarray:
    """Nodes where the film is broken: a trial pressure below zero behind the largest one, and both ends."""
    behind = np.arange(pressure.shape[1]) > np.argmax(pressure, axis=1)[:, None]
    found = (trial < 0.0) & behind
    found[:, [0, -1]] = True
    return found


def _break_film(matrix: np.ndarray, rest: np.ndarray, pressure: np.ndarray) -> None:
    """Replace the balance by zero pressure where the film is broken, in place."""
    nodes = pressure.shape[1]
    diagonal = np.abs(np.einsum("kii->ki", matrix)[:, :nodes])
    with np.errstate(divide="ignore", invalid="ignore"):
        trial = pressure - rest[:, :nodes] / diagonal
    case, node = np.nonzero(broken(pressure, trial))
    matrix[case, node] = 0.0
    matrix[case, node, node] = 1.0
    rest[case, node] = pressure[case, node]
