"""Prescribed skewness and kurtosis, the Weierstrass-Mandelbrot function and the recipes of finishing."""

import itertools

import numpy as np
import pytest
from scipy.special import ndtri

from profiles import InputError, Profile
from profiles.finishes import ground, hobbed, honed, pitted, run_in, scratched, superfinished
from profiles.nongaussian import johnson_sample, non_gaussian, weierstrass_mandelbrot
from profiles.synthesise import self_affine

GRID = {"points": 12000, "spacing": 0.5e-6}
BASE = self_affine(1e-7, hurst=0.8, rolloff=4e-5, shortest=2e-6, seed=3, **GRID)


def shape(heights):
    w = (heights - heights.mean()) / heights.std()
    return np.mean(w**3), np.mean(w**4)


@pytest.mark.parametrize(
    ("skewness", "kurtosis"), [(0, 3), (0, 2.2), (0, 6), (-1, 5), (1, 5), (-2, 9), (0.5, 2.5), (-0.8, 4.1)]
)
def test_skewness_and_kurtosis_are_the_prescribed_ones(skewness, kurtosis):
    trace = non_gaussian(BASE, skewness=skewness, kurtosis=kurtosis)
    assert shape(trace.profile.heights) == pytest.approx((skewness, kurtosis), abs=1e-5)
    assert trace.profile.heights.std() == pytest.approx(1e-7, rel=1e-9)


def test_the_spectrum_of_the_base_is_kept():
    trace = non_gaussian(BASE, skewness=-1, kurtosis=5)
    ours, base = (np.abs(np.fft.rfft(p.heights)) ** 2 for p in (trace.profile, BASE.profile))
    edges = [5, 20, 80, 320, 1280]
    for low, high in itertools.pairwise(edges):
        assert ours[low:high].sum() == pytest.approx(base[low:high].sum(), rel=0.1)


@pytest.mark.parametrize(("skewness", "kurtosis"), [(0, 1), (2, 5), (np.nan, 3), (0, np.inf)])
def test_impossible_shapes_are_refused(skewness, kurtosis):
    with pytest.raises(InputError, match="kurtosis must exceed"):
        johnson_sample(100, skewness, kurtosis)


def test_weierstrass_mandelbrot_moments_and_slope():
    trace = weierstrass_mandelbrot(
        dimension=1.4, roughness_length=1e-9, longest=2e-4, shortest=4e-6, points=200_000, spacing=1e-7, seed=1
    )
    z = trace.profile.heights
    slope = np.diff(z) / 1e-7
    assert np.mean(z**2) == pytest.approx(trace.m0, rel=0.02)
    assert np.mean(slope**2) == pytest.approx(trace.m2, rel=0.01)
    assert np.mean((np.diff(slope) / 1e-7) ** 2) == pytest.approx(trace.m4, rel=0.01)


def test_weierstrass_mandelbrot_structure_function_grows_as_lag_to_the_4_minus_2d():
    # Majumdar and Tien, eq. 9, for lags well inside the band.
    z = weierstrass_mandelbrot(
        dimension=1.4, roughness_length=1e-9, longest=2e-2, shortest=4e-7, points=400_000, spacing=1e-7, seed=1
    ).profile.heights
    lags = np.array([32, 64, 128, 256, 512])
    structure = [np.mean((z[lag:] - z[:-lag]) ** 2) for lag in lags]
    assert np.polyfit(np.log(lags), np.log(structure), 1)[0] == pytest.approx(4 - 2 * 1.4, abs=0.1)


def test_honed_surface_has_two_slopes_on_the_probability_plot():
    z = np.sort(honed(5e-8, 8e-7, plateau_share=0.8, seed=2, points=60_000, spacing=0.5e-6).profile.heights)
    line = ndtri((np.arange(z.size) + 0.5) / z.size)
    plateau = np.polyfit(line[(line > 0) & (line < 2)], z[(line > 0) & (line < 2)], 1)[0]
    valleys = np.polyfit(line[(line > -2.5) & (line < -1.5)], z[(line > -2.5) & (line < -1.5)], 1)[0]
    assert plateau == pytest.approx(5e-8, rel=0.3)
    assert valleys > 8 * plateau


def test_ground_is_gaussian_and_superfinished_is_skewed():
    assert shape(ground(3e-7, seed=4, **GRID).profile.heights) == pytest.approx((0, 3), abs=0.7)
    fine = superfinished(3e-8, base_rms=3e-7, removed_share=0.6, seed=4, **GRID)
    assert shape(fine.profile.heights)[0] < -1


def test_hobbed_surface_repeats_with_the_feed():
    trace = hobbed(feed=0.5e-3, radius=20e-3, rms=2e-8, seed=1, **GRID).profile
    power = np.abs(np.fft.rfft(trace.heights - trace.heights.mean()))
    assert np.argmax(power) == round(trace.heights.size * trace.spacing / 0.5e-3)


def test_run_in_leaves_what_lies_below_untouched_and_lowers_moments():
    before = ground(3e-7, seed=4, **GRID)
    after = run_in(before.profile, 0.3)
    level = np.quantile(before.profile.heights, 0.7)
    below = before.profile.heights <= level
    assert (after.profile.heights[below] == before.profile.heights[below]).all()
    assert after.profile.heights.max() < level + 0.06 * (before.profile.heights.max() - level)
    assert after.m0 < before.m0


@pytest.mark.parametrize("damage", [scratched, pitted])
def test_damage_has_the_stated_depth_and_touches_the_stated_width(damage):
    flat = Profile(np.zeros(12000), 0.5e-6)
    trace = damage(flat, count=6, depth=2e-6, width=40e-6, seed=5)
    assert trace.profile.heights.min() == pytest.approx(-2e-6, rel=1e-6)
    assert np.count_nonzero(trace.profile.heights < 0) == pytest.approx(6 * 80, abs=12)
    assert not trace.exact
    assert len(trace.profile.steps) == 1


@pytest.mark.parametrize(
    "call",
    [
        lambda: run_in(BASE.profile, 1.5),
        lambda: scratched(BASE.profile, count=0, depth=1e-6, width=1e-5, seed=1),
        lambda: pitted(BASE.profile, count=3, depth=1e-6, width=1.0, seed=1),
        lambda: honed(1e-6, 1e-7, plateau_share=0.5, seed=1, **GRID),
        lambda: hobbed(feed=1.0, radius=0.01, rms=1e-8, seed=1, **GRID),
    ],
)
def test_impossible_recipes_are_refused(call):
    with pytest.raises(InputError, match=r"needs|must"):
        call()
