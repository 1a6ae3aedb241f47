"""Kind ``table``: the user's own simulation beside a recording."""

import json

import numpy as np
import pandas as pd
import pytest

from mixedlub.case.folder import case_of, read_case
from mixedlub.case.forward import Forward
from mixedlub.case.simulation import simulate
from mixedlub.cli import main
from mixedlub.diagnosis.assessment import candidates
from mixedlub.diagnosis.labels import axis_label
from mixedlub.recording.conditions import raw_coordinates
from mixedlub.schema.units import stated_units
from profiles.errors import InputError
from tests.kinds.tables_of_cases import ORDERS, compared, deal

SYSTEM = """
schema = "mixedlub-case/1"
kind = "table"
[conditions.preload]
unit = "kN"
[conditions.grease]
[uncertainty]
viscosity = 0.1
stiffness = { value = 3.0, sd = 0.2, unit = "N/mm" }
[recording]
quantity = "drag"
unit = "N"
noise = { relative = 0.01 }
"""
OF_FILMS = {'"table"': '"film"', "stiffness =": "# ", 'quantity = "drag"\nunit = "N"': 'quantity = "film_thickness_nm"'}


def recording() -> pd.DataFrame:
    """Drag over preload and temperature of two greases: the simulation with 1 % noise."""
    rng = np.random.default_rng(3)
    levels = [(p, t, g) for p in (1.0, 3.0, 5.0) for t in (20.0, 40.0, 60.0) for g in ("A", "B")] * 2
    frame = pd.DataFrame(levels, columns=["preload", "oil_temperature_C", "grease"])
    frame.insert(0, "run", np.arange(1, len(frame) + 1))
    simulated = 2.0 + 3.0 * frame["preload"] + 0.02 * frame["oil_temperature_C"] * (frame["grease"] == "A")
    frame["drag"] = simulated * (1.0 + 0.01 * rng.standard_normal(len(frame)))
    frame["simulated"] = simulated
    frame["simulated_viscosity"] = 1.05 * simulated
    frame["simulated_stiffness"] = simulated + 0.2
    return frame


def written(folder, frame=None, system=SYSTEM):
    (recording() if frame is None else frame).to_csv(folder / "recordings.csv", index=False)
    (folder / "system.toml").write_text(system, encoding="utf-8")
    return folder


def test_inputs_respond_along_their_columns(tmp_path):
    case = read_case(written(tmp_path))
    forward, simulated = Forward(case, case.recordings), case.recordings["simulated"]
    assert forward.base_prediction() == pytest.approx(simulated)
    assert [c.name for c in forward.calibrations] == ["viscosity", "stiffness"]
    two_up = np.exp(2 * 0.1)
    assert forward.predict({"viscosity": two_up}) == pytest.approx(simulated * 1.05**2)
    assert forward.predict({"stiffness": 2.8}) == pytest.approx(simulated - 0.2)
    assert forward.predict({"viscosity": two_up, "stiffness": 3.4}) == pytest.approx(simulated * 1.05**2 + 0.4)


def test_readings_of_either_sign_respond_linearly():
    frame = recording()
    for name in ("drag", "simulated", "simulated_viscosity"):
        frame[name] -= 8.0
    system = {
        "kind": "table",
        "uncertainty": {"viscosity": 0.1},
        "recording": {"quantity": "drag", "unit": "N"},
        "conditions": {"preload": {"unit": "kN"}, "grease": {}},
    }
    case = case_of(system, frame.drop(columns="simulated_stiffness"))
    forward, table = Forward(case, case.recordings), case.recordings
    expected = table["simulated"] + 2.0 * (table["simulated_viscosity"] - table["simulated"])
    assert forward.predict({"viscosity": np.exp(0.2)}) == pytest.approx(expected)


def test_a_stated_unit_stands_on_axes(tmp_path):
    case = read_case(written(tmp_path))
    with stated_units(case.kind.units):
        assert (axis_label("preload"), axis_label("drag")) == ("preload (kN)", "drag (N)")
    assert axis_label("preload") == "preload (-)"


def test_suggested_conditions_have_an_interpolated_simulation(tmp_path):
    case = read_case(written(tmp_path))
    columns = [c for c in case.kind.columns if c.name in case.recordings]
    wanted = candidates.inside(case, case.recordings, columns, {c.name for c in columns})
    simulated = Forward(case, wanted).base_prediction()
    names = np.array([str(g) == "A" for g in wanted["grease"]])
    exact = 2.0 + 3.0 * wanted["preload"] + 0.02 * wanted["oil_temperature_C"] * names
    inside = (wanted["preload"] >= 1.0) & (wanted["preload"] <= 5.0)
    assert np.max(np.abs(simulated / exact - 1.0)[inside]) < 0.03
    assert set(raw_coordinates(Forward(case, wanted))) >= {"preload", "oil_temperature_C"}


