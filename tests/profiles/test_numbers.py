"""Columns of numbers in text: a count above them, results below them, and what is no number."""

import numpy as np
import pytest

from profiles import InputError, read
from roughness import trace_record
from tests.profiles.test_text import rows, written

COUNT = 4000
X = 0.5 * np.arange(COUNT)  # um
Z = 11.0 + 0.4 * np.sin(X / 3.0) + 0.3 * np.sin(X / 11.0 + 1.0)  # um
RQ = np.sqrt((0.4**2 + 0.3**2) / 2.0)


def column(values, head="", foot=""):
    return head + "".join(f"{z:.4f}\n" for z in values) + foot


def rq_of(trace):
    return trace_record(trace, cutoff=None, short_cutoff=None, edges=False)[1]["parameters"]["Rq_um"]


@pytest.mark.parametrize("head", [f"2.00000\n{COUNT}\n", f"2.0 {COUNT}\n", f"Surface 7\n2.0;{COUNT}\n"])
@pytest.mark.parametrize("name", ["trace.tx1", "trace.txt"])
def test_length_and_count_above_the_heights_are_none_of_them(tmp_path, head, name):
    trace = read(written(tmp_path, column(Z, head), name), unit="mm, um")
    assert trace.heights.size == COUNT
    assert trace.spacing == pytest.approx(0.5e-6)
    assert trace.valid.all()
    assert any("count" in step for step in trace.steps)
    assert any("0.0005 mm" in step for step in trace.steps)
    assert rq_of(trace) == pytest.approx(RQ, rel=0.02)


def test_a_step_that_is_told_wins_over_length_and_count(tmp_path):
    file = written(tmp_path, column(Z, f"2.0\n{COUNT}\n"), "trace.tx1")
    assert read(file).spacing == pytest.approx(0.5e-6)
    told = read(file, spacing="0.4 um")
    assert told.spacing == 0.4e-6
    assert "0.5 um" in told.origin["spacing_overruled"]


@pytest.mark.parametrize("units", ["", "unit: nm\n", "x unit: mm\n"])
def test_one_unit_that_is_told_is_not_that_of_the_length(tmp_path, units):
    file = written(tmp_path, column(Z, f"{units}2.0\n{COUNT}\n"))
    trace = read(file, unit="um")
    assert (trace.spacing, trace.heights[1]) == pytest.approx((0.5e-6, Z[1] * 1e-6), rel=1e-4)
    told = read(file, unit="um", spacing="0.4 um")
    assert told.spacing == 0.4e-6
    assert not any(step.startswith("step ") for step in told.steps)


def test_a_count_without_a_length_needs_the_step(tmp_path):
    file = written(tmp_path, column(Z, f"{COUNT}\n"))
    with pytest.raises(InputError, match="needs its step"):
        read(file, unit="um")
    assert read(file, unit="um", spacing="0.5 um").heights.size == COUNT


@pytest.mark.parametrize("kept", [COUNT - 500, COUNT - 1])
@pytest.mark.parametrize("pairs", [False, True])
def test_a_count_of_other_than_the_heights_below_is_said(tmp_path, kept, pairs):
    body = rows(X[:kept], Z[:kept], ",") if pairs else column(Z[:kept])
    trace = read(written(tmp_path, f"2.0\n{COUNT}\n" + body), unit="um" if pairs else "mm, um")
    assert trace.heights.size == kept
    assert trace.spacing == pytest.approx(0.5e-6)
    (said,) = (w for w in trace_record(trace)[1]["warnings"] if "counts" in w)
    assert str(COUNT) in said
    assert str(kept) in said


@pytest.mark.parametrize("heights", [np.arange(500) % 7 - 3, np.zeros(500)])
def test_a_count_above_fewer_whole_heights_is_said(tmp_path, heights):
    text = "800\n" + "".join(f"{z:.0f}\n" for z in heights)
    trace = read(written(tmp_path, text), unit="nm", spacing="0.5 um")
    assert trace.heights.size == 500
    assert "cut short" in trace.origin["count_differs"]


def test_a_count_named_in_the_heading_is_held_against_the_heights(tmp_path):
    text = "Points: {}\nx_um,z_um\n" + rows(X[:50], Z[:50], ",").replace("{", "{{")
    assert "count_differs" in read(written(tmp_path, text.format(60))).origin
    assert "count_differs" not in read(written(tmp_path, text.format(50))).origin


@pytest.mark.parametrize("between", [",  ", "\t", " "])
def test_a_count_in_a_line_under_the_units(tmp_path, between):
    trace = read(written(tmp_path, f"mm µm\n{COUNT}\n" + rows(X / 1e3, Z, between)))
    assert (trace.heights.size, trace.spacing) == (COUNT, pytest.approx(0.5e-6))
    assert rq_of(trace) == pytest.approx(RQ, rel=0.02)


