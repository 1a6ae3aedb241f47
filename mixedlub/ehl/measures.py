"""Results of a solution in SI: films, friction, temperatures, heat, and balances of load, mass and energy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.ehl.across import COUNT
from mixedlub.ehl.columns import driven, sheared
from mixedlub.ehl.film import LOAD
from mixedlub.ehl.flow import cell_columns, flow
from mixedlub.ehl.heat import Heat, full_film, heat_step, node_columns
from mixedlub.ehl.levels import Level
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil

MIDDLE = COUNT // 2
"""Node in the middle of the film."""


@dataclass(frozen=True)
class Quantity:
    """A result per contact: unit and meaning."""

    unit: str
    meaning: str


QUANTITIES: Mapping[str, Quantity] = {
    "central_film": Quantity("m", "film thickness in the centre of the contact"),
    "minimum_film": Quantity("m", "smallest film thickness"),
    "flow_film": Quantity("m", "mass flow over ambient density and entrainment speed"),
    "largest_pressure": Quantity("Pa", "largest pressure; at a spike it depends on the grid"),
    "friction_coefficient": Quantity("1", "shear stress in the middle of the film over the contact, by load"),
    "sliding_power": Quantity("W/m", "friction times sliding speed, per width"),
    "rolling_power": Quantity("W/m", "heat of shear that is not of sliding, per width"),
    "largest_film_temperature": Quantity("K", "largest temperature in the middle of the film"),
    "largest_first_wall_temperature": Quantity("K", "largest temperature of the first surface"),
    "largest_second_wall_temperature": Quantity("K", "largest temperature of the second surface"),
    "heat_to_first_wall": Quantity("W/m", "heat into the first body, per width"),
    "heat_to_second_wall": Quantity("W/m", "heat into the second body, per width"),
    "heat_carried": Quantity("W/m", "heat that the oil carries out of inlet and outlet, per width"),
}
"""Results with an error estimate."""
CHECKS: Mapping[str, Quantity] = {
    "load_imbalance": Quantity("1", "integral of the pressure over the load, less one"),
    "mass_imbalance": Quantity("1", "largest change of the mass flow over the unbroken film, by the flow"),
    "stress_imbalance": Quantity("1", "last change of the shear stress in its search, by the stress"),
    "heat_imbalance": Quantity("1", "heat that neither walls nor oil take, by the heat of shear"),
}
"""Errors of the conserved quantities."""
PROFILES: Mapping[str, Quantity] = {
    "position": Quantity("m", "place along the contact, from its centre in the direction of the flow"),
    "pressure": Quantity("Pa", "pressure"),
    "film": Quantity("m", "film thickness"),
    "shear_stress": Quantity("Pa", "shear stress in the middle of the film"),
    "film_temperature": Quantity("K", "temperature in the middle of the film"),
    "first_wall_temperature": Quantity("K", "temperature of the first surface"),
    "second_wall_temperature": Quantity("K", "temperature of the second surface"),
}
"""Results along the contact."""


def measures(oil: Oil, contacts: Contacts, level: Level, *, thermal: bool) -> dict[str, np.ndarray]:
    """Quantities, checks and profiles of solutions; thermal quantities are NaN for isothermal solutions."""
    mesh, state = level.mesh, level.state
    gap = state.gap(mesh)
    full = full_film(state.pressure)
    film, pressure = gap * contacts.gap_unit[:, None], state.pressure * contacts.pressure[:, None]
    weights = mesh.weights * contacts.half_width[:, None] * full
    if thermal:
        heat = heat_step(oil, contacts, mesh, state, gap, np.zeros(len(gap)))
        shear = heat.sheared
    else:
        column = node_columns(oil, contacts, mesh, state, gap)
        shear = sheared(column, np.zeros_like(column.pressure))
    stress = shear.mean_stress * full
    friction = np.sum(weights * stress, axis=1)
    mass = flow(oil, contacts, mesh, state, gap).mass
    layers = state.temperature if thermal else np.repeat(state.temperature, COUNT, axis=2)
    first, middle, second = layers[..., 0], layers[..., MIDDLE], layers[..., -1]
    found: dict[str, np.ndarray] = {
        "central_film": np.array([np.interp(0.0, x, h) for x, h in zip(mesh.x, film, strict=True)]),
        "minimum_film": np.min(np.where(mesh.x > -1.0, film, np.inf), axis=1),
        "flow_film": mass[:, mass.shape[1] // 2] * contacts.gap_unit,
        "largest_pressure": np.max(pressure, axis=1),
        "friction_coefficient": friction / contacts.line_load,
        "sliding_power": friction * contacts.sliding,
        "rolling_power": _rolling_power(oil, contacts, level, gap, full),
        "load_imbalance": np.sum(mesh.weights * state.pressure, axis=1) / LOAD - 1.0,
        "mass_imbalance": _spread(mass, full),
        "stress_imbalance": np.max(shear.miss * full, axis=1),
        "position": mesh.x * contacts.half_width[:, None],
        "pressure": pressure,
        "film": film,
        "shear_stress": stress,
        "film_temperature": middle,
        "first_wall_temperature": first,
        "second_wall_temperature": second,
        "largest_film_temperature": np.max(middle, axis=1),
        "largest_first_wall_temperature": np.max(first, axis=1),
        "largest_second_wall_temperature": np.max(second, axis=1),
    }
    names = ("heat_to_first_wall", "heat_to_second_wall", "heat_carried", "heat_imbalance")
    values = _heat_balance(contacts, level, heat, full) if thermal else np.full((4, len(gap)), np.nan)
    return found | dict(zip(names, values, strict=True))


def _rolling_power(oil: Oil, contacts: Contacts, level: Level, gap: np.ndarray, full: np.ndarray) -> np.ndarray:
    """Pressure gradient times pressure-driven flow by cell: heat of shear in addition to sliding."""
    cells = cell_columns(oil, contacts, level.mesh, level.state, gap)
    moved = driven(cells, sheared(cells, level.state.stress)).flow
    rise = np.diff(level.state.pressure, axis=1) * contacts.pressure[:, None]
    return np.sum(full[:, 1:] * rise * np.mean(moved, axis=1), axis=1)


def _spread(mass: np.ndarray, full: np.ndarray) -> np.ndarray:
    """Range of the mass flow over cells of full film, relative to its mean."""
    unbroken = full[:, 1:]
    low, high = np.where(unbroken, mass, np.inf), np.where(unbroken, mass, -np.inf)
    return (np.max(high, axis=1) - np.min(low, axis=1)) / np.mean(mass, axis=1, where=unbroken)


def _heat_balance(contacts: Contacts, level: Level, heat: Heat, full: np.ndarray) -> np.ndarray:
    """Heat into both walls, heat convected out, and relative error of the balance with the heat of shear.

    Taken over the full film without its first cell: oil fills only part of the gap in the cavitated film.
    """
    cells = level.mesh.steps * contacts.half_width[:, None]
    inside = full[:, 1:] * (np.arange(cells.shape[1]) > 0)
    walls = np.sum(heat.walls[:, :, 1:] * (inside * cells)[:, None], axis=2)
    made = np.sum((heat.shear_heat + heat.compression_heat)[:, 1:] * inside * cells, axis=1)
    sheared_heat = np.sum(heat.shear_heat[:, 1:] * inside * cells, axis=1)
    last = np.sum(full, axis=1) - 1
    carried = heat.carried[np.arange(len(last)), last] - heat.carried[:, 1]
    return np.stack([walls[:, 0], walls[:, 1], carried, (made - walls[:, 0] - walls[:, 1] - carried) / sheared_heat])
