"""False alarms and power of the Gaussian verdict, by simulation over correlation, length and departure."""

from collections import Counter

import numpy as np
import pytest

from profiles import Profile
from roughness import normal_probability, roughness_profile

SPACING = 0.5e-6


def heights(rng, points, roll, short=5e-6):
    f = np.fft.rfftfreq(2 * points, SPACING)
    density = (1 + (f * roll) ** 2) ** -1.3 * np.exp(-((f * short) ** 2))
    z = np.fft.irfft(np.sqrt(density) * (rng.normal(size=f.size) + 1j * rng.normal(size=f.size)))[:points]
    return 0.3e-6 * (z - z.mean()) / z.std()


def verdicts(make, runs, seed=0):
    rng = np.random.default_rng(seed)
    found = [normal_probability(roughness_profile(Profile(make(rng), SPACING), cutoff=0.8e-3)) for _ in range(runs)]
    return Counter(f.verdict for f in found), np.array([f.p_value for f in found])


@pytest.mark.parametrize(
    ("points", "roll"),
    [
        (8000, 30e-6),
        pytest.param(8000, 100e-6, marks=pytest.mark.long),
        pytest.param(8000, 8e-6, marks=pytest.mark.long),
        pytest.param(32000, 30e-6, marks=pytest.mark.long),
    ],
)
def test_gaussian_surfaces_are_seldom_called_anything_else(points, roll):
    count, p = verdicts(lambda rng: heights(rng, points, roll), 120)
    assert count["gaussian"] >= 114
    assert count["plateau"] + count["not_gaussian"] <= 2
    # at the 1 % and 10 % levels, with the scatter of 120 runs
    assert np.mean(p < 0.01) <= 0.04
    assert 0.04 <= np.mean(p < 0.10) <= 0.20


def test_uncorrelated_band_would_raise_false_alarms():
    """What the allowance for correlation is worth: treated as independent, the same traces fail."""
    from roughness.probability import _gaussian_band, _plotted

    rng = np.random.default_rng(1)
    p = []
    for _ in range(50):
        profile = roughness_profile(Profile(heights(rng, 8000, 100e-6), SPACING), cutoff=0.8e-3)
        quantiles, plotted, sums = _plotted(profile)
        p.append(_gaussian_band(quantiles, plotted, np.ones_like(sums), 8000)[0])
    assert np.mean(np.array(p) < 0.01) > 0.5


def plateau(rng, ratio, lift):
    fine, deep = heights(rng, 8000, 30e-6) / 3, heights(rng, 8000, 60e-6) / 3
    return np.minimum(fine, ratio * deep + lift)


@pytest.mark.parametrize(
    ("ratio", "lift"),
    [
        (6, 0.6e-6),
        pytest.param(4, 0.3e-6, marks=pytest.mark.long),
        pytest.param(10, 0.5e-6, marks=pytest.mark.long),
        pytest.param(5, 0.0, marks=pytest.mark.long),
    ],
)
def test_plateaus_are_found(ratio, lift):
    count, p = verdicts(lambda rng: plateau(rng, ratio, lift), 40)
    assert count["plateau"] >= 36
    assert count["gaussian"] == 0
    assert (p < 0.01).all()


def scratched(rng, count):
    z = heights(rng, 8000, 30e-6)
    groove = 2e-6 * (1 - (np.arange(-20, 21) / 20) ** 2)
    for at in rng.integers(100, 7900, count):
        z[at - 20 : at + 21] -= groove
    return z


@pytest.mark.parametrize(("grooves", "share"), [(2, 0.5), (4, 0.9)])
def test_scratches_leave_a_gaussian_bulk(grooves, share):
    count, _ = verdicts(lambda rng: scratched(rng, grooves), 40)
    assert count["gaussian_bulk"] >= share * 40
    assert count["not_gaussian"] <= 3


@pytest.mark.parametrize(
    "shape",
    [
        lambda z: np.exp(z / 0.7e-6),
        lambda z: np.abs(z),
        lambda z: np.arctan(z / 0.15e-6),
    ],
    ids=["lognormal", "folded", "clipped"],
)
def test_distorted_surfaces_are_not_gaussian(shape):
    count, p = verdicts(lambda rng: shape(heights(rng, 32000, 15e-6)), 10)
    assert count["gaussian"] == 0
    assert count["not_gaussian"] + count["plateau"] >= 9
    assert (p < 0.01).all()
