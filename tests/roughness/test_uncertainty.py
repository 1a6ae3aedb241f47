"""Bootstrap and short cut-off band."""

from dataclasses import replace

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import mccool_asperities, moments, roughness_profile
from roughness.uncertainty import bootstrap, short_cutoff_band, smoothed_moments


@pytest.mark.parametrize("sections", [3, *(pytest.param(n, marks=pytest.mark.long) for n in (5, 10))])
def test_intervals_of_90_percent_hold_the_truth_in_85_to_95(gaussian_trace, sections):
    """Quantiles of the resampled sections held it in 64 to 70 % with three sections, 76 to 83 % with five."""
    long = gaussian_trace(200 * sections * 1600, seed=3)
    whole = moments(long)
    summits = mccool_asperities(whole)
    truth = {"m0": whole.m0, "m2": whole.m2, "m4": whole.m4, "density": summits.density, "radius": summits.radius}
    found = [bootstrap(Profile(z, long.spacing), sections=sections) for z in np.split(long.heights, 200)]
    for name, value in truth.items():
        held = np.mean([row[name][0] <= value <= row[name][1] for row in found])
        assert 0.85 <= held <= 0.95, name


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
    assert [m.short_cutoff for m in (half, one, two)] == pytest.approx([4e-6, 8e-6, 16e-6], rel=1e-12)


def test_band_leaves_out_what_the_trace_cannot_show(gaussian_trace):
    found = short_cutoff_band(gaussian_trace(), 1.2e-6, lambda p, s: roughness_profile(p, short_cutoff=s))
    assert [m.short_cutoff for m in found] == pytest.approx([1.2e-6, 2.4e-6], rel=1e-12)


def test_two_gaussians_are_one(gaussian_trace):
    p = gaussian_trace(40_000)
    once = moments(roughness_profile(p, short_cutoff=16e-6))
    twice = smoothed_moments(roughness_profile(p, short_cutoff=8e-6), 16e-6)
    assert twice.m2 == pytest.approx(once.m2, rel=5e-3)
    assert twice.m4 == pytest.approx(once.m4, rel=1e-2)


def test_smoothing_backwards_is_refused(gaussian_trace):
    with pytest.raises(InputError, match="above the 8 um already filtered"):
        smoothed_moments(replace(gaussian_trace(), cutoffs={"short_cutoff": 8e-6}), 4e-6)
