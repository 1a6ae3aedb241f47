"""Contact integrals of height distributions, against sums over the heights and the closed forms of normal ones."""

import numpy as np
import pytest

from profiles import InputError
from roughness.height_shapes import at_gap, log_integrals, measured_shape, normal_shape, plateau_shape
from roughness.integrals import area_integral, load_integral
from roughness.probability import Plateau

GAPS = np.array([-2.0, -0.5, 0.0, 1.0, 2.0, 3.0])


def both(first, second, share):
    table = log_integrals(first, second, share)
    return [np.exp(at_gap(table, row, GAPS)) for row in (0, 1)]


def test_two_normal_surfaces_are_one():
    area, load = both(normal_shape(), normal_shape(), 0.3)
    assert area == pytest.approx(area_integral(GAPS), rel=1e-4)
    assert load == pytest.approx(load_integral(GAPS), rel=2.5e-4)


def test_heights_of_two_surfaces_meet_as_their_sums_do():
    """Every height of one against every height of the other."""
    rng = np.random.default_rng(1)
    one, other = -rng.gamma(2.0, size=900) * 1e-7, rng.standard_normal(800) * 3e-7
    share = one.var() / (one.var() + other.var())
    sums = (one - one.mean())[:, None] + (other - other.mean())[None, :]
    over = np.maximum(sums.ravel() / np.sqrt(one.var() + other.var()) - GAPS[:, None], 0.0)
    area, load = both(measured_shape(one), measured_shape(other), share)
    assert area == pytest.approx(over.mean(axis=1), rel=2e-3)
    assert load == pytest.approx((over**1.5).mean(axis=1), rel=3e-3)


def test_above_the_knee_a_plateau_is_a_smoother_normal_surface():
    """F_n(t) is sigma_u^n F_n((t - m_u)/sigma_u) there, as only the upper process acts."""
    lines = Plateau(plateau_sigma=0.4, valley_sigma=2.0, material_percent=84.134, knee_height=-0.1, plateau_mean=0.3)
    shape = plateau_shape(lines, 0.0, 1.0)
    area, load = both(shape, normal_shape(), 1.0)
    above = GAPS > 0
    assert area[above] == pytest.approx(0.4 * area_integral((GAPS[above] - 0.3) / 0.4), rel=2e-2)
    assert load[above][:2] == pytest.approx(0.4**1.5 * load_integral((GAPS[above][:2] - 0.3) / 0.4), rel=1e-2)


def test_a_plateau_of_one_process_is_a_normal_surface():
    area, load = both(plateau_shape(Plateau(2e-7, 2e-7, 60.0, 0.0, 0.0), 0.0, 2e-7), normal_shape(), 0.5)
    assert area == pytest.approx(area_integral(GAPS), rel=1e-4)
    assert load == pytest.approx(load_integral(GAPS), rel=3e-4)


def test_nothing_touches_above_the_highest_height():
    flat = measured_shape(np.array([-1.0, 1.0]))
    area, _ = both(flat, normal_shape(), 1.0)
    assert area[GAPS >= 2.0] == pytest.approx(0.0, abs=1e-200)
    assert area[2] == pytest.approx(0.5)


def test_lines_that_fall_are_no_plateau():
    with pytest.raises(InputError, match="no two lines"):
        plateau_shape(Plateau(-1e-8, 1e-7, 50.0, 0.0, 0.0), 0.0, 1e-7)
