"""Areal moments: those of the spectrum that made the map, and those of its profiles."""

import numpy as np
import pytest

from profiles import InputError, Profile
from profiles.maps import HeightMap
from roughness import moments, primary_profile
from roughness.maps.moments import areal_moments, gaussian_scatter, tiles
from roughness.maps.prepare import areal_roughness
from roughness.mccool import plane_offset, summit_density, summit_sigma

STEP = 1e-6


def gaussian_map(size=1024, stretch=1.0, longest=80.0, shortest=24.0, seed=0, turned=False):
    """A periodic Gaussian map with power q^-2 between two wavelengths (in points), ridges ``stretch`` times longer
    along y, and its profile moments along x and y from the spectrum."""
    q = np.fft.fftfreq(size)
    down, across = q[:, None] * stretch, q[None, :]
    radius = np.hypot(down, across)
    power = np.where((radius >= 1 / longest) & (radius <= 1 / shortest), np.maximum(radius, 1e-9) ** -2.0, 0.0)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal(power.shape))
    # phases alone are random, so the moments of this very map are the sums over its spectrum
    z = np.fft.ifft2(np.sqrt(power) * noise / np.abs(noise)).real
    scale = 3e-7 / z.std()
    weight = power / power.sum() * (3e-7) ** 2
    angular = 2 * np.pi * q / STEP
    truth = {
        "m0": weight.sum(),
        "m2x": (weight.sum(axis=0) * angular**2).sum(),
        "m2y": (weight.sum(axis=1) * angular**2).sum(),
        "m4x": (weight.sum(axis=0) * angular**4).sum(),
        "m4y": (weight.sum(axis=1) * angular**4).sum(),
    }
    heights = z * scale
    return HeightMap(heights.T if turned else heights, STEP, STEP, "made"), truth


def test_areal_moments_of_an_isotropic_map_are_those_of_its_profiles():
    area, truth = gaussian_map()
    found = areal_moments(area)
    rows = [moments(Profile(row, STEP)) for row in area.heights[::16]]
    for name, power in (("m0", 0), ("m2", 2), ("m4", 4)):
        each = np.array([getattr(row, name) for row in rows])
        error = 3.0 * each.std() / np.sqrt(each.size)
        for angle in (0.0, np.pi / 2):
            assert getattr(found.profile(angle), name) == pytest.approx(each.mean(), abs=error), (name, angle)
        known = truth["m0"] if not power else truth[f"m{power}x"]
        assert getattr(found.profile(0.0), name) == pytest.approx(known, rel=0.03)


def test_an_isotropic_map_has_one_profile_in_every_direction():
    found = areal_moments(gaussian_map(seed=4)[0])
    assert found.m22 == pytest.approx(found.m40 / 3, rel=0.05)
    assert found.anisotropy > 0.99
    for angle in np.linspace(0.0, np.pi, 7):
        assert found.profile(angle).m2 == pytest.approx(found.m20, rel=0.04)
        assert found.profile(angle).m4 == pytest.approx(found.m40, rel=0.06)


@pytest.mark.parametrize("turned", [False, True])
def test_the_lay_is_found_with_the_moments_of_the_spectrum(turned):
    area, truth = gaussian_map(stretch=4.0, turned=turned, seed=2)
    found = areal_moments(area)
    across = found.across_lay
    assert abs(np.cos(across)) == pytest.approx(0.0 if turned else 1.0, abs=0.03)
    assert found.profile(across).m2 == pytest.approx(truth["m2x"], rel=0.03)
    assert found.profile(across + np.pi / 2).m4 == pytest.approx(truth["m4y"], rel=0.05)
    assert found.anisotropy == pytest.approx(0.25, rel=0.03)


def summits(z):
    """Heights above all eight neighbours."""
    top = np.ones(z.shape, bool)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            if i or j:
                top &= z > np.roll(z, (i, j), (0, 1))
    return z[top]


@pytest.mark.parametrize("stretch", [1.0, 2.0, 4.0])
def test_geometric_means_give_the_summits_of_a_surface_with_a_lay(stretch):
    """Counted on the map: an isotropic surface that is stretched keeps its summits, per stretched area."""
    area, truth = gaussian_map(size=2048, stretch=stretch, longest=60.0, shortest=16.0, seed=7)
    m0, m2, m4 = truth["m0"], (truth["m2x"] * truth["m2y"]) ** 0.5, (truth["m4x"] * truth["m4y"]) ** 0.5
    # a slanting ridge that is sampled more finely along than across shows summits that are not there
    found = summits(area.heights[:: int(stretch)])
    assert found.size / (area.heights.size * STEP**2) == pytest.approx(summit_density(m2, m4), rel=0.04)
    assert found.mean() == pytest.approx(plane_offset(m0, m2, m4), rel=0.03)
    assert found.std() == pytest.approx(summit_sigma(m0, m2, m4), rel=0.03)


def test_an_areal_filter_acts_on_a_wave_as_the_profile_filter():
    """At the cut-off a half is left, on a wave that runs along an axis; ISO 16610-61."""
    _, x = np.mgrid[0:300, 0:400]
    wave = HeightMap(1e-7 * np.cos(2 * np.pi * x / 20), STEP, STEP, "wave")
    left = areal_roughness(wave, form="none", short_cutoff=20e-6).heights[150]
    line = primary_profile(Profile(wave.heights[150], STEP), 20e-6).heights
    assert left[100:300] == pytest.approx(line[100:300], abs=2e-10)
    assert np.abs(left[100:300]).max() == pytest.approx(0.5e-7, rel=0.01)


