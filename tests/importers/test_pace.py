"""Histories against cycles or a distance: seconds are made of them by a pace that is asked, and that is said."""

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_kind
from mixedlub.importers.plain import draft
from mixedlub.schema.units import split
from profiles.errors import InputError

HISTORY = {"kind": "friction_history", "import.units.friction_coefficient": "-"}
CYCLE, SPEED = "import.seconds_a_cycle", "import.speed_m_s"


def history(header):
    return f"{header};mu\n10;0.1\n20;0.2\n40;0.15\n"


def needed(header, told=HISTORY):
    return {
        q.key: q for q in draft(InputFile("t.csv", history(header)), told).questions if q.needed and q.key not in told
    }


@pytest.mark.parametrize("header", ["Cycle", "Cycles (-)", "No. of cycles", "cycle number", "Revolutions", "Cycle [#]"])
def test_cycles_are_seconds_by_what_one_takes(header):
    (question,) = needed(header).values()
    assert (question.key, repr(header) in question.text) == (CYCLE, True)
    found = draft(InputFile("t.csv", history(header)), {**HISTORY, CYCLE: 2.5})
    assert found.columns["time_s"].tolist() == [25.0, 50.0, 100.0]
    assert f"t.csv: time_s is {header!r} times 2.5 s a cycle" in map(str, found.notes)


@pytest.mark.parametrize(
    ("header", "metres"),
    [("Distance (m)", 1.0), ("Sliding distance [km]", 1e3), ("sliding_distance_mm", 1e-3), ("distance_m", 1.0)],
)
def test_a_distance_is_seconds_by_the_speed(header, metres):
    (question,) = needed(header).values()
    assert question.key == SPEED
    found = draft(InputFile("t.csv", history(header)), {**HISTORY, SPEED: 0.5})
    assert found.columns["time_s"].tolist() == pytest.approx([20 * metres, 40 * metres, 80 * metres], rel=1e-14)
    assert f"t.csv: time_s is {header!r} over 0.5 m/s" in map(str, found.notes)


def test_the_unit_of_a_distance_is_asked_with_those_of_lengths_first():
    question = needed("Distance")["import.units.time_s"]
    assert (question.example, question.options[:3]) == ('"m"', ("m", "mm", "km"))
    told = {**HISTORY, "import.units.time_s": "km", SPEED: 2}
    assert draft(InputFile("t.csv", history("Distance")), told).columns["time_s"].tolist() == [5000.0, 10000.0, 20000.0]


def test_a_header_of_another_name_is_told_and_its_unit_asked():
    assert "counts cycles or a distance will do" in needed("N")["import.columns.time_s"].text
    told = {**HISTORY, "import.columns.time_s": "N"}
    assert "cycle" in needed("N", told)["import.units.time_s"].options
    told |= {"import.units.time_s": "cycle", CYCLE: 2.0}
    assert draft(InputFile("t.csv", history("N")), told).columns["time_s"].tolist() == [20.0, 40.0, 80.0]


def test_a_time_goes_before_what_counts():
    found = draft(InputFile("t.csv", "Cycle;Time (s);mu\n1;10;0.1\n2;20;0.2\n3;40;0.15\n"), HISTORY)
    assert found.columns["time_s"].tolist() == [10.0, 20.0, 40.0]
    assert not {CYCLE, SPEED} & {question.key for question in found.questions}


RECORDED = ["t [s]", "t (h)", "Zeit [s]", "Duration [min]", "time since start (s)"]


def beside(header, counts="Cycles", values=(7, 8, 9)):
    """A recording against a count, with another column of numbers or words."""
    rows = [f"{10 * (i + 1)};{value};0.{i + 1}" for i, value in enumerate(values)]
    return "\n".join([f"{counts};{header};COF [-]", *rows]) + "\n"


