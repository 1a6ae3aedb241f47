"""Power loss of a gear pair, mean over a mesh cycle."""

from __future__ import annotations

import numpy as np

from mixedlub.base_model.chains import GEAR_LOSS
from mixedlub.gear.inputs import contact_inputs
from mixedlub.kinds import columns
from mixedlub.kinds.kind import MIXED_FRICTION, NO_GEARS, Inputs, Kind, bookkeeping_inputs, column, gears_out
from mixedlub.kinds.standard import GEARS, OIL, ROUGHNESS_UM, StandardRig
from mixedlub.kinds.surfaces import pair_of_surfaces
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.table import Column, Table

PATH_POINTS = 24
"""Cost limit. Points along the path of contact."""

CONDITIONS = (
    columns.TORQUE,
    columns.SPEED,
    columns.OIL_TEMPERATURE,
    columns.surface("pinion_surface"),
    columns.surface("gear_surface"),
)
POWER_LOSS = Column("power_loss_W", meaning="power lost", words=("power loss", "loss"))


def reading(power_loss: np.ndarray) -> np.ndarray:
    """The rig reads the power lost (W).

    >>> float(reading(12.0))
    12.0
    """
    return power_loss


def without_gears(found: Inputs, table: Table) -> Inputs:
    """Chain inputs without meshing, churning and windage in the rows that were recorded with the gears out."""
    out = gears_out(table)[:, None]
    if not out.any():
        return found
    text = (
        f"{int(out.sum())} rows are compared with the shafts alone: no loss of the mesh, of wheels in oil or in air, "
        "and bearings without tooth force"
    )
    report(finding("gears_absent", text, f"{table.source}, rig {NO_GEARS}"))
    return {
        **found,
        "path_weight": np.where(out, 0.0, found["path_weight"]),
        "gears_fitted": np.where(out, 0.0, 1.0),
    }


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    points = rig.mesh(PATH_POINTS)
    temperature = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    mesh_inputs = contact_inputs(points, column(table["torque_Nm"]), column(table["speed_rpm"]) * np.pi / 30.0)
    return {
        **without_gears(mesh_inputs, table),
        **rig.oil().inputs(temperature),
        **pair_of_surfaces(rig, table, "pinion_surface", "gear_surface"),
        **bookkeeping_inputs(system, table),
        "oil_temperature": temperature,
        "boundary_friction": system.boundary_friction,
        "largest_torque": float(np.max(recorded["torque_Nm"])),
    }


STANDARD = StandardRig(
    sections={"gears": GEARS, "lubricant": OIL},
    noise=0.3,
    conditions={
        "load": ("torque_Nm", (50.0, 100.0, 150.0)),
        "speed": ("speed_rpm", (500.0, 1000.0, 1500.0, 2000.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (50.0, 70.0, 90.0)),
        "surfaces": ("pinion_surface", tuple(ROUGHNESS_UM)),
    },
)

KIND = Kind(
    name="gear_pair",
    subject="gears",
    readings=(POWER_LOSS,),
    columns=CONDITIONS,
    sections=("gears", "lubricant", "surfaces"),
    base_model=(
        f"Dowson-Toyoda film along the path of contact, {MIXED_FRICTION}; sliding loss integrated over the path. No "
        "other loss, no heat."
    ),
    chain=lambda system, table: (*GEAR_LOSS, ("reading", reading)),
    inputs=inputs,
    part_rigs=(NO_GEARS,),
    base_inputs={"power_loss": "nominal_loss"},
    asks_for_oil=True,
    standard=STANDARD,
)
