"""Readings of both signs at one condition: one of them is wrong, and is named."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import check_readings
from mixedlub.importers import write_case
from mixedlub.schema.findings import Finding, Severity

SCATTER = 1.0 + 0.01 * np.random.default_rng(0).standard_normal(40)
SPEED = np.tile(np.geomspace(1.0, 100.0, 10), 4)
SIGNS = ("sign_contradictory", "sign_opposite_to_model", "sign_lost", "reading_negative")
HALF = np.where(np.arange(40) < 20, 1.0, -1.0)


def told(folder: Path, kind: str, quantity: str, columns: dict[str, Any]) -> list[Finding]:
    """What is found of signs, if anything."""
    sections = {"kind": kind, "recording": {"quantity": quantity}}
    case = read_case(write_case(folder / "case", sections, columns))
    assert case.recordings is not None
    y = np.asarray(case.recordings[quantity], dtype=float)
    found = check_readings(case, case.recordings, y, Forward(case, case.recordings))
    return [note for note in found if note.code in SIGNS]


def history(folder: Path, friction: np.ndarray) -> list[Finding]:
    columns = {"time_s": 60.0 * np.arange(40), "friction_coefficient": friction}
    return told(folder, "friction_history", "friction_coefficient", columns)


def drive(folder: Path, friction: np.ndarray, speed: np.ndarray = SPEED) -> list[Finding]:
    columns = {"speed_rpm": speed, "friction_torque_Nm": friction}
    return told(folder, "friction_map", "friction_torque_Nm", columns)


def test_an_unsigned_friction_of_both_signs_is_doubted_with_its_runs(tmp_path: Path) -> None:
    (note,) = history(tmp_path, -0.1 * SCATTER * (-1.0) ** np.arange(40))
    assert note.code == "sign_contradictory"
    assert "20 readings are negative" in note.text
    assert "(runs 1, 3, 5, 7, 9 and 15 more)" in note.text


def test_a_drive_that_reads_both_signs_at_one_speed_is_doubted(tmp_path: Path) -> None:
    (note,) = drive(tmp_path, SCATTER * (1.0 + 0.01 * SPEED) * np.where(np.arange(40) < 30, 1.0, -1.0))
    assert note.code == "sign_contradictory"
    assert "10 readings are negative" in note.text
    assert "(runs 31, " in note.text


def test_one_reading_of_the_other_sign_is_named(tmp_path: Path) -> None:
    flipped = np.where(np.arange(40) == 25, -1.0, 1.0)
    (note,) = drive(tmp_path, SCATTER * (1.0 + 0.01 * SPEED) * flipped)
    assert "1 reading is negative" in note.text
    assert "(run 26)" in note.text


def test_a_drive_turned_back_reads_either_sign(tmp_path: Path) -> None:
    assert drive(tmp_path, SCATTER * HALF, SPEED * HALF) == []


def test_a_drive_that_stands_is_held_either_way(tmp_path: Path) -> None:
    still = np.arange(40) % 10 == 0
    assert drive(tmp_path, SCATTER * np.where(still, HALF, 1.0), np.where(still, 0.0, SPEED)) == []


@pytest.mark.parametrize("offset", [0.0, 0.005])
def test_readings_about_zero_have_either_sign(tmp_path: Path, offset: float) -> None:
    assert history(tmp_path, offset + 0.01 * np.random.default_rng(2).standard_normal(40)) == []


def test_the_same_at_other_loads_is_no_matter_of_signs(tmp_path: Path) -> None:
    """A payload that outweighs friction at one load and not at the other."""
    columns = {"speed_rpm": SPEED, "torque_Nm": 10.0 + 5.0 * HALF, "friction_torque_Nm": SCATTER * HALF}
    assert told(tmp_path, "friction_map", "friction_torque_Nm", columns) == []


def test_a_single_wrong_sign_is_told_once(tmp_path: Path) -> None:
    (note,) = history(tmp_path, 0.1 * SCATTER * np.where(np.arange(40) == 6, -1.0, 1.0))
    assert note.text.endswith("(run 7)")


@pytest.mark.parametrize(("payload", "severity"), [(0.0, Severity.DOUBT), (3.0, Severity.CAUTION)])
def test_a_friction_that_lost_its_sign_is_told(tmp_path: Path, payload: float, severity: Severity) -> None:
    speed = np.concatenate([-np.geomspace(2.0, 200.0, 12), np.geomspace(2.0, 200.0, 12)])
    friction = np.abs(payload + np.sign(speed) + speed / 200.0)
    columns = {"speed_rpm": speed, "friction_torque_Nm": friction}
    notes = told(tmp_path, "friction_map", "friction_torque_Nm", columns)
    assert [note.severity for note in notes if note.code == "sign_lost"] == [severity]