def test_a_map_is_levelled_before_it_is_filtered():
    area, _ = gaussian_map(size=256, seed=3)
    y, x = np.mgrid[0:256, 0:256]
    tilted = HeightMap(area.heights + 1e-8 * x + 3e-8 * y, STEP, STEP)
    for cutoff in (None, 1e-4):
        level = areal_roughness(tilted, cutoff=cutoff).heights
        assert level == pytest.approx(areal_roughness(area, cutoff=cutoff).heights, abs=1e-13)


def test_tiles_cover_the_map():
    area, _ = gaussian_map(size=100, longest=40.0, shortest=10.0)
    assert sum(part.heights.size for part in tiles(area)) == area.heights.size


def test_holes_of_a_map_are_left_out_of_its_moments():
    area, _ = gaussian_map(size=256, seed=5)
    holes = np.random.default_rng(1).random(area.heights.shape) < 0.02
    holed = HeightMap(np.where(holes, np.nan, area.heights), STEP, STEP)
    for cutoffs in ({}, {"cutoff": 1e-4}):
        whole, left = (areal_moments(areal_roughness(one, **cutoffs)) for one in (area, holed))
        for angle in (0.0, 0.7, 1.5):
            ours, right = left.profile(angle), whole.profile(angle)
            assert (ours.m0, ours.m2, ours.m4) == pytest.approx((right.m0, right.m2, right.m4), rel=0.02)
    one = np.array(area.heights)
    one[70, 70] = np.nan
    assert areal_roughness(HeightMap(one, STEP, STEP), cutoff=1e-4).heights.size == one.size


@pytest.mark.parametrize(
    ("spoil", "rule"),
    [
        (
            lambda z: np.where(np.indices(z.shape)[1] % 4 == 0, np.nan, z),
            "1024 of 4096 points have no height",
        ),
        (lambda z: np.zeros_like(z), "flat"),
        (lambda z: z[:8], "at least 16 rows"),
    ],
)
def test_a_map_that_gives_no_moments_is_refused(spoil, rule):
    area, _ = gaussian_map(size=64, longest=40.0, shortest=10.0)
    with pytest.raises(InputError, match=rule):
        areal_moments(HeightMap(spoil(np.array(area.heights)), STEP, STEP, "bad"))


@pytest.mark.parametrize(("keys", "rule"), [({"form": "circle"}, "of a map is"), ({"cutoff": 1e-3}, "shorter than")])
def test_a_filter_that_does_not_fit_a_map_is_refused(keys, rule):
    with pytest.raises(InputError, match=rule):
        areal_roughness(gaussian_map(size=64, longest=40.0, shortest=10.0)[0], **keys)


@pytest.mark.long
@pytest.mark.parametrize("longest", [25.0, 90.0, 200.0])
def test_bands_of_maps_hold_the_true_moments_in_90_percent(longest):
    """225 maps of 256 points a side, whose nine parts are 3.4 to 0.4 of the longest waves wide."""
    from mixedlub.rig.measured import Measured

    size, points, held = 3840, 256, []
    q = np.fft.fftfreq(size)
    radius = np.hypot(q[:, None], q[None, :])
    power = np.where((radius >= 1 / longest) & (radius <= 1 / 6), np.maximum(radius, 1e-9) ** -2.6, 0.0)
    noise = np.fft.fft2(np.random.default_rng(2).standard_normal(power.shape))
    z = 1e-7 * np.fft.ifft2(np.sqrt(power) * noise).real / np.sqrt(power.mean())
    slope, share = 2 * np.sin(np.pi * q) / STEP, power.sum(axis=0) / power.sum()
    truth = {"m0": 1e-14, "m2": 1e-14 * (share * slope**2).sum(), "m4": 1e-14 * (share * slope**4).sum()}
    for rows in np.split(z, size // points):
        for heights in np.split(rows, size // points, axis=1):
            one = Measured(area=HeightMap(heights - heights.mean(), STEP, STEP), isotropic=True)
            values, axes = one.values(), one.axes("a")
            reach = {name: np.sqrt(sum(axis[name] ** 2 for axis in axes)) for name in truth}
            held.append([abs(np.log(values[name] / known)) <= reach[name] for name, known in truth.items()])
    assert (np.mean(held, axis=0) > 0.88).all()
    assert (np.mean(held, axis=0) < 0.98).all()


def test_scatter_of_a_gaussian_map_is_that_between_maps():
    """Standard deviation of the moments of 100 maps cut from a large one, 10 of its longest waves wide."""
    size = 1280
    q = np.fft.fftfreq(size)
    radius = np.hypot(q[:, None], q[None, :])
    noise = np.fft.fft2(np.random.default_rng(6).standard_normal(radius.shape))
    z = 1e-6 * np.fft.ifft2(noise * ((radius > 1 / 13) & (radius < 1 / 4))).real
    maps = [HeightMap(h, STEP, STEP) for row in np.split(z, 10) for h in np.split(row, 10, axis=1)]
    found = [areal_moments(one).profile(0.0) for one in maps]
    values = np.array([(m.m0, m.m2, m.m4) for m in found])
    predicted = np.mean([gaussian_scatter(one, 0.0) for one in maps], axis=0)
    assert values.std(axis=0) / values.mean(axis=0) == pytest.approx(predicted, rel=0.2)
