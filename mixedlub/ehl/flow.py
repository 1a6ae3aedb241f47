"""Mass flow through the cells of the grid: Couette flow minus pressure-driven flow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl import across
from mixedlub.ehl.columns import FilmColumn, driven, newtonian, sheared
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

Three = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Flow:
    """Mass flow through each cell, over ambient density, entrainment speed and gap unit, with derivatives.

    Derivatives are with respect to pressure and gap of three nodes: before the cell, at its start and at its end.
    ``stress``: mean shear stress at both sides of each cell (Pa).
    """

    mass: np.ndarray
    by_pressure: Three
    by_gap: Three
    stress: np.ndarray


def sides(nodes: np.ndarray) -> np.ndarray:
    """Nodal values at the start and end of each cell, on an axis before the cells."""
    return np.stack([nodes[:, :-1], nodes[:, 1:]], axis=1)


def flow(oil: Oil, contacts: Contacts, grid: Grid, state: State, gap: np.ndarray, *, central: float = 0.0) -> Flow:
    """Mass flow of a state; the pressure-driven flow is the mean of both sides of the cell.

    ``central``: share of central differences in the Couette flow; the rest is upwind.
    """
    hertz = contacts.pressure[:, None]
    density, squeezed, _ = oil.density_ratio(state.pressure * hertz, across.mean(state.temperature))
    squeezed = squeezed * hertz
    column = cell_columns(oil, contacts, grid, state, gap)
    if oil.newtonian and state.temperature.shape[-1] == 1:
        moved, stress = newtonian(column), state.stress
    else:
        shear = sheared(column, state.stress)
        moved, stress = driven(column, shear), shear.mean_stress
    unit = (contacts.speed * contacts.gap_unit)[:, None, None]
    density2, squeezed2 = 0.5 * sides(density) / unit, 0.5 * sides(squeezed) / unit
    back = density2 * moved.flow
    by_p = density2 * moved.by_pressure * hertz[..., None] + squeezed2 * moved.flow
    by_h = density2 * moved.by_gap * contacts.gap_unit[:, None, None]
    by_push = np.sum(density2 * moved.by_gradient, axis=1) * (contacts.pressure / contacts.half_width)[:, None]
    by_push = by_push / grid.steps
    carried, (p0, p1, p2), (h0, h1, h2) = _carried(grid, density, squeezed, gap, central)
    return Flow(
        carried - np.sum(back, axis=1),
        (p0, p1 - by_p[:, 0] + by_push, p2 - by_p[:, 1] - by_push),
        (h0, h1 - by_h[:, 0], h2 - by_h[:, 1]),
        stress,
    )


def cell_columns(oil: Oil, contacts: Contacts, grid: Grid, state: State, gap: np.ndarray) -> FilmColumn:
    """Columns of film at both sides of each cell, with the pressure gradient of the cell."""
    gradient = np.diff(state.pressure, axis=1) / grid.steps * (contacts.pressure / contacts.half_width)[:, None]
    return FilmColumn(
        oil,
        sides(state.pressure) * contacts.pressure[:, None, None],
        sides(state.temperature),
        sides(gap) * contacts.gap_unit[:, None, None],
        gradient[:, None],
        contacts.sliding[:, None, None],
    )


def _carried(
    grid: Grid, density: np.ndarray, squeezed: np.ndarray, gap: np.ndarray, central: float
) -> tuple[np.ndarray, Three, Three]:
    """Couette flow: density times gap, second-order upwind, central in the first cell."""
    lean = np.pad((1.0 - central) * 0.5 * grid.steps[:, 1:] / grid.steps[:, :-1], ((0, 0), (1, 0)))
    before, start, end = -lean, 1.0 - 0.5 * central + lean, np.full_like(lean, 0.5 * central)
    before[:, 0], start[:, 0], end[:, 0] = 0.0, 0.5, 0.5
    shares = (before, start, end)

    def weighted(values: np.ndarray) -> Three:
        earlier = np.pad(values[:, :-2], ((0, 0), (1, 0)))
        near = (earlier, values[:, :-1], values[:, 1:])
        one, two, three = (share * value for share, value in zip(shares, near, strict=True))
        return one, two, three

    one, two, three = weighted(density * gap)
    return one + two + three, weighted(squeezed * gap), weighted(density)
