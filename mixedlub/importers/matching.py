"""Matching of headers to columns of a case with units; the remainder becomes questions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from mixedlub.importers.answer_keys import COLUMNS, UNIT_KEYS, UNKNOWN_HEADER, VALUES
from mixedlub.importers.base import Answers, Question
from mixedlub.importers.cell_columns import Cells, is_numeric
from mixedlub.importers.column_units import (
    header_unit_of,
    is_named,
    refuse_idle_units,
    taken_units,
    target_for,
    unit_question,
)
from mixedlub.importers.kinematic import VISCOSITY
from mixedlub.importers.likeness import (
    WEAR,
    either,
    is_empty,
    is_logarithm,
    likely_headers,
    likely_spread,
    likeness,
    relative_spread_notes,
    rival_note,
    rivals,
    spare_headers,
    spare_notes,
    spare_questions,
    transmitted,
)
from mixedlub.importers.one_value import without_value
from mixedlub.importers.speed_from_position import FROM_POSITION, SPEED_FROM, positions
from mixedlub.importers.surface_speeds import FROM_BOTH_SPEEDS, other_surface
from mixedlub.importers.time_base import (
    PACE_KEYS,
    TIME,
    header_of_count,
    headers_in_time,
    pace_questions,
    target_in,
)
from mixedlub.importers.vocabulary import BY_NAME, TEXT_COLUMNS, is_kinematic, is_of_another, target_of
from mixedlub.kinds import Kind
from mixedlub.running.shell import quoted
from mixedlub.schema.table import BOOKKEEPING, Column, check_column, sd_column
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import fits, open_units, split, unit_of, words_of
from profiles.errors import InputError, nearest

AMBIGUOUS = 0.1
"""Judgement. Difference of likeness up to which another header is listed as equally likely."""


@dataclass(frozen=True)
class Match:
    """Headers and source units by column, open questions, notes on choices, warnings of unused columns."""

    headers: Mapping[str, str]
    units: Mapping[str, str]
    questions: tuple[Question, ...]
    notes: tuple[str, ...]
    warned: tuple[str, ...]


@dataclass
class _Matched:
    """Headers, questions and notes so far."""

    headers: dict[str, str] = field(default_factory=dict)
    questions: list[Question] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def wanted(kind: Kind, quantity: str, answers: Answers) -> tuple[Column, ...]:
    """All columns possible in a case of a kind, except ``run``."""
    check = answers.get("recording.check")
    return (
        *kind.columns,
        *kind.instrument_channels,
        Column(quantity),
        sd_column(quantity),
        *BOOKKEEPING,
        *([check_column(str(check))] if check else []),
    )


def import_keys(columns: Sequence[Column]) -> tuple[str, ...]:
    """Keys of the answers that match headers to these columns."""
    return (
        f"{COLUMNS}run",
        *(COLUMNS + c.name for c in columns),
        *(UNIT_KEYS + c.name for c in columns if target_for(c.name) is not None),
        *PACE_KEYS,
    )


def match(kind: Kind, quantity: str, cells: Cells, answers: Answers) -> Match:
    """Headers and units of the columns of a case; a needed column without a unique header becomes a question."""
    columns = without_value(wanted(kind, quantity, answers), answers)
    named = {c.name: _named_header(c.name, cells, answers) for c in columns if COLUMNS + c.name in answers}
    matched = _Matched(headers=dict(named))
    reserved = set(named.values())
    free = {h: values for h, values in cells.items() if h not in reserved}
    filled = {h: values for h, values in free.items() if not is_empty(values)}
    for column in columns:
        if column.name not in named:
            _find_header(column, free if column.required else filled, matched)
        if column.name == TIME and column.required and column.name not in matched.headers:
            _find_count(filled, matched)
    _one_of(either(kind.name), set(named), matched)
    _absent_check(answers.get("recording.check"), cells, matched.headers)
    open_keys = {q.key for q in matched.questions}
    missing = [
        c.name for c in columns if c.required and c.name not in matched.headers and COLUMNS + c.name not in open_keys
    ]
    group = either(kind.name)
    if group and not any(c in matched.headers or COLUMNS + c in open_keys or VALUES + c in answers for c in group):
        missing.append(next(iter(likely_headers(group, _offered(cells, matched.headers))), group[0]))
    needed = {*named, *(c.name for c in columns if c.required)}
    certain = {c: h for c, h in matched.headers.items() if c in needed}
    similar = _near(missing, cells, matched.headers, certain)
    matched.headers = {c: h for c, h in matched.headers.items() if c in certain or h not in similar.values()}
    matched.questions.extend(_missing(missing, similar, cells, matched.headers, answers))
    spare = {c: h for c, h in _spare(kind, quantity, filled, matched).items() if VALUES + c not in answers}
    matched.questions.extend(spare_questions(spare))
    asked = {q.key.removeprefix(COLUMNS) for q in matched.questions}
    refuse_idle_units({*matched.headers, *asked}, answers)
    units, questions, notes = taken_units(matched.headers, answers)
    ordered = {c.name: matched.headers[c.name] for c in columns if c.name in matched.headers}
    questions += pace_questions(matched.headers, units, answers)
    left = {h: v for h, v in _offered(filled, matched.headers).items() if h not in spare.values()}
    spread = relative_spread_notes(
        {h: v for h, v in _offered(cells, matched.headers).items() if h not in spare.values()}
    )
    warned = (*spare_notes(spare), *spread, *_rivals(quantity, named, matched.headers, cells, left))
    every = tuple(_explained(q, kind) for q in (*matched.questions, *questions))
    return Match(ordered, units, every, (*matched.notes, *notes), warned)


def _rivals(
    quantity: str, named: Mapping[str, str], headers: Mapping[str, str], cells: Cells, left: Cells
) -> tuple[str, ...]:
    """Note on headers that may hold the reading, if neither an answer nor an exact column name decides."""
    header = headers.get(quantity)
    if header is None or quantity in named or is_named(header, quantity):
        return ()
    others = rivals(quantity, header, {header: cells[header], **left})
    return (rival_note(quantity, header, others),) if others else ()


def _explained(question: Question, kind: Kind) -> Question:
    """Question with the meaning of its column and, except for time, the key of one value for all rows."""
    name = question.key.rpartition(".")[2]
    column = next((c for c in (*kind.columns, *kind.instrument_channels, *kind.readings) if c.name == name), None)
    if column is None:
        return question
    unit = unit_of(name)
    meaning = f"{name}: {column.meaning}" + (f", in {unit}; other units are converted" if unit else "")
    has_value = question.key == COLUMNS + name and column in kind.columns and name != TIME
    return replace(question, meaning=meaning, one_value=VALUES + name if has_value else "")


def with_whole_headers(answers: Answers, cells: Cells) -> dict[str, Any]:
    """Answers in which a header named without its unit has it.

    >>> with_whole_headers({"import.columns.friction_coefficient": "Reibungszahl"}, {"Reibungszahl [-]": ["0.1"]})
    {'import.columns.friction_coefficient': 'Reibungszahl [-]'}
    """
    whole = dict(answers)
    for key, header in answers.items():
        if key.startswith(COLUMNS) and str(header) not in cells:
            found = [h for h in cells if split(h)[0] == str(header).strip().lower()]
            whole[key] = found[0] if len(found) == 1 else header
    return whole


def _named_header(column: str, cells: Cells, answers: Answers) -> str:
    header = str(answers[COLUMNS + column])
    where = COLUMNS + column
    if header not in cells:
        one = f"; if all rows have it: --set {quoted(f'{VALUES}{column}={header}')}"
        rule = f"no such header; {nearest(header, cells)}" + (one if column in TEXT_COLUMNS else "")
        raise InputError(rule, where=where, value=header)
    if WEAR.search(words_of(header)) and column in ("friction_coefficient", "friction_torque_Nm"):
        raise InputError("is wear, which no kind takes: it is no friction", where=where, value=header)
    if is_logarithm(header):
        raise InputError("is a logarithm; add a column of the quantity itself", where=where, value=header)
    unit = answers.get(UNIT_KEYS + column, split(header)[1])
    if column.startswith(VISCOSITY) and "kinematic" in words_of(header).split() and not is_kinematic(unit):
        rule = f'is a kinematic viscosity; give its unit, {UNIT_KEYS}{column} = "mm2/s", and the density of the oil, '
        rule += "lubricant.density_15C_kg_m3; or add a column of it times the density: mm²/s times g/cm³ is mPa s"
        raise InputError(rule, where=where, value=header)
    return header


def _find_header(column: Column, cells: Cells, matched: _Matched) -> None:
    """Find the header of a column by name or instrument words; an optional column takes the first of several."""
    exact = [h for h in cells if is_named(h, column.name)]
    if exact:
        matched.headers[column.name] = exact[0]
        return
    spoken = [h for h in cells if _speaks_of(h, column.name)]
    if column.dtype != "name":
        order = {words: place for place, words in enumerate(BY_NAME[column.name].spoken)} if spoken else {}
        # A time of day, or a column of remarks, may have the words of a number.
        numeric = [h for h in spoken if is_numeric(cells[h])]
        spoken = sorted(numeric or spoken, key=lambda h: order.get(words_of(h), -1))
    spoken = [h for h in spoken if not is_kinematic(split(h)[1])] or spoken
    if not spoken:
        return
    differing = [h for h in spoken if (split(h)[1], cells[h]) != (split(spoken[0])[1], cells[spoken[0]])]
    if differing and column.required:
        text = f"Header of the column that holds {column.name}, as more than one could"
        among = (spoken[0], *differing)
        question = Question(COLUMNS + column.name, text, toml_value(spoken[0]), options=among)
        matched.questions.append(replace(question, placeholder=UNKNOWN_HEADER))
        return
    matched.headers[column.name] = spoken[0]
    if differing:
        others = ", ".join(map(repr, differing))
        matched.notes.append(
            f"{spoken[0]!r} taken as {column.name}, not {others}; {COLUMNS}{column.name} names another"
        )


def _find_count(cells: Cells, matched: _Matched) -> None:
    """Find the header of a count of cycles or distance; ask a question if another column may hold the time."""
    header = header_of_count(cells)
    if header is None or COLUMNS + TIME in {question.key for question in matched.questions}:
        return
    times = headers_in_time({h: v for h, v in cells.items() if h not in matched.headers.values()})
    if times:
        text = f"Header of the column that holds {TIME}, or counts cycles or a distance instead"
        question = Question(COLUMNS + TIME, text, toml_value(times[0]), options=(*times, header))
        matched.questions.append(replace(question, placeholder=UNKNOWN_HEADER))
    else:
        matched.headers[TIME] = header


def _speaks_of(header: str, column: str) -> bool:
    """Whether a header has the words of a column and no unit of another quantity.

    A header with an unknown unit matches; the unit is an error later, with the possible units.

    >>> [_speaks_of(h, "friction_coefficient") for h in ("mu", "mu [%]", "mu [mPa s]", "mu [cSt]", "mu [Vs]")]
    [True, True, False, False, True]
    >>> [_speaks_of(h, "viscosity_mPa_s") for h in ("Kinematic viscosity [cSt]", "kinematic_viscosity_mm2_s")]
    [True, True]
    """
    unit = split(header)[1]
    target = target_of(re.sub(r"kinematic[\s_]+", "", header, flags=re.IGNORECASE) if is_kinematic(unit) else header)
    if target is None or target.name != column:
        return False
    return unit is None or fits(unit, target_in(target, unit).unit) or not is_of_another(unit, target)


def _one_of(group: tuple[str, ...], named: set[str], matched: _Matched) -> None:
    """Keep the answered column among columns that exclude each other, or ask a question."""
    present = [c for c in group if c in matched.headers]
    chosen = [c for c in present if c in named]
    if len(present) < 2 or len(chosen) > 1:
        return
    for column in present:
        if column not in chosen:
            header = matched.headers.pop(column)
            if not chosen and column == present[0]:
                text = f"Which to take: a case has one of {' and '.join(present)}; name its header by {COLUMNS}COLUMN"
                matched.questions.append(Question(COLUMNS + column, text, toml_value(header)))


def _absent_check(check: Any, cells: Cells, headers: Mapping[str, str]) -> None:
    if check and str(check) not in headers:
        raise InputError(f"no such header; {nearest(str(check), cells)}", where="recording.check", value=check)


def _near(
    missing: Sequence[str], cells: Cells, headers: Mapping[str, str], certain: Mapping[str, str]
) -> dict[str, str]:
    """Headers similar to needed columns: unused headers, or else headers taken for an optional column."""
    similar = likely_headers(missing, _offered(cells, headers))
    lent = {h: values for h, values in _offered(cells, certain).items() if h not in similar.values()}
    return {**likely_headers([c for c in missing if c not in similar], lent), **similar}


def _missing(
    missing: Sequence[str], similar: Mapping[str, str], cells: Cells, headers: Mapping[str, str], answers: Answers
) -> list[Question]:
    free = _offered(cells, headers)
    logarithms = [h for h in free if is_logarithm(h)]
    refused = (
        f"; {', '.join(logarithms)}: a logarithm cannot be taken, add a column of the quantity" if logarithms else ""
    )
    questions = []
    for column in missing:
        header = similar.get(column)
        others = [c for c, h in similar.items() if h != header]
        rivals = _equally_likely(column, header, {h: v for h, v in free.items() if not _is_of(others, column, h, v)})
        text = f"Header of the column that holds {column}{rivals}{_two_speeds(column, cells)}{refused}"
        header = None if rivals else header
        text += "; one that counts cycles or a distance will do" if column == TIME else ""
        places = [] if header or column not in FROM_POSITION else positions(cells)
        text += f"; or the change of a position: --set {quoted(f'{SPEED_FROM}={places[0]}')}" if places else ""
        others = [] if header or rivals else transmitted(column, free)
        if others:
            text += f"; not proposed: {', '.join(others)}, as by its words none of these is one; where it is their "
            text += "difference, add a column of that to the file"
        among = (
            _of_names(cells, [h for h in free if h not in similar.values()]) if column in TEXT_COLUMNS else tuple(cells)
        )
        example = toml_value(header) if header else UNKNOWN_HEADER
        question = Question(COLUMNS + column, text, example, options=among, options_intro="the file has")
        questions.append(replace(question, offered=header is not None))
        target = target_for(column)
        if header is None or target is None or header == column or UNIT_KEYS + column in answers:
            continue
        unit = header_unit_of(column, header)
        if unit is None or open_units(unit, target.unit):
            questions.append(unit_question(column, header, target))
    return questions


def _of_names(cells: Cells, free: Sequence[str]) -> tuple[str, ...]:
    """Headers of text columns, or else all unused headers, since names may be numbers."""
    filled = {h: values for h, values in cells.items() if not is_empty(values)}
    return tuple(h for h, values in filled.items() if not is_numeric(values)) or tuple(h for h in free if h in filled)


def _offered(cells: Cells, headers: Mapping[str, str]) -> Cells:
    """Unused headers, without speeds of single surfaces."""
    free = {h: values for h, values in cells.items() if h not in headers.values()}
    return {h: values for h, values in free.items() if other_surface(h, cells) is None}


def _two_speeds(column: str, cells: Cells) -> str:
    """Reason against offering the speeds of two surfaces."""
    single = [h for h in cells if other_surface(h, cells) is not None] if column in FROM_BOTH_SPEEDS else []
    made = FROM_BOTH_SPEEDS.get(column, "").removesuffix(" with that of").removesuffix(" to that of")
    return f"; {', '.join(single)}: speeds of single surfaces, {made}, add a column of it" if single else ""


def _spare(kind: Kind, quantity: str, cells: Cells, matched: _Matched) -> dict[str, str]:
    """Headers similar to optional columns that have none."""
    open_keys = {q.key.removeprefix(COLUMNS) for q in matched.questions}
    possible = (*kind.columns, *kind.instrument_channels)
    absent = [
        c for c in possible if not c.required and c.name not in {*matched.headers, *open_keys, *either(kind.name)}
    ]
    offered = {question.example for question in matched.questions}
    free = {h: v for h, v in _offered(cells, matched.headers).items() if toml_value(h) not in offered}
    near = spare_headers(absent, free)
    reading, sd = matched.headers.get(quantity), f"{quantity}_sd"
    spread = None if reading is None or sd in matched.headers else likely_spread(BY_NAME[quantity], reading, free)
    return near if spread is None else {**near, sd: spread}


def _is_of(others: Sequence[str], column: str, header: str, cells: Sequence[str]) -> bool:
    """Whether a header clearly belongs to another column without a header."""
    near = likeness(column, header, cells)
    return any(likeness(other, header, cells) > near + AMBIGUOUS for other in others)


def _equally_likely(column: str, header: str | None, free: Cells) -> str:
    """Headers about as similar to a column as the most similar header; empty if unique."""
    if header is None:
        return ""
    least = likeness(column, header, free[header]) - AMBIGUOUS
    likely = [h for h in free if h == header or likeness(column, h, free[h]) >= least]
    return f"; equally likely: {', '.join(likely)}" if len(likely) > 1 else ""
