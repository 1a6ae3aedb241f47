"""A recording before its diagnosis: questions of the importer, preview of the table, plot, and the written case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from mixedlub.importers.answer_keys import COLUMNS, UNKNOWN_HEADER, UNKNOWN_UNIT, VALUES
from mixedlub.importers.base import Question, flat, open_questions
from mixedlub.importers.dialogue import value_of
from mixedlub.importers.missing_inputs import Gap
from mixedlub.importers.wizard import drafted, first_rows, import_files, missing_inputs, range_of_column
from mixedlub.report.format_reference import about
from mixedlub.report.readings import abscissae, readings_figure
from mixedlub.report.style import as_svg
from mixedlub.schema.findings import Finding
from mixedlub.schema.gear_file import gear_names, shipped_gears
from mixedlub.schema.oil_file import oil_names, shipped_oil
from mixedlub.schema.toml_file import read_toml, toml_value
from profiles.errors import InputError

NO_PATHS = ("title", "description", "name")
"""Last parts of keys that hold free text, as the headers of columns do; every other text may be a path."""
ROWS = 8
"""Judgement. Rows of a table in the preview."""
KIND, QUANTITY = "kind", "recording.quantity"
UNSUITED = ("schema", KIND, "quantity", "base", "rig", "effects", "calibration", "missing_part", "load_sharing")
"""Keys of system.toml that belong to no form: asked elsewhere, or tables."""

Texts = Mapping[str, str]
"""Answers as typed, by key."""
Field = dict[str, Any]
"""Input of the form: key, text, example, group, whether it is needed, choices and the answer taken."""


def answers_of(texts: Texts, examples: Texts, files: Sequence[Path]) -> dict[str, Any]:
    """Answers by key: those of TOML files, and the typed ones, which take precedence.

    >>> texts = {"contact.radius_mm": "9.5, inf", "import.columns.load_N": "=20"}
    >>> answers_of(texts, {"contact.radius_mm": "[1, 2]"}, [])
    {'contact.radius_mm': [9.5, inf], 'import.values.load_N': 20}
    """
    answers = {key: value for file in files for key, value in flat(read_toml(file)).items() if key != "schema"}
    for key, text in texts.items():
        if key.startswith(COLUMNS) and text.startswith("="):
            answers[VALUES + key.removeprefix(COLUMNS)] = value_of(text[1:])
        else:
            answers[key] = value_of(text, examples.get(key, ""))
    refuse_foreign_files(answers)
    return answers


def refuse_foreign_files(values: Any, where: str = "") -> None:
    """Raise an error for a text that names a file outside the folder of the files that were sent."""
    if isinstance(values, Mapping):
        for key, value in values.items():
            refuse_foreign_files(value, f"{where}.{key}".lstrip("."))
    elif isinstance(values, list | tuple):
        for value in values:
            refuse_foreign_files(value, where)
    elif isinstance(values, str) and where.rpartition(".")[2] not in NO_PATHS and not where.startswith(COLUMNS):
        paths = (PurePosixPath(values), PureWindowsPath(values))
        if any(path.is_absolute() or ".." in path.parts for path in paths):
            raise InputError("names a file outside this page; send the file, and give its bare name", where=where)


def preview(files: Sequence[Path], answer_files: Sequence[Path], texts: Texts, examples: Texts, over: str) -> Field:
    """The recording as far as its answers tell: form, table, ranges, notes and a plot."""
    given = answers_of(texts, examples, answer_files)
    draft, answers, taken = drafted(files, given)
    waiting = open_questions(draft, answers)
    headers, rows = _rows(files, answers)
    fields = [_asked(question, answers, headers) for question in (*taken, *draft.questions)]
    known = {field["key"] for field in fields}
    open_gaps = () if waiting or draft.kind is None else missing_inputs(draft, answers, [files[0].parent])
    for gap in open_gaps:
        fields += [field for field in _of_gap(gap, answers) if field["key"] not in known]
    blocking = [gap.blocking for gap in open_gaps if gap.required]
    drawn = draft.quantity is not None and draft.quantity in draft.columns
    return {
        "kind": draft.kind,
        "about": about(draft.kind) if draft.kind else "",
        "quantity": draft.quantity,
        "columns": [{"name": n, "range": range_of_column(v)} for n, v in draft.columns.items()],
        "count": len(next(iter(draft.columns.values()))) if draft.columns else len(rows),
        "headers": headers,
        "rows": rows,
        "notes": [_note(note) for note in draft.notes],
        "fields": fields,
        "open": [question.key for question in waiting],
        "blocking": blocking,
        "axes": abscissae(draft.columns, str(draft.quantity)) if drawn else [],
        "plot": as_svg(readings_figure(draft.columns, str(draft.quantity), over)) if drawn else "",
    }


def write(files: Sequence[Path], answer_files: Sequence[Path], texts: Texts, examples: Texts, out: Path) -> str:
    """Write the case of a recording; return its folder."""
    _, answers, _ = drafted(files, answers_of(texts, examples, answer_files))
    return str(import_files(files, out, overwrite=True, **answers))


def _rows(files: Sequence[Path], answers: Mapping[str, Any]) -> tuple[list[str], list[list[str]]]:
    """Headers and first rows as the instrument wrote them; none for a file that is no plain table."""
    try:
        return first_rows(files, answers, ROWS)
    except InputError:
        return [], []


def _note(note: Finding) -> dict[str, str]:
    return {"severity": str(note.severity), "text": str(note)}


def _asked(question: Question, answers: Mapping[str, Any], headers: Sequence[str]) -> Field:
    """Input for a question of the importer."""
    example = "" if question.example in (UNKNOWN_HEADER, UNKNOWN_UNIT) or question.placeholder else question.example
    # One value for all rows can be typed, so that these headers are suggestions and no choice.
    options = () if question.one_value else question.options
    choices = {option: about(option) if question.key == KIND else option for option in options}
    text = question.text + (" (=VALUE if all rows have the same)" if question.one_value else "")
    return {
        **_field(question.key, text, example, question.needed),
        "type": question.example,
        "offered": question.offered,
        "choices": choices,
        "suggested": list(headers) if question.key.startswith(COLUMNS) else [],
        "meaning": question.meaning,
        "value": _shown(answers.get(question.key)),
        "group": "needed" if question.needed else _table(question.key),
    }


def _of_gap(gap: Gap, answers: Mapping[str, Any]) -> Iterator[Field]:
    """Inputs for the keys that a table of system.toml leaves out."""
    for name in dict.fromkeys((*gap.needed, *gap.enough, *gap.assumed, *(gap.keys if gap.absent else ()))):
        described = gap.keys[name]
        if name in UNSUITED or (gap.table == "recording" and name == "noise"):
            continue
        key = f"{gap.table}.{name}".lstrip(".")
        needed = gap.required and (name in gap.needed or not gap.needed)
        example = "" if described.example is None else toml_value(described.example)
        default = gap.assumed.get(name, "")
        yield {
            **_field(key, described.words[:1].upper() + described.words[1:], default or example, needed),
            "type": example,
            "offered": False,
            "choices": _choices(key, described.values),
            "suggested": [],
            "meaning": f"left out: {default}" if default else "",
            "value": _shown(answers.get(key)),
            "group": "needed" if gap.required else gap.table or "case",
        }


def _field(key: str, text: str, example: str, needed: bool) -> Field:
    return {"key": key, "text": text, "example": example, "needed": needed}


def _choices(key: str, values: Mapping[str, str]) -> dict[str, str]:
    """Values of a choice, or the names of shipped gears and oils."""
    if key == "gears.preset":
        return {name: shipped_gears(name).name for name in gear_names()}
    if key == "lubricant.oil":
        return {name: shipped_oil(name).name for name in oil_names()}
    return dict(values)


def _shown(value: Any) -> str:
    """Value as typed into a form.

    >>> _shown("film"), _shown([9.5, 20.0]), _shown(None)
    ('film', '[9.5, 20.0]', '')
    """
    return "" if value is None else value if isinstance(value, str) else toml_value(value)


def _table(key: str) -> str:
    """Table of a key."""
    return key.rpartition(".")[0] or "case"
