"""Gear inputs of the chain of laws: contact points, motion and sizes of the wheels, by name of the glossary."""

from __future__ import annotations

from typing import Any

import numpy as np

from mixedlub.gear.mesh import Mesh

Inputs = dict[str, Any]


def contact_inputs(points: Mesh, torque: np.ndarray, speed: np.ndarray) -> Inputs:
    """Chain inputs of the contact points of a mesh; torque (N m) and pinion speed (rad/s) end in an axis of one."""
    known, place = np.unique(torque[..., 0], return_inverse=True)
    return {**motion_inputs(points, torque, speed), "load_share": points.load_share(known)[place]}


def motion_inputs(points: Mesh, torque: np.ndarray, speed: np.ndarray) -> Inputs:
    """Chain inputs of the contact points without their load."""
    pair = points.pair
    low, high = pair.path_start, pair.path_end
    return {
        "radius": points.radius,
        "entrainment_speed": points.entrainment_per_speed * speed,
        "sliding_speed": np.abs(points.sliding_per_speed) * speed,
        "roll_angle": points.roll_angle,
        "path_fraction": (points.position - low) / (high - low),
        "face_position": points.face_position / pair.face_width,
        "mesh_phase": (points.position - low) / pair.base_pitch - points.lag,
        "path_weight": points.weight,
        "torque": torque,
        "pinion_speed": speed,
        "transmitted_force": torque / pair.base_radius[0],
        "contact_width": points.contact_width,
        "reduced_modulus": pair.reduced_modulus,
        **gear_inputs(points, speed),
    }


def gear_inputs(points: Mesh, speed: np.ndarray) -> Inputs:
    """Inputs of losses outside the contact: sizes and speeds of the two wheels."""
    pair = points.pair
    return {
        "face_width": pair.face_width,
        "gear_module": pair.normal_module,
        "helix_angle": abs(pair.helix_angle),
        "pinion_radius": pair.operating_radius[0],
        "gear_radius": abs(pair.operating_radius[1]),
        "gear_speed": speed / pair.gear_ratio,
        "pinion_teeth": float(pair.teeth[0]),
        "gear_teeth": float(abs(pair.teeth[1])),
        "contact_ratio": pair.contact_ratio,
        "gears_fitted": 1.0,
    }
