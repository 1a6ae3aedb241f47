"""The worked example is what it says: made by the rig program, and solved by the diagnosis."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "worked"


@pytest.fixture(scope="module")
def truth() -> dict:
    """What the rig concealed."""
    return json.loads((EXAMPLE / "truth.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def second() -> Diagnosis:
    """The answer to the second campaign."""
    return diagnose_case(EXAMPLE / "second_campaign")


def test_rig_program_makes_the_recordings_that_are_shown(tmp_path: Path) -> None:
    shutil.copy(EXAMPLE / "make_rig.py", tmp_path)
    subprocess.run([sys.executable, str(tmp_path / "make_rig.py")], check=True, timeout=60)
    for campaign in ("first_campaign", "second_campaign"):
        made = (tmp_path / campaign / "recordings.csv").read_text(encoding="utf-8")
        assert made == (EXAMPLE / campaign / "recordings.csv").read_text(encoding="utf-8")


def test_case_folders_do_not_tell_the_truth(truth: dict) -> None:
    for path in EXAMPLE.glob("*_campaign/*"):
        assert path.name in ("system.toml", "recordings.csv", "conditions.csv")
        assert not any(name in path.read_text(encoding="utf-8") for name in truth["concealed"])


@pytest.mark.long
def test_concealed_loss_is_named(second: Diagnosis, truth: dict) -> None:
    assert list(second.posterior.verdict.ids) == list(truth["concealed"])


@pytest.mark.long
def test_spoilt_reading_is_found(second: Diagnosis, truth: dict) -> None:
    assert second.outlier_runs == truth["spoilt_runs"]


@pytest.mark.long
def test_withheld_conditions_are_predicted_nine_times_better_than_by_recalibration(
    second: Diagnosis, truth: dict
) -> None:
    assert second.wanted is not None
    true = {int(run): row["loss_W"] for run, row in truth["withheld"].items()}
    calibrated = predicted = 0.0
    for i, run in enumerate(second.wanted.table["run"]):
        calibrated += (second.wanted.calibrated[i] / true[int(run)] - 1.0) ** 2
        predicted += (second.wanted.predicted[i] / true[int(run)] - 1.0) ** 2
    assert predicted < calibrated / 81.0
