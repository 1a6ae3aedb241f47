"""What stands at one place of a condition and has no name is found, told where, and not taken for outliers."""

import numpy as np
import pytest

from mixedlub.diagnosis.assessment.power_law import describe_discrepancy
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.discrepancy.modulated import thermal_lag
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.report.text.words import as_text, sections

from .conftest import BALL, system
from .test_planted import by_d341, film

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
    return " ".join(as_text("", sections(found, describe_discrepancy(found.search))).split())


def resonance(speed, order):
    """A Lorentzian about one speed, either way: the diagnosis carries bells."""
    return 0.25 / (1.0 + ((np.abs(speed) - AT) / (0.05 * AT)) ** 2)


@pytest.mark.long
def test_a_resonance_is_no_heap_of_outliers(make):
    found = diagnose_case(make(*drive(resonance)).folder)
    assert found.test.detected
    assert found.posterior.verdict == DISCREPANCY
    shape = found.search.discrepancy.best
    assert (shape.form, shape.axes) == ("peak", ("speed_rpm",))
    assert shape.at == pytest.approx(AT, rel=0.01)
    assert len(found.outlier_runs) <= 2  # of 25 readings, on the flanks of another form
    assert f"is a peak at speed {AT:.4g} rpm in both directions" in told(found)


@pytest.mark.long
def test_wild_readings_at_many_places_are_no_peak(make):
    about, columns = drive(lambda speed, order: np.zeros(speed.size))
    wild = np.arange(7, 140, 23)
    columns["friction_torque_Nm"][wild] *= 1.0 + 0.25 * (-1.0) ** np.arange(wild.size)
    found = diagnose_case(make(about, columns).folder)
    assert found.posterior.verdict == NOTHING
    assert found.outlier_runs == [int(r) for r in found.case.recordings["run"][wild]]


@pytest.mark.long
def test_few_wild_readings_at_one_place_are_no_peak(make):
    about, columns = drive(lambda speed, order: np.zeros(speed.size))
    there = np.flatnonzero(columns["speed_rpm"] == np.round(AT, 2))[:2]
    columns["friction_torque_Nm"][there] *= 1.25
    found = diagnose_case(make(about, columns).folder)
    assert found.posterior.verdict == NOTHING
    assert found.outlier_runs == [int(r) for r in found.case.recordings["run"][there]]


def remounted(speed, order):
    return np.where(order > 0.6, 0.15, 0.0)


def test_what_changes_at_one_moment_is_told_with_its_run(make):
    found = diagnose_case(make(*drive(remounted)).folder)
    assert found.posterior.verdict == DISCREPANCY
    assert found.search.discrepancy.best.form == "step"
    rows = found.case.recordings
    run = rows["run"][rows["sequence"] > 0.6][0]
    assert f"is a step at run {run:g}," in told(found)
    assert f"Look up what was done to the rig or the sample at run {run:g}," in told(found)


@pytest.mark.long
def test_a_sample_that_was_changed_is_no_drift(make):
    """Viscosity up and down in temperature; from two thirds on another fill, 12 % thicker."""
    celsius = np.concatenate([np.linspace(30.0, 100.0, 18), np.linspace(100.0, 30.0, 18)])
    order = np.linspace(0.0, 1.0, 36)
    read = by_d341(celsius) * np.where(order > 2 / 3, 1.12, 1.0)
    read = read * (1.0 + 0.01 * np.random.default_rng(2).standard_normal(36))
    columns = {"temperature_C": celsius, "sequence": order, "viscosity_mPa_s": read}
    found = diagnose_case(make(system("viscosity", "viscosity_mPa_s"), columns).folder)
    assert found.posterior.verdict == DISCREPANCY
    assert found.search.discrepancy.best.form == "step"
    assert found.search.discrepancy.best.at == pytest.approx(2 / 3, abs=0.06)


