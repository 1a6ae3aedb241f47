"""Readings of several assemblies: their common errors stand in for no physics and do not move the calibration."""

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation

from .conftest import system

SPEED = np.geomspace(20.0, 400.0, 12)
LOADS = (10.0, 40.0, 70.0, 100.0)
ASSEMBLIES = 4


def drive(load_share, spread, seed=1):
    """Friction of four assemblies, each off by its own factor, at four loads."""
    rng = np.random.default_rng(seed)
    speed, load, which = (x.ravel() for x in np.meshgrid(SPEED, np.array(LOADS), np.arange(ASSEMBLIES), indexing="ij"))
    factor = 1.0 + spread * rng.standard_normal(ASSEMBLIES)
    friction = (2.0 * (1.0 + load_share * load / 100.0) + 0.8 * speed / 400.0) * factor[which]
    read = friction * (1.0 + 0.02 * rng.standard_normal(speed.size))
    sections = system("friction_map", "friction_torque_Nm")
    sections["recording"] = {
        "quantity": "friction_torque_Nm",
        "noise": {"relative": 0.02, "setup_relative": spread},
    }
    names = np.array([f"assembly {k + 1}" for k in range(ASSEMBLIES)])[which]
    return sections, {"speed_rpm": speed, "load_N": load, "setup": names, "friction_torque_Nm": read}


@pytest.mark.long
@pytest.mark.parametrize("spread", [0.05, 0.2])
def test_a_load_that_counts_is_found_across_assemblies_and_calibration_stays_near(make, spread):
    found = diagnose_case(make(*drive(1.0, spread)).folder)
    assert found.test.detected
    assert found.posterior.verdict == Explanation.of("load_dependent_friction")
    ratio = np.median(found.recorded.calibrated / found.readings)
    assert 0.8 < ratio < 1.25


@pytest.mark.long
def test_assemblies_that_differ_are_no_physics(make):
    found = diagnose_case(make(*drive(0.0, 0.2)).folder)
    assert found.posterior.verdict == NOTHING
    assert np.median(found.recorded.predicted / found.readings) == pytest.approx(1.0, abs=0.3)
