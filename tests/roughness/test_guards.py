"""Each guard speaks when it should, and keeps still on a good trace."""

from dataclasses import replace

import numpy as np
import pytest

from profiles import Profile
from profiles.synthesise import of_moments
from roughness import evaluation_profile, moments, profile_record, roughness_profile, trace_record


def warnings(profile, **kw):
    return profile_record(profile, **kw)["warnings"]


def said(found, phrase):
    return any(phrase in w for w in found)


@pytest.fixture
def good(gaussian_trace):
    return roughness_profile(gaussian_trace(16_000, short=12e-6), cutoff=0.8e-3, short_cutoff=8e-6)


def test_good_trace_earns_none(good):
    assert warnings(good) == []


def test_narrow_band(good):
    wave = replace(good, heights=1e-6 * np.sin(2 * np.pi * np.arange(16_000) / 200))
    assert said(warnings(wave), "below 1.5")


def test_unresolved_trace(good):
    noise = replace(good, heights=1e-7 * np.random.default_rng(0).normal(size=16_000))
    assert said(warnings(noise), "neighbouring heights correlate by 0.0")
    assert said(warnings(noise), "of m4 by spectral integration")


@pytest.mark.parametrize("alpha", [1.52, 1.58])
def test_a_narrow_band_that_is_resolved_is_no_white_noise(alpha):
    """alpha from 1.5 to 1.6 alone said that neighbours correlate by 1.00 only."""
    made = of_moments(1e-13, 2e-3, alpha * 2e-3**2 / 1e-13, points=40_000, spacing=0.25e-6, seed=1)
    assert not said(warnings(made.profile), "correlate by")
    noise = Profile(1e-7 * np.random.default_rng(0).normal(size=16_000), 1e-6)
    assert said(warnings(noise), "white noise gives 0 and 1.5")
    rough = Profile(noise.heights + 2e-7 * np.sin(np.arange(16_000) / 50), 1e-6)
    assert not said(warnings(rough), "white noise")


def test_too_few_points_a_short_cutoff(good):
    assert said(warnings(replace(good, cutoffs={"cutoff": 0.8e-3, "short_cutoff": 2.5e-6})), "5.0 points a short")


def test_two_points_a_short_cutoff_lower_m2_too(good):
    assert said(
        warnings(replace(good, cutoffs={"cutoff": 0.8e-3, "short_cutoff": 1.2e-6})), "and m2 by up to an eighth"
    )


def test_no_short_cutoff(good):
    assert said(warnings(replace(good, cutoffs={"cutoff": 0.8e-3})), "no short cut-off")


def test_no_cutoff(good):
    assert said(warnings(replace(good, cutoffs={"short_cutoff": 8e-6})), "no cut-off")


def test_too_few_sampling_lengths(good):
    assert said(warnings(replace(good, cutoffs={"cutoff": 2.5e-3, "short_cutoff": 8e-6})), "3 sampling lengths")


def test_less_than_one_cutoff_is_told_with_its_length(gaussian_trace):
    short = replace(gaussian_trace(1400), cutoffs={"cutoff": 0.8e-3, "short_cutoff": 8e-6})
    assert said(warnings(short), "one sampling length of 0.7 mm, shorter than the cut-off of 0.8 mm")


def test_quantum(gaussian_trace):
    p = gaussian_trace(16_000, short=12e-6)
    coarse = Profile(np.round(p.heights / 5e-8) * 5e-8, p.spacing)
    assert said(trace_record(coarse, short_cutoff=None)[1]["warnings"], "the height step of 50 nm accounts for")


def test_tip(good):
    steep = replace(good, heights=20 * good.heights, origin={"tip_radius": 5e-6})
    assert said(warnings(steep), "shows the tip of 5 um")


def test_stated_value_that_disagrees(good):
    found = warnings(replace(good, origin={"stated": {"Ra": 1e-7, "Rq": 0.0, "Rz": "n/a"}}))
    assert said(found, "the file states Ra 0.1 um")
    assert not said(found, "states Rq")