@pytest.mark.parametrize("pace", [{}, {CYCLE: 0.5}])
@pytest.mark.parametrize("header", RECORDED)
def test_a_count_beside_a_time_of_other_words_is_asked_about(header, pace):
    found = draft(InputFile("t.csv", beside(header)), {**HISTORY, **pace})
    (question,) = [q for q in found.questions if q.needed and q.key not in HISTORY]
    assert (question.key, question.options) == ("import.columns.time_s", (header, "Cycles"))
    assert "time_s" not in found.columns


@pytest.mark.parametrize("header", RECORDED)
def test_either_answer_is_taken(header):
    seconds = {"s": 1.0, "h": 3600.0, "min": 60.0}[split(header)[1]]
    told = {**HISTORY, "import.columns.time_s": header}
    times = draft(InputFile("t.csv", beside(header)), told).columns["time_s"]
    assert times.tolist() == [7 * seconds, 8 * seconds, 9 * seconds]
    told |= {"import.columns.time_s": "Cycles", CYCLE: 0.5}
    assert draft(InputFile("t.csv", beside(header)), told).columns["time_s"].tolist() == [5.0, 10.0, 15.0]


def test_a_distance_beside_a_time_of_other_words_is_asked_about_too():
    found = draft(InputFile("t.csv", beside("t [s]", counts="Distance (m)")), HISTORY)
    assert {q.key: q.options for q in found.questions}["import.columns.time_s"] == ("t [s]", "Distance (m)")


def test_a_clock_is_no_time_beside_a_count():
    clock = draft(InputFile("t.csv", beside("t [s]", values=("8:00", "8:01", "8:02"))), {**HISTORY, CYCLE: 0.5})
    assert clock.columns["time_s"].tolist() == [5.0, 10.0, 15.0]


def test_the_recorded_time_is_the_first_choice(file, tmp_path, at_terminal):
    settings = [f"{key}={value}" for key, value in HISTORY.items()]
    at_terminal(file(beside("t [s]")), tmp_path / "case", settings, {"holds time_s": ["@a"]})
    assert read_case(tmp_path / "case").recordings["time_s"].tolist() == [7.0, 8.0, 9.0]


@pytest.mark.parametrize("header", ["Stroke (mm)", "Wear (mm)", "Cycle time", "Stroke"])
def test_other_lengths_and_words_count_nothing(header):
    assert "import.columns.time_s" in needed(header)


@pytest.mark.parametrize("header", ["Cycle", "Distance (m)"])
def test_what_counts_beside_a_friction_is_a_history(header):
    assert likely_kind({header: ["1", "2"], "COF (-)": ["0.1", "0.2"]}) == "friction_history"


@pytest.mark.parametrize("pace", [0, -1.0, "fast", True, float("inf")])
def test_a_pace_is_a_number_above_zero(pace):
    with pytest.raises(InputError, match="must be a number above 0"):
        draft(InputFile("t.csv", history("Cycle")), {**HISTORY, CYCLE: pace})


@pytest.mark.parametrize(("header", "key"), [("Time (s)", CYCLE), ("time_s", SPEED), ("Cycle", SPEED)])
def test_a_pace_without_a_use_is_refused(header, key):
    with pytest.raises(InputError, match=f"{key}: time_s is taken from '{header[:4]}.*needs no such answer"):
        draft(InputFile("t.csv", history(header)), {**HISTORY, key: 2.0})


def test_the_case_that_is_written_is_in_seconds(file, tmp_path):
    told = {**HISTORY, CYCLE: 0.5}
    table = read_case(import_files([file(history("Cycle"))], tmp_path / "case", **told)).recordings
    assert table["time_s"].tolist() == [5.0, 10.0, 20.0]


def test_the_pace_is_asked_with_the_other_questions(file, tmp_path, at_terminal):
    settings = [f"{key}={value}" for key, value in HISTORY.items()]
    user = at_terminal(file(history("Distance (m)")), tmp_path / "case", settings, {"in m/s": ["0.1"]})
    assert "t.csv: time_s is 'Distance (m)' over 0.1 m/s" in user.said
    assert len(user.forms) == 1
    assert read_case(tmp_path / "case").recordings["time_s"].tolist() == [100.0, 200.0, 400.0]
