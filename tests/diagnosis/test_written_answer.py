"""What is written: the schema field by field, equal bytes for equal cases, nothing half overwritten."""

from __future__ import annotations

import json
import os
import re
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.api.diagnosis import Answer
from mixedlub.chain.effect import STAGES
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.report.files import WRITTEN, case_origin, diagnose, write
from mixedlub.diagnosis.report.text.answer import as_json, predictions
from mixedlub.effects import catalogue
from mixedlub.schema.toml_file import read_toml


def number(value: Any) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool) and value == value and abs(value) < 1e300


def probability(value: Any) -> bool:
    return number(value) and 0.0 < value < 1.0


@pytest.fixture(params=["complete", "offset", "unnamed", "teeth"])
def answer(request: pytest.FixtureRequest) -> tuple[Diagnosis, dict[str, Any]]:
    """A diagnosis and its JSON."""
    d = request.getfixturevalue(request.param)
    return d, json.loads(json.dumps(as_json(d)))


def test_schema_and_case_are_named(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    d, said = answer
    assert said["schema"] == "mixedlub-diagnosis/1"
    assert said["case"] == d.case.folder.name


def test_mismatch_field(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    d, said = answer
    field = said["mismatch"]
    assert set(field) == {"detected", "p_value", "level", "chi2_before", "rows"}
    assert isinstance(field["detected"], bool)
    assert 0.0 <= field["p_value"] <= 1.0
    assert field["detected"] == (field["p_value"] <= field["level"])
    assert number(field["chi2_before"])
    assert field["chi2_before"] >= 0
    assert field["rows"] == d.search.problem.y.size


def test_verdict_and_ties(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    allowed = {*catalogue(), "none", "unknown"}
    assert said["tied"][0] == said["verdict"]
    for explanation in said["tied"]:
        assert set(explanation) <= allowed
        assert len(explanation) == len(set(explanation)) > 0
        assert len(explanation) == 1 or not {"none", "unknown"} & set(explanation)


def test_probabilities_are_never_certain(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    assert {"none", "unknown"} <= set(said["probabilities"]) <= {*catalogue(), "none", "unknown"}
    assert all(probability(p) for p in said["probabilities"].values())


def test_stages(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    assert set(said["stage"]) == set(STAGES)
    assert all(probability(p) for p in said["stage"].values())


def test_location(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    d, said = answer
    place = said["location"]
    assert set(place) == {"rows", "where", "text"}
    assert set(place["rows"]) == {str(int(run)) for run in d.recorded.table["run"]}
    assert all(number(z) for z in place["rows"].values())
    assert place["text"]
    for cut in place["where"]:
        assert cut["column"] in d.recorded.table
        assert set(cut) in ({"column", "low", "high"}, {"column", "values"})
    if said["verdict"] == ["none"]:
        assert set(place["rows"].values()) == {0.0}


def test_effects(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    named = [] if said["verdict"] in (["none"], ["unknown"]) else said["verdict"]
    assert [e["id"] for e in said["effects"]] == named
    for e in said["effects"]:
        assert set(e) == {"id", "parameters", "source", "equation"}
        assert e["source"]
        assert e["equation"]
        assert [p["name"] for p in e["parameters"]] == [p.name for p in catalogue()[e["id"]].parameters]
        for p in e["parameters"]:
            whole = p.get("absolute")
            assert set(p) - {"absolute"} == {"name", "unit", "value", "low90", "high90"}
            assert p["low90"] <= p["value"] <= p["high90"]
            if whole is not None and p["value"]:
                size = whole["value"] / p["value"]
                assert whole["low90"] == pytest.approx(size * p["low90"])
                assert whole["high90"] == pytest.approx(size * p["high90"])


def test_calibration(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    assert {name for name in said["calibration"] if "." not in name} == {
        "boundary_friction",
        "viscosity",
        "pressure_viscosity",
        "eyring_stress",
        "roughness",
    }
    for c in said["calibration"].values():
        assert set(c) == {"value", "low90", "high90"}
        assert c["low90"] < c["value"] < c["high90"]


def test_fit(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    _, said = answer
    fit = said["fit"]
    assert set(fit) == {"noise_rms", "heldout_before", "heldout_after", "split", "folds"}
    assert all(number(fit[k]) and fit[k] > 0 for k in ("noise_rms", "heldout_before", "heldout_after"))
    assert isinstance(fit["folds"], int)
    assert fit["folds"] >= 2
    assert fit["split"].startswith("leave ")


def test_outliers_next_tests_and_warnings(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    d, said = answer
    runs = {int(run) for run in d.recorded.table["run"]}
    assert set(said["outlier_runs"]) <= runs
    names = {c.name for c in d.case.kind.columns}
    for test in said["next_tests"]:
        assert set(test) == {"conditions", "separates", "expected_bits", "text", "readings"}
        assert set(test["conditions"]) <= names
        assert test["expected_bits"] >= 0
        assert all(isinstance(s, str) for s in test["separates"])
    assert all(isinstance(w, str) for w in said["warnings"])
    assert all(set(found) == {"code", "severity", "place", "text"} for found in said["findings"])
    assert len(said["findings"]) == len(said["warnings"])


def test_written_answer_is_the_answer(offset: Diagnosis, offset_files: dict[str, str]) -> None:
    assert json.loads(offset_files["diagnosis.json"]) == json.loads(json.dumps(as_json(offset)))


def test_unnamed_mismatch_carries_its_description(unnamed_files: dict[str, str]) -> None:
    said = json.loads(unnamed_files["diagnosis.json"])["unknown"]
    assert said["stages"][0]["quantity"]
    assert said["empirical_form"] is None


def test_predictions_have_a_row_a_run(answer: tuple[Diagnosis, dict[str, Any]]) -> None:
    d, _ = answer
    rows = predictions(d)
    assert list(rows)[:7] == ["run", "base", "calibrated", "predicted", "low90", "high90", "mismatch_z"]
    recorded = d.recorded.table[d.case.quantity]
    assert rows[f"recorded_{d.case.quantity}"].tolist() == recorded.tolist()
    assert all(rows[c.name].tolist() == d.recorded.table[c.name].tolist() for c in d.case.kind.columns if c.required)
    assert rows["run"].tolist() == d.recorded.table["run"].tolist()
    assert ((rows["low90"] < rows["predicted"]) & (rows["predicted"] < rows["high90"])).all()


def test_the_same_case_twice_gives_the_same_bytes(
    offset_folder: Path, offset_files: dict[str, str], excluded: tuple[str, ...], tmp_path: Path
) -> None:
    diagnose(offset_folder, tmp_path, exclude=excluded)
    written = {p.relative_to(tmp_path).as_posix(): p.read_bytes() for p in tmp_path.rglob("*.*")}
    assert json.loads(written.pop("origin.json"))["source"] == Path(os.path.relpath(offset_folder, tmp_path)).as_posix()
    assert written == {name: text.encode() for name, text in offset_files.items()}
    assert set(written) >= {"diagnosis.json", "predictions.csv", "report.txt", "report.html"}


def test_an_answer_from_python_leaves_the_record_of_the_command(
    offset: Diagnosis,
    offset_folder: Path,
    offset_files: dict[str, str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("mixedlub.api.diagnosis.files", lambda d: offset_files)
    Answer(offset).write(tmp_path / "python")
    assert case_origin(offset_folder).check_folder(tmp_path / "python", WRITTEN, "case") == ""
    write(offset_files, tmp_path / "command", case_origin(offset_folder))
    assert (tmp_path / "python" / "origin.json").read_bytes() == (tmp_path / "command" / "origin.json").read_bytes()


def test_the_answer_to_tables_in_memory_names_no_case(
    offset: Diagnosis, offset_files: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mixedlub.api.diagnosis.files", lambda d: offset_files)
    recordings = replace(offset.given.recordings, source="recordings")
    Answer(replace(offset, given=replace(offset.given, recordings=recordings))).write(tmp_path)
    assert not (tmp_path / "origin.json").exists()


def test_the_system_as_used_stands_beside_any_answer(unnamed: Diagnosis, unnamed_files: dict[str, str]) -> None:
    given = read_toml(unnamed.given.folder / "system.toml")
    assert tomllib.loads(unnamed_files["case/system.toml"]) == given


def test_files_carry_no_date_and_no_path(offset: Diagnosis, offset_files: dict[str, str]) -> None:
    for text in offset_files.values():
        assert not re.search(r"\b20\d\d-\d\d-\d\d\b", text)
        assert str(offset.case.folder.parent) not in text


def test_wanted_conditions_are_predicted(offset_folder: Path, excluded: tuple[str, ...], tmp_path: Path) -> None:
    wanted = tmp_path / "wanted.csv"
    header = "run,sequence,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface\n"
    wanted.write_text(header + "901,1,75,1200,70,ground,ground\n", encoding="utf-8")
    d = diagnose_case(offset_folder, predict=wanted, exclude=[*excluded, "churning", "sensor_gain"])
    last = predictions(d).iloc[-1]
    assert last["run"] == 901
    assert np.isnan(last["recorded_power_loss_W"])


def test_a_failed_write_leaves_the_old_answer(tmp_path: Path) -> None:
    write({"a.txt": "old", "b.txt": "old"}, tmp_path)
    with pytest.raises(UnicodeEncodeError):
        write({"a.txt": "new", "b.txt": "\ud800"}, tmp_path)
    assert {p.name: p.read_text() for p in tmp_path.iterdir()} == {"a.txt": "old", "b.txt": "old"}


def test_drawings_of_an_earlier_answer_go(tmp_path: Path) -> None:
    drawn = "<dc:title>mixedlub</dc:title>"
    write({"figures/old.svg": drawn, "figures/kept.svg": drawn}, tmp_path)
    write({"figures/kept.svg": "y"}, tmp_path)
    assert [p.name for p in (tmp_path / "figures").iterdir()] == ["kept.svg"]
    assert (tmp_path / "figures" / "kept.svg").read_text() == "y"


def test_files_of_the_user_among_the_drawings_stay(tmp_path: Path) -> None:
    drawn = "<dc:title>mixedlub</dc:title>"
    write({"figures/evidence.svg": drawn}, tmp_path)
    own = {"notes.txt": "mine", "photo.svg": "<svg/>", "evidence_marked.svg": f"<svg xmlns:inkscape=''>{drawn}"}
    for name, text in own.items():
        (tmp_path / "figures" / name).write_text(text, encoding="utf-8")
    (tmp_path / "figures" / "talk").mkdir()
    (tmp_path / "figures" / "talk" / "slide.svg").write_text("x", encoding="utf-8")
    write({"figures/evidence.svg": "new"}, tmp_path)
    for name, text in {**own, "evidence.svg": "new", "talk/slide.svg": "x"}.items():
        assert (tmp_path / "figures" / name).read_text(encoding="utf-8") == text
    assert sorted(p.name for p in tmp_path.iterdir()) == ["figures"]


def test_conditions_hidden_by_the_run_of_a_reading_are_named(
    make_case: Callable[..., Path], tmp_path: Path, excluded: tuple[str, ...]
) -> None:
    folder = make_case(tmp_path / "case", "disc")
    lines = (folder / "recordings.csv").read_text(encoding="utf-8").splitlines()
    head, same, other = (line.rsplit(",", 1)[0] for line in (lines[0], lines[1], lines[2]))
    other = other.replace("1500.0", "2000.0")
    (folder / "conditions.csv").write_text("\n".join([head, same, other]) + "\n", encoding="utf-8")
    (warned,) = [note for note in diagnose_case(folder, exclude=excluded).warnings if note.code == "run_number_reused"]
    assert warned.text.endswith(": 2")


def test_a_part_rig_that_no_chain_models_is_named(
    make_case: Callable[..., Path], tmp_path: Path, excluded: tuple[str, ...]
) -> None:
    folder = make_case(tmp_path / "case", "gear_pair")
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    rigs = ["rig", *("motor_only" if i < 5 else "whole" for i in range(len(lines) - 1))]
    path.write_text("\n".join(f"{a},{b}" for a, b in zip(lines, rigs, strict=True)) + "\n", encoding="utf-8")
    warned = diagnose_case(folder, exclude=excluded).warnings
    assert any(note.code == "part_rigs_not_modelled" and "motor_only, whole" in note.text for note in warned)
