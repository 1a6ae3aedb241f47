"""The Gaussian verdict on surfaces of known making."""

import numpy as np
import pytest

from profiles import InputError, Profile
from roughness import normal_probability
from roughness.integrals import area_integral
from roughness.probability import correlation_sums, extreme_limit, two_lines


def test_line_recovers_mean_and_sigma(gaussian_trace):
    p = gaussian_trace(60_000, roll=20e-6)
    found = normal_probability(Profile(p.heights + 1e-6, p.spacing))
    assert found.mean == pytest.approx(1e-6, abs=0.02e-6)
    assert found.sigma == pytest.approx(p.heights.std(), rel=0.03)


@pytest.mark.parametrize("seed", range(5))
def test_gaussian_trace_is_gaussian(gaussian_trace, seed):
    found = normal_probability(gaussian_trace(seed=seed + 10))
    assert found.verdict == "gaussian"
    assert found.from_percent < 2
    assert found.to_percent > 98


@pytest.mark.parametrize("seed", range(5))
def test_plateau_is_a_plateau(plateau_trace, seed):
    found = normal_probability(plateau_trace(seed=seed))
    assert found.verdict == "plateau"
    assert found.plateau.plateau_sigma == pytest.approx(0.1e-6, rel=0.25)
    assert found.plateau.valley_sigma > 0.25e-6


def scratched(profile, count):
    z = np.array(profile.heights)
    groove = 2e-6 * (1 - (np.arange(-20, 21) / 20) ** 2)
    for at in np.linspace(500, z.size - 500, count).astype(int):
        z[at - 20 : at + 21] -= groove
    return Profile(z, profile.spacing)


def test_four_scratches_leave_a_gaussian_bulk(gaussian_trace):
    found = normal_probability(scratched(gaussian_trace(roll=30e-6), 4))
    assert found.verdict == "gaussian_bulk"
    assert 0.5 < found.from_percent < 10
    assert found.to_percent > 98


@pytest.mark.parametrize(
    "make",
    [
        lambda rng: rng.uniform(size=8000),
        lambda rng: rng.exponential(size=8000),
        lambda rng: np.sin(2 * np.pi * np.arange(8000) / 200),
        lambda rng: np.exp(0.4 * rng.normal(size=8000)),
    ],
    ids=["uniform", "exponential", "turned", "lognormal"],
)
def test_other_laws_are_not_gaussian(make):
    profile = Profile(1e-7 * make(np.random.default_rng(0)), 0.5e-6)
    assert normal_probability(profile).verdict == "not_gaussian"


@pytest.mark.parametrize("cut", [0.0, 0.15e-6])
def test_flat_top_is_no_gaussian_of_no_width(gaussian_trace, cut):
    worn = Profile(np.minimum(gaussian_trace().heights, cut), 0.5e-6)
    found = normal_probability(worn)
    assert found.verdict in ("plateau", "not_gaussian")
    assert found.sigma > 0.1 * worn.heights.std()


def test_heavy_tails_leave_a_gaussian_bulk():
    heavy = np.random.default_rng(0).standard_t(4, size=8000)
    assert normal_probability(Profile(heavy, 1e-6)).verdict == "gaussian_bulk"


def test_verdict_does_not_depend_on_unit_or_level(gaussian_trace, plateau_trace):
    for p in (gaussian_trace(), plateau_trace()):
        one, other = normal_probability(p), normal_probability(Profile(1e3 * p.heights + 2.0, p.spacing))
        assert one.verdict == other.verdict
        assert one.from_percent == pytest.approx(other.from_percent)


def test_band_widens_as_heights_correlate(gaussian_trace):
    near = normal_probability(gaussian_trace(roll=80e-6, short=30e-6))
    far = normal_probability(gaussian_trace(roll=10e-6, short=3e-6))
    assert near.independent_heights < 0.5 * far.independent_heights
    assert near.band[60] / near.sigma > far.band[60] / far.sigma


def test_correlation_sums_of_a_first_order_process():
    a = 0.8
    sums = correlation_sums(a ** np.arange(5000.0), orders=3)
    assert sums == pytest.approx([(1 + a**k) / (1 - a**k) for k in (1, 2, 3)], rel=5e-3)


def test_contact_ratio_of_a_plateau_is_that_of_its_overlap(plateau_trace):
    p = plateau_trace()
    z = (p.heights - p.heights.mean()) / p.heights.std()
    ratio = normal_probability(p).contact_ratio
    assert ratio[0] == pytest.approx(np.maximum(z - 1, 0).mean() / float(area_integral(1.0)))
    assert ratio[1] < 0.3


def test_two_lines_read_back_a_drawn_plateau():
    from scipy.special import ndtri

    q = ndtri((np.arange(20000) + 0.5) / 20000)
    z = np.where(q > -1, 0.1 * q, -0.1 + 0.6 * (q + 1))
    found = two_lines(Profile(np.random.default_rng(0).permutation(z) * 1e-6, 1e-6))
    assert found.plateau_sigma == pytest.approx(0.1e-6, rel=0.05)
    assert found.valley_sigma == pytest.approx(0.6e-6, rel=0.05)
    assert found.material_percent == pytest.approx(84.1, abs=2)


def test_words_name_the_verdict(gaussian_trace, plateau_trace):
    assert normal_probability(gaussian_trace()).words.startswith("Gaussian from")
    assert normal_probability(plateau_trace()).words.startswith("plateau of sigma")


def test_too_few_heights_are_refused():
    with pytest.raises(InputError, match="fifty heights"):
        normal_probability(Profile(np.arange(20.0), 1e-6))


@pytest.mark.parametrize("height", [4e-6, 20e-6])
def test_a_height_beyond_chance_is_not_gaussian(gaussian_trace, height):
    """One sample of 9600 at 13 and at 67 sigma passed for Gaussian, with Rku 48 and 15 times the overlap at 3 sigma."""
    p = gaussian_trace()
    z = np.array(p.heights)
    z[4800] += height
    before, found = normal_probability(p), normal_probability(Profile(z, p.spacing))
    assert before.verdict == "gaussian"
    assert found.verdict == "gaussian_bulk"
    assert found.independent_heights == pytest.approx(before.independent_heights, rel=0.02)


def test_extreme_limit_is_kept_by_gaussian_heights():
    drawn = np.abs(np.random.default_rng(0).normal(size=(4000, 500))).max(axis=1)
    assert np.mean(drawn > extreme_limit(500, 0.05)) == pytest.approx(0.05, abs=0.01)
    assert np.mean(drawn > extreme_limit(500)) < 0.003
