"""Files of another form than expected: what is there is named, with the way on."""

import gzip
import shlex
import shutil
import zipfile
from pathlib import Path

import openpyxl
import pytest

from mixedlub.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
TRACE = "x (um),z (um)\n" + "".join(f"{0.5 * i},{(i * 7919) % 13 / 10}\n" for i in range(4000))


def refused(capsys, *words):
    assert main([str(word) for word in words]) == 2
    return capsys.readouterr().err


def test_compressed_recordings_of_a_case_are_named_with_the_command_that_imports_them(tmp_path, capsys):
    case = shutil.copytree(EXAMPLES / "case", tmp_path / "my case")
    table = (case / "recordings.csv").read_bytes()
    (case / "recordings.csv").unlink()
    (case / "recordings.csv.gz").write_bytes(gzip.compress(table))
    assert "recordings.csv.gz is there" in refused(capsys, "diagnose", case, "--out", tmp_path / "o")
    assert main(["check", str(case)]) == 0
    command = capsys.readouterr().out.split("recordings.csv.gz is there, and `")[1].split("`")[0]
    assert main(shlex.split(command)[1:]) == 0
    assert main(["check", str(case)]) == 0
    assert "recordings.csv: 72 rows." in capsys.readouterr().out


def test_a_folder_that_is_no_case_is_not_said_to_be_missing(tmp_path, capsys):
    told = refused(capsys, "check", EXAMPLES)
    assert "is a folder without system.toml, so no case; cases in it: case" in told
    assert "`mixedlub new case` writes one" in refused(capsys, "check", tmp_path)
    assert "no such case folder" in refused(capsys, "check", tmp_path / "nowhere")
    shutil.copytree(EXAMPLES / "case", tmp_path / ".writing-31534")
    assert "`mixedlub new case` writes one" in refused(capsys, "check", tmp_path)


def test_a_folder_named_as_a_trace_is_said_to_be_one(tmp_path, capsys):
    case = shutil.copytree(EXAMPLES / "case", tmp_path / "case")
    text = (case / "system.toml").read_text(encoding="utf-8")
    (case / "system.toml").write_text(text.replace("m0_um2 = 0.13\nm2 = 0.0026\nm4_per_um2 = 0.0038", 'profile = "."'))
    assert "'.': is a folder; name a file in it" in refused(capsys, "check", case)


@pytest.mark.parametrize("name", ["bad.x3p", "bad.xlsx"])
@pytest.mark.parametrize("head", [b"PK\x03\x04", b"PK\x03\x04\0\0"])
def test_a_damaged_archive_is_called_so(name, head, tmp_path, capsys):
    file = tmp_path / name
    file.write_bytes(head + bytes(range(1, 256)) * 20)
    assert "damaged or unsupported zip archive" in refused(capsys, "profile", file, "--out", tmp_path / "o")
    assert "damaged or unsupported zip archive" in refused(capsys, "import", file, "--out", tmp_path / "o")


def test_an_empty_archive_is_called_so(tmp_path, capsys):
    with zipfile.ZipFile(tmp_path / "none.zip", "w"):
        pass
    assert "unsupported zip archive" in refused(capsys, "profile", tmp_path / "none.zip", "--out", tmp_path / "o")


def test_a_workbook_of_recordings_is_no_trace(tmp_path, capsys):
    book = openpyxl.Workbook()
    for row in [("run", "surface", "loss"), (1, "ground", 20.5), (2, "ground", 21.5)]:
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    told = refused(capsys, "profile", tmp_path / "rig.xlsx", "--out", tmp_path / "o")
    assert "sheet 'Sheet': is no trace" in told


@pytest.mark.parametrize("name", ["trace.txt.gz", "trace.csv.GZ"])
def test_a_compressed_trace_is_read_under_its_name(name, tmp_path, capsys):
    (tmp_path / name).write_bytes(gzip.compress(TRACE.encode()))
    assert main(["profile", str(tmp_path / name), "--out", str(tmp_path / "o")]) == 0
    assert (tmp_path / "o" / "figures" / "trace_abbott.svg").is_file()
    (tmp_path / name).write_bytes(gzip.compress(TRACE.encode())[:-20])
    assert "damaged gzip file" in refused(capsys, "profile", tmp_path / name, "--out", tmp_path / "o")


@pytest.mark.parametrize(
    "words",
    [
        ["study", EXAMPLES / "study_21_pairings.toml"],
        ["profile", "shipped:0258"],
        ["diagnose", EXAMPLES / "case"],
        ["simulate", EXAMPLES / "case"],
        ["import", EXAMPLES / "case" / "recordings.csv"],
        ["new", "case"],
        ["prove"],
    ],
    ids=lambda words: words[0],
)
def test_an_empty_out_is_refused(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "'--out': must name a folder" in refused(capsys, *words, "--out", "")
    assert not list(tmp_path.iterdir())
