"""Synthetic traces against the truth they are returned with."""

import numpy as np
import pytest

from profiles import InputError
from profiles.synthesise import from_spectrum, of_moments, self_affine, uniform

GRID = {"points": 20000, "spacing": 0.25e-6}


def periodic_moments(profile):
    """Mean squares of height, slope and curvature of a closed trace, by its Fourier series."""
    coefficients = np.fft.rfft(profile.heights)
    q = 2 * np.pi * np.fft.rfftfreq(profile.heights.size, profile.spacing)
    return [np.mean(np.fft.irfft(coefficients * q**k, profile.heights.size) ** 2) for k in (0, 1, 2)]


@pytest.mark.parametrize("points", [4096, 4097])
def test_exact_moments_are_those_of_the_trace(points):
    trace = from_spectrum(lambda q: np.exp(-((q * 3e-6) ** 2)), points=points, spacing=0.5e-6, seed=2)
    assert periodic_moments(trace.profile) == pytest.approx([trace.m0, trace.m2, trace.m4], rel=1e-10)


@pytest.mark.parametrize("alpha", [1.5, 2.0, 6.4, 30.0])
def test_prescribed_moments_are_met(alpha):
    m2, m4 = 2.5e-3, 3.6e9
    trace = of_moments(alpha * m2**2 / m4, m2, m4, seed=4, **GRID)
    found = periodic_moments(trace.profile)
    assert found == pytest.approx([alpha * m2**2 / m4, m2, m4], rel=1e-9)
    assert trace.bandwidth == pytest.approx(alpha, rel=1e-9)


def test_self_affine_spectrum_has_the_hurst_exponent():
    trace = self_affine(1e-7, hurst=0.7, rolloff=2e-4, shortest=2e-6, seed=1, **GRID)
    power = np.abs(np.fft.rfft(trace.profile.heights)) ** 2
    q = 2 * np.pi * np.fft.rfftfreq(GRID["points"], GRID["spacing"])
    band = (q > 2 * np.pi / 1e-4) & (q < 2 * np.pi / 3e-6)
    slope = np.polyfit(np.log(q[band]), np.log(power[band]), 1)[0]
    assert slope == pytest.approx(-1 - 2 * 0.7, abs=1e-6)


def test_heights_are_gaussian():
    trace = self_affine(1e-7, hurst=0.8, rolloff=2e-5, shortest=2e-6, seed=8, **GRID)
    w = trace.profile.heights / np.sqrt(trace.m0)
    # About 250 independent waves: standard errors near 0.1 and 0.2.
    assert np.mean(w**3) == pytest.approx(0, abs=0.3)
    assert np.mean(w**4) == pytest.approx(3, abs=0.6)


def test_the_same_seed_gives_the_same_trace_and_another_seed_another():
    make = lambda seed: self_affine(1e-7, hurst=0.8, rolloff=2e-5, shortest=2e-6, seed=seed, **GRID)  # noqa: E731
    assert (make(1).profile.heights == make(1).profile.heights).all()
    assert not np.allclose(make(1).profile.heights, make(2).profile.heights)


def test_uniform_numbers_are_uniform():
    u = uniform(123, 100_000)
    assert u.min() > 0
    assert u.max() < 1
    assert np.histogram(u, 10, (0, 1))[0] == pytest.approx(10_000, abs=400)


@pytest.mark.parametrize("moments", [(1e-14, 1e-3, 1e8), (-1e-14, 1e-3, 1e9), (1e-14, np.nan, 1e9)])
def test_impossible_moments_are_refused(moments):
    with pytest.raises(InputError, match="m0 m4 > m2"):
        of_moments(*moments, seed=1, **GRID)


def test_a_band_the_trace_cannot_hold_is_refused():
    with pytest.raises(InputError, match="cannot hold the band"):
        of_moments(1e-14, 2.5e-3, 3.6e12, seed=1, **GRID)
