"""Plain tables: one header line, any of the usual separators."""

from __future__ import annotations

import numpy as np

from mixedlub.importers.clock import date_order, run_on
from mixedlub.importers.constant import constants, value_keys
from mixedlub.importers.dates import KEY as DATES
from mixedlub.importers.draft import Answers, Draft, Question, contact_form, questions_of, read_note, refuse_unknown
from mixedlub.importers.groups import kept, only_keys, pooled
from mixedlub.importers.kinematics import refuse_one_surface
from mixedlub.importers.likely import likely_kind, likeness
from mixedlub.importers.marks import KEY as DECIMAL
from mixedlub.importers.marks import MARKS
from mixedlub.importers.match import import_keys, match, target_for, wanted
from mixedlub.importers.pace import KEYS as PACED
from mixedlub.importers.pace import TIME, in_seconds, target_in
from mixedlub.importers.runs import header_of_runs, runs_of
from mixedlub.importers.sheet import Cells, Sheet, not_above_zero, read_sheet, whole
from mixedlub.importers.vocabulary import convert
from mixedlub.kinds import Kind
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.system_file import KINDS
from mixedlub.schema.table import Column
from mixedlub.schema.toml_file import toml_value
from profiles.errors import InputError, nearest


def matches(text: str) -> bool:
    """Any text may be a table."""
    return True


def draft(text: str, name: str, answers: Answers) -> Draft:
    """A case from a table: kind and quantity are asked, columns by their headers, units where a header has none.

    Where the kind or the quantity is open, what a likely one leaves to ask is asked with it.
    """
    kind, quantity = answers.get("kind"), answers.get("recording.quantity")
    if kind is not None and kind not in KINDS:
        raise InputError(f"no such kind; {nearest(str(kind), KINDS)}", where="kind", value=kind)
    _refuse_unknown(kind, answers)
    sheet, chosen = kept(read_sheet(text, name, _decimal(answers)), answers)
    likely = kind_of(kind or likely_kind(sheet.cells))
    if kind is not None and quantity is not None and quantity not in likely.quantities:
        rule = f"a case of kind {kind!r} records {' or '.join(likely.quantities)}"
        raise InputError(rule, where="recording.quantity", value=quantity)
    questions: list[Question] = []
    if kind is None:
        questions.append(Question("kind", "Kind of recording", toml_value(likely.name), among=KINDS))
    if quantity is None:
        quantity = _likely_quantity(likely, sheet.cells)
        if len(likely.quantities) > 1:
            example = toml_value(quantity)
            questions.append(Question("recording.quantity", "Recorded quantity", example, among=likely.quantities))
    found = match(likely, str(quantity), sheet.cells, answers)
    rest = (*found.questions, *contact_form(likely.name, answers), *questions_of(likely.name))
    if questions:
        return Draft(kind, None, {}, {}, (*questions, *rest))
    rules = {column.name: column for column in wanted(likely, str(quantity), answers)}
    needed = [h for c, h in found.headers.items() if rules[c].form != "name" and not rules[c].blank]
    sheet, lost = whole(sheet, needed)
    refuse_one_surface(found.headers, sheet.cells, name)
    asked = {TIME if question.key in PACED else question.key.rpartition(".")[2] for question in found.questions}
    columns = {
        column: _values(rules[column], header, sheet, found.units.get(column))
        for column, header in found.headers.items()
        if column not in asked
    }
    paced = ""
    restarted: list[Finding] = []
    if TIME in columns and TIME in found.units:
        columns[TIME], paced = in_seconds(columns[TIME], found.headers[TIME], found.units[TIME], answers)
    if TIME in columns:
        columns[TIME], restarted = run_on(columns[TIME], found.headers[TIME], sheet, date_order(answers))
    columns |= constants(likely, answers, len(sheet.lines))
    readings = columns.get(str(quantity)) if likely.is_unsigned(str(quantity)) else None
    low = [] if readings is None else not_above_zero(str(quantity), readings.tolist(), sheet.lines)
    header = header_of_runs(sheet, answers)
    runs, anew = (None, None) if header is None else runs_of(sheet, header)
    fixed = [c for c in columns if c not in found.headers]
    taken = [*(["run"] if runs is not None else []), *(c for c in columns if c in found.headers)]
    left = [h for h in sheet.cells if h not in found.headers.values() and h != header]
    conditions = [v for c, v in columns.items() if c not in (quantity, f"{quantity}_sd")]
    mixed = pooled({h: sheet.cells[h] for h in left}, conditions, name)
    read = [
        *chosen,
        f"{len(taken)} of {len(sheet.cells)} columns taken: {', '.join(taken)}",
        *([f"not taken: {', '.join(left)}"] if left else []),
        *([f"the same in all rows, as answered: {', '.join(fixed)}"] if fixed else []),
        *([f"{sheet.left_out} left out: no part of the table"] if sheet.left_out else []),
        *found.notes,
        *([paced] if paced else []),
    ]
    notes = [
        *(finding("rows_left_out", text, name) for text in lost),
        *(finding("column_not_taken", text, name) for text in found.warned),
        *mixed,
        *(read_note(text, name) for text in read),
        *restarted,
        *(read_note(text, name) for text in low),
        *([read_note(anew)] if anew else []),
    ]
    return Draft(kind, quantity, columns, {}, rest, tuple(notes), runs)


def _refuse_unknown(kind: str | None, answers: Answers) -> None:
    kinds = [kind_of(k) for k in ([kind] if kind else KINDS)]
    columns = {c.name: c for k in kinds for q in k.quantities for c in wanted(k, q, answers)}
    values = (key for k in kinds for key in value_keys(k))
    refuse_unknown(answers, (DECIMAL, DATES, *only_keys(answers), *import_keys(tuple(columns.values())), *values))


def _decimal(answers: Answers) -> str | None:
    told = answers.get(DECIMAL)
    if told is not None and told not in MARKS:
        raise InputError("must be '.' or ','", where=DECIMAL, value=told)
    return told


def _likely_quantity(kind: Kind, cells: Cells) -> str:
    """The quantity to which a header comes nearest."""
    return max(kind.quantities, key=lambda q: max(likeness(q, h, values) for h, values in cells.items()))


def _values(rule: Column, header: str, sheet: Sheet, unit: str | None) -> np.ndarray:
    """The cells of a column in its unit, within the bounds that a case sets; the first wrong one is named."""
    cells = sheet.cells[header]
    places = [f"{sheet.name}: line {line}, {header}" for line in sheet.lines]
    if rule.form == "name":
        return np.array([rule.parse(cell, place) for cell, place in zip(cells, places, strict=True)])
    number = Column(header, blank=rule.blank)
    values = np.array([number.parse(cell, place) for cell, place in zip(cells, places, strict=True)], dtype=float)
    target = target_for(rule.name)
    if unit is not None and target is not None:
        values = convert(values, unit, target_in(target, unit), f"{sheet.name}: {header}")
    for value, place in zip(values.tolist(), places, strict=True):
        if value == value and not rule.allows(value):
            rule.parse(repr(value), place)
    return values
