"""Reading of expressions: text into a tree, and errors that name the place.

Powers are written ``^`` or ``**`` and group from the right. A number may carry its unit, as ``420 N`` or ``2 m/s``, and
is then converted to SI. A unit has no blank around its slash, and a power right behind a unit is one of the unit.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from math import isfinite

from mixedlub.expressions.tree import FUNCTIONS, Call, Expression, Name, Node, Number
from mixedlub.schema.units import to_si
from profiles.errors import InputError, nearest

LONGEST, DEEPEST = 2000, 40
"""Most characters, and most brackets, powers and signs inside each other, of an expression."""
_NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WORD = r"(?:[^\W\d_]|°)+"
_POWER = r"(?:\^?\d+)?"
_UNDER = rf"/(?:{_WORD}{_POWER}|\({_WORD}{_POWER}(?:[ .·]{_WORD}{_POWER})+\))"
_UNIT = re.compile(rf"\s*((?:%|{_WORD}{_POWER})(?:[ .·]{_WORD}{_POWER})*(?:{_UNDER})?)")
_NAME = re.compile(r"[^\W\d]\w*")
_LEVELS = (("+", "-"), ("*", "/"))
"""Operators of two sides, in the order in which brackets would be put last."""


def parse(text: str, names: Collection[str] | None = None, where: str = "expression") -> Expression:
    """Read an expression; ``names``: the names that it may read, by default any. ``where``: place in errors.

    >>> float(parse("2 km/h").evaluate({})) == 2 / 3.6, parse("max(a, 0) ** 2").names
    (True, ('a',))
    >>> parse("lod^a", ["load", "a"])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: expression, character 1: 'lod': no such quantity or parameter; nearest known: 'load'
    """
    if not isinstance(text, str) or not text.strip():
        raise InputError("needs an expression, as text", where=where, value=text)
    if len(text) > LONGEST:
        raise InputError(f"has {len(text)} characters; an expression has at most {LONGEST}", where=where)
    return Expression(text.strip(), _Reader(text, names, where).whole())


class _Reader:
    """Reader of one text, from left to right; each method reads a part of the grammar."""

    def __init__(self, text: str, names: Collection[str] | None, where: str) -> None:
        self.text, self.names, self.where, self.at, self.depth = text, names, where, 0, 0

    def whole(self) -> Node:
        tree = self._sides(0)
        if self._next():
            raise self._unexpected("an operator is missing before it")
        return tree

    def _sides(self, level: int) -> Node:
        """A chain of operators of one level, grouped from the left."""
        if level == len(_LEVELS):
            return self._signed()
        tree = self._sides(level + 1)
        while self._next() in _LEVELS[level] and self._next():
            operator = self._take()
            tree = Call(operator, (tree, self._sides(level + 1)))
        return tree

    def _signed(self) -> Node:
        """A power, with any number of signs before it."""
        self._deeper()
        sign = self._take() if self._next() in ("+", "-") and self._next() else ""
        tree = self._signed() if sign else self._power()
        self.depth -= 1
        return Call("negative", (tree,)) if sign == "-" else tree

    def _power(self) -> Node:
        base = self._atom()
        if self._next() != "^":
            return base
        self._take()
        return Call("^", (base, self._signed()))

    def _atom(self) -> Node:
        if self._next() == "(":
            self._take()
            tree = self._sides(0)
            self._close()
            return tree
        if number := _NUMBER.match(self.text, self._blank()):
            return self._number(number)
        if name := _NAME.match(self.text, self.at):
            return self._named(name)
        raise self._unexpected("a number, a name or a bracket is missing here")

    def _named(self, found: re.Match[str]) -> Node:
        """A quantity or a function with its arguments."""
        start, name = self.at, found[0]
        self.at = found.end()
        if self._next() == "(":
            if name not in FUNCTIONS:
                raise self._error(f"no such function; {nearest(name, FUNCTIONS)}", start, name)
            return Call(name, self._arguments(name, start))
        if name in FUNCTIONS:
            raise self._error("is a function and needs its argument in brackets", start, name)
        if self.names is not None and name not in self.names:
            hint = nearest(name, self.names) if self.names else "it may read none"
            raise self._error(f"no such quantity or parameter; {hint}", start, name)
        return Name(name)

    def _arguments(self, name: str, start: int) -> tuple[Node, ...]:
        self._take()
        found = [self._sides(0)]
        while self._next() == ",":
            self._take()
            found.append(self._sides(0))
        self._close()
        several = name in ("min", "max")
        if several != (len(found) > 1):
            raise self._error(f"takes {'two numbers or more' if several else 'one number'}", start, name)
        return tuple(found)

    def _number(self, found: re.Match[str]) -> Number:
        """A number, converted to SI if a unit is behind it."""
        start, value = self.at, float(found[0])
        self.at = found.end()
        text = found[0]
        if unit := _UNIT.match(self.text, self.at):
            self._refuse_names(unit, start)
            factor, added = self._si(unit[1], start)
            self.at, text = unit.end(), f"{text} {unit[1]}"
            value = factor * value + added
            if self.text.startswith("/", self.at):
                raise self._error(f"a slash right behind a unit must be clear: write ({text})/...", start, text)
            if self._next() == "^":
                raise self._error(f"a power behind a unit must be clear: write ({text})^...", start, text)
        if not isfinite(value):
            raise self._error("must be a finite number", start, text)
        return Number(value, text)

    def _refuse_names(self, unit: re.Match[str], start: int) -> None:
        """Refuse a unit in which a name of the expression stands, as N/s where s is a parameter."""
        words = re.findall(_WORD, unit[1])
        for word in words[1:]:
            if self.names is not None and word in self.names:
                number = f"{self.text[start : unit.start(1)].strip()} {words[0]}"
                rule = f"{word} is a unit and a name here: write ({number}) before the slash, or rename {word}"
                raise self._error(rule, start, self.text[start : unit.end()])

    def _si(self, unit: str, start: int) -> tuple[float, float]:
        """Factor and offset to SI; scales of temperature have their zero."""
        try:
            return to_si(unit)
        except KeyError:
            rule = "no such unit; an operator stands before a name, and a number before / in brackets with its unit"
            raise self._error(rule, start, unit) from None

    def _blank(self) -> int:
        while self.at < len(self.text) and self.text[self.at].isspace():
            self.at += 1
        return self.at

    def _next(self) -> str:
        """The next sign, behind blanks; empty at the end. Both ways to write a power give ``^``."""
        sign = self.text[self._blank() :][:2]
        return "^" if sign == "**" else sign[:1]

    def _take(self) -> str:
        sign = self._next()
        self.at += 2 if self.text.startswith("**", self.at) else 1
        return sign

    def _close(self) -> None:
        if self._next() != ")":
            raise self._unexpected("a bracket is not closed before it")
        self._take()

    def _deeper(self) -> None:
        self.depth += 1
        if self.depth > DEEPEST:
            raise self._error(f"more than {DEEPEST} brackets, powers and signs inside each other", self.at, None)

    def _unexpected(self, rule: str) -> InputError:
        """Error at the next sign, or at the end of the text."""
        rest = self.text[self._blank() :]
        if not rest:
            return InputError("ends too early: a number, a name or a bracket is missing", where=self.where)
        found = _NAME.match(rest)
        allowed = "arithmetic, powers, " + ", ".join(FUNCTIONS)
        known = rest[0] in "+-*/^(),." or rest[0].isalnum()
        return self._error(
            rule if known else f"is not read; allowed: {allowed}", self.at, found[0] if found else rest[0]
        )

    def _error(self, rule: str, at: int, value: str | None) -> InputError:
        return InputError(rule, where=f"{self.where}, character {at + 1}", value=value)
