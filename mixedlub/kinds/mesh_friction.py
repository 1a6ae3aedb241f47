"""Friction coefficient of one tooth contact at recorded roll angles."""

from __future__ import annotations

import numpy as np

from mixedlub.base_model.chains import GEAR_CONTACT
from mixedlub.gear import Mesh, at_roll_angle
from mixedlub.gear.build import gear_pair
from mixedlub.gear.inputs import motion_inputs
from mixedlub.kinds import columns
from mixedlub.kinds.gear_pair import CONDITIONS
from mixedlub.kinds.kind import MIXED_FRICTION, Inputs, Kind, bookkeeping_inputs, column, inverse_of
from mixedlub.kinds.standard import GEARS, OIL, ROUGHNESS_UM, StandardRig
from mixedlub.kinds.surfaces import pair_of_surfaces
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Column, Table

ROLL_ANGLE = Column("roll_angle_deg", meaning="roll angle of the contact on the pinion", words=("roll angle",))
LEAST_SHARE = 0.05
"""Judgement. Smallest share of a tooth pair's load, at the start of mesh, for which a friction coefficient is
meaningful."""


def reading(friction: np.ndarray) -> np.ndarray:
    """The rig reads the friction coefficient as a positive number (-).

    >>> float(reading(0.05))
    0.05
    """
    return friction


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table, a contact point per row."""
    points, share = _contacts(rig, table)
    known = share if recorded is table else _contacts(rig, recorded)[1]
    along = motion_inputs(points, table["torque_Nm"], table["speed_rpm"] * np.pi / 30.0)
    own = {name: column(value) if np.ndim(value) else value for name, value in along.items()}
    temperature = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    return {
        **own,
        "load_share": column(share),
        **inverse_of(_asked_of(share, table), _asked_of(known, recorded)),
        **rig.oil().inputs(temperature),
        **pair_of_surfaces(rig, table, "pinion_surface", "gear_surface"),
        **bookkeeping_inputs(system, table),
        "oil_temperature": temperature,
        "boundary_friction": system.boundary_friction,
    }


def _contacts(rig: Rig, table: Table) -> tuple[Mesh, np.ndarray]:
    """Contact point of every row and its load share."""
    points = at_roll_angle(rig.gears, rig.sharing, np.radians(table["roll_angle_deg"]), slices=1)
    share = np.empty(len(table))
    for level in np.unique(table["torque_Nm"]):
        rows = table["torque_Nm"] == level
        share[rows] = points.load_share(level)[rows]
    return points, share


def _asked_of(share: np.ndarray, table: Table) -> np.ndarray:
    """Torque at which a single tooth pair carrying all load would have each row's contact load."""
    return np.asarray(table["torque_Nm"] * np.maximum(share, LEAST_SHARE))


def column_limits(system: system_file.System) -> dict[str, tuple[float, float]]:
    """Limits of the roll angle: contact exists only on the path of contact."""
    if system.gears is None:
        return {}
    pair = gear_pair(system.gears)
    first, last = np.degrees(np.array([pair.path_start, pair.path_end]) / pair.base_radius[0])
    return {"roll_angle_deg": (float(first), float(last))}


STANDARD = StandardRig(
    sections={"gears": GEARS, "lubricant": OIL},
    noise=2e-4,
    conditions={
        "load": ("torque_Nm", (50.0, 150.0)),
        "speed": ("speed_rpm", (500.0, 1500.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (50.0, 90.0)),
        "surfaces": ("pinion_surface", tuple(ROUGHNESS_UM)),
        "roll_angle": ("roll_angle_deg", (16.0, 19.0, 22.0, 25.0, 28.0, 31.0)),
    },
)

KIND = Kind(
    name="mesh_friction",
    subject="gears",
    readings=(columns.FRICTION,),
    columns=(*CONDITIONS, ROLL_ANGLE),
    sections=("gears", "lubricant", "surfaces"),
    base_model=(f"Dowson-Toyoda film at each roll angle, {MIXED_FRICTION}. No heat."),
    chain=lambda system, table: (*GEAR_CONTACT, ("reading", reading)),
    inputs=inputs,
    column_limits=column_limits,
    asks_for_oil=True,
    standard=STANDARD,
)
