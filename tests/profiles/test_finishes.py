"""Recipes of finishing, and of changes in service."""

import numpy as np
import pytest
from scipy.special import ndtri

from profiles import InputError, Profile
from profiles.finishes import ground, hobbed, honed, pitted, run_in, scratched, superfinished
from profiles.synthesise import self_affine

GRID = {"points": 12000, "spacing": 0.5e-6}
BASE = self_affine(1e-7, hurst=0.8, rolloff=4e-5, shortest=2e-6, seed=3, **GRID)


def shape(heights):
    w = (heights - heights.mean()) / heights.std()
    return np.mean(w**3), np.mean(w**4)


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
