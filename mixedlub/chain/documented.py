"""Coefficients of published laws, which their users give, and how messages and pages name them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Coefficient:
    """A number of a law that its user gives; one without a default must be given."""

    name: str
    unit: str
    meaning: str
    default: float | None = None


def described(c: Coefficient) -> str:
    """A coefficient in words."""
    unit = f" ({c.unit})" if c.unit not in ("", "-") else ""
    return f"{c.meaning}{unit}; " + ("must be given" if c.default is None else f"left out: {c.default:g}")


MOST_NAMED = 4
"""Most coefficients that a message names."""


def few(names: Sequence[str]) -> str:
    """Names in a message, the first ones of many.

    >>> few(["a", "b"]), few(list("abcdef"))
    ('a, b', 'a, b, c, d and 2 more')
    """
    others = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ", ".join(names[:MOST_NAMED]) + others
