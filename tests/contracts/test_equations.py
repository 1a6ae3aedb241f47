"""The letters of an effect's equation are its parameters, the quantities it names, or defined beside it."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from mixedlub.chain.effect import Effect
from mixedlub.chain.plain_text import plain_equation, with_symbol
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.effects import catalogue
from mixedlub.report.effect_pages import effects_text
from mixedlub.report.equations import equation as drawn
from tests.contracts.rigs import EFFECTS

each = pytest.mark.parametrize("effect", EFFECTS, ids=[e.id for e in EFFECTS])

_UNLETTERED = re.compile(
    r"\\(?:text|operatorname)\{[^{}]*\}|\\(?:left|right|[bB]igg?[lr]?)(?![a-zA-Z])|\\[,;! ]"
    r"|\\sum_\{[^{}]*\}(?:\^\{\d+\})?|\\int(?=_)"
)
_SYMBOL = r"(?:\\mathrm\{[A-Za-z]+\}|\\[a-zA-Z]+|[a-zA-Z])(?:_(?:\{[^{}]*\}|\\[a-zA-Z]+|\w))?'?"
_DEFINITION = re.compile(rf"({_SYMBOL})(?:\((\\?[a-zA-Z]+)\))?\s*=")
_DIFFERENTIAL = re.compile(r"\\,d([a-z])(?![a-zA-Z])")
_COMMANDS = set(re.findall(r"\w+", "frac dfrac tfrac sqrt infty leftarrow quad qquad leq geq pm cdot times circ"))
_FUNCTIONS = set(re.findall(r"\w+'?", "exp ln sinh cosh tanh sin cos min max Phi Phi' Delta pi e"))


def canonical(symbol: str) -> str:
    r"""A LaTeX symbol as the glossary writes it: ``\theta_{oil}`` is ``theta_oil``."""
    return re.sub(r"\\mathrm|[\\{}\s]", "", symbol)


def members(symbol: str) -> list[str]:
    """What a symbol with several or a running index stands for: m_2,4 for m_2 and m_4, omega_i for omega_1 first."""
    base, _, index = symbol.partition("_")
    if re.fullmatch(r"\d(,\d)+", index):
        return [f"{base}_{k}" for k in index.split(",")]
    return [re.sub(r"_[ik]$", "_1", symbol)]


def letters(equation: str) -> set[str]:
    """Every symbol of an equation."""
    text = _UNLETTERED.sub(" ", _DIFFERENTIAL.sub(r" \1", equation))
    return {canonical(found) for found in re.findall(_SYMBOL, text)} - _COMMANDS - _FUNCTIONS


def defined(equation: str) -> set[str]:
    """What an equation explains itself: left of an equals sign, argument, variable of an integral, running index."""
    text = _UNLETTERED.sub(" ", equation)
    both = [canonical(s) for found in _DEFINITION.findall(text) for s in found if s]
    return {*both, *(one for s in both for one in members(s)), *_DIFFERENTIAL.findall(equation)} | set(
        re.findall(r"\\sum_\{([ik])=", equation)
    )


def unexplained(effect: Effect) -> set[str]:
    """The letters of an effect's equation that are no parameter, no quantity it names and not defined."""
    known = {GLOSSARY[q].symbol for q in (*effect.acts_on, *effect.reads)}
    known |= {canonical(p.symbol) for p in effect.parameters} | defined(effect.equation)
    return {s for s in letters(effect.equation) if s not in known and not known.issuperset(members(s))}


def missing(effect: Effect) -> list[str]:
    """The parameters without a symbol, or whose symbol does not stand in the equation."""
    there = letters(effect.equation)
    if r"\sum_{k=" in effect.equation:
        there |= {re.sub("k$", str(k), s) for s in there for k in range(1, 1 + len(effect.parameters))}
    return [p.name for p in effect.parameters if not p.symbol or canonical(p.symbol) not in there]


@each
def test_every_parameter_has_a_symbol_of_the_equation(effect: Effect) -> None:
    assert not missing(effect)


@each
def test_symbols_differ_from_each_other_and_from_those_of_the_quantities(effect: Effect) -> None:
    symbols = [canonical(p.symbol) for p in effect.parameters]
    symbols += [GLOSSARY[q].symbol for q in (*effect.acts_on, *effect.reads)]
    assert len(set(symbols)) == len(symbols), sorted(symbols)


@each
def test_every_letter_of_the_equation_is_explained(effect: Effect) -> None:
    assert not unexplained(effect)


def test_an_equation_that_lacks_a_parameter_or_explains_a_letter_nowhere_is_found() -> None:
    creep = catalogue()["contact_creep"]
    assert missing(replace(creep, equation=creep.equation.replace("^m", "^3"))) == ["power"]
    assert unexplained(replace(creep, equation=creep.equation.replace("S_0", "S_1"))) == {"S_1"}
    nameless = tuple(replace(p, symbol="") for p in creep.parameters)
    assert missing(replace(creep, parameters=nameless)) == [p.name for p in creep.parameters]


@pytest.mark.parametrize("effect", [catalogue()["churning"], catalogue()["sensor_offset"]], ids=lambda e: e.id)
def test_page_shows_the_symbol_beside_the_name(effect: Effect) -> None:
    page = effects_text(effect.id)
    for p in effect.parameters:
        assert f"  {with_symbol(p.name, plain_equation(p.symbol))}  " in page


@each
def test_the_page_of_a_study_draws_the_equation(effect: Effect) -> None:
    assert drawn(effect.equation).startswith("<svg")
