"""What the study command says of earlier results, and what its page repeats of the notes on traces."""

from itertools import islice

import pytest

from mixedlub.cli import main
from mixedlub.commands.study import resumed
from mixedlub.report.figures import figures


def run(file, out, *options):
    assert main(["study", str(file), "--out", str(out), *options]) == 0


FEW = {"conditions__oil_temperature_C": [60], "conditions__torque_Nm": [50]}
"""Conditions of few figures."""


@pytest.fixture(autouse=True)
def one_figure(monkeypatch):
    """Pages have one figure of the results, as no test here is of what the others show."""
    monkeypatch.setattr("mixedlub.report.page.figures", lambda results: islice(figures(results), 1))


def test_a_page_of_an_earlier_run_is_named_where_none_is_drawn(write_study, tmp_path, capsys):
    first, other = write_study("first", **FEW), write_study("other", **FEW, gears__face_width_mm=20.0)
    run(first, tmp_path / "o")
    capsys.readouterr()
    run(other, tmp_path / "o", "--no-figures", "--replace")
    assert f"of an earlier run, in {tmp_path / 'o'}: index.html" in capsys.readouterr().err


def test_files_of_the_user_among_the_figures_stay_and_old_figures_go(write_study, tmp_path):
    drawings = tmp_path / "o" / "figures"
    run(write_study("first", **FEW), tmp_path / "o")
    drawn = {path.name for path in drawings.iterdir()}
    next(iter(drawings.iterdir())).rename(drawings / "figure_of_old.svg")
    (drawings / "notes.txt").write_text("mine", encoding="utf-8")
    run(write_study("first", **FEW), tmp_path / "o")
    assert {path.name for path in drawings.iterdir()} == {*drawn, "notes.txt"}


def test_the_page_says_what_is_doubtful_about_the_heights_of_a_trace(write_study, tmp_path):
    file = write_study(
        "traced", **FEW, surfaces={"few": {"profile": "shipped:0122", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}}
    )
    run(file, tmp_path / "o")
    page = (tmp_path / "o" / "index.html").read_text(encoding="utf-8")
    assert "surfaces.few: only 19 independent heights" in page
    assert "surfaces.few: called Gaussian, yet real contact at a gap of 2 sigma is 0.14 times the Gaussian one" in page


def test_a_resumed_study_says_how_much_was_there(capsys):
    seen = []
    progress = resumed(lambda done, of: seen.append((done, of)))
    progress(3, 8)
    progress(4, 8)
    assert capsys.readouterr().out == "blocks kept from an earlier start: 3 of 8; to compute: 5\n"
    assert seen == [(3, 8), (4, 8)]
    resumed(lambda done, of: None)(0, 8)
    assert capsys.readouterr().out == ""
