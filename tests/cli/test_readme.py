"""What the README shows runs."""

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

from mixedlub.cli import COMMANDS, main

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)
    return found


def test_study_of_the_readme_runs(tmp_path):
    (tmp_path / "traces").mkdir()
    x = np.arange(12000) * 0.5
    z = np.convolve(np.random.default_rng(2).normal(size=x.size), np.ones(30) / 30, "same")
    np.savetxt(
        tmp_path / "traces/ground.csv", np.column_stack([x, z]), delimiter=",", header="x (um),z (um)", comments=""
    )
    (tmp_path / "mine.toml").write_text(block("toml"))
    assert main(["study", str(tmp_path / "mine.toml"), "--no-figures", "--out", str(tmp_path / "out")]) == 0


def test_python_of_the_readme_runs(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    exec(compile(block("python"), "README", "exec"), {})
    assert "power_loss" in capsys.readouterr().out


def test_every_command_is_in_the_readme():
    for command in COMMANDS:
        assert f"`mixedlub {command.NAME}" in README


@pytest.mark.parametrize("name", re.findall(r"\]\(([^)]+)\)", README))
def test_linked_files_exist(name):
    assert (ROOT / name).is_file()


def test_version_is_in_the_changelog():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text()


ROWS = {
    "right verdict, one effect, identifiable": "right verdict, one effect, identifiable",
    "right or honestly tied, one effect": "right or honestly tied, one effect, all",
    "both effects of a pair": "both effects of a pair named",
    "none where nothing is missing": "none where nothing is missing",
    "unknown where ": "unknown where so and identifiable",
    "instrument fault called physics or the reverse": "fault called physics or physics fault",
}


@pytest.mark.parametrize(("scores", "column"), [("score.txt", 2), ("score_rigs.txt", 7)])
@pytest.mark.parametrize("row", ROWS)
def test_figures_of_the_proof_are_those_of_its_table(row, scores, column):
    """The README has two tables of figures: value first, or value behind those of the kinds."""
    table = (ROOT / "examples/proof" / scores).read_text(encoding="utf-8")
    (found, *_) = re.findall(rf"^{re.escape(ROWS[row])} +([-.0-9e]+)", table, re.MULTILINE)
    lines = [line.split("|") for line in README.splitlines() if line.startswith(f"| {row}")]
    told = [float(cells[column]) for cells in lines if (len(cells) > 7) == (column == 7)]
    assert told == [pytest.approx(float(found), abs=5e-3)]


@pytest.mark.parametrize("scores", ["score.txt", "score_rigs.txt"])
def test_every_goal_that_is_missed_is_told(scores):
    table = (ROOT / "examples/proof" / scores).read_text(encoding="utf-8").split("\n\n")[0]
    missed = len(re.findall("NOT met", table))
    count = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight")[missed]
    assert f"{count} {'goal is' if missed < 2 else 'goals are'} missed" in " ".join(README.split())
