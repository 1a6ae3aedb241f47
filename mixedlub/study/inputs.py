"""Inputs of a study's model: conditions, mesh and surfaces as arrays by axis."""

from __future__ import annotations

from typing import Any

import numpy as np

from mixedlub.gear import GearPair, Mesh
from mixedlub.gear.inputs import motion_inputs
from mixedlub.laws.load import LEAST_SHARE
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.surface import Surface, mean_over_rms, paired
from mixedlub.rig.waves import WaveRows
from mixedlub.study.schema import StudyFile

SOLIDS = ("solid_conductivity", "solid_density", "solid_heat_capacity")
"""Inputs of the surfaces usually equal for all pairings, so that dependent steps are computed once."""


def condition_inputs(file: StudyFile, pair: GearPair, points: Mesh, oil: Lubricant) -> dict[str, Any]:
    """Inputs common to all pairings."""
    levels, options = file.conditions, file.options
    of_gear = options.conditions_of == "gear"
    torques = np.array(levels.torque_Nm) / (pair.gear_ratio if of_gear else 1.0)
    speeds = np.array(levels.speed_rpm) * (np.pi / 30.0) * (pair.gear_ratio if of_gear else 1.0)
    temperature = np.array(levels.oil_temperature_C) + ZERO_CELSIUS + options.bulk_temperature_rise_K
    torque = torques.reshape(1, 1, -1, 1, 1)
    speed = speeds.reshape(1, 1, 1, -1, 1)
    share = points.load_share(torques)[None, None, :, None, :]
    return {
        **mesh_inputs(points, share, torque, speed),
        **oil.inputs(temperature.reshape(1, -1, 1, 1, 1)),
        "oil_temperature": temperature.reshape(1, -1, 1, 1, 1),
        "working_pressure_angle": pair.working_pressure_angle,
        "base_helix_angle": pair.base_helix_angle,
        "boundary_friction": file.boundary_friction,
        **({} if options.hardness_GPa is None else {"hardness": options.hardness_GPa * 1e9}),
    }


def mesh_inputs(points: Mesh, share: np.ndarray, torque: np.ndarray, speed: np.ndarray) -> dict[str, Any]:
    """Inputs of a mesh by its load share; torque (N m) and speed (rad/s) of the pinion have a last axis of length
    one."""
    pair = points.pair
    mean = points.weight * points.face_fraction * (share > LEAST_SHARE)
    return {
        **motion_inputs(points, torque, speed),
        "load_share": share,
        "mean_weight": mean / mean.sum(axis=-1, keepdims=True),
        "mean_sliding_speed": pair.end_mean_sliding * pair.base_radius[0] * speed,
    }


def surface_inputs(pairs: list[tuple[Surface, Surface]], waves: WaveRows | None = None) -> dict[str, np.ndarray]:
    """Inputs of the surfaces by pairing, with the rows of their waves where these flatten."""
    first, second = [a for a, _ in pairs], [b for _, b in pairs]
    both = {**paired(first, second), "mean_over_rms": mean_over_rms(first, second)}
    both |= {} if waves is None else waves.inputs(first, second)
    alike = {name for name in SOLIDS if np.ptp(both[name]) == 0.0}
    return {name: (v[:1] if name in alike else v).reshape(-1, 1, 1, 1, 1) for name, v in both.items()}
