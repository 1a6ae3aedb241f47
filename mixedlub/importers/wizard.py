"""Instrument files into a case folder: what the files do not say is asked, or listed where nobody can answer."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from mixedlub.case.import_file import NAME
from mixedlub.importers import pcs, plain, trios
from mixedlub.importers.carried import carried, is_share, with_share
from mixedlub.importers.checked import is_list, refuse_wrong
from mixedlub.importers.clock import follow
from mixedlub.importers.constant import VALUES
from mixedlub.importers.draft import EVERY, Draft, Question, Unanswered, flat, open_questions, read_note
from mixedlub.importers.needs import gaps, told, undescribed
from mixedlub.importers.pace import TIME
from mixedlub.importers.readable import refuse_unreadable
from mixedlub.importers.runs import together
from mixedlub.importers.write import findings_toml, write_case
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.findings import Finding, Severity, finding, of_severity, report
from mixedlub.schema.table import with_hyphens
from profiles.errors import InputError, nearest
from profiles.readers.numbers import decoded

MANY = 2000
"""Readings in time from which a recording is raw rather than averaged."""

Say = Callable[[str], None]

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
    restarted: list[Finding] = []
    if TIME in columns:
        columns[TIME], restarted = follow([(path.name, d.columns[TIME]) for path, d in zip(files, drafts, strict=True)])
    questions = {q.key: q for d in drafts for q in d.questions}
    runs, anew = together([(path.name, d.runs) for path, d in zip(files, drafts, strict=True)])
    notes = [*(note for d in drafts for note in d.notes), *restarted, *([read_note(anew)] if anew else [])]
    return Draft(
        first.kind,
        first.quantity,
        columns,
        first.system,
        tuple(questions.values()),
        tuple(notes),
        runs,
    )


def _read_one(path: Path, answers: Mapping[str, Any]) -> Draft:
    text = _text(path)
    reader = next(r for r in READERS if r.matches(text))
    found: Draft = reader.draft(text, path.name, answers)
    return found


def _text(path: Path) -> str:
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise InputError("no such file", where=str(path)) from None
    except IsADirectoryError:
        raise InputError("is a folder; name the files in it", where=str(path)) from None
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    text = with_hyphens(decoded(raw, path.name))
    if "\0" in text[:4096]:
        raise InputError("is not a text file; export it as text first", where=path.name)
    return text


def _apart(files: Sequence[Path]) -> tuple[list[Path], list[Path]]:
    """Files that hold readings, and tables of load shares."""
    shares = [path for path in files if is_share(_text(path))]
    return [path for path in files if path not in shares], shares


def import_files(files: Sequence[Path], out: Path, *, overwrite: bool = False, **answers: Any) -> Path:
    """A case folder from instrument files; ``answers`` are tables or dotted keys as in system.toml.

    What is needed and not answered is an error that lists it; nothing is guessed. A case that is there and
    differs is an error too, unless ``overwrite`` is said.
    """
    files, shares = _apart(files)
    given = with_share(flat(answers), shares)
    draft = read(files, given)
    missing = open_questions(draft, given)
    if missing:
        raise Unanswered(missing)
    folder, _ = _write(draft, given, out, overwrite, _folders(None, files, out))
    for note in _warnings(draft):
        report(note)
    return folder


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
    answers = flat(toml_file.read_toml(answers_file)) if answers_file is not None else {}
    answers.update(parse_setting(s) for s in settings)
    files, shares = _apart(files)
    answers = with_share(answers, shares)
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
        answers = _answered(files, answers, question, ask, say)
    missing = open_questions(draft, answers)
    if missing:
        raise Unanswered(missing)
    folder, refusal = _write(draft, answers, out, overwrite, _folders(answers_file, files, out))
    for note in draft.notes:
        say(_line(note))
    for hint in _hints(draft, answers):
        say(hint)
    if refusal:
        say(_line(finding("case_refused", f"diagnose cannot use this case as it is: {refusal}")))
    say(f"{folder}: a case of kind {draft.kind} that records {draft.quantity}")
    system = toml_file.parse(system_file.System, toml_file.read_toml(folder / "system.toml"), "system.toml")
    for line in told(gaps(system, draft.columns), str(folder / "system.toml"), system):
        say(line)
    return folder


def _line(note: Finding) -> str:
    """A finding as the command prints it; how a file was read stands without a mark."""
    return str(note) if note.severity is Severity.NOTE else f"{note.severity}: {note}"


def _warnings(draft: Draft) -> tuple[Finding, ...]:
    """What is kept for `check` and `diagnose`: readings lost or in doubt, not how the files were read."""
    return of_severity(draft.notes, Severity.CAUTION, Severity.DOUBT)


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


def _answered(
    files: Sequence[Path], answers: Mapping[str, Any], question: Question, ask: Callable[[str], str], say: Say
) -> dict[str, Any]:
    """The answers with one more, unless it is left open; a wrong one is told and asked again."""
    told: dict[str, Mapping[str, Any]] = {}
    while True:
        found = _ask(question, ask, say)
        if found is None:
            return dict(answers)
        more = {**answers, **found}
        try:
            for key, value in found.items():
                refuse_wrong(key, value)
            read(files, more)
        except InputError as error:
            # What another answer does not change is wrong in the file.
            if told.get(str(error), found) != found:
                raise
            if not question.key.startswith("import.") and error.where != question.key:
                raise
            told[str(error)] = found
            say(str(error))
        else:
            return more


def _ask(question: Question, ask: Callable[[str], str], say: Say) -> dict[str, Any] | None:
    """One answer with its key, asked again while it is needed and empty, then with the choices by number.

    None if left open; a reply that tells what all rows have has a key of its own.
    """
    hint = f"for example {question.example}" + ("" if question.needed else "; empty if not known")
    words = f"{question.text}: {question.choices}" if question.choices else question.text
    listed: tuple[str, ...] = ()
    while True:
        reply = ask(f"{words} ({hint}): ").strip()
        if reply.isdecimal() and 1 <= int(reply) <= len(listed):
            return {question.key: listed[int(reply) - 1]}
        if reply.startswith(VALUES):
            if "=" in reply:
                return dict([parse_setting(reply)])
            say(f"what all rows have is told as {VALUES}NAME=VALUE")
            continue
        if reply:
            return {question.key: _value(f"[{reply}]" if is_list(question.example, reply) else reply)}
        if not question.needed:
            return None
        listed = () if any(choice.isdecimal() for choice in question.among) else question.among
        say("this is needed" + ("; a number will do:" if listed else ""))
        for number, choice in enumerate(listed, start=1):
            say(f"  {number}  {choice}")


def _folders(answers_file: Path | None, files: Sequence[Path], out: Path) -> list[Path]:
    """Where a file that the answers name is looked for."""
    beside = [path.parent for path in (*([answers_file] if answers_file else []), *files)]
    return list(dict.fromkeys([*beside, Path(), out]))


def _hints(draft: Draft, answers: Mapping[str, Any]) -> list[str]:
    rows = len(next(iter(draft.columns.values())))
    if rows < MANY or "time_s" not in draft.columns or EVERY.key in answers:
        return []
    return [
        f"{rows} readings in time: --set {EVERY.key}=10 would keep one of ten; a start-up is cut off and readings are "
        "averaged in the file before it is imported (README, Files of instruments)"
    ]


def _write(
    draft: Draft, answers: Mapping[str, Any], out: Path, overwrite: bool, folders: Sequence[Path]
) -> tuple[Path, str]:
    """The case folder, and why diagnose would refuse it though check reads it."""
    told, files = carried(answers, folders)
    system: dict[str, Any] = {"kind": draft.kind, **told}
    for section, facts in draft.system.items():
        system[section] = {**facts, **system.get(section, {})}
    system["recording"] = {"quantity": draft.quantity, **system.get("recording", {})}
    checked = toml_file.parse(system_file.System, {"schema": SCHEMA, **system}, "answers")
    every = answers.get(EVERY.key, 1)
    refuse_wrong(EVERY.key, every)
    columns = {name: values[::every] for name, values in draft.columns.items()}
    check = checked.recording.check
    if check is not None and check not in columns:
        raise InputError("is no column that is taken from these files", where="recording.check", value=check)
    lacking = gaps(checked, columns)
    others = undescribed(checked, columns)
    if checked.surfaces and others:
        rule = f"is named in the readings and not described; {nearest(others[0], checked.surfaces)}"
        raise InputError(rule, where="surfaces", value=others[0])
    numbered = columns if draft.runs is None else {"run": draft.runs[::every], **columns}
    comments = {gap.table: tuple(gap.comments()) for gap in lacking}
    complete = not any(gap.required for gap in lacking)
    refusals: list[str] = []

    def read_back(folder: Path) -> None:
        refusals.append(refuse_unreadable(folder, checked, complete, out))

    warned = _warnings(draft)
    if warned or (out / NAME).exists():
        files[NAME] = findings_toml(warned).encode()
    write_case(out, system, numbered, overwrite=overwrite, comments=comments, carried=files, check=read_back)
    return out, "".join(refusals)
