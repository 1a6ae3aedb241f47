"""Set-points that jitter are levels, sweeps are not."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.assessment.location import region
from mixedlub.recording.set_points import set_points
from mixedlub.schema.table import Table

RNG = np.random.default_rng(5)


def test_a_region_at_a_jittering_load_is_that_load() -> None:
    load = np.repeat([3.0, 9.0], 8) + 0.004 * RNG.standard_normal(16)
    found = region(Table({"load_N": load}), ["load_N"], np.where(load < 6.0, 8.0, 0.5))
    assert found.inside.tolist() == (load < 6.0).tolist()
    (cut,) = found.where
    assert cut["low"] == load[:8].min()
    assert cut["high"] == load[:8].max()


def test_temperatures_that_wander_by_a_kelvin_are_one_level() -> None:
    set_to = np.repeat([40.0, 60.0, 90.0], 10)
    assert np.unique(set_points(set_to + RNG.uniform(-0.4, 0.4, 30))).tolist() == [40.0, 60.0, 90.0]


def test_a_sweep_stays_a_sweep() -> None:
    time = np.linspace(0.0, 7200.0, 400)
    assert set_points(time) is time


def test_a_sweep_of_many_values_is_cut_where_there_are_values() -> None:
    """Between two clusters a twelfth of the readings can hold none."""
    time = np.concatenate([np.linspace(0.0, 10.0, 20), np.linspace(5000.0, 7200.0, 5)])
    found = region(Table({"time_s": time}), ["time_s"], np.where(time > 100.0, 6.0, 0.3))
    assert [cut["column"] for cut in found.where] == ["time_s"]
