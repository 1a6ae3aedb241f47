"""Tables of a loaded tooth contact: columns with unit, meaning and source of their values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from mixedlub.gear import IsoStiffness, loss_factors
from mixedlub.gear.analysis.tooth_contact import ToothContact
from mixedlub.schema.findings import collected
from mixedlub.schema.result import column, described, frame_of

STIFFNESS = 1e-9
"""From N/m per m to N/(mm um)."""


def _solved(value: Callable[[ToothContact, Any], Any]) -> Callable[[ToothContact], Any]:
    """Values for elastic teeth only: a function of the contact and its distribution."""
    return lambda found: None if found.distribution is None else value(found, found.distribution)


TORQUE = "torque on the pinion"
ROLL = "roll angle of the pinion, at the middle of the face"
LOAD_SHARE = (
    column(lambda f: f.torque[:, None], "torque_Nm", TORQUE),
    column(lambda f: np.degrees(f.roll_angle), "roll_angle_deg", ROLL),
    column(lambda f: f.load_share, "load_share", "part of the force on the base tangent that one tooth pair carries"),
)
LINE_LOADS = (
    column(lambda f: f.torque[:, None, None], "torque_Nm", TORQUE),
    column(lambda f: np.degrees(f.roll_angle)[:, None], "roll_angle_deg", ROLL),
    column(lambda f: f.face * 1e3, "face_position_mm", "middle of the slice across the face, from the front"),
    column(lambda f: f.position * 1e3, "path_position_mm", "place on the path, from the pinion's base tangent point"),
    column(lambda f: f.line_load * 1e-3, "line_load_N_mm", "normal force over length of the contact line"),
    column(lambda f: f.pressure * 1e-6, "hertz_pressure_MPa", "largest Hertz pressure of the slice"),
    column(lambda f: f.sliding, "sliding_over_base_speed", "sliding speed over the speed of the pinion's base circle"),
)
TRANSMISSION = (
    column(lambda f: f.torque[:, None], "torque_Nm", TORQUE),
    column(lambda f: _pitches(f), "base_pitches", "turn of the mesh, in base pitches", "base pitches"),
    column(
        lambda f: np.degrees(_pitches(f) * f.pair.base_pitch / f.pair.base_radius[0]),
        "roll_angle_deg",
        f"{ROLL}, turned",
    ),
    column(
        _solved(lambda f, s: s.approach * 1e6), "transmission_error_um", "approach of the wheels on the base tangent"
    ),
    column(
        _solved(lambda f, s: s.stiffness * 1e-6), "mesh_stiffness_N_um", "tangent stiffness of all pairs in contact"
    ),
    column(
        _solved(lambda f, s: f.base_force[:, None] / s.approach * 1e-6), "secant_stiffness_N_um", "force over approach"
    ),
    column(_solved(lambda f, s: (s.force.sum(axis=3) > 0).sum(axis=2)), "pairs_in_contact", "tooth pairs that carry"),
    column(
        _solved(lambda f, s: s.force.max(axis=(2, 3)) * f.face.size / f.pair.face_width * 1e-3),
        "largest_line_load_N_mm",
        "largest line load of all pairs",
    ),
    column(
        _solved(lambda f, s: (s.force.sum(axis=2) * s.face).sum(axis=2) / s.force.sum(axis=(2, 3)) * 1e3),
        "load_centre_mm",
        "centre of the load across the face, from the front",
    ),
)
_UNIT = "N/(mm µm)"
_APPROACH = (
    column(lambda f: f.torque, "torque_Nm", TORQUE),
    column(
        lambda f: f.base_force, "base_tangent_force_N", "transverse force on the base tangent, torque over base radius"
    ),
    column(
        lambda f: f.base_force * math.tan(abs(f.pair.base_helix_angle)),
        "axial_force_N",
        "axial force, without friction",
    ),
    column(
        _solved(lambda f, s: s.approach.mean(axis=1) * 1e6), "mean_transmission_error_um", "mean transmission error"
    ),
    column(
        _solved(lambda f, s: s.peak_to_peak * 1e6),
        "peak_to_peak_transmission_error_um",
        "its largest less its smallest",
    ),
    column(
        _solved(lambda f, s: s.stiffness.mean(axis=1) / f.pair.face_width * STIFFNESS),
        "mean_mesh_stiffness_N_mm_um",
        "mean tangent stiffness of the mesh over face width",
        _UNIT,
    ),
    column(
        _solved(lambda f, s: (f.base_force[:, None] / s.approach / f.pair.face_width).mean(axis=1) * STIFFNESS),
        "mean_secant_stiffness_N_mm_um",
        "mean force over approach and face width",
        _UNIT,
    ),
)
_ISO = tuple(
    column(value, f"iso_{name}_stiffness_N_mm_um", f"{meaning}, ISO 6336-1", _UNIT)
    for value, name, meaning in (
        (lambda iso: [one.theoretical * STIFFNESS for one in iso], "theoretical_single", "stiffness of a pair c'_th"),
        (lambda iso: [one.single * STIFFNESS for one in iso], "single", "stiffness of a pair c'"),
        (lambda iso: [one.mesh * STIFFNESS for one in iso], "mesh", "mesh stiffness c_gamma_alpha"),
        (lambda iso: [one.face * STIFFNESS for one in iso], "face", "c_gamma_beta, for the face load factor"),
    )
)
_LOADED = (
    column(lambda f: f.load_share.max(axis=1), "largest_load_share", "largest load share of a tooth pair"),
    column(lambda f: f.line_load.max(axis=(1, 2)) * 1e-3, "largest_line_load_N_mm", "largest line load"),
    column(lambda f: f.pressure.max(axis=(1, 2)) * 1e-6, "largest_hertz_pressure_MPa", "largest Hertz pressure"),
    column(
        lambda f: f.face_load_factor, "face_load_factor", "largest over mean load across the face, mean of the mesh"
    ),
    column(lambda f: 100.0 * f.pattern, "contact_pattern_percent", "part of the flank on the path that touches"),
    column(lambda f: 100.0 * f.beyond_path, "load_beyond_path_percent", "part of the load on edges beyond the path"),
    column(lambda f: f.loss_factor, "local_loss_factor", "tooth loss factor of the local load"),
)
SUMMARY = (*_APPROACH, *_ISO, *_LOADED)
LOSS_FACTORS = described(
    loss_factor="text: formula, or local for the load of this mesh",
    torque_Nm=f"{TORQUE}, of the local one",
    value="tooth loss factor",
    outside_range="text: why a formula does not hold for these gears",
)
GEOMETRY = {
    "transverse_contact_ratio": lambda pair: pair.contact_ratio,
    "overlap_ratio": lambda pair: pair.overlap_ratio,
    "working_pressure_angle_deg": lambda pair: math.degrees(pair.working_pressure_angle),
    "base_helix_angle_deg": lambda pair: math.degrees(pair.base_helix_angle),
    "centre_distance_mm": lambda pair: abs(pair.working_centre_distance) * 1e3,
    "backlash_mm": lambda pair: pair.backlash * 1e3 + 0.0,
    "base_pitch_mm": lambda pair: pair.base_pitch * 1e3,
    "path_start_mm": lambda pair: pair.path_start * 1e3,
    "pitch_point_mm": lambda pair: pair.pitch_point * 1e3,
    "path_end_mm": lambda pair: pair.path_end * 1e3,
    "path_length_mm": lambda pair: (pair.path_end - pair.path_start) * 1e3,
    "pinion_base_diameter_mm": lambda pair: pair.base_radius[0] * 2e3,
    "gear_base_diameter_mm": lambda pair: abs(pair.base_radius[1]) * 2e3,
    "pinion_tip_diameter_mm": lambda pair: pair.tip_radii[0] * 2e3,
    "gear_tip_diameter_mm": lambda pair: abs(pair.tip_radii[1]) * 2e3,
    "pinion_tip_thickness_mm": lambda pair: pair.tip_thickness[0] * 1e3,
    "gear_tip_thickness_mm": lambda pair: pair.tip_thickness[1] * 1e3,
}
"""Geometry of the mesh by name with unit; positions on the path count from the base tangent point of the pinion."""
TABLES = {
    "summary": SUMMARY,
    "load_share": LOAD_SHARE,
    "line_loads": LINE_LOADS,
    "transmission_error": TRANSMISSION,
    "loss_factors": LOSS_FACTORS,
    "geometry": described(quantity="text: name with unit", value="in the unit of the quantity"),
}
"""Columns of the tables of `mixedlub gear`."""


def tables(found: ToothContact, iso: Sequence[IsoStiffness]) -> dict[str, pd.DataFrame]:
    """All tables by file name; the transmission error for elastic teeth only."""
    summary = pd.concat([frame_of(found, _APPROACH), frame_of(iso, _ISO), frame_of(found, _LOADED)], axis=1)
    made = {"summary": summary, "load_share": load_share_table(found), "line_loads": line_load_table(found)}
    if found.distribution is not None:
        made["transmission_error"] = frame_of(found, TRANSMISSION, found.distribution.approach.shape)
    geometry = [(name, value(found.pair)) for name, value in GEOMETRY.items()]
    return {
        **made,
        "loss_factors": loss_factor_table(found),
        "geometry": pd.DataFrame(geometry, columns=["quantity", "value"]),
    }


def load_share_table(found: ToothContact) -> pd.DataFrame:
    """Share of one tooth pair over the roll angle of the pinion, as `load_share.csv` of a case."""
    return frame_of(found, LOAD_SHARE, found.load_share.shape)


def line_load_table(found: ToothContact) -> pd.DataFrame:
    """Line load, pressure and sliding of each slice of one tooth pair along its path."""
    table = frame_of(found, LINE_LOADS, found.force.shape)
    touching = np.broadcast_to(found.on_path | (found.force > 0).any(axis=0), found.force.shape).ravel()
    return table[touching].reset_index(drop=True)


def loss_factor_table(found: ToothContact) -> pd.DataFrame:
    """Closed loss factors, marked outside their valid range, and the local loss factor of each torque."""
    with collected():
        closed = loss_factors(found.pair)
    rows = [(factor.name, math.nan, factor.value, factor.outside) for factor in closed]
    rows += [("local", torque, value, "") for torque, value in zip(found.torque, found.loss_factor, strict=True)]
    return pd.DataFrame(rows, columns=[one.name for one in LOSS_FACTORS])


def _pitches(found: ToothContact) -> np.ndarray:
    """Rotation of the mesh at the middles of its phases (base pitches)."""
    assert found.distribution is not None
    return (np.arange(found.distribution.approach.shape[1]) + 0.5) / found.conditions.positions
