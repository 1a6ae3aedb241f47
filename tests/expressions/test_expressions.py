"""Expressions: values by hand, text that reads back, units, and one sentence for anything that is no arithmetic."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mixedlub.expressions import FUNCTIONS, Call, Expression, Name, Node, Number, parse
from profiles.errors import InputError

VALUES = {"a": 2.0, "b": 3.0, "load": 840.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("(load/420 N)^a", 4.0),
        ("2^a^b", 256.0),
        ("2**-a", 0.25),
        ("-a^2", -4.0),
        ("a - b - 1", -2.0),
        ("12/a/b", 2.0),
        ("a + b*2", 8.0),
        ("exp(log(a)) + sqrt(b + 1) + tanh(0)", 4.0),
        ("min(a, b, 1) + max(a, b) + abs(-a) + sign(-b)", 5.0),
        ("1e-3*.5", 5e-4),
    ],
)
def test_arithmetic_has_the_value_by_hand(text: str, value: float) -> None:
    assert float(parse(text).evaluate(VALUES)) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("420 N", 420.0),
        ("2 km/h", 2.0 / 3.6),
        ("30 degC", 303.15),
        ("30 °C", 303.15),
        ("1000 rpm", 1000.0 * math.pi / 30.0),
        ("30 mPa s", 0.03),
        ("50 Nm", 50.0),
        ("40 cSt", 4e-5),
        ("5 mm^2", 5e-6),
        ("0.14 W/(m K)", 0.14),
        ("50 %", 0.5),
        ("0.2 GPa", 2e8),
    ],
)
def test_a_number_with_a_unit_is_in_si(text: str, value: float) -> None:
    assert float(parse(text).evaluate({})) == pytest.approx(value, rel=1e-12)


def test_a_blank_before_the_slash_divides_by_a_quantity() -> None:
    assert float(parse("2 m / s", ["s"]).evaluate({"s": 4.0})) == 0.5
    with pytest.raises(InputError, match="s is a unit and a name here"):
        parse("2 m/s", ["s"])


def test_arrays_broadcast() -> None:
    found = parse("a*b").evaluate({"a": np.ones((3, 1)), "b": np.arange(4.0)})
    assert found.shape == (3, 4)
    assert found[2].tolist() == [0.0, 1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("__import__('os')", "'__import__': no such function"),
        ("a.b", "an operator is missing"),
        ("a[0]", "'\\['"),
        ("f(a)", "no such function"),
        ("lambda: 1", "'lambda': no such quantity"),
        ("a if b else a", "an operator is missing"),
        ("a == b", "'='"),
        ("'a'", "is not read"),
        ("a b", "character 3: 'b': an operator is missing"),
        ("lod", "no such quantity or parameter; nearest known: 'load'"),
        ("exp(a, b)", "takes one number"),
        ("min(a)", "takes two numbers"),
        ("exp", "needs its argument"),
        ("(a", "ends too early"),
        ("a)", "an operator is missing"),
        ("", "needs an expression"),
        ("2 apples", "no such unit"),
        ("2 k", "no such unit"),
        ("420 N^a", "write \\(420 N\\)\\^"),
        ("1e999", "must be a finite number"),
        ("(" * 60 + "a" + ")" * 60, "more than 40"),
        ("a+" * 2000 + "a", "at most 2000"),
    ],
)
def test_anything_but_arithmetic_is_one_sentence(text: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        parse(text, [*VALUES], "law.toml: expression")
    assert str(caught.value).startswith("law.toml: expression")
    assert "\n" not in str(caught.value)


LEAVES = st.sampled_from([Name("a"), Name("b"), Number(3.0, "3"), Number(420.0, "420 N"), Number(2.0, "2 m/s")])


def _with(inner: st.SearchStrategy[Node]) -> st.SearchStrategy[Node]:
    two = st.builds(Call, st.sampled_from("+-*/^"), st.tuples(inner, inner))
    one = st.builds(
        Call, st.sampled_from(["negative", *(f for f in FUNCTIONS if f not in ("min", "max"))]), st.tuples(inner)
    )
    return two | one | st.builds(Call, st.sampled_from(["min", "max"]), st.tuples(inner, inner))


@given(st.recursive(LEAVES, _with, max_leaves=8))
def test_the_text_of_a_tree_reads_back_as_the_tree(tree: Node) -> None:
    assert parse(Expression.of(tree).text).tree == tree
