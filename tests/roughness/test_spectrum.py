"""Spectrum and autocorrelation on processes whose own are known."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import autocorrelation, correlation_length, power_density
from roughness.spectrum import log_binned


def test_spectrum_integrates_to_the_variance(gaussian_trace):
    p = gaussian_trace(40_000, roll=10e-6)
    f, g = power_density(p)
    assert g.sum() * f[1] == pytest.approx(p.heights.var(), rel=0.03)


def test_white_noise_is_flat():
    f, g = power_density(Profile(np.random.default_rng(0).normal(size=100_000), 1e-6))
    assert log_binned(f, g)[1][-10:] == pytest.approx(2e-6, rel=0.1)


def test_tilt_does_not_fill_the_short_waves():
    p = Profile(np.linspace(-1, 1, 5000), 1e-6)
    f, g = power_density(p)
    assert g[f > 1e5].max() < 1e-9 * g.max()


def test_autocorrelation_of_a_cosine_is_a_fading_cosine():
    x = np.arange(4000)
    r = autocorrelation(Profile(np.cos(2 * np.pi * x / 100), 1e-6))
    assert r == pytest.approx((1 - x / 4000) * np.cos(2 * np.pi * x / 100), abs=5e-3)


@pytest.mark.parametrize("fall", [0.2, 1 / np.e])
def test_correlation_length_of_a_first_order_process(fall):
    from scipy.signal import lfilter

    z = lfilter([1], [1, -0.98], np.random.default_rng(0).normal(size=400_000))
    assert correlation_length(Profile(z, 1e-6), fall_to=fall) == pytest.approx(
        np.log(fall) / np.log(0.98) * 1e-6, rel=0.1
    )


def test_flat_profile_has_no_autocorrelation():
    with pytest.raises(InputError, match="is flat"):
        autocorrelation(Profile(np.zeros(10), 1e-6))
