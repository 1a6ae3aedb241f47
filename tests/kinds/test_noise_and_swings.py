"""Noise, swings in time and what is neither: which of them a recording shows."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.schema.findings import codes

from .conftest import TIME, drive, noisy, system


def hunting(periods, height):
    """A temperature controller that hunts: a triangle in time, where the diagnosis carries cosine and sine."""
    phase = (periods * (TIME - TIME[0]) / np.ptp(TIME) + 0.2) % 1.0
    friction = 0.1 * (1.0 + height * (4.0 * np.abs(phase - 0.5) - 1.0))
    return system("friction_history", "friction_coefficient"), {"time_s": TIME, "friction_coefficient": noisy(friction)}


@pytest.mark.parametrize(
    ("periods", "height"),
    [
        (8.3, 0.03),
        pytest.param(4.4, 0.2, marks=pytest.mark.long),
        pytest.param(19.6, 0.03, marks=pytest.mark.long),
        pytest.param(28.0, 0.03, marks=pytest.mark.long),
        pytest.param(8.25, 0.1, marks=pytest.mark.long),
        pytest.param(19.29, 0.5, marks=pytest.mark.long),
    ],
)
def test_what_swings_in_time_is_no_noise(make, periods, height):
    found = diagnose_case(make(*hunting(periods, height)).folder)
    assert found.test.detected
    assert found.posterior.verdict == DISCREPANCY
    assert found.search.discrepancy.best.waves == pytest.approx(periods, abs=0.2)
    assert found.case.system.recording.noise.relative <= max(0.01, 0.1 * height)  # a triangle is not all cosine


@pytest.mark.long
def test_noise_of_readings_through_zero_is_told_from_repeats(make):
    rng = np.random.default_rng(5)
    speed = np.tile(np.concatenate([-np.geomspace(2.0, 200.0, 14)[::-1], np.geomspace(2.0, 200.0, 14)]), 8)
    clean = 1.0 * np.sign(speed) + 2.0 * speed / 200.0 + 0.95
    read = clean + np.hypot(0.03 * clean, 0.02) * rng.standard_normal(speed.size)
    columns = {"friction_torque_Nm": read, "speed_rpm": speed}
    sections = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    found = diagnose_case(make(sections, columns).folder)
    noise = found.case.system.recording.noise
    sd, true = (np.hypot(r * clean, a) for r, a in ((noise.relative, noise.absolute), (0.03, 0.02)))
    assert np.max(np.abs(np.log(sd / true))) < np.log(1.6)
    assert not found.test.detected


@pytest.mark.long
@pytest.mark.parametrize(("times", "verdict"), [(2.0, NOTHING), (9.0, DISCREPANCY)])
def test_scatter_far_beyond_what_is_stated_is_not_called_noise(make, times, verdict):
    friction = noisy(np.full(TIME.size, 0.1), 0.01 * times, seed=8)
    columns = {"time_s": TIME, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert found.posterior.verdict == verdict
    assert {"scatter_above_stated", "scatter_unexplained"} & set(codes(found.warnings))
    assert found.test.detected == (verdict == DISCREPANCY)


@pytest.mark.long
def test_a_condition_that_is_cycled_makes_no_wave(make):
    """Every second reading at another load, in order: what goes with the load is no swing in time."""
    load = np.where(np.arange(TIME.size) % 2 == 0, 20.0, 60.0)
    friction = noisy(np.where(load > 30.0, 0.1, 0.12))
    columns = {"time_s": TIME, "load_N": load, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert found.test.detected
    assert not found.search.discrepancy.best.waves


@pytest.mark.long
def test_a_wave_is_not_foretold_far_beyond_its_record(make):
    case = make(*hunting(12.0, 0.1))
    wanted = case.folder / "later.csv"
    wanted.write_text("run,time_s\n" + "".join(f"{900 + i},{7200 + 900 * i}\n" for i in range(30)))
    told = diagnose_case(case.folder, predict=wanted).wanted
    half = 0.5 * (told.high90 - told.low90)
    assert np.all(half[5:] > 0.008)
    assert np.all(np.abs(told.predicted[5:] - 0.1) < 0.001)


def test_scatter_has_no_period(make):
    found = diagnose_case(make(*hunting(8.3, 0.0)).folder)
    assert not found.test.detected
    assert found.posterior.verdict == NOTHING


def test_a_scan_does_not_make_false_alarms(make):
    """What a scan finds in noise is no alternative of the test for a mismatch."""
    angle = np.linspace(0.0, 360.0, 80, endpoint=False)
    quiet = drive(np.full(80, 2.0), speed_rpm=np.where(angle < 180.0, 50.0, 60.0), position_deg=angle)
    found = diagnose_case(make(*quiet).folder)
    assert not found.test.detected
    assert found.posterior.verdict == NOTHING
