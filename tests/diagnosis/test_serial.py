"""Noise that lasts over several readings: a logged series tells less than the number of its readings."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.search.autocorrelation import batch_means_inflation
from mixedlub.schema.findings import codes

from ..kinds.conftest import make, system

__all__ = ["make"]

COUNT = 800
TIME = np.arange(1.0, COUNT + 1.0)


def lasting_noise(correlation: float, seed: int) -> np.ndarray:
    """Unit noise of the first order, each reading correlated so with the one before."""
    fresh = np.sqrt(1.0 - correlation**2) * np.random.default_rng(seed).standard_normal(COUNT)
    return lfilter([1.0], [1.0, -correlation], fresh)


def answer(make, friction: np.ndarray) -> Diagnosis:
    columns = {"time_s": TIME, "friction_coefficient": friction}
    return diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)


@pytest.mark.parametrize("variance", [1.0, 1.5, 2.0])
@pytest.mark.parametrize(("correlation", "low", "high"), [(0.0, 0.0, 0.1), (0.3, 0.8, 1.0)])
def test_lack_of_fit_is_no_autocorrelation(variance: float, correlation: float, low: float, high: float) -> None:
    series = [np.sqrt(variance) * lasting_noise(correlation, seed) for seed in range(200)]
    fired = np.mean([batch_means_inflation(one, TIME) > 1.0 for one in series])
    assert low <= fired <= high


@pytest.mark.long
@pytest.mark.parametrize("correlation", [0.0, 0.8])
def test_noise_that_lasts_is_no_mismatch(make, correlation: float) -> None:
    """A first-order series tells (1 - r)/(1 + r) of its readings' number: 9 for one at r = 0.8."""
    d = answer(make, 0.1 * (1.0 + 0.01 * lasting_noise(correlation, 3)))
    count = d.search.problem.n_per_effective
    assert d.posterior.verdict == NOTHING
    assert (count == 1.0) if correlation == 0.0 else (4.0 < count < 18.0)
    assert ("residuals_autocorrelated" in codes(d.warnings)) == (correlation > 0.0)


@pytest.mark.long
def test_what_is_there_is_still_found_and_a_new_reading_scatters_as_one(make) -> None:
    friction = 0.1 + 0.02 * np.exp(-TIME / 120.0)
    d = answer(make, friction * (1.0 + 0.01 * lasting_noise(0.8, 4)))
    assert "friction_run_in" in {name for key in d.posterior.tied for name in list(key.ids)}
    half = 0.5 * (d.recorded.high90 - d.recorded.low90)
    assert np.median(half) == pytest.approx(1.645 * 0.01 * np.median(friction), rel=0.25)
    assert d.recorded.sd == pytest.approx(0.01 * d.recorded.predicted)
    inside = (d.readings > d.recorded.low90) & (d.readings < d.recorded.high90)
    assert 0.85 < inside.mean() < 0.96


@pytest.mark.long
def test_the_seconds_after_a_start_are_no_effect(make) -> None:
    """A start that settles within 2 s, of 800 s that are held: wrong readings, and nothing missing."""
    friction = 0.1 * (1.0 + 0.01 * np.random.default_rng(5).standard_normal(COUNT)) + 0.04 * np.exp(-TIME / 1.5)
    d = answer(make, friction)
    assert d.posterior.verdict == NOTHING
    assert {1, 2, 3} <= set(d.outlier_runs)


@pytest.mark.long
@pytest.mark.parametrize(
    "seed",
    [
        0,
        pytest.param(1, marks=pytest.mark.long),
        pytest.param(2, marks=pytest.mark.long),
        pytest.param(3, marks=pytest.mark.long),
    ],
)
def test_noise_of_two_paces_is_no_mismatch(make, seed: int) -> None:
    """Slow noise under as much that is new at each reading: a free form follows the slow part well."""
    noise = 0.7 * lasting_noise(0.95, seed) + 0.7 * np.random.default_rng(100 + seed).standard_normal(COUNT)
    d = answer(make, 0.1 * (1.0 + 0.01 * noise))
    assert not d.test.detected
    assert d.posterior.verdict == NOTHING
