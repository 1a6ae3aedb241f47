"""Matching of headers to the columns of a case, with their units; the rest becomes questions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.importers.base import Answers, Question
from mixedlub.importers.likeness import (
    either,
    is_logarithm,
    likely_headers,
    likely_spread,
    likeness,
    spare_headers,
    spare_notes,
    spare_questions,
    transmitted,
)
from mixedlub.importers.surface_speeds import FROM_BOTH_SPEEDS, other_surface
from mixedlub.importers.text_table import Cells, is_numeric
from mixedlub.importers.time_base import (
    PACE_KEYS,
    PACES,
    TIME,
    counted,
    header_of_count,
    headers_in_time,
    pace_questions,
    target_in,
    unit_of_count,
)
from mixedlub.importers.vocabulary import BY_NAME, TEXT_COLUMNS, WEIGHED, Target, is_of_another, target_of, unknown_unit
from mixedlub.kinds import Kind
from mixedlub.schema.table import BOOKKEEPING, Column, check_column, is_missing, sd_column
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import change_to, fits, open_units, split, tidy, units_of, words_of
from profiles.errors import InputError, nearest

VALUES = "import.values."
"""Prefix of a column in the answer that gives all its rows one value."""


def value_keys(kind: Kind) -> tuple[str, ...]:
    """The answers that give a column of a kind one value."""
    return tuple(VALUES + column.name for column in kind.columns)


def without_value(columns: Sequence[Column], answers: Answers) -> tuple[Column, ...]:
    """The columns that need a header, as no answer gives their value."""
    return tuple(column for column in columns if VALUES + column.name not in answers)


def constants(kind: Kind, answers: Answers, rows: int) -> dict[str, np.ndarray]:
    """The columns of a kind that have one value by an answer, each checked by the rules of its column."""
    columns = {}
    for column in kind.columns:
        key = VALUES + column.name
        if key in answers:
            if f"import.columns.{column.name}" in answers:
                raise InputError("has a header too; give one of the two", where=key, value=answers[key])
            columns[column.name] = np.full(rows, column.parse(str(answers[key]), key))
    return columns


def _or_one_value(column: str) -> str:
    """How to answer for a column that has the same value in all rows."""
    return f"; or {VALUES}{column}=... if all rows have the same"


def has_header(header: str, column: str) -> bool:
    """Whether a header is the name of a column, with blanks or hyphens for its underscores.

    >>> has_header("Pinion surface", "pinion_surface"), has_header("pinion", "pinion_surface")
    (True, False)
    """
    return header.strip().lower().replace(" ", "_").replace("-", "_") == column.lower()


COLUMNS = "import.columns."
UNIT_KEYS = "import.units."
OF_READINGS = ("mean", "average", "avg", "median", "value", "measured", "nominal", "actual", "set")
"""Last words of a header that are no unit."""
COUNTS = ("fringe_order",)
"""Columns without a unit."""
AMBIGUOUS = 0.1
"""Difference of likeness up to which another header is listed as equally likely: judgement."""


@dataclass(frozen=True)
class Match:
    """Headers and units to convert from by column, open questions, notes on choices, warnings of unused columns."""

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
    """Every column that a case of a kind may hold, except ``run``."""
    check = answers.get("recording.check")
    return (
        *kind.columns,
        *kind.instrument_channels,
        Column(quantity),
        sd_column(quantity),
        *BOOKKEEPING,
        *([check_column(str(check))] if check else []),
    )


def target_for(column: str) -> Target | None:
    """Unit and words of a column; the standard deviation of a reading has the unit of the reading."""
    reading = column.removesuffix("_sd")
    target = BY_NAME.get(reading)
    return target if target is None or reading == column else replace(target, name=column, spoken=())


def import_keys(columns: Sequence[Column]) -> tuple[str, ...]:
    """The answers that match headers to these columns."""
    return (
        f"{COLUMNS}run",
        *(COLUMNS + c.name for c in columns),
        *(UNIT_KEYS + c.name for c in columns if target_for(c.name) is not None),
        *PACE_KEYS,
    )


def match(kind: Kind, quantity: str, cells: Cells, answers: Answers) -> Match:
    """Headers and units of the columns of a case; a needed column with no header or several becomes a question."""
    columns = without_value(wanted(kind, quantity, answers), answers)
    named = {c.name: _named_header(c.name, cells, answers) for c in columns if COLUMNS + c.name in answers}
    matched = _Matched(headers=dict(named))
    reserved = set(named.values())
    free = {h: values for h, values in cells.items() if h not in reserved}
    filled = {h: values for h, values in free.items() if not all(map(is_missing, values))}
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
    matched.questions.extend(spare_questions(spare, COLUMNS))
    asked = {q.key.removeprefix(COLUMNS) for q in matched.questions}
    _refuse_idle_units({*matched.headers, *asked}, answers)
    units, questions, notes = _units(matched.headers, answers)
    ordered = {c.name: matched.headers[c.name] for c in columns if c.name in matched.headers}
    questions += pace_questions(matched.headers, units, answers)
    warned = tuple(spare_notes(spare, COLUMNS))
    return Match(ordered, units, (*matched.questions, *questions), (*matched.notes, *notes), warned)


def _named_header(column: str, cells: Cells, answers: Answers) -> str:
    header = str(answers[COLUMNS + column])
    where = COLUMNS + column
    if header not in cells:
        raise InputError(f"no such header; {nearest(header, cells)}", where=where, value=header)
    if is_logarithm(header):
        raise InputError("is a logarithm; add a column of the quantity itself", where=where, value=header)
    if column.startswith("viscosity_mPa_s") and "kinematic" in words_of(header).split():
        rule = "is a kinematic viscosity; add a column of it times the density: mm²/s times g/cm³ is mPa s"
        raise InputError(rule, where=where, value=header)
    return header


def _find_header(column: Column, cells: Cells, matched: _Matched) -> None:
    """The header of a column, by name or by the words of instruments; an optional column takes the first of several."""
    exact = [h for h in cells if _is_named(h, column.name)]
    if exact:
        matched.headers[column.name] = exact[0]
        return
    spoken = [h for h in cells if _speaks_of(h, column.name)]
    if column.dtype != "name":
        order = {words: place for place, words in enumerate(BY_NAME[column.name].spoken)} if spoken else {}
        # A time of day, or a column of remarks, may have the words of a number.
        numeric = [h for h in spoken if is_numeric(cells[h])]
        spoken = sorted(numeric or spoken, key=lambda h: order.get(words_of(h), -1))
    if not spoken:
        return
    differing = [h for h in spoken if (split(h)[1], cells[h]) != (split(spoken[0])[1], cells[spoken[0]])]
    if differing and column.required:
        text = f"Header of the column that holds {column.name}, as more than one could"
        among = (spoken[0], *differing)
        matched.questions.append(Question(COLUMNS + column.name, text, toml_value(spoken[0]), options=among))
        return
    matched.headers[column.name] = spoken[0]
    if differing:
        others = ", ".join(map(repr, differing))
        matched.notes.append(
            f"{spoken[0]!r} taken as {column.name}, not {others}; {COLUMNS}{column.name} names another"
        )


def _find_count(cells: Cells, matched: _Matched) -> None:
    """The header that counts cycles or a distance; a question where another may hold the time itself."""
    header = header_of_count(cells)
    if header is None or COLUMNS + TIME in {question.key for question in matched.questions}:
        return
    times = headers_in_time({h: v for h, v in cells.items() if h not in matched.headers.values()})
    if times:
        text = f"Header of the column that holds {TIME}, or counts cycles or a distance instead"
        matched.questions.append(Question(COLUMNS + TIME, text, toml_value(times[0]), options=(*times, header)))
    else:
        matched.headers[TIME] = header


def _speaks_of(header: str, column: str) -> bool:
    """Whether a header has the words of a column, and no unit of another quantity.

    An unknown unit may be meant for this column: it is refused later, with the possible ones.

    >>> [_speaks_of(h, "friction_coefficient") for h in ("mu", "mu [%]", "mu [mPa s]", "mu [cSt]", "mu [Vs]")]
    [True, True, False, False, True]
    """
    target, unit = target_of(header), split(header)[1]
    if target is None or target.name != column:
        return False
    return unit is None or fits(unit, target_in(target, unit).unit) or not is_of_another(unit, target)


def _is_named(header: str, column: str) -> bool:
    """Whether a header is the column's own name; with a unit, capitals distinguish milli from mega."""
    return header == column or (target_for(column) is None and has_header(header, column))


