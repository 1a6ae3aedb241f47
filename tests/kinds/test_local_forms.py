"""What stands at one place of a condition and has no name is found, told where, and not taken for outliers."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.judging.empirical import unnamed
from mixedlub.diagnosis.telling.words import as_text, sections

from .conftest import system
from .test_planted import by_d341

SPEED = np.concatenate([-np.geomspace(2.0, 200.0, 14)[::-1], np.geomspace(2.0, 200.0, 14)])
AT = SPEED[SPEED > 0.0][9]
RUNS = 5


def drive(extra, seed=1, relative=0.01):
    """Dry and viscous friction with a payload, ``RUNS`` times over in random order, and what is added."""
    rng = np.random.default_rng(seed)
    speed = rng.permutation(np.tile(SPEED, RUNS))
    order = np.linspace(0.0, 1.0, speed.size)
    own = 2.0 * np.sign(speed) + 0.8 * speed / 200.0
    read = (own * (1.0 + extra(speed, order)) + 0.9) * (1.0 + relative * rng.standard_normal(speed.size))
    columns = {"friction_torque_Nm": read, "speed_rpm": np.round(speed, 2), "sequence": order}
    return system("friction_map", "friction_torque_Nm"), columns


def told(found):
    return " ".join(as_text("", sections(found, unnamed(found.found))).split())


def resonance(speed, order):
    """A Lorentzian about one speed, either way: the diagnosis carries bells."""
    return 0.25 / (1.0 + ((np.abs(speed) - AT) / (0.05 * AT)) ** 2)


def test_a_resonance_is_no_heap_of_outliers(make):
    found = diagnose_case(make(*drive(resonance)).folder)
    assert found.test.detected
    assert found.posterior.verdict == "unknown"
    shape = found.found.unknown.best
    assert (shape.form, shape.axes) == ("peak", ("speed_rpm",))
    assert shape.at == pytest.approx(AT, rel=0.01)
    assert len(found.outlier_runs) <= 2  # of 25 readings, on the flanks of another form
    assert f"is a peak at speed {AT:.4g} rpm in both directions" in told(found)


def test_wild_readings_at_many_places_are_no_peak(make):
    about, columns = drive(lambda speed, order: np.zeros(speed.size))
    wild = np.arange(7, 140, 23)
    columns["friction_torque_Nm"][wild] *= 1.0 + 0.25 * (-1.0) ** np.arange(wild.size)
    found = diagnose_case(make(about, columns).folder)
    assert found.posterior.verdict == ()
    assert found.outlier_runs == [int(r) for r in found.case.recordings["run"][wild]]


def test_few_wild_readings_at_one_place_are_no_peak(make):
    about, columns = drive(lambda speed, order: np.zeros(speed.size))
    there = np.flatnonzero(columns["speed_rpm"] == np.round(AT, 2))[:2]
    columns["friction_torque_Nm"][there] *= 1.25
    found = diagnose_case(make(about, columns).folder)
    assert found.posterior.verdict == ()
    assert found.outlier_runs == [int(r) for r in found.case.recordings["run"][there]]


def remounted(speed, order):
    return np.where(order > 0.6, 0.15, 0.0)


def test_what_changes_at_one_moment_is_told_with_its_run(make):
    found = diagnose_case(make(*drive(remounted)).folder)
    assert found.posterior.verdict == "unknown"
    assert found.found.unknown.best.form == "step"
    rows = found.case.recordings
    run = rows["run"][rows["sequence"] > 0.6][0]
    assert f"is a step at run {run:g}," in told(found)
    assert f"Look up what was done to the rig or the sample at run {run:g}," in told(found)


def test_a_sample_that_was_changed_is_no_drift(make):
    """Viscosity up and down in temperature; from two thirds on another fill, 12 % thicker."""
    celsius = np.concatenate([np.linspace(30.0, 100.0, 18), np.linspace(100.0, 30.0, 18)])
    order = np.linspace(0.0, 1.0, 36)
    read = by_d341(celsius) * np.where(order > 2 / 3, 1.12, 1.0)
    read = read * (1.0 + 0.01 * np.random.default_rng(2).standard_normal(36))
    columns = {"temperature_C": celsius, "sequence": order, "viscosity_mPa_s": read}
    found = diagnose_case(make(system("viscosity", "viscosity_mPa_s"), columns).folder)
    assert found.posterior.verdict == "unknown"
    assert found.found.unknown.best.form == "step"
    assert found.found.unknown.best.at == pytest.approx(2 / 3, abs=0.06)


def test_a_friction_event_keeps_its_name(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = np.where(time > 4000.0, 0.13, 0.1) * (1.0 + 0.01 * np.random.default_rng(3).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert found.posterior.verdict == ("friction_event",)


def test_creep_that_few_readings_show_is_found_beside_running_in(make):
    """Every tenth reading at very low slip: under running-in alone they look like outliers."""
    time = np.linspace(100.0, 20000.0, 60)
    slip = np.where(np.arange(60) % 10 == 4, 6e-4, np.tile([3e-3, 0.01, 0.03, 0.08, 0.14], 12))
    worn = 0.1 * (1.0 + 0.8 / (1.0 + time / 1500.0))
    friction = worn * -np.expm1(-slip / 3e-4) * (1.0 + 0.008 * np.random.default_rng(4).standard_normal(60))
    columns = {"time_s": time, "slide_roll_ratio": slip, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert "contact_creep" in found.posterior.verdict
    assert not found.outlier_runs


def test_the_run_of_a_change_is_told_among_very_many(make):
    rng = np.random.default_rng(7)
    speed = np.tile(np.geomspace(5.0, 300.0, 12), 25)
    order = np.linspace(0.0, 1.0, speed.size)
    read = (2.0 + 0.8 * speed / 300.0) * np.where(order > 0.37, 1.12, 1.0) * (1.0 + 0.01 * rng.standard_normal(300))
    columns = {"friction_torque_Nm": read, "speed_rpm": speed, "sequence": order}
    found = diagnose_case(make(system("friction_map", "friction_torque_Nm"), columns).folder)
    run = found.case.recordings["run"][order > 0.37][0]
    assert f"is a step at run {run:g}," in told(found)
    assert not found.outlier_runs


def test_a_passing_disturbance_is_no_lasting_event(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = 0.1 * (1.0 + 0.3 * np.exp(-0.5 * ((time - 4000.0) / 250.0) ** 2))
    friction = friction * (1.0 + 0.01 * np.random.default_rng(5).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert ("unknown" in found.posterior.tied) or found.posterior.verdict == "unknown"


def test_a_step_is_unnamed_where_its_name_is_excluded(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = np.where(time > 4000.0, 0.13, 0.1) * (1.0 + 0.01 * np.random.default_rng(3).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    case = make(system("friction_history", "friction_coefficient"), columns)
    found = diagnose_case(case.folder, exclude=["friction_event"])
    assert found.posterior.verdict == "unknown"
    assert found.found.unknown.best.form == "step"
