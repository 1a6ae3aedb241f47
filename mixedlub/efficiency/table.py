"""Tables of an efficiency, with units in the names of columns; tooth and gearbox efficiency have one each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from mixedlub.efficiency.gearbox import MESH, ORIGINS, Gearbox, Losses, Origin
from mixedlub.efficiency.mesh_cycle import MeshCycle

RPM = 30.0 / np.pi
JOULES_PER_KWH = 3.6e6
SECONDS_PER_HOUR = 3600.0


def present(losses: Losses) -> list[str]:
    """Origins that have a part, in their order."""
    there = {origin for _, origin, _ in losses.by_origin}
    return [origin for origin in ORIGINS if origin in there]


def map_table(losses: Losses) -> pd.DataFrame:
    """One row a condition: power, total loss, both efficiencies (empty without torque), loss by origin, validity."""
    output_speed = losses.speed / losses.gearbox.ratio
    columns: dict[str, object] = {
        "torque_Nm": losses.torque,
        "speed_rpm": losses.speed * RPM,
        "input_power_W": losses.input_power,
        "total_loss_W": losses.total(),
        "output_power_W": losses.output_power,
        "output_torque_Nm": losses.output_power / output_speed,
        "output_speed_rpm": output_speed * RPM,
        "tooth_efficiency_percent": 100.0 * losses.efficiency(MESH),
        "gearbox_efficiency_percent": 100.0 * losses.efficiency(),
        **{f"{origin}_loss_W": losses.total(origins=(origin,)) for origin in present(losses)},
        "validity": list(losses.validity),
    }
    return pd.DataFrame(columns)


def part_table(losses: Losses) -> pd.DataFrame:
    """One row a condition, one column a part: the loss of each mesh and of each part of every stage."""
    parts = {_column(origin): value for origin, value in losses.by_origin.items()}
    head = {"torque_Nm": losses.torque, "speed_rpm": losses.speed * RPM, "total_loss_W": losses.total()}
    return pd.DataFrame({**head, **parts})


def loss_map(losses: Losses) -> pd.DataFrame:
    """The loss map for drive-cycle tools: torque and power lost at each speed and torque of the input."""
    return pd.DataFrame(
        {
            "input_speed_rpm": losses.speed * RPM,
            "input_torque_Nm": losses.torque,
            "torque_loss_Nm": losses.total() / losses.speed,
            "power_loss_W": losses.total(),
        }
    ).sort_values(["input_speed_rpm", "input_torque_Nm"], ignore_index=True)


def breakdown_table(at: Losses) -> pd.DataFrame:
    """Loss of every mesh and part at one condition, with law and share of the total; the last row is the sum."""
    parts = ((stage, part) for stage in at.gearbox.stages for part in stage.parts)
    laws = {(stage.name, part.table, part.name): part.law.title for stage, part in parts}
    total = float(at.total()[0])
    rows = []
    for (stage, origin, part), value in at.by_origin.items():
        law = laws.get((stage, origin, part), "")
        rows.append((stage, origin, part, law or _friction(at.gearbox, stage), float(value[0])))
    rows.append(("all", "total", "", "", total))
    table = pd.DataFrame(rows, columns=["stage", "origin", "part", "law", "loss_W"])
    table["share_percent"] = 100.0 * table["loss_W"] / total
    return table


def stage_table(at: Losses) -> pd.DataFrame:
    """One row a stage at one condition: which side drives, what comes in, and both efficiencies of the stage."""
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
    """Loss, tooth efficiency, friction of the mesh and friction force of each stage over one base pitch."""
    return pd.concat(
        [
            pd.DataFrame(
                {
                    "stage": one.stage.name,
                    "driving": one.stage.driving,
                    "base_pitches": one.phase,
                    "roll_angle_deg": np.degrees(one.roll_angle),
                    "sliding_loss_W": one.sliding,
                    "rolling_loss_W": one.rolling,
                    "tooth_efficiency_percent": 100.0 * one.efficiency,
                    "mesh_friction": one.friction,
                    "friction_force_N": one.friction_force,
                }
            )
            for one in cycles
        ],
        ignore_index=True,
    )


def tooth_table(cycles: Sequence[MeshCycle]) -> pd.DataFrame:
    """Forces of one tooth pair of each stage over its way through the mesh, friction on the pinion."""
    return pd.concat(
        [
            pd.DataFrame(
                {
                    "stage": one.stage.name,
                    "roll_angle_deg": np.degrees(one.pair.roll_angle),
                    "normal_force_N": one.pair.normal_force,
                    "friction_force_N": one.pair.friction_force,
                }
            )
            for one in cycles
        ],
        ignore_index=True,
    )


def duty_table(losses: Losses, hours: np.ndarray) -> pd.DataFrame:
    """One row an operating point of a duty cycle: the columns of the map, and its energies."""
    table = map_table(losses)
    table.insert(2, "duration_h", hours)
    for name, power in (("input", losses.input_power), ("loss", losses.total())):
        table[f"{name}_energy_kWh"] = power * hours * SECONDS_PER_HOUR / JOULES_PER_KWH
    return table


def duty_summary(losses: Losses, hours: np.ndarray) -> pd.DataFrame:
    """One row: energies of a duty cycle in all and by origin; its mean efficiencies are ratios of energies."""
    to_energy = hours * SECONDS_PER_HOUR / JOULES_PER_KWH
    taken, lost, mesh = (
        float(np.sum(power * to_energy)) for power in (losses.input_power, losses.total(), losses.total(origins=MESH))
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


def _friction(gearbox: Gearbox, name: str) -> str:
    stage = next(stage for stage in gearbox.stages if stage.name == name)
    return str(stage.study.file.options.friction)
