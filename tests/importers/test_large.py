"""Tables of many rows; how long they take is told by benchmarks/import_table.py."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files, long_table
from mixedlub.importers.cell_columns import NumberColumn, values_of
from mixedlub.importers.text_table import read_sheet
from mixedlub.kinds import kind
from mixedlub.schema import table as schema_table
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, read_table
from profiles.errors import InputError

DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
ROWS = 30_000


def table(rows):
    lines = (f"{i * 0.1:.1f},{100 + i % 900},{0.5 + i % 7:.3f},40.0,A{i % 3}" for i in range(rows))
    return "Time [s],Speed [rpm],Friction torque [Nm],Oil temp [°C],Sample\n" + "\n".join(lines) + "\n"


@pytest.mark.long
def test_a_table_of_many_rows_is_imported_whole(file, tmp_path):
    path = file(table(ROWS))
    with pytest.warns(UserWarning, match="pooled"):
        case = import_files([path], tmp_path / "case", **DRIVE)
    read = read_case(case).recordings
    assert len(read) == ROWS
    assert np.allclose(read["friction_torque_Nm"], 0.5 + np.arange(ROWS) % 7)


def test_a_long_case_is_read_as_a_short_one_is(file, tmp_path, monkeypatch):
    """At once and row by row: the same columns, also with a name among them; a wrong cell is named by its line."""
    path = file(
        "run,speed_rpm,setup,friction_torque_Nm\n" + "".join(f"{i},{9 * i},a{i % 2},0.{i}\n" for i in range(1, 60))
    )
    columns = (*kind("friction_map").columns, *BOOKKEEPING, RUN, Column("friction_torque_Nm"))
    short = read_table(path, columns)
    monkeypatch.setattr(schema_table, "LONG", 100)
    monkeypatch.setattr(schema_table, "csv_rows", None)
    long = read_table(path, columns)
    assert list(long.columns) == list(short.columns)
    assert all(
        np.array_equal(long[name], short[name]) and long[name].dtype == short[name].dtype for name in long.columns
    )
    monkeypatch.undo()
    monkeypatch.setattr(schema_table, "LONG", 100)
    path.write_text(path.read_text(encoding="utf-8").replace("\n7,63", "\n7,6E"), encoding="utf-8")
    with pytest.raises(InputError, match="line 8, speed_rpm: '6E': speed_rpm must be a number"):
        read_table(path, columns)


LOG = "Rig 7\n\nTime [s]{0}Load [N]{0}Note{0}COF\n"


def rows(count, separator, decimal):
    for i in range(count):
        numbers = [f"{i * 0.1:.1f}", str(20 + i % 3), "on" if i % 5 else "off", f"{0.1 + 1e-4 * (i % 7):.5f}"]
        numbers[1] = "" if i == 1200 else numbers[1]
        yield separator.join(number.replace(".", decimal) for number in numbers)


@pytest.mark.parametrize(("separator", "decimal"), [(",", "."), (";", ","), ("\t", ","), (";", ".")])
def test_a_long_table_is_read_as_a_short_one_is(separator, decimal, monkeypatch):
    """Columns at once give the numbers, texts and lines of the reading row by row."""
    text = LOG.format(separator) + "\n".join(rows(2000, separator, decimal)) + "\n"
    monkeypatch.setattr(long_table, "LONG", 30_000)
    quick, slow = long_table.long_sheet(text, "t.csv"), read_sheet(text, "t.csv")
    assert isinstance(quick.cells["COF"], NumberColumn)
    assert (list(quick.cells), quick.lines, quick.left_out) == (list(slow.cells), slow.lines, slow.left_out)
    for header, cells in slow.cells.items():
        if header == "Note":
            assert list(quick.cells[header]) == cells
        else:
            assert np.array_equal(values_of(quick.cells[header]), values_of(cells), equal_nan=True)


@pytest.mark.parametrize(
    "odd", ['"7",20,on,0.1', "7,20,on", "7,20,on,0.1,5", "7,2O,on,#DIV/0!", "mean,20,on,0.1", "# pause", "7,20,3,0.1"]
)
def test_a_long_table_with_an_odd_row_is_left_to_the_usual_reading(odd, monkeypatch):
    monkeypatch.setattr(long_table, "LONG", 30_000)
    lines = list(rows(2000, ",", "."))
    assert long_table.long_sheet(LOG.format(",") + "\n".join(lines), "t.csv") is not None
    assert long_table.long_sheet(LOG.format(",") + "\n".join([*lines[:900], odd, *lines[900:]]), "t.csv") is None
