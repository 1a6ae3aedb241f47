"""Tables as instruments leave them: with lines before and after, a line of units, decimal commas, a clock."""

import numpy as np
import pytest

from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.importers.text_table import read_sheet
from mixedlub.importers.vocabulary import BY_NAME, convert
from mixedlub.schema.units import split
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
    assert "lines 1 to 4 and line 9 left out" in " ".join(map(str, draft(InputFile("PIN.TSV", PIN), ANSWERS).notes))


def test_numbers_have_decimal_commas_and_the_clock_is_not_the_time():
    found = draft(InputFile("PIN.TSV", PIN), ANSWERS).columns
    assert np.allclose(found["time_s"], [6.0, 7.0, 8.5])
    assert np.allclose(found["load_N"], 59.841)


def test_headers_that_stand_twice_are_told_apart():
    assert {"Friction Force", "friction force #2"} <= set(read_sheet(PIN, "PIN.TSV").cells)


def test_a_line_of_units_belongs_to_the_header():
    text = "speed;friction torque\n1/min;[N.mm]\n100;250\n200;260\n"
    assert set(read_sheet(text, "drive.csv").cells) == {"speed (1/min)", "friction torque (N.mm)"}
    found = draft(
        InputFile("drive.csv", text), {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
    ).columns
    assert found["speed_rpm"].tolist() == [100.0, 200.0]
    assert np.allclose(found["friction_torque_Nm"], [0.25, 0.26])


CHANNELS = """Timestamp,2020-01-02 10:00:00,Timestamp,2020-01-02 10:00:00
Interval,0.5,Interval,0.5
Channel name,"Friction coefficient",Channel name,"Strain gauge"
Unit,"-",Unit,"V"
0,0.11,0,3.1
0.5,0.12,0.5,3.2
1.0,0.11,1.0,3.1
"""


def test_channels_with_lines_of_names_and_units_are_read():
    told = {"kind": "friction_history", "import.units.time_s": "s"}
    found = draft(InputFile("scope.csv", CHANNELS), told)
    assert set(read_sheet(CHANNELS, "scope.csv").cells) == {
        "Time",
        "Friction coefficient (-)",
        "time #2",
        "Strain gauge (V)",
    }
    assert found.columns["time_s"].tolist() == [0.0, 0.5, 1.0]
    assert found.columns["friction_coefficient"].tolist() == [0.11, 0.12, 0.11]


@pytest.mark.parametrize("first", ["Oil,20,40,60", "Oil,Sort,0,20,40,60,Source"])
def test_a_table_whose_header_holds_numbers_seems_to_be_turned(first):
    width = first.count(",")
    text = f"{first}\nA{',' * (width - 2)},9,1\nB{',' * (width - 2)},8,2\n"
    with pytest.raises(InputError) as caught:
        read_sheet(text, "wide.csv")
    assert caught.value.where == "wide.csv: line 1"
    assert "seems to be turned: each quantity, such as the temperature, must have one column" in str(caught.value)


def test_rows_with_a_clock_or_a_name_may_have_no_header():
    with pytest.raises(InputError, match="seems to be turned, or has no header: each quantity"):
        read_sheet("12:00:01,20,90,30\n12:00:02,21,91,30\n", "log.csv")


def test_two_lines_of_numbers_may_be_a_turned_table():
    with pytest.raises(InputError, match="if they are values of a quantity, turn the table"):
        read_sheet("0,20,40\n90,30,12\n", "wide.csv")


def test_a_row_of_another_length_amid_rows_is_an_error():
    text = "time_s,friction_coefficient\n1,0.1\n2,0.1,3\n3,0.1\n4,0.1\n"
    with pytest.raises(InputError, match=r"t\.csv: line 3: has not as many cells as the header \(2\)"):
        read_sheet(text, "t.csv")


@pytest.mark.parametrize(("unit", "factor"), [("N mm", 1e-3), ("Nmm", 1e-3), ("N·m", 1.0), ("kNm", 1e3), ("Ncm", 0.01)])
def test_torques_are_converted_from_their_unit(unit, factor):
    text = f"speed_rpm,friction torque ({unit})\n100,250\n200,260\n"
    found = draft(
        InputFile("t.csv", text), {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
    ).columns
    assert np.allclose(found["friction_torque_Nm"], [250 * factor, 260 * factor])


def test_an_unknown_unit_is_told_the_nearest_as_it_is_written():
    text = "speed_rpm,friction torque (Nk)\n100,250\n200,260\n"
    with pytest.raises(InputError, match=r"unit of friction_torque_Nm is not known.*N\.m"):
        draft(InputFile("t.csv", text), {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"})


def test_lines_of_remarks_with_as_many_cells_are_no_header():
    text = "Operator;J\nDate;2020\nSpeed (rpm);Friction torque (N m)\n1;2\n2;3\n"
    assert list(read_sheet(text, "t.csv").cells) == ["Speed (rpm)", "Friction torque (N m)"]


TWO_TABLES = "a,b\n1,2\n3,4\nc,d\n1,2\n3,4\n5,6\n"


@pytest.mark.parametrize(
    ("number", "headers", "lines"), [(None, "cd", (5, 6, 7)), (1, "ab", (2, 3)), (2, "cd", (5, 6, 7))]
)
def test_of_two_tables_in_a_file_the_longest_or_the_numbered_one_is_read(number, headers, lines):
    found = read_sheet(TWO_TABLES, "t.csv", number=number)
    assert (list(found.cells), found.lines) == (list(headers), lines)
    assert found.tables == ("lines 2 to 3: a, b", "lines 5 to 7: c, d")


def test_a_number_beyond_the_tables_is_refused():
    with pytest.raises(InputError, match=r"import\.table: 3: must be a table of t\.csv, from 1 to 2"):
        read_sheet(TWO_TABLES, "t.csv", number=3)


def test_a_single_row_beside_a_table_is_refused():
    with pytest.raises(InputError, match="begins another table"):
        read_sheet("a,b\n1,2\n3,4\nc,d\n1,2\n", "t.csv")


CALIBRATED = """Sample;12
Point;Force (N);Signal (mV)
1;10;1.02
2;20;2.03
3;30;3.01
4;40;4.02

Time (s);Friction coefficient (-)
0;0.11
1;0.12
2;0.13
"""


def test_of_two_tables_the_one_with_a_reading_is_read_and_the_other_named():
    found = draft(InputFile("t.csv", CALIBRATED), {"kind": "friction_history"})
    assert found.columns["friction_coefficient"].tolist() == [0.11, 0.12, 0.13]
    assert any("not 1 (lines 3 to 6: Point, Force (N), Signal (mV))" in note.text for note in found.notes)


def test_two_tables_with_readings_are_a_question():
    text = CALIBRATED.replace("Force (N);Signal (mV)", "Load (N);COF (-)")
    (question,) = (q for q in draft(InputFile("t.csv", text), {}).questions if q.key == "import.table")
    assert (question.needed, question.example) == (True, "1")
    told = {"kind": "friction_history", "import.table": 2}
    assert draft(InputFile("t.csv", text), told).columns["friction_coefficient"].size == 3


def test_a_header_in_quotes_over_lines_without_rows_is_refused():
    with pytest.raises(InputError, match="at least one row"):
        read_sheet('Speed (rpm),"Friction torque (Nm)\nchannel 2"\n', "t.csv")


@pytest.mark.parametrize(("header", "column"), [("Pressure (mPa)", "pressure_MPa"), ("Load (MN)", "load_N")])
def test_milli_is_not_mega(header, column):
    with pytest.raises(InputError, match=f"unit of {column} is not known"):
        convert(np.array([1.0]), split(header)[1], BY_NAME[column], "t.csv")


@pytest.mark.parametrize("text", ["", "\n\n", "# only a comment\n"])
def test_a_file_without_rows_is_refused(text):
    with pytest.raises(InputError, match=r"film.txt: needs a header line and at least one row"):
        read_sheet(text, "film.txt")


def test_a_table_without_a_header_is_refused():
    with pytest.raises(InputError, match="no header: the first line holds numbers only"):
        read_sheet("0.02\t44.1\n0.04\t58.8\n0.08\t79.7\n", "film.txt")


DRIVE = """Prüfstand;GP-04;Bediener;Müller
Datum;12.03.2020;;

Messung;Drehzahl;Reibmoment;Öltemperatur;;Bemerkung
Nr.;1/min;Nm;°C;;
1;5,0;1,5291;35,0;;
2;10,0;1,4596;35,1;;
3;-5,0;-1,5359;35,3;;Wiederholung
"""


def test_a_line_of_units_may_number_the_rows():
    headers = ["Messung (Nr.)", "Drehzahl (1/min)", "Reibmoment (Nm)", "Öltemperatur (°C)", "Bemerkung"]
    assert list(read_sheet(DRIVE, "drive.csv").cells) == headers


def test_a_line_of_units_may_hold_one_that_is_new():
    text = "Zeit;Drehzahl;Moment;Frequenz\ns;1/min;Nm;Hz\n1;300;5;50\n2;310;6;50\n"
    headers = ["Zeit (s)", "Drehzahl (1/min)", "Moment (Nm)", "Frequenz (Hz)"]
    assert list(read_sheet(text, "t.csv").cells) == headers
    few = "Lauf;Drehzahl;Moment\nNr.;1/min;Nm\n1;300;5\n2;310;6\n"
    assert list(read_sheet(few, "t.csv").cells) == ["Lauf (Nr.)", "Drehzahl (1/min)", "Moment (Nm)"]


def test_a_header_of_short_names_under_a_title_is_no_line_of_units():
    text = "Test 12;steel;oil B\nN;K;T\n1;300;5\n2;310;6\n"
    assert list(read_sheet(text, "t.csv").cells) == ["N", "K", "T"]


DISCS = """Twin-disc rig  test 0415   oil: FVA3
   Zeit    Fn     v1      v2     Toel    mu
    [s]   [kN]   [m/s]   [m/s]   [C]     [-]
     30   1.50   2.020   1.980   60.3  0.02531
     60   1.50   2.050   1.950   59.7  0.03082
     90   1.50   2.100   1.900   59.8  0.03468
"""


def test_columns_may_stand_between_blanks():
    sheet = read_sheet(DISCS, "discs.dat")
    assert list(sheet.cells) == ["Zeit (s)", "Fn (kN)", "v1 (m/s)", "v2 (m/s)", "Toel (C)", "mu (-)"]
    assert sheet.cells["mu (-)"] == ["0.02531", "0.03082", "0.03468"]
    assert sheet.lines == (4, 5, 6)
    assert sheet.left_out == "line 1"


@pytest.mark.parametrize(
    "header",
    ["Time Load mu", "Time (s) Load (N) mu (-)", "Test time (s)   Ball load (N)   Friction  ", "Time(s)\tLoad\t mu"],
)
@pytest.mark.parametrize("row", ["1 20 0.05", "  1.5   20.25   0.05", "1,5  20,25\t0,05"])
def test_headers_between_blanks_may_have_units_and_several_words(header, row):
    sheet = read_sheet(f"rig 4, oil B\n\n{header}\n{row}\n{row.replace('20', '40')}\n", "t.txt")
    assert len(sheet.cells) == 3
    assert [float(cell) for cell in list(sheet.cells.values())[2]] == [0.05, 0.05]
    assert len(sheet.lines) == 2


@pytest.mark.parametrize(
    "text",
    [
        "speed, torque, note\n1, 2, a b\n2, 3, c d\n",
        "recorded\tspeed\ttorque\n2020-07-08 21:10:11\t1\t2\n2020-07-08 21:10:12\t2\t3\n",
        "speed;torque;remark\n1,5;2,5;1 2 3 4\n2,5;3,5;5 6 7 8\n",
        '"a","b","c"\n"1,5","2,5","3"\n"2,5","3,5","4"\n',
    ],
)
def test_blanks_within_cells_part_nothing_where_a_mark_does(text):
    assert len(read_sheet(text, "t.txt").cells) == 3


def test_a_quoted_cell_over_two_lines_is_kept_and_an_open_quote_is_refused():
    rows = 'speed_rpm,surface,friction\n100,polished,0.05\n200,"ground\na",0.04\n300,honed,0.03\n'
    assert read_sheet(rows, "rig.csv").cells["surface"] == ["polished", "ground a", "honed"]
    with pytest.raises(InputError, match=r"line 3: .*a quoted cell must end in its line"):
        read_sheet(rows.replace('a"', "a"), "rig.csv")


def test_a_stroke_between_digits_is_no_number():
    sheet = read_sheet("speed_rpm;load_N;friction\n100;20;0.05\n200;20;1_7.49\n300;20;0.03\n", "rig.csv")
    assert not sheet.cells["friction"].numeric
    assert np.isnan(sheet.cells["friction"].values[1])
