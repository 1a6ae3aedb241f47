"""Results appear whole or not at all."""

import subprocess
import sys

import pytest

from mixedlub.commands.output import output_folder
from mixedlub.writing import writing
from profiles.errors import InputError


def test_folder_is_replaced_as_a_whole(tmp_path):
    (tmp_path / "figures").mkdir()
    (tmp_path / "figures" / "old.svg").write_text("<dc:title>mixedlub</dc:title>")
    with writing(tmp_path) as aside:
        (aside / "figures").mkdir()
        (aside / "figures" / "new.svg").write_text("new")
    assert [p.name for p in (tmp_path / "figures").iterdir()] == ["new.svg"]
    assert [p.name for p in tmp_path.iterdir()] == ["figures"]


def test_failure_while_writing_leaves_what_was_there(tmp_path):
    (tmp_path / "table.csv").write_text("old")

    def fail():
        with writing(tmp_path) as aside:
            (aside / "table.csv").write_text("half")
            raise RuntimeError("full disk")

    with pytest.raises(RuntimeError):
        fail()
    assert (tmp_path / "table.csv").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["table.csv"]


def test_leavings_of_a_dead_process_are_cleared_and_of_a_living_one_kept(tmp_path):
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    (tmp_path / f".writing-{dead.pid}").mkdir()
    (tmp_path / ".writing-1").mkdir()
    with writing(tmp_path):
        pass
    assert [p.name for p in tmp_path.iterdir()] == [".writing-1"]


def test_default_folder_is_named_after_command_and_input(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert output_folder(None, "study", "mine").resolve() == tmp_path / "out" / "study" / "mine"


def test_a_default_folder_with_a_result_is_said_to_be_replaced(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    folder = output_folder(None, "study", "mine")
    (folder / ".parts-1").mkdir()
    output_folder(None, "study", "mine")
    assert capsys.readouterr().err == ""
    (folder / "results.csv").write_text("")
    output_folder(folder, "study", "mine")
    assert capsys.readouterr().err == ""
    output_folder(None, "study", "mine")
    assert "the result in out/study/mine, maybe of another input of that name, is replaced" in capsys.readouterr().err


def test_folder_that_cannot_be_is_bad_input(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="--out"):
        output_folder(tmp_path / "file" / "below", "study", "mine")
