"""Solution on nested grids, from an initial guess on the coarsest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from mixedlub.ehl.across import COUNT
from mixedlub.ehl.again import again
from mixedlub.ehl.batch import Batch
from mixedlub.ehl.film import LOAD
from mixedlub.ehl.grid import Grid, flooded_inlet, grid
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.linear import times
from mixedlub.ehl.newton import converge
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State
from mixedlub.laws.film import moes_line

NODES = (61, 121, 241)
"""Nodes along the film on each grid; the last two are the Richardson pair."""


@dataclass(frozen=True)
class Level(Batch):
    """Solution on one grid."""

    mesh: Grid
    state: State


@dataclass(frozen=True)
class Solved:
    """Solutions on the two finest grids, for the contacts converged on every grid.

    ``index``: numbers of these contacts. ``stopped_at``: for every contact, nodes of the grid without convergence, or
    zero.
    """

    index: np.ndarray
    coarse: Level
    fine: Level
    stopped_at: np.ndarray


def solve_levels(oil: Oil, contacts: Contacts, *, thermal: bool, nodes: tuple[int, ...] = NODES) -> Solved:
    """Solutions on grids with the given nodes, thermal or at the oil temperature.

    The first grid only provides a start for the second and need not converge.
    """
    film = central_film(oil, contacts)
    inlet = np.where(np.isnan(contacts.inlet), flooded_inlet(film), contacts.inlet)
    index, stopped_at = np.arange(len(film)), np.zeros(len(film), dtype=int)
    levels: list[Level] = []
    found = np.zeros(len(film), dtype=bool)
    for count in nodes:
        mesh = grid(inlet[index], film[index], count)
        here = contacts.take(index)
        guess = _guess(here, mesh, film[index], COUNT if thermal else 1)
        if levels:
            usable = ~np.isnan(levels[-1].state.approach)
            guess.put(usable, _refined(levels[-1].take(usable), mesh.take(usable)))
        state, converged = converge(oil, here, mesh, guess, thermal=thermal, far=~found)
        # Contacts given up at a near start have more time in the last attempt.
        for attempt, tried in ((again, np.ones_like(found)), (converge, found)) if levels else ():
            left = np.flatnonzero(~converged & tried)
            if len(left):
                parts = here.take(left), mesh.take(left), guess.take(left)
                other, solved = attempt(oil, *parts, thermal=thermal, far=(attempt is converge) | ~found[left])
                state.put(left, other)
                converged[left] = solved
        kept = converged if levels else np.ones_like(converged)
        stopped_at[index[~kept]] = count
        index, found = index[kept], converged[kept]
        levels = [*(level.take(kept) for level in levels[-1:]), Level(mesh, state).take(kept)]
    return Solved(index, levels[-2], levels[-1], stopped_at)


def central_film(oil: Oil, contacts: Contacts) -> np.ndarray:
    """Film thickness of an incompressible oil by Moes, in units of the gap (b^2/R)."""
    load, material = contacts.moes(*oil.at_ambient(contacts.oil_temperature))
    return np.pi * moes_line(load, material) / (8.0 * load)


def _guess(contacts: Contacts, mesh: Grid, film: np.ndarray, across: int) -> State:
    """Hertz pressure, with the film thickness by Moes in the centre."""
    cases, nodes = mesh.x.shape
    pressure = np.sqrt(np.maximum(1.0 - mesh.x**2, 0.0))
    pressure *= (LOAD / np.sum(mesh.weights * pressure, axis=1))[:, None]
    middle = np.arange(cases), np.argmin(np.abs(mesh.x), axis=1)
    temperature = np.broadcast_to(contacts.oil_temperature[:, None, None], (cases, nodes, across)).copy()
    stress = np.zeros((cases, 2, nodes - 1))
    return State(pressure, film - times(mesh.kernel, pressure)[middle], temperature, stress)


def _refined(coarse: Level, mesh: Grid) -> State:
    """Solution of a coarser grid interpolated to a finer grid, at its load."""
    old, state = coarse.mesh.x, coarse.state

    def on_new(values: np.ndarray) -> np.ndarray:
        new = np.empty((*mesh.x.shape, *values.shape[2:]))
        for case, (at, x, y) in enumerate(zip(mesh.x, old, values, strict=True)):
            new[case] = PchipInterpolator(x, y)(np.clip(at, x[0], x[-1]))
        return new

    pressure = on_new(state.pressure)
    pressure *= (LOAD / np.sum(mesh.weights * pressure, axis=1))[:, None]
    return State(pressure, state.approach, on_new(state.temperature), np.repeat(state.stress, 2, axis=2))
