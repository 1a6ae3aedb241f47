"""Tables as instruments leave them: with lines before and after, a line of units, decimal commas, a clock."""

import numpy as np
import pytest

from mixedlub.headers import BY_NAME, convert, split
from mixedlub.importers.plain import draft
from mixedlub.importers.sheet import read_sheet
from profiles.errors import InputError

PIN = """Data file\t\tPIN.TSV
Calibration file\t\tCELL.CAL
160210\t\t
Test started at 20:32:15
\tTime\tTest Time\tLoad\tFriction Force\tFriction Coefficient\tFriction Force
\t20:32:21\t6,\t59,841\t7,6\t0,126206\t7,6
\t20:32:22\t7,\t59,841\t7,5\t0,125100\t7,5
\t20:32:23\t8,5\t59,841\t7,4\t0,124000\t7,4
Test completed at 21:02:28
"""
ANSWERS = {
    "kind": "friction_history",
    "recording.quantity": "friction_coefficient",
    "import.units.time_s": "s",
    "import.units.load_N": "N",
    "import.units.friction_coefficient": "-",
}


def test_lines_before_and_after_the_table_are_left_out_and_said():
    sheet = read_sheet(PIN, "PIN.TSV")
    assert sheet.left_out == "lines 1 to 4 and line 9"
    assert sheet.lines == (6, 7, 8)
    assert "lines 1 to 4 and line 9 left out" in " ".join(draft(PIN, "PIN.TSV", ANSWERS).notes)


def test_numbers_have_decimal_commas_and_the_clock_is_not_the_time():
    found = draft(PIN, "PIN.TSV", ANSWERS).columns
    assert np.allclose(found["time_s"], [6.0, 7.0, 8.5])
    assert np.allclose(found["load_N"], 59.841)


def test_headers_that_stand_twice_are_told_apart():
    assert {"Friction Force", "friction force #2"} <= set(read_sheet(PIN, "PIN.TSV").cells)


def test_a_line_of_units_belongs_to_the_header():
    text = "speed;friction torque\n1/min;[N.mm]\n100;250\n200;260\n"
    assert set(read_sheet(text, "drive.csv").cells) == {"speed (1/min)", "friction torque (N.mm)"}
    found = draft(text, "drive.csv", {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}).columns
    assert found["speed_rpm"].tolist() == [100.0, 200.0]
    assert np.allclose(found["friction_torque_Nm"], [0.25, 0.26])


def test_a_row_of_another_length_amid_rows_is_an_error():
    text = "time_s,friction_coefficient\n1,0.1\n2,0.1,3\n3,0.1\n4,0.1\n"
    with pytest.raises(InputError, match=r"t\.csv: line 3: has not as many cells as the header \(2\)"):
        read_sheet(text, "t.csv")


@pytest.mark.parametrize(("unit", "factor"), [("N mm", 1e-3), ("Nmm", 1e-3), ("N·m", 1.0), ("kNm", 1e3), ("Ncm", 0.01)])
def test_torques_are_converted_from_their_unit(unit, factor):
    text = f"speed_rpm,friction torque ({unit})\n100,250\n200,260\n"
    found = draft(text, "t.csv", {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}).columns
    assert np.allclose(found["friction_torque_Nm"], [250 * factor, 260 * factor])


def test_an_unknown_unit_is_told_the_nearest_as_it_is_written():
    text = "speed_rpm,friction torque (Nk)\n100,250\n200,260\n"
    with pytest.raises(InputError, match=r"unit of friction_torque_Nm is not known.*N\.m"):
        draft(text, "t.csv", {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"})


def test_lines_of_remarks_with_as_many_cells_are_no_header():
    text = "Operator;J\nDate;2020\nSpeed (rpm);Friction torque (N m)\n1;2\n2;3\n"
    assert list(read_sheet(text, "t.csv").cells) == ["Speed (rpm)", "Friction torque (N m)"]


def test_two_tables_in_a_file_are_refused():
    text = "a,b\n1,2\n3,4\nc,d\n1,2\n3,4\n5,6\n"
    with pytest.raises(InputError, match=r"lines 2 to 3: holds other rows of numbers before its longest table"):
        read_sheet(text, "t.csv")


def test_a_header_in_quotes_over_lines_without_rows_is_refused():
    with pytest.raises(InputError, match="at least one row"):
        read_sheet('Speed (rpm),"Friction torque (Nm)\nchannel 2"\n', "t.csv")


@pytest.mark.parametrize(("header", "column"), [("Pressure (mPa)", "pressure_MPa"), ("Load (MN)", "load_N")])
def test_milli_is_not_mega(header, column):
    with pytest.raises(InputError, match=f"unit of {column} is not known"):
        convert(np.array([1.0]), split(header)[1], BY_NAME[column], "t.csv")


def test_a_table_without_a_header_is_refused():
    with pytest.raises(InputError, match="no header: the first line holds numbers only"):
        read_sheet("0.02\t44.1\n0.04\t58.8\n0.08\t79.7\n", "film.txt")
