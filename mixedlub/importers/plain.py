"""Plain tables with a header line and any common separator."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import numpy as np

from mixedlub.data_checks.pooled_rows import grouping_columns, pooled_words
from mixedlub.importers import dropped_columns
from mixedlub.importers.answer_keys import COLUMNS
from mixedlub.importers.base import Answers, Draft, Question, contact_form, questions_of, read_note, refuse_unknown
from mixedlub.importers.cell_columns import Cells, NumberColumn
from mixedlub.importers.chosen_table import chosen_table
from mixedlub.importers.column_units import target_for
from mixedlub.importers.decimals import DECIMAL, MARKS
from mixedlub.importers.dropped_columns import LEAVE
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.kinematic import as_dynamic
from mixedlub.importers.likeness import likely_headers, likely_kind, likeness_of_reading
from mixedlub.importers.matching import Match, import_keys, match, wanted, with_whole_headers
from mixedlub.importers.one_value import constants, value_keys
from mixedlub.importers.recognised import logarithm_doubt, refuse_unrecognised
from mixedlub.importers.speed_from_position import SPEED_FROM, offer_note, speed_question, with_speed
from mixedlub.importers.surface_speeds import halved_sum, refuse_one_surface
from mixedlub.importers.text_table import (
    ONLY,
    TABLE,
    Sheet,
    complete_rows,
    header_of_runs,
    not_above_zero,
    only_keys,
    runs_of,
    selected_rows,
)
from mixedlub.importers.time_base import DATES, PACE_KEYS, TIME, continued, date_order, in_seconds, target_in
from mixedlub.importers.two_forces import COEFFICIENT, over_load
from mixedlub.importers.two_surfaces import RADII, with_both_speeds
from mixedlub.importers.vocabulary import convert
from mixedlub.kinds import KINDS, NATIVE, Kind
from mixedlub.kinds import kind as kind_of
from mixedlub.kinds.acceleration import COLUMN as ACCELERATION
from mixedlub.kinds.acceleration import accelerated
from mixedlub.running.shell import quoted
from mixedlub.schema.cells import is_number
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Column, Table
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import unit_of
from profiles.errors import InputError, nearest

OWN_COLUMNS = (
    "has columns of its own, so nothing is recognised: save the table as recordings.csv of a case of this kind"
)


def draft(file: InputFile, answers: Answers) -> Draft:
    """Draft of a case from a table: columns by header; kind, quantity and missing units are questions.

    While kind or quantity is open, the questions for the likely choice are included.
    """
    kind, name = answers.get("kind"), file.name
    if kind is not None and kind not in NATIVE:
        rule = f"no such kind; {nearest(str(kind), NATIVE)}" if kind not in KINDS else OWN_COLUMNS
        raise InputError(rule, where="kind", value=kind)
    _refuse_unknown(kind, answers)
    whole, which, table_notes = chosen_table(file, _decimal(answers), answers)
    sheet, selection_notes = selected_rows(whole, answers)
    sheet, speed_notes = with_speed(sheet, kind, answers)
    answers = with_whole_headers(answers, sheet.cells)
    with_ratio, left_to_answer, ratio_notes = over_load(sheet, answers)
    if kind is None:
        refuse_unrecognised(with_ratio.cells, name, answers)
    likely = kind_of(kind or likely_kind(with_ratio.cells))
    quantity, questions = _quantity(likely, with_ratio.cells, answers)
    if quantity == COEFFICIENT:
        sheet, answers = with_ratio, left_to_answer
    else:
        ratio_notes = []
    made = with_both_speeds(sheet, likely, answers)
    sheet = made.sheet
    matched = match(likely, quantity, sheet.cells, answers)
    asked = [question for question in matched.questions if question.key not in made.replaced]
    further = (*made.questions, *asked, *contact_form(likely.name, answers), *questions_of(likely.name))
    if questions:
        return Draft(kind, None, {}, {}, (*which, *questions, *further))
    rules = {column.name: column for column in wanted(likely, quantity, answers)}
    needed = [h for c, h in matched.headers.items() if rules[c].dtype != "name" and not rules[c].optional_cells]
    sheet, incomplete = complete_rows(sheet, needed)
    refuse_one_surface(matched.headers, sheet.cells, name)
    columns, made_notes, clock_notes = _columns(likely, quantity, matched, sheet, answers)
    readings = columns.get(quantity) if likely.is_unsigned(quantity) else None
    not_positive = [] if readings is None else not_above_zero(quantity, readings.tolist(), sheet.lines)
    header = header_of_runs(sheet, answers)
    runs, renumbered = (None, None) if header is None else runs_of(sheet, header)
    fixed = [c for c in columns if c not in matched.headers]
    taken = [*(["run"] if runs is not None else []), *(c for c in columns if c in matched.headers)]
    unused = [h for h in sheet.cells if h not in matched.headers.values() and h != header]
    conditions = [v for c, v in columns.items() if c not in (quantity, f"{quantity}_sd")]
    left = {h: sheet.cells[h] for h in unused}
    pooled = dict(grouping_columns(left, conditions))
    no_speed = "entrainment_speed_m_s" not in columns and SPEED_FROM not in answers
    place = speed_question(likely.name, left, sheet.cells) if no_speed else []
    further = (*further, *dropped_columns.setup_offers(pooled, columns), *place)
    related: list[str] = []
    doubts: list[str] = []
    if quantity in columns:
        reading = columns[quantity]
        offered = {q.example: q.key for q in matched.questions}
        further = (*dropped_columns.questions(left, conditions, reading, answers, offered), *further)
        correlated = dropped_columns.changing_with(left, reading)
        offers, related = dropped_columns.channel_offers(correlated, quantity, answers)
        further = (*further, *offers)
        doubts += logarithm_doubt(quantity, matched.headers.get(quantity, ""), reading)
    how_read = [
        *table_notes,
        *selection_notes,
        f"{len(taken)} of {len(sheet.cells)} columns taken: {', '.join(taken)}",
        *([f"not taken: {', '.join(unused)}"] if unused else []),
        *([f"the same in all rows, as answered: {', '.join(fixed)}"] if fixed else []),
        *([f"{sheet.left_out} left out: no part of the table"] if sheet.left_out else []),
        *matched.notes,
        *made_notes,
        *_accelerated(likely, columns),
    ]
    notes = [
        *(finding("decimal_mark_assumed", text, name) for text in sheet.notes),
        *(finding("rows_left_out", text, name) for text in (*filter(None, [sheet.summaries]), *incomplete)),
        *(finding("column_not_taken", text, name) for text in (*matched.warned, *map(offer_note, place))),
        *_pooled(pooled, name),
        *(finding("column_changes_with_reading", text, name) for text in related),
        *(finding("viscosity_logarithm", text, name) for text in doubts),
        *speed_notes,
        *made.notes,
        *ratio_notes,
        *(read_note(text, name) for text in (*filter(None, [sheet.repeated]), *how_read)),
        *clock_notes,
        *(read_note(text, name) for text in not_positive),
        *([read_note(renumbered)] if renumbered else []),
    ]
    return Draft(kind, quantity, columns, {}, (*which, *further), tuple(notes), runs)


def _quantity(likely: Kind, cells: Cells, answers: Answers) -> tuple[str, list[Question]]:
    """Recorded or likely quantity, and open questions on kind and quantity."""
    kind, quantity = answers.get("kind"), answers.get("recording.quantity")
    among = likely.quantities
    if kind is not None and quantity is not None and quantity not in among:
        rule = f"a case of kind {kind!r} records {' or '.join(among)}"
        raise InputError(rule, where="recording.quantity", value=quantity)
    questions = []
    if kind is None:
        questions.append(Question("kind", "Kind of recording", toml_value(likely.name), options=NATIVE, offered=True))
    if quantity is not None:
        return str(quantity), questions
    quantity = _likely_quantity(likely, cells)
    if len(among) > 1:
        example = toml_value(quantity)
        questions.append(Question("recording.quantity", "Recorded quantity", example, options=among, offered=True))
    return quantity, questions


def _columns(
    kind: Kind, quantity: str, matched: Match, sheet: Sheet, answers: Answers
) -> tuple[dict[str, np.ndarray], list[str], list[Finding]]:
    """Columns in case units, notes on derived columns, and findings on the clock."""
    rules = {column.name: column for column in wanted(kind, quantity, answers)}
    open_columns = {TIME if q.key in PACE_KEYS else q.key.rpartition(".")[2] for q in matched.questions}
    columns = {
        column: _values(rules[column], header, sheet, matched.units.get(column))
        for column, header in matched.headers.items()
        if column not in open_columns
    }
    count_note = ""
    clock_notes: list[Finding] = []
    if TIME in columns and TIME in matched.units:
        columns[TIME], count_note = in_seconds(columns[TIME], matched.headers[TIME], matched.units[TIME], answers)
    if TIME in columns:
        columns[TIME], clock_notes = continued(columns[TIME], matched.headers[TIME], sheet, date_order(answers))
    columns |= constants(kind, answers, len(sheet.lines))
    where = f"{sheet.name}: {matched.headers.get(quantity, quantity)}"
    columns, density_note = as_dynamic(columns, matched.units, answers, where)
    sum_note = ""
    if (mean := "entrainment_speed_m_s") in matched.headers and mean in columns:
        columns[mean], sum_note = halved_sum(columns[mean], matched.headers[mean])
    return columns, [note for note in (count_note, density_note, sum_note) if note], clock_notes


def _pooled(columns: Cells, file: str) -> Iterator[Finding]:
    """Findings on omitted columns that distinguish groups of rows, which are then pooled."""
    for header, cells in columns.items():
        value = toml_value(cells[0]) if not is_number(cells[0]) and re.search(r"[^\w-]", cells[0]) else cells[0]
        only, setup = quoted(f"{ONLY}{header}={value}"), quoted(f"{COLUMNS}setup={toml_value(header)}")
        text = f"{header!r} is not taken, so {pooled_words(cells)}; to tell them apart: --set {setup}; to import one "
        yield finding("things_pooled", f"{text}of them: --set {only}", file)


def _accelerated(kind: Kind, columns: Mapping[str, np.ndarray]) -> list[str]:
    """Note on the acceleration that follows from logged speeds of a machine."""
    table = Table(columns)
    if kind.name != "friction_map" or ACCELERATION not in accelerated(table, table):
        return []
    return ["speed_rpm changes over time_s: the angular acceleration is derived, for the inertia of the machine"]


def _refuse_unknown(kind: str | None, answers: Answers) -> None:
    kinds = [kind_of(k) for k in ([kind] if kind else NATIVE)]
    columns = {c.name: c for k in kinds for q in k.quantities for c in wanted(k, q, answers)}
    values = (key for k in kinds for key in value_keys(k))
    refuse_unknown(
        answers,
        (
            DECIMAL,
            DATES,
            LEAVE,
            SPEED_FROM,
            RADII,
            TABLE,
            *only_keys(answers),
            *import_keys(tuple(columns.values())),
            *values,
        ),
    )


def _decimal(answers: Answers) -> str | None:
    mark = answers.get(DECIMAL)
    if mark is not None and mark not in MARKS:
        raise InputError("must be '.' or ','", where=DECIMAL, value=mark)
    return mark


def _likely_quantity(kind: Kind, cells: Cells) -> str:
    """Quantity with the most similar header."""
    similar = likely_headers(kind.quantities, cells)
    return max(kind.quantities, key=lambda q: likeness_of_reading(q, cells, similar.get(q)))


def _values(rule: Column, header: str, sheet: Sheet, unit: str | None) -> np.ndarray:
    """Values of a column in its unit, within the bounds of a case; raise an error for the first invalid cell."""
    cells = sheet.cells[header]

    def place(row: int) -> str:
        return f"{sheet.name}: line {sheet.lines[row]}, {header}"

    # Bounds hold in the unit of the case, after the conversion.
    written = rule if rule.dtype == "name" else Column(header, optional_cells=rule.optional_cells)
    known = isinstance(cells, NumberColumn) and written.dtype == "number" and bool(np.isfinite(cells.values).all())
    values = cells.values if isinstance(cells, NumberColumn) and known else written.parse_all(cells)
    if values is None:
        values = np.array([written.parse(cell, place(row)) for row, cell in enumerate(cells)])
    if rule.dtype == "name":
        return values
    target = target_for(rule.name)
    if unit is not None and target is not None:
        values = convert(values, unit, target_in(target, unit), f"{sheet.name}: {header}")
    allowed = np.isnan(values) | ((values > rule.above) & (values >= rule.at_least) & (values <= rule.at_most))
    if not allowed.all():
        row = int(np.argmin(allowed))
        try:
            rule.parse(repr(float(values[row])), place(row))
        except InputError as error:
            native = unit is None or float(cells[row]) == values[row]
            meant = "" if native else f": {cells[row]} {unit} is {values[row]:g} {unit_of(rule.name)}"
            text = (error.rule if native else error.rule.partition(";")[0]) + meant
            text += f"; --set {quoted(f'{ONLY}{header}=LOW..HIGH')} keeps the rows within a range"
            raise InputError(text, where=error.where, value=cells[row]) from None
    return values