def _one_of(group: tuple[str, ...], named: set[str], matched: _Matched) -> None:
    """Of columns that exclude each other the one that an answer names, else a question."""
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
    """Headers similar to needed columns: unused ones, else one that was taken for an optional column."""
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
        rivals = _equally_likely(column, header, free)
        text = f"Header of the column that holds {column}{rivals}{_two_speeds(column, cells)}{refused}"
        text += "; one that counts cycles or a distance will do" if column == TIME else ""
        others = [] if header else transmitted(column, free)
        if others:
            text += f"; not proposed: {', '.join(others)}, as by its words none of these is one; where it is their "
            text += "difference, add a column of that to the file"
        text += _or_one_value(column) if column in TEXT_COLUMNS else ""
        example = toml_value(header or "HEADER")
        question = Question(COLUMNS + column, text, example, options=tuple(cells), options_intro="the file has")
        questions.append(replace(question, offered=header is not None and not rivals))
        target = target_for(column)
        if header is None or target is None or header == column or UNIT_KEYS + column in answers:
            continue
        unit = _header_unit(column, header)
        if unit is None or open_units(unit, target.unit):
            questions.append(_unit_question(column, header, target))
    return questions


def _offered(cells: Cells, headers: Mapping[str, str]) -> Cells:
    """Unused headers, without the speeds of single surfaces."""
    free = {h: values for h, values in cells.items() if h not in headers.values()}
    return {h: values for h, values in free.items() if other_surface(h, cells) is None}


