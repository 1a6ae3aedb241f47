"""Numbers and their numbering: what is written reads back equal, and readings keep the number they had."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.vocabulary import BY_NAME, convert
from mixedlub.importers.wizard import run

HISTORY = {"kind": "friction_history"}


def said_of(files, out, kind="viscosity"):
    lines = []
    run(files, out, [f"kind={kind}"], say=lines.append)
    return " ".join(lines)


def test_times_since_the_epoch_stay_apart(file, tmp_path):
    times = [1619110000.0, 1619110000.1, 1619110000.2, 1619110000.3]
    text = "time_s,friction_coefficient\n" + "".join(f"{t!r},0.1{i}\n" for i, t in enumerate(times))
    table = read_case(import_files([file(text)], tmp_path / "case", **HISTORY)).recordings
    assert table["time_s"].tolist() == times


def test_every_digit_comes_back(file, tmp_path):
    values = np.random.default_rng(3).lognormal(0.0, 20.0, 40).tolist()
    text = "time_s,friction_coefficient\n" + "".join(f"{i},{v!r}\n" for i, v in enumerate(values))
    table = read_case(import_files([file(text)], tmp_path / "case", **HISTORY)).recordings
    assert table["friction_coefficient"].tolist() == values


def test_conversion_leaves_no_digits_of_its_own(file, tmp_path):
    text = "Time (s),Friction Coefficient (%),Oil Temp (K)\n" + "".join(f"{i},{i}.7,30{i}.1\n" for i in range(6))
    folder = import_files([file(text)], tmp_path / "case", **HISTORY)
    rows = (folder / "recordings.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0] == "run,time_s,oil_temperature_C,friction_coefficient"
    assert rows[1:3] == ["1,0,26.95,0.007", "2,1,27.95,0.017"]


@pytest.mark.parametrize(("value", "unit", "column", "expected"), [(50, "degF", "oil_temperature_C", 10.0)])
def test_fahrenheit(value, unit, column, expected):
    assert convert(np.array([float(value)]), unit, BY_NAME[column], "t").tolist() == [expected]


@pytest.mark.parametrize("unit", ["lbft", "lb-ft", "ft.lb", "lbf ft"])
def test_pound_feet(unit):
    assert convert(np.array([1.0]), unit, BY_NAME["torque_Nm"], "t")[0] == pytest.approx(0.3048 * 4.4482216152605)


def test_run_numbers_are_kept(file, tmp_path):
    text = "run,temperature_C,viscosity_mPa_s\n17,40,30\n4,60,12\n99,100,5\n"
    table = read_case(import_files([file(text)], tmp_path / "case", kind="viscosity")).recordings
    assert table["run"].tolist() == [17, 4, 99]


def test_run_numbers_behind_the_same_word_are_kept(file, tmp_path):
    text = "Run,temperature_C,viscosity_mPa_s\nT-017,40,30\nT-004,60,12\nT-099,100,5\n"
    table = read_case(import_files([file(text)], tmp_path / "case", kind="viscosity")).recordings
    assert table["run"].tolist() == [17, 4, 99]


def test_a_column_under_another_word_is_told(file, tmp_path):
    text = "Point,temperature_C,viscosity_mPa_s\n17,40,30\n4,60,12\n"
    told = {"kind": "viscosity", "import.columns.run": "Point"}
    assert read_case(import_files([file(text)], tmp_path / "case", **told)).recordings["run"].tolist() == [17, 4]


def test_run_numbers_stay_with_their_readings_where_some_are_left_out(file, tmp_path):
    text = "run,temperature_C,viscosity_mPa_s\n17,40,30\n4,60,12\n99,100,5\n"
    told = {"kind": "viscosity", "import.every": 2}
    table = read_case(import_files([file(text)], tmp_path / "case", **told)).recordings
    assert table["run"].tolist() == [17, 99]


@pytest.mark.parametrize(
    ("again", "said"),
    [
        ("17", "run 17 is in lines 2 and 3, so readings are renumbered from 1"),
        ("B4", "line 3, run: 'B4' is no whole number, so readings are renumbered from 1"),
        ("4.5", "line 3, run: '4.5' is no whole number"),
        ("nan", "line 3, run: 'nan' is no whole number"),
    ],
)
def test_numbers_that_cannot_be_kept_are_named(file, tmp_path, again, said):
    text = f"run,temperature_C,viscosity_mPa_s\n17,40,30\n{again},60,12\n"
    assert said in said_of([file(text)], tmp_path / "case")
    assert read_case(tmp_path / "case").recordings["run"].tolist() == [1, 2]


def test_runs_of_two_files_are_kept_where_they_differ(file, tmp_path):
    head = "run,temperature_C,viscosity_mPa_s\n"
    files = [file(f"{head}1,40,30\n", "a.csv"), file(f"{head}7,60,12\n", "b.csv")]
    table = read_case(import_files(files, tmp_path / "case", kind="viscosity")).recordings
    assert table["run"].tolist() == [1, 7]


def test_runs_that_stand_in_two_files_are_named(file, tmp_path):
    head = "run,temperature_C,viscosity_mPa_s\n"
    files = [file(f"{head}1,40,30\n2,50,20\n", "a.csv"), file(f"{head}2,60,12\n", "b.csv")]
    assert "run 2 is in a.csv and b.csv, so readings are renumbered" in said_of(files, tmp_path / "case")
    assert read_case(tmp_path / "case").recordings["run"].tolist() == [1, 2, 3]


def test_a_file_without_runs_beside_one_with_is_named(file, tmp_path):
    files = [
        file("run,temperature_C,viscosity_mPa_s\n1,40,30\n", "a.csv"),
        file("temperature_C,viscosity_mPa_s\n60,12\n", "b.csv"),
    ]
    assert "b.csv has no run numbers to keep" in said_of(files, tmp_path / "case")


@pytest.mark.parametrize("decimal", [".", ","])
def test_a_minus_as_it_is_printed_is_read(file, tmp_path, decimal):
    """U+2212 before a number is a minus."""
    text = "time_s;friction_coefficient\n" + "".join(f"{i};\u22120.1{i}\n" for i in range(5)) + "5;1.2e\u22121\n"
    case = import_files([file(text.replace(".", decimal))], tmp_path / "case", **HISTORY)
    expected = [-0.1, -0.11, -0.12, -0.13, -0.14, 0.12]
    assert read_case(case).recordings["friction_coefficient"].tolist() == expected
    path = case / "recordings.csv"
    path.write_text(path.read_text(encoding="utf-8").replace("-", "\u2212"), encoding="utf-8")
    assert read_case(case).recordings["friction_coefficient"].tolist() == expected
