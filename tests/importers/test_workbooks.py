"""Workbooks as people leave them: hidden sheets and rows, means below the table, errors, numbers stored as text."""

import re

import openpyxl
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers.odd_rows import without_summaries
from mixedlub.importers.wizard import run
from profiles.errors import InputError

HEAD = ["Speed (rpm)", "Friction torque (Nm)"]
ROWS = [[100 * i, 0.5 + 0.1 * i] for i in range(1, 7)]
TOLD = ["kind=friction_map", "recording.quantity=friction_torque_Nm"]


def imported(path, tmp_path, *settings):
    """The runs, speeds and torques of the case, and what was said."""
    said = []
    case = run([path], tmp_path / "case", [*TOLD, *settings], say=said.append)
    table = read_case(case).recordings
    columns = (table[name].tolist() for name in ("run", "speed_rpm", "friction_torque_Nm"))
    return [*zip(*columns, strict=True)], "\n".join(said)


def speeds(path, tmp_path, *settings):
    rows, said = imported(path, tmp_path, *settings)
    return [speed for _, speed, _ in rows], said


@pytest.fixture
def changed(book):
    """A workbook of the rows, after a change of its sheet."""

    def write(change, rows=ROWS):
        path = book(Data=[HEAD, *rows])
        made = openpyxl.load_workbook(path)
        change(made)
        made.save(path)
        return path

    return write


ALL = [100.0 * i for i in range(1, 7)]


def with_hidden_sheet(made):
    old = made.create_sheet("Old")
    for row in [HEAD, *([10 * i, i / 4] for i in range(1, 20))]:
        old.append(row)
    old.sheet_state = "hidden"


def test_a_hidden_sheet_is_read_only_where_it_is_named(changed, tmp_path):
    taken, said = speeds(changed(with_hidden_sheet), tmp_path)
    assert taken == ALL
    assert "'Old' (hidden)" in said
    taken, said = speeds(changed(with_hidden_sheet), tmp_path / "named", "import.sheet=Old")
    assert len(taken) == 19
    assert "'Old' (hidden) is read" in said


def test_a_workbook_whose_only_numbers_are_hidden_is_refused(book, tmp_path):
    path = book(About=[["Rig", "A"]])
    made = openpyxl.load_workbook(path)
    with_hidden_sheet(made)
    made.save(path)
    with pytest.raises(InputError, match="'Old', which is hidden"):
        imported(path, tmp_path)


def test_hidden_rows_are_left_out_with_their_count_unless_taken(changed, tmp_path):
    def hide(made):
        for row in (3, 5):
            made["Data"].row_dimensions[row].hidden = True

    taken, said = speeds(changed(hide), tmp_path)
    assert taken == [100.0, 300.0, 500.0, 600.0]
    assert "2 rows" in said
    assert "lines 3, 5" in said
    assert "import.hidden_rows" in said
    assert speeds(changed(hide), tmp_path / "taken", "import.hidden_rows=take")[0] == ALL
    with pytest.raises(InputError, match="'take' or 'leave'"):
        imported(changed(hide), tmp_path / "wrong", "import.hidden_rows=yes")


@pytest.mark.parametrize("label", ["mean", "Average:", "SUM", "Mittelwert", "SD"])
@pytest.mark.parametrize("gap", [0, 1, 3])
def test_rows_of_means_are_no_readings(changed, tmp_path, label, gap):
    numbered = [[i, *row] for i, row in enumerate(ROWS, 1)]

    def summarise(made):
        sheet = made["Data"]
        sheet["A1"], sheet["B1"], sheet["C1"] = "Nr.", *HEAD
        for place, value in zip("ABC", (label, 350, 0.85), strict=True):
            sheet[f"{place}{8 + gap}"] = value

    rows, said = imported(changed(summarise, numbered), tmp_path)
    assert [speed for _, speed, _ in rows] == ALL
    assert repr(label) in said
    assert f"line {8 + gap}" in said


LABELS = """Max,Min,n,N,CV %,RMS,MW,Mittelwerte,Std. Abw.,Std.-Abw.,Stdev.S,moyenne,Gesamtmittelwert
Mittelwert 1-24,Mean of all,total,Summe,Mean values:,s.d.,St. Dev."""


def test_rows_labelled_in_many_ways_summarise_others():
    readings = [(i, [str(i), "0.5", "N"]) for i in range(1, 30)]
    kept, _ = without_summaries(
        [*readings, *((50 + i, [label, "7", ""]) for i, label in enumerate(re.split("[,\n]", LABELS)))]
    )
    assert kept == readings


def test_a_mean_amid_the_rows_is_no_reading(book, tmp_path):
    numbered = [[i, *row] for i, row in enumerate(ROWS, 1)]
    path = book(Data=[["Nr.", *HEAD], *numbered[:3], ["Mean", 200, 0.7], *numbered[3:]])
    rows, _ = imported(path, tmp_path)
    assert [(n, speed) for n, speed, _ in rows] == [(i, 100.0 * i) for i in range(1, 7)]


