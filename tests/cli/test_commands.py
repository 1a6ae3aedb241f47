"""The command line as a user meets it: help, results, exit status."""

import csv
import json
import os
import shlex
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import pytest

from mixedlub.cli import COMMANDS, main
from mixedlub.running.version import installed_version

ROOT = Path(__file__).parents[2]

STUDY = """
schema = "mixedlub-study/1"
title = "Trial"
[gears]
teeth = [17, 26]
normal_module_mm = 4.2333333
pressure_angle_deg = 22.5
face_width_mm = 14.0
[lubricant]
temperature_C = [60.0, 100.0]
kinematic_viscosity_mm2_s = [18.05, 7.2]
pressure_viscosity_per_GPa = [14.8, 13.0]
density_15C_kg_m3 = 850.0
density_change_per_K = 6.5e-4
eyring_stress_MPa = 5.0
thermal_conductivity_W_mK = 0.14
specific_heat_J_kgK = 2000.0
[surfaces]
fine = { m0_um2 = 0.02, m2 = 0.0025, m4_per_um2 = 0.0036 }
coarse = { m0_um2 = 0.3, m2 = 0.003, m4_per_um2 = 0.004 }
[conditions]
torque_Nm = [50, 150]
speed_rpm = [500, 3000]
oil_temperature_C = [60]
"""


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "trial.toml"
    path.write_text(STUDY)
    return path


@pytest.mark.parametrize("command", COMMANDS, ids=lambda module: module.NAME)
def test_help_shows_an_example(command, capsys):
    assert main([command.NAME, "--help"]) == 0
    assert f"mixedlub {command.NAME}" in " ".join(capsys.readouterr().out.split("Example:")[1].split())


