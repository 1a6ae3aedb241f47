"""Delivery of results: whose files are replaced, formats, failing figures, paths."""

import os
from pathlib import Path

import openpyxl
import pyarrow.parquet as pq
import pytest

from mixedlub.cli import main
from mixedlub.commands import console
from mixedlub.efficiency.table import TABLES as OF_EFFICIENCY
from mixedlub.ehl.table import TABLES as OF_EHL
from mixedlub.evaluate import EVALUATIONS
from mixedlub.gear.analysis.table import TABLES as OF_GEAR
from mixedlub.solutions.result_columns import CONDENSED, LAW_ERRORS
from mixedlub.study.friction_comparison import TABLES as OF_FRICTION

GEARS = """schema = "mixedlub-gear/1"
[gears]
teeth = [17, 26]
normal_module_mm = 4.0
face_width_mm = 14.0
load_sharing = { model = "rigid" }
[load]
torque_Nm = [50, 150]
[mesh]
positions = 8
"""
STUDY = """schema = "mixedlub-study/1"
gears = { teeth = [17, 26], normal_module_mm = 4.0, face_width_mm = 14.0 }
surfaces = { "=1+1" = { m0_um2 = 0.137, m2 = 0.0031, m4_per_um2 = 0.0021 } }
conditions = { torque_Nm = [50.5, 150], speed_rpm = [1500], oil_temperature_C = [60] }
"""
TEMPLATES = {
    "gear": ("gear", "gear.toml", "summary.csv"),
    "bevel": ("bevel", "bevel.toml", "map.csv"),
    "worm": ("worm", "worm.toml", "map.csv"),
    "efficiency": ("efficiency", "efficiency.toml", "map.csv"),
    "ehl": ("ehl", "contacts.toml", "contacts.csv"),
    "study": ("study", "study.toml", "results.csv"),
    "factors": ("factors", "factors.toml", "indices.csv"),
    "simulate": ("case", "", "simulation.csv"),
    "diagnose": ("case", "", "predictions.csv"),
}
"""Template, its file and a table of each command that reads a file."""
OTHERS = {
    ("condense", "atf"): "terms.csv",
    ("law-errors",): "laws.csv",
    ("profile", "shipped:0258"): "profile.json",
}


