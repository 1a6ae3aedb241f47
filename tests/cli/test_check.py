"""`mixedlub check` says what may be calibrated, stated or not."""

import shutil
from pathlib import Path

import numpy as np
import pytest

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
    assert "fitted with broad priors" in said.replace("\n", " ")


def test_a_viscosity_case_tells_once_what_is_typical_of_the_oil_and_only_what_it_reads(tmp_path, capsys):
    system = {"kind": "viscosity", "lubricant": {"density_15C_kg_m3": 972.0}}
    system["recording"] = {"quantity": "viscosity_mPa_s", "noise": {"relative": 0.01}}
    columns = {"temperature_C": [20.0, 30.0, 40.0, 60.0, 80.0], "viscosity_mPa_s": [78.0, 45.0, 28.0, 13.4, 7.6]}
    said = understood(tmp_path, capsys, system, columns)
    (line,) = [line for line in said.splitlines() if "taken as typical of base" in line]
    assert "density_change_per_K = 0.00065" in line
    assert not any(key in line for key in ("eyring_stress", "thermal_conductivity", "specific_heat"))


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


def test_noise_has_the_unit_of_the_reading(capsys):
    assert main(["check", str(EXAMPLE)]) == 0
    assert "Noise of a reading: 0.01 of its value and 0.2 W.\n" in capsys.readouterr().out


EXAMPLE = Path(__file__).parents[2] / "examples" / "case"


def spoilt(folder: Path, change) -> Path:
    """The example with its readings (a list of numbers) changed."""
    case = shutil.copytree(EXAMPLE, folder / "case")
    head, *lines = (case / "recordings.csv").read_text(encoding="utf-8").splitlines()
    cells = [line.split(",") for line in lines]
    readings = change([float(row[-1]) for row in cells])
    rows = [",".join([*row[:-1], repr(y)]) for row, y in zip(cells, readings, strict=False)]
    (case / "recordings.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return case


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            lambda y: [v / 1000 for v in y],
            "readings are about a thousandth of what the base model gives: check the unit",
        ),
        (
            lambda y: [v * 1000 for v in y],
            "readings are about a thousand times what the base model gives: check the unit",
        ),
        (lambda y: [-v for v in y], "most readings have the opposite sign to the base model"),
        (lambda y: [33.3] * 20 + y[20:], "20 of 72 readings are exactly 33.3 though speed_rpm,"),
        (lambda y: y[:4], "Cannot be diagnosed: {case}/recordings.csv: power_loss_W: 4: needs at least 5 readings"),
    ],
    ids=["thousandth", "thousandfold", "negative", "stuck", "few"],
)
def test_what_is_doubtful_about_the_readings_is_told(change, said, tmp_path, capsys):
    case = spoilt(tmp_path, change)
    assert main(["check", str(case)]) == 0
    assert said.format(case=case) in capsys.readouterr().out


def test_nothing_is_doubtful_about_the_example(capsys):
    assert main(["check", str(EXAMPLE)]) == 0
    said = capsys.readouterr().out
    assert "Doubtful" not in said
    assert "Cannot be diagnosed" not in said


@pytest.mark.parametrize("number", range(8))
def test_nothing_is_doubtful_about_the_practice_cases(number, shared, capsys):
    case = shared / "cases" / f"case_{number:03}"
    if not case.is_dir():
        pytest.skip("practice cases not present beside the project")
    assert main(["check", str(case)]) == 0
    said = capsys.readouterr().out
    assert "Doubtful" not in said
    assert "Cannot be diagnosed" not in said