def test_a_lone_number_over_two_columns_is_the_line_that_is_blamed(tmp_path):
    with pytest.raises(InputError, match=r"line 2: '7\.5': expected 2 numbers"):
        read(written(tmp_path, "mm um\n7.5\n" + rows(X / 1e3, Z, " ")))


@pytest.mark.parametrize(
    "text", ["49\n" + column(np.arange(50) % 7), "12\n" + column(np.arange(40) * 0.5), "3\n1\n2\n4\n"]
)
def test_whole_heights_are_heights(tmp_path, text):
    trace = read(written(tmp_path, text), unit="um", spacing="0.5 um")
    assert trace.heights.size == len(text.split())


RESULTS = "\nRa,0.40\nRq [um],0.36\nRz; 1.4 µm\nRsk,0.1\n"


@pytest.mark.parametrize("heading", ["x_um,z_um\n", ""])
def test_results_below_the_heights_are_kept_and_compared(tmp_path, heading):
    trace = read(written(tmp_path, heading + rows(X, Z, ",") + RESULTS), unit="um")
    assert trace.heights.size == COUNT
    assert trace.origin["stated"] == pytest.approx({"Ra": 0.40e-6, "Rq": 0.36e-6, "Rz": 1.4e-6, "Rsk": 0.1})
    assert any("Ra, Rq, Rz, Rsk" in step for step in trace.steps)
    record = trace_record(trace, cutoff=None, short_cutoff=None)[1]
    ours = record["parameters"]
    said = [w for w in record["warnings"] if "the file states" in w]
    assert [w.split()[3] for w in said] == [n for n in ("Ra", "Rq", "Rz") if _off(trace.origin["stated"][n], ours, n)]
    assert f"{100 * (0.40 / ours['Ra_um'] - 1):+.0f} %" in said[0]


def _off(stated, ours, name):
    return abs(stated * 1e6 / ours[f"{name}_um"] - 1) > 0.02


def test_words_below_the_heights_are_said(tmp_path):
    trace = read(written(tmp_path, "x_um,z_um\n" + rows(X, Z, ",") + "\n\nOperator: Meyer\n# end\n"))
    assert trace.heights.size == COUNT
    assert any("2 lines below" in step and "left out" in step for step in trace.steps)
    assert "stated" not in trace.origin


@pytest.mark.parametrize("foot", ["1,Ra,0.290\n", "---- results ----\nRa 0.29\n", ";end\n", "2) Rz 1.4\n-Rq: 0.3\n"])
def test_results_behind_a_mark_or_a_number_are_below_the_heights(tmp_path, foot):
    trace = read(written(tmp_path, column(Z, foot=foot)), unit="um", spacing="0.5 um")
    assert trace.heights.size == COUNT
    assert any(f"from line {COUNT + 1} on" in step for step in trace.steps)


@pytest.mark.parametrize("foot", ["\n0.290\n0.351\n1.47\n", "\nRa 0.29\n\n0.351\n"])
def test_numbers_below_an_empty_line_are_no_heights(tmp_path, foot):
    trace = read(written(tmp_path, column(Z, foot=foot)), unit="um", spacing="0.5 um")
    assert trace.heights.size == COUNT
    assert any(f"from line {COUNT + 2} on" in step for step in trace.steps)


def test_two_traces_parted_by_an_empty_line_are_refused(tmp_path):
    with pytest.raises(InputError, match=f"line {COUNT + 2}: .*save each"):
        read(written(tmp_path, column(Z) + "\n" + column(Z)), unit="um", spacing="0.5 um")
    doubled = read(written(tmp_path, column(Z).replace("\n", "\n\n")), unit="um", spacing="0.5 um")
    assert doubled.heights.size == COUNT


def test_words_between_the_heights_are_no_end(tmp_path):
    text = "x_um,z_um\n" + rows(X[:50], Z[:50], ",") + "Ra,0.3\n" + rows(X[50:60], Z[50:60], ",")
    with pytest.raises(InputError, match="line 52: 'Ra': not a number"):
        read(written(tmp_path, text))


@pytest.mark.parametrize("cell", ["1_7.49", "1_0", "_1"])
def test_a_stroke_between_digits_is_no_number(tmp_path, cell):
    text = "x_um,z_um\n0.0,0.1\n0.5,0.2\n1.0," + cell + "\n1.5,0.1\n"
    with pytest.raises(InputError, match=f"line 4: '{cell}': not a number"):
        read(written(tmp_path, text))
