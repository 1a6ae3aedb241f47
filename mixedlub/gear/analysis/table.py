"""Tables of a loaded tooth contact, with units in the names of the columns."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from mixedlub.gear import GearPair, IsoStiffness, loss_factors
from mixedlub.gear.analysis.tooth_contact import ToothContact
from mixedlub.schema.findings import collected

STIFFNESS = 1e-9
"""From N/m per m to N/(mm um)."""


def load_share_table(found: ToothContact) -> pd.DataFrame:
    """Share of one tooth pair over the roll angle of the pinion, as `load_share.csv` of a case."""
    torques, positions = found.load_share.shape
    return pd.DataFrame(
        {
            "torque_Nm": np.repeat(found.torque, positions),
            "roll_angle_deg": np.tile(np.degrees(found.roll_angle), torques),
            "load_share": found.load_share.ravel(),
        }
    )


def line_load_table(found: ToothContact) -> pd.DataFrame:
    """Line load, pressure and sliding of each slice of one tooth pair on its way through the mesh."""
    torques, positions, slices = found.force.shape
    every = np.ones((torques, 1, 1))
    columns = {
        "torque_Nm": found.torque[:, None, None],
        "roll_angle_deg": np.degrees(found.roll_angle)[None, :, None],
        "face_position_mm": found.face * 1e3,
        "path_position_mm": found.position * 1e3 * every,
        "line_load_N_mm": found.line_load * 1e-3,
        "hertz_pressure_MPa": found.pressure * 1e-6,
        "sliding_over_base_speed": found.sliding * every,
    }
    shape = (torques, positions, slices)
    table = pd.DataFrame({name: np.broadcast_to(values, shape).ravel() for name, values in columns.items()})
    touching = np.broadcast_to(found.on_path | (found.force > 0).any(axis=0), shape).ravel()
    return table[touching].reset_index(drop=True)


def transmission_table(found: ToothContact) -> pd.DataFrame:
    """Transmission error and stiffness over the mesh of elastic teeth; empty of others."""
    solved = found.distribution
    if solved is None:
        return pd.DataFrame()
    torques, phases = solved.approach.shape
    pairs_touching = (solved.force.sum(axis=3) > 0).sum(axis=2)
    load = solved.force.sum(axis=2)
    secant = found.base_force[:, None] / solved.approach
    pitches = (np.arange(phases) + 0.5) / found.conditions.positions
    columns = {
        "torque_Nm": np.repeat(found.torque, phases),
        "base_pitches": np.tile(pitches, torques),
        "roll_angle_deg": np.tile(np.degrees(pitches * found.pair.base_pitch / found.pair.base_radius[0]), torques),
        "transmission_error_um": solved.approach.ravel() * 1e6,
        "mesh_stiffness_N_um": solved.stiffness.ravel() * 1e-6,
        "secant_stiffness_N_um": secant.ravel() * 1e-6,
        "pairs_in_contact": pairs_touching.ravel(),
        "largest_line_load_N_mm": solved.force.max(axis=(2, 3)).ravel() * _per_width(found) * 1e-3,
        "load_centre_mm": ((load * solved.face).sum(axis=2) / load.sum(axis=2)).ravel() * 1e3,
    }
    return pd.DataFrame(columns)


def summary_table(found: ToothContact, iso: list[IsoStiffness]) -> pd.DataFrame:
    """One row a torque."""
    pair, solved = found.pair, found.distribution
    columns: dict[str, object] = {
        "torque_Nm": found.torque,
        "base_tangent_force_N": found.base_force,
        "axial_force_N": found.base_force * math.tan(abs(pair.base_helix_angle)),
    }
    if solved is not None:
        mean = found.base_force[:, None] / solved.approach / pair.face_width
        columns |= {
            "mean_transmission_error_um": solved.approach.mean(axis=1) * 1e6,
            "peak_to_peak_transmission_error_um": solved.peak_to_peak * 1e6,
            "mean_mesh_stiffness_N_mm_um": solved.stiffness.mean(axis=1) / pair.face_width * STIFFNESS,
            "mean_secant_stiffness_N_mm_um": mean.mean(axis=1) * STIFFNESS,
        }
    columns |= {
        "iso_theoretical_single_stiffness_N_mm_um": [one.theoretical * STIFFNESS for one in iso],
        "iso_single_stiffness_N_mm_um": [one.single * STIFFNESS for one in iso],
        "iso_mesh_stiffness_N_mm_um": [one.mesh * STIFFNESS for one in iso],
        "iso_face_stiffness_N_mm_um": [one.face * STIFFNESS for one in iso],
        "largest_load_share": found.load_share.max(axis=1),
        "largest_line_load_N_mm": found.line_load.max(axis=(1, 2)) * 1e-3,
        "largest_hertz_pressure_MPa": found.pressure.max(axis=(1, 2)) * 1e-6,
        "face_load_factor": found.face_load_factor,
        "contact_pattern_percent": 100.0 * found.pattern,
        "load_beyond_path_percent": 100.0 * found.beyond_path,
        "local_loss_factor": found.loss_factor,
    }
    return pd.DataFrame(columns)


def loss_factor_table(found: ToothContact) -> pd.DataFrame:
    """Closed loss factors, with a word where they do not hold, and the local one of each torque."""
    with collected():
        closed = loss_factors(found.pair)
    rows = [(factor.name, math.nan, factor.value, factor.outside) for factor in closed]
    rows += [("local", torque, value, "") for torque, value in zip(found.torque, found.loss_factor, strict=True)]
    return pd.DataFrame(rows, columns=["loss_factor", "torque_Nm", "value", "outside_range"])


GEOMETRY = (
    ("transverse_contact_ratio", lambda pair: pair.contact_ratio),
    ("overlap_ratio", lambda pair: pair.overlap_ratio),
    ("working_pressure_angle_deg", lambda pair: math.degrees(pair.working_pressure_angle)),
    ("base_helix_angle_deg", lambda pair: math.degrees(pair.base_helix_angle)),
    ("centre_distance_mm", lambda pair: pair.working_centre_distance * 1e3),
    ("backlash_mm", lambda pair: pair.backlash * 1e3),
    ("base_pitch_mm", lambda pair: pair.base_pitch * 1e3),
    ("path_start_mm", lambda pair: pair.path_start * 1e3),
    ("pitch_point_mm", lambda pair: pair.pitch_point * 1e3),
    ("path_end_mm", lambda pair: pair.path_end * 1e3),
    ("path_length_mm", lambda pair: (pair.path_end - pair.path_start) * 1e3),
    ("pinion_base_diameter_mm", lambda pair: pair.base_radius[0] * 2e3),
    ("gear_base_diameter_mm", lambda pair: pair.base_radius[1] * 2e3),
    ("pinion_tip_diameter_mm", lambda pair: pair.tip_radii[0] * 2e3),
    ("gear_tip_diameter_mm", lambda pair: pair.tip_radii[1] * 2e3),
    ("pinion_tip_thickness_mm", lambda pair: pair.tip_thickness[0] * 1e3),
    ("gear_tip_thickness_mm", lambda pair: pair.tip_thickness[1] * 1e3),
)
"""What the data sheet means for the mesh: name with unit, and value of a pair."""


def geometry_table(pair: GearPair) -> pd.DataFrame:
    """Geometry of the mesh; positions on the path count from the base tangent point of the pinion."""
    return pd.DataFrame([(name, value(pair)) for name, value in GEOMETRY], columns=["quantity", "value"])


def _per_width(found: ToothContact) -> float:
    return found.face.size / found.pair.face_width
