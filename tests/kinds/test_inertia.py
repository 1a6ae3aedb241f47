"""Torque of machines that change speed while it is read."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.report.text.answer import effect_records
from mixedlub.importers import write_case
from mixedlub.kinds.acceleration import COLUMN, accelerated
from mixedlub.schema.table import Table

INERTIA = 0.012
RECORDING = {"quantity": "friction_torque_Nm"}


def run_up(folder, time, speed, acceleration, noise=0.004):
    """Torque 0.18 N m + 0.00011 N m/rpm speed + J acceleration."""
    torque = 0.18 + 0.00011 * speed + INERTIA * acceleration
    read = torque + np.random.default_rng(5).normal(0.0, noise, time.size)
    columns = {"time_s": time, "speed_rpm": speed, "friction_torque_Nm": read}
    write_case(folder, {"kind": "friction_map", "recording": RECORDING}, columns)
    return diagnose_case(folder)


def moment_of(d):
    (record,) = (e for e in effect_records(d) if e["id"] == "inertia")
    return record["parameters"][0]["absolute"]


def test_up_and_down_again_gives_the_moment_of_inertia_and_nothing_else(tmp_path):
    time = np.linspace(0.5, 120.0, 160)
    up = time < 60.0
    speed = np.where(up, 1500.0 * -np.expm1(-time / 18.0), 1446.5 * np.exp(-(time - 60.0) / 40.0))
    slope = np.where(up, 1500.0 / 18.0 * np.exp(-time / 18.0), -1446.5 / 40.0 * np.exp(-(time - 60.0) / 40.0))
    d = run_up(tmp_path, time, speed, slope * np.pi / 30.0)
    assert d.posterior.verdict.ids == ("inertia",)
    found = moment_of(d)
    assert found["unit"] == "kg m^2"
    assert found["low90"] < INERTIA < found["high90"]
    assert 0.0115 < found["value"] < 0.0125
    assert d.heldout.after < 1.3


@pytest.mark.long
def test_an_acceleration_that_is_a_line_over_speed_is_told_and_inertia_is_not_excluded(tmp_path):
    time = np.arange(0.0, 60.0, 0.5)
    speed = 1500.0 * -np.expm1(-time / 18.0)
    d = run_up(tmp_path, time, speed, 1500.0 / 18.0 * np.exp(-time / 18.0) * np.pi / 30.0)
    assert ("inertia",) in [key.ids for key in d.posterior.tied]
    assert "inertia_not_separable" in {one.code for one in d.warnings}


@pytest.mark.long
def test_a_slow_ramp_without_inertia_has_nothing_missing(tmp_path):
    time = np.arange(80.0) * 5.0
    d = run_up(tmp_path, time, np.linspace(50.0, 1500.0, 80), np.zeros(80))
    assert d.posterior.verdict.ids == ("none",)


@pytest.mark.parametrize("speed", [np.tile([100.0, 900.0, 300.0, 1500.0, 700.0], 8), np.full(40, 800.0)])
def test_speeds_in_any_order_and_steady_speed_have_no_acceleration(speed):
    rows = Table({"time_s": np.arange(40.0), "speed_rpm": speed})
    assert COLUMN not in accelerated(rows, rows).columns


def test_acceleration_at_a_sudden_change_of_torque_is_that_of_one_side():
    time = np.arange(0.0, 60.0, 0.5)
    speed = np.where(time < 30.0, 10.0 * time, 300.0 - 5.0 * (time - 30.0)) * 30.0 / np.pi
    rows = Table({"time_s": time, "speed_rpm": speed})
    found = accelerated(rows, rows)[COLUMN].round(9).tolist()
    assert found[:60] + found[61:] == [10.0] * 60 + [-5.0] * 59
    assert found[60] in (10.0, -5.0)


def test_rows_of_no_time_are_steady_and_rows_between_readings_are_not():
    time = np.linspace(0.0, 10.0, 41)
    log = Table({"time_s": time, "speed_rpm": 30.0 / np.pi * time**2})
    asked = Table({"time_s": np.array([2.125, 40.0]), "speed_rpm": np.array([40.0, 40.0])})
    assert accelerated(asked, log)[COLUMN].round(6).tolist() == [4.25, 0.0]
    assert accelerated(Table({"speed_rpm": np.array([40.0])}), log)[COLUMN].tolist() == [0.0]


def test_a_motor_that_stands_still_most_of_the_time_has_no_corner_at_each_reading_of_its_ramp():
    """Noise of 0.5 rpm on the ramp alone: a one-sided parabola would have two and a half times the error."""
    time = np.arange(0.0, 120.0, 0.5)
    ramp = np.clip(time - 80.0, 0.0, None) * 20.0
    speed = ramp + np.random.default_rng(3).normal(0.0, 0.5, time.size) * (time > 80.0)
    found = accelerated(rows := Table({"time_s": time, "speed_rpm": speed}), rows)[COLUMN]
    steady = (time > 83.0) & (time < 117.0)
    assert np.std(found[steady] * 30.0 / np.pi) < 0.35
