"""The process against a function that is known, and against its own definition."""

import numpy as np
import pytest

from mixedlub.full_base import gaussian_process
from mixedlub.full_base.gaussian_process import covariance, fit, quadratic

POINTS = np.random.default_rng(1).uniform(-1.0, 1.0, (80, 3))
TERMS = quadratic(POINTS)
VALUES = np.sin(2.0 * POINTS[:, 0]) * np.exp(0.5 * POINTS[:, 1]) + 0.2 * POINTS[:, 2]


def test_it_finds_a_smooth_function() -> None:
    found, others = fit(POINTS, VALUES), np.random.default_rng(2).uniform(-0.9, 0.9, (50, 3))
    wanted = np.sin(2.0 * others[:, 0]) * np.exp(0.5 * others[:, 1]) + 0.2 * others[:, 2]
    assert np.max(np.abs(found(others) - wanted)) < 2e-3
    assert found.scales[2] > 3.0 * found.scales[0]


def test_a_quadratic_is_exact() -> None:
    found = fit(POINTS, TERMS @ np.arange(1.0, 11.0))
    assert found(POINTS[:5] * 0.5) == pytest.approx(quadratic(POINTS[:5] * 0.5) @ np.arange(1.0, 11.0))


def test_slopes_of_the_values_are_their_differences() -> None:
    found, places, step = fit(POINTS, VALUES), 0.8 * POINTS[:9], 1e-4
    for axis, slopes in enumerate(found.slopes(places).T):
        moved = step * np.eye(3)[axis]
        assert slopes == pytest.approx((found(places + moved) - found(places - moved)) / (2.0 * step), abs=1e-5)
    assert (found.slopes(np.full((1, 3), 40.0)) == 0.0).all()


def test_features_that_depend_on_each_other_have_a_bounded_trend() -> None:
    """Values follow from the first two features alone; the third is their sum."""
    twins = np.column_stack([POINTS[:, :2], 0.5 * (POINTS[:, 0] + POINTS[:, 1])])
    found = fit(twins, np.sin(twins[:, 0]) + twins[:, 1] ** 2)
    moved = np.array([[0.3, 0.2, 0.25], [0.3, 0.2, 0.3]])
    assert found(moved)[0] == pytest.approx(np.sin(0.3) + 0.04, abs=1e-3)
    assert abs(found(moved)[1] - found(moved)[0]) < 0.1


def test_slopes_of_the_likelihood_are_its_differences() -> None:
    log = np.log(np.array([0.8, 1.2, 2.0, 1e-3]))
    _, slopes = gaussian_process._loss(log, POINTS, TERMS, VALUES)
    for place in range(4):
        step = 1e-5 * np.eye(4)[place]
        up, down = (gaussian_process._loss(log + sign * step, POINTS, TERMS, VALUES)[0] for sign in (1.0, -1.0))
        assert slopes[place] == pytest.approx((up - down) / 2e-5, rel=1e-4)


def test_errors_of_left_out_points_are_those_of_a_process_without_them() -> None:
    found = fit(POINTS, VALUES)
    nugget = 1e-5
    whole = covariance(POINTS, POINTS, found.scales) + nugget * np.eye(80)
    inverse, mean, _ = gaussian_process.solved(whole[1:, 1:], quadratic(POINTS[1:]), VALUES[1:])
    there = quadratic(POINTS[:1]) @ mean + covariance(POINTS[:1], POINTS[1:], found.scales) @ (inverse @ VALUES[1:])
    own, _, _ = gaussian_process.solved(whole, quadratic(POINTS), VALUES)
    assert (own @ VALUES)[0] / own[0, 0] == pytest.approx(VALUES[0] - there[0], rel=1e-3)
