"""Preparation: right answer, recorded step, untouched original."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import level, primary_profile, remove_form, roughness_profile, trim, waviness_profile
from roughness.prepare import smooth_bridges

X = np.linspace(-1, 1, 2001)


def trace(z, **kw):
    return Profile(z, 1e-6, name="flank", **kw)


@pytest.mark.parametrize(("form", "shape"), [("mean", 1 + 0 * X), ("line", 2 * X - 1), ("polynomial-4", X**4 - X)])
def test_form_is_removed_whole(form, shape):
    assert np.abs(remove_form(trace(shape), form).heights).max() < 1e-12


def test_level_keeps_what_is_not_a_line():
    wave = np.cos(40 * np.pi * X)
    assert np.abs(level(trace(wave + 3 * X)).heights - level(trace(wave)).heights).max() < 1e-12


def test_circle_is_removed_where_a_parabola_is_not():
    x = X * 1e-3
    ball = trace(np.sqrt(4e-6 - x**2))
    assert np.abs(remove_form(ball, "circle").heights).max() < 1e-13
    assert np.abs(remove_form(ball, "polynomial-2").heights).max() > 1e-6


def test_circle_says_its_radius():
    x = X * 1e-3
    assert "radius 10 mm" in remove_form(trace(-np.sqrt(1e-4 - (x - 2e-4) ** 2)), "circle").steps[0]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("run", [1, -1])
def test_involute_flank_is_removed_either_way_up_and_run(side, run):
    from scipy.interpolate import CubicSpline

    u = np.linspace(-0.2, 0.2, 4001)
    x = 0.033 * (0.4 * np.sin(u) + u * np.sin(u) + np.cos(u) - 1)
    y = 0.033 * (0.4 * (1 - np.cos(u)) + np.sin(u) - u * np.cos(u))
    flank = trace(side * CubicSpline(x, y)(np.linspace(-1e-3, 1e-3, 2001))[::run] + 1e-3)
    assert np.abs(remove_form(flank, "involute-33").heights).max() < 1e-10
    assert np.abs(remove_form(flank, "circle").heights).max() > 1e-8


def test_masked_points_do_not_pull_the_form():
    z = 2 * X
    valid = np.ones(X.size, bool)
    valid[900:950] = False
    assert np.abs(remove_form(trace(np.where(valid, z, 9.0), valid=valid), "line").heights[valid]).max() < 1e-12


def test_band_records_steps_and_cutoffs():
    done = roughness_profile(trace(X), cutoff=0.25e-3, short_cutoff=8e-6, trim_cutoffs=0.5)
    assert done.cutoffs == {"short_cutoff": 8e-6, "cutoff": 0.25e-3}
    assert [s.split(",")[0] for s in done.steps] == [
        "Gaussian low-pass",
        "Gaussian high-pass",
        "trimmed 0.125 mm and 0.125 mm",
    ]


def test_original_is_untouched():
    before = trace(X)
    roughness_profile(level(before), cutoff=0.25e-3)
    assert before.steps == ()
    assert np.array_equal(before.heights, X)


def test_roughness_and_waviness_add_up():
    p = trace(np.random.default_rng(0).normal(size=3000))
    both = roughness_profile(p, cutoff=0.25e-3).heights + waviness_profile(p, 0.25e-3).heights
    assert np.abs(both - p.heights).max() < 1e-12


def test_primary_profile_lowers_the_finest_waves_only():
    fine, coarse = np.sin(2 * np.pi * np.arange(4000) / 4), np.sin(2 * np.pi * np.arange(4000) / 200)
    assert np.abs(primary_profile(trace(fine), 16e-6).heights[20:-20]).max() < 1e-4
    assert primary_profile(trace(coarse), 16e-6).heights.std() > 0.99 * coarse.std()


def test_trim_keeps_the_mask():
    valid = np.ones(100, bool)
    valid[50] = False
    cut = trim(trace(np.arange(100.0), valid=valid), 40e-6, 10e-6)
    assert cut.heights[0] == 40
    assert np.flatnonzero(~cut.valid).tolist() == [10]


@pytest.mark.parametrize("method", ["gaussian", "robust", "spline"])
def test_every_filter_takes_off_a_long_wave(method):
    p = trace(np.sin(2 * np.pi * np.arange(6000) / 3000))
    left = roughness_profile(p, cutoff=0.25e-3, method=method).heights[600:-600]
    assert np.abs(left).max() < 0.03


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda p: remove_form(p, "polynom-2"), "nearest known: 'polynomial-N'"),
        (lambda p: remove_form(p, "involute-x"), "base radius in mm"),
        (lambda p: roughness_profile(p, cutoff=8e-3), "2 mm is shorter than the cut-off"),
        (lambda p: roughness_profile(p, cutoff=0.1e-3, short_cutoff=0.2e-3), "below the cut-off of 100 um"),
        (lambda p: roughness_profile(p, cutoff=0.1e-3, method="spine"), "nearest known: 'spline'"),
        (lambda p: trim(p, 1e-3, 1e-3), "no profile of 2 mm is left"),
        (lambda p: remove_form(trace(0 * X), "circle"), "too straight"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call(trace(X))


def test_second_filter_does_not_hide_the_first(gaussian_trace):
    """A profile low-passed at 8 um and then at 6 um holds what one pass at 10 um leaves, and says so."""
    once = primary_profile(gaussian_trace(), 8e-6)
    twice = primary_profile(once, 6e-6)
    assert twice.cutoffs["short_cutoff"] == pytest.approx(10e-6)
    single = primary_profile(gaussian_trace(), 10e-6)
    assert twice.heights[40:-40] == pytest.approx(single.heights[40:-40], abs=1e-10)
    narrow = roughness_profile(gaussian_trace(), cutoff=0.25e-3)
    assert roughness_profile(narrow, cutoff=0.8e-3).cutoffs["cutoff"] == 0.25e-3


def test_bridges_meet_level_and_slope_and_stay_near_the_surface(gaussian_trace):
    p = gaussian_trace()
    valid = np.ones(9600, bool)
    valid[2000:2030] = valid[5000:5600] = valid[:20] = False
    z = smooth_bridges(np.where(valid, p.heights, 1.0), valid)
    assert (z[valid] == p.heights[valid]).all()
    bend = np.abs(np.diff(z[1990:2040], 2)).max()
    assert bend < 2 * np.abs(np.diff(p.heights, 2)).max()
    assert np.abs(z[20:]).max() < 2 * np.abs(p.heights).max()
