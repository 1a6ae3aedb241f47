"""Bootstrap and short cut-off band."""

from dataclasses import replace

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import moments, roughness_profile
from roughness.uncertainty import bootstrap, short_cutoff_band, smoothed_moments


def test_bootstrap_covers_the_truth(gaussian_trace):
    """Short pieces of one long surface: their 90 % intervals hold its moments four times in five or more."""
    long = gaussian_trace(400_000)
    truth = moments(long).m4
    pieces = np.array_split(long.heights, 40)
    held = [low <= truth <= high for z in pieces for low, high in [bootstrap(Profile(z, 0.5e-6), sections=8)["m4"]]]
    assert np.mean(held) >= 0.75


def test_bootstrap_narrows_with_length(gaussian_trace):
    def width(n):
        low, high = bootstrap(gaussian_trace(n), sections=n // 1600)["m0"]
        return high / low

    assert width(160_000) < 0.6 * (width(16_000) - 1) + 1


def test_bootstrap_of_two_sections_is_refused(gaussian_trace):
    with pytest.raises(InputError, match="at least three"):
        bootstrap(gaussian_trace(), sections=2)


def test_band_falls_with_the_short_cutoff(gaussian_trace):
    half, one, two = short_cutoff_band(
        gaussian_trace(), 8e-6, lambda p, s: roughness_profile(p, cutoff=0.8e-3, short_cutoff=s)
    )
    assert half.m4 > one.m4 > two.m4
    assert [m.short_cutoff for m in (half, one, two)] == [4e-6, 8e-6, 16e-6]


def test_band_leaves_out_what_the_trace_cannot_show(gaussian_trace):
    found = short_cutoff_band(gaussian_trace(), 1.2e-6, lambda p, s: roughness_profile(p, short_cutoff=s))
    assert [m.short_cutoff for m in found] == [1.2e-6, 2.4e-6]


def test_two_gaussians_are_one(gaussian_trace):
    p = gaussian_trace(40_000)
    once = moments(roughness_profile(p, short_cutoff=16e-6))
    twice = smoothed_moments(roughness_profile(p, short_cutoff=8e-6), 16e-6)
    assert twice.m2 == pytest.approx(once.m2, rel=5e-3)
    assert twice.m4 == pytest.approx(once.m4, rel=1e-2)


def test_smoothing_backwards_is_refused(gaussian_trace):
    with pytest.raises(InputError, match="above the 8 um already filtered"):
        smoothed_moments(replace(gaussian_trace(), cutoffs={"short_cutoff": 8e-6}), 4e-6)
