"""Trees of expressions: numbers, names, and operators or functions of them, with values and text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any

import numpy as np

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "exp": np.exp,
    "log": np.log,
    "sqrt": np.sqrt,
    "tanh": np.tanh,
    "abs": np.abs,
    "sign": np.sign,
    "min": lambda *values: reduce(np.minimum, values),
    "max": lambda *values: reduce(np.maximum, values),
}
"""Functions of an expression; ``min`` and ``max`` take two numbers or more, the others one."""
OPERATORS: Mapping[str, tuple[Callable[..., Any], int]] = {
    "+": (np.add, 1),
    "-": (np.subtract, 1),
    "*": (np.multiply, 2),
    "/": (np.divide, 2),
    "negative": (np.negative, 3),
    "^": (np.power, 4),
}
"""Operators of an expression, and their rank: higher ranks bind first."""
ATOM = 5
"""Rank of numbers, names and functions."""


@dataclass(frozen=True)
class Number:
    """A number in SI; ``text``: as written, with its unit."""

    value: float
    text: str = ""

    def __str__(self) -> str:
        return self.text or f"{self.value:.12g}"


@dataclass(frozen=True)
class Name:
    """A named quantity or parameter."""

    name: str

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Call:
    """An operator or function of arguments.

    >>> print(Call("^", (Call("/", (Name("load"), Number(420.0, "420 N"))), Name("a"))))
    (load/420 N)^a
    """

    of: str
    arguments: tuple[Node, ...]

    def __str__(self) -> str:
        if self.of not in OPERATORS:
            return f"{self.of}({', '.join(map(str, self.arguments))})"
        rank = OPERATORS[self.of][1]
        if self.of == "negative":
            return f"-{_bracketed(self.arguments[0], rank)}"
        # The side that would otherwise be read first needs brackets at equal rank.
        left, right = (rank + 1, rank) if self.of == "^" else (rank, rank + 1)
        one, other = _bracketed(self.arguments[0], left), _bracketed(self.arguments[1], right)
        spaced = rank == 1 or (self.of == "/" and _ends_in_unit(self.arguments[0]) and not one.endswith(")"))
        return f"{one} {self.of} {other}" if spaced else f"{one}{self.of}{other}"


Node = Number | Name | Call


def _bracketed(node: Node, rank: int) -> str:
    """Text of a node, in brackets if its rank is below ``rank``."""
    if isinstance(node, Number):
        own = OPERATORS["negative"][1] if str(node).startswith("-") else 3 if " " in str(node) else ATOM
    else:
        own = OPERATORS[node.of][1] if isinstance(node, Call) and node.of in OPERATORS else ATOM
    return f"({node})" if own < rank else str(node)


def _ends_in_unit(node: Node) -> bool:
    """Whether the text ends in the unit of a number, to which a slash would belong."""
    if isinstance(node, Call):
        return node.of in OPERATORS and _ends_in_unit(node.arguments[-1])
    return isinstance(node, Number) and " " in str(node)


def names_in(node: Node) -> Iterator[str]:
    """Names of a tree, in the order of the text."""
    if isinstance(node, Name):
        yield node.name
    elif isinstance(node, Call):
        for argument in node.arguments:
            yield from names_in(argument)


def value_of(node: Node, values: Mapping[str, Any]) -> Any:
    """Value of a tree at the values of its names."""
    if isinstance(node, Number):
        return node.value
    if isinstance(node, Name):
        return values[node.name]
    function = FUNCTIONS[node.of] if node.of in FUNCTIONS else OPERATORS[node.of][0]
    return function(*(value_of(argument, values) for argument in node.arguments))


@dataclass(frozen=True)
class Expression:
    """An expression: its text and its tree.

    >>> from mixedlub.expressions import parse
    >>> power = parse("(load/420 N)^a")
    >>> power.names, float(power.evaluate({"load": 840.0, "a": 3.0}))
    (('load', 'a'), 8.0)
    """

    text: str
    tree: Node

    @classmethod
    def of(cls, tree: Node) -> Expression:
        """The expression of a tree, with the text that reads back as this tree."""
        return cls(str(tree), tree)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names that the expression reads, each once."""
        return tuple(dict.fromkeys(names_in(self.tree)))

    def evaluate(self, values: Mapping[str, Any]) -> np.ndarray:
        """Values at numbers or arrays by name, which broadcast; not finite where the expression is not."""
        with np.errstate(all="ignore"):
            own = {name: np.asarray(values[name], dtype=float) for name in self.names}
            return np.asarray(value_of(self.tree, own), dtype=float)

    def __str__(self) -> str:
        return self.text