def test_every_default_that_is_taken_is_listed_with_its_value(tmp_path, capsys):
    case = shutil.copytree(EXAMPLE, tmp_path / "case")
    file = case / "system.toml"
    left_out = ("boundary_friction = 0.1", "pressure_angle_deg", "load_sharing", "eyring_stress_MPa")
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith(left_out)]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert main(["check", str(case)]) == 0
    said = capsys.readouterr().out.partition("Assumed:")[2]
    for default in (
        "boundary_friction = 0.1",
        "pressure_angle_deg = 20",
        "load_sharing = rigid: the pairs in contact share equally",
        "tip_diameter_mm = [80.4333, 118.533], standard addendum",
        "centre_distance_mm = 91.0167, from the profile shift",
        "profile_shift = [0, 0]",
        "youngs_modulus_GPa = [206, 206]",
        "poisson_ratio = [0.3, 0.3]",
        "eyring_stress_MPa = 5.0 not given; taken as typical of base mineral (assumed)",
        "surfaces.polished, surfaces.ground: thermal_conductivity_W_mK = 46",
        "ambient_temperature_C = 25",
    ):
        assert default in said


def test_a_ball_of_given_bodies_assumes_nothing_of_them(tmp_path, capsys):
    oil = {"temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [30.0, 6.2]}
    system = {"kind": "film", "contact": BALL, "lubricant": oil, "recording": {"quantity": "film_thickness_nm"}}
    columns = {"load_N": [20.0, 20.0], "entrainment_speed_m_s": [0.1, 1.0], "slide_roll_ratio": [0.0, 0.0]}
    columns |= {"oil_temperature_C": [40.0, 40.0], "film_thickness_nm": [50.0, 230.0]}
    said = understood(tmp_path, capsys, system, columns).partition("Assumed:")[2]
    assert "pressure_viscosity_per_GPa = [15.9, 11.6]" in said
    assert not any(key in said for key in ("boundary_friction", "youngs_modulus", "surfaces", "ambient"))


@pytest.mark.parametrize(("header", "things", "told"), [("drive", ["A", "B"], True), ("remark", ["", "slow"], False)])
def test_things_that_an_unread_column_tells_apart_are_told(header, things, told, tmp_path, capsys):
    speed = np.tile(np.arange(1.0, 11.0), 2)
    columns = {"speed_rpm": speed, "friction_torque_Nm": 1.0 + speed + np.repeat([0.0, 0.5], 10)}
    columns[header] = np.repeat(things, 10)
    said = understood(
        tmp_path, capsys, {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}, columns
    )
    line = (
        f"  recordings.csv: {header!r} is not read, so rows of 2 different things are pooled (A, B): keep the rows of "
        "one, or name each in a column setup.\n"
    )
    assert (line in said) == told
    assert ("pooled" in said) == told


@pytest.mark.parametrize(("factor", "advice"), [(-2.5, "cannot be below zero"), (10.0, "check unit and decimal")])
@pytest.mark.parametrize("run", [1, 3, 70])
def test_a_reading_that_cannot_be_is_doubted(tmp_path, capsys, factor, advice, run):
    folder = spoilt(tmp_path, lambda y: [factor * v if i == run else v for i, v in enumerate(y, start=1)])
    assert main(["check", str(folder)]) == 0
    (said,) = [line for line in capsys.readouterr().out.splitlines() if "others suggest" in line]
    assert said.startswith(f"  run {run}: reads ")
    assert advice in said


def test_the_shipped_example_has_no_doubtful_reading(capsys):
    assert main(["check", str(EXAMPLE)]) == 0
    assert "others suggest" not in capsys.readouterr().out


@pytest.mark.parametrize("case", [f"case_00{i}" for i in range(8)])
def test_no_reading_of_the_practice_cases_is_doubted(case, shared, capsys):
    assert main(["check", str(shared / "cases" / case)]) == 0
    assert "others suggest" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("added", "said"),
    [
        ("", []),
        ('flattening = "waves"\n', ["flattening = waves", "the roughness inside the film"]),
        ("short_cutoff_over_half_width = 0.1\n", ["flattening = none", "short cut-off at 0.1 of the half-width"]),
    ],
)
def test_the_roughness_in_the_film_is_named_where_it_is_chosen(tmp_path, capsys, added, said):
    folder = tmp_path / "case"
    shutil.copytree(EXAMPLE, folder)
    file = folder / "system.toml"
    file.write_text(added + file.read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["check", str(folder)]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if "flattening" in line]
    assert len(lines) == bool(said)
    assert all(part in line for part in said for line in lines)
