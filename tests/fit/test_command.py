"""`mixedlub fit`: files of a fitted law run where they say, the answer is complete, and bad input is one sentence."""

import csv
import json
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

import mixedlub as ml
from mixedlub.chain.priors import LogNormal
from mixedlub.cli import main
from mixedlub.ehl import EXAMPLE, read_oil
from mixedlub.fit import checked, of_columns
from mixedlub.fit.candidates import candidates
from mixedlub.fit.exported import exported
from mixedlub.fit.inference import fit
from mixedlub.own_laws import read_law
from mixedlub.schema.toml_file import read_toml
from tests.fit.made_up import MADE_UP, MadeUp


def by_law(name: str) -> MadeUp:
    return next(made for made in MADE_UP if made.law == name)


def written(folder: Path, table, name: str = "readings.csv") -> Path:
    path = folder / name
    with path.open("w", newline="") as file:
        out = csv.writer(file)
        out.writerow(table)
        out.writerows(zip(*(map(repr, map(float, values)) for values in table.values()), strict=True))
    return path


def constants(made: MadeUp) -> list[str]:
    return [word for name, value in made.constants.items() for word in ("--set", f"{name}={value}")]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_answer_is_in_report_tables_json_and_pictures(folder, capsys):
    made = by_law("hamrock_dowson")
    path = written(folder, made.table(1))
    assert main(["fit", str(path), *constants(made), "--out", "o", "--xlsx"]) == 0
    said = capsys.readouterr().out
    assert "Best law: hamrock_dowson" in said
    assert "* hamrock_dowson" in said or "*hamrock_dowson" in said
    found = json.loads(Path("o/fit.json").read_text(encoding="utf-8"))
    assert (found["best"], found["tied"]) == ("hamrock_dowson", ["hamrock_dowson"])
    weights = [law["weight"] for law in found["laws"]]
    assert sum(weights) == pytest.approx(1.0)
    factor = found["laws"][0]["parameters"][0]
    assert factor["low90"] < factor["value"] < factor["high90"]
    assert {row["law"] for row in found["not_judged"]} >= {"dowson_toyoda_central", "moes"}
    assert Path("o/figures/residuals.svg").stat().st_size > 10_000
    assert Path("o/results.xlsx").exists()
    for table in Path("o").glob("*.parquet"):
        schema = pq.read_schema(table)
        assert all(schema.field(name).metadata[b"meaning"] for name in schema.names), table


def test_a_friction_law_is_exported_as_options_of_a_study(folder, capsys):
    made = by_law("schlenk")
    path = written(folder, made.table(1))
    assert main(["fit", str(path), *constants(made), "--out", "o", "--no-figures", "--law", "schlenk"]) == 0
    options = read_toml(Path("o/options.toml"))["options"]
    assert options["friction"] == "schlenk"
    pair = ml.gear_pair(teeth=(16, 24), normal_module_mm=4.5, pressure_angle_deg=20.0, face_width_mm=14.0)
    surfaces = (ml.surface(m0_um2=0.1, m2=0.003, m4_per_um2=0.002),) * 2
    oil = ml.oil("mineral", temperature_C=[40.0, 100.0], kinematic_viscosity_mm2_s=[100.0, 11.0])
    where = {"torque_Nm": [100.0], "speed_rpm": [1000.0], "oil_temperature_C": 60.0}
    own = ml.power_loss(pair, oil, surfaces, **where, options=options)
    plain = ml.power_loss(pair, oil, surfaces, **where, options={"friction": "schlenk"})
    ratio = float(own["mean_friction"].squeeze() / plain["mean_friction"].squeeze())
    assert ratio == pytest.approx(options["friction_coefficients"]["lubricant_factor"], rel=1e-6)


