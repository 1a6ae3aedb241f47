"""Coefficients of published laws given by the user, and their text in messages and pages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Coefficient:
    """A coefficient of a law, given by the user; required if it has no default.

    ``usual``: range of values of nine laws in ten, over which a fit to readings looks for the coefficient.
    """

    name: str
    unit: str
    meaning: str
    default: float | None = None
    usual: tuple[float, float] | None = None


def described(c: Coefficient) -> str:
    """Meaning, unit and default of a coefficient."""
    unit = f" ({c.unit})" if c.unit not in ("", "-") else ""
    return f"{c.meaning}{unit}; " + ("must be given" if c.default is None else f"left out: {c.default:g}")


MOST_NAMED = 4
"""Most coefficients that a message names."""


def few(names: Sequence[str]) -> str:
    """First names of a list, as text for a message.

    >>> few(["a", "b"]), few(list("abcdef"))
    ('a, b', 'a, b, c, d and 2 more')
    """
    others = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ", ".join(names[:MOST_NAMED]) + others
