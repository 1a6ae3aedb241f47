"""Energy of the film: a Newton step of its temperature, at a pressure and gap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.ehl.across import COUNT, DERIVATIVE, NODES, RUNNING, SECOND, WEIGHTS
from mixedlub.ehl.columns import FilmColumn, Sheared, sheared
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.linear import times
from mixedlub.ehl.march import Energy, leaving, march
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

RESOLVED = 0.5 / (COUNT - 1)


@dataclass(frozen=True)
class Heat:
    """Temperature (K) after a step, and heat flows of the film before it.

    Per area of the film (W/m^2) at nodes: heat of shear, heat of compression, and flux into the first and second wall
    in the cell before the node; ``carried``: heat convected along per width (W/m), relative to the inlet temperature.
    """

    temperature: np.ndarray
    shear_heat: np.ndarray
    compression_heat: np.ndarray
    walls: np.ndarray
    carried: np.ndarray
    sheared: Sheared


def full_film(pressure: np.ndarray) -> np.ndarray:
    """Nodes before cavitation: all nodes except those without pressure downstream of the maximum.

    >>> full_film(np.array([[0.0, 0.2, 1.0, 0.1, 0.0, 0.0]])).astype(int)
    array([[1, 1, 1, 1, 0, 0]])
    """
    behind = np.arange(pressure.shape[1]) > np.argmax(pressure, axis=1)[:, None]
    return ~(behind & (pressure <= 0.0))


def heat_step(oil: Oil, contacts: Contacts, grid: Grid, state: State, gap: np.ndarray, damping: np.ndarray) -> Heat:
    r"""Temperatures after a step.

    .. math:: \rho c\left(u\,\partial_x T + \frac{w}{h}\,\partial_s T\right) - \frac{k}{h^2}\,\partial_s^2 T
              = \tau\dot\gamma + \beta_\rho T u\,p_x,\quad \rho w = -\int_{-1/2}^{s} \partial_x(\rho h u)\,ds'

    at constant s, the position across over the thickness. Heat of shear is linear in the temperatures of its column,
    with the mean stress eliminated. A ``damping`` of 1 omits the terms by which a warm layer heats up further: the step
    is then stable and small.
    """
    column = node_columns(oil, contacts, grid, state, gap)
    shear = sheared(column, _at_nodes(state.stress))
    full = full_film(state.pressure)
    thickness = column.gap[..., None]
    velocity = contacts.first.speed[:, None, None] + thickness * (shear.rate @ RUNNING.T)
    density = oil.density * oil.density_ratio(column.pressure[..., None], column.temperature)[0]
    capacity = oil.heat_capacity * density * velocity
    made, by_temperature = _shear_heat(shear, full)
    expansion = oil.expansion(column.pressure[..., None], column.temperature)
    compression = expansion * velocity * (column.gradient * full)[..., None]
    place = np.arange(COUNT)
    held = damping[:, None, None] * np.max(np.maximum(by_temperature[..., place, place], 0.0), axis=2, keepdims=True)
    matrix = -by_temperature - oil.conductivity / thickness[..., None] ** 2 * SECOND
    matrix[..., place, place] += held - compression
    matrix += _crossing(capacity * thickness, grid.steps * contacts.half_width[:, None], thickness, oil.conductivity)
    known = made + held * column.temperature - times(by_temperature, column.temperature)
    energy = Energy(matrix, known, capacity, column.gap, state.temperature)
    temperature, walls = march(oil, contacts, grid, energy)
    rise = temperature - contacts.oil_temperature[:, None, None]
    return Heat(
        temperature,
        column.gap * (made @ WEIGHTS),
        column.gap * ((compression * temperature) @ WEIGHTS),
        walls,
        column.gap * ((capacity * rise) @ WEIGHTS),
        shear,
    )


def _at_nodes(stress: np.ndarray) -> np.ndarray:
    """Mean stress of the cells on both sides of each node; start of the iteration."""
    after = np.concatenate([stress[:, 0], stress[:, 0, -1:]], axis=1)
    before = np.concatenate([stress[:, 1, :1], stress[:, 1]], axis=1)
    return 0.5 * (before + after)


def node_columns(oil: Oil, contacts: Contacts, grid: Grid, state: State, gap: np.ndarray) -> FilmColumn:
    """Columns of film at the nodes, with the mean gradient of the cells on both sides."""
    cells = np.pad(np.diff(state.pressure, axis=1) / grid.steps, ((0, 0), (1, 1)), mode="edge")
    gradient = 0.5 * (cells[:, :-1] + cells[:, 1:])
    return FilmColumn(
        oil,
        state.pressure * contacts.pressure[:, None],
        state.temperature,
        gap * contacts.gap_unit[:, None],
        gradient * (contacts.pressure / contacts.half_width)[:, None],
        contacts.sliding[:, None],
    )


def _shear_heat(shear: Sheared, full: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Heat of shear (W/m^3), zero in the cavitated film, and its derivatives by the temperatures of its column."""
    stress_falls = -WEIGHTS * shear.by_temperature / (shear.by_stress @ WEIGHTS)[..., None]
    by_stress = shear.rate + shear.stress * shear.by_stress
    slopes = by_stress[..., :, None] * stress_falls[..., None, :]
    place = np.arange(COUNT)
    slopes[..., place, place] += shear.stress * shear.by_temperature
    return shear.stress * shear.rate * full[..., None], slopes * full[..., None, None]


def _crossing(flow: np.ndarray, steps: np.ndarray, thickness: np.ndarray, conductivity: float) -> np.ndarray:
    """Heat convected across the film as its layers change in thickness; zero through the walls.

    In the cavitated film the divergence of the flow is distributed over the thickness.
    """
    growth = np.pad(np.diff(flow, axis=1) / steps[..., None], ((0, 0), (1, 1), (0, 0)))
    back = leaving(flow)
    crossing = -(back * growth[:, 1:] + (1.0 - back) * growth[:, :-1]) @ RUNNING.T
    crossing -= crossing[..., -1:] * (NODES + 0.5)
    spread = np.maximum(RESOLVED * np.abs(crossing) / thickness - conductivity / thickness**2, 0.0)
    return (crossing / thickness)[..., None] * DERIVATIVE - DERIVATIVE @ (spread[..., None] * DERIVATIVE)
