"""A full disk is one sentence that says what is kept and that a rerun goes on; nothing is left outside --out."""

import errno
import tempfile

import pytest

from mixedlub.cli import main
from mixedlub.study import batch, checkpoint

FULL = OSError(errno.ENOSPC, "No space left on device")


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """A system's temporary folder of its own, in which nothing may appear."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    yield
    assert list(folder.iterdir()) == []


def fails(*arguments, **named):
    raise FULL


def study(file, out):
    return main(["study", str(file), "--no-figures", "--out", str(out)])


def test_while_computing_what_was_done_is_kept_and_the_rerun_goes_on(write_study, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(batch, "BLOCK_POINTS", 150)
    file, out, keep = write_study(), tmp_path / "o", checkpoint.keep
    kept = []

    def keep_two(folder, block, found):
        kept.append(block)
        keep(folder, block, found) if len(kept) < 3 else fails()

    monkeypatch.setattr(checkpoint, "keep", keep_two)
    assert study(file, out) == 1
    (said,) = capsys.readouterr().err.strip().splitlines()[-1:]
    assert said == (
        f"mixedlub: the disk of {out} is full; what was done is kept in {out}, "
        "and the same command goes on from there once there is room"
    )
    assert {path.suffix for path in out.rglob("*") if path.is_file()} == {".parquet"}
    monkeypatch.setattr(checkpoint, "keep", keep)
    assert study(file, out) == 0
    assert "2 of " in capsys.readouterr().out


@pytest.mark.parametrize("place", ["pyarrow.parquet.write_table", "mixedlub.commands.deliver.write_long"])
def test_while_writing_nothing_is_left_half_done(place, write_study, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(batch, "BLOCK_POINTS", 150)
    monkeypatch.setattr(place, fails)
    assert study(write_study(), tmp_path / "o") == 1
    err = capsys.readouterr().err
    assert "is full" in err
    assert "Traceback" not in err
    assert not [path for path in tmp_path.rglob("*") if path.name.startswith((".writing", ".running"))]
    assert not list(tmp_path.rglob("*.log"))


def test_the_log_of_an_unexpected_error_lies_with_the_results_until_a_run_succeeds(write_study, tmp_path, monkeypatch):
    monkeypatch.setattr("mixedlub.study.run_study", lambda *a, **k: 1 / 0)
    file, out = write_study(), tmp_path / "o"
    assert study(file, out) == 1
    assert "ZeroDivisionError" in (out / "mixedlub-error.log").read_text(encoding="utf-8")
    monkeypatch.undo()
    assert study(file, out) == 0
    assert not (out / "mixedlub-error.log").exists()


def test_without_a_folder_for_results_an_unexpected_error_says_where_it_arose(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("mixedlub.report.effect_pages.effects_text", lambda effect: 1 / 0)
    assert main(["effects"]) == 1
    err = capsys.readouterr().err
    assert "ZeroDivisionError" in err
    assert "at line" in err
