"""What laws of friction and of machine parts say of themselves: their docstrings and their coefficients."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mixedlub.chain.effect import entry
from profiles.errors import InputError, nearest


@dataclass(frozen=True)
class Coefficient:
    """A number of a law that its user gives; one without a default must be given."""

    name: str
    unit: str
    meaning: str
    default: float | None = None


class Documented:
    """A published law whose docstring has its meaning, its equation and its source."""

    name: str
    law: Callable[..., Any]
    coefficients: tuple[Coefficient, ...]

    @property
    def summary(self) -> str:
        """The first line of its docstring."""
        return self._text.split("\n")[0]

    @property
    def source(self) -> str:
        """The source that its docstring names."""
        found = re.search(r"Source: (.*?)(?:\n\s*\n|\Z)", self._text, re.DOTALL)
        return " ".join(found[1].split()) if found else ""

    @property
    def equation(self) -> str:
        """Its equation in TeX."""
        found = re.search(r"\.\. math::(.*?)(?:\n\s*\n|\Z)", self._text, re.DOTALL)
        return " ".join(found[1].split()) if found else ""

    @property
    def _text(self) -> str:
        return (inspect.getdoc(self.law) or "").partition(">>>")[0]

    @property
    def remarks(self) -> str:
        """What its docstring says between equation and source."""
        _, _, below = self._text.partition(".. math::")
        _, _, rest = below.partition("\n\n")
        return " ".join(rest.partition("Source: ")[0].split())

    @property
    def reads(self) -> tuple[str, ...]:
        """Quantities that the law needs."""
        return tuple(n for n, a in inspect.signature(self.law).parameters.items() if a.kind is not a.KEYWORD_ONLY)

    def _page(self, parts: Mapping[str, str]) -> str:
        """Summary, what is known of it by heading, and coefficients, as text of 80 columns."""
        facts = [entry(f"  {name}", text) for name, text in parts.items() if text]
        numbers = [entry(f"  {c.name}", described(c), 2 + max(16, len(c.name) + 2)) for c in self.coefficients]
        head = entry(f"{self.name}: ", self.summary, indent=2)
        return "\n".join([head, "", *facts, *(["", "coefficients", *numbers] if numbers else [])])

    def values(self, given: Mapping[str, float]) -> dict[str, Any]:
        """The coefficients, defaults where none are given."""
        return {c.name: given.get(c.name, c.default) for c in self.coefficients}


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


def check_given(law: Documented, given: Mapping[str, float], place: str, page: str) -> None:
    """Refuse coefficients that a law does not have, and those that it lacks; ``page`` is the command of its page."""
    known = [c.name for c in law.coefficients]
    for name in given:
        if name not in known:
            hint = nearest(name, known) if known else "it has none"
            raise InputError(f"no such coefficient of {law.name}; {hint}", where=place, value=name)
    missing = [c.name for c in law.coefficients if c.default is None and c.name not in given]
    if missing:
        rule = f"needs {few(missing)}: no source prints them; `{page}` says what they are"
        raise InputError(rule, where=place, value=dict(given) or None)
