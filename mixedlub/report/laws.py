"""The laws a study used, taken from their docstrings: sentence, equation, source."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from mixedlub.chain.law import DISPLAY, SOURCE
from mixedlub.chain.model import Model
from mixedlub.report.equations import equation

_INLINE = re.compile(r":math:`([^`]+)`")
DISPLAY_SIZE = 20.0

_SENTENCE = re.compile(r"(?<=[.:;]) (?=[A-Z`])")


@dataclass(frozen=True)
class LawText:
    """A law for the page: its outputs, its description as HTML with typeset equations, and its source."""

    gives: str
    says: str
    source: str
    effect: str = ""


def laws_used(model: Model) -> Iterator[LawText]:
    """Steps of the chain on which the results depend, in order."""
    for step in model.steps:
        gives = ", ".join(name.replace("_", " ") for name in step.outputs)
        if step.effect is not None:
            e = next(e for e in model.effects if e.id == step.effect)
            html = _inlined(e.summary) + _displayed(e.equation)
            yield LawText(gives, html, escape(e.source), effect=e.id.replace("_", " "))
        else:
            yield law_text((inspect.getdoc(step.law) or "").partition(">>>")[0], gives)


def law_text(docstring: str, gives: str) -> LawText:
    """Parts of a docstring; sentences that contain code are left out.

    >>> law_text("Height (m). ``z`` has two axes.\\n\\nSource: A. Author, 1999.", "height")
    LawText(gives='height', says='Height (m).', source='A. Author, 1999.', effect='')
    """
    source = SOURCE.search(docstring)
    parts = DISPLAY.split(SOURCE.sub("", docstring))
    says = "".join(_displayed(part) if i % 2 else _inlined(_for_readers(part)) for i, part in enumerate(parts))
    return LawText(gives, says, escape(" ".join(source[1].split())) if source else "")


def _displayed(tex: str) -> str:
    return f'<div class="display">{equation(" ".join(tex.split()), DISPLAY_SIZE)}</div>'


def _for_readers(text: str) -> str:
    """The sentences without code in backquotes, which is for programmers."""
    sentences = _SENTENCE.split(" ".join(text.split()))
    return " ".join(s for s in sentences if "`" not in _INLINE.sub("", s))


def _inlined(text: str) -> str:
    """Escaped text with typeset inline formulas."""
    parts = _INLINE.split(text)
    return "".join(equation(part) if i % 2 else escape(part) for i, part in enumerate(parts))
