"""Three effects at once: their prior odds, and that they are looked for where two leave something over."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, pairwise

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.initial_guesses import fit_singles, sample
from mixedlub.diagnosis.inference.map_fit import map_fit
from mixedlub.diagnosis.search.prior_odds import PriorOdds, priors
from mixedlub.diagnosis.search.several import with_additions
from mixedlub.diagnosis.settings.search import PRIOR
from mixedlub.validation.battery import make as deal
from mixedlub.validation.sample_case import Order

from .test_inference import problem

EFFECTS = ("boundary_film_temperature", "churning", "seal_drag", "tip_relief", "sensor_gain")
LAWS = ("film_law", "shear_law")


def test_the_odds_of_every_set_of_effects_and_laws_add_up_to_the_total() -> None:
    prior = PriorOdds.of((*EFFECTS, *LAWS))
    sets = [e + w for n in range(4) for e in combinations(EFFECTS, n) for k in range(3) for w in combinations(LAWS, k)]
    some = sum(float(np.exp(prior.log(Explanation.of(*one) if one else NOTHING))) for one in sets)
    discrepancy = PRIOR["discrepancy"] * sum(
        float(np.exp(prior.log(Explanation.of(*w) if w else NOTHING) - prior.log(NOTHING)))
        for k in range(3)
        for w in combinations(LAWS, k)
    )
    assert some + discrepancy == pytest.approx(prior.total, rel=1e-12)


def test_each_further_effect_is_less_probable_beforehand() -> None:
    weights = priors(40)
    assert all(more < fewer for fewer, more in pairwise(weights[1:]))
    assert len(priors(0)) == len(weights)


@pytest.mark.long
def test_a_third_effect_is_tried_where_two_leave_something_over_and_not_where_they_do_not() -> None:
    p = problem(relative=0.004)
    null_fit = map_fit(p, NOTHING, np.zeros(p.size(NOTHING)))
    draws = tuple(sample(p, name, null_fit) for name in EFFECTS[:4])
    for count in (2, 3):
        change = sum(max(s.change, key=np.linalg.norm) for s in draws[:count])
        made = replace(p, y=null_fit.prediction + p.sd * change)
        singles = fit_singles(made, map_fit(made, NOTHING, null_fit.z), draws)
        pair = Explanation.of(*EFFECTS[:2])
        start = np.zeros(made.size(pair))
        fits = {NOTHING: map_fit(made, NOTHING, null_fit.z), **singles, pair: map_fit(made, pair, start)}
        found = with_additions(made, fits, draws)
        best = max(found.values(), key=lambda f: f.evidence + PriorOdds.of(EFFECTS).log(f.explanation))
        assert best.explanation == Explanation.of(*EFFECTS[:count])


@pytest.mark.long
def test_three_effects_planted_by_the_independent_generator_are_named(tmp_path) -> None:
    effects = ("fluid_drag", "presliding", "stribeck")
    order = Order("three", "friction_map", "triple", effects, "clear")
    found = diagnose_case(tmp_path / deal(6, 0, order, tmp_path))
    assert set(effects) <= set().union(*(one.effects for one in found.posterior.tied))
    assert any(set(effects) == set(one.effects) for one in found.posterior.tied)
