"""Friction laws against numbers of their sources, one contact and one mesh at a time, and as studies of whole gears."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mixedlub.friction import catalogue
from mixedlub.laws import contact, pitch_point
from mixedlub.study import read_study, run_study
from mixedlub.study.schema import StudyFile

CONTACT = {
    "radius": 5e-3,
    "entrainment_speed": 5.0,
    "hertz_pressure": 2e9,
    "viscosity": 0.010,
    "kinematic_viscosity": 13e-6,
    "composite_roughness": 0.07e-6,
    "line_load": 553e3,
}
"""Figure 3.1: R 5 mm, sum speed 10 m/s, 2 GPa, 10 cP and 13 cSt, 0.07 um, hence 553 N/mm."""


def at_contact(name: str, slide_roll_ratio: float) -> float:
    state = {**CONTACT, "slide_roll_ratio": slide_roll_ratio, "sliding_speed": 5.0 * slide_roll_ratio}
    if name == "odonoghue_cameron":  # its roughness is a centre-line average
        state["composite_roughness"] = 0.07e-6 * math.sqrt(math.pi / 2)
    law = catalogue()[name]
    return float(law.law(*(state[quantity] for quantity in law.reads)))


@pytest.mark.literature("H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, at the condition of its figure 3.1")
@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("drozdov_gavrikov", (0.0594, 0.0526, 0.0442, 0.0335)),
        ("odonoghue_cameron", (0.0981, 0.0723, 0.0574, 0.0455)),
        ("misharin", (0.1145, 0.0910, 0.0765, 0.0644)),
        ("iso_tc60", (0.0633, 0.0633, 0.0633, 0.0633)),
        ("benedict_kelley", (0.0607, 0.0553, 0.0513, 0.0473)),
        ("xu_kahraman", (0.0175, 0.0224, 0.0196, 0.0147)),
    ],
)
def test_local_laws_over_slide_to_roll_ratio(name: str, values: tuple[float, ...]) -> None:
    found = [at_contact(name, ratio) for ratio in (0.1, 0.25, 0.5, 1.0)]
    assert found == pytest.approx(values, abs=0.6e-4)


@pytest.mark.literature("H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, at the condition of its figure 3.1")
def test_load_of_the_condition_is_that_of_its_pressure() -> None:
    modulus = contact.reduced_modulus((206e9, 206e9), (0.3, 0.3))
    assert contact.line_hertz_pressure(553e3, 5e-3, modulus) == pytest.approx(2e9, rel=0.01)


@pytest.mark.literature(
    "FZG test gear C at 183.4 N m and 8.3 m/s: ISO/TR 14179-2, 15144-1 and 13989-1, and the program of Fernandes"
)
@pytest.mark.parametrize(
    ("name", "value", "digits"),
    [("schlenk", 0.04257, 5), ("iso_tr_15144", 0.05160, 5), ("iso_tr_13989", 0.05321, 5), ("fernandes", 0.0487, 4)],
)
def test_mean_laws_of_the_fzg_test_gear(name: str, value: float, digits: int) -> None:
    angle = math.acos(33.829 / 36.6)
    base = {"pinion_radius": 36.6e-3, "gear_radius": 54.9e-3, "face_width": 14e-3}
    load = pitch_point.mesh_line_load(np.array(183.4 / 33.829e-3), 14e-3)
    state = {
        **base,
        "mesh_line_load": load,
        "transmitted_force": load * 14e-3,
        "pitch_entrainment_speed": pitch_point.pitch_entrainment_speed(8.3, angle),
        "pitch_radius": pitch_point.pitch_radius(36.6e-3, 54.9e-3, angle, 0.0),
        "viscosity": 0.010,
        "pressure_viscosity": 15e-9,
        "mean_roughness": 0.2e-6,
        "base_helix_angle": 0.0,
        "contact_ratio": 1.44,
    }
    law = catalogue()[name]
    found = law.with_coefficients({})(*(state[quantity] for quantity in law.reads))
    assert float(found[0]) == pytest.approx(value, abs=0.6 * 10**-digits)


def loss(file: dict[str, object]) -> tuple[np.ndarray, np.ndarray]:
    """Mesh loss (W) over speed, and mean friction, of a study with one pairing, torque and temperature."""
    results = run_study(read_study(Path("gear.toml"), StudyFile.model_validate(file)))
    return results["mesh_loss"].ravel(), results["mean_friction"].ravel()


@pytest.mark.literature(
    "Petry-Johnson's gear in a thesis of Seoul National University, tables 3.7 to 3.12: the loss that the measured one "
    "and the printed error of Xu's model imply"
)
def test_loss_of_a_measured_gear_with_the_friction_of_xu() -> None:
    """413 N m, rigid teeth, 75W90 at 100 C; the one Rq printed, 0.07 um, is taken as that of both surfaces together."""
    found, _ = loss(
        {
            "schema": "mixedlub-study/1",
            "gears": {
                "teeth": [40, 40],
                "normal_module_mm": 2.32,
                "pressure_angle_deg": 28.0,
                "profile_shift": [-0.2621, -0.2621],
                "tip_diameter_mm": [95.95, 95.95],
                "centre_distance_mm": 91.5,
                "face_width_mm": 26.7,
            },
            "lubricant": {
                "temperature_C": [40.0, 100.0],
                "kinematic_viscosity_mm2_s": [90.0, 0.0106 / 799.3 * 1e6],
                "pressure_viscosity_per_GPa": [9.68, 9.68],
                "density_15C_kg_m3": 799.3,
                "density_change_per_K": 0.0,
            },
            "surfaces": {"flank": {"m0_um2": 0.07**2 / 2, "m2": 0.0015, "m4_per_um2": 0.002}},
            "conditions": {"torque_Nm": [413], "speed_rpm": [2000, 4000, 6000, 8000], "oil_temperature_C": [100]},
            "options": {"friction": "xu_kahraman"},
        }
    )
    assert found == pytest.approx([112.0, 213.0, 316.0, 399.0], rel=0.04)


@pytest.mark.literature("GEARpie (FEUP), report of the gear C14: 200 N m, 1500 rpm, oil M320 at 75 C, Ra 0.6, X_L 0.85")
def test_loss_of_the_gear_c14_with_the_friction_of_schlenk() -> None:
    """The viscosity counts with the power -0.05: that of ISO VG 320 with a viscosity index of 95 is near enough."""
    heights = (0.6 * math.sqrt(math.pi / 2)) ** 2
    found, friction = loss(
        {
            "schema": "mixedlub-study/1",
            "gears": {
                "teeth": [16, 24],
                "normal_module_mm": 4.5,
                "profile_shift": [0.1817, 0.1715],
                "tip_diameter_mm": [82.46, 118.36],
                "centre_distance_mm": 91.5,
                "face_width_mm": 14.0,
            },
            "lubricant": {
                "temperature_C": [40.0, 100.0],
                "kinematic_viscosity_mm2_s": [320.0, 24.0],
                "density_15C_kg_m3": 900.0,
            },
            "surfaces": {"flank": {"m0_um2": heights, "m2": 0.0015, "m4_per_um2": 0.002}},
            "conditions": {"torque_Nm": [200], "speed_rpm": [1500], "oil_temperature_C": [75]},
            "options": {"friction": "schlenk", "friction_coefficients": {"lubricant_factor": 0.85}},
        }
    )
    assert friction == pytest.approx([0.0483], rel=0.01)
    assert found == pytest.approx([295.17], rel=0.01)
