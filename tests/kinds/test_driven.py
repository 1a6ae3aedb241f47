"""Drives that are loaded in both senses: what their gears lose, and what the motor's torque constant may be."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.effects import find
from mixedlub.importers import write_case
from mixedlub.kinds.friction_map import load_sense
from mixedlub.schema.table import Table


def map_of(folder, driving, driven, seed=8):
    """Friction sgn(speed) (2 N m + c |load|) + 0.04 N m/rpm speed, c by who drives; noise 0.15 N m."""
    speed = np.repeat([-30.0, -15.0, -5.0, 5.0, 15.0, 30.0], 9)
    load = np.tile(np.linspace(-80.0, 80.0, 9), 6)
    share = np.where(speed * load >= 0.0, driving, driven)
    friction = np.sign(speed) * (2.0 + share * np.abs(load)) + 0.04 * speed
    read = friction + np.random.default_rng(seed).normal(0.0, 0.15, speed.size)
    columns = {"speed_rpm": speed, "torque_Nm": load, "friction_torque_Nm": read.round(5)}
    recording = {"quantity": "friction_torque_Nm", "noise": {"absolute": 0.15}}
    write_case(folder, {"kind": "friction_map", "recording": recording}, columns)
    return diagnose_case(folder)


def tied(d):
    return [set(key.ids) for key in d.posterior.tied]


def test_a_loss_that_depends_on_who_drives_is_tied_with_the_torque_constant(tmp_path):
    d = map_of(tmp_path, 0.10, 0.16)
    assert {"back_driving"} in tied(d)
    assert {"torque_constant", "load_dependent_friction"} in tied(d)
    chances = d.posterior.inclusion(d.search)
    assert 0.09 < chances["torque_constant"] < 0.91
    (law,) = find("back_driving")
    assert "stalled output" in law.separated_by


@pytest.mark.long
def test_gears_that_lose_alike_both_ways_need_no_difference(tmp_path):
    d = map_of(tmp_path, 0.13, 0.13)
    assert all("load_dependent_friction" in ids for ids in tied(d))
    assert not any({"back_driving", "torque_constant"} & ids for ids in tied(d))
    assert d.posterior.inclusion(d.search)["back_driving"] < 0.2


def test_the_sense_of_the_load_is_that_of_its_power():
    columns = {"speed_rpm": np.array([100.0, -100.0, 50.0]), "torque_Nm": np.array([10.0, 20.0, 0.0])}
    assert load_sense(Table(columns)).tolist() == [1.0, -1.0, 0.0]