def test_a_form_is_exported_as_a_law_file_in_quantities_of_the_table(folder):
    made = by_law("mckee")
    path = written(folder, table := made.table(1))
    assert main(["fit", str(path), "--out", "o", "--no-figures", "--law", "mckee"]) == 0
    law = read_law(Path("o/law.toml"))
    state = {
        "viscosity": table["viscosity_mPa_s"] * 1e-3,
        "drive_speed": table["speed_rpm"] * np.pi / 30.0,
        "mean_pressure": table["specific load (MPa)"] * 1e6,
    }
    assert set(law.law.arguments) == {law.acts_on[0], *state}
    assert law.acts_on == ("friction_torque",)
    found = law.law(np.zeros(table["speed_rpm"].size), *(state[n] for n in law.law.arguments[1:]), **law.law_values())
    assert found == pytest.approx(table["friction_coefficient"], rel=0.08)


def test_a_law_file_has_the_interval_of_the_fit_as_its_prior(folder):
    readings = checked(of_columns(by_law("mckee").table(1), None, {}), None)
    found = fit(next(law for law in candidates(readings)[0] if law.name == "mckee"), readings)
    Path("law.toml").write_text(exported(found, readings)["law.toml"], encoding="utf-8")
    written_priors = {p.name: p.prior for p in read_law(Path("law.toml")).parameters}
    logarithmic = [p.name for p in found.law.parameters if isinstance(p.prior, LogNormal)]
    assert logarithmic
    for name in logarithmic:
        ratio = written_priors[name].value(1.6449) / written_priors[name].value(-1.6449)
        assert ratio == pytest.approx(found.high90[name] / found.low90[name], rel=1e-4)


def test_a_law_file_of_a_drive_simulates_the_drive(folder):
    made = MADE_UP[-1]
    path = written(folder, table := made.table(3))
    assert main(["fit", str(path), "--out", "o", "--no-figures", "--law", "gauss"]) == 0
    drive = {
        "kind": "friction_map",
        "recording": {"quantity": "friction_torque_Nm"},
        "effects": {"o/law.toml": {}},
    }
    case = ml.case.case_of(drive, {name: list(values) for name, values in table.items()})
    simulated = ml.simulate(case)["friction_torque_Nm"].to_numpy()
    assert simulated == pytest.approx(table["friction_torque_Nm"], rel=0.07)


def test_an_oil_is_exported_for_studies_and_for_the_solver(folder):
    made = by_law("d341_roelands")
    path = written(folder, made.table(1))
    arguments = ["fit", str(path), *constants(made), "--no-figures"]
    assert main([*arguments, "--out", "o"]) == 0
    oil = ml.oil("o/oil.toml")
    exact = by_law("d341").reading({"temperature_C": np.array([40.0, 100.0])}, np.random.default_rng(1)) / 0.86
    assert oil.kinematic_viscosity_mm2_s == pytest.approx(exact, rel=0.03)
    assert oil.pressure_viscosity_per_GPa == pytest.approx([20.0, 15.2], rel=0.04)
    assert main([*arguments, "--out", "s", "--law", "roelands"]) == 0
    text = EXAMPLE.read_text(encoding="utf-8")
    section = text[text.index("[viscosity]") : text.index("[shear]")]
    Path("solver.toml").write_text(text.replace(section, Path("s/viscosity.toml").read_text(encoding="utf-8") + "\n"))
    assert read_oil("solver.toml").name == "reference oil"


def test_a_case_folder_is_read_with_its_contact_and_oil(folder, capsys):
    assert main(["new", "case", "--kind", "film", "--out", "case"]) == 0
    assert main(["fit", "case", "--out", "o", "--no-figures"]) == 0
    found = json.loads(Path("o/fit.json").read_text(encoding="utf-8"))
    assert "hamrock_dowson" in found["tied"]


def test_a_case_takes_no_constants(folder, capsys):
    assert main(["new", "case", "--kind", "film", "--out", "case"]) == 0
    assert main(["fit", "case", "--set", "radius_mm=3", "--out", "o"]) == 2
    assert "constants are for tables" in capsys.readouterr().err


