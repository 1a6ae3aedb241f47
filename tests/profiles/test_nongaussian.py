"""Prescribed skewness and kurtosis, and the Weierstrass-Mandelbrot function."""

import itertools

import numpy as np
import pytest

from profiles import InputError
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
