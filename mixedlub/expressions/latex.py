"""Expressions as LaTeX, for the equations of pages."""

from __future__ import annotations

import re
from collections.abc import Callable

from mixedlub.expressions.tree import Call, Name, Node, Number

RANKS = {"+": 1, "-": 1, "*": 2, "negative": 1}
"""Ranks of the operators that need brackets inside products and powers; a fraction needs none in a product."""
_HEADS = {"exp": r"\exp", "log": r"\ln", "tanh": r"\tanh", "min": r"\min", "max": r"\max", "sign": r"\mathrm{sgn}"}


def latex(node: Node, symbol: Callable[[str], str]) -> str:
    r"""LaTeX of a tree; ``symbol``: LaTeX of each name.

    >>> from mixedlub.expressions import parse
    >>> latex(parse("(load/420 N)^a*exp(-b)").tree, lambda name: {"load": "F"}.get(name, name))
    '\\left(\\frac{F}{420\\,\\text{N}}\\right)^{a}\\,\\exp\\left(-b\\right)'
    """
    if isinstance(node, Number):
        number, _, unit = str(node).partition(" ")
        return number + _unit(unit)
    if isinstance(node, Name):
        return symbol(node.name)
    return _call(node, [latex(argument, symbol) for argument in node.arguments])


def _unit(unit: str) -> str:
    return rf"\,\text{{{unit.replace('%', chr(92) + '%')}}}" if unit else ""


def _call(node: Call, texts: list[str]) -> str:
    first = texts[0]
    if node.of == "/":
        return rf"\frac{{{first}}}{{{texts[1]}}}"
    if node.of == "^":
        plain = isinstance(node.arguments[0], Name) and "^" not in first
        return rf"{first if plain else _brackets(first)}^{{{texts[1]}}}"
    if node.of == "negative":
        return f"-{_within(node.arguments[0], first, 2)}"
    if node.of == "*":
        one, other = (_within(n, t, 2) for n, t in zip(node.arguments, texts, strict=True))
        return rf"{one}\cdot {other}" if other[0].isdigit() else rf"{one}\,{other}"
    if node.of in RANKS:
        right = _within(node.arguments[1], texts[1], 2 if node.of == "-" else 1)
        return f"{first} {node.of} {right}"
    if node.of == "sqrt":
        return rf"\sqrt{{{first}}}"
    if node.of == "abs":
        return rf"\left|{first}\right|"
    return _HEADS[node.of] + _brackets(", ".join(texts))


def _within(node: Node, text: str, rank: int) -> str:
    """Text of an argument, in brackets if its rank is below ``rank``."""
    return _brackets(text) if isinstance(node, Call) and RANKS.get(node.of, rank) < rank else text


def _brackets(text: str) -> str:
    return rf"\left({text}\right)"


def symbol_in_latex(plain: str, greek: re.Pattern[str]) -> str:
    """LaTeX of a symbol of the glossary; ``greek``: pattern of the names of Greek letters.

    >>> symbol_in_latex("theta_oil", re.compile("theta"))
    '\\\\theta_{oil}'
    """
    return greek.sub(lambda found: f"\\{found[0]}", re.sub(r"_(\w+)", r"_{\1}", plain))