@pytest.fixture
def gears(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("gear.toml").write_text(GEARS, encoding="utf-8")
    return Path("gear.toml")


def is_refused(words, table, capsys):
    """Whether a command leaves a file made by hand as it is."""
    Path("o").mkdir()
    (Path("o") / table).write_text("mine", encoding="utf-8")
    assert main([*words, "--out", "o"]) == 2
    assert f"holds {table}" in capsys.readouterr().err
    return (Path("o") / table).read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("command", TEMPLATES)
def test_a_file_made_by_hand_is_not_replaced(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    template, file, table = TEMPLATES[command]
    assert main(["new", template, "--out", "given"]) == 0
    assert is_refused([command, str(Path("given") / file)], table, capsys)


@pytest.mark.parametrize("words", OTHERS)
def test_a_file_made_by_hand_is_not_replaced_without_an_input_file(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert is_refused(words, OTHERS[words], capsys)


def test_a_comparison_of_laws_replaces_no_file_made_by_hand(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(STUDY, encoding="utf-8")
    assert is_refused(["friction-laws", "--study", "s.toml"], "mesh.csv", capsys)


@pytest.mark.parametrize("method", sorted(EVALUATIONS))
def test_an_evaluation_replaces_no_file_made_by_hand(method, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", method, "--out", "given"]) == 0
    table = f"{next(iter(EVALUATIONS[method].results))}.csv"
    assert is_refused(["evaluate", method, f"given/{method}.toml"], table, capsys)


def test_an_evaluation_with_a_case_runs_again(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "calorimetric", "--out", "."]) == 0
    command = ["evaluate", "calorimetric", "calorimetric.toml", "--out", "o", "--no-figures"]
    assert [main(command), main(command)] == [0, 0]
    Path("o/case/system.toml").write_text("mine", encoding="utf-8")
    assert main(command) == 2
    assert "case/system.toml" in capsys.readouterr().err


def test_a_result_is_replaced_by_its_own_input_alone(gears, capsys):
    assert main(["gear", str(gears), "--out", "o", "--no-figures"]) == 0
    assert main(["gear", str(gears), "--out", "o", "--no-figures"]) == 0
    Path("other.toml").write_text(GEARS.replace("[50, 150]", "[60]"), encoding="utf-8")
    assert main(["gear", "other.toml", "--out", "o", "--no-figures"]) == 2
    assert main(["gear", "other.toml", "--out", "o", "--no-figures", "--replace"]) == 0


def test_figures_that_fail_leave_the_tables_and_the_other_figures(gears, capsys, monkeypatch):
    def broken(*arguments):
        raise MemoryError

    monkeypatch.setattr("mixedlub.report.gear.pattern_figure", broken)
    assert main(["gear", str(gears), "--out", "o"]) == 1
    (said,) = (line for line in capsys.readouterr().err.splitlines() if line.startswith("mixedlub:"))
    assert "contact_pattern" in said
    assert "unexpected" not in said
    assert Path("o/summary.csv").exists()
    assert {path.name for path in Path("o/figures").iterdir()} == {"load_distribution.svg", "loss_factors.svg"}


def without_meaning(folder):
    """Columns of the tables in a folder that have no meaning."""
    schemas = [pq.read_schema(path) for path in sorted(Path(folder).glob("*.parquet"))]
    return [name for schema in schemas for name in schema.names if not schema.field(name).metadata[b"meaning"]]


@pytest.mark.parametrize("method", sorted(EVALUATIONS))
def test_every_column_of_an_evaluation_has_a_meaning(method, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", method, "--out", "given"]) == 0
    assert main(["evaluate", method, f"given/{method}.toml", "--out", "o", "--no-figures"]) == 0
    assert without_meaning("o") == []


def test_every_column_of_a_table_has_a_meaning(gears):
    assert main(["gear", str(gears), "--out", "o", "--no-figures"]) == 0
    assert without_meaning("o") == []
    assert pq.read_schema("o/summary.parquet").field("torque_Nm").metadata[b"unit"] == b"N m"


@pytest.mark.parametrize("tables", [OF_GEAR, OF_EFFICIENCY, OF_EHL, OF_FRICTION, CONDENSED, LAW_ERRORS])
def test_declared_columns_have_meanings(tables):
    assert all(column.meaning for columns in tables.values() for column in columns)


def test_a_workbook_has_a_sheet_a_table_with_units_and_frozen_rows(gears):
    assert main(["gear", str(gears), "--out", "o", "--no-figures", "--xlsx"]) == 0
    book = openpyxl.load_workbook("o/results.xlsx")
    sheet = book["summary"]
    assert (sheet["A1"].value, sheet["A2"].value, sheet["A3"].value) == ("torque_Nm", "N m", 50)
    assert sheet.freeze_panes == "A3"
    assert {path.stem for path in Path("o").glob("*.csv")} | {"columns"} == set(book.sheetnames)
    meanings = {(row[0], row[1]): row[3] for row in book["columns"].iter_rows(min_row=2, values_only=True)}
    assert meanings["summary", "torque_Nm"] == "torque on the pinion"
    assert main(["gear", str(gears), "--out", "o", "--no-figures"]) == 0
    assert not Path("o/results.xlsx").exists()


@pytest.mark.parametrize("options", [(), ("--csv-style", "german")])
def test_names_that_begin_a_formula_are_escaped(options, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(STUDY, encoding="utf-8")
    assert main(["study", "s.toml", "--out", "o", "--no-figures", "--xlsx", *options]) == 0
    text = Path("o/results.csv").read_text(encoding="utf-8")
    assert "'=1+1" in text
    assert not any(
        cell.strip('"').startswith("=") for row in text.splitlines() for cell in row.replace(";", ",").split(",")
    )
    cell = openpyxl.load_workbook("o/results.xlsx")["results"]["A3"]
    assert (cell.value, cell.data_type) == ("'=1+1", "s")
    assert pq.read_table("o/results.parquet")["pinion_surface"].to_pylist() == ["=1+1"] * 2


def test_a_german_table_has_semicolons_and_decimal_commas(gears, tmp_path):
    assert main(["gear", str(gears), "--out", "o", "--no-figures", "--csv-style", "german"]) == 0
    head, first, *_ = Path("o/load_share.csv").read_text(encoding="utf-8").splitlines()
    assert head == "torque_Nm;roll_angle_deg;load_share"
    assert "." not in first
    assert first.startswith("50;")
    Path("s.toml").write_text(STUDY.replace("=1+1", "fine"), encoding="utf-8")
    assert main(["study", "s.toml", "--out", "t", "--no-figures", "--csv-style", "german"]) == 0
    assert Path("t/results.csv").read_text(encoding="utf-8").splitlines()[1].startswith("fine;fine;50,5;1500;60;")
    assert main(["gear", str(gears), "--out", "u", "--csv-style", "germn"]) == 2


def test_a_rerun_in_another_style_says_what_it_replaces(gears, capsys):
    again = ["gear", str(gears), "--out", "o", "--no-figures"]
    assert main([*again, "--xlsx", "--csv-style", "german"]) == 0
    assert "earlier run" not in capsys.readouterr().err
    assert main(again) == 0
    said = capsys.readouterr().err
    assert said.count("--csv-style german keeps it") == 1
    assert said.count("--xlsx writes it anew") == 1
    assert main(again) == 0
    assert "earlier run" not in capsys.readouterr().err
    assert main([*again, "--csv-style", "german"]) == 0
    assert "--csv-style plain keeps it" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("--out", "~/results"), ("--out=~/results",)])
def test_the_home_folder_is_meant_by_its_sign(words, gears, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert main(["gear", str(gears), "--no-figures", *words]) == 0
    assert (tmp_path / "home" / "results" / "summary.csv").exists()
    assert not Path("~").exists()


@pytest.mark.parametrize("command", ["gear", "study", "ehl", "efficiency", "factors", "profile", "simulate"])
def test_a_path_that_is_too_long_is_bad_input(command, gears, capsys):
    long = "x" * 300
    assert main([command, long]) == 2
    assert "unexpected" not in capsys.readouterr().err
    assert main(["gear", str(gears), "--out", long]) == 2
    assert "unexpected" not in capsys.readouterr().err


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="permissions bind no administrator")
def test_a_study_in_an_unreadable_folder_is_bad_input(tmp_path, capsys):
    folder = tmp_path / "closed"
    folder.mkdir()
    (folder / "s.toml").write_text(STUDY, encoding="utf-8")
    folder.chmod(0)
    try:
        assert main(["study", str(folder / "s.toml"), "--out", str(tmp_path / "o")]) == 2
    finally:
        folder.chmod(0o700)
    assert "unexpected" not in capsys.readouterr().err


def test_an_unreadable_file_is_bad_input(gears, monkeypatch, capsys):
    def closed(*arguments):
        raise PermissionError(13, "Permission denied", "gear.toml")

    monkeypatch.setattr("mixedlub.gear.analysis.file.read_problem", closed)
    assert main(["gear", str(gears)]) == 2
    assert "cannot be used (Permission denied)" in capsys.readouterr().err


def test_progress_without_a_terminal_is_a_line_now_and_then(monkeypatch, capsys):
    clock = iter((0.0, 1.0, 30.0, 30.0, 40.0))
    monkeypatch.setattr(console.time, "monotonic", lambda: next(clock))
    tell = console.now_and_then()
    for text in ("first", "second", "third"):
        tell(text)
    assert capsys.readouterr().err == "second\n"
