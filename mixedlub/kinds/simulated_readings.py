"""Places of a simulated reading in the chains of the package, by the recorded quantity and the columns of the table."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.model import Chain
from mixedlub.gear.inputs import contact_inputs
from mixedlub.kinds import disc, film, friction_history, friction_map, gear_pair, mesh_friction, viscosity
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, gears_out, inverse_of, programme
from mixedlub.kinds.surfaces import pair_of_surfaces
from mixedlub.laws import contact, drag, load, loss
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Table

SIMULATED = "simulated"
"""Column of the simulation, and quantity of the chain."""
GEARED: Chain = (
    ("line_load", load.gear_line_load),
    ("hertz_half_width", contact.line_hertz_half_width),
    ("rolling_force", load.rolling_force),
    ("rolling_loss", loss.rolling_loss),
    ("power_loss", loss.power_loss),
    ("bath_acceleration", drag.bath_acceleration),
    ("reading", gear_pair.reading),
)
"""Losses beside a simulated loss of the mesh."""
SURFACES = (("pinion_surface", "gear_surface"), ("surface_1", "surface_2"))
"""Pairs of columns with the names of surfaces."""
OF_THE_MIXTURE = ("boundary_friction", "area_ratio", "fluid_friction", "flash_per_friction")
"""Inputs of a simulated friction that a simulation does not give."""


def simulated_reading(simulated: np.ndarray) -> np.ndarray:
    """The rig reads the simulated quantity.

    >>> float(simulated_reading(3.0))
    3.0
    """
    return simulated


def same_viscosity(viscosity: np.ndarray) -> np.ndarray:
    """Viscosity under pressure (Pa s), which the simulation includes.

    >>> float(same_viscosity(0.05))
    0.05
    """
    return viscosity


@dataclass(frozen=True)
class Place:
    """Place of a simulated reading: the quantity of the chain that it stands for, the chain after it, other inputs.

    ``kind``: kind of recording with the same reading; its effects on the reading apply. None for other readings.
    """

    kind: Kind | None
    quantity: Callable[[system_file.System, Table], str]
    chain: Callable[[system_file.System, Table], Chain]
    inputs: Callable[[system_file.System, Rig, Table, Table], Inputs]


def place_of(quantity: str, headers: Collection[str]) -> Place:
    """Place of a reading in a table with these columns."""
    speeds = [name for name in friction_map.SPEEDS if name in headers]
    if quantity == "friction_coefficient":
        if "time_s" in headers:
            return HISTORY
        if "roll_angle_deg" in headers:
            return MESH
        return DRIVE if len(speeds) == 1 and "entrainment_speed_m_s" not in headers else DISC
    if quantity == "friction_torque_Nm":
        return DRIVE if len(speeds) == 1 else OTHER
    return {"power_loss_W": GEARS, "film_thickness_nm": FILM, "viscosity_mPa_s": VISCOSITY}.get(quantity, OTHER)


def _constant(value: str) -> Callable[[system_file.System, Table], str]:
    return lambda system, table: value


def _common(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Inputs of rows with any reading: temperatures, place in the programme, roughness of named surfaces."""
    found: Inputs = {**bookkeeping_inputs(system, table), **programme(table, recorded)}
    celsius = next((n for n in ("oil_temperature_C", "temperature_C") if n in table), None)
    if celsius is not None:
        found["oil_temperature"] = column(table[celsius]) + ZERO_CELSIUS
    for first, second in SURFACES:
        if first in table and second in table and {*table[first], *table[second]} <= set(system.surfaces):
            found |= pair_of_surfaces(rig, table, first, second)
    return found


def _is_geared(system: system_file.System, table: Table) -> bool:
    return system.gears is not None and "torque_Nm" in table and "speed_rpm" in table


def _gear_inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Inputs of losses beside the mesh, as far as gears, oil, torque and speed are known."""
    found = _common(system, rig, table, recorded)
    if system.lubricant is not None and "oil_temperature" in found:
        found |= rig.oil().inputs(found["oil_temperature"])
    if "torque_Nm" in table:
        found |= {"torque": column(table["torque_Nm"]), "largest_torque": float(np.max(recorded["torque_Nm"]))}
    if "speed_rpm" in table:
        found["pinion_speed"] = column(table["speed_rpm"]) * np.pi / 30.0
    out = gears_out(table)[:, None]
    if _is_geared(system, table):
        found |= contact_inputs(rig.mesh(gear_pair.PATH_POINTS), found["torque"], found["pinion_speed"])
        found["path_weight"] = np.where(out, 0.0, found["path_weight"])
    return {**found, "gears_fitted": np.where(out, 0.0, 1.0)}


def _friction_inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Inputs of a friction coefficient: conditions, and the load where it was varied."""
    found = friction_history.inputs(system.model_copy(update={"contact": None}), rig, table, recorded)
    found = {name: value for name, value in found.items() if name not in OF_THE_MIXTURE}
    if "torque_Nm" in table and "load_N" not in table:
        found |= inverse_of(np.abs(table["torque_Nm"]), np.abs(recorded["torque_Nm"]))
    return {**_common(system, rig, table, recorded), **found}


def _drive_inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    found = friction_map.inputs(system, rig, table, recorded)
    return {**_common(system, rig, table, recorded), **found, "payload_torque": 0.0, "gears_fitted": 1.0}


def _film_inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    return {**_common(system, rig, table, recorded), **film.orders(table, recorded)}


GEARS = Place(
    gear_pair.KIND,
    lambda system, table: "mesh_loss" if _is_geared(system, table) else "power_loss",
    lambda system, table: GEARED if _is_geared(system, table) else (("reading", gear_pair.reading),),
    _gear_inputs,
)
DISC = Place(
    disc.KIND, _constant("friction"), lambda system, table: (("reading", disc.point_reading),), _friction_inputs
)
MESH = Place(mesh_friction.KIND, DISC.quantity, DISC.chain, _friction_inputs)
HISTORY = Place(
    friction_history.KIND,
    _constant("boundary_friction"),
    lambda system, table: (("friction", friction_history.constant_friction), *DISC.chain(system, table)),
    _friction_inputs,
)
DRIVE = Place(
    friction_map.KIND,
    _constant("running_friction"),
    lambda system, table: friction_map.chain(system, table)[1:],
    _drive_inputs,
)
FILM = Place(film.KIND, _constant("film_thickness"), lambda system, table: (("reading", film.reading),), _film_inputs)
VISCOSITY = Place(
    viscosity.KIND,
    _constant("viscosity"),
    lambda system, table: (("contact_viscosity", same_viscosity), ("reading", viscosity.reading)),
    _common,
)
OTHER = Place(None, _constant(SIMULATED), lambda system, table: (("reading", simulated_reading),), _common)
