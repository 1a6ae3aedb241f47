"""Filters against their standards, and what outliers do to them."""

import numpy as np
import pytest

from profiles import InputError
from roughness.filters import gaussian_mean_line, local_regression
from roughness.robust import regression_kernel, robust_mean_line, spline_mean_line

X = np.arange(8000)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_half_passes_at_the_cutoff_while_no_point_loses_weight(order):
    wave = np.cos(2 * np.pi * X / 500)
    kernel = regression_kernel(500.0, 1.0, order)
    passed = local_regression(wave, np.ones(X.size), kernel, order=order)
    middle = slice(1500, -1500)
    assert passed[middle] @ wave[middle] / (wave[middle] @ wave[middle]) == pytest.approx(0.5, abs=2e-4)


@pytest.mark.parametrize(("order", "shape"), [(0, 0 * X + 1.0), (1, X * 1.0), (2, (X / 1000.0) ** 2)])
def test_polynomial_of_its_order_passes_whole(order, shape):
    assert np.abs(robust_mean_line(shape, 1.0, 400.0, order=order) - shape).max() < 1e-8 * shape.max()


def test_deep_valleys_pull_the_gaussian_but_not_the_robust_line():
    z = 0.01 * np.sin(X / 5.0)
    z[3000:3100] -= 5.0
    gauss = gaussian_mean_line(z, 1.0, 800.0)
    robust = robust_mean_line(z, 1.0, 800.0)
    assert np.abs(gauss).max() > 0.5
    assert np.abs(robust).max() < 0.02


def test_robust_line_is_symmetric_up_and_down():
    z = np.random.default_rng(1).normal(size=3000)
    assert np.abs(robust_mean_line(-z, 1.0, 300.0) + robust_mean_line(z, 1.0, 300.0)).max() < 1e-9


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_spline_transmission(ratio):
    cutoff, wave_length = 400.0, 400.0 * ratio
    wave = np.cos(2 * np.pi * X / wave_length)
    passed = spline_mean_line(wave, 1.0, cutoff)
    middle = slice(2000, -2000)
    gain = passed[middle] @ wave[middle] / (wave[middle] @ wave[middle])
    relation = np.sin(np.pi / wave_length) / np.sin(np.pi / cutoff)
    assert gain == pytest.approx(1 / (1 + relation**4), abs=1e-4)


def test_spline_passes_a_line_to_its_very_ends():
    assert np.abs(spline_mean_line(X * 1.0, 1.0, 400.0) - X).max() < 1e-7 * X.max()


def test_order_three_is_refused():
    with pytest.raises(InputError, match="0, 1 or 2"):
        robust_mean_line(X * 1.0, 1.0, 400.0, order=3)
