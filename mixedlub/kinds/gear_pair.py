"""Power loss of a gear pair, mean over a mesh cycle."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.base_models import GEAR_LOSS
from mixedlub.gear import Mesh
from mixedlub.kinds import columns
from mixedlub.kinds.kind import NO_GEARS, Inputs, Kind, bookkeeping_inputs, column, gears_out
from mixedlub.kinds.surfaces import pair_of_surfaces
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.table import Column, Table

PATH_POINTS = 24

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


def contact_inputs(points: Mesh, torque: np.ndarray, speed: np.ndarray) -> Inputs:
    """Chain inputs of the contact points of a mesh; torque (N m) and pinion speed (rad/s) end in an axis of one."""
    known, place = np.unique(torque[..., 0], return_inverse=True)
    return {**motion_inputs(points, torque, speed), "load_share": points.load_share(known)[place]}


def motion_inputs(points: Mesh, torque: np.ndarray, speed: np.ndarray) -> Inputs:
    """Chain inputs of the contact points but for the load they carry."""
    pair = points.pair
    low, high = pair.path_start, pair.path_end
    return {
        "radius": points.radius,
        "entrainment_speed": points.entrainment_per_speed * speed,
        "sliding_speed": np.abs(points.sliding_per_speed) * speed,
        "roll_angle": points.roll_angle,
        "path_fraction": (points.position - low) / (high - low),
        "face_position": points.face_position / pair.face_width,
        "path_weight": points.weight,
        "torque": torque,
        "pinion_speed": speed,
        "transmitted_force": torque / pair.base_radius[0],
        "contact_width": points.contact_width,
        "reduced_modulus": pair.reduced_modulus,
        **gear_inputs(points, speed),
    }


def gear_inputs(points: Mesh, speed: np.ndarray) -> Inputs:
    """What losses outside the contact read: the sizes and speeds of the two wheels."""
    pair = points.pair
    return {
        "face_width": pair.face_width,
        "gear_module": pair.normal_module,
        "pinion_radius": pair.operating_radius[0],
        "gear_radius": pair.operating_radius[1],
        "gear_speed": speed / pair.gear_ratio,
        "pinion_teeth": float(pair.teeth[0]),
        "gear_teeth": float(pair.teeth[1]),
        "contact_ratio": pair.contact_ratio,
        "gears_fitted": 1.0,
    }


def without_gears(found: Inputs, table: Table) -> Inputs:
    """Chain inputs with nothing to mesh, to stir oil or to drive air in the rows of the rig without gears."""
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


KIND = Kind(
    name="gear_pair",
    readings=(POWER_LOSS,),
    columns=CONDITIONS,
    sections=("gears", "lubricant", "surfaces"),
    chain=lambda system, table: (*GEAR_LOSS, ("reading", reading)),
    inputs=inputs,
    part_rigs=(NO_GEARS,),
    nominal={"power_loss": "nominal_loss"},
)
