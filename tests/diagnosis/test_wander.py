"""Noise that wanders in time: it is no event, and events and laws in it are found all the same."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.importers import write_case
from mixedlub.recording.correlated_error import UNCORRELATED, CorrelatedError
from mixedlub.schema.findings import codes
from mixedlub.schema.table import Table

COUNT, SINGLE = 120, 0.005
CLOCK = np.linspace(30.0, 7200.0, COUNT)


def wandering_noise(seed, alike, size):
    rng = np.random.default_rng(seed)
    found = np.empty(COUNT)
    found[0] = rng.standard_normal()
    for i in range(1, COUNT):
        found[i] = alike * found[i - 1] + np.sqrt(1.0 - alike**2) * rng.standard_normal()
    return size * found + SINGLE * rng.standard_normal(COUNT)


def answer_to(folder, friction, clock=CLOCK):
    system = {
        "kind": "friction_history",
        "recording": {"quantity": "friction_coefficient", "noise": {"relative": SINGLE}},
    }
    write_case(folder, system, {"time_s": clock, "friction_coefficient": friction})
    return diagnose_case(folder)


@pytest.fixture(scope="module")
def wandering(tmp_path_factory):
    """The answer to noise that wanders, and nothing else."""
    return answer_to(tmp_path_factory.mktemp("wandering"), 0.1 * (1.0 + wandering_noise(3, 0.9, 0.01)))


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2])
def test_wandering_noise_is_no_event(tmp_path, seed):
    d = answer_to(tmp_path, 0.1 * (1.0 + wandering_noise(seed, 0.9, 0.01)))
    assert d.posterior.verdict in (NOTHING, DISCREPANCY)
    assert {"residuals_drift", "residuals_autocorrelated", "scatter_above_stated"} & set(codes(d.warnings))


@pytest.mark.long
def test_noise_that_is_seen_to_wander_is_told_as_that(wandering):
    assert wandering.posterior.verdict == NOTHING
    assert wandering.search.problem.correlated_error.size >= 1.0
    assert "residuals_drift" in codes(wandering.warnings)


def test_noise_that_does_not_wander_is_left_as_it_is(tmp_path):
    d = answer_to(tmp_path, 0.1 * (1.0 + wandering_noise(4, 0.0, 0.0)))
    assert d.search.problem.correlated_error == UNCORRELATED
    assert "residuals_drift" not in codes(d.warnings)


@pytest.mark.long
@pytest.mark.parametrize(
    ("form", "name"),
    [
        (1.0 + 0.2 * np.exp(-CLOCK / 900.0), "friction_run_in"),
        (np.where(CLOCK > 4100.0, 1.06, 1.0), "friction_event"),
    ],
    ids=["run-in", "event"],
)
def test_what_happens_is_found_in_wandering_noise(tmp_path, form, name):
    d = answer_to(tmp_path, 0.1 * form * (1.0 + wandering_noise(5, 0.8, 0.01)))
    assert name in d.posterior.verdict.effects
    assert d.search.problem.correlated_error.size


def test_an_error_that_wanders_is_the_same_for_some_of_the_rows():
    rows = Table({"time_s": CLOCK}, "rows")
    correlated_error = CorrelatedError.over(CLOCK, 2.0, 0.2)
    some = np.arange(0, COUNT, 3)
    whole, part = correlated_error.columns(rows), correlated_error.columns(rows.take(some))
    assert (part @ part.T) == pytest.approx((whole @ whole.T)[np.ix_(some, some)])
    assert correlated_error.columns(Table({"load_N": CLOCK}, "rows")).shape == (COUNT, 0)


@pytest.mark.long
def test_a_new_reading_scatters_as_the_recorded_ones(wandering):
    d = wandering
    inside = (d.readings > d.recorded.low90) & (d.readings < d.recorded.high90)
    assert 0.84 < inside.mean() < 0.97


@pytest.mark.long
@pytest.mark.parametrize("count", [125, 250])
def test_what_swings_far_beyond_the_noise_is_a_state(tmp_path, count):
    """Friction of 500 traction cycles as measured (ETM, slide-roll ratio above 15 %), its turning points typed in."""
    cycle = np.linspace(1.0, 500.0, count)
    turns = (1, 6, 55, 106, 165, 205, 339, 500), (0.058, 0.0514, 0.0575, 0.0487, 0.067, 0.051, 0.0686, 0.06)
    noise = 0.0008 * np.random.default_rng(count).standard_normal(count)
    d = answer_to(tmp_path, np.interp(cycle, *turns) + noise, 533.0 * cycle)
    assert d.test.detected
    assert d.posterior.verdict != NOTHING


@pytest.mark.long
def test_set_ups_that_are_off_do_not_wander(tmp_path):
    """What a new reading scatters by beside its set-up's error does not grow with how far set-ups are off."""
    noise = wandering_noise(3, 0.9, 0.01)
    widths = []
    for apart in (0.0, 0.05):
        setup = np.repeat(["a", "b", "c"], COUNT // 3)
        off = np.repeat([1.0, -1.0, 0.3], COUNT // 3) * apart
        system = {
            "kind": "friction_history",
            "recording": {
                "quantity": "friction_coefficient",
                "noise": {"relative": SINGLE, "setup_relative": 0.05},
            },
        }
        columns = {"time_s": CLOCK, "setup": setup, "friction_coefficient": 0.1 * (1.0 + noise + off)}
        d = diagnose_case(write_case(tmp_path / str(apart), system, columns))
        widths.append(np.median(d.recorded.high90 - d.recorded.low90))
    assert widths[1] == pytest.approx(widths[0], rel=0.15)


@pytest.mark.long
def test_two_readings_of_one_second_change_nothing(tmp_path):
    friction = 0.1 * (1.0 + wandering_noise(3, 0.9, 0.01))
    clock = CLOCK.copy()
    clock[52] = clock[51]
    d = answer_to(tmp_path, friction, clock)
    assert d.posterior.verdict == NOTHING
    assert d.search.problem.correlated_error.size
