"""The improved model: a case that runs and gives the verdict's fit, elsewhere and at other conditions."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
import profiles
from mixedlub.api.diagnosis import Answer
from mixedlub.case.files import case_files
from mixedlub.case.folder import Case, conditions_for, read_case
from mixedlub.case.forward import Forward
from mixedlub.case.missing_part import ADDITION, SHARE, MissingPart
from mixedlub.case.missing_part import OUTSIDE as MISSING_PART
from mixedlub.case.simulation import simulate
from mixedlub.cli import main
from mixedlub.commands.new import case_files as template
from mixedlub.diagnosis.assessment.prediction import NewRows
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case, diagnosis_of
from mixedlub.diagnosis.report.files import write
from mixedlub.diagnosis.report.improved import improved_files, most_probable
from mixedlub.diagnosis.report.text.answer import as_json, verdict_fit
from mixedlub.kinds import KINDS
from mixedlub.schema.findings import codes, collected
from mixedlub.schema.table import Table
from profiles.errors import InputError

TRACE = Path(profiles.__file__).parent / "traces" / "0258.txt"


def written(contents: dict[str, str | bytes], folder: Path) -> Path:
    """A folder with these files."""
    folder.mkdir()
    write(contents, folder)
    return folder


def renumbered(table: Table, rows: slice) -> Table:
    """Some rows of a table under run numbers of their own, without the place in the test programme."""
    part = {name: values[rows] for name, values in table.columns.items() if name != "sequence"}
    return Table({**part, "run": part["run"] + 10_000}, "conditions.csv")


def readings(case: Case, at: Table | None = None) -> np.ndarray:
    """What the case simulates, whatever it reports."""
    with collected():
        return simulate(case, at)[case.quantity].to_numpy()


def fit(d: Diagnosis, table: Table) -> np.ndarray:
    """Readings of the verdict at its most probable parameters, at the end of the test programme where it has one."""
    at_end = {"sequence": np.ones(len(table))} if "sequence" in d.search.problem.rows else {}
    problem = NewRows(d.search, Table({**at_end, **table.columns})).problem
    return problem.inverse(problem.predict(d.posterior.verdict, most_probable(d)))


@pytest.fixture(scope="module")
def stribeck() -> Diagnosis:
    """A drive with mixed friction at low speeds."""
    speed = np.array([10.0, 20, 50, 100, 200, 300, 400, 500] * 4)
    torque = (0.5 + 2e-3 * speed + 0.6 * np.exp(-speed / 40)) * (1 + 0.01 * np.cos(7.0 * np.arange(32)))
    rows = pd.DataFrame({"speed_rpm": speed, "friction_torque_Nm": torque})
    drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
    return diagnosis_of(ml.case.case_of(drive, rows))


@pytest.fixture(params=["complete", "offset", "thickening", "stribeck"])
def named(request: pytest.FixtureRequest) -> Diagnosis:
    """The answer of discs, a gear pair, a viscometer or a drive: nothing missing, or an effect with a name."""
    d: Diagnosis = request.getfixturevalue(request.param)
    assert not d.posterior.verdict.is_discrepancy
    return d


def test_the_improved_case_simulates_the_fit(named: Diagnosis, tmp_path: Path) -> None:
    case = read_case(written(case_files(Answer(named).improved), tmp_path / "improved"))
    assert case.conditions is None
    assert readings(case) == pytest.approx(fit(named, named.search.problem.rows), rel=1e-9)


def test_the_improved_case_simulates_the_fit_at_other_conditions(named: Diagnosis) -> None:
    at = renumbered(named.search.problem.rows, slice(1, 8, 3))
    case = Answer(named).improved
    assert readings(case, at) == pytest.approx(fit(named, at), rel=1e-9)


def test_where_nothing_is_missing_the_fit_is_the_prediction(complete: Diagnosis) -> None:
    case = Answer(complete).improved
    assert not case.system.effects
    assert readings(case) == pytest.approx(complete.recorded.predicted, rel=1e-9)


def test_parameters_are_those_of_the_answer_but_for_an_error_of_form(named: Diagnosis) -> None:
    system, said = Answer(named).improved.system, as_json(named)
    there = {f"{e}.{name}": value for e, own in system.effects.items() for name, value in own.items()}
    answer = {f"{e['id']}.{p['name']}": p["value"] for e in said["effects"] for p in e["parameters"]}
    assert there.keys() == answer.keys()
    if not verdict_fit(named).bend:
        assert there == pytest.approx(answer)
        assert dict(system.calibration) == pytest.approx({n: c["value"] for n, c in said["calibration"].items()})


def test_the_improved_case_follows_the_readings(named: Diagnosis) -> None:
    problem, kept = named.search.problem, named.counted
    residual = (problem.y - problem.transform(readings(Answer(named).improved))) / problem.sd
    assert np.sqrt(np.mean(residual[kept] ** 2)) < 1.5


def test_a_mismatch_without_law_is_a_table(lawless_teeth: Diagnosis, tmp_path: Path) -> None:
    assert lawless_teeth.posterior.verdict.is_discrepancy
    assert lawless_teeth.heldout.after < lawless_teeth.heldout.before
    case = read_case(written(case_files(Answer(lawless_teeth).improved), tmp_path / "improved"))
    off = (readings(case) - lawless_teeth.recorded.predicted) / lawless_teeth.recorded.sd
    assert np.max(np.abs(off)) < 0.01
    assert lawless_teeth.tabulated.largest_error < 0.01
    assert case.missing is not None
    assert (case.missing.table["missing_sd"] > 0.0).all()


def test_outside_its_table_a_row_says_so_and_keeps_the_end(lawless_teeth: Diagnosis) -> None:
    case = Answer(lawless_teeth).improved
    rows = lawless_teeth.search.problem.rows
    one = {n: v[:1] for n, v in rows.columns.items() if n not in ("run", lawless_teeth.case.quantity)}
    at = {n: np.repeat(v, 4) for n, v in one.items()} | {"roll_angle_deg": np.array([16.0, 15.0, 14.0, 10.0])}
    with collected() as said:
        found = simulate(case, conditions_for(case, at))
    outside = [MISSING_PART in text for text in found["validity"]]
    assert outside == [False, True, True, True]
    assert [text.startswith("not_quantitative") for text in found["validity"][:1]] == [True]  # of the base model
    assert MISSING_PART in codes(said)
    with collected():
        plain = simulate(replace(case, missing=None), conditions_for(case, at))
    added = (found[case.quantity] - plain[case.quantity]).to_numpy()
    assert case.missing is not None
    if not case.missing.is_share:
        assert added[1:] == pytest.approx(added[0], rel=1e-9)


def test_surfaces_outside_the_table_have_the_base_model(unnamed: Diagnosis) -> None:
    grid = {"pinion_surface": np.array(["ground"]), "gear_surface": np.array(["ground"]), SHARE: np.array([0.5])}
    case = replace(unnamed.given, missing=MissingPart(Table(grid)))
    base = readings(unnamed.given)
    known = unnamed.given.recordings["pinion_surface"] == "ground"
    assert readings(case)[known] == pytest.approx(1.5 * base[known], rel=1e-12)
    assert readings(case)[~known] == pytest.approx(base[~known], rel=1e-12)


def test_a_table_is_linear_between_its_rows() -> None:
    torque, speed = np.meshgrid([10.0, 20.0, 25.0], [100.0, 400.0, 1000.0], indexing="ij")
    value = 1.0 + 0.2 * torque + np.log(speed) * (0.3 - 0.01 * torque)
    grid = {"speed_rpm": speed.ravel(), ADDITION: value.ravel(), "torque_Nm": torque.ravel()}
    part = MissingPart(Table({n: v[::-1] for n, v in grid.items()})).checked("missing_part.csv")
    rng = np.random.default_rng(5)
    at = {"torque_Nm": rng.uniform(10.0, 25.0, 50), "speed_rpm": rng.uniform(100.0, 1000.0, 50)}
    expected = 1.0 + 0.2 * at["torque_Nm"] + np.log(at["speed_rpm"]) * (0.3 - 0.01 * at["torque_Nm"])
    assert part.at(Table(at)) == pytest.approx(expected, rel=1e-12)


def test_an_answer_worse_than_calibration_on_left_out_levels_is_not_handed_on(unnamed: Diagnosis) -> None:
    assert unnamed.heldout.after > unnamed.heldout.before
    answer = Answer(replace(unnamed, law=None))
    found = answer.predictions
    assert found["predicted"].to_numpy() == pytest.approx(found["calibrated"].to_numpy(), rel=1e-12)
    inside = (unnamed.readings > found["low90"]) & (unnamed.readings < found["high90"])
    assert inside.mean() >= 0.8
    assert np.abs(found["mismatch_z"]).max() > 10.0
    assert readings(answer.improved) == pytest.approx(found["calibrated"].to_numpy(), rel=1e-9)
    assert answer.record["improved"] == {"model": "calibration", "heldout": unnamed.heldout.before}


def test_the_files_of_an_earlier_improved_model_are_removed(
    complete: Diagnosis, lawless_teeth: Diagnosis, tmp_path: Path
) -> None:
    write(improved_files(lawless_teeth), tmp_path)
    (tmp_path / "improved" / "own.csv").write_text("run\n")
    assert (tmp_path / "improved" / "missing_part.csv").exists()
    write(improved_files(complete), tmp_path)
    assert {path.name for path in (tmp_path / "improved").iterdir()} == {"own.csv", "recordings.csv", "system.toml"}


def test_the_table_is_part_of_the_model_that_is_diagnosed(teeth: Diagnosis, excluded: tuple[str, ...]) -> None:
    assert diagnosis_of(Answer(teeth).improved, exclude=excluded).posterior.verdict.ids == ("none",)


WRONG_TABLES = {
    "no values": ("torque_Nm\n100\n", "missing_share"),
    "a combination without row": (
        "torque_Nm,speed_rpm,missing_share\n50,500,0\n50,900,0\n90,500,0\n",
        "4 combinations",
    ),
    "a combination twice": ("torque_Nm,missing_share\n50,0\n50,1\n", "1 combinations"),
    "no conditions": ("missing_reading\n3\n", "combinations"),
}


@pytest.mark.parametrize("wrong", WRONG_TABLES)
def test_a_wrong_table_of_the_missing_part_is_refused(
    make_case: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str], wrong: str
) -> None:
    text, hint = WRONG_TABLES[wrong]
    folder = make_case(tmp_path / "case", "gear_pair")
    (folder / "lacking.csv").write_text(text, encoding="utf-8")
    system = (folder / "system.toml").read_text(encoding="utf-8")
    (folder / "system.toml").write_text('missing_part = "lacking.csv"\n' + system, encoding="utf-8")
    assert main(["simulate", str(folder), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert hint in said
    assert "lacking.csv" in said


def test_the_improved_case_lacks_nothing(offset: Diagnosis, excluded: tuple[str, ...]) -> None:
    d = diagnosis_of(Answer(offset).improved, exclude=excluded)
    assert d.posterior.verdict.ids == ("none",)
    assert "effects_known" in codes(d.warnings)
    assert "sensor_offset" not in d.posterior.inclusion(d.search)


def test_what_the_case_was_made_of_is_said(offset: Diagnosis) -> None:
    said = Answer(offset).improved.system.description
    assert offset.case.name in said
    assert "sensor offset" in said


@pytest.fixture(params=KINDS)
def of_kind(request: pytest.FixtureRequest, tmp_path: Path) -> Case:
    """The template of a kind of recording."""
    return read_case(written(dict(template(request.param)), tmp_path / "case"))


def test_every_effect_of_a_case_acts_as_in_the_search(of_kind: Case, tmp_path: Path) -> None:
    assert of_kind.recordings is not None
    base = Forward(of_kind, of_kind.recordings)
    calibration = {c.name: c.parameter.prior.value(0.5) for c in base.calibrations}
    for e in base.effects():
        own = {name: value for name, value in calibration.items() if not name.startswith(f"{e.id}.")}
        updated = {"effects": {e.id: e.prior_medians}, "calibration": own}
        case = replace(of_kind, system=of_kind.system.model_copy(update=updated))
        there = Forward(case, of_kind.recordings)
        assert there.predict() == pytest.approx(
            base.predict(calibration, {e.id: e.prior_medians}), rel=1e-12, nan_ok=True
        )
        assert e.id not in {other.id for other in there.effects()}
        if e.id == base.effects()[-1].id:
            read = read_case(written(case_files(case), tmp_path / "read"))
            assert read.system == case.system


def test_files_that_the_case_names_are_carried_along(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "first" / "case", "gear_pair")
    for place in (tmp_path / "first", folder):
        shutil.copy(TRACE, place / "trace.txt")
    (tmp_path / "first" / "share.csv").write_text("torque_Nm,roll_angle_deg,load_share\n100,10,1\n100,35,1\n")
    text = (folder / "system.toml").read_text(encoding="utf-8")
    text = text.replace('{ model = "rigid" }', '{ table = "../share.csv" }')
    text += '[surfaces.near]\nprofile = "trace.txt"\n[surfaces.far]\nprofile = "../trace.txt"\n'
    text += '[surfaces.shipped]\nprofile = "shipped:0258"\n'
    (folder / "system.toml").write_text(text, encoding="utf-8")
    before = read_case(folder)
    after = written(case_files(before), tmp_path / "second")
    first = readings(before)
    shutil.rmtree(tmp_path / "first")
    moved = read_case(after)
    assert readings(moved) == pytest.approx(first, rel=1e-15)
    with collected():
        assert moved.rig.surface("far").m0 == moved.rig.surface("near").m0


REFUSED = {
    "no such effect": ("[effects]\nwindge = {}", "windage"),
    "no such parameter": ("[effects]\nwindage = { stength = 1.0 }", "strength"),
    "an effect of another kind": ("[effects]\nfringe_order = {}", "cannot act"),
    "a text": ('[effects]\nwindage = { strength = "much" }', "must be a number"),
    "a negative size": ("[effects]\nwindage = { strength = -1.0 }", "negative"),
    "a negative spread": ("[effects]\nsensor_gain = { gain = 0.1, gain_sd = -1.0 }", "negative"),
    "no such law": ('[effects]\nbearing_drag = { law = "Palmgreen" }', "Palmgren"),
    "a parameter of the law": ('[effects]\nbearing_drag = { law = "Palmgren", rubbing = 1.0 }', "fixes"),
    "an input that is not calibrated": ("[calibration]\nviscosty = 1.1", "viscosity"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_part_of_the_model_is_refused(
    make_case: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str], case: str
) -> None:
    section, hint = REFUSED[case]
    folder = make_case(tmp_path / "case", "gear_pair")
    with (folder / "system.toml").open("a", encoding="utf-8") as file:
        file.write(section + "\n")
    assert main(["simulate", str(folder), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert hint in said
    assert "system.toml" in said


def test_a_parameter_with_a_standard_deviation_is_calibrated(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path: Path
) -> None:
    folder = make_case(tmp_path / "case", "gear_pair", lambda conditions, base: 1.04 * base)
    with (folder / "system.toml").open("a", encoding="utf-8") as file:
        file.write("[effects]\nsensor_gain = { gain = 0.0, gain_sd = 0.05 }\n")
        file.write('bearing_drag = { law = "Palmgren", strength = 0 }\n')
    case = read_case(folder)
    assert case.recordings is not None
    forward = Forward(case, case.recordings)
    assert "sensor_gain.gain" in [c.name for c in forward.calibrations]
    assert forward.predict({"sensor_gain.gain": 0.1}) == pytest.approx(1.1 * forward.predict())
    assert forward.known.values["bearing_drag"]["rubbing"] == 0.0
    d = diagnose_case(folder, exclude=excluded)
    assert d.posterior.verdict.ids == ("none",)
    assert 0.0 < Answer(d).record["calibration"]["sensor_gain.gain"]["value"] < 0.08
    assert readings(Answer(d).improved) == pytest.approx(fit(d, case.recordings), rel=1e-9)


def test_conditions_that_an_effect_needs_are_named(make_case: Callable[..., Path], tmp_path: Path) -> None:
    folder = make_case(tmp_path / "case", "viscosity")
    with (folder / "system.toml").open("a", encoding="utf-8") as file:
        file.write("[effects.zero_drift]\n")
    case = read_case(folder)
    assert case.recordings is not None
    unplaced = {name: values for name, values in case.recordings.columns.items() if name != "sequence"}
    bare = replace(case, recordings=Table(unplaced, "recordings.csv"))
    with pytest.raises(InputError, match="sequence"):
        simulate(bare)
