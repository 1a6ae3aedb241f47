"""Power loss of ring gears, and of single meshes of planetary sets as their carrier sees them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mixedlub.validation.rig import Rig
from mixedlub.validation.rigs.gears import COATED, draw_case, rig_of

RINGS: tuple[dict[str, Any], ...] = (
    {"teeth": [27, -72], "normal_module_mm": 2.0, "pressure_angle_deg": 20.0, "face_width_mm": 20.0,
     "tip_diameter_mm": [58.0, 140.6], "torques": (30.0, 150.0), "speeds": (500.0, 5000.0)},
    {"teeth": [23, -67], "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "face_width_mm": 18.0,
     "tip_diameter_mm": [75.2, 196.2], "profile_shift": [0.1, 0.05], "torques": (50.0, 300.0),
     "speeds": (400.0, 3500.0)},
    {"teeth": [21, -66], "normal_module_mm": 4.0, "pressure_angle_deg": 25.0, "face_width_mm": 16.0,
     "tip_diameter_mm": [92.0, 256.6], "torques": (80.0, 400.0), "speeds": (300.0, 3000.0)},
)  # fmt: skip
"""External wheels that drive a ring gear."""
SETS: tuple[dict[str, Any], ...] = (
    {"teeth": {"sun": 24, "planet": 24, "ring": 72}, "planets": 3, "normal_module_mm": 2.0,
     "pressure_angle_deg": 20.0, "face_width_mm": 18.0, "tip_diameter_mm": {"sun": 52.0, "planet": 52.0, "ring": 140.8},
     "torques": (60.0, 280.0), "speeds": (600.0, 6000.0)},
    {"teeth": {"sun": 28, "planet": 23, "ring": 74}, "planets": 3, "normal_module_mm": 3.0,
     "pressure_angle_deg": 22.5, "face_width_mm": 25.0, "tip_diameter_mm": {"sun": 90.0, "planet": 75.0, "ring": 216.6},
     "torques": (150.0, 900.0), "speeds": (400.0, 3500.0)},
    {"teeth": {"sun": 36, "planet": 28, "ring": 92}, "planets": 4, "normal_module_mm": 1.75,
     "pressure_angle_deg": 25.0, "face_width_mm": 20.0, "tip_diameter_mm": {"sun": 66.5, "planet": 52.5, "ring": 157.9},
     "torques": (80.0, 450.0), "speeds": (800.0, 7000.0)},
)  # fmt: skip
"""Planetary sets; torque and speed of the sun; the ring is held."""


def from_carrier(teeth: Mapping[str, int], planets: int, torque: float, speed: float) -> dict[str, tuple[float, float]]:
    """Torque (Nm) of one mesh and speed (rpm) against the carrier, of the sun and of a planet, with the ring held.

    Seen from the carrier the ring runs backwards at the carrier's speed, n_s z_s/(z_s + z_r), and the sun at what is
    left of its own. Each planet passes its share of the sun's torque on, tooth force by tooth force.

    >>> from_carrier({"sun": 24, "planet": 24, "ring": 72}, 3, 90.0, 4000.0)
    {'sun': (30.0, 3000.0), 'planet': (30.0, 3000.0)}
    """
    sun = speed * teeth["ring"] / (teeth["sun"] + teeth["ring"])
    share, turns = torque / planets, teeth["planet"] / teeth["sun"]
    return {"sun": (share, sun), "planet": (share * turns, sun / turns)}


def meshes(of: Mapping[str, Any]) -> tuple[dict[str, Any], ...]:
    """The two meshes of a planetary set, sun with planet and planet with ring, as pairs at rest of their carrier."""
    low, high = (from_carrier(of["teeth"], of["planets"], *ends) for ends in zip(of["torques"], of["speeds"]))
    shared = {key: of[key] for key in ("normal_module_mm", "pressure_angle_deg", "face_width_mm")}
    pairs = []
    for inner, outer, sign in (("sun", "planet", 1), ("planet", "ring", -1)):
        torques, speeds = zip(low[inner], high[inner])
        pair = {
            "teeth": [of["teeth"][inner], sign * of["teeth"][outer]],
            **shared,
            "torques": torques,
            "speeds": speeds,
        }
        pairs.append(pair | {"tip_diameter_mm": [of["tip_diameter_mm"][wheel] for wheel in (inner, outer)]})
    return tuple(pairs)


MESHES = tuple(mesh for one in SETS for mesh in meshes(one))


def draw_ring(rng: np.random.Generator) -> Rig:
    return rig_of(draw_case(rng, rng.random() < COATED, RINGS))


def draw_planetary(rng: np.random.Generator) -> Rig:
    return rig_of(draw_case(rng, rng.random() < COATED, MESHES))
