"""Dialogue on a question at a terminal: prompt, help and interpretation of replies."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from mixedlub.importers.answer_keys import UNKNOWN_HEADER, UNKNOWN_UNIT, VALUES
from mixedlub.importers.base import Question, is_list, listed
from mixedlub.report.format_reference import about
from profiles.errors import InputError

Ask = Callable[[str], str]
Say = Callable[[str], None]


def parse_setting(text: str) -> tuple[str, Any]:
    """Key and value of ``KEY=VALUE`` with a TOML value; a bare word is text.

    >>> parse_setting("contact.radius_mm=[9.525, inf]"), parse_setting("kind=film")
    (('contact.radius_mm', [9.525, inf]), ('kind', 'film'))
    """
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise InputError("must read KEY=VALUE", where="--set", value=text)
    return key.strip(), value_of(value)


def value_of(text: str, example: str = "") -> Any:
    """Value of a reply in TOML, or as a list without brackets where the example is a list; a bare word is text.

    >>> value_of("206, 75", example="[206.0, 206.0]"), value_of("0.2"), value_of("ground")
    ([206, 75], 0.2, 'ground')
    """
    text = f"[{text}]" if is_list(example, text) else text
    try:
        return tomllib.loads(f"value = {text.strip()}")["value"]
    except ValueError:
        return text.strip()


def ask_for(question: Question, ask: Ask, say: Say) -> dict[str, Any] | None:
    """Answer to a question by key; None if it is left open.

    An empty reply to a needed question without a likely answer shows the help; a second empty reply leaves it open.
    """
    words = f"{question.text}: {question.choices}" if question.choices else question.text
    listing: tuple[str, ...] = ()
    was_empty = False
    while True:
        reply = ask(f"{words} ({_hint(question)}): ").strip()
        if not reply and not question.needed:
            return None
        if not reply and question.offered:
            return {question.key: value_of(question.example)}
        if not reply and was_empty:
            return None
        was_empty = not reply
        if was_empty:
            say("this is needed; Enter again leaves it open, and then no case is written")
        if reply in ("", "?", "help"):
            listing = _choices(question)
            for line in _help(question, listing):
                say(line)
        elif reply.isdecimal() and 1 <= int(reply) <= len(listing):
            return {question.key: listing[int(reply) - 1]}
        elif reply in ("=", VALUES, question.one_value):
            say("one value for all rows is written as =VALUE")
        elif reply.startswith("=") and question.one_value:
            return {question.one_value: value_of(reply[1:])}
        elif reply.startswith(VALUES) and "=" in reply:
            return dict([parse_setting(reply)])
        else:
            return {question.key: value_of(reply, question.example)}


def _hint(question: Question) -> str:
    """Effect of an empty reply, example, and syntax of one value for all rows.

    >>> _hint(Question("import.columns.load_N", "Header", UNKNOWN_HEADER, one_value="import.values.load_N"))
    '=VALUE if all rows have the same; ? explains'
    """
    is_example = question.example not in (UNKNOWN_HEADER, UNKNOWN_UNIT)
    parts = (
        f"Enter takes {question.example}" if question.offered else "",
        f"for example {question.example}" if is_example and not question.offered else "",
        "" if question.needed else "Enter leaves it open",
        "=VALUE if all rows have the same" if question.one_value else "",
        "? explains",
    )
    return "; ".join(filter(None, parts))


def _choices(question: Question) -> tuple[str, ...]:
    """Choices selectable by number; none if a choice is itself a number."""
    return () if any(choice.isdecimal() for choice in question.options) else question.options


def _help(question: Question, listing: Sequence[str]) -> Iterator[str]:
    """Help on a question: meaning, choices by number, and the setting for its answer."""
    if question.meaning:
        yield question.meaning
    if listing:
        yield "a number will do:"
    for number, choice in enumerate(listing, start=1):
        yield f"  {number}  {about(choice) if question.key == 'kind' else choice}"
    if question.key == "kind":
        yield "  (columns and keys of each: mixedlub kinds KIND)"
    if question.one_value:
        yield "  =VALUE  one value for all rows, for example =" + ("ground" if "surface" in question.key else "40")
    yield "the same answer on the command line:"
    yield from listed([question])
