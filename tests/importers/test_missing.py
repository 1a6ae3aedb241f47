"""Readings that a rig did not take: their rows are left out and said, in instrument files and in a case."""

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.wizard import run
from mixedlub.report.format_reference import kinds_text
from mixedlub.schema.findings import FindingWarning
from profiles.errors import InputError

FALLING_BODY = """# falling-body viscometer, sinker 6.30 mm
T (degC),pressure (bar),viscosity (Pa s),fall,remark
40,1,0.0078811,6.62,
40,500,0.022324,18.75,
75,1,@,2.71,stuck
75,500,0.0072074,6.05,
100,1,0.0020734,1.74,
"""
TOLD = {"kind": "viscosity", "import.columns.temperature_C": "T (degC)"}
DRIVE = "schema = 'mixedlub-case/1'\nkind = 'friction_map'\n[recording]\nquantity = 'friction_torque_Nm'\n"
ABSENT = ["", "n/a", "-", "NaN", "#N/A", "--"]


def said_of(path, out, told=TOLD):
    lines = []
    run([path], out, [f"{key}={value}" for key, value in told.items()], say=lines.append)
    return lines


@pytest.mark.parametrize("cell", ABSENT)
def test_a_row_without_its_reading_is_left_out_and_named(file, tmp_path, cell):
    said = said_of(file(FALLING_BODY.replace("@", cell)), tmp_path / "case")
    assert "caution: t.csv: 1 row left out, as 'viscosity (Pa s)' is missing: line 5" in said
    table = read_case(tmp_path / "case").recordings
    assert table["viscosity_mPa_s"].tolist() == [7.8811, 22.324, 7.2074, 2.0734]
    assert table["temperature_C"].tolist() == [40.0, 40.0, 75.0, 100.0]


def test_a_row_without_a_condition_is_left_out_too(file, tmp_path):
    text = FALLING_BODY.replace("@", "0.0032").replace("\n40,500,", "\n40,,").replace("\n100,1,", "\nn/a,1,")
    said = said_of(file(text), tmp_path / "case")
    assert "caution: t.csv: 1 row left out, as 'T (degC)' is missing: line 7" in said
    assert "caution: t.csv: 1 row left out, as 'pressure (bar)' is missing: line 4" in said
    assert len(read_case(tmp_path / "case").recordings) == 3


def test_from_python_rows_that_are_left_out_are_a_warning(file, tmp_path):
    with pytest.warns(FindingWarning, match="1 row left out, as 'viscosity"):
        import_files([file(FALLING_BODY.replace("@", "n/a"))], tmp_path / "case", **TOLD)


def test_run_numbers_stay_with_their_readings(file, tmp_path):
    text = "run,temperature_C,viscosity_mPa_s\n17,40,30\n4,60,-\n99,100,5\n"
    said_of(file(text), tmp_path / "case", {"kind": "viscosity"})
    assert read_case(tmp_path / "case").recordings["run"].tolist() == [17, 99]


def test_rows_of_separators_only_are_nothing(file, tmp_path):
    text = "temperature_C;viscosity_mPa_s\n40;30\n;\n100;5\n;\n;\n"
    said = said_of(file(text), tmp_path / "case", {"kind": "viscosity"})
    assert not any("left out" in line for line in said)


def test_a_column_that_holds_nothing_is_not_taken(file, tmp_path):
    text = "temperature_C,time_s,viscosity_mPa_s\n40,,30\n60,,12\n100,,5\n"
    said = said_of(file(text), tmp_path / "case", {"kind": "viscosity"})
    assert "t.csv: not taken: time_s" in said
    assert len(read_case(tmp_path / "case").recordings) == 3


def test_a_table_without_a_whole_row_is_refused(file, tmp_path):
    text = "temperature_C,viscosity_mPa_s\n40,n/a\n60,n/a\n,5\n"
    with pytest.raises(InputError, match="no row is complete: 'viscosity_mPa_s' is missing in 2 of them"):
        import_files([file(text)], tmp_path / "case", kind="viscosity")


def test_a_row_of_a_rheometer_without_its_reading_is_left_out(file, tmp_path):
    text = "[step]\nHold\nViscosity\tStep time\tTemperature\nPa.s\ts\tdegC\n1\t1\t20\n--\t2\t20\n3\t3\t20\n"
    said = said_of(file(text, "r.txt"), tmp_path / "case", {})
    assert "caution: r.txt: 1 row left out, as a value is missing: line 6" in said
    assert read_case(tmp_path / "case").recordings["time_s"].tolist() == [1.0, 3.0]


HEAD = "Step Time (s)\tBall Load (N)\tRolling Speed (mm/s)\tSRR (%)\tLube RTD Temp (degC)\tTraction Coeff (-)\tECR (%)"


def test_a_row_of_a_traction_rig_without_its_reading_is_left_out(file, tmp_path):
    rows = "".join(f"{i}\t30.1\t200\t50\t60.0\t{'' if i == 3 else f'0.0{i}'}\t\n" for i in range(1, 8))
    text = f"Step 1 started at 03/04/2021 09:20:00\nStep type\tBOD_TIMED\tStep description\trub\n{HEAD}\n{rows}\n"
    said = said_of(file(text, "m.txt"), tmp_path / "case", {})
    assert "caution: m.txt: 1 row left out, as 'Traction Coeff (-)' is missing: line 6" in said
    table = read_case(tmp_path / "case").recordings
    assert table["friction_coefficient"].tolist() == [0.01, 0.02, 0.04, 0.05, 0.06, 0.07]
    assert table["time_s"].tolist() == [1.0, 2.0, 4.0, 5.0, 6.0, 7.0]


def test_a_friction_of_zero_is_taken_and_named(file, tmp_path):
    """The first second of a rig may read 0; a reading near zero may be noise, so none is left out."""
    text = "Time [s];COF\n1;0\n2;0.11\n3;0.12\n4;-0.001\n5;0.11\n6;0.10\n"
    told = {"kind": "friction_history", "import.units.friction_coefficient": "-"}
    said = said_of(file(text), tmp_path / "case", told)
    assert "t.csv: 2 readings of friction_coefficient at zero or below, taken as read: lines 2, 5" in said
    table = read_case(tmp_path / "case").recordings
    assert table["friction_coefficient"].tolist() == [0.0, 0.11, 0.12, -0.001, 0.11, 0.1]
    assert "friction over load, positive but for noise" in " ".join(kinds_text("friction_history").split())


@pytest.mark.parametrize("quantity", ["friction_coefficient", "friction_torque_Nm"])
def test_friction_of_a_map_carries_the_sign_of_its_speed(file, tmp_path, quantity):
    text = f"speed_rpm,{quantity}\n-2,-0.11\n-1,-0.12\n1,0.1\n2,0.11\n3,0.1\n"
    told = {"kind": "friction_map", "recording.quantity": quantity}
    assert not any("zero or below" in line for line in said_of(file(text), tmp_path / "case", told))


def test_a_friction_of_a_traction_rig_that_is_zero_is_named_with_its_line(file, tmp_path):
    rows = "".join(f"{i}\t30.1\t200\t50\t60.0\t{0.0 if i == 3 else f'0.0{i}'}\t\n" for i in range(1, 8))
    text = f"Step 1 started at 03/04/2021 09:20:00\nStep type\tBOD_TIMED\tStep description\trub\n{HEAD}\n{rows}\n"
    said = said_of(file(text, "m.txt"), tmp_path / "case", {})
    assert "m.txt: 1 reading of friction_coefficient at zero or below, taken as read: line 6" in said
