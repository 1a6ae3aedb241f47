"""Files that are no plain text in UTF-8: workbooks, compressed tables, UTF-16."""

import gzip
import io

import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.input_file import open_file
from profiles.errors import InputError

TABLE = "Temperature (degC),Viscosity (mPa.s)\n40,30.5\n60,12\n100,4.75\n"
ROWS = [["Temperature (degC)", "Viscosity (mPa.s)"], [40, 30.5], [60, 12], [100, 4.75]]


def viscosities(path, tmp_path, **told):
    table = read_case(import_files([path], tmp_path / "case", kind="viscosity", **told)).recordings
    return list(zip(table["temperature_C"].tolist(), table["viscosity_mPa_s"].tolist(), strict=True))


EXPECTED = [(40.0, 30.5), (60.0, 12.0), (100.0, 4.75)]


def test_the_sheet_with_the_longest_table_is_read_and_named(book, tmp_path, capsys):
    path = book(About=[["Operator", "Meyer"], ["Room", 12]], Data=[["Rig 4", None], [], *ROWS], Short=ROWS[:2])
    assert viscosities(path, tmp_path) == EXPECTED
    main(["import", str(path), "--out", str(tmp_path / "b"), "--set", "kind=viscosity"])
    assert "t.xlsx: sheet 'Data' is read, not 'About', 'Short'" in capsys.readouterr().out


def test_another_sheet_is_read_where_it_is_named(book, tmp_path):
    other = [ROWS[0], [20, 90], [30, 50]]
    path = book(Data=ROWS, Cold=other)
    assert viscosities(path, tmp_path, **{"import.sheet": "Cold"}) == [(20.0, 90.0), (30.0, 50.0)]
    words = ["import", str(path), "--out", str(tmp_path / "b"), "--set", "kind=viscosity", "--sheet", "Cold"]
    assert main(words) == 0
    assert len(read_case(tmp_path / "b").recordings) == 2


def test_a_sheet_that_is_not_there_is_refused(book, file, tmp_path):
    with pytest.raises(InputError, match=r"import\.sheet: 'Dat': no such sheet in t\.xlsx; nearest known: 'Data'"):
        viscosities(book(Data=ROWS), tmp_path, **{"import.sheet": "Dat"})
    with pytest.raises(InputError, match=r"import\.sheet: 'Data': none of the files has several tables"):
        viscosities(file(TABLE), tmp_path, **{"import.sheet": "Data"})


def test_missing_cells_of_a_workbook_leave_their_rows_out(book, tmp_path):
    path = book(Data=[*ROWS[:2], [50, None], *ROWS[2:]])
    with pytest.warns(UserWarning, match="line 3"):
        assert viscosities(path, tmp_path) == EXPECTED


def test_numbers_that_the_workbook_shows_in_percent_are_reported(book):
    rows = [["SRR", "COF"], [0.05, 0.04], [0.1, 0.05]]
    (note,) = open_file(book(Data=rows, formats={"A2": "0%", "A3": "0%"}), {}).notes
    assert note.code == "percent_as_stored"
    assert "column A " in note.text


@pytest.mark.parametrize(
    "data",
    [
        gzip.compress(TABLE.encode()),
        TABLE.encode("utf-16"),
        TABLE.encode("utf-16-le"),
        TABLE.encode("utf-16-be"),
        gzip.compress(TABLE.replace(",", ";").encode("utf-16")),
    ],
    ids=["gzip", "utf-16", "utf-16-le", "utf-16-be", "gzip of utf-16"],
)
def test_compressed_tables_and_utf_16_are_read(data, tmp_path):
    path = tmp_path / "t.csv.gz"
    path.write_bytes(data)
    assert viscosities(path, tmp_path) == EXPECTED


def test_a_compressed_workbook_is_read(book, tmp_path):
    path = tmp_path / "t.xlsx.gz"
    path.write_bytes(gzip.compress(book(Data=ROWS).read_bytes()))
    assert viscosities(path, tmp_path, **{"import.sheet": "Data"}) == EXPECTED


@pytest.mark.parametrize(("cut", "rule"), [(20, "damaged gzip file"), (-4, "damaged gzip file")])
def test_a_damaged_gzip_file_is_refused(cut, rule, tmp_path):
    (tmp_path / "t.csv.gz").write_bytes(gzip.compress(TABLE.encode())[:cut])
    with pytest.raises(InputError, match=rule):
        open_file(tmp_path / "t.csv.gz", {})


def test_a_gzip_file_that_unpacks_without_end_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("mixedlub.importers.input_file.MAX_BYTES", 10_000)
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb") as file:
        file.write(bytes(20_000))
    (tmp_path / "t.gz").write_bytes(packed.getvalue())
    with pytest.raises(InputError, match="unpacks to more than 10000 bytes"):
        open_file(tmp_path / "t.gz", {})


@pytest.mark.parametrize("data", [b"\x89PNG\r\n" + bytes(range(256)) * 8, bytes(3000)], ids=["picture", "zeros"])
def test_what_is_no_text_is_refused(data, tmp_path):
    (tmp_path / "t.dat").write_bytes(data)
    with pytest.raises(InputError, match="is not a text file or workbook"):
        open_file(tmp_path / "t.dat", {})


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ('{\n  "oil": "A",\n  "temperature_C": [20, 40]\n}\n', "JSON"),
        ('[{"temperature_C": 20, "viscosity_mPa_s": 90}]', "JSON"),
        ("<!DOCTYPE html>\n<html><body>20,90</body></html>\n", "HTML or XML"),
        ("\n<HTML><body>20,90</body></HTML>\n", "HTML or XML"),
        ('<?xml version="1.0"?>\n<data>20,90</data>\n', "HTML or XML"),
    ],
)
def test_a_format_without_a_table_is_named_with_those_that_are_read(text, form, tmp_path):
    (tmp_path / "oil.json").write_text(text)
    with pytest.raises(InputError) as caught:
        open_file(tmp_path / "oil.json", {})
    assert str(caught.value).startswith(f"oil.json: is {form}, which is no table; import reads text with a header line")
    assert ".csv, .txt" in str(caught.value)


def test_a_header_may_begin_with_a_bracket(tmp_path):
    (tmp_path / "t.csv").write_text("[1] temperature_C,viscosity_mPa_s\n20,90\n")
    assert open_file(tmp_path / "t.csv", {}).table().lines == (2,)


def test_a_header_in_angle_brackets_is_no_markup(tmp_path):
    (tmp_path / "t.csv").write_text("<Time>,COF\n1,0.1\n2,0.2\n")
    assert list(open_file(tmp_path / "t.csv", {}).table().cells) == ["<Time>", "COF"]
