"""The Gaussian filter against its definition."""

import numpy as np
import pytest

from profiles import InputError
from roughness.filters import convolve, gaussian_kernel, gaussian_mean_line, gaussian_transmission


def direct_mean_line(z, spacing, cutoff):
    """Weighted sum at every point, weights and local line fitted anew: the definition, slowly."""
    kernel = gaussian_kernel(cutoff, spacing)
    half = kernel.size // 2
    result = np.empty_like(z)
    for i in range(z.size):
        j = np.arange(max(0, i - half), min(z.size, i + half + 1))
        root = np.sqrt(kernel[j - i + half])
        basis = np.column_stack((np.ones(j.size), j - i))
        result[i] = np.linalg.lstsq(basis * root[:, None], z[j] * root, rcond=None)[0][0]
    return result


@pytest.mark.parametrize(("points", "cutoff"), [(300, 20e-6), (300, 130e-6), (200, 190e-6)])
def test_fast_filter_equals_direct_sum(points, cutoff):
    z = np.random.default_rng(1).normal(size=points)
    assert np.abs(gaussian_mean_line(z, 1e-6, cutoff) - direct_mean_line(z, 1e-6, cutoff)).max() < 1e-12


@pytest.mark.parametrize("points", [16384, 16500, 40001])
def test_blocks_leave_no_seam(points):
    z = np.random.default_rng(2).normal(size=points)
    kernel = gaussian_kernel(500e-6, 0.5e-6)
    assert np.abs(convolve(z, kernel) - np.convolve(z, kernel, "same")).max() < 1e-12


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 4.0])
def test_transmission_follows_the_standard(ratio):
    x = np.arange(20000) * 0.5e-6
    wave = np.cos(2 * np.pi * x / (ratio * 0.8e-3))
    passed = gaussian_mean_line(wave, 0.5e-6, 0.8e-3)[4000:-4000]
    scale = passed @ wave[4000:-4000] / (wave[4000:-4000] @ wave[4000:-4000])
    assert scale == pytest.approx(gaussian_transmission(ratio * 0.8e-3, 0.8e-3), abs=2e-5)


def test_half_passes_at_the_cutoff():
    assert gaussian_transmission(0.25e-3, 0.25e-3) == 0.5


def test_no_length_is_lost_and_a_slope_passes():
    slope = np.linspace(-3.0, 5.0, 5000)
    assert np.abs(gaussian_mean_line(slope, 1e-6, 0.8e-3) - slope).max() < 1e-12


def test_normalised_ends_pass_a_constant():
    assert np.abs(gaussian_mean_line(np.ones(3000), 1e-6, 0.8e-3, ends="normalised") - 1).max() < 1e-12


def test_periodic_ends_leave_no_trace_of_the_origin():
    z = np.random.default_rng(3).normal(size=4000)
    here = gaussian_mean_line(z, 1e-6, 0.25e-3, ends="periodic")
    there = gaussian_mean_line(np.roll(z, 777), 1e-6, 0.25e-3, ends="periodic")
    assert np.abs(np.roll(here, 777) - there).max() < 1e-12


def test_masked_points_do_not_count():
    z = 1e-9 * np.sin(np.arange(4000) / 7)
    valid = np.ones(z.size, bool)
    valid[2000:2030] = False
    spoilt = np.where(valid, z, 1.0)
    clean = gaussian_mean_line(z, 1e-6, 0.25e-3, valid=valid)
    assert np.abs(gaussian_mean_line(spoilt, 1e-6, 0.25e-3, valid=valid) - clean)[valid].max() < 1e-16


def test_gap_wider_than_the_kernel_keeps_what_is_there():
    valid = np.ones(500, bool)
    valid[200:300] = False
    assert np.isfinite(gaussian_mean_line(np.ones(500), 1e-6, 20e-6, valid=valid)).all()


def test_floored_kernel_is_a_whole_number_of_samples():
    assert gaussian_kernel(0.8e-6, 0.5e-6, floored=True).size == 3
    assert not np.allclose(gaussian_kernel(3.8e-6, 0.5e-6), gaussian_kernel(3.8e-6, 0.5e-6, floored=True))


def test_cutoff_below_the_spacing_is_refused():
    with pytest.raises(InputError, match=r"cut-off \(um\): 0.4: .* spacing of 0.5 um"):
        gaussian_kernel(0.4e-6, 0.5e-6)


def test_unknown_ends_are_refused():
    with pytest.raises(InputError, match="regression, normalised, reflect, periodic"):
        gaussian_mean_line(np.zeros(100), 1e-6, 10e-6, ends="mirror")


@pytest.mark.parametrize("points", [2.0, 2.5, 3.0, 4.0, 4.9, 5.0, 8.0])
@pytest.mark.parametrize("ratio", [1.0, 2.0, 4.0])
def test_coarse_filter_transmits_as_the_standard_says(points, ratio):
    """Samples of the Gaussian transmitted 0.89, 0.69 and 0.56 at their cut-off of 2, 2.5 and 3 points."""
    kernel = gaussian_kernel(points, 1.0)
    at = np.arange(kernel.size) - kernel.size // 2
    passed = kernel @ np.cos(2 * np.pi * at / (points * ratio))
    assert passed == pytest.approx(gaussian_transmission(points * ratio, points), abs=7e-3 if points == 2.0 else 1e-3)
    assert kernel.sum() == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("points", [2.0, 2.7, 4.5])
def test_coarse_filter_keeps_a_slope_to_its_ends_and_does_not_raise_them(points):
    slope = np.linspace(-3.0, 5.0, 500)
    assert np.abs(gaussian_mean_line(slope, 1.0, points) - slope).max() < 1e-11
    z = np.random.default_rng(0).normal(size=(200, 300))
    passed = np.array([gaussian_mean_line(row, 1.0, points) for row in z])
    assert (passed[:, :3] ** 2).mean() < 2.0 * (passed[:, 100:200] ** 2).mean()
    assert np.isfinite(gaussian_mean_line(z[0, :12], 1.0, points)).all()
