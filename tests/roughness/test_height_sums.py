"""Sums over Gaussian heights: the fast ones against the integrals themselves, over their whole range."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from roughness import single_asperity
from roughness.height_sums import AREA, FIRST, LAST, LOAD, MOST_ONSETS, height_sum, integrated
from roughness.integrals import area_integral, gaussian_integral, load_integral, pair_area_integral, pair_load_integral

LAWS = {
    "chang_etsion_bogy": single_asperity.chang_etsion_bogy(),
    "zhao_maietta_chang": single_asperity.zhao_maietta_chang(),
    "kogut_etsion": single_asperity.kogut_etsion(),
    "jackson_green": single_asperity.jackson_green(0.02),
}
each = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
FAST = {1.0: area_integral, 1.5: load_integral, 2.0: pair_area_integral, 2.5: pair_load_integral}


@pytest.mark.parametrize("n", FAST)
def test_fast_integrals_are_within_their_bound(n):
    t = np.linspace(-6.0, 36.0, 40_001)
    assert FAST[n](t) == pytest.approx(gaussian_integral(n, t), rel=1e-7, abs=0.0)
    beyond = t > 10.0
    assert FAST[n](t[beyond]) == pytest.approx(gaussian_integral(n, t[beyond]), rel=1e-11, abs=0.0)


def adaptively(factor, power, first, t, onset):
    """The sum by QUADPACK, over the density at the nearest height, in pieces between the edges and about the peak."""
    end = np.sqrt(max(t, 0.0) ** 2 + 80.0) - t

    def summand(x):
        ratio = factor(np.asarray(x / onset)) if x > first * onset else 1.0
        return float(ratio) * x**power * np.exp(-0.5 * ((t + x) ** 2 - max(t, 0.0) ** 2))

    edges = {x * onset for x in (1.0, 1.9, 6.0, 54.0, 110.0)} | {-t, 2.0 - t, -t - 2.0}
    edges |= {end * 0.25**k for k in range(11)}
    places = [0.0, *sorted(x for x in edges if 0.0 < x < end), end]
    parts = (quad(summand, a, b, epsabs=0.0, epsrel=1e-11, limit=200)[0] for a, b in itertools.pairwise(places))
    return sum(parts) * np.exp(-0.5 * max(t, 0.0) ** 2) / np.sqrt(2.0 * np.pi)


@each
def test_integrals_agree_with_quadpack(law):
    rng = np.random.default_rng(5)
    for t, onset in zip(rng.uniform(FIRST, LAST, 25), 10.0 ** rng.uniform(-5.0, 1.5, 25)):
        area, load = integrated(law, np.array(t), np.array(onset))
        assert area == pytest.approx(adaptively(law.area, 1.0, law.edges[0], t, onset), rel=1e-9, abs=0.0)
        assert load == pytest.approx(adaptively(law.load, 1.5, law.edges[0], t, onset), rel=1e-9, abs=0.0)


@each
def test_table_is_within_its_bound_over_the_whole_range(law):
    gaps = np.linspace(-8.0, LAST, 461)
    onsets = np.geomspace(1e-6, 1e2, 17)[:, None]
    exact = integrated(law, gaps, onsets)
    for which in (AREA, LOAD):
        assert height_sum(law, which, gaps, onsets) == pytest.approx(exact[which], rel=1e-7, abs=0.0)
        assert not height_sum(law, which, np.array([LAST + 1e-9, 50.0]), 0.01).any()


@pytest.mark.long
@each
def test_many_different_onsets_are_within_their_bound(law):
    rng = np.random.default_rng(3)
    gaps = rng.uniform(-5.0, LAST, (1, MOST_ONSETS))
    onsets = 10.0 ** rng.uniform(-3.0, 1.0, gaps.shape)
    edges = np.exp(np.arange(-300, 301) / 64.0)  # on the nodes of the grid, the outermost among them
    for given in ((gaps, onsets), (1.0, edges)):
        exact = integrated(law, *given)
        for which in (AREA, LOAD):
            assert height_sum(law, which, *given) == pytest.approx(exact[which], rel=1e-6, abs=0.0)


@each
def test_nothing_yields_far_below_onset(law):
    gaps = np.linspace(-3.0, 9.0, 50)
    assert height_sum(law, AREA, gaps, 1e3) == pytest.approx(gaussian_integral(1.0, gaps), rel=1e-7, abs=0.0)
    assert height_sum(law, LOAD, gaps, 1e3) == pytest.approx(gaussian_integral(1.5, gaps), rel=1e-7, abs=0.0)


@each
def test_a_gap_that_is_not_a_number_stays_so(law):
    assert np.isnan(height_sum(law, AREA, np.array([np.nan, 1.0]), 0.1)).tolist() == [True, False]
