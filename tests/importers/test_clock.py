"""A clock that starts anew at every step: run on as the rig's own files are, by dates where there are any, and said."""

import numpy as np
import pytest

from mixedlub.importers.input_file import InputFile, open_file
from mixedlub.importers.plain import draft
from mixedlub.importers.wizard import read
from mixedlub.schema.dates import moments
from mixedlub.schema.findings import Severity
from profiles.errors import InputError

HISTORY = {"kind": "friction_history", "import.units.friction_coefficient": "-"}


def history(header, *rows):
    return "\n".join([f"{header},time_s,mu", *(f"{row},0.1{i}" for i, row in enumerate(rows))]) + "\n"


def taken(text):
    found = draft(InputFile("t.csv", text), HISTORY)
    return found.columns["time_s"].tolist(), [
        note for note in found.notes if "time_s" in note.text and "taken:" not in note.text
    ]


def test_a_clock_that_runs_is_left_alone():
    assert taken(history("step", "1,0", "1,5", "2,5", "2,9")) == ([0.0, 5.0, 5.0, 9.0], [])


@pytest.mark.parametrize("header", ["step", "Cycle", "segment", "Step number"])
def test_a_clock_that_restarts_with_a_step_runs_on_from_its_end(header):
    times, (note,) = taken(history(header, "1,1", "1,60", "2,20", "2,60", "3,1"))
    assert times == [1.0, 60.0, 80.0, 120.0, 121.0]
    assert (note.code, note.place) == ("file_read", "t.csv")
    assert f"in lines 4, 6 with {header!r}" in note.text


def test_dates_of_the_starts_keep_the_pauses():
    rows = [f"2,23/03/2018 10:12:0{s},{t}" for s, t in ((1, 1), (1, 2))]
    rows += [f"4,23/03/2018 10:14:01,{t}" for t in (1, 2)]
    times, (note,) = taken(history("step,step_start", *rows))
    assert times == [1.0, 2.0, 121.0, 122.0]
    assert note.code == "file_read"
    assert "in line 4; continued from the starts in 'step_start'" in note.text


def test_day_and_month_are_those_that_make_the_shorter_test():
    """Read the other way round, six hours over midnight would be a month."""
    rows = ("05/06/2019 22:00,0", "05/06/2019 22:00,3600", "05/07/2019 00:00,0", "05/07/2019 00:00,60")
    assert taken(history("started", *rows))[0] == [0.0, 3600.0, 7200.0, 7260.0]


def test_dates_that_overlap_their_steps_are_not_believed():
    rows = ("2018-03-23 10:00:00,0", "2018-03-23 10:00:00,500", "2018-03-23 10:00:01,0", "2018-03-23 10:00:01,9")
    times, (note,) = taken(history("start", *rows))
    assert times == [0.0, 500.0, 500.0, 509.0]
    assert "without the pauses" in note.text


def test_a_fall_that_no_column_tells_of_is_warned_of():
    times, (note,) = taken(history("load_N", "9,0", "9,60", "9,120", "8,1", "8,60"))
    assert times == [0.0, 60.0, 120.0, 121.0, 180.0]
    assert (note.code, note.place) == ("clock_restarted", "t.csv")
    assert "in line 5; " in note.text


@pytest.mark.parametrize("times", [(0, 40, 80, 30, 70), (5, 4, 3, 2, 1), (0, 60, 59, 120, 180), (0, 90, 10, 50, 30)])
def test_a_time_that_only_runs_backwards_is_left_and_warned_of(times):
    kept, (note,) = taken(history("load_N", *(f"9,{t}" for t in times)))
    assert kept == list(times)
    assert (note.code, note.place) == ("clock_backwards", "t.csv")


def test_the_clock_of_a_later_file_runs_on_from_the_one_before(file):
    paths = [file(history("load_N", "9,0", "9,60"), name) for name in ("a.csv", "b.csv")]
    found = read([open_file(path, {}) for path in paths], HISTORY)
    assert found.columns["time_s"].tolist() == [0.0, 60.0, 60.0, 120.0]
    (note,) = [note for note in found.notes if note.code == "clock_restarted"]
    assert note.place == "b.csv"
    assert "a.csv" in note.text


def test_files_whose_clocks_follow_each_other_are_left_alone(file):
    paths = [
        file(history("load_N", *rows), name) for name, rows in (("a.csv", ("9,0", "9,60")), ("b.csv", ("9,70", "9,80")))
    ]
    assert np.all(read([open_file(path, {}) for path in paths], HISTORY).columns["time_s"] == [0.0, 60.0, 70.0, 80.0])


