"""A channel that is dead, stuck or at its limit for a while is one fault, whatever its single readings look like."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.data_checks.faulty_stretches import faults, set_aside
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.report.text.answer import effect_records, next_tests_table, predictions
from mixedlub.importers import write_case
from mixedlub.recording.readings import rows_of

TIME = np.arange(2.0, 2002.0, 10.0)
DEAD = slice(118, 152)


def running_in(seed=3):
    """0.16 + 0.05 exp(-t/250 s), noise 0.002."""
    return 0.16 + 0.05 * np.exp(-TIME / 250.0) + np.random.default_rng(seed).normal(0.0, 0.002, TIME.size)


def dead(seed=3):
    """The same with both cells at noise about zero for 34 readings."""
    rng, y = np.random.default_rng(seed + 1), running_in(seed)
    y[DEAD] = rng.normal(0.0, 0.6, 34) / rng.uniform(0.4, 1.6, 34)
    y[[118, 151]] = -0.9, 0.9
    return y


def history(folder, y, **more):
    system = {"kind": "friction_history", "boundary_friction": 0.2, "uncertainty": {"boundary_friction": 0.05}}
    system["recording"] = {"quantity": "friction_coefficient"}
    return write_case(folder, system, {"time_s": TIME, "friction_coefficient": y, **more})


def found(folder, y, **more):
    return [one.rows.tolist() for one in faults(read_case(history(folder, y, **more)))]


@pytest.mark.parametrize("seed", range(6))
def test_a_dead_channel_is_one_fault_with_all_of_its_readings(tmp_path, seed):
    assert found(tmp_path, dead(seed)) == [list(range(118, 152))]


def test_its_readings_are_left_out_told_and_predicted_and_running_in_is_found(tmp_path):
    d = diagnose_case(history(tmp_path, dead()))
    assert set(d.outlier_runs) >= set(range(119, 153))
    assert len(d.outlier_runs) <= 36
    (fault,) = (one for one in d.warnings if one.code == "channel_faulty")
    assert fault.place == "run 119 to run 152"
    settling = {"friction_run_in", "two_time_scales", "tribofilm_growth", "running_in"}
    assert set(d.posterior.verdict.effects) <= settling
    assert d.posterior.verdict.effects
    assert {e["id"] for e in effect_records(d)} <= settling
    table = predictions(d).set_index("run")
    assert len(table) == len(rows_of(d.given)) == 200
    assert next_tests_table(d)["run"].min() == 201
    assert np.allclose(table.predicted.loc[119:152], 0.16 + 0.05 * np.exp(-TIME[DEAD] / 250.0), atol=0.002)


@pytest.mark.parametrize("value", [0.2137, 0.0, 0.161])
def test_a_channel_that_keeps_one_value_is_a_fault_at_its_limit_or_not(tmp_path, value):
    y = running_in()
    y[60:80] = value
    assert found(tmp_path, y) == [list(range(60, 80))]


def test_a_measured_condition_that_is_stuck_is_a_fault_too(tmp_path):
    speed = 1.0 + np.random.default_rng(7).normal(0.0, 0.01, TIME.size).round(4)
    speed[30:50] = speed[29]
    assert found(tmp_path, running_in(), entrainment_speed_m_s=speed) == [list(range(29, 50))]


def test_an_event_a_few_wild_readings_and_friction_near_zero_are_no_fault(tmp_path):
    event = running_in()
    event[100:140] += 0.15
    assert found(tmp_path / "event", event) == []
    assert found(tmp_path / "falls", running_in() - 0.13 * (TIME > 900.0)) == []
    wild = running_in()
    wild[[20, 90, 170]] = -0.3, 1.2, 2.0
    assert found(tmp_path / "wild", wild) == []
    rolling = np.random.default_rng(2).normal(0.001, 0.002, TIME.size)
    assert found(tmp_path / "rolling", rolling) == []
    assert found(tmp_path / "rounded", running_in().round(2)) == []


def test_a_case_without_a_fault_stays_the_same_object(tmp_path):
    case = read_case(history(tmp_path, running_in()))
    assert set_aside(case) == (case, None, ())
