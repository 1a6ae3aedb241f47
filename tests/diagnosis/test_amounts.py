"""Fitted numbers are told with what they are of, and where they come from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.labels import number
from mixedlub.diagnosis.report.text import tables, words
from mixedlub.diagnosis.report.text.answer import calibration_record
from mixedlub.effects import catalogue
from mixedlub.importers import write_case

from .test_words import judged, section

DRIVE = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.015}}}


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A drive with a tenth more friction one way: whether the dry or the viscous part has it, readings do not tell."""
    speed = np.array([s * v for s in (-1.0, 1.0) for v in np.geomspace(5.0, 300.0, 13)])
    friction = (1.5 * np.sign(speed) + 1.15 * speed / 300.0) * (1.0 + 0.1 * np.sign(speed))
    friction += 0.015 * np.abs(friction) * np.random.default_rng(3).standard_normal(speed.size)
    folder = tmp_path_factory.mktemp("drive") / "case"
    write_case(folder, DRIVE, {"speed_rpm": speed, "friction_torque_Nm": friction})
    kept = ("direction_dependence", "sensor_offset", "sensor_gain")
    return diagnose_case(folder, exclude=[name for name in catalogue() if name not in kept])


def test_a_share_is_told_as_an_amount(offset: Diagnosis) -> None:
    one = judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1)
    row = section(one, words.LEFT_OUT).table[1]
    size = float(offset.search.problem.forward.inputs["reading_scale"])
    made = float(row[-1].rpartition(": ")[2].removesuffix(" W"))
    assert made == pytest.approx(float(row[2]) * size, rel=0.01)
    assert made == pytest.approx(9.0, rel=0.2)


def test_a_share_of_a_torque_is_told_in_newton_metres(offset: Diagnosis, drive: Diagnosis) -> None:
    (zero,) = catalogue()["torque_offset"].parameters
    assert tables._meaning(offset, zero, 5e-4).endswith("(150 N m): 0.075 N m")
    growth, _ = catalogue()["load_dependent_friction"].parameters
    moved = calibration_record(drive)["coulomb_torque"]["value"]
    assert tables._meaning(drive, growth, 0.5).endswith(f"({number(moved)} N m): {number(0.5 * moved)} N m")


def test_a_share_of_the_largest_speed_is_told_in_turns(drive: Diagnosis) -> None:
    least, _ = catalogue()["presliding"].parameters
    assert tables._meaning(drive, least, 0.01).endswith("(300 rpm): 3 rpm")


def test_what_a_parameter_is_a_share_of_is_read_by_its_law() -> None:
    for e in catalogue().values():
        assert all(not p.relative_to or p.relative_to in (*e.acts_on, *e.reads) for p in e.parameters), e.id


def test_inputs_taken_from_the_readings_are_not_called_stated(
    drive: Diagnosis, complete: Diagnosis, tmp_path: Path
) -> None:
    origin = {row[0]: row[1].partition(" ")[2] for row in tables.calibration(drive)[1][1:]}
    assert origin == {
        "coulomb torque": "(from the readings)",
        "viscous torque": "(from the readings)",
        "payload torque": "(assumed)",
    }
    assert all("(" not in row[1] for row in tables.calibration(complete)[1][1:])
    history = {"kind": "friction_history", "recording": {"quantity": "friction_coefficient"}}
    columns = {"time_s": np.arange(1.0, 9.0), "friction_coefficient": np.linspace(0.10, 0.11, 8)}
    assert tables._sources(read_case(write_case(tmp_path / "case", history, columns))) == {
        "boundary_friction": " (from the readings)"
    }


def test_parameters_that_may_each_be_nothing_are_known_together(drive: Diagnosis) -> None:
    sure = judged(drive, {Explanation.of("direction_dependence"): 0.97}, 1)
    said, table = tables.parameters(sure)
    assert all(float(row[3].split(" to ")[0]) < 0.0 < float(row[3].split(" to ")[1]) for row in table[1:])
    assert any("asymmetry and viscous asymmetry alone may have no effect, but not all at once" in text for text in said)
    unsure = judged(drive, {Explanation.of("direction_dependence"): 0.5, NOTHING: 0.4}, 2)
    assert not any("alone may have no effect" in text for text in tables.parameters(unsure)[0])
