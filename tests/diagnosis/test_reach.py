"""Predictions beyond the recorded conditions are told, and run numbers that are taken are refused at once."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from mixedlub.case.folder import read_case, read_conditions, refuse_used_runs
from mixedlub.cli import main
from mixedlub.diagnosis.assessment.extrapolation import beyond_recorded
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.schema.findings import Finding

EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
HEAD = "run,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface\n"


def said_of(tmp_path: Path, *rows: str) -> list[Finding]:
    """What is told of conditions to predict for the example, recorded at 50 to 150 N m, 500 to 4000 rpm, 40 and 70."""
    path = tmp_path / "wanted.csv"
    path.write_text(HEAD + "\n".join(rows) + "\n", encoding="utf-8")
    case = read_case(EXAMPLE)
    return beyond_recorded(case, read_conditions(case, path))


def test_every_condition_beyond_is_named_with_its_run(tmp_path: Path) -> None:
    inside, torque, both = (
        "201,100,3000,55,ground,ground",
        "202,1000,3000,55,ground,ground",
        "203,100,50,120,ground,ground",
    )
    (said,) = said_of(tmp_path, inside, torque, both)
    assert (said.code, said.place) == ("prediction_extrapolates", "wanted.csv")
    assert said.text.startswith("2 of 3 conditions")
    assert (
        "run 202: torque_Nm 1000 N m, recorded 50 to 150 N m; run 203: speed_rpm 50 rpm, recorded 500 to 4000 rpm"
        in said.text
    )
    assert "oil_temperature_C 120 °C, recorded 40 to 70 °C" in said.text
    assert "201" not in said.text


def test_what_wanders_about_a_set_point_is_not_beyond(tmp_path: Path) -> None:
    assert said_of(tmp_path, "201,151,4050,39.2,ground,ground") == []


def test_many_runs_are_counted(tmp_path: Path) -> None:
    (said,) = said_of(tmp_path, *(f"{200 + i},1000,3000,55,ground,ground" for i in range(9)))
    assert said.text.endswith("; and 4 more runs)")


def test_a_surface_that_was_never_recorded_is_beyond(tmp_path: Path) -> None:
    case = shutil.copytree(EXAMPLE, tmp_path / "case")
    rows = (case / "recordings.csv").read_text(encoding="utf-8").splitlines()
    kept = [row for row in rows if "polished" not in row]
    (case / "recordings.csv").write_text("\n".join(kept) + "\n", encoding="utf-8")
    found = read_case(case)
    (said,) = beyond_recorded(found, found.conditions)
    assert "pinion_surface polished, never recorded" in said.text


def test_the_answer_and_check_say_it(make_case, tmp_path: Path, excluded: tuple[str, ...], capsys) -> None:
    folder = make_case(tmp_path / "case", "disc")
    head, first = (folder / "recordings.csv").read_text(encoding="utf-8").splitlines()[:2]
    row = first.rsplit(",", 1)[0].replace("1,", "900,", 1).replace("1500.0", "90000.0")
    (folder / "conditions.csv").write_text(f"{head.rsplit(',', 1)[0]}\n{row}\n", encoding="utf-8")
    told = "run 900: load_N 90000 N, recorded 1500 to 6000 N"
    assert sum(told in note.text for note in diagnose_case(folder, exclude=excluded).warnings) == 1
    assert main(["check", str(folder)]) == 0
    assert told in capsys.readouterr().out


def test_a_run_number_that_a_reading_has_is_refused_before_the_work(tmp_path: Path, capsys) -> None:
    wanted = tmp_path / "wanted.csv"
    wanted.write_text(HEAD + "1,100,3000,55,ground,ground\n", encoding="utf-8")
    status = main(["diagnose", str(EXAMPLE), "--predict", str(wanted), "--out", str(tmp_path / "o")])
    assert status == 2
    assert capsys.readouterr().err.endswith(
        f"{wanted}: run: 1: the run number is that of a reading at other conditions; number them from 73 on\n"
    )
    assert not (tmp_path / "o").exists()


@pytest.mark.parametrize("runs", ["73", "900"])
def test_free_run_numbers_are_taken(tmp_path: Path, runs: str) -> None:
    wanted = tmp_path / "wanted.csv"
    wanted.write_text(HEAD + f"{runs},100,3000,55,ground,ground\n", encoding="utf-8")
    case = read_case(EXAMPLE)
    refuse_used_runs(case, read_conditions(case, wanted), wanted)
