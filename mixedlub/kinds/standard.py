"""Reference rig of a kind, for the comparison of effects and as a start of new cases."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

Levels = tuple[Any, ...]
Columns = dict[str, np.ndarray]

OIL = {
    "name": "automatic transmission fluid",
    "temperature_C": (40.0, 100.0),
    "kinematic_viscosity_mm2_s": (34.0, 7.2),
    "pressure_viscosity_per_GPa": (16.2, 13.0),
    "density_15C_kg_m3": 850.0,
    "density_change_per_K": 6.5e-4,
    "eyring_stress_MPa": 5.0,
    "thermal_conductivity_W_mK": 0.14,
    "specific_heat_J_kgK": 2000.0,
}
UNCERTAINTY = {
    "boundary_friction": 0.012,
    "viscosity": 0.06,
    "pressure_viscosity": 0.06,
    "eyring_stress": 0.15,
    "roughness": 0.04,
}
"""Judgement. Relative standard deviations that the reference rigs state for their inputs."""
GEARS = {
    "teeth": (17, 26),
    "normal_module_mm": 25.4 / 6.0,
    "pressure_angle_deg": 22.5,
    "tip_diameter_mm": (80.5, 118.4),
    "face_width_mm": 14.0,
}
"""Judgement. Gears of the reference rig, at 91 mm centres."""
DISCS = {"radius_mm": (40.0, 40.0), "width_mm": 6.0}
"""Judgement. Discs of the reference rig."""
ROUGHNESS_UM = {"superfinished": 0.15, "ground": 0.37, "coarse": 0.58, "coated": 0.37}
"""Judgement. Rq of one surface; slopes and curvatures are the same for all, since rougher flanks have longer
wavelengths."""
RELATIVE_NOISE = 0.01
"""Judgement. Relative noise of every reference rig."""


@dataclass(frozen=True)
class StandardRig:
    """Reference rig of a kind and its test.

    ``sections``: tables of `system.toml` except the surfaces. ``noise``: absolute part of the standard deviation of a
    reading, in its unit. ``conditions``: varied conditions by name in fingerprints, with column and levels, in all
    combinations. ``channels(columns, reading)``: additional instrument channels, from the conditions and a function
    that returns the base model's reading.
    """

    sections: Mapping[str, Any]
    noise: float
    conditions: Mapping[str, tuple[str, Levels]]
    channels: Callable[[Columns, Callable[[], np.ndarray]], Columns] = lambda columns, reading: {}
