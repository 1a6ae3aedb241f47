"""The recording of the example case is what its script writes."""

import csv
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_the_shipped_recording_is_that_of_the_script(tmp_path):
    shutil.copytree(EXAMPLES / "case", tmp_path / "case")
    script = shutil.copy(EXAMPLES / "03_made_up_recording.py", tmp_path)
    subprocess.run([sys.executable, script], check=True, capture_output=True)
    shipped, made = (
        list(csv.reader((place / "case" / "recordings.csv").read_text().splitlines())) for place in (EXAMPLES, tmp_path)
    )
    assert [row[:-1] for row in made] == [row[:-1] for row in shipped]
    losses = [float(row[-1]) for row in shipped[1:]]
    assert [float(row[-1]) for row in made[1:]] == pytest.approx(losses, abs=0.011)
    conditions = [(place / "case" / "conditions.csv").read_text() for place in (EXAMPLES, tmp_path)]
    assert conditions[0] == conditions[1]
