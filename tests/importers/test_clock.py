"""A clock that starts anew at every step: run on as the rig's own files are, by dates where there are any, and said."""

import numpy as np
import pytest

from mixedlub.importers.plain import draft
from mixedlub.importers.wizard import read

HISTORY = {"kind": "friction_history", "import.units.friction_coefficient": "-"}


def history(header, *rows):
    return "\n".join([f"{header},time_s,mu", *(f"{row},0.1{i}" for i, row in enumerate(rows))]) + "\n"


def taken(text):
    found = draft(text, "t.csv", HISTORY)
    return found.columns["time_s"].tolist(), [note for note in found.notes if "time_s" in note and "taken:" not in note]


def test_a_clock_that_runs_is_left_alone():
    assert taken(history("step", "1,0", "1,5", "2,5", "2,9")) == ([0.0, 5.0, 5.0, 9.0], [])


@pytest.mark.parametrize("header", ["step", "Cycle", "segment", "Step number"])
def test_a_clock_that_restarts_with_a_step_runs_on_from_its_end(header):
    times, (note,) = taken(history(header, "1,1", "1,60", "2,20", "2,60", "3,1"))
    assert times == [1.0, 60.0, 80.0, 120.0, 121.0]
    assert note == (
        f"t.csv: time_s starts anew in lines 4, 6, with {header!r}, and runs on from there without the pauses between"
    )


def test_dates_of_the_starts_keep_the_pauses():
    rows = [f"2,23/03/2018 10:12:0{s},{t}" for s, t in ((1, 1), (1, 2))]
    rows += [f"4,23/03/2018 10:14:01,{t}" for t in (1, 2)]
    times, (note,) = taken(history("step,step_start", *rows))
    assert times == [1.0, 2.0, 121.0, 122.0]
    assert note == "t.csv: time_s starts anew in line 4, and runs on from the starts in 'step_start'"


def test_day_and_month_are_those_that_make_the_shorter_test():
    """Read the other way round, six hours over midnight would be a month."""
    rows = ("05/06/2019 22:00,0", "05/06/2019 22:00,3600", "05/07/2019 00:00,0", "05/07/2019 00:00,60")
    assert taken(history("started", *rows))[0] == [0.0, 3600.0, 7200.0, 7260.0]


def test_dates_that_overlap_their_steps_are_not_believed():
    rows = ("2018-03-23 10:00:00,0", "2018-03-23 10:00:00,500", "2018-03-23 10:00:01,0", "2018-03-23 10:00:01,9")
    times, (note,) = taken(history("start", *rows))
    assert times == [0.0, 500.0, 500.0, 509.0]
    assert "without the pauses" in note


def test_a_fall_that_no_column_tells_of_is_warned_of():
    times, (note,) = taken(history("load_N", "9,0", "9,60", "9,120", "8,1", "8,60"))
    assert times == [0.0, 60.0, 120.0, 121.0, 180.0]
    assert note.startswith("warning: t.csv: time_s starts anew in line 5, ")
    assert note.endswith("; where rows are out of order, sort them first")


@pytest.mark.parametrize("times", [(0, 40, 80, 30, 70), (5, 4, 3, 2, 1), (0, 60, 59, 120, 180), (0, 90, 10, 50, 30)])
def test_a_time_that_only_runs_backwards_is_left_and_warned_of(times):
    kept, (note,) = taken(history("load_N", *(f"9,{t}" for t in times)))
    assert kept == list(times)
    assert note.startswith("warning: t.csv: time_s runs backwards in line")


def test_the_clock_of_a_later_file_runs_on_from_the_one_before(file):
    paths = [file(history("load_N", "9,0", "9,60"), name) for name in ("a.csv", "b.csv")]
    found = read(paths, HISTORY)
    assert found.columns["time_s"].tolist() == [0.0, 60.0, 60.0, 120.0]
    assert (
        "warning: b.csv: time_s starts anew, and runs on from the end of a.csv without the pause between" in found.notes
    )


def test_files_whose_clocks_follow_each_other_are_left_alone(file):
    paths = [
        file(history("load_N", *rows), name) for name, rows in (("a.csv", ("9,0", "9,60")), ("b.csv", ("9,70", "9,80")))
    ]
    assert np.all(read(paths, HISTORY).columns["time_s"] == [0.0, 60.0, 70.0, 80.0])
