"""Import of instrument files into a case folder, with questions for missing facts or an error that lists them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case.import_file import NAME
from mixedlub.data_checks.case_check import refuse_unreadable
from mixedlub.importers import plain
from mixedlub.importers.attachments import is_share, with_attachments, with_share
from mixedlub.importers.base import (
    EVERY,
    SHEET,
    Answers,
    Draft,
    Question,
    Unanswered,
    flat,
    listed,
    open_questions,
    read_note,
    refuse_wrong,
)
from mixedlub.importers.case_writer import findings_toml, write_case
from mixedlub.importers.dialogue import Ask, Say, ask_all, is_likely, likely_answer, parse_setting, value_of
from mixedlub.importers.input_file import InputFile, open_file
from mixedlub.importers.missing_inputs import Gap, gap_lines, gaps, undescribed
from mixedlub.importers.text_table import joined_runs
from mixedlub.importers.time_base import TIME, joined_times
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.discovery import loaded
from mixedlub.schema.findings import Finding, Severity, finding, of_severity, report
from profiles.errors import InputError, nearest

RAW_FROM = 2000
"""Readings in time at which a recording is raw rather than averaged."""
NAMES_SHOWN = 4
"""Most different names of a column listed in the summary."""

Step = Callable[[str], None]
"""Callback at the start of a task with its name, and at the end with an empty text."""

STEPS = ("reading files", "reading tables", "writing the case", "checking the case")

SCHEMA = "mixedlub-case/1"


def read(files: Sequence[InputFile], answers: Answers) -> Draft:
    """Joint draft of all files, which must be of the same kind with the same columns."""
    if not files:
        raise InputError("name at least one file", where="import")
    drafts = [_read_one(file, answers) for file in files]
    first = drafts[0]
    for file, other in zip(files[1:], drafts[1:], strict=True):
        if (other.kind, other.quantity, set(other.columns)) != (first.kind, first.quantity, set(first.columns)):
            raise InputError("holds other columns than the first file; import it by itself", where=file.name)
    columns = {name: np.concatenate([d.columns[name] for d in drafts]) for name in first.columns}
    restarted: list[Finding] = []
    if TIME in columns:
        times = [(file.name, d.columns[TIME]) for file, d in zip(files, drafts, strict=True)]
        columns[TIME], restarted = joined_times(times)
    questions = {q.key: q for d in drafts for q in d.questions}
    runs, renumbered = joined_runs([(file.name, d.runs) for file, d in zip(files, drafts, strict=True)])
    file_notes = [note for file in files for note in file.notes]
    notes = [
        *file_notes,
        *(note for d in drafts for note in d.notes),
        *restarted,
        *([read_note(renumbered)] if renumbered else []),
    ]
    return Draft(
        first.kind,
        first.quantity,
        columns,
        first.system,
        tuple(questions.values()),
        tuple(notes),
        runs,
    )


def _read_one(file: InputFile, answers: Answers) -> Draft:
    # Readers of other packages come first; what none takes is read as a plain table.
    readers = [] if file.measured else reversed(loaded("mixedlub.importers.instruments", "mixedlub.importers"))
    reader = next((one for one in readers if one.matches(file.text)), plain)
    draft: Draft = reader.draft(file, answers)
    return draft


def import_files(files: Sequence[Path], out: Path, *, overwrite: bool = False, **answers: Any) -> Path:
    """Write a case folder from instrument files; ``answers``: tables or dotted keys as in system.toml.

    Missing answers are an error that lists them; nothing is guessed. An existing case with differences is an error too,
    unless ``overwrite`` is true.
    """
    opened, given = _opened(files, flat(answers))
    draft = whole_round(opened, given)
    missing = open_questions(draft, given)
    if missing:
        raise Unanswered(missing)
    folder, _ = _write(draft, given, out, overwrite, _folders(None, files, out))
    for note in _warnings(draft):
        report(note)
    return folder


def drafted(files: Sequence[Path], answers: Answers) -> tuple[Draft, dict[str, Any], list[Question]]:
    """Draft of a case before it is written, its answers with every likely one taken, and the questions of these."""
    opened, given = _opened(files, flat(answers))
    for key, value in given.items():
        refuse_wrong(key, value)
    draft = read(opened, given)
    taken: list[Question] = []
    while likely := [q for q in draft.questions if q.offered and q.key not in given]:
        taken.append(likely[0])
        given[likely[0].key] = value_of(likely[0].example)
        draft = read(opened, given)
    return draft, given, taken


def first_rows(files: Sequence[Path], answers: Answers, count: int) -> tuple[list[str], list[list[str]]]:
    """Headers and first rows of the table in the first file, as the instrument wrote them."""
    opened, _ = _opened(files[:1], answers)
    cells = opened[0].table().cells if opened else {}
    return list(cells), [list(map(str, row)) for row in islice(zip(*cells.values()), count)]


def missing_inputs(draft: Draft, answers: Answers, folders: Sequence[Path] = ()) -> tuple[Gap, ...]:
    """Inputs of the rig that the answers to a draft without open questions leave out."""
    given, _ = with_attachments(answers, folders)
    return gaps(_checked(draft, given), draft.columns)


def run(
    files: Sequence[Path],
    out: Path,
    settings: Sequence[str] = (),
    answers_file: Path | None = None,
    ask: Ask | None = None,
    say: Say = print,
    overwrite: bool = False,
    step: Step = lambda doing: None,
) -> Path:
    """Run the import command: first settings ``KEY=VALUE`` and a TOML file, then ``ask`` for missing answers.

    Without ``ask``, missing answers are an error that lists them. ``step`` is called at the start of each of the STEPS,
    and with an empty text before a question.
    """
    answers = flat(toml_file.read_toml(answers_file)) if answers_file is not None else {}
    answers.update(parse_setting(s) for s in settings)
    step(STEPS[0])
    opened, answers = _opened(files, answers)
    if ask is not None and not overwrite and (out / "system.toml").exists():
        say(f"{out} is a case already; it is kept where it differs (--overwrite replaces it)")
    step(STEPS[1])
    draft = whole_round(opened, answers)
    step("")
    if ask is not None:
        answers, draft = _with_replies(opened, answers, draft, ask, say)
    missing = open_questions(draft, answers)
    if missing:
        raise Unanswered(missing)
    if ask is not None:
        for line in _summary(draft, answers):
            say(line)
        if ask(f"Write this case to {out} (Enter writes it, n stops): ").strip().lower().startswith("n"):
            raise InputError("stopped before writing; nothing was changed", where=str(out))
    folder, refusal = _write(draft, answers, out, overwrite, _folders(answers_file, files, out), step)
    step("")
    for note in draft.notes:
        say(_line(note))
    for hint in _hints(draft, answers):
        say(hint)
    if refusal:
        say(_line(finding("case_refused", f"diagnose cannot use this case as it is: {refusal}")))
    say(f"{folder}: a case of kind {draft.kind} that records {draft.quantity}")
    system = toml_file.parse(system_file.System, toml_file.read_toml(folder / "system.toml"), "system.toml")
    for line in gap_lines(gaps(system, draft.columns), str(folder / "system.toml"), system):
        say(line)
    return folder


def _line(note: Finding) -> str:
    """Finding as printed by the command: without severity for a note."""
    return str(note) if note.severity is Severity.NOTE else f"{note.severity}: {note}"


def _warnings(draft: Draft) -> tuple[Finding, ...]:
    """Findings on lost or doubtful readings, which are kept for `check` and `diagnose`."""
    return of_severity(draft.notes, Severity.CAUTION, Severity.DOUBT)


def _opened(files: Sequence[Path], answers: Answers) -> tuple[list[InputFile], dict[str, Any]]:
    """Files of readings, and answers with a table of load shares among the files."""
    opened = [(path, open_file(path, answers)) for path in files]
    shares = [path for path, file in opened if is_share(file.text)]
    if SHEET in answers and not any(file.is_workbook for _, file in opened):
        raise InputError(
            "none of the files has several tables (.xlsx, .tdms, .mat, .mf4)", where=SHEET, value=answers[SHEET]
        )
    return [file for path, file in opened if path not in shares], with_share(answers, shares)


def whole_round(files: Sequence[InputFile], answers: Answers) -> Draft:
    """Draft with the questions that follow from the proposed answers too, so that all are asked at once."""
    draft = read(files, answers)
    questions = {q.key: q for q in draft.questions}
    supposed = dict(answers)
    while fresh := {q.key: likely_answer(q) for q in questions.values() if q.key not in supposed and is_likely(q)}:
        supposed |= fresh
        try:
            further = read(files, supposed).questions
        except InputError:
            # A proposal that does not hold with the others is for the user to change.
            break
        questions = {**{q.key: q for q in further}, **questions}
    return replace(draft, questions=tuple(questions.values()))


def _with_replies(
    files: Sequence[InputFile], answers: dict[str, Any], draft: Draft, ask: Ask, say: Say
) -> tuple[dict[str, Any], Draft]:
    """Answers and draft after all questions were asked together; a question with a refused answer is asked again."""
    asked: set[str] = set()
    refused: dict[str, Mapping[str, Any]] = {}
    while waiting := [q for q in draft.questions if q.key not in answers and q.key not in asked]:
        ordered = sorted(waiting, key=lambda q: not q.needed)
        replies = ask_all(ordered, ask, say)
        asked |= {q.key for q in ordered}
        every = {**answers, **{key: value for reply in replies.values() for key, value in reply.items()}}
        try:
            answers, draft = every, _accepted(files, answers, every)
        except InputError:
            for question in (q for q in ordered if q.key in replies):
                try:
                    extended = {**answers, **replies[question.key]}
                    answers, draft = extended, _accepted(files, answers, extended)
                except InputError as error:
                    _say_refused(error, question, replies[question.key], refused, say)
                    asked.discard(question.key)
    return answers, draft


def _accepted(files: Sequence[InputFile], answers: Answers, extended: Answers) -> Draft:
    """Draft with more answers, which are valid."""
    for key in extended.keys() - answers.keys():
        refuse_wrong(key, extended[key])
    return whole_round(files, extended)


def _say_refused(
    error: InputError, question: Question, reply: Answers, refused: dict[str, Mapping[str, Any]], say: Say
) -> None:
    """Say why an answer is refused; raise an error of the file, which no answer changes."""
    if refused.get(str(error), reply) != reply:
        raise error
    if not question.key.startswith("import.") and error.where != question.key:
        raise error
    refused[str(error)] = reply
    say(str(error))
    if question.one_value and question.key in reply:
        say(f"if all rows have the same value, reply N=={reply[question.key]}")


def _summary(draft: Draft, answers: Answers) -> Iterator[str]:
    """Lines with kind, rows and ranges of the case to be written, and settings for open questions."""
    rows = len(next(iter(draft.columns.values())))
    yield f"{draft.kind}: {rows} rows, reading {draft.quantity}"
    width = max(map(len, draft.columns))
    for name, values in draft.columns.items():
        yield f"  {name:{width}}  {range_of_column(values)}"
    left = [q for q in draft.questions if q.key not in answers]
    if left:
        yield "left open, each may be given later:"
        yield from listed(left)


def range_of_column(values: np.ndarray) -> str:
    """Range of a numeric column, or its names.

    >>> range_of_column(np.array([50.0, 100.5, np.nan])), range_of_column(np.array(["a", "b", "a"]))
    ('50 to 100.5', 'a, b')
    """
    if values.dtype.kind not in "fiu":
        names = list(dict.fromkeys(values.tolist()))
        return ", ".join(map(str, names[:NAMES_SHOWN])) + (", ..." if len(names) > NAMES_SHOWN else "")
    known = values[np.isfinite(values)]
    return f"{known.min():g} to {known.max():g}" if known.size else "empty"


def _folders(answers_file: Path | None, files: Sequence[Path], out: Path) -> list[Path]:
    """Folders to search for files named in the answers."""
    beside = [path.parent for path in (*([answers_file] if answers_file else []), *files)]
    return list(dict.fromkeys([*beside, Path(), out]))


def _hints(draft: Draft, answers: Answers) -> list[str]:
    rows = len(next(iter(draft.columns.values())))
    if rows < RAW_FROM or "time_s" not in draft.columns or EVERY.key in answers:
        return []
    return [
        f"{rows} readings in time: --set {EVERY.key}=10 would keep one of ten; a start-up is cut off and readings are "
        "averaged in the file before it is imported (see `mixedlub import --help`)"
    ]


def _write(
    draft: Draft,
    answers: Answers,
    out: Path,
    overwrite: bool,
    folders: Sequence[Path],
    step: Step = lambda doing: None,
) -> tuple[Path, str]:
    """Write the case folder; return it, and the reason if diagnose would reject a case that check reads."""
    step(STEPS[2])
    given, files = with_attachments(answers, folders)
    system = _system(draft, given)
    checked = _checked(draft, given)
    every = answers.get(EVERY.key, 1)
    refuse_wrong(EVERY.key, every)
    columns = {name: values[::every] for name, values in draft.columns.items()}
    check = checked.recording.check
    if check is not None and check not in columns:
        raise InputError("is no column that is taken from these files", where="recording.check", value=check)
    open_gaps = gaps(checked, columns)
    not_described = undescribed(checked, columns)
    if checked.surfaces and not_described:
        rule = f"is named in the readings and not described; {nearest(not_described[0], checked.surfaces)}"
        raise InputError(rule, where="surfaces", value=not_described[0])
    numbered = columns if draft.runs is None else {"run": draft.runs[::every], **columns}
    comments = {gap.table: tuple(gap.comments()) for gap in open_gaps}
    complete = not any(gap.required for gap in open_gaps)
    refusals: list[str] = []

    def read_back(folder: Path) -> None:
        step(STEPS[3])
        refusals.append(refuse_unreadable(folder, checked, complete, out))

    warnings = _warnings(draft)
    if warnings or (out / NAME).exists():
        files[NAME] = findings_toml(warnings).encode()
    write_case(out, system, numbered, overwrite=overwrite, comments=comments, attachments=files, check=read_back)
    return out, "".join(refusals)


def _system(draft: Draft, given: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of system.toml: the facts of the draft, and the answers, which take precedence."""
    system: dict[str, Any] = {"kind": draft.kind, **given}
    for section, facts in draft.system.items():
        system[section] = {**facts, **system.get(section, {})}
    system["recording"] = {"quantity": draft.quantity, **system.get("recording", {})}
    return system


def _checked(draft: Draft, given: Mapping[str, Any]) -> system_file.System:
    return toml_file.parse(system_file.System, {"schema": SCHEMA, **_system(draft, given)}, "answers")
