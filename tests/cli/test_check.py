"""`mixedlub check` says what may be calibrated, stated or not."""

from pathlib import Path

import numpy as np

from mixedlub.cli import main
from mixedlub.importers import write_case


def understood(tmp_path: Path, capsys, system, columns) -> str:
    folder = write_case(tmp_path / "case", system, columns)
    assert main(["check", str(folder)]) == 0
    return capsys.readouterr().out


BALL = {"geometry": "point", "radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 75.0]}
BALL["poisson_ratio"] = [0.3, 0.22]


def test_an_unnamed_oil_is_told_with_its_broad_priors(tmp_path, capsys):
    system = {"kind": "film", "contact": BALL, "recording": {"quantity": "film_thickness_nm"}}
    columns = {
        "load_N": [20.0, 20.0],
        "entrainment_speed_m_s": [0.1, 1.0],
        "slide_roll_ratio": [0.0, 0.0],
        "oil_temperature_C": [40.0, 40.0],
        "film_thickness_nm": [50.0, 230.0],
    }
    said = understood(tmp_path, capsys, system, columns)
    assert "fitted with a broad prior" in said
    assert "viscosity: 80 % within" in said
    assert "all inputs count as known" not in said
    assert "rests on these data" in said.replace("\n", " ")


def test_a_friction_map_names_its_unknown_torques_and_its_own_noise(tmp_path, capsys):
    speed = np.array([-10.0, -5.0, 5.0, 10.0])
    columns = {
        "speed_rpm": speed,
        "friction_torque_Nm": 2.0 * np.sign(speed),
        "friction_torque_Nm_sd": np.full(4, 0.1),
    }
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    said = understood(tmp_path, capsys, system, columns)
    assert "coulomb torque: 80 % within" in said
    assert "Noise of a reading: the column friction_torque_Nm_sd." in said
