"""Noise, quantum and tip: what they add is what is predicted."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import moments, roughness_profile
from roughness.noise import (
    height_quantum,
    noise_moments,
    tip_limited_wavelength,
    tip_reconstructed,
    tip_traced,
    without_noise,
)

NOISE = np.random.default_rng(0).normal(size=400_000) * 2e-9


@pytest.mark.parametrize("short", [None, 4e-6])
def test_noise_moments_are_those_of_filtered_noise(short):
    m = moments(roughness_profile(Profile(NOISE, 0.5e-6), short_cutoff=short))
    for found, expected in zip((m.m0, m.m2, m.m4), noise_moments(2e-9, 0.5e-6, short)):
        assert found == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("short", [None, 8e-6])
def test_correction_restores_the_clean_moments(gaussian_trace, short):
    clean = gaussian_trace(100_000)
    noisy = Profile(clean.heights + NOISE[:100_000], clean.spacing)
    before, true = (moments(roughness_profile(p, short_cutoff=short)) for p in (noisy, clean))
    assert without_noise(before, 2e-9).m4 == pytest.approx(true.m4, rel=0.02)
    if short is None:
        assert before.m4 > 1.15 * true.m4


def test_quantum_is_read_from_the_levels(gaussian_trace):
    z = np.round(gaussian_trace().heights / 7.6e-8) * 7.6e-8
    assert height_quantum(Profile(z, 1e-6)) == pytest.approx(7.6e-8, rel=1e-6)


def test_smooth_heights_have_no_quantum(gaussian_trace):
    assert height_quantum(gaussian_trace()) is None


def test_quantisation_acts_as_noise_of_a_twelfth(gaussian_trace):
    p = gaussian_trace(100_000)
    rounded = Profile(np.round(p.heights / 2e-8) * 2e-8, p.spacing)
    corrected = without_noise(moments(rounded), 2e-8 / np.sqrt(12))
    assert moments(rounded).m4 > 2 * moments(p).m4
    assert corrected.m4 == pytest.approx(moments(p).m4, rel=0.1)


def test_noise_as_large_as_the_surface_is_refused(gaussian_trace):
    with pytest.raises(InputError, match="nothing is left"):
        without_noise(moments(gaussian_trace()), 1e-6)


def test_tip_leaves_gentle_waves_and_fills_sharp_valleys():
    x = np.arange(4000) * 0.1e-6
    gentle = Profile(50e-9 * np.sin(2 * np.pi * x / 50e-6), 0.1e-6)
    sharp = Profile(500e-9 * np.abs(np.sin(2 * np.pi * x / 8e-6)), 0.1e-6)
    inner = slice(200, -200)
    assert np.abs(tip_traced(gentle, 2e-6).heights - gentle.heights)[inner].max() < 1e-12
    assert tip_traced(sharp, 5e-6).heights[inner].min() > 100e-9


def test_reconstruction_undoes_what_the_tip_touched(gaussian_trace):
    p = gaussian_trace(spacing=0.2e-6, short=3e-6)
    seen = tip_reconstructed(tip_traced(p, 5e-6), 5e-6).heights
    assert (seen >= p.heights - 1e-15).all()
    assert np.mean(seen - p.heights < 1e-12) > 0.6


@pytest.mark.parametrize("radius", [2e-6, 10e-6])
def test_tip_limit_grows_with_the_tip(gaussian_trace, radius):
    drawn = tip_traced(Profile(20 * gaussian_trace(spacing=0.2e-6, short=1e-6).heights, 0.2e-6), radius)
    assert tip_limited_wavelength(drawn, radius) > 0
    assert tip_limited_wavelength(drawn, 2 * radius) >= tip_limited_wavelength(drawn, radius)


def test_a_deep_fall_does_not_hide_the_height_step(gaussian_trace):
    """Written to 0.1 nm, with 200 um of chamfer: the gap between far levels is no resolution."""
    p = gaussian_trace()
    fallen = 0.3 * p.heights - 0.5 * np.maximum(0.0, p.positions - 4.4e-3)
    written = Profile(np.round(fallen * 1e10) * 1e-10, p.spacing)
    assert height_quantum(written) == pytest.approx(1e-10, rel=0.01)
