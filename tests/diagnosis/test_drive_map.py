"""A drive run in two directions: figures that keep them apart, and words on what such a recording cannot tell."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.report.figures import figures, maps
from mixedlub.diagnosis.report.text import tables, words
from mixedlub.importers import write_case
from mixedlub.kinds.friction_map import made_up_for

from ..kinds.conftest import system

SLOWEST = 6.0


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """Stribeck friction in both directions, no temperature recorded, nothing read below the slowest speed."""
    one = np.geomspace(SLOWEST, 150.0, 20)
    speed = np.concatenate([-one[::-1], one])
    torque = np.sign(speed) * (1.0 + 0.6 * np.exp(-np.abs(speed) / 15.0)) + 0.5 * speed / 150.0
    torque *= 1.0 + 0.01 * np.random.default_rng(2).standard_normal(speed.size)
    columns = {"speed_rpm": speed, "friction_torque_Nm": torque}
    folder = tmp_path_factory.mktemp("drive") / "case"
    return diagnose_case(write_case(folder, system("friction_map", "friction_torque_Nm"), columns))


def test_profile_stands_only_where_something_was_recorded(drive: Diagnosis) -> None:
    figure = figures.profiles(drive)
    assert figure is not None
    lines = [np.asarray(line.get_xdata(), dtype=float) for line in figure.axes[0].lines]
    drawn = [x for x in lines if x.size and set(x.tolist()) != {0.0, 1.0}]
    assert np.isin(np.concatenate(drawn), drive.recorded.table["speed_rpm"]).all()
    assert not any(x.min() < 0.0 < x.max() for x in drawn), "a line crosses speeds that were not run"


def test_bins_keep_the_directions_apart(drive: Diagnosis) -> None:
    speed = drive.recorded.table["speed_rpm"]
    label, names = maps._ticks(speed)
    assert len(names) <= maps.MOST_LEVELS + 1
    assert all(np.unique(np.sign(speed[label == k])).size == 1 for k in range(len(names)))
    assert min(abs(float(name)) for name in names) > 0.9 * SLOWEST


def left_out(d: Diagnosis) -> words.Section:
    return next(s for s in words.sections(d) if s.title == words.LEFT_OUT)


def test_parameter_that_no_reading_depends_on_is_not_listed(drive: Diagnosis) -> None:
    assert drive.posterior.verdict == Explanation.of("stribeck")
    said = left_out(drive)
    assert not any(row[1].startswith("thinning") for row in said.table)
    assert any(row[1].startswith("excess") for row in said.table)
    assert any(s.startswith("Stribeck: no reading here depends on thinning (b)") for s in said.sentences)
    assert not any("thinning" in s and "not determined" in s for s in said.sentences)


def at_coordinate(d: Diagnosis, z: float) -> Diagnosis:
    """The same answer, the first parameter of its effect so many standard deviations up its prior."""
    key = d.posterior.verdict
    coordinates = d.refined[key].z.copy()
    coordinates[d.search.problem.calibration_size] = z
    return replace(d, refined={**d.refined, key: replace(d.refined[key], z=coordinates)})


@pytest.mark.parametrize(("z", "marked"), [(4.5, True), (-3.2, True), (2.0, False)])
def test_parameter_far_outside_of_what_is_usual_is_marked(drive: Diagnosis, z: float, marked: bool) -> None:
    said = left_out(at_coordinate(drive, z))
    far = "far outside its expected range (0.0805 to 1.12)"
    assert (far in said.table[1][-1]) == marked
    assert not any("usual (" in row[-1] for row in said.table[2:])
    stretch = f"Stribeck: excess is {far}. This effect is doubtful: something else may act in the same way."
    assert (stretch in said.sentences) == marked


def test_one_direction_does_not_tell_dry_friction_from_a_payload(drive: Diagnosis) -> None:
    speed = drive.recorded.table["speed_rpm"]
    both = drive.search.problem
    assert tables.one_way(both.forward) == []
    for rows in (speed > 0.0, speed < 0.0):
        said = tables.one_way(both.take(np.flatnonzero(rows)).forward)
        assert "one way only, which does not distinguish coulomb torque from payload torque" in said[0]


def test_a_payload_that_makes_up_for_friction_is_nothing_missing(tmp_path: Path) -> None:
    """Lowering a load: what is read is far smaller than any of its parts, and changes its sign with the speed."""
    speed = np.tile([0.05, 0.1], 40)
    friction = 0.02 - 0.08 + 0.9 * speed
    friction *= 1.0 + 0.004 * np.random.default_rng(3).standard_normal(speed.size)
    columns = {"sliding_speed_m_s": speed, "friction_coefficient": friction}
    case = write_case(tmp_path / "case", system("friction_map", "friction_coefficient"), columns)
    assert diagnose_case(case).posterior.verdict == NOTHING


@pytest.mark.parametrize("seed", range(8))
def test_no_payload_is_seen_in_noise_about_zero_nor_in_a_wild_reading(seed: int) -> None:
    rng, speed = np.random.default_rng(seed), np.linspace(10.0, 200.0, 10)
    assert made_up_for(rng.standard_normal(10), speed) == 0.0
    friction = 0.5 + 0.002 * speed
    friction[seed] = -50.0
    assert made_up_for(friction, speed) == 0.0


def test_only_a_drive_has_a_direction(complete: Diagnosis) -> None:
    assert tables.one_way(complete.search.problem.forward) == []
