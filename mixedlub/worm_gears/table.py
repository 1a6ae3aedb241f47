"""Tables of worm drives: columns with unit and meaning."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd

from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.result import column, described, frame_of
from mixedlub.worm_gears.drive import RPM, Drive, Losses

MAP = (
    column(lambda f: f.torque, "wheel_torque_Nm", "torque of the wheel"),
    column(lambda f: f.speed / RPM, "worm_speed_rpm", "speed of the worm"),
    column(lambda f: f.temperature - ZERO_CELSIUS, "oil_temperature_C", "temperature of the oil"),
    column(lambda f: f.sliding, "sliding_speed_m_s", "along the thread at the reference cylinder"),
    column(lambda f: f.film * 1e6, "film_thickness_um", "mean film; empty without [film]"),
    column(lambda f: f.friction, "mean_friction", "mean friction coefficient of the mesh"),
    column(lambda f: np.degrees(f.angle), "friction_angle_deg", "friction angle"),
    column(lambda f: 100.0 * f.driving, "worm_drives_efficiency_percent", "efficiency of the mesh, worm driving"),
    column(
        lambda f: 100.0 * f.driven,
        "wheel_drives_efficiency_percent",
        "efficiency of the mesh, wheel driving; empty where it locks itself",
    ),
    column(lambda f: f.torque / f.ratio / f.driving, "worm_drives_torque_Nm", "torque of the driving worm"),
    column(lambda f: f.torque / f.ratio * f.driven, "wheel_drives_torque_Nm", "torque that reaches the driven worm"),
    column(lambda f: f.wheel_power * (1.0 / f.driving - 1.0), "worm_drives_loss_W", "power lost, worm driving"),
    column(lambda f: f.wheel_power * (1.0 - f.driven), "wheel_drives_loss_W", "power lost, wheel driving"),
)
TABLES = {
    "map": (*MAP, *described(state="text: drives both ways, or self-locking")),
    "geometry": described(quantity="text: name with unit", value="of the drive"),
}
"""Columns of the tables of `mixedlub worm`."""
OF_DRIVE: dict[str, Callable[[Drive], float]] = {
    "ratio": lambda d: d.ratio,
    "lead_angle_deg": lambda d: math.degrees(d.lead),
    "normal_pressure_angle_deg": lambda d: d.file.pressure_angle_deg,
    "centre_distance_mm": lambda d: d.file.gears.distance_mm,
    "wheel_diameter_mm": lambda d: d.file.gears.axial_module_mm * d.file.gears.wheel_teeth,
    "wheel_profile_shift": lambda d: d.file.gears.profile_shift,
    "diameter_quotient": lambda d: d.file.gears.worm_diameter_mm / d.file.gears.axial_module_mm,
    "friction_factor": lambda d: d.factor,
    "self_locking_friction": lambda d: d.locking_friction,
}
"""Sizes of the drive by name with unit."""


def map_table(losses: Losses) -> pd.DataFrame:
    """Friction, film and efficiency at every condition."""
    state = np.where(losses.locks, "self-locking", "drives both ways")
    return frame_of(losses, MAP).assign(state=state)


def geometry_table(drive: Drive) -> pd.DataFrame:
    """Sizes of the drive."""
    return pd.DataFrame([(name, value(drive)) for name, value in OF_DRIVE.items()], columns=["quantity", "value"])
