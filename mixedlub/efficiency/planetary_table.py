"""Tables of planetary stages at one condition: power of members, power that rolls through meshes, loads of planets."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mixedlub.efficiency.gearbox import Losses
from mixedlub.efficiency.planetary import PlanetaryModel, PlanetaryState
from mixedlub.efficiency.train import CARRIER
from mixedlub.schema.result import described

RPM = 30.0 / np.pi
STAGE = {"stage": "text: planetary stage"}
TABLES = {
    "members": described(
        **STAGE,
        member="text: sun, ring or carrier",
        role="text: input, output, fixed or free",
        speed_rpm="speed, above 0 as the input turns",
        speed_to_carrier_rpm="speed relative to the carrier",
        torque_Nm="torque from outside, without what parts of the member itself take",
        power_W="torque times speed, above 0 if it comes in",
        rolling_power_W="torque times speed relative to the carrier, which goes through the meshes",
    ),
    "rolling": described(
        **STAGE,
        mesh="text: mesh",
        driving="text: wheel that drives, relative to the carrier",
        rolling_power_W="power that the mesh takes in relative to the carrier, all planets",
        rolling_over_input="that power over the power of the input; above 1, power circulates",
        pinion_torque_Nm="torque on the first wheel, on the mean planet",
        pinion_speed_rpm="speed of the first wheel relative to the carrier",
        mesh_loss_W="loss of the mesh by sliding and rolling, all planets",
        mesh_efficiency_percent="1 less that loss over the power that it takes in",
    ),
    "planets": described(
        **STAGE,
        planet="text: kind of planet",
        speed_to_carrier_rpm="speed relative to the carrier",
        centrifugal_force_N="centrifugal force of one planet",
        largest_pin_load_N="load of the pin by meshes and centrifugal force, on the planet of the largest load",
    ),
    "pairings": described(
        **STAGE,
        finishes="text: finish of each wheel that is tried",
        mesh_loss_W="loss of all meshes by sliding and rolling",
        stage_loss_W="all losses of the stage",
        stage_efficiency_percent="1 less all losses of the stage over power that comes in",
        MESH_loss_W="loss of a mesh",
    ),
}
"""Columns of the tables of planetary stages."""


def planetary_tables(at: Losses) -> dict[str, pd.DataFrame]:
    """Tables at one condition of the input of the gearbox; none without planetary stages, or without pairings."""
    power, speed = float(at.input_power[0]), float(at.speed[0])
    rows: dict[str, list[dict[str, object]]] = {name: [] for name in TABLES}
    for stage in at.gearbox.stages:
        if isinstance(stage, PlanetaryModel):
            torque = max(power, 0.0) / speed
            state = stage.state(np.array([torque]), np.array([speed]))
            rows["members"] += _members(stage, state, speed)
            rows["rolling"] += _rolling(stage, state, torque, speed)
            rows["planets"] += _planets(stage, state, speed)
            rows["pairings"] += _pairings(stage, torque, speed)
        power -= float(at.total(stage=stage.name)[0])
        speed /= stage.ratio
    return {name: pd.DataFrame(found) for name, found in rows.items() if found}


def _members(stage: PlanetaryModel, state: PlanetaryState, speed: float) -> Iterator[dict[str, object]]:
    train = stage.train
    roles = {train.input: "input", train.output: "output", train.fixed: "fixed"}
    for member in train.members:
        torque, own = float(state.flow.torque[member][0]), train.speeds[member] * speed
        rolling = own - train.speeds[CARRIER] * speed
        yield {
            "stage": stage.name,
            "member": member,
            "role": roles.get(member, "free"),
            "speed_rpm": own * RPM,
            "speed_to_carrier_rpm": rolling * RPM,
            "torque_Nm": torque,
            "power_W": torque * own,
            "rolling_power_W": torque * rolling,
        }


def _rolling(stage: PlanetaryModel, state: PlanetaryState, torque: float, speed: float) -> Iterator[dict[str, object]]:
    for index, one in enumerate(stage.train.couplings):
        rolled = float(state.rolled[index, 0])
        lost = float(state.sliding[index, 0] + state.rolling[index, 0])
        pinion = abs(float(state.flow.force[index, 0])) * one.teeth[0] / stage.section.planet_count
        yield {
            "stage": stage.name,
            "mesh": one.name,
            "driving": one.wheels[0 if state.flow.first_drives[index, 0] else 1],
            "rolling_power_W": rolled,
            "rolling_over_input": rolled / (torque * speed) if torque > 0.0 else np.nan,
            "pinion_torque_Nm": pinion,
            "pinion_speed_rpm": abs(stage.train.relative[index, 0]) * speed * RPM,
            "mesh_loss_W": lost,
            "mesh_efficiency_percent": 100.0 * (1.0 - lost / rolled) if rolled > lost else np.nan,
        }


def _pairings(stage: PlanetaryModel, torque: float, speed: float) -> list[dict[str, object]]:
    """Losses with each combination of finishes, the smallest first."""
    rows: list[dict[str, object]] = []
    for finish, other in stage.combinations():
        state = other.state(np.array([torque]), np.array([speed]))
        each = (state.sliding + state.rolling)[:, 0]
        lost = float(sum(value[0] for value in state.found.values()))
        rows.append(
            {
                "stage": stage.name,
                "finishes": ", ".join(f"{wheel} {name}" for wheel, name in finish.items()),
                "mesh_loss_W": float(each.sum()),
                "stage_loss_W": lost,
                "stage_efficiency_percent": 100.0 * (1.0 - lost / (torque * speed))
                if torque * speed > lost
                else np.nan,
                **{f"{one.name}_loss_W": float(v) for one, v in zip(stage.train.couplings, each, strict=True)},
            }
        )
    return sorted(rows, key=lambda row: float(str(row["stage_loss_W"])))


def _planets(stage: PlanetaryModel, state: PlanetaryState, speed: float) -> Iterator[dict[str, object]]:
    carrier = stage.train.speeds[CARRIER] * speed
    for name, planet in stage.section.planets.items():
        yield {
            "stage": stage.name,
            "planet": name,
            "speed_to_carrier_rpm": (stage.train.speeds[name] * speed - carrier) * RPM,
            "centrifugal_force_N": planet.mass_kg * abs(stage.planets.places[name]) * carrier**2,
            "largest_pin_load_N": float(state.pin[name].max()),
        }