def test_simulate_writes_the_simulation(tmp_path):
    case = read_case(written(tmp_path))
    found = simulate(case)
    assert found["drag"].to_numpy() == pytest.approx(case.recordings["simulated"])


@pytest.mark.parametrize(
    ("change", "system", "message"),
    [
        (lambda f: f.assign(simulated=f["simulated"].astype(object).where(f["run"] != 4, "")), {}, "line 5, simulated"),
        (lambda f: f.rename(columns={"simulated": "simulated_kN"}), {}, "'simulated' is missing; the file has 'sim"),
        (lambda f: f.assign(simulated=3.0), {}, "all simulated readings are the same number"),
        (lambda f: f.rename(columns={"simulated_stiffness": "simulated_stifness"}), {}, "nearest known: 'stiffness'"),
        (lambda f: f, {'unit = "kN"': ""}, 'numbers need a unit: [conditions.preload] unit = "..."'),
        (lambda f: f, {"[conditions.grease]": "[conditions.predicted]"}, "another column of the tables or results"),
        (lambda f: f, {"[conditions.grease]": "[conditions.simulated_x]"}, "another column of the tables or results"),
        (lambda f: f, {"[conditions.grease]": "[conditions.load_N]\nunit='kN'"}, "ends in another unit, N"),
        (lambda f: f, {"sd = 0.2, ": ""}, "stiffness must be a relative standard deviation"),
        (lambda f: f, {"viscosity = 0.1": "viscosity = -0.1"}, "viscosity must be a relative standard deviation"),
        (lambda f: f, {'unit = "kN"': 'units = "kN"'}, "nearest known: 'unit'"),
        (lambda f: f, OF_FILMS, "has columns of its own"),
    ],
)
def test_bad_tables_are_refused(tmp_path, change, system, message):
    text = SYSTEM
    for old, new in system.items():
        text = text.replace(old, new)
    with pytest.raises(InputError) as refused:
        read_case(written(tmp_path, change(recording()), text))
    assert message in str(refused.value)


def test_an_input_without_its_column_counts_as_known(tmp_path):
    case = read_case(written(tmp_path, recording().drop(columns="simulated_viscosity")))
    assert "simulation_derivative_missing" in [note.code for note in case.notes]
    assert [c.name for c in Forward(case, case.recordings).calibrations] == ["stiffness"]


def test_columns_without_a_section_are_told(tmp_path):
    case = read_case(written(tmp_path, recording().assign(humidity=1.0)))
    (told,) = [note for note in case.notes if note.code == "condition_undeclared"]
    assert "humidity" in told.text


def test_conditions_need_the_columns_of_the_recordings(tmp_path):
    folder = written(tmp_path)
    wanted = recording().drop(columns=["drag", "simulated_stiffness"]).assign(run=lambda f: f["run"] + 100)
    wanted.to_csv(folder / "conditions.csv", index=False)
    with pytest.raises(InputError, match="'simulated_stiffness' is missing, which the recordings have"):
        read_case(folder)


def test_a_shifted_zero_is_named_and_predicted(tmp_path, capsys):
    frame = recording()
    frame["drag"] += 1.5
    wanted = frame[:3].drop(columns="drag").assign(run=[101, 102, 103])
    folder = written(tmp_path, frame)
    wanted.to_csv(folder / "conditions.csv", index=False)
    assert main(["diagnose", str(folder), "--out", str(tmp_path / "out")]) == 0
    answer = json.loads((tmp_path / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    assert answer["verdict"] == ["sensor_offset"]
    predicted = pd.read_csv(tmp_path / "out" / "predictions.csv").set_index("run").loc[[101, 102, 103], "predicted"]
    assert predicted.to_numpy() == pytest.approx(wanted["simulated"] + 1.5, rel=0.02)
    assert "kN" in (tmp_path / "out" / "report.txt").read_text(encoding="utf-8")
    assert main(["simulate", str(tmp_path / "out" / "improved"), "--out", str(tmp_path / "sim")]) == 0
    capsys.readouterr()


@pytest.mark.parametrize("index", [2, pytest.param(14, marks=pytest.mark.long)])
def test_the_same_numbers_as_a_table_get_the_same_verdict(tmp_path, index):
    native, effects = deal(index, 11, tmp_path / "native")
    one = compared(native, tmp_path / "tables", effects)
    assert one.table == one.expected == (effects or ("none",))


@pytest.mark.long
def test_most_cases_have_the_verdict_of_the_package(tmp_path):
    found = [compared(*_dealt(index, tmp_path)) for index in range(2 * len(ORDERS))]
    assert np.mean([one.same for one in found]) >= 0.8


def _dealt(index, folder):
    native, effects = deal(index, 11, folder / "native")
    return native, folder / "tables", effects
