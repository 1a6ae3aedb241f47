"""Dialogue at a terminal: all questions of an import together, help, and interpretation of replies."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from mixedlub.importers.answer_keys import UNKNOWN_HEADER, UNKNOWN_UNIT, VALUES
from mixedlub.importers.base import Answers, Question, is_list, listed
from mixedlub.report.format_reference import about
from profiles.errors import InputError

Ask = Callable[[str], str]
Say = Callable[[str], None]
PROMPT = "answers, such as {example} (N? explains; Enter takes the proposals): "
LETTERS = "abcdefghijklmnopqrstuvwxyz"
CHOSEN = re.compile(r"(\d+)([a-z])")
TOLD = re.compile(r"(\d+)\s*=(.*)", re.DOTALL)
PARTS = re.compile(r"""(?:"[^"]*"|'[^']*'|[^;"'])+""")
"""Replies between semicolons outside quotes."""


def parse_setting(text: str) -> tuple[str, Any]:
    """Key and value of ``KEY=VALUE`` with a TOML value; a bare word is text.

    >>> parse_setting("contact.radius_mm=[9.525, inf]"), parse_setting("kind=film")
    (('contact.radius_mm', [9.525, inf]), ('kind', 'film'))
    """
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise InputError("must read KEY=VALUE", where="--set", value=text)
    return key.strip(), value_of(value)


def is_likely(question: Question) -> bool:
    """Whether a needed question has a proposal, or an example that is probable."""
    return question.needed and not question.placeholder and question.example not in (UNKNOWN_HEADER, UNKNOWN_UNIT)


def likely_answer(question: Question) -> Any:
    """Proposed or probable answer."""
    return value_of(question.example)


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


def ask_all(questions: Sequence[Question], ask: Ask, say: Say) -> dict[str, Answers]:
    """Answers to questions asked together, by the key of the question; a question left open has none.

    An empty reply takes the proposals. Needed questions without a proposal are named again once.
    """
    for line in form(questions):
        say(line)
    replies: dict[str, Answers] = {}
    was_empty = False
    while True:
        reply = ask(PROMPT.format(example=_example(questions))).strip()
        for part in PARTS.findall(reply):
            _read_part(part.strip(), questions, replies, say)
        open_ = [str(n) for n, q in enumerate(questions, start=1) if _stays_open(q) and q.key not in replies]
        if (not open_ and not reply.endswith("?")) or (not reply and was_empty):
            break
        was_empty = not reply
        if open_ and not reply.endswith("?"):
            again = "Enter again leaves them open, and then no case is written"
            say(f"needed: {', '.join(open_)}" + (f"; {again}" if was_empty else ""))
    proposed = {q.key: {q.key: value_of(q.example)} for q in questions if q.needed and q.offered}
    return {**proposed, **replies}


def form(questions: Sequence[Question]) -> Iterator[str]:
    """Lines with all questions by number, each with its choices by letter and the effect of an empty reply.

    >>> print(*form([Question("kind", "Kind", '"film"', options=("disc", "film"), offered=True)]), sep="\\n")
    1 question before anything is written; answer by NUMBER=ANSWER, or by number and letter of a choice
      1  Kind (Enter takes "film")
           1a disc, 1b film
    """
    count = f"{len(questions)} question" + ("s" if len(questions) > 1 else "")
    several = ", several separated by ';'" if len(questions) > 1 else ""
    yield f"{count} before anything is written; answer by NUMBER=ANSWER, or by number and letter of a choice{several}"
    for number, question in enumerate(questions, start=1):
        hint = _hint(question)
        yield f"{number:3}  {question.text}" + (f" ({hint})" if hint else "")
        if question.options:
            shown = ", ".join(f"{number}{letter} {o}" for letter, o in zip(LETTERS, question.options, strict=False))
            rest = ", ".join(question.options[len(LETTERS) :])
            yield f"       {shown}" + (f", or {rest}" if rest else "")


def _example(questions: Sequence[Question]) -> str:
    chosen = next((f"{n}a" for n, q in enumerate(questions, start=1) if q.options), "")
    told = next((f"{n}={q.example}" for n, q in enumerate(questions, start=1) if not q.options), "")
    return "; ".join(filter(None, (chosen, told)))


def _stays_open(question: Question) -> bool:
    """Whether an empty reply leaves a needed question open."""
    return question.needed and not question.offered


def _read_part(part: str, questions: Sequence[Question], replies: dict[str, Answers], say: Say) -> None:
    """Take one reply: choices by letter, an answer to a numbered question, or a wish for help."""
    letters = [CHOSEN.fullmatch(word) for word in part.split()]
    told = TOLD.fullmatch(part)
    if part.rstrip("?").isdecimal() and part.endswith("?") and 1 <= int(part.rstrip("?")) <= len(questions):
        for line in _help(questions[int(part.rstrip("?")) - 1]):
            say(line)
    elif part in ("?", "help"):
        for question in questions:
            for line in _help(question):
                say(line)
    elif letters and all(letters):
        for match in filter(None, letters):
            number, place = int(match[1]), LETTERS.index(match[2])
            if not 1 <= number <= len(questions) or place >= len(questions[number - 1].options):
                say(f"{match[0]}: no such choice")
            else:
                question = questions[number - 1]
                replies[question.key] = {question.key: question.options[place]}
    elif told and 1 <= int(told[1]) <= len(questions):
        _told(questions[int(told[1]) - 1], told[2].strip(), replies, say)
    elif len(questions) == 1 and not told:
        choices = dict(zip(LETTERS, questions[0].options, strict=False))
        _told(questions[0], part if part in questions[0].options else choices.get(part, part), replies, say)
    else:
        say(f"{part!r}: say NUMBER=ANSWER with a number from 1 to {len(questions)}")


def _told(question: Question, reply: str, replies: dict[str, Answers], say: Say) -> None:
    """Take an answer in words: a value, or one value for all rows."""
    if reply in ("=", VALUES, question.one_value) and question.one_value:
        say("one value for all rows is written as NUMBER==VALUE")
    elif reply.startswith("=") and question.one_value:
        replies[question.key] = {question.one_value: value_of(reply[1:])}
    elif reply.startswith(VALUES) and "=" in reply:
        replies[question.key] = dict([parse_setting(reply)])
    elif reply:
        replies[question.key] = {question.key: value_of(reply, question.example)}


def _hint(question: Question) -> str:
    """Effect of an empty reply, example, and syntax of one value for all rows.

    >>> _hint(Question("import.columns.load_N", "Header", UNKNOWN_HEADER, one_value="import.values.load_N"))
    'needed; ==VALUE if all rows have the same'
    """
    is_example = question.example not in (UNKNOWN_HEADER, UNKNOWN_UNIT)
    parts = (
        "needed" if _stays_open(question) else "",
        f"Enter takes {question.example}" if question.offered else "",
        f"for example {question.example}" if is_example and not question.offered and not question.options else "",
        "" if question.needed else "may stay open",
        "==VALUE if all rows have the same" if question.one_value else "",
    )
    return "; ".join(filter(None, parts))


def _help(question: Question) -> Iterator[str]:
    """Help on a question: meaning, kinds in words, and the setting for its answer."""
    yield question.meaning or question.text
    if question.key == "kind":
        yield from (f"  {about(kind)}" for kind in question.options)
        yield "  (columns and keys of each: mixedlub kinds KIND)"
    if question.one_value:
        yield "  ==VALUE  one value for all rows, for example ==" + ("ground" if "surface" in question.key else "40")
    yield "the same answer on the command line:"
    yield from listed([question])
