"""Results appear whole or not at all."""

import subprocess
import sys
from pathlib import Path

import pytest

from mixedlub.cli import main
from mixedlub.commands.console import output_folder
from mixedlub.running.atomic import writing
from profiles.errors import InputError

EXAMPLES = Path(__file__).parents[2] / "examples"


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


def test_folder_that_cannot_be_is_bad_input(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="--out"):
        output_folder(tmp_path / "file" / "below", "study", "mine")


@pytest.fixture
def interrupted(monkeypatch):
    """A function of a module that Ctrl-C stops while it runs, after what it did first."""

    def stop(place, first=lambda *args: None):
        def stopped(*args, **named):
            first(*args)
            raise KeyboardInterrupt

        monkeypatch.setattr(place, stopped)

    return stop


def test_ctrl_c_leaves_no_empty_folder_and_says_that_nothing_was_written(tmp_path, interrupted, capsys):
    interrupted("mixedlub.diagnosis.diagnose.diagnose_case")
    assert main(["diagnose", str(EXAMPLES / "case"), "--out", str(tmp_path / "a" / "b")]) == 130
    assert capsys.readouterr().err == "mixedlub: stopped; no result was written, and the same command starts anew\n"
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_says_where_what_was_done_is_kept_and_that_it_goes_on(tmp_path, interrupted, capsys):
    interrupted("mixedlub.validation.run.validate", lambda out, *rest: (out / "sealed").write_text("first case"))
    assert main(["prove", "--quick", "--out", str(tmp_path / "out")]) == 130
    said = f"mixedlub: stopped; what was done is kept in {tmp_path / 'out'}, and the same command goes on from there\n"
    assert capsys.readouterr().err.endswith(said)


def test_ctrl_c_while_drawing_says_where_the_tables_are(tmp_path, interrupted, capsys):
    interrupted("mixedlub.diagnosis.report.files.drawings")
    out, case = tmp_path / "out", tmp_path / "case"
    assert main(["new", "case", "--kind", "film", "--out", str(case)]) == 0
    assert main(["diagnose", str(case), "--out", str(out)]) == 130
    assert capsys.readouterr().err.endswith(f"mixedlub: stopped; the tables are in {out}\n")
    assert (out / "diagnosis.json").exists()
    assert not (out / "report.html").exists()


def test_ctrl_c_of_a_command_without_results_says_that_it_stopped(interrupted, capsys):
    interrupted("mixedlub.case.folder.read_case")
    assert main(["check", str(EXAMPLES / "case")]) == 130
    assert capsys.readouterr().err == "mixedlub: stopped\n"
