"""Tables of bevel and hypoid gears: columns with unit and meaning."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pandas as pd

from mixedlub.chain.ranges import flags, validity
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.result import column, described, frame_of
from mixedlub.skew_gears.blank import Blank
from mixedlub.skew_gears.contact_lines import mean_contact
from mixedlub.skew_gears.losses import Losses
from mixedlub.skew_gears.prepare import RPM, Pair
from mixedlub.skew_gears.undercut import shift_limits

RESULTS = (
    column(lambda f: f["input_power"], "input_power_W", "power of the driving member"),
    column(lambda f: f["power_loss"], "power_loss_W", "power lost by sliding in the mesh"),
    column(lambda f: 100.0 * f["efficiency"], "tooth_efficiency_percent", "1 less power lost over input power"),
    column(lambda f: f["output_torque"], "output_torque_Nm", "torque of the driven member"),
    column(lambda f: f["mean_friction"], "mean_friction", "loss over load times sliding speed of the mesh"),
    column(lambda f: f["loss_factor"], "loss_factor_H_V", "load times sliding speed over power of the pinion"),
    column(
        lambda f: 100.0 * f["lengthwise_share"],
        "lengthwise_loss_percent",
        "part of the loss by sliding along the teeth",
    ),
    column(lambda f: f["line_load"] * 1e-3, "largest_line_load_N_mm", "largest normal force per length of line"),
    column(lambda f: f["hertz_pressure"] * 1e-6, "largest_hertz_pressure_MPa", "largest Hertz pressure"),
    column(lambda f: f["film_thickness"] * 1e6, "film_thickness_um", "central film, mean over the contact lines"),
    column(lambda f: f["film_parameter"], "film_parameter", "film over composite roughness, mean over the lines"),
    column(lambda f: f["area_ratio"], "boundary_area_ratio", "share of boundary friction, mean over the lines"),
)
MAP = (
    column(lambda f: f.torque, "torque_Nm", "torque of the pinion"),
    column(lambda f: f.speed / RPM, "speed_rpm", "speed of the pinion"),
    column(lambda f: f.temperature - ZERO_CELSIUS, "oil_temperature_C", "temperature of the oil"),
    *RESULTS,
)
CONTACT = (
    column(lambda f: (f.position + 0.5) / f.positions, "base_pitches", "position of the mesh", "pitches"),
    column(lambda f: f.tooth, "tooth_pair", "pitches from the pair at the mean point", "pitches"),
    column(lambda f: f.along * 1e3, "face_position_mm", "along the face from the mean point, outwards"),
    column(lambda f: f.height * 1e3, "height_mm", "above the pitch plane, towards the wheel's root"),
    column(lambda f: f.length * 1e3, "line_length_mm", "length of contact line of the point"),
    column(lambda f: f.shape, "load_shape", "line load over its largest value"),
    column(lambda f: f.contact.radius * 1e3, "radius_mm", "reduced radius of curvature across the line"),
    column(
        lambda f: f.contact.entrainment * 1e3, "entrainment_mm_rad", "entrainment speed over pinion speed", "mm/rad"
    ),
    column(lambda f: f.contact.sliding_speed * 1e3, "sliding_mm_rad", "sliding speed over pinion speed", "mm/rad"),
    column(
        lambda f: f.lengthwise_sliding * 1e3,
        "lengthwise_sliding_mm_rad",
        "its part along the tooth, pinion less wheel",
        "mm/rad",
    ),
    column(lambda f: f.profile_sliding * 1e3, "profile_sliding_mm_rad", "its part in profile direction", "mm/rad"),
)
LOADED = (
    column(lambda f: f["line_load"] * 1e-3, "line_load_N_mm", "normal force per length of line"),
    column(lambda f: f["hertz_pressure"] * 1e-6, "hertz_pressure_MPa", "largest Hertz pressure"),
    column(lambda f: f["film_thickness"] * 1e6, "film_thickness_um", "central film"),
    column(lambda f: f["friction"], "friction", "friction coefficient"),
)
"""Columns of a contact point at the largest torque and speed and the last oil temperature."""
Value = Callable[[Blank, int], float]


def _deg(value: float) -> float:
    return math.degrees(value)


OF_MEMBERS: dict[str, Value] = {
    "teeth": lambda b, i: b.basic.teeth[i],
    "pitch_angle_deg": lambda b, i: _deg(b.cones.angle[i]),
    "face_angle_deg": lambda b, i: _deg(b.cones.angle[i] + b.tip_angle[i]),
    "root_angle_deg": lambda b, i: _deg(b.cones.angle[i] - b.root_angle[i]),
    "mean_spiral_angle_deg": lambda b, i: _deg(b.cones.spiral[i]),
    "inner_spiral_angle_deg": lambda b, i: _deg(b.spiral_ends[i][0]),
    "outer_spiral_angle_deg": lambda b, i: _deg(b.spiral_ends[i][1]),
    "mean_pitch_diameter_mm": lambda b, i: 2e3 * b.cones.radius[i],
    "outside_diameter_mm": lambda b, i: 1e3 * b.tip_diameter(i),
    "mean_cone_distance_mm": lambda b, i: 1e3 * b.cones.cone_distance[i],
    "inner_cone_distance_mm": lambda b, i: 1e3 * b.cone_ends(i)[0],
    "outer_cone_distance_mm": lambda b, i: 1e3 * b.cone_ends(i)[1],
    "face_width_mm": lambda b, i: 1e3 * b.face_width[i],
    "mean_addendum_mm": lambda b, i: 1e3 * b.addendum[i],
    "mean_dedendum_mm": lambda b, i: 1e3 * b.dedendum[i],
    "mean_normal_thickness_mm": lambda b, i: 1e3 * b.thickness[i],
    "apex_beyond_crossing_mm": lambda b, i: 1e3 * b.apex_beyond[i],
}
"""Geometry of pinion and wheel by name with unit."""
OF_PAIR: dict[str, Callable[[Blank], float]] = {
    "shaft_angle_deg": lambda b: _deg(b.basic.shaft_angle),
    "offset_mm": lambda b: 1e3 * b.basic.offset,
    "pitch_plane_offset_mm": lambda b: 1e3 * b.pitch_offset,
    "pitch_plane_offset_angle_deg": lambda b: _deg(b.cones.offset_angle),
    "mean_normal_module_mm": lambda b: 1e3 * b.cones.normal_module,
    "limit_pressure_angle_deg": lambda b: _deg(b.cones.limit_angle),
    "generated_drive_pressure_angle_deg": lambda b: _deg(b.pressure_angle[0]),
    "generated_coast_pressure_angle_deg": lambda b: _deg(b.pressure_angle[1]),
    "effective_drive_pressure_angle_deg": lambda b: _deg(b.effective_angle[0]),
    "effective_coast_pressure_angle_deg": lambda b: _deg(b.effective_angle[1]),
}
"""Geometry of the pair by name with unit."""
TABLES = {
    "map": (*MAP, *described(validity="text: valid, or what is not")),
    "geometry": described(quantity="text: name with unit", pinion="of the pinion or the pair", wheel="of the wheel"),
    "contact": (*CONTACT, *LOADED),
    "mesh_cycle": described(
        base_pitches="turn of the mesh",
        power_loss_W="power lost by all tooth pairs in contact",
        tooth_efficiency_percent="1 less power lost over input power",
        mean_friction="loss over load times sliding speed",
    ),
    "vary": (
        *described(varied="text: number that varies", value="its value"),
        *RESULTS,
        *described(
            pinion_spiral_angle_deg="mean spiral angle of the pinion",
            wheel_spiral_angle_deg="mean spiral angle of the wheel",
            status="text: computed, or why not",
        ),
    ),
}
"""Columns of the tables of `mixedlub bevel`."""


def map_table(losses: Losses) -> pd.DataFrame:
    """Efficiency and its reasons at every condition."""
    shape = losses.torque.shape
    return frame_of(losses, MAP).assign(validity=list(validity(flags(losses.reached, shape), shape)))


def geometry_table(pair: Pair) -> pd.DataFrame:
    """Blank by ISO 23509, and the contact at the mean point."""
    own, lines = pair.blank, pair.mesh.lines
    rows = [(name, value(own, 0), value(own, 1)) for name, value in OF_MEMBERS.items()]
    limits = {one.member: one.limit for one in shift_limits(own) if one.inner}
    if limits:
        rows.append(("inner_profile_shift_limit", limits[0], -limits[1]))
    of_pair = {name: value(own) for name, value in OF_PAIR.items()}
    mean = mean_contact(own, drive=lines.drive)
    of_pair |= {
        "mean_curvature_radius_mm": 1e3 * float(mean.radius[0]),
        "mean_sliding_over_pitch_speed": float(mean.sliding_speed[0] / np.linalg.norm(mean.velocity[0])),
        "mean_entrainment_over_pitch_speed": float(mean.entrainment[0] / np.linalg.norm(mean.velocity[0])),
        "contact_ratio": lines.contact_ratio,
    }
    rows += [(name, value, math.nan) for name, value in of_pair.items()]
    return pd.DataFrame(rows, columns=["quantity", "pinion", "wheel"])


def contact_table(pair: Pair, points: Mapping[str, np.ndarray]) -> pd.DataFrame:
    """Points of the contact lines over one pitch, with load and friction."""
    return pd.concat([frame_of(pair.mesh.lines, CONTACT), frame_of(points, LOADED)], axis=1)


def cycle_table(pair: Pair, points: Mapping[str, np.ndarray]) -> pd.DataFrame:
    """Loss, efficiency and friction over one pitch at the largest torque and speed."""
    lines, levels = pair.mesh.lines, pair.file.conditions
    speed = max(levels.speed_rpm) * RPM
    lost = lines.over_positions(points["power_loss"])
    sliding = points["line_load"] * lines.length * lines.contact.sliding_speed * speed
    taken = max(levels.torque_Nm) * speed + (0.0 if pair.mesh.pinion_drives else lost)
    return pd.DataFrame(
        {
            "base_pitches": (np.arange(lines.positions) + 0.5) / lines.positions,
            "power_loss_W": lost,
            "tooth_efficiency_percent": 100.0 * (1.0 - lost / taken),
            "mean_friction": lost / lines.over_positions(sliding),
        }
    )


def vary_table(pair: Pair) -> pd.DataFrame:
    """Results over each varied number; empty where a value gives no gears, with the reason."""
    rows = []
    for name, value, own, losses, reason in pair.varied():
        row: dict[str, object] = {"varied": name, "value": value}
        if own is not None and losses is not None:
            row |= {str(key): result for key, result in frame_of(losses, RESULTS).iloc[0].items()}
            row |= {
                f"{member}_spiral_angle_deg": _deg(own.cones.spiral[i]) for i, member in enumerate(("pinion", "wheel"))
            }
        rows.append(row | {"status": reason or "computed"})
    return pd.DataFrame(rows, columns=[one.name for one in TABLES["vary"]])