def _two_speeds(column: str, cells: Cells) -> str:
    """The reason why the speeds of two surfaces are not offered."""
    single = [h for h in cells if other_surface(h, cells) is not None] if column in FROM_BOTH_SPEEDS else []
    made = FROM_BOTH_SPEEDS.get(column, "").removesuffix(" with that of").removesuffix(" to that of")
    return f"; {', '.join(single)}: speeds of single surfaces, {made}, add a column of it" if single else ""


def _spare(kind: Kind, quantity: str, cells: Cells, matched: _Matched) -> dict[str, str]:
    """Headers similar to optional columns that were not found."""
    open_keys = {q.key.removeprefix(COLUMNS) for q in matched.questions}
    possible = (*kind.columns, *kind.instrument_channels)
    absent = [
        c for c in possible if not c.required and c.name not in {*matched.headers, *open_keys, *either(kind.name)}
    ]
    offered = {question.example for question in matched.questions}
    free = {h: v for h, v in _offered(cells, matched.headers).items() if toml_value(h) not in offered}
    near = spare_headers(absent, free)
    reading, sd = matched.headers.get(quantity), f"{quantity}_sd"
    spread = None if reading is None or sd in matched.headers else likely_spread(quantity, reading, free)
    return near if spread is None else {**near, sd: spread}


def _equally_likely(column: str, header: str | None, free: Cells) -> str:
    """Other headers as similar to a column as the one that is offered."""
    if header is None:
        return ""
    least = likeness(column, header, free[header]) - AMBIGUOUS
    others = [h for h in free if h != header and likeness(column, h, free[h]) >= least]
    return f"; equally likely: {', '.join(others)}" if others else ""


def _refuse_idle_units(columns: Set[str], answers: Answers) -> None:
    """An error about a unit that its column cannot have, or whose column is not taken."""
    for key, unit in answers.items():
        column = key.removeprefix(UNIT_KEYS)
        target = target_for(column)
        if not key.startswith(UNIT_KEYS) or target is None:
            continue
        target = target_in(target, str(unit))
        if change_to(str(unit), target.unit) is None:
            raise InputError(unknown_unit(str(unit), target), where=key, value=unit)
        if "kind" in answers and column not in columns:
            raise InputError(f"no column is taken as {column}; name its header by {COLUMNS}{column}", where=key)


def _units(headers: Mapping[str, str], answers: Answers) -> tuple[dict[str, str], list[Question], list[str]]:
    """Units by column, by answer or by header; a question where both lack it."""
    units: dict[str, str] = {}
    questions: list[Question] = []
    notes: list[str] = []
    for column, header in headers.items():
        target = target_for(column)
        if target is None or column in TEXT_COLUMNS:
            continue
        named = _is_named(header, column)
        header_unit = None if named else _header_unit(column, header)
        native = named or column in COUNTS
        unit = answers.get(UNIT_KEYS + column)
        if unit is not None:
            units[column] = str(unit)
            if (native and change_to(str(unit), target.unit) != (1.0, 0.0)) or header_unit not in (None, str(unit)):
                notes.append(f"{header!r} is taken to be in {unit}, as answered, whatever its header names")
        elif header_unit is not None and not open_units(header_unit, target.unit):
            units[column] = header_unit
        elif not native:
            questions.append(_unit_question(column, header, target))
        weight = WEIGHED.get(tidy(units.get(column, "")).lower())
        if weight is not None:
            notes.append(f"{header!r} is taken to be a load in {weight}")
    return units, questions, notes


def _header_unit(column: str, header: str) -> str | None:
    return unit_of_count(header) if column == TIME else split(header)[1]


def _unit_question(column: str, header: str, target: Target) -> Question:
    """An example unit is given where the last word of the header is no unit; it may be an unknown one."""
    text = f"Unit of the column {header!r}, taken as {column}"
    candidates = open_units(split(header)[1] or "", target.unit)
    if candidates:
        return Question(
            UNIT_KEYS + column, f"{text}, whose header is ambiguous", toml_value("UNIT"), options=candidates
        )
    units = units_of(target.unit)
    if column == TIME:
        first = counted(header)
        units = tuple(u for f in sorted((target.unit, *PACES), key=lambda f: f != first) for u in units_of(f))
    words = words_of(header).split()
    spoken = {
        w for form in (*BY_NAME[column.removesuffix("_sd")].spoken, column.replace("_", " ")) for w in form.split()
    }
    sure = (
        len(words) == 1
        or counted(header) is not None
        or words[-1] in (*spoken, *OF_READINGS)
        or bool(re.fullmatch(r"[#\d]+", words[-1]))
    )
    return Question(UNIT_KEYS + column, text, toml_value(units[0] if sure else "UNIT"), options=units)
