"""Efficiency of published gears, by the same command as a user's."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.efficiency import Losses
from mixedlub.efficiency.gearbox import MESH
from tests.efficiency.gearboxes import SMOOTH, gearbox

SPEEDS = [2000.0, 4000.0, 6000.0, 8000.0]


def computed(folder: Path, stage: dict[str, Any], torque: list[float], speed: list[float]) -> Losses:
    """The map of a stage without parts."""
    return gearbox(folder, stage, conditions={"torque_Nm": torque, "speed_rpm": speed}).map()


@pytest.mark.literature(
    "Petry-Johnson's gear in a thesis of Seoul National University, tables 3.7 to 3.12: the loss that the measured one "
    "and the printed error of Xu's model imply"
)
def test_loss_of_a_measured_gear_with_the_friction_of_xu(tmp_path: Path) -> None:
    flank = {"m0_um2": 0.07**2 / 2, "m2": 0.0015, "m4_per_um2": 0.002}
    stage = {
        "oil_temperature_C": 100.0,
        "gears": {"preset": "measured_40_40"},
        "lubricant": {
            "temperature_C": [40.0, 100.0],
            "kinematic_viscosity_mm2_s": [90.0, 0.0106 / 799.3 * 1e6],
            "pressure_viscosity_per_GPa": [9.68, 9.68],
            "density_15C_kg_m3": 799.3,
            "density_change_per_K": 0.0,
        },
        "surfaces": {"pinion": flank, "gear": flank},
        "options": {"friction": "xu_kahraman"},
    }
    found = computed(tmp_path, stage, [413.0], SPEEDS)
    assert found.total() == pytest.approx([112.0, 213.0, 316.0, 399.0], rel=0.04)
    power = 413.0 * np.array(SPEEDS) * math.pi / 30
    assert power * 1e-3 == pytest.approx([86.5, 173.0, 259.5, 346.0], rel=1e-3)
    assert found.efficiency(MESH) == pytest.approx(1.0 - np.array([112.0, 213.0, 316.0, 399.0]) / power, abs=5e-5)


@pytest.mark.literature("GEARpie (FEUP), report of the gear C14: 200 N m, 1500 rpm, P_VZP 295.17 W")
def test_tooth_efficiency_of_the_gear_c14(tmp_path: Path) -> None:
    """Oil M320 at 75 C by its viscosity, which counts with the power -0.05; Ra 0.6 um on both flanks, X_L 0.85."""
    heights = {"m0_um2": (0.6 * math.sqrt(math.pi / 2)) ** 2, "m2": 0.0015, "m4_per_um2": 0.002}
    stage = {
        "oil_temperature_C": 75.0,
        "gears": {"preset": "fzg_c"},
        "lubricant": {
            "temperature_C": [40.0, 100.0],
            "kinematic_viscosity_mm2_s": [320.0, 24.0],
            "density_15C_kg_m3": 900.0,
        },
        "surfaces": {"pinion": heights, "gear": heights},
        "options": {"friction": "schlenk", "friction_coefficients": {"lubricant_factor": 0.85}},
    }
    found = computed(tmp_path, stage, [200.0], [1500.0])
    assert found.total() == pytest.approx(295.17, rel=0.01)
    assert 1.0 - found.efficiency(MESH) == pytest.approx(295.17 / (200.0 * 50.0 * math.pi), rel=0.01)


@pytest.mark.literature("H. Ohlendorf (1958), in the form of Niemann and Winter, Maschinenelemente II; FZG C: 0.195")
@pytest.mark.parametrize("driving", ["pinion", "gear"])
def test_tooth_efficiency_of_constant_friction(tmp_path: Path, driving: str) -> None:
    """P_V = P_a mu H_V, whichever side drives."""
    stage = {
        "driving": driving,
        "oil_temperature_C": 80.0,
        "gears": {"preset": "fzg_c"},
        "lubricant": {"oil": "m100"},
        "surfaces": {"pinion": SMOOTH, "gear": SMOOTH},
        "options": {"friction": "constant", "friction_coefficients": {"friction": 0.05}},
    }
    found = computed(tmp_path, stage, [100.0, 300.0], [500.0, 2000.0])
    assert 1.0 - found.efficiency(MESH) == pytest.approx(0.05 * 0.1950, rel=1e-3)