def test_readings_outside_the_range_of_a_law_are_said(folder, capsys):
    made = by_law("misharin")
    path = written(folder, made.table(1))
    assert main(["fit", str(path), *constants(made), "--out", "o", "--no-figures"]) == 0
    assert "misharin is used outside the range in which it holds" in capsys.readouterr().err


CELSIUS, FALLING = [20.0, 40.0, 60.0, 80.0, 100.0], [5, 4, 3, 2, 1]
GOOD = {"temperature_C": CELSIUS, "viscosity_mPa_s": [100.0, 40.0, 18.0, 10.0, 6.0]}
ALIKE = {"temperature_C": [40.0] * 5, "viscosity_mPa_s": [10.0, 10.1, 9.9, 10.2, 9.8]}
SPEED = [0.1, 0.2, 0.5, 1.0, 2.0]
SLIDING = {"sliding_speed_m_s": SPEED, "friction_coefficient": [0.1, 0.08, 0.05, 0.04, 0.03]}
NO_ZERO = "reading 3: 0.0: a reading of 0 has no relative noise; state an absolute one"


@pytest.mark.parametrize(
    ("table", "words", "message"),
    [
        ({"temperature_C": CELSIUS, "viscosty_mPa_s": FALLING}, [], "nearest known: 'viscosity_mPa_s'"),
        ({"colour_of_oil": SPEED, "x": SPEED}, [], "has no column to fit laws to: friction_coefficient"),
        ({**GOOD, "viscosity_mPa_s": [100.0, 40.0, -18.0, 10.0, 6.0]}, [], "reading 3: -18.0: must be above 0"),
        ({**GOOD, "viscosity_mPa_s": [10.0] * 5}, [], "all 5 readings are the same"),
        (ALIKE, [], "no condition has a second level"),
        ({name: values[:2] for name, values in GOOD.items()}, [], "2 readings are fewer"),
        ({"temperature": CELSIUS, "viscosity_mPa_s": FALLING}, [], "has no unit"),
        ({"temperature (N)": CELSIUS, "viscosity_mPa_s": FALLING}, [], "N is no unit of"),
        ({"load_N": SPEED, "film_thickness_nm": SPEED}, [], "no law can be judged"),
        ({"temperature_C": CELSIUS, "viscosity_mm2_s": FALLING}, [], "--set density_kg_m3=860"),
        (GOOD, ["--quantity", "film_thicknes_nm"], "nearest known: 'film_thickness_nm'"),
        (GOOD, ["--relative-sd", "2"], "must lie above 0 and below 1"),
        (GOOD, ["--set", "radius"], "is COLUMN=NUMBER"),
        (GOOD, ["--set", "radus_mm=3"], "nearest known: 'radius'"),
        (GOOD, ["--set", "radius_mm=3", "--set", "radius_mm=4"], "radius_mm is set twice"),
        (GOOD, ["--set", "radius_mm=3", "--set", "radius_m=0.004"], "radius is set twice"),
        ({**SLIDING, "friction_coefficient": [0.1, 0.05, 0.0, 0.03, 0.04]}, ["--relative-sd", "0.02"], NO_ZERO),
        (GOOD, ["--law", "vogl"], "nearest known: 'vogel'"),
        (GOOD, ["--law", "d341"], "is not judged: needs a column oil_density"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence(folder, capsys, table, words, message):
    path = written(folder, table)
    assert main(["fit", str(path), *words, "--out", "o", "--no-figures"]) == 2
    (said,) = (line for line in capsys.readouterr().err.splitlines() if line.startswith("mixedlub:"))
    assert message in said
    assert "Traceback" not in said
    assert not Path("o").exists() or not list(Path("o").iterdir())


def test_a_missing_file_is_one_sentence(folder, capsys):
    assert main(["fit", "absent.csv"]) == 2
    assert "no such file" in capsys.readouterr().err