STAMPS = (
    ("2026-11-23T14:03:10Z", "2026-11-23T14:05:10Z"),
    ("2026-11-23T14:03:10+01:00", "2026-11-23T14:05:10+01:00"),
    ("2026-11-23 14:03:10.5 +0100", "2026-11-23 14:05:10.5 +0100"),
    ("2026-10-25T02:59:10+02:00", "2026-10-25T02:01:10+01:00"),
    ("11/23/2026 11:59:10 AM", "11/23/2026 12:01:10 PM"),
    ("23/11/2026 11:59 pm", "24/11/2026 12:01 am"),
    ("23 Nov 2026 14:03:10", "23 Nov 2026 14:05:10"),
    ("23-November-2026 14:03:10", "23-November-2026 14:05:10"),
    ("Nov 23 2026 2:03:10 PM", "Nov 23 2026 2:05:10 PM"),
    ('"Nov 23, 2026 14:03:10"', '"Nov 23, 2026 14:05:10"'),
    ("23-11-2026 14:03:10", "23-11-2026 14:05:10"),
    ("2026.11.23 14:03:10", "2026.11.23 14:05:10"),
)


@pytest.mark.parametrize(("one", "other"), STAMPS)
def test_dates_are_read_as_instruments_write_them(one, other):
    times, (note,) = taken(history("started", f"{one},1", f"{one},2", f"{other},1", f"{other},2"))
    assert times == [1.0, 2.0, 121.0, 122.0]
    assert note.code == "file_read"
    assert note.text.endswith("in line 4; continued from the starts in 'started'")


def test_no_day_or_hour_is_made_up():
    for one, other in (("31/02/2026 10:00", "31/02/2026 10:02"), ("2026-01-31 13:00 AM", "2026-01-31 13:02 AM")):
        assert "without the pauses" in taken(history("started", f"{one},0", f"{one},9", f"{other},0"))[1][0].text


def test_a_step_shorter_than_the_stamps_tell_keeps_the_dates():
    """Two steps begin in the same minute: the second runs on from the first, the others by their dates."""
    rows = [f"23/03/2018 10:12,{t}" for t in (0, 10)] + [f"23/03/2018 10:12,{t}" for t in (0, 5)]
    rows += [f"23/03/2018 11:12,{t}" for t in (0, 10)]
    times, (note,) = taken(history("started", *rows))
    assert times == [0.0, 10.0, 10.0, 15.0, 3600.0, 3610.0]
    assert note.text.endswith("continued from the starts in 'started'")


def test_a_step_so_short_that_the_clock_does_not_fall_after_it_keeps_the_dates():
    rows = ("2018-03-23 10:00:00,0", "2018-03-23 10:00:00,60", "2018-03-23 10:05:00,0", "2018-03-23 10:05:00,1")
    times, _ = taken(history("started", *rows, "2018-03-23 10:09:00,2", "2018-03-23 10:09:00,30"))
    assert times == [0.0, 60.0, 300.0, 301.0, 542.0, 570.0]


def test_a_clock_that_goes_with_the_rows_puts_steps_in_their_place():
    rows = ("10:00:00,5", "10:00:10,15", "10:05:00,1", "10:05:08,9")
    times, (note,) = taken(history("clock", *(f"2018-03-23 {row}" for row in rows)))
    assert times == [5.0, 15.0, 305.0, 313.0]
    assert note.text.endswith("continued by the clock in 'clock'")


AMBIGUOUS = ("05/06/2019 22:00,0", "05/06/2019 22:00,3600", "05/07/2019 00:00,0", "05/07/2019 00:00,60")


def test_a_day_that_could_be_the_month_is_told_with_the_answer_that_settles_it():
    (note,) = taken(history("started", *AMBIGUOUS))[1]
    assert (note.code, note.place) == ("date_order_assumed", "t.csv")
    assert "import.dates = 'day first'" in note.text


@pytest.mark.parametrize(("order", "second"), [("month first", 7200.0), ("day first", 30 * 86400.0 - 22 * 3600.0)])
def test_what_is_told_of_day_and_month_is_done(order, second):
    found = draft(InputFile("t.csv", history("started", *AMBIGUOUS)), {**HISTORY, "import.dates": order})
    assert found.columns["time_s"][2] == second
    assert not [note for note in found.notes if note.severity is Severity.CAUTION]


def test_another_order_is_refused():
    with pytest.raises(InputError, match=r"import\.dates: 'year first': must be 'day first' or 'month first'"):
        draft(InputFile("t.csv", history("started", *AMBIGUOUS)), {**HISTORY, "import.dates": "year first"})


def test_dates_that_are_one_day_either_way_leave_nothing_open():
    rows = ("05/05/2019 22:00,0", "05/05/2019 22:00,3600", "05/05/2019 23:30,0", "05/05/2019 23:30,60")
    assert taken(history("started", *rows))[1][0].code != "date_order_assumed"


@pytest.mark.parametrize("cell", ["2026-11-23 14:03:10 +2500", "2026-11-23 14:03:10+99:00", "2026-11-23 14:03:99"])
def test_a_clock_or_zone_that_no_place_has_is_no_date(cell):
    assert not any(moments([cell]).values())