def test_a_friction_event_keeps_its_name(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = np.where(time > 4000.0, 0.13, 0.1) * (1.0 + 0.01 * np.random.default_rng(3).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert found.posterior.verdict == Explanation.of("friction_event")


@pytest.mark.long
def test_creep_that_few_readings_show_is_found_beside_running_in(make):
    """Every tenth reading at very low slip: under running-in alone they look like outliers.

    The bodies are as stiff under any friction, so what starts in proportion to slip does so by the same slope.
    """
    time = np.linspace(100.0, 20000.0, 60)
    slip = np.where(np.arange(60) % 10 == 4, 6e-4, np.tile([3e-3, 0.01, 0.03, 0.08, 0.14], 12))
    worn = 0.1 * (1.0 + 0.8 / (1.0 + time / 1500.0))
    friction = worn * -np.expm1(-330.0 * slip / worn) * (1.0 + 0.008 * np.random.default_rng(4).standard_normal(60))
    columns = {"time_s": time, "slide_roll_ratio": slip, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert "contact_creep" in found.posterior.verdict.effects
    assert not found.outlier_runs


@pytest.mark.long
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


@pytest.mark.long
def test_a_passing_disturbance_is_no_lasting_event(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = 0.1 * (1.0 + 0.3 * np.exp(-0.5 * ((time - 4000.0) / 250.0) ** 2))
    friction = friction * (1.0 + 0.01 * np.random.default_rng(5).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    if DISCREPANCY not in found.posterior.tied:
        named = found.search.best_named
        (event,) = found.search.problem.parameters(named.explanation, named.z).items()
        assert (event[0], event[1]["later"]) == ("friction_event", pytest.approx(-1.0, abs=0.1))


def test_a_step_is_unnamed_where_its_name_is_excluded(make):
    time = np.linspace(60.0, 7200.0, 60)
    friction = np.where(time > 4000.0, 0.13, 0.1) * (1.0 + 0.01 * np.random.default_rng(3).standard_normal(60))
    columns = {"time_s": time, "friction_coefficient": friction}
    case = make(system("friction_history", "friction_coefficient"), columns)
    found = diagnose_case(case.folder, exclude=["friction_event"])
    assert found.posterior.verdict == DISCREPANCY
    assert found.search.discrepancy.best.form == "step"


def films(dent=1.0, repeats=1):
    """Isothermal films of a ball at two loads and four slips; a corner of speed, slip and load is dented."""
    grid = np.meshgrid(np.geomspace(0.05, 3.0, 11), [0.0, 0.5, 1.0, 1.5], [20.0, 50.0])
    speed, slip, load = (np.repeat(x.ravel(), repeats) for x in grid)
    thickness = 380.0 * speed**0.67 * load**-0.067 * np.where((speed > 0.5) & (slip > 0.7) & (load < 30.0), dent, 1.0)
    celsius = np.full(speed.size, 40.0)
    return film(thickness, speed, slide_roll_ratio=slip, load_N=load, oil_temperature_C=celsius)


@pytest.mark.long
@pytest.mark.parametrize("repeats", [1, pytest.param(2, marks=pytest.mark.long)])
def test_a_corner_of_conditions_is_no_heap_of_outliers(make, repeats):
    """A dimple: films are a quarter thicker under a small load and fast sliding, and repeats agree on it."""
    found = diagnose_case(make(*films(1.25, repeats)).folder)
    assert found.posterior.verdict == DISCREPANCY
    box = {name: (low, high) for name, low, high in found.search.discrepancy.best.box}
    assert set(box) == {"entrainment_speed_m_s", "slide_roll_ratio", "load_N"}
    assert box["slide_roll_ratio"] == (0.75, np.inf)
    assert box["load_N"] == (-np.inf, 35.0)
    assert len(found.outlier_runs) <= 1
    assert "is a shift where " in told(found)
    assert "slide-roll ratio is from 1 on" in told(found)


@pytest.mark.long
def test_films_without_a_dent_have_no_box(make):
    assert diagnose_case(make(*films()).folder).posterior.verdict == NOTHING


@pytest.mark.long
def test_what_the_reading_before_left_behind_is_not_noise(make):
    """A quarter of each step of temperature is still to come when the film is read."""
    rng = np.random.default_rng(9)
    speed, celsius = (x.ravel() for x in np.meshgrid(np.geomspace(0.05, 2.0, 8), [30.0, 50.0, 70.0, 90.0]))
    shuffled = rng.permutation(speed.size)
    speed, celsius = speed[shuffled], celsius[shuffled]
    warm = celsius - 0.25 * np.diff(celsius, prepend=celsius[0])
    film = 1e3 * (0.1 * np.exp(-0.03 * (warm - 40.0)) * speed) ** 0.67 * (1.0 + 0.01 * rng.standard_normal(32))
    columns = {"entrainment_speed_m_s": speed, "oil_temperature_C": celsius, "film_thickness_nm": film}
    columns |= {"load_N": np.full(32, 20.0), "slide_roll_ratio": np.zeros(32), "sequence": np.linspace(0.0, 1.0, 32)}
    found = diagnose_case(make(system("film", "film_thickness_nm", contact=BALL), columns).folder)
    assert found.posterior.verdict == DISCREPANCY
    assert found.search.discrepancy.best.form == "delay"
    assert "follows the temperature of the previous reading" in told(found)
    assert "Wait longer after a change of temperature" in told(found)


def test_a_temperature_that_lags_has_caught_up_after_a_pause(make):
    """Whichever rows are asked for, the reading before is the recorded one; a step after a pause is a part of it."""
    time = np.concatenate([np.arange(0.0, 300.0, 10.0), np.arange(1290.0, 1590.0, 10.0)])
    celsius = 40.0 + 15.0 * np.sin(time / 160.0)
    columns = {"time_s": time, "temperature_C": celsius, "viscosity_mPa_s": 50.0 - 0.5 * celsius}
    case = make(system("viscosity", "viscosity_mPa_s"), columns)
    whole = Problem.of(case)
    moved = thermal_lag(whole, whole.run(NOTHING, np.zeros(whole.calibration_size)))
    slope = np.diff(celsius)
    per_kelvin = moved[1:30] / slope[:29]
    assert moved[30] == pytest.approx(np.median(per_kelvin) * slope[29] / 100.0, rel=0.3)
    few = whole.take(np.array([5, 30, 40]))
    assert thermal_lag(few, few.run(NOTHING, np.zeros(few.calibration_size))) == pytest.approx(
        moved[[5, 30, 40]], rel=1e-6
    )


@pytest.mark.long
@pytest.mark.parametrize("scatter", [1.0, 4.0])
def test_levels_left_out_are_those_of_the_condition_that_was_varied(make, scatter):
    """Seven films over nine times the speed; the load is measured and jitters by a few per cent or more."""
    rng = np.random.default_rng(2)
    speed = np.geomspace(0.12, 1.06, 7)
    columns = {
        "load_N": 20.0 + scatter * np.array([0.305, -0.108, 0.179, 0.191, 0.381, -0.743, -0.342]),
        "sequence": np.linspace(0.0, 1.0, 7),
        "entrainment_speed_m_s": speed,
        "slide_roll_ratio": np.zeros(7),
        "oil_temperature_C": np.full(7, 38.8),
        "film_thickness_nm": 560.0 * speed**0.6 * (1.0 + 0.01 * rng.standard_normal(7)),
    }
    found = diagnose_case(make(system("film", "film_thickness_nm", contact=BALL), columns).folder)
    assert "speed" in found.heldout.split


@pytest.mark.long
def test_a_film_that_rolls_is_not_swept_in_its_sliding(make):
    """It is measured and jitters about zero, so its values are no levels to leave out."""
    rng = np.random.default_rng(2)
    speed = np.geomspace(0.1, 2.0, 10)
    columns = {
        "load_N": np.full(10, 20.0),
        "entrainment_speed_m_s": speed,
        "slide_roll_ratio": 0.01 * rng.uniform(-1.0, 1.0, 10),
        "oil_temperature_C": np.full(10, 38.8),
        "film_thickness_nm": 560.0 * speed**0.6 * (1.0 + 0.01 * rng.standard_normal(10)),
    }
    found = diagnose_case(make(system("film", "film_thickness_nm", contact=BALL), columns).folder)
    assert [axis.name for axis in found.search.space.axes] == ["entrainment_speed_m_s"]
    assert "speed" in found.heldout.split
