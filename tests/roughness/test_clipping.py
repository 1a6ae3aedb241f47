"""Traces clipped at the end of the range or held constant, and those that only look alike."""

import numpy as np
import pytest

from profiles import Profile
from profiles.finishes import honed
from roughness import normal_probability, trace_record
from roughness.clipping import clipping

STEP = 0.5e-6
SIGMA = 0.3e-6


def gaussian(seed, correlation=4, count=8000):
    """Gaussian heights (m) that neighbours within some points share."""
    lag = np.arange(-4 * correlation, 4 * correlation + 1)
    noise = np.random.default_rng(seed).standard_normal(count + lag.size - 1)
    z = np.convolve(noise, np.exp(-0.5 * (lag / correlation) ** 2), "valid")
    return SIGMA * z / z.std()


def rounded(z, quantum):
    return np.round(z / quantum) * quantum if quantum else z


@pytest.mark.parametrize("quantum", [0.0, 0.01 * SIGMA, 0.1 * SIGMA])
@pytest.mark.parametrize("sigmas", [1.0, 1.5, 2.0, 2.5])
@pytest.mark.parametrize(("low", "high"), [(False, True), (True, False), (True, True)])
def test_clipped_heights_are_told_with_their_share(quantum, sigmas, low, high):
    for seed in range(5):
        z = gaussian(seed, 2)
        limits = -sigmas * SIGMA if low else None, sigmas * SIGMA if high else None
        cut = rounded(np.clip(z, *limits), quantum)
        found = clipping(Profile(cut, STEP))
        assert (found.low > 0, found.high > 0) == (low, high)
        share = np.mean(cut == cut.max()) if high else np.mean(cut == cut.min())
        assert (found.high if high else found.low) == pytest.approx(share, rel=0.02)


@pytest.mark.parametrize("sigmas", [1.5, 2.0, 2.5])
def test_clipped_heights_are_not_called_gaussian(sigmas):
    z = gaussian(7)
    free, cut = (Profile(rounded(heights, 1e-9), STEP) for heights in (z, np.clip(z, -sigmas * SIGMA, sigmas * SIGMA)))
    assert trace_record(free, cutoff=None)[1]["gaussian"]["verdict"] == "gaussian"
    profile, record = trace_record(cut, cutoff=None)
    assert record["gaussian"]["verdict"] == "not_gaussian"
    assert any("clipped" in text for text in record["warnings"])
    assert normal_probability(cut).verdict == normal_probability(profile).verdict == "not_gaussian"


def test_quantised_gaussian_heights_are_not_clipped():
    told = []
    for seed in range(200):
        quantum = (0.0, 1e-4, 0.01, 0.05, 0.1, 0.2, 0.5)[seed % 7] * SIGMA
        told.append(clipping(Profile(rounded(gaussian(seed, 1 + seed % 12), quantum), STEP)))
    assert not any(told)


@pytest.mark.parametrize("quantum", [0.0, 1e-9, 10e-9, 50e-9, 0.2e-6])
def test_a_honed_plateau_is_not_clipped(quantum):
    for seed in range(8):
        trace = honed(
            plateau_rms=0.05e-6, valley_rms=0.6e-6, plateau_share=0.8, points=8000, spacing=STEP, seed=seed
        ).profile
        found = Profile(rounded(trace.heights, quantum), STEP)
        assert not clipping(found)
        if quantum < 10e-9:
            assert normal_probability(found).verdict == "plateau"


@pytest.mark.parametrize("quantum", [1e-9, 20e-9])
def test_waves_arcs_and_squares_are_not_clipped(quantum):
    x = np.arange(6000)
    arc = -1e-5 * (x / 3000.0 - 1.0) ** 2 + 0.05e-6 * np.random.default_rng(1).standard_normal(6000)
    for z in (1e-6 * np.sin(x / 31.7), arc, 1e-6 * np.sign(np.sin(x / 40.0 + 0.01))):
        assert not clipping(Profile(rounded(z, quantum), STEP))


@pytest.mark.parametrize("level", [0.0, 1e-6, None], ids=["mean", "above", "top"])
@pytest.mark.parametrize(("first", "last"), [(7400, 8000), (4000, 4600), (0, 300)])
@pytest.mark.parametrize("quantum", [0.0, 0.01 * SIGMA, 0.1 * SIGMA])
def test_a_stretch_of_constant_heights_is_told_with_its_ends(quantum, first, last, level):
    for correlation in (2, 8, 16):
        z = rounded(gaussian(3, correlation), quantum)
        z[first:last] = z.max() if level is None else level
        found = clipping(Profile(z, STEP))
        (ends,) = found.constant
        assert ends == pytest.approx((first * STEP, (last - 1) * STEP), abs=20 * STEP)
        assert f"heights constant from {1e3 * ends[0]:.4g} to " in str(found)
    assert trace_record(Profile(z, STEP), cutoff=None)[1]["gaussian"]["verdict"] == "not_gaussian"


def test_several_constant_stretches_are_all_told():
    z = gaussian(5)
    for start in (500, 3000, 7000):
        z[start : start + 200] = 0.0
    assert [round(one[0] / STEP) for one in clipping(Profile(z, STEP)).constant] == [500, 3000, 7000]
