"""Instrument files into a case folder: what the files do not say is asked, or listed where nobody can answer."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from mixedlub import config
from mixedlub.importers import pcs, plain, trios
from mixedlub.importers.draft import Draft, Question, Unanswered, flat, nested, open_questions
from mixedlub.importers.needs import gaps, told
from mixedlub.importers.write import write_case
from profiles.errors import InputError

READERS: tuple[ModuleType, ...] = (pcs, trios, plain)
"""Tried in this order; plain tables last because any text matches."""

SCHEMA = "mixedlub-case/1"


def read(files: Sequence[Path], answers: Mapping[str, Any]) -> Draft:
    """What the files say together; files of one case must be of the same kind and hold the same columns."""
    if not files:
        raise InputError("name at least one file", where="import")
    drafts = [_read_one(path, answers) for path in files]
    first = drafts[0]
    for path, other in zip(files[1:], drafts[1:], strict=True):
        if (other.kind, other.quantity, set(other.columns)) != (first.kind, first.quantity, set(first.columns)):
            raise InputError("holds other columns than the first file; import it by itself", where=path.name)
    columns = {name: np.concatenate([d.columns[name] for d in drafts]) for name in first.columns}
    questions = {q.key: q for d in drafts for q in d.questions}
    return Draft(
        first.kind,
        first.quantity,
        columns,
        first.system,
        tuple(questions.values()),
        tuple(note for d in drafts for note in d.notes),
    )


def _read_one(path: Path, answers: Mapping[str, Any]) -> Draft:
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise InputError("no such file", where=str(path)) from None
    except OSError as error:
        raise InputError(f"cannot be read ({error})", where=str(path)) from None
    if b"\0" in raw[:4096]:
        raise InputError("is not a text file; export it as text first", where=path.name)
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    reader = next(r for r in READERS if r.matches(text))
    found: Draft = reader.draft(text, path.name, answers)
    return found


def import_files(files: Sequence[Path], out: Path, *, overwrite: bool = False, **answers: Any) -> Path:
    """A case folder from instrument files; ``answers`` are tables or dotted keys as in system.toml.

    What is needed and not answered is an error that lists it; nothing is guessed. A case that is there and
    differs is an error too, unless ``overwrite`` is said.
    """
    given = flat(answers)
    draft = read(files, given)
    missing = open_questions(draft, given)
    if missing:
        raise Unanswered(missing)
    return _write(draft, given, out, overwrite)


def run(
    files: Sequence[Path],
    out: Path,
    settings: Sequence[str] = (),
    answers_file: Path | None = None,
    ask: Callable[[str], str] | None = None,
    say: Callable[[str], None] = print,
    overwrite: bool = False,
) -> Path:
    """The import command: settings ``KEY=VALUE`` and a TOML file first, then ``ask`` for what is missing.

    ``ask`` is None where nobody is there to answer; then missing answers are an error that lists them.
    """
    answers = flat(config.read_toml(answers_file)) if answers_file is not None else {}
    answers.update(parse_setting(s) for s in settings)
    asked: set[str] = set()
    if ask is not None and not overwrite and (out / "system.toml").exists():
        say(f"{out} is a case already; it is left as it is where it differs (--overwrite replaces it)")
    while True:
        draft = read(files, answers)
        waiting = [q for q in draft.questions if q.key not in answers and q.key not in asked]
        if ask is None or not waiting:
            break
        question = next((q for q in waiting if q.needed), waiting[0])
        asked.add(question.key)
        found = _ask(question, ask, say)
        if found is not None:
            answers[question.key] = found
    missing = open_questions(draft, answers)
    if missing:
        raise Unanswered(missing)
    folder = _write(draft, answers, out, overwrite)
    for note in draft.notes:
        say(note)
    say(f"{folder}: a case of kind {draft.kind} that records {draft.quantity}")
    system = config.parse(config.System, config.read_toml(folder / "system.toml"), "system.toml")
    for line in told(gaps(system, draft.columns), str(folder / "system.toml")):
        say(line)
    return folder


def parse_setting(text: str) -> tuple[str, Any]:
    """``KEY=VALUE`` with a TOML value; a bare word is taken as text.

    >>> parse_setting("contact.radius_mm=[9.525, inf]"), parse_setting("kind=film")
    (('contact.radius_mm', [9.525, inf]), ('kind', 'film'))
    """
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise InputError("must read KEY=VALUE", where="--set", value=text)
    return key.strip(), _value(value)


def _value(text: str) -> Any:
    try:
        return tomllib.loads(f"value = {text.strip()}")["value"]
    except tomllib.TOMLDecodeError:
        return text.strip()


def _ask(question: Question, ask: Callable[[str], str], say: Callable[[str], None]) -> Any:
    """One answer, asked again while it is needed and empty; None where an optional one is left open."""
    hint = f"for example {question.example}" + ("" if question.needed else "; empty if not known")
    while True:
        words = f"{question.text}: {question.choices}" if question.choices else question.text
        reply = ask(f"{words} ({hint}): ").strip()
        if reply:
            return _value(reply)
        if not question.needed:
            return None
        say("this is needed")


def _write(draft: Draft, answers: Mapping[str, Any], out: Path, overwrite: bool) -> Path:
    system: dict[str, Any] = {"kind": draft.kind, **nested(answers)}
    for section, facts in draft.system.items():
        system[section] = {**facts, **system.get(section, {})}
    system["recording"] = {"quantity": draft.quantity, **system.get("recording", {})}
    checked = config.parse(config.System, {"schema": SCHEMA, **system}, "answers")
    every = answers.get("import.every", 1)
    if not isinstance(every, int) or every < 1:
        raise InputError("must be a whole number of at least 1", where="import.every", value=every)
    columns = {name: values[::every] for name, values in draft.columns.items()}
    comments = {gap.table: tuple(gap.comments()) for gap in gaps(checked, columns)}
    return write_case(out, system, columns, overwrite=overwrite, comments=comments)
