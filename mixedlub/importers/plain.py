"""Plain tables: one header line, any of the usual separators."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub.config import KINDS
from mixedlub.headers import BY_NAME, TEXT_COLUMNS, UNITS, convert, split, target_of, words_of
from mixedlub.importers.draft import Answers, Draft, Question, contact_form, questions_of
from mixedlub.importers.kinematics import refuse_one_surface
from mixedlub.importers.likely import likely_headers, likely_kind
from mixedlub.importers.sheet import Cells, Sheet, is_number, read_sheet
from mixedlub.importers.write import toml_value
from mixedlub.kinds import Kind
from mixedlub.kinds import kind as kind_of
from mixedlub.table import Column
from profiles.errors import InputError, nearest


def matches(text: str) -> bool:
    """Any text may be a table."""
    return True


def draft(text: str, name: str, answers: Answers) -> Draft:
    """A case from a table: kind and quantity are asked, columns by their headers, units where a header has none.

    Where the kind or the quantity is open, what a likely one leaves to ask is asked with it.
    """
    sheet = read_sheet(text, name)
    kind, quantity = answers.get("kind"), answers.get("recording.quantity")
    if kind is not None and kind not in KINDS:
        raise InputError(f"no such kind; {nearest(str(kind), KINDS)}", where="kind", value=kind)
    likely = kind_of(kind or likely_kind(sheet.cells))
    questions: list[Question] = []
    if kind is None:
        questions.append(Question("kind", "Kind of recording", toml_value(likely.name), among=KINDS))
    if quantity is None:
        quantity = _likely_quantity(likely, sheet.cells)
        if len(likely.quantities) > 1:
            example = toml_value(quantity)
            questions.append(Question("recording.quantity", "Recorded quantity", example, among=likely.quantities))
    headers, unknown = _headers(likely, str(quantity), sheet.cells, answers)
    units, unread = _units(headers, answers)
    rest = (*unknown, *unread, *contact_form(likely.name, answers), *questions_of(likely.name))
    if questions:
        return Draft(kind, None, {}, {}, (*questions, *rest))
    refuse_one_surface(headers, sheet.cells, name)
    columns = {
        column: _values(column, header, sheet, units.get(column))
        for column, header in headers.items()
        if column in units or not _has_unit(column, header)
    }
    notes = [f"{name}: {len(columns)} of {len(sheet.cells)} columns taken: {', '.join(columns)}"]
    rest_of_it = [header for header in sheet.cells if header not in headers.values()]
    if rest_of_it:
        notes.append(f"{name}: not taken: {', '.join(rest_of_it)}")
    if sheet.left_out:
        notes.append(f"{name}: {sheet.left_out} left out: no part of the table")
    return Draft(kind, quantity, columns, {}, rest, tuple(notes))


def _likely_quantity(kind: Kind, cells: Cells) -> str:
    return next((q for q in kind.quantities if _header(q, cells, {}) is not None), kind.quantities[0])


def _headers(kind: Kind, quantity: str, cells: Cells, answers: Answers) -> tuple[dict[str, str], list[Question]]:
    """Headers by the column they hold, and what to ask where a needed column has none."""
    wanted = [*(c.name for c in kind.columns), quantity, f"{quantity}_sd", "rig", "sequence", "setup"]
    found = {c: h for c in wanted if (h := _header(c, cells, answers)) is not None}
    missing = [c for c in wanted if c not in found and (c == quantity or c in _required(kind))]
    free = {h: values for h, values in cells.items() if h not in found.values()}
    nearest_header = likely_headers(missing, free or cells)
    questions = []
    for column in missing:
        header = nearest_header.get(column)
        example = toml_value(header or "HEADER")
        text = f"Header of the column that holds {column}"
        questions.append(Question(f"import.columns.{column}", text, example, among=tuple(cells), of="the file has"))
        bare = header is not None and _has_unit(column, header) and split(header)[1] is None
        if header is not None and bare and f"import.units.{column}" not in answers:
            questions.append(_unit_question(column, header))
    return found, questions


def _required(kind: Kind) -> set[str]:
    return {c.name for c in kind.columns if c.required}


def _header(column: str, cells: Cells, answers: Answers) -> str | None:
    told = answers.get(f"import.columns.{column}")
    if told is not None:
        if told not in cells:
            raise InputError(
                f"no such header; {nearest(str(told), cells)}", where=f"import.columns.{column}", value=told
            )
        return str(told)
    if column in cells:
        return column
    found = [h for h in cells if (target := target_of(h)) is not None and target.name == column]
    if column in TEXT_COLUMNS:
        return found[0] if found else None
    spoken = BY_NAME[column].spoken if column in BY_NAME else ()
    order = {words: place for place, words in enumerate(spoken)}
    # A clock, or a column of remarks, may bear the words of a number.
    numeric = [h for h in found if is_number(cells[h][0])]
    return min(numeric or found, key=lambda h: order.get(words_of(h), -1), default=None)


def _has_unit(column: str, header: str) -> bool:
    """Whether the column is read in a unit: one by its own name is in its own."""
    return column in BY_NAME and header != column


def _units(headers: Mapping[str, str], answers: Answers) -> tuple[dict[str, str], list[Question]]:
    """Units by column, as told or as the header says, and what to ask where neither does."""
    told = {c: answers.get(f"import.units.{c}") or split(h)[1] for c, h in headers.items() if _has_unit(c, h)}
    return (
        {c: str(unit) for c, unit in told.items() if unit is not None},
        [_unit_question(c, headers[c]) for c, unit in told.items() if unit is None],
    )


def _unit_question(column: str, header: str) -> Question:
    known = tuple(UNITS[BY_NAME[column].unit])
    text = f"Unit of the column {header!r}, taken as {column}"
    return Question(f"import.units.{column}", text, toml_value(known[0]), among=known)


def _values(column: str, header: str, sheet: Sheet, unit: str | None) -> np.ndarray:
    cells = sheet.cells[header]
    if column in TEXT_COLUMNS:
        return np.array(cells)
    number = Column(header)
    values = np.array(
        [
            number.parse(cell, f"{sheet.name}: line {line}, {header}")
            for line, cell in zip(sheet.lines, cells, strict=True)
        ]
    )
    return values if unit is None else convert(values, unit, BY_NAME[column], f"{sheet.name}: {header}")
