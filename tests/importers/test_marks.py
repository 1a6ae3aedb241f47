"""Commas and points in numbers: only what the whole file proves decides, and what it leaves open is refused."""

import pytest

from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.text_table import read_sheet
from profiles.errors import InputError

THOUSANDS = "speed_rpm\tfriction_torque_Nm\n2,000\t17.50\n4,000\t18.25\n1000\t16\n"
OPEN = "speed_rpm\tfriction_torque_Nm\n2,000\t17\n4,000\t18\n1000\t16\n"


def speeds(text, decimal=None):
    return [float(cell) for cell in read_sheet(text, "t.txt", decimal).cells["speed_rpm"]]


def test_a_point_before_decimals_makes_a_comma_part_thousands():
    assert speeds(THOUSANDS) == [2000.0, 4000.0, 1000.0]


def test_a_comma_before_decimals_makes_a_point_part_thousands():
    assert speeds(OPEN.replace(",", ".").replace("17", "17,5")) == [2000.0, 4000.0, 1000.0]


@pytest.mark.parametrize("proof", ["17,5", "0,125", "17,5000", "1.234,5", "1,5e3", "1.234.567"])
def test_one_number_that_proves_a_decimal_comma_is_enough(proof):
    assert speeds(OPEN.replace("17", proof)) == [2.0, 4.0, 1000.0]


@pytest.mark.parametrize("proof", ["17.5", "0.125", "17.5000", "1,234.5", "1.5e3", "1,234,567"])
def test_one_number_that_proves_a_decimal_point_is_enough(proof):
    assert speeds(OPEN.replace("17", proof)) == [2000.0, 4000.0, 1000.0]


@pytest.mark.parametrize("separator", ["\t", ";"])
def test_where_nothing_tells_the_first_open_number_is_refused_with_both_readings(separator):
    with pytest.raises(InputError) as caught:
        read_sheet(OPEN.replace("\t", separator), "t.txt")
    said = str(caught.value)
    assert said.startswith("t.txt: line 2: '2,000': could be 2000 or 2.000")
    assert 'import.decimal="."\' for 2000' in said
    assert 'import.decimal=","\' for 2.000' in said


def test_a_quoted_number_among_commas_is_no_other_matter():
    text = 'speed_rpm,friction_torque_Nm\n"2,000",17\n"4,000",18\n'
    with pytest.raises(InputError, match="could be 2000 or"):
        read_sheet(text, "t.csv")
    assert speeds(text, ".") == [2000.0, 4000.0]


def test_the_answer_decides():
    assert speeds(OPEN, ".") == [2000.0, 4000.0, 1000.0]
    assert speeds(OPEN, ",") == [2.0, 4.0, 1000.0]


def test_an_answer_that_a_number_contradicts_is_refused_with_its_line():
    with pytest.raises(InputError, match=r"t\.txt: line 2: '17\.50': is no number with ',' as decimal mark"):
        read_sheet(THOUSANDS, "t.txt", ",")


def test_a_file_with_both_marks_before_decimals_is_refused():
    text = "speed_rpm;friction_torque_Nm\n17,5;1\n3;2.25\n"
    with pytest.raises(InputError, match=r"line 2: '17,5': has a decimal comma, line 3 has a decimal point"):
        read_sheet(text, "t.csv")


def test_points_alone_stand_before_decimals():
    assert speeds("speed_rpm,friction_torque_Nm\n1.234,2\n5.678,3\n") == [1.234, 5.678]


def test_lines_around_the_table_do_not_overrule_it():
    text = "Firmware;2.14\nspeed_rpm;friction_torque_Nm;note\n17,5;1;a\n3,25;2;b\n"
    assert speeds(text) == [17.5, 3.25]


def test_commas_within_headers_part_nothing():
    sheet = read_sheet("Speed, rpm\tTorque, Nm\n2,5\t17,5\n4,5\t18,5\n", "t.txt")
    assert dict(sheet.cells) == {"Speed, rpm": ["2.5", "4.5"], "Torque, Nm": ["17.5", "18.5"]}


def test_labels_prove_no_mark_and_stay_as_they_are():
    text = "sample\tspeed_rpm\tfriction_torque_Nm\n1.2\t1,250\t17\nB2\t2,250\t18\nC\t1000\t16\n"
    with pytest.raises(InputError, match="'1,250': could be 1250 or"):
        read_sheet(text, "t.txt")
    sheet = read_sheet(text, "t.txt", ",")
    assert sheet.cells["sample"] == ["1.2", "B2", "C"]
    assert sheet.cells["speed_rpm"] == ["1.250", "2.250", "1000"]


def test_on_the_command_line_too(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.txt").write_text(OPEN, encoding="utf-8")
    words = ["import", "t.txt", "--out", "rig", "--set", "kind=friction_map", "--set"]
    words.append("recording.quantity=friction_torque_Nm")
    assert main(words) == 2
    assert "t.txt: line 2: '2,000'" in capsys.readouterr().err
    assert not (tmp_path / "rig").exists()
    assert main([*words, "--set", 'import.decimal="."']) == 0
    assert (tmp_path / "rig/recordings.csv").read_text(encoding="utf-8").splitlines()[1] == "1,2000,17"


def test_another_answer_than_a_mark_is_refused(tmp_path):
    path = tmp_path / "t.txt"
    path.write_text(OPEN, encoding="utf-8")
    with pytest.raises(InputError, match=r"import\.decimal: 'comma': must be '\.' or ','"):
        import_files([path], tmp_path / "rig", kind="friction_map", **{"import.decimal": "comma"})


def test_a_cell_of_the_other_mark_than_the_answer_is_refused():
    with pytest.raises(InputError, match=r"line 2: '1,500\.0': .*',' as decimal mark"):
        read_sheet("a\tb\n1,500.0\t1,5\n1,600.0\t2,5\n", "t.txt", ",")


def test_thousands_that_other_numbers_prove_are_reported(file, tmp_path):
    """'1,000' beside '0.10' is read as 1000, and the note says so."""
    text = "time (s)\tfriction_coefficient\n1\t0.10\n1,000\t0.11\n2,000\t0.12\n"
    (note,) = read_sheet(text, "t.txt").notes
    assert note.startswith("line 3: '1,000' is read as 1000")
    assert "'0.10'" in note
    with pytest.warns(UserWarning, match="read as 1000"):
        import_files([file(text, "t.txt")], tmp_path / "a", kind="friction_history")
    import_files([file(text, "t.txt")], tmp_path / "b", kind="friction_history", **{"import.decimal": "."})


@pytest.mark.parametrize("cell", ["1,234,567", "1,234.5", "2000"])
def test_thousands_that_prove_themselves_are_not(cell):
    assert read_sheet(f"a\tb\n{cell}\t0.10\n2\t0.11\n", "t.txt").notes == ()
