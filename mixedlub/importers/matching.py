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
from mixedlub.importers.surface_speeds import MADE, other_surface
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
    found = {}
    for column in kind.columns:
        key = VALUES + column.name
        if key in answers:
            if f"import.columns.{column.name}" in answers:
                raise InputError("has a header too; give one of the two", where=key, value=answers[key])
            found[column.name] = np.full(rows, column.parse(str(answers[key]), key))
    return found


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
class _Finding:
    """Headers, questions and notes found so far."""

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
    found = BY_NAME.get(reading)
    return found if found is None or reading == column else replace(found, name=column, spoken=())


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
    found = _Finding(headers=dict(named))
    reserved = set(named.values())
    free = {h: values for h, values in cells.items() if h not in reserved}
    held = {h: values for h, values in free.items() if not all(map(is_missing, values))}
    for column in columns:
        if column.name not in named:
            _find(column, free if column.required else held, found)
        if column.name == TIME and column.required and column.name not in found.headers:
            _find_count(held, found)
    _one_of(either(kind.name), set(named), found)
    _absent_check(answers.get("recording.check"), cells, found.headers)
    open_keys = {q.key for q in found.questions}
    missing = [
        c.name for c in columns if c.required and c.name not in found.headers and COLUMNS + c.name not in open_keys
    ]
    group = either(kind.name)
    if group and not any(c in found.headers or COLUMNS + c in open_keys or VALUES + c in answers for c in group):
        missing.append(next(iter(likely_headers(group, _offered(cells, found.headers))), group[0]))
    needed = {*named, *(c.name for c in columns if c.required)}
    kept = {c: h for c, h in found.headers.items() if c in needed}
    near = _near(missing, cells, found.headers, kept)
    found.headers = {c: h for c, h in found.headers.items() if c in kept or h not in near.values()}
    found.questions.extend(_missing(missing, near, cells, found.headers, answers))
    spare = {c: h for c, h in _spare(kind, quantity, held, found).items() if VALUES + c not in answers}
    found.questions.extend(spare_questions(spare, COLUMNS))
    open_ones = {q.key.removeprefix(COLUMNS) for q in found.questions}
    _refuse_idle_units({*found.headers, *open_ones}, answers)
    units, questions, notes = _units(found.headers, answers)
    ordered = {c.name: found.headers[c.name] for c in columns if c.name in found.headers}
    questions += pace_questions(found.headers, units, answers)
    warned = tuple(spare_notes(spare, COLUMNS))
    return Match(ordered, units, (*found.questions, *questions), (*found.notes, *notes), warned)


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


def _find(column: Column, cells: Cells, found: _Finding) -> None:
    """The header of a column, by name or by the words of instruments; an optional column takes the first of several."""
    own = [h for h in cells if _is_named(h, column.name)]
    if own:
        found.headers[column.name] = own[0]
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
        found.questions.append(Question(COLUMNS + column.name, text, toml_value(spoken[0]), among=among))
        return
    found.headers[column.name] = spoken[0]
    if differing:
        others = ", ".join(map(repr, differing))
        found.notes.append(f"{spoken[0]!r} taken as {column.name}, not {others}; {COLUMNS}{column.name} names another")


def _find_count(cells: Cells, found: _Finding) -> None:
    """The header that counts cycles or a distance; a question where another may hold the time itself."""
    header = header_of_count(cells)
    if header is None or COLUMNS + TIME in {question.key for question in found.questions}:
        return
    times = headers_in_time({h: v for h, v in cells.items() if h not in found.headers.values()})
    if times:
        text = f"Header of the column that holds {TIME}, or counts cycles or a distance instead"
        found.questions.append(Question(COLUMNS + TIME, text, toml_value(times[0]), among=(*times, header)))
    else:
        found.headers[TIME] = header


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


def _one_of(group: tuple[str, ...], named: set[str], found: _Finding) -> None:
    """Of columns that exclude each other the one that an answer names, else a question."""
    present = [c for c in group if c in found.headers]
    chosen = [c for c in present if c in named]
    if len(present) < 2 or len(chosen) > 1:
        return
    for column in present:
        if column not in chosen:
            header = found.headers.pop(column)
            if not chosen and column == present[0]:
                text = f"Which to take: a case has one of {' and '.join(present)}; name its header by {COLUMNS}COLUMN"
                found.questions.append(Question(COLUMNS + column, text, toml_value(header)))


def _absent_check(check: Any, cells: Cells, headers: Mapping[str, str]) -> None:
    if check and str(check) not in headers:
        raise InputError(f"no such header; {nearest(str(check), cells)}", where="recording.check", value=check)


