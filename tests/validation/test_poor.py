"""Batteries of poor recordings: what they deal, how their noise is made and stated, and how answers are scored."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.answers import read_truth
from mixedlub.validation.battery import errors, make
from mixedlub.validation.poor import FLAWS, POOR_FIGURES, THREE, TRIPLE, plan_poor
from mixedlub.validation.rigs import CONTACTS, OTHERS
from mixedlub.validation.sample_case import FEW, FEW_SIZES, HEAVY, LASTING, MIS_SET, SD_ESTIMATED, Order, sample_case
from mixedlub.validation.score import score
from profiles.errors import InputError

from .test_score import answer_of, truth_of


def test_errors_have_the_stated_standard_deviation_whatever_their_flaw():
    for flaws in ((), (HEAVY,), (LASTING,)):
        some = errors(np.random.default_rng(3), 200_000, flaws)
        assert abs(np.std(some) - 1.0) < 0.05
        assert abs(np.mean(some)) < 0.05


def test_lasting_errors_are_those_of_their_neighbours_and_heavy_ones_leave_three_sds():
    def alike(some):
        return np.corrcoef(some[1:], some[:-1])[0, 1]

    assert alike(errors(np.random.default_rng(5), 50_000, (LASTING,))) > 0.2
    assert abs(alike(errors(np.random.default_rng(5), 50_000, (HEAVY,)))) < 0.02
    assert np.mean(np.abs(errors(np.random.default_rng(5), 50_000, (HEAVY,))) > 3.0) > 0.01


def test_a_battery_that_is_too_small_says_how_many_cases_it_needs():
    with pytest.raises(InputError, match="at least 12 cases"):
        plan_poor(1, 5, ("gear_pair", "film"))


def test_three_effects_count_where_one_explanation_has_all():
    truth = truth_of("churning+film_heating+starvation", TRIPLE)
    two = answer_of("churning+film_heating", truth)
    found = score([(truth, replace(two, tied=(two.verdict, truth.label))), (truth, two)], figures=POOR_FIGURES)
    assert found["three"].value == 0.5
    assert found["two_of_three"].value == 1.0


@pytest.mark.long
def test_every_case_has_a_flaw_and_half_are_gears_and_discs():
    orders = plan_poor(5, 240, (*CONTACTS, *OTHERS))
    assert all(order.flaws for order in orders)
    assert set(Counter(flaw for order in orders for flaw in order.flaws)) == set(FLAWS)
    assert 0.4 < sum(order.kind in CONTACTS for order in orders) / 240 < 0.6
    assert not any(order.no_data_sheet for order in orders if MIS_SET in order.flaws)
    assert {len(order.flaws) for order in orders} == {1, 2}
    triples = [order for order in orders if order.label == TRIPLE]
    assert len(triples) >= 30
    assert all(len(set(order.effects)) == 3 and order.flaws == (THREE,) for order in triples)


@pytest.mark.long
def test_flaws_are_dealt_as_their_names_say(tmp_path):
    few = Order("few", "disc", "single", ("film_heating",), "clear", small=True, flaws=(FEW,))
    off = Order("off", "disc", "single", ("film_heating",), "clear", flaws=(MIS_SET, SD_ESTIMATED))
    truth = read_truth(tmp_path / make(4, 0, few, tmp_path))
    assert FEW_SIZES[0] <= np.sum(~truth.withheld) < FEW_SIZES[1]
    assert truth.flaws == {FEW}
    sample = sample_case(np.random.default_rng(8), off)
    assert np.sum(np.abs(sample.z) >= 2.0) >= 2