def test_stated_value_is_held_against_the_heights_as_read(good):
    """A primary profile's Pq is not the Rq that our filter leaves of it."""
    wave = 1e-6 * np.sin(2 * np.pi * np.arange(16_000) / 8000)
    trace = Profile(good.heights + wave, good.spacing, origin={"stated": {"Pq": float(np.std(good.heights + wave))}})
    _, record = trace_record(trace)
    assert record["parameters"]["Rq_um"] < 0.7e6 * trace.heights.std()
    assert not said(record["warnings"], "the file states")
    wrong = replace(trace, origin={"stated": {"Pq": 0.9 * trace.origin["stated"]["Pq"]}})
    assert said(trace_record(wrong)[1]["warnings"], "the file states Pq")


def test_stated_value_after_a_short_cutoff(good):
    rough = np.random.default_rng(0).normal(size=16_000) * 1e-7
    origin = {"stated": {"Pa": float(np.abs(good.heights).mean())}, "stated_short_cutoff": 40e-6}
    noisy = Profile(good.heights + 10 * rough, good.spacing, origin=origin)
    assert not said(warnings(noisy), "the file states Pa 1 um")
    assert said(warnings(replace(noisy, origin={"stated": origin["stated"]})), "the file states Pa")


def test_surface_that_changes_along_the_trace(good):
    louder = np.where(np.arange(16_000) < 4000, 3.0, 1.0) * good.heights
    assert said(warnings(replace(good, heights=louder)), "not alike along the trace")


def test_lifted_profile(good):
    assert said(warnings(replace(good, heights=good.heights + 1e-7)), "off the zero line")


def test_masked_share(good):
    valid = np.ones(16_000, bool)
    valid[1000:2000] = False
    assert said(warnings(replace(good, valid=valid)), "6.2 % of the points are masked")


def test_curve_that_is_not_s_shaped(good):
    wave = replace(good, heights=1e-6 * np.sin(2 * np.pi * np.arange(16_000) / 200))
    record = profile_record(wave)
    assert said(record["warnings"], "not S-shaped")
    assert record["parameters"]["Rk_um"] is None


def test_plateau_is_told(plateau_trace):
    assert said(warnings(plateau_trace()), "plateau of sigma")


def test_few_independent_heights(good):
    slow = 1e-6 * np.sin(2 * np.pi * np.arange(16_000) / 4000)
    assert said(warnings(replace(good, heights=slow)), "independent heights")


def spiked(profile, height, at=(4800,)):
    z = np.array(profile.heights)
    z[list(at)] += height
    return replace(profile, heights=z)


@pytest.mark.parametrize("height", [2e-6, 20e-6])
def test_spike_of_one_sample_is_named_with_its_place_and_share(gaussian_trace, height):
    """20 um on one sample of 9600: the summit radius fell thirteenfold and only the verdict said anything: Gaussian."""
    trace = gaussian_trace()
    clean = trace_record(trace)[1]
    assert not said(clean["warnings"], "of m4")
    record = trace_record(spiked(trace, height))[1]
    assert record["asperities"]["radius_um"] < 0.8 * clean["asperities"]["radius_um"]
    (told,) = (w for w in record["warnings"] if "a spike, dirt or a scratch" in w)
    assert told.startswith("one place, at 2.4 mm, ")
    share = 1.0 - clean["moments"]["m4_per_um2"] / record["moments"]["m4_per_um2"]
    assert float(told.split("holds ")[1].split(" %")[0]) == pytest.approx(100 * share, abs=3)
    assert "--outliers" in told


def test_two_spikes_are_counted(gaussian_trace):
    assert said(trace_record(spiked(gaussian_trace(), 20e-6, (3000, 6000)))[1]["warnings"], " % with 1 more)")


def test_masked_spike_raises_no_alarm(gaussian_trace):
    """Straight bridges under a filter make steps: m4 by differences is then 0.38 of m4 by spectral integration."""
    clean = trace_record(gaussian_trace())[1]
    profile, record = trace_record(spiked(gaussian_trace(), 20e-6), outliers=5.0)
    assert record["warnings"] == clean["warnings"]
    assert record["asperities"]["radius_um"] == pytest.approx(clean["asperities"]["radius_um"], rel=0.02)
    ratio = moments(profile, estimator="spectral").m4 / moments(profile).m4
    untouched = evaluation_profile(gaussian_trace())
    assert ratio == pytest.approx(moments(untouched, estimator="spectral").m4 / moments(untouched).m4, rel=0.02)


def test_deep_plateau_valleys_are_no_spikes(plateau_trace):
    assert not said(warnings(plateau_trace()), "a spike")
