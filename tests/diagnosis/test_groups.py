"""Specimens and laboratories: groups with an error of their own, neither physics nor a fault of the clock."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.search.setup_error import has_groups
from mixedlub.importers import write_case
from mixedlub.recording.conditions import clock_of
from mixedlub.schema.table import Table

from ..kinds.conftest import OIL


def specimens(folder, offset, column="setup", noise=0.002):
    """Friction 0.2 of two specimens that differ by an offset, each running in by 0.06 exp(-t/400 s) from zero time."""
    time = np.tile(np.arange(0.0, 3000.0, 50.0), 2)
    which = np.repeat(["first", "second"], 60)
    friction = 0.2 + 0.06 * np.exp(-time / 400.0) + offset * (which == "second")
    read = friction + np.random.default_rng(4).normal(0.0, noise, time.size)
    system = {"kind": "friction_history", "boundary_friction": 0.2, "uncertainty": {"boundary_friction": 0.05}}
    system["recording"] = {"quantity": "friction_coefficient"}
    return write_case(folder, system, {column: which, "time_s": time, "friction_coefficient": read})


@pytest.mark.parametrize("column", ["setup", "specimen"])
def test_a_second_specimen_is_a_group_and_no_clock_that_runs_backwards(tmp_path, column):
    d = diagnose_case(specimens(tmp_path, 0.03, column))
    codes = {one.code for one in d.warnings}
    assert not codes & {"time_backwards", "things_pooled"}
    assert "setup_error_estimated" in codes
    assert ("column_as_setup" in codes) == (column != "setup")
    stated = d.case.system.recording.noise
    assert np.hypot(stated.setup_relative * 0.2, stated.setup_absolute) == pytest.approx(0.02, rel=0.6)
    assert stated.absolute == pytest.approx(0.002, rel=0.3)
    assert "friction_run_in" in d.posterior.verdict.effects
    assert "friction_event" not in {name for key in d.posterior.tied for name in key.effects}


def test_equal_specimens_get_no_error_of_their_own(tmp_path):
    stated = diagnose_case(specimens(tmp_path, 0.0)).case.system.recording.noise
    assert not stated.of_setups


def test_laboratories_that_differ_by_a_gain_are_told_from_the_law_of_pressure(tmp_path):
    """McEwen's form, eta0 (1 + p/c)^4 with c 320 MPa, of six laboratories with errors of 2 %."""
    rng = np.random.default_rng(9)
    pressure, lab = (x.ravel() for x in np.meshgrid([0.1, 50.0, 100.0, 200.0, 300.0, 400.0], np.arange(6)))
    eta = 5.0 * (1.0 + pressure / 320.0) ** 4 * (1.0 + rng.normal(0.0, 0.02, 6))[lab]
    eta *= 1.0 + rng.normal(0.0, 0.005, eta.size)
    oil = {**OIL, "kinematic_viscosity_mm2_s": [6.5, 2.6], "pressure_viscosity_per_GPa": [12.5, 10.6]}
    oil |= {"density_15C_kg_m3": 815.0, "density_change_per_K": 8e-4}
    system = {"kind": "viscosity", "lubricant": oil, "uncertainty": {"viscosity": 0.03, "pressure_viscosity": 0.15}}
    system["recording"] = {"quantity": "viscosity_mPa_s", "noise": {"relative": 0.006}}
    columns = {"laboratory": [f"L{k}" for k in lab], "temperature_C": np.full(36, 40.0), "pressure_MPa": pressure}
    d = diagnose_case(write_case(tmp_path, system, {**columns, "viscosity_mPa_s": eta}))
    assert d.case.system.recording.noise.setup_relative in (0.01, 0.03)
    assert "pressure_viscosity_law" in d.posterior.verdict.effects
    chances = d.posterior.inclusion(d.search)
    assert max(chances.get("sensor_offset", 0.0), chances.get("sensor_gain", 0.0)) < 0.5


def test_a_stated_error_and_single_readings_are_left_as_they_are(tmp_path):
    case = read_case(specimens(tmp_path, 0.03))
    assert has_groups(case)
    rows = case.recordings
    alone = Table({**rows.columns, "setup": np.array([str(k) for k in range(len(rows))])})
    assert not has_groups(type(case)(**{**vars(case), "recordings": alone}))


def test_clocks_of_set_ups_follow_each_other_and_interleaved_ones_stay():
    times = np.array([0.0, 1.0, 2.0])
    after = Table({"time_s": np.tile(times, 2), "setup": np.repeat(["a", "b"], 3)})
    assert clock_of(after).tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    mixed = Table({"sequence": np.array([0.0, 0.6, 0.2, 0.8]), "setup": np.array(["a", "b", "a", "b"])})
    assert clock_of(mixed).tolist() == [0.0, 0.6, 0.2, 0.8]
