"""Tables of an efficiency: columns with unit, meaning and source; tooth and gearbox efficiency are separate columns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from mixedlub.efficiency.gearbox import MESH, ORIGINS, Gearbox, Losses, Origin
from mixedlub.efficiency.mesh_cycle import MeshCycle
from mixedlub.efficiency.planetary_table import TABLES as PLANETARY
from mixedlub.efficiency.thermal_table import TABLES as THERMAL
from mixedlub.schema.result import column, described, frame_of

RPM = 30.0 / np.pi
JOULES_PER_KWH = 3.6e6
SECONDS_PER_HOUR = 3600.0
TOOTH = "1 less the losses of the teeth, sliding and rolling, over the power taken in; empty without torque"
WHOLE = "1 less all losses over the power taken in: at the input, in coast at the output; empty without torque"
OIL = column(lambda f: f.oil, "oil_temperature_C", "temperature of the oil of all stages; only where it is an axis")
AT = (
    column(lambda f: f.torque, "torque_Nm", "torque of the input; below 0 in coast, where the output drives"),
    column(lambda f: f.speed * RPM, "speed_rpm", "speed of the input"),
    OIL,
)
MAP = (
    *AT,
    column(lambda f: f.input_power, "input_power_W", "torque times angular speed of the input"),
    column(lambda f: f.total(), "total_loss_W", "sum of all losses"),
    column(lambda f: f.output_power, "output_power_W", "input power less all losses; below 0 it drives"),
    column(lambda f: f.output_power / f.speed * f.gearbox.ratio, "output_torque_Nm", "torque of the output"),
    column(lambda f: f.speed / f.gearbox.ratio * RPM, "output_speed_rpm", "speed of the output"),
    column(lambda f: 100.0 * f.efficiency(MESH), "tooth_efficiency_percent", TOOTH),
    column(lambda f: 100.0 * f.efficiency(), "gearbox_efficiency_percent", WHOLE),
)
LOSS_MAP = (
    column(lambda f: f.speed * RPM, "input_speed_rpm", "speed of the input"),
    column(lambda f: f.torque, "input_torque_Nm", "torque of the input; below 0 in coast"),
    OIL,
    column(lambda f: f.total() / f.speed, "torque_loss_Nm", "all losses as a torque of the input"),
    column(lambda f: f.total(), "power_loss_W", "all losses"),
)
CYCLE = (
    column(lambda f: f.stage.name, "stage", "stage", "text"),
    column(lambda f: f.stage.driving, "driving", "wheel that drives", "text"),
    column(lambda f: f.phase, "base_pitches", "turn of the mesh", "base pitches"),
    column(lambda f: np.degrees(f.roll_angle), "roll_angle_deg", "turn of the pinion"),
    column(lambda f: f.sliding, "sliding_loss_W", "loss by sliding, all tooth pairs"),
    column(lambda f: f.rolling, "rolling_loss_W", "loss by rolling, all tooth pairs"),
    column(lambda f: 100.0 * f.efficiency, "tooth_efficiency_percent", "1 less both losses over input power"),
    column(lambda f: f.friction, "mesh_friction", "friction coefficient of the mesh"),
    column(lambda f: f.friction_force, "friction_force_N", "friction force on the pinion"),
)
TOOTH_PAIR = (
    column(lambda f: f.stage.name, "stage", "stage", "text"),
    column(lambda f: np.degrees(f.pair.roll_angle), "roll_angle_deg", "roll angle of the pinion"),
    column(lambda f: f.pair.normal_force, "normal_force_N", "normal force of a tooth pair"),
    column(lambda f: f.pair.friction_force, "friction_force_N", "friction force of a tooth pair on the pinion"),
)
_MAP = (*MAP, *described(ORIGIN_loss_W="part of total_loss_W by its origin", validity="text: valid, or what is not"))
_DURATION = {"duration_h": "duration of the operating points"}
TABLES = {
    "map": _MAP,
    "loss_map": LOSS_MAP,
    "losses": (*AT, *described(total_loss_W="sum of the others", STAGE_loss_W="loss of a mesh or part of a stage")),
    "breakdown": described(
        stage="text: stage, or all",
        origin="text: origin of the loss, or total",
        part="text: name of the part",
        law="text: law of the loss",
        loss_W="loss at the condition of [cycle]; in coast alone, of the gearbox driven at its output",
        share_percent="part of the total loss",
    ),
    "stages": described(
        stage="text: stage",
        driving="text: wheel that drives",
        driven="text: wheel that is driven",
        ratio="speed of the input over that of the output",
        input_torque_Nm="torque that comes in",
        input_speed_rpm="speed that comes in",
        input_power_W="power that comes in",
        stage_loss_W="all losses of the stage",
        tooth_efficiency_percent=TOOTH,
        stage_efficiency_percent="1 less all losses of the stage over power that comes in",
    ),
    "mesh_cycle": CYCLE,
    "tooth_pair": TOOTH_PAIR,
    "duty": (
        *_MAP,
        *described(
            **_DURATION, input_energy_kWh="energy taken in, in coast at the output", loss_energy_kWh="energy lost"
        ),
    ),
    "duty_summary": described(
        **_DURATION,
        input_energy_kWh="energy taken in, in coast at the output",
        loss_energy_kWh="energy lost",
        output_energy_kWh="energy delivered",
        mean_tooth_efficiency_percent="1 less energy lost by the teeth over energy taken in",
        mean_gearbox_efficiency_percent="1 less energy lost over energy taken in",
        ORIGIN_energy_kWh="part of the energy lost by its origin",
    ),
    **PLANETARY,
    **THERMAL,
}
"""Columns of the tables of `mixedlub efficiency`."""


def present(losses: Losses) -> list[str]:
    """Origins with a part, in their order."""
    there = {origin for _, origin, _ in losses.by_origin}
    return [origin for origin in ORIGINS if origin in there]


def map_table(losses: Losses) -> pd.DataFrame:
    """Table of conditions: power, total loss, efficiencies (empty without torque), loss by origin, validity."""
    origins = {f"{origin}_loss_W": losses.total(origins=(origin,)) for origin in present(losses)}
    return frame_of(losses, MAP).assign(**origins, validity=list(losses.validity))


def part_table(losses: Losses) -> pd.DataFrame:
    """Loss of each mesh and part (columns) at each condition (rows)."""
    parts = {_column(origin): value for origin, value in losses.by_origin.items()}
    return frame_of(losses, AT).assign(total_loss_W=losses.total(), **parts)


def loss_map(losses: Losses) -> pd.DataFrame:
    """Loss map for drive-cycle tools: torque and power lost at each speed and torque of the input."""
    table = frame_of(losses, LOSS_MAP)
    order = [name for name in (OIL.name, "input_speed_rpm", "input_torque_Nm") if name in table]
    return table.sort_values(order, ignore_index=True)


def breakdown_table(at: Losses) -> pd.DataFrame:
    """Loss of every mesh and part at one condition, with law and share of the total; the last row is the sum."""
    parts = ((stage, part) for stage in at.gearbox.stages for part in stage.all_parts)
    laws = {(stage.name, part.table, part.name): part.law.title for stage, part in parts}
    total = float(at.total()[0])
    rows = []
    for (stage, origin, part), value in at.by_origin.items():
        law = laws.get((stage, origin, part), "")
        rows.append((stage, origin, part, law or _friction(at.gearbox, stage, part), float(value[0])))
    rows.append(("all", "total", "", "", total))
    table = pd.DataFrame(rows, columns=[one.name for one in TABLES["breakdown"][:-1]])
    table["share_percent"] = 100.0 * table["loss_W"] / total
    return table


def stage_table(at: Losses) -> pd.DataFrame:
    """Table of stages at one condition: driving side, input, and tooth and total efficiency of the stage."""
    rows, power, speed = [], float(at.input_power[0]), float(at.speed[0])
    for stage in at.gearbox.stages:
        total, mesh = (float(at.total(stage=stage.name, origins=o)[0]) for o in (ORIGINS, MESH))
        rows.append(
            {
                "stage": stage.name,
                "driving": stage.driving,
                "driven": stage.driven,
                "ratio": stage.ratio,
                "input_torque_Nm": max(power, 0.0) / speed,
                "input_speed_rpm": speed * RPM,
                "input_power_W": power,
                "stage_loss_W": total,
                "tooth_efficiency_percent": 100.0 * (1.0 - mesh / power) if power > total else np.nan,
                "stage_efficiency_percent": 100.0 * (1.0 - total / power) if power > total else np.nan,
            }
        )
        power, speed = power - total, speed / stage.ratio
    return pd.DataFrame(rows)


def cycle_table(cycles: Sequence[MeshCycle]) -> pd.DataFrame:
    """Loss, tooth efficiency, mesh friction and friction force of each stage over one base pitch."""
    return pd.concat([frame_of(one, CYCLE) for one in cycles], ignore_index=True)


def tooth_table(cycles: Sequence[MeshCycle]) -> pd.DataFrame:
    """Forces of one tooth pair of each stage along its path of contact, friction on the pinion."""
    return pd.concat([frame_of(one, TOOTH_PAIR) for one in cycles], ignore_index=True)


def duty_table(losses: Losses, hours: np.ndarray) -> pd.DataFrame:
    """Table of the operating points of a duty cycle: columns of the map, and energies."""
    table = map_table(losses)
    table.insert(2, "duration_h", hours)
    for name, power in (("input", losses.power_taken), ("loss", losses.total())):
        table[f"{name}_energy_kWh"] = power * hours * SECONDS_PER_HOUR / JOULES_PER_KWH
    return table


def duty_summary(losses: Losses, hours: np.ndarray) -> pd.DataFrame:
    """Energies of a duty cycle, total and by origin, and mean efficiencies as ratios of energies, in one row."""
    to_energy = hours * SECONDS_PER_HOUR / JOULES_PER_KWH
    taken, lost, mesh = (
        float(np.sum(power * to_energy)) for power in (losses.power_taken, losses.total(), losses.total(origins=MESH))
    )
    drives = taken > lost
    row: dict[str, float] = {
        "duration_h": float(hours.sum()),
        "input_energy_kWh": taken,
        "loss_energy_kWh": lost,
        "output_energy_kWh": taken - lost,
        "mean_tooth_efficiency_percent": 100.0 * (1.0 - mesh / taken) if drives else np.nan,
        "mean_gearbox_efficiency_percent": 100.0 * (1.0 - lost / taken) if drives else np.nan,
    }
    for origin in present(losses):
        row[f"{origin}_energy_kWh"] = float(np.sum(losses.total(origins=(origin,)) * to_energy))
    return pd.DataFrame([row])


def _column(origin: Origin) -> str:
    return "_".join([*filter(None, origin), "loss_W"])


def _friction(gearbox: Gearbox, name: str, mesh: str) -> str:
    stage = next(stage for stage in gearbox.stages if stage.name == name)
    return str(stage.mesh_of(mesh).study.file.options.friction)
