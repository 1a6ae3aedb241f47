"""What the README shows runs, and what it claims is in the score tables."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from mixedlub.cli import COMMANDS

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
MOST_WORDS = 700
SCORES = ("score.txt", "score_rigs.txt")


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)
    return found


def score(file: str) -> str:
    """The table of the diagnosis itself."""
    return (ROOT / "examples/proof" / file).read_text(encoding="utf-8").split("\n\n")[0]


def test_readme_is_short():
    assert len(re.sub(r"```.*?```", "", README, flags=re.DOTALL).split()) <= MOST_WORDS


def test_python_of_the_readme_runs(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    exec(compile(block("python"), "README", "exec"), {})
    assert "power_loss" in capsys.readouterr().out


@pytest.mark.long
def test_picture_and_numbers_of_the_first_page_are_those_of_the_example(tmp_path):
    """README and the first page of the docs state what the script finds in the measured readings."""
    copy = tmp_path / "examples"
    shutil.copytree(ROOT / "examples/real/tables", copy / "real/tables")
    shutil.copy(ROOT / "examples/05_missing_physics.py", copy)
    script = [sys.executable, "05_missing_physics.py"]
    found = subprocess.run(script, cwd=copy, env=os.environ, capture_output=True, text=True, check=True).stdout
    (probability,) = re.findall(r"Missing physics: Stribeck \(probability ([\d.]+)\)", found)
    (largest,) = re.findall(r"Largest at run \d+ .*: -?([\d.]+) sigma", found)
    rows = re.findall(r"rpm: (\S+) N m \((\S+) to (\S+)\), calibrated base model (\S+), measured (\S+)", found)
    assert len(rows) == 2
    for _, low, high, _, measured in rows:
        assert float(low) <= float(measured) <= float(high)
    predicted, _, _, base, measured = rows[1]
    for page in (ROOT / "README.md", ROOT / "docs/index.md"):
        text = " ".join(page.read_text(encoding="utf-8").split())
        assert f"Stribeck friction with probability {probability}" in text
        assert f"up to {float(largest):.0f} times the noise" in text
        assert f"{predicted} N m predicted, {measured} measured" in text
        assert f"says {base} (right)" in text
    assert not (copy / "missing_physics.svg").exists()
    folders = (copy / "out/missing_physics", ROOT / "examples")
    drawn, kept = ((folder / "missing_physics.svg").read_text(encoding="utf-8") for folder in folders)
    words = re.findall(r"<!-- (.*?) -->", kept)
    assert "predicted, then measured" in words
    assert re.findall(r"<!-- (.*?) -->", drawn) == words
    marks = [
        np.array(re.findall(r'<use [^>]*x="([-\d.]+)" y="([-\d.]+)"', text), dtype=float) for text in (drawn, kept)
    ]
    assert len(marks[0]) > 3 * 34
    np.testing.assert_allclose(*marks, atol=1.0)


def test_every_command_is_in_the_readme():
    for command in COMMANDS:
        assert f"`mixedlub {command.NAME}" in README


@pytest.mark.parametrize("name", re.findall(r"\]\(([^)]+)\)", README))
def test_linked_files_exist(name):
    assert (ROOT / name).is_file()


def test_version_is_in_the_changelog_and_the_citation():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text()
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()


FIGURES = [row.split("|") for row in README.splitlines() if re.match(r"\|.*\| [\d.]+ \| [\d.]+ \|", row)]


def test_the_readme_has_four_figures():
    assert len(FIGURES) == 4


@pytest.mark.parametrize("column", range(len(SCORES)))
@pytest.mark.parametrize("row", FIGURES, ids=lambda row: row[1].strip())
def test_figures_of_the_readme_are_those_of_the_score(row, column):
    (found,) = re.findall(rf"^{re.escape(row[1].strip())} +([-.0-9e]+)", score(SCORES[column]), re.MULTILINE)
    assert float(row[2 + column]) == pytest.approx(float(found), abs=5e-4)


def test_missed_goals_are_counted_in_the_readme():
    first, second = (len(re.findall("NOT met", score(file))) for file in SCORES)
    assert f"Goals missed: {first} of the first battery, {second} of the second" in README


def test_nothing_tells_to_install_from_an_index():
    texts = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "mixedlub").rglob("*.py")]
    assert not [path for path in texts if re.search(r"pip install \W*mixedlub", path.read_text(encoding="utf-8"))]