def _near(missing: Sequence[str], cells: Cells, headers: Mapping[str, str], kept: Mapping[str, str]) -> dict[str, str]:
    """Headers similar to needed columns: unused ones, else one that was taken for an optional column."""
    near = likely_headers(missing, _offered(cells, headers))
    lent = {h: values for h, values in _offered(cells, kept).items() if h not in near.values()}
    return {**likely_headers([c for c in missing if c not in near], lent), **near}


def _missing(
    missing: Sequence[str], near: Mapping[str, str], cells: Cells, headers: Mapping[str, str], answers: Answers
) -> list[Question]:
    free = _offered(cells, headers)
    logarithms = [h for h in free if is_logarithm(h)]
    refused = (
        f"; {', '.join(logarithms)}: a logarithm cannot be taken, add a column of the quantity" if logarithms else ""
    )
    questions = []
    for column in missing:
        header = near.get(column)
        rivals = _equally_likely(column, header, free)
        text = f"Header of the column that holds {column}{rivals}{_two_speeds(column, cells)}{refused}"
        text += "; one that counts cycles or a distance will do" if column == TIME else ""
        others = [] if header else transmitted(column, free)
        if others:
            text += f"; not proposed: {', '.join(others)}, as by its words none of these is one; where it is their "
            text += "difference, add a column of that to the file"
        text += _or_one_value(column) if column in TEXT_COLUMNS else ""
        example = toml_value(header or "HEADER")
        question = Question(COLUMNS + column, text, example, among=tuple(cells), of="the file has")
        questions.append(replace(question, offered=header is not None and not rivals))
        target = target_for(column)
        if header is None or target is None or header == column or UNIT_KEYS + column in answers:
            continue
        unit = _own_unit(column, header)
        if unit is None or open_units(unit, target.unit):
            questions.append(_unit_question(column, header, target))
    return questions


def _offered(cells: Cells, headers: Mapping[str, str]) -> Cells:
    """Unused headers, without the speeds of single surfaces."""
    free = {h: values for h, values in cells.items() if h not in headers.values()}
    return {h: values for h, values in free.items() if other_surface(h, cells) is None}


def _two_speeds(column: str, cells: Cells) -> str:
    """The reason why the speeds of two surfaces are not offered."""
    single = [h for h in cells if other_surface(h, cells) is not None] if column in MADE else []
    made = MADE.get(column, "").removesuffix(" with that of").removesuffix(" to that of")
    return f"; {', '.join(single)}: speeds of single surfaces, {made}, add a column of it" if single else ""


def _spare(kind: Kind, quantity: str, cells: Cells, found: _Finding) -> dict[str, str]:
    """Headers similar to optional columns that were not found."""
    open_keys = {q.key.removeprefix(COLUMNS) for q in found.questions}
    own = (*kind.columns, *kind.instrument_channels)
    absent = [c for c in own if not c.required and c.name not in {*found.headers, *open_keys, *either(kind.name)}]
    offered = {question.example for question in found.questions}
    free = {h: v for h, v in _offered(cells, found.headers).items() if toml_value(h) not in offered}
    near = spare_headers(absent, free)
    reading, sd = found.headers.get(quantity), f"{quantity}_sd"
    spread = None if reading is None or sd in found.headers else likely_spread(quantity, reading, free)
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
        own = None if named else _own_unit(column, header)
        native = named or column in COUNTS
        unit = answers.get(UNIT_KEYS + column)
        if unit is not None:
            units[column] = str(unit)
            if (native and change_to(str(unit), target.unit) != (1.0, 0.0)) or own not in (None, str(unit)):
                notes.append(f"{header!r} is taken to be in {unit}, as answered, whatever its header names")
        elif own is not None and not open_units(own, target.unit):
            units[column] = own
        elif not native:
            questions.append(_unit_question(column, header, target))
        weight = WEIGHED.get(tidy(units.get(column, "")).lower())
        if weight is not None:
            notes.append(f"{header!r} is taken to be a load in {weight}")
    return units, questions, notes


def _own_unit(column: str, header: str) -> str | None:
    return unit_of_count(header) if column == TIME else split(header)[1]


def _unit_question(column: str, header: str, target: Target) -> Question:
    """An example unit is given where the last word of the header is no unit; it may be an unknown one."""
    text = f"Unit of the column {header!r}, taken as {column}"
    meant = open_units(split(header)[1] or "", target.unit)
    if meant:
        return Question(UNIT_KEYS + column, f"{text}, whose header is ambiguous", toml_value("UNIT"), among=meant)
    known = units_of(target.unit)
    if column == TIME:
        first = counted(header)
        known = tuple(u for f in sorted((target.unit, *PACES), key=lambda f: f != first) for u in units_of(f))
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
    return Question(UNIT_KEYS + column, text, toml_value(known[0] if sure else "UNIT"), among=known)
