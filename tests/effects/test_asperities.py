"""Effects on asperities against the integrals over heights that they shorten."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate, optimize, stats

from mixedlub.effects.asperity_plasticity import asperity_plasticity
from mixedlub.effects.skewed_heights import _skewed_area_integral
from roughness.integrals import area_integral


@pytest.mark.parametrize("skewness", [-2.0, -0.8, -0.05, 0.05, 0.6, 1.5])
@pytest.mark.parametrize("gap", [-1.5, 0.0, 1.0, 2.2])
def test_skewed_area_integral_is_that_of_lognormal_heights(skewness: float, gap: float) -> None:
    def skew(shape: float) -> float:
        return float(stats.lognorm(shape).stats(moments="s")) - abs(skewness)

    law = stats.lognorm(optimize.brentq(skew, 1e-4, 2.0, xtol=1e-14))
    side = np.sign(skewness)
    mean, sd = law.mean(), law.std()

    def excess(height: float) -> float:
        return max(side * (height - mean) / sd - gap, 0.0) * law.pdf(height)

    edge = mean + side * gap * sd
    ends = (max(edge, 0.0), np.inf) if side > 0 else (0.0, max(edge, 0.0))
    expected = integrate.quad(excess, *ends, limit=200, epsabs=1e-13)[0]
    assert _skewed_area_integral(np.array(gap), skewness) == pytest.approx(expected, abs=1e-8)


def test_skewed_area_integral_joins_the_normal_one() -> None:
    gaps = np.linspace(-2.0, 3.0, 11)
    below, above = (_skewed_area_integral(gaps, s) for s in (-0.99999e-4, -1.00001e-4))
    np.testing.assert_allclose(below, above, atol=2e-9)
    np.testing.assert_allclose(_skewed_area_integral(gaps, 0.0), area_integral(gaps), rtol=1e-15)


def test_plastic_area_is_the_sum_over_asperities() -> None:
    """Each summit has pi R w below onset w_c and pi R w (2 - w_c/w) above."""
    gap, onset = 0.7, 0.4
    radius, sigma, density, modulus = 1e-5, 1e-7, 1e10, 226e9
    hardness = np.sqrt(onset * sigma / radius) * modulus / (np.pi * 0.577)

    def area(height: float) -> float:
        w = height - gap
        return (w if w < onset else 2.0 * w - onset) * stats.norm.pdf(height)

    expected = np.pi * density * radius * sigma * integrate.quad(area, gap, 12.0, points=[gap + onset])[0]
    elastic = np.pi * density * radius * sigma * area_integral(gap)
    found = asperity_plasticity(elastic, gap, density, radius, sigma, modulus, strength=1.0, hardness=hardness)
    assert found == pytest.approx(expected, rel=1e-6)
