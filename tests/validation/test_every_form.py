"""Every published form: complete in what it says of itself, dealt in turn, and counted by name."""

import inspect
from collections import Counter

import numpy as np
import pytest

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.forms import every_form, plan_forms
from mixedlub.validation.planted import FORMS
from mixedlub.validation.rigs import KINDS
from mixedlub.validation.sample_case import sample_case
from mixedlub.validation.tables import by_form
from profiles.errors import InputError


@pytest.fixture(scope="module")
def listed():
    return every_form()


def test_every_form_of_gears_and_discs_is_listed(listed):
    assert {(one.effect, one.source) for one in listed} >= {
        (form.id, form.source) for forms in FORMS.values() for form in forms
    }


def test_every_form_states_its_formula_and_source(listed):
    without = [
        (one.effect, form.law.__name__)
        for one in listed
        for form in one.on.values()
        if not (inspect.getdoc(form.law) and form.source)
    ]
    assert without == []


def test_the_catalogue_becomes_a_form_on_kinds_that_have_it(listed):
    (carreau,) = (one for one in listed if one.source == "Carreau 1972")
    assert set(carreau.within) == {"film", "mesh_friction"} < set(carreau.kinds)


def test_a_battery_deals_every_form_and_the_first_again(listed):
    orders = plan_forms(5, len(listed) + 3)
    dealt = Counter((order.effects[0], order.law) for order in orders)
    named = [{(one.effect, form.law.__name__) for form in one.on.values()} for one in listed]
    times = [sum(dealt[key] for key in keys) for keys in named]
    assert times[:3] == [2, 2, 2]
    assert set(times[3:]) == {1}
    assert plan_forms(5, len(listed)) != plan_forms(6, len(listed))


def test_a_case_has_the_form_it_is_ordered_with():
    orders = [
        order for order in plan_forms(5, len(every_form(("film",))), ("film",)) if order.effects[0] == "starvation"
    ]
    rng = np.random.default_rng(1)
    for order in orders[:2]:
        assert [form.law.__name__ for form in sample_case(rng, order).forms] == [order.law]


def test_too_few_cases_for_every_form_are_refused(listed):
    with pytest.raises(InputError, match=f"at least {len(listed)}"):
        plan_forms(5, len(listed) - 1)
    assert len(every_form(("viscosity",))) < len(listed) < 40 * len(KINDS)


def _pair(verdict, tied, source):
    one = np.zeros(1)
    truth = Truth(
        "case", "film", "single", ("starvation",), frozenset({"starvation"}), 9.0, True, False, False, frozenset(), {},
        one, one > 0, one, one, one + 1, forms=(source,),
    )  # fmt: skip
    both = tuple(frozenset({name}) for name in tied)
    return truth, Answer("case", frozenset({verdict}), both, {}, True, frozenset(), {}, {}, one, one, one, one, one)


def test_right_and_tied_answers_are_counted_by_form():
    pairs = [
        _pair("starvation", (), "first"),
        _pair("none", ("starvation",), "first"),
        _pair("none", (), "second"),
    ]
    rows = [line.split() for line in by_form({"film": pairs}).splitlines()]
    assert rows[0] == ["by", "form", "source", "right", "tied", "identifiable", "cases"]
    assert rows[1:] == [["starvation", "first", "1", "2", "2", "2"], ["starvation", "second", "0", "0", "1", "1"]]
