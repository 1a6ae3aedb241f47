"""The laws a study used, told from their own docstrings: sentence, equation, source."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from mixedlub.chain.model import Model
from mixedlub.effects import find
from mixedlub.report.equations import equation

_INLINE = re.compile(r":math:`([^`]+)`")
_DISPLAY = re.compile(r"\.\. math::(.*?)(?:\n\s*\n|\Z)", re.DOTALL)
DISPLAY_SIZE = 20.0

_SENTENCE = re.compile(r"(?<=[.:;]) (?=[A-Z`])")
_SOURCE = re.compile(r"Source: (.*?)(?:\n\s*\n|\Z)", re.DOTALL)


@dataclass(frozen=True)
class Told:
    """A law in words: what it gives, HTML of what it says with its equations set, its source."""

    gives: str
    says: str
    source: str
    effect: str = ""


def laws_used(model: Model) -> Iterator[Told]:
    """Every step of the chain that the results depend on, in order."""
    for step in model.steps:
        gives = ", ".join(name.replace("_", " ") for name in step.outputs)
        if step.effect is not None:
            (e,) = find([step.effect])
            said = _inlined(e.summary) + _displayed(e.equation)
            yield Told(gives, said, escape(e.source), effect=e.id.replace("_", " "))
        else:
            yield told((inspect.getdoc(step.law) or "").partition(">>>")[0], gives)


def told(docstring: str, gives: str) -> Told:
    """A docstring taken apart; its sentences on names of the program are left out.

    >>> told("Height (m). ``z`` has two axes.\\n\\nSource: A. Author, 1999.", "height")
    Told(gives='height', says='Height (m).', source='A. Author, 1999.', effect='')
    """
    source = _SOURCE.search(docstring)
    parts = _DISPLAY.split(_SOURCE.sub("", docstring))
    says = "".join(_displayed(part) if i % 2 else _inlined(_for_readers(part)) for i, part in enumerate(parts))
    return Told(gives, says, escape(" ".join(source[1].split())) if source else "")


def _displayed(tex: str) -> str:
    return f'<div class="display">{equation(" ".join(tex.split()), DISPLAY_SIZE)}</div>'


def _for_readers(text: str) -> str:
    """Sentences without code in backquotes, which is there for programmers."""
    sentences = _SENTENCE.split(" ".join(text.split()))
    return " ".join(s for s in sentences if "`" not in _INLINE.sub("", s))


def _inlined(text: str) -> str:
    """Escaped text with its inline formulas set."""
    parts = _INLINE.split(text)
    return "".join(equation(part) if i % 2 else escape(part) for i, part in enumerate(parts))