def test_version_is_printed(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == f"mixedlub {installed_version()}"


def lines_of(example):
    return [shlex.split(line) for line in example.splitlines()]


LONG = ("condense", "law-errors", "study")
"""Commands whose example takes long, and whose own tests run the same on fewer contacts and figures."""


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(c, marks=pytest.mark.long if c.NAME in LONG else (), id=c.NAME)
        for c in COMMANDS
        if c.NAME not in ("prove", "diagnose", "app")
    ],
)
def test_the_example_of_the_help_runs_in_an_empty_folder(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = lines_of(command.EXAMPLE)
    assert lines[-1][:2] == ["mixedlub", command.NAME]
    for words in lines:
        assert main(words[1:]) == 0


def test_the_example_of_diagnose_makes_the_case_that_it_names(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    first, (*_, case) = lines_of(next(c.EXAMPLE for c in COMMANDS if c.NAME == "diagnose"))
    assert main(first[1:]) == 0
    assert (tmp_path / case / "recordings.csv").is_file()


@pytest.mark.parametrize(
    "words",
    [
        ["effects"],
        ["effects", "inlet_shear_heating"],
        ["kinds"],
        ["kinds", "study"],
        ["profile", "shipped:0258", "--no-figures", "--out", "p"],
        *([c.NAME, "--help"] for c in COMMANDS),
    ],
    ids=" ".join,
)
def test_no_line_is_wider_than_a_terminal(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 80


def test_lines_of_any_command_are_fitted_to_a_terminal(study, monkeypatch, capsys):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["check", str(ROOT / "examples" / "case")]) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 60


def test_one_of_a_thing_is_not_a_plural(study, capsys):
    study.write_text(STUDY.replace("[50, 150]", "[50]").replace("[500, 3000]", "[500]"))
    assert main(["study", str(study), "--no-figures"]) == 0
    assert "3 pairings x 1 torque x 1 speed x 1 oil temperature = 3 conditions" in capsys.readouterr().out


def test_short_trace_is_not_called_not_gaussian(tmp_path, capsys):
    (tmp_path / "few.csv").write_text("x (um),z (um)\n" + "".join(f"{i}.0,{i % 3}.5\n" for i in range(12)))
    assert main(["profile", str(tmp_path / "few.csv"), "--no-figures", "--out", str(tmp_path / "o")]) == 0
    assert "cannot be judged" in capsys.readouterr().out


def test_no_command_prints_the_help(capsys):
    assert main([]) == 0
    bare = capsys.readouterr().out
    assert main(["--help"]) == 0
    assert bare == capsys.readouterr().out


@pytest.mark.parametrize("command", [[], *([c.NAME] for c in COMMANDS)], ids=" ".join)
def test_h_is_short_for_help(command, capsys):
    assert main([*command, "-h"]) == 0
    short = capsys.readouterr().out
    assert main([*command, "--help"]) == 0
    assert short == capsys.readouterr().out


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_commands_and_options_are_completed(shell):
    words = {"bash": ("mixedlub st", "1"), "zsh": ("mixedlub st", ""), "fish": ("mixedlub st", "")}[shell]
    asked = {"_MIXEDLUB_COMPLETE": f"complete_{shell}", "COMP_WORDS": words[0], "COMP_CWORD": words[1]}
    asked |= {"_TYPER_COMPLETE_ARGS": words[0], "_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    run = subprocess.run(
        [sys.executable, "-m", "mixedlub"], capture_output=True, text=True, check=True, env={**os.environ, **asked}
    )
    assert "study" in run.stdout
    assert "diagnose" not in run.stdout


def test_a_title_cannot_command_the_terminal(study, capsys):
    study.write_text(STUDY.replace('"Trial"', r'"\u001b[31mred\u0007"'))
    assert main(["study", str(study), "--no-figures"]) == 0
    out = capsys.readouterr().out
    assert r"\x1b[31mred\x07: 3 pairings" in out
    assert "\x1b" not in out


def test_a_page_keeps_the_letters_of_keys_and_no_title_in_it_commands_a_terminal(study, tmp_path):
    without = STUDY.replace("density_15C_kg_m3 = 850.0\n", "")
    study.write_text(without.replace('"Trial"', r'"\u001b[31mred\u0007"'))
    assert main(["study", str(study), "--out", "o"]) == 0
    page = (tmp_path / "o" / "index.html").read_text(encoding="utf-8")
    assert "lubricant: density_15C_kg_m3" in page
    assert "text-transform" not in page
    written = [path.read_bytes() for path in (tmp_path / "o").rglob("*") if path.suffix in (".html", ".json", ".svg")]
    assert written
    assert not any(b"\x1b" in content or b"\x07" in content for content in written)


@pytest.mark.parametrize("name", ['""', '"a\\nb"', '" a"'])
def test_a_surface_without_a_proper_name_is_refused(name, study, capsys):
    study.write_text(STUDY.replace("fine =", f"{name} ="))
    assert main(["study", str(study), "--no-figures"]) == 2
    assert "is no name: one line of text" in capsys.readouterr().err


def test_misspelt_command_names_the_nearest(capsys):
    assert main(["studdy"]) == 2
    assert "study" in capsys.readouterr().err


def test_misspelt_option_is_bad_input(study, capsys):
    assert main(["study", str(study), "--no-figure"]) == 2
    assert "--no-figures" in capsys.readouterr().err


def test_study_writes_where_it_is_told(study, tmp_path):
    assert main(["study", str(study), "--no-figures", "--out", "here"]) == 0
    assert sorted(p.name for p in (tmp_path / "here").iterdir()) == [
        "fits.csv",
        "fits.parquet",
        "origin.json",
        "ranking.csv",
        "ranking.parquet",
        "resolved.json",
        "results.csv",
        "results.parquet",
        "study.toml",
    ]


def test_study_writes_under_its_name_by_default(study, tmp_path):
    assert main(["study", str(study), "--no-figures"]) == 0
    assert (tmp_path / "out" / "study" / "trial" / "results.csv").is_file()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out", "trial.toml"]


def test_study_again_replaces_its_results_and_keeps_other_files(study, tmp_path):
    main(["study", str(study), "--no-figures", "--out", "here"])
    (tmp_path / "here" / "mine.txt").write_text("kept")
    study.write_text(STUDY.replace("[50, 150]", "[50]"))
    assert main(["study", str(study), "--no-figures", "--out", "here"]) == 0
    with (tmp_path / "here" / "results.csv").open() as file:
        assert len(list(csv.reader(file))) == 1 + 3 * 2
    assert (tmp_path / "here" / "mine.txt").read_text() == "kept"


def test_a_failed_page_leaves_the_tables(study, tmp_path, monkeypatch, capsys):
    def broken(*arguments, **named):
        (arguments[1] / "index.html").write_text("half")
        raise BrokenProcessPool("a child process terminated abruptly")

    monkeypatch.setattr("mixedlub.report.page.write_page", broken)
    assert main(["study", str(study), "--out", "here"]) == 1
    (said,) = (line for line in capsys.readouterr().err.splitlines() if line.startswith("mixedlub:"))
    assert "memory ran out" in said
    assert "unexpected" not in said
    assert {"results.csv", "results.parquet", "study.toml"} <= {p.name for p in (tmp_path / "here").iterdir()}
    assert not (tmp_path / "here" / "index.html").exists()


def test_a_run_that_fails_before_its_tables_leaves_earlier_results_alone(study, tmp_path, monkeypatch):
    main(["study", str(study), "--no-figures", "--out", "here"])
    before = {p.name: p.read_bytes() for p in (tmp_path / "here").iterdir()}
    study.write_text(STUDY.replace("[50, 150]", "[50]"))

    def broken(*arguments, **named):
        raise RuntimeError("no table today")

    monkeypatch.setattr("mixedlub.commands.deliver.write_long", broken)
    assert main(["study", str(study), "--out", "here"]) == 1
    (tmp_path / "here" / "mixedlub-error.log").unlink()
    assert {p.name: p.read_bytes() for p in (tmp_path / "here").iterdir()} == before


def test_unexpected_error_is_one_line_and_names_its_log(study, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("mixedlub.study.run_study", lambda *a, **k: 1 / 0)
    assert main(["study", str(study), "--no-figures", "--out", "here"]) == 1
    said = capsys.readouterr().err.strip().splitlines()[-1]
    assert "ZeroDivisionError" in said
    assert "Traceback" not in said
    log = tmp_path / "here" / "mixedlub-error.log"
    assert str(log.relative_to(tmp_path)) in said
    assert "Traceback" in log.read_text()


def test_unwritable_out_is_bad_input(study, tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["study", str(study), "--no-figures", "--out", "file"]) == 2
    assert "--out" in capsys.readouterr().err


def test_no_scheduler_is_bad_input(study, capsys):
    pytest.importorskip("distributed")
    assert main(["study", str(study), "--no-figures", "--out", "here", "--scheduler", "nonsense://nowhere"]) == 2
    assert "nonsense" in capsys.readouterr().err


def test_progress_and_notes_keep_off_stdout(study):
    run = subprocess.run(
        [sys.executable, "-m", "mixedlub", "study", str(study), "--no-figures"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "caution:" in run.stderr
    assert "caution:" not in run.stdout
    assert run.stdout.count("\n") == 3


def test_warm_import_needs_no_heavy_package():
    heavy = "pandas matplotlib scipy xarray pyarrow skimage distributed"
    code = f"import sys, mixedlub, mixedlub.cli; print([m for m in '{heavy}'.split() if m in sys.modules])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_profile_writes_its_record(tmp_path, monkeypatch, capsys):
    import numpy as np

    monkeypatch.chdir(tmp_path)
    x = np.arange(9000) * 0.5
    z = np.convolve(np.random.default_rng(1).normal(size=9000), np.ones(20) / 20, "same")
    np.savetxt("ground.csv", np.column_stack([x, z]), delimiter=",", header="x (um),z (um)", comments="")
    assert main(["profile", "ground.csv", "--out", "p"]) == 0
    (row,) = json.loads((tmp_path / "p" / "profile.json").read_text())
    assert row["file"] == "ground.csv"
    assert {"Ra_um", "Rq_um", "Rz_um", "Rsk", "Rku"} <= set(row["parameters"])
    wanted = {"m0_um2", "m2", "m4_per_um2", "spacing_um", "short_cutoff_um", "cutoff_mm"}
    assert wanted <= set(row["moments"])
    assert {"density_per_mm2", "radius_um", "sigma_um", "plane_offset_um", "nayak"} <= set(row["asperities"])
    assert row["gaussian"]["verdict"] in ("gaussian", "gaussian_bulk", "plateau", "not_gaussian")
    drawn = {p.name for p in (tmp_path / "p" / "figures").iterdir()}
    assert drawn == {f"ground_{kind}.svg" for kind in ("trace", "probability", "abbott", "spectrum")}
    assert "Ra" in capsys.readouterr().out


@pytest.mark.parametrize("case", [f"case_00{i}" for i in range(8)])
def test_simulate_meets_the_base_values_of_the_practice_cases(case, shared, tmp_path):
    folder = shared / "cases" / case
    assert main(["simulate", str(folder), "--out", str(tmp_path)]) == 0
    rows = json.loads((folder / "truth.json").read_text())["rows"]
    nominal = dict(zip(rows["run"], rows["nominal"], strict=True))
    with (tmp_path / "simulation.csv").open() as file:
        header, *lines = csv.reader(file)
    assert header[0] == "run"
    found = {int(run): float(value) for run, value, *_ in lines}
    assert found.keys() == nominal.keys()
    for run, value in found.items():
        assert value == pytest.approx(nominal[run], rel=5e-4), run


def test_simulate_at_other_conditions(shared, tmp_path):
    folder = shared / "cases" / "case_000"
    at = folder / "conditions.csv"
    assert main(["simulate", str(folder), "--out", str(tmp_path), "--at", str(at)]) == 0
    with (tmp_path / "simulation.csv").open() as file:
        found = [row[0] for row in csv.reader(file)]
    with at.open() as file:
        assert found == [row[0] for row in csv.reader(file)]


def test_conditions_without_run_numbers_are_numbered_after_the_recorded_runs(tmp_path, capsys):
    at = tmp_path / "at.csv"
    at.write_text(
        "torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface\n"
        "50,1000,60,ground,ground\n60,1000,60,ground,ground\n"
    )
    case = ROOT / "examples" / "case"
    assert main(["simulate", str(case), "--out", str(tmp_path / "o"), "--at", str(at)]) == 0
    assert "at.csv: no column run: rows are numbered from 73 to 74" in capsys.readouterr().err
    with (tmp_path / "o" / "simulation.csv").open() as file:
        assert [row[0] for row in csv.reader(file)] == ["run", "73", "74"]
    at.write_text(at.read_text().replace("torque_Nm,", "Run,torque_Nm,").replace("0,1000", "0,7,1000"))
    assert main(["simulate", str(case), "--out", str(tmp_path / "o"), "--at", str(at)]) == 2
    assert "column 'run' is missing; the file has 'Run'" in capsys.readouterr().err


@pytest.mark.parametrize("case", [f"case_00{i}" for i in range(8)])
def test_check_tells_kind_and_tables(case, shared, capsys):
    assert main(["check", str(shared / "cases" / case)]) == 0
    said = capsys.readouterr().out
    assert "recordings.csv" in said
    assert "Assumed" in said
