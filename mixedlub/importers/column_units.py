"""Units of imported columns: from an answer, the header or the column name, or else by a question."""

from __future__ import annotations

import re
from collections.abc import Mapping, Set
from dataclasses import replace

from mixedlub.importers.answer_keys import COLUMNS, UNIT_KEYS, UNKNOWN_UNIT
from mixedlub.importers.base import Answers, Question
from mixedlub.importers.time_base import PACES, TIME, counted, target_in, unit_of_count
from mixedlub.importers.vocabulary import BY_NAME, TEXT_COLUMNS, WEIGHED, Target, unknown_unit
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import change_to, open_units, split, tidy, units_of, words_of
from profiles.errors import InputError

OF_READINGS = ("mean", "average", "avg", "median", "value", "measured", "nominal", "actual", "set")
"""Last words of a header that are not a unit."""
FORCE = re.compile(r"force|kraft|kräfte")
"""Words of a friction force."""
COUNTS = ("fringe_order",)
"""Columns without a unit."""


def target_for(column: str) -> Target | None:
    """Unit and words of a column; a standard deviation has the unit of its reading."""
    reading = column.removesuffix("_sd")
    target = BY_NAME.get(reading)
    return target if target is None or reading == column else replace(target, name=column, spoken=())


def has_header(header: str, column: str) -> bool:
    """Whether a header is the name of a column, apart from capitals and blanks or hyphens for underscores.

    >>> has_header("Pinion surface", "pinion_surface"), has_header("pinion", "pinion_surface")
    (True, False)
    """
    return header.strip().lower().replace(" ", "_").replace("-", "_") == column.lower()


def is_named(header: str, column: str) -> bool:
    """Whether a header is the exact name of a column; capitals are ignored without a unit (milli and mega)."""
    return header == column or (target_for(column) is None and has_header(header, column))


def refuse_idle_units(columns: Set[str], answers: Answers) -> None:
    """Raise an error for a unit that does not fit its column or belongs to no imported column."""
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


def taken_units(headers: Mapping[str, str], answers: Answers) -> tuple[dict[str, str], list[Question], list[str]]:
    """Units by column, from answer or header; a question if both are missing."""
    units: dict[str, str] = {}
    questions: list[Question] = []
    notes: list[str] = []
    for column, header in headers.items():
        target = target_for(column)
        if target is None or column in TEXT_COLUMNS:
            continue
        named = is_named(header, column)
        header_unit = None if named else header_unit_of(column, header)
        native = named or column in COUNTS
        unit = answers.get(UNIT_KEYS + column)
        if unit is not None:
            units[column] = str(unit)
            if (native and change_to(str(unit), target.unit) != (1.0, 0.0)) or header_unit not in (None, str(unit)):
                notes.append(f"{header!r} is taken to be in {unit}, as answered, whatever its header names")
        elif header_unit is not None and not open_units(header_unit, target.unit):
            units[column] = header_unit
        elif not native:
            questions.append(unit_question(column, header, target))
        weight = WEIGHED.get(tidy(units.get(column, "")).lower())
        if weight is not None:
            notes.append(f"{header!r} is taken to be a load in {weight}")
    return units, questions, notes


def header_unit_of(column: str, header: str) -> str | None:
    return unit_of_count(header) if column == TIME else split(header)[1]


def unit_question(column: str, header: str, target: Target) -> Question:
    """Question on a unit, with an example if the last word of the header is not a unit; it may be an unknown unit."""
    text = f"Unit of the column {header!r}, taken as {column}"
    candidates = open_units(split(header)[1] or "", target.unit)
    if candidates:
        return Question(UNIT_KEYS + column, f"{text}, whose header is ambiguous", UNKNOWN_UNIT, options=candidates)
    units = units_of(target.unit)
    if column == "friction_coefficient" and FORCE.search(words_of(header)):
        text += "; of a force, with the unit of the load, force divided by load is taken"
        units = (*units, *units_of("N"))
    if target.unit == "mPa_s":
        units = (*units, *units_of("mm2_s"))
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
    return Question(UNIT_KEYS + column, text, toml_value(units[0]) if sure else UNKNOWN_UNIT, options=units)