def test_the_numbers_of_the_sheet_stay_the_runs(book, tmp_path):
    path = book(Data=[["Nr.", *HEAD], *([i, *row] for i, row in zip((3, 5, 8, 13, 21, 34), ROWS, strict=True))])
    rows, _ = imported(path, tmp_path)
    assert [n for n, _, _ in rows] == [3, 5, 8, 13, 21, 34]


def test_numbers_stored_as_text_are_read_and_said(book, tmp_path):
    texts = [[str(speed), f"{torque:.2f}".replace(".", ",")] for speed, torque in ROWS]
    taken, said = speeds(book(Data=[HEAD, *texts]), tmp_path)
    assert taken == ALL
    assert "columns A, B" in said
    assert "stored as text" in said


@pytest.mark.parametrize(("cell", "speed"), [("1.500", 1500.0), ("1.500.000", 1.5e6), ("1.500,5", 1500.5)])
def test_a_point_in_a_text_beside_decimal_commas_parts_thousands(book, tmp_path, cell, speed):
    texts = [[str(100 * i), f"0,{i}5"] for i in range(1, 6)]
    taken, _ = speeds(book(Data=[HEAD, *texts, [cell, "0,9"]]), tmp_path)
    assert taken == [*ALL[:5], speed]


@pytest.mark.parametrize("cell", ["1,500.0", "1,500,000", "-12,345.6"])
def test_commas_as_decimal_mark_and_between_thousands_are_refused_with_both_cells(book, tmp_path, cell):
    texts = [[str(100 * i), f"0,{i}5"] for i in range(1, 6)]
    with pytest.raises(InputError, match=rf"cell B2: '0,15': .*cell A7.*{re.escape(repr(cell))}"):
        speeds(book(Data=[HEAD, *texts, [cell, "0,9"]]), tmp_path)


def test_a_column_of_decimal_points_keeps_them_beside_decimal_commas(book, tmp_path):
    texts = [[f"{i}.25", f"0,{i}5"] for i in range(1, 6)]
    taken, _ = speeds(book(Data=[HEAD, *texts, ["6.125", "0,9"]]), tmp_path)
    assert taken == [1.25, 2.25, 3.25, 4.25, 5.25, 6.125]


def test_one_text_with_a_decimal_comma_among_numbers_is_read(changed, tmp_path):
    def as_text(made):
        made["Data"]["B3"] = "0,7"

    rows, _ = imported(changed(as_text), tmp_path)
    assert rows[1] == (2, 200.0, 0.7)


@pytest.mark.parametrize("cell", ["#DIV/0!", "#VALUE!", "inf", "-inf", "#N/A", "1.#INF"])
def test_a_cell_of_an_error_leaves_its_row_out(changed, tmp_path, cell):
    def spoil(made):
        made["Data"]["B4"] = cell

    taken, said = speeds(changed(spoil), tmp_path)
    assert taken == [100.0, 200.0, 400.0, 500.0, 600.0]
    assert "line 4" in said


def test_formulas_without_values_name_the_way_out(changed, tmp_path):
    def one(made):
        made["Data"]["B4"] = "=A4/1000"

    taken, said = speeds(changed(one), tmp_path)
    assert taken == [100.0, 200.0, 400.0, 500.0, 600.0]
    assert "LibreOffice" in said
    with pytest.raises(InputError, match="LibreOffice"):
        imported(changed(lambda made: None, [[a, f"=A{i}/9"] for i, (a, _) in enumerate(ROWS, 2)]), tmp_path / "all")


@pytest.mark.parametrize("gap", [" ", "\u00a0", "\u202f", "'", "\u2019"])
def test_thousands_may_be_separated_by_a_blank_or_an_apostrophe(file, tmp_path, gap):
    text = "Speed (rpm);Friction torque (Nm)\n" + "".join(f"{i}{gap}{i}00;0,{i}\n" for i in range(1, 7))
    taken, said = speeds(file(text), tmp_path)
    assert taken == [1000.0 * i + 100 * i for i in range(1, 7)]
    assert "is read as 1100" in said


def test_two_columns_between_blanks_are_no_thousands(file, tmp_path):
    text = "speed_rpm friction_torque_Nm\n" + "".join(f"{100 * i} {100 + i}\n" for i in range(1, 7))
    assert speeds(file(text), tmp_path)[0] == ALL


def test_dates_percent_and_gaps_of_a_sheet(book, tmp_path):
    import datetime

    from profiles.readers.workbook import worksheets

    rows = [["When", "Share", None, True], [datetime.datetime(2020, 1, 2, 3, 4, 5), 0.05, None, 1e-7]]
    path = book(Data=rows, formats={"B2": "0.0%"})
    (sheet,) = worksheets(path.read_bytes(), "t.xlsx")
    assert sheet.text == "When\tShare\t\tTrue\n2020-01-02 03:04:05\t0.05\t\t1e-07\n"
    assert sheet.percent == ("B",)
