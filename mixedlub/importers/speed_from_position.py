"""Speed as the derivative of a position or angle over time."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from mixedlub.importers.base import Answers, Question, read_note
from mixedlub.importers.cell_columns import Cells, NumberColumn, is_numeric, values_of
from mixedlub.importers.text_table import Sheet
from mixedlub.importers.time_base import TIME
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.running.shell import quoted
from mixedlub.schema.findings import Finding
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import change_to, rounded, split, words_of
from profiles.errors import InputError, nearest

SPEED_FROM = "import.speed_from"
"""Key of the header of the position that is differentiated."""
SPEEDS = {"m": ("sliding_speed_m_s", 1.0), "deg": ("speed_rpm", 1.0 / 6.0)}
"""Column of the derivative and its size for one unit per second, by the unit of the position."""
FROM_POSITION = tuple(column for column, _ in SPEEDS.values())
PURE_SLIDING = 2.0
"""Definition. Slide-roll ratio of a body that slides on one at rest; their mean speed is half the sliding speed."""
NO_PLACE = re.compile(r"wear|track|width|diameter|thickness|film|roughness|depth|verschleiß|breite|dicke")
"""Words of lengths that are no position of a body."""


def _measure(header: str) -> str | None:
    unit = split(header)[1] or ""
    return next((measure for measure in SPEEDS if change_to(unit, measure) is not None), None)


def positions(cells: Cells) -> list[str]:
    """Headers of possible positions over time; empty without a time.

    >>> positions({"Time (s)": ["0", "1"], "Position (mm)": ["0", "5"], "Wear (mm)": ["0", "0"]})
    ['Position (mm)', 'Wear (mm)']
    """
    if _time(cells) is None:
        return []
    return [h for h, values in cells.items() if _measure(h) and is_numeric(values)]


def speed_question(kind: str, free: Collection[str], cells: Cells) -> list[Question]:
    """Offer of the change of a position as the speed of a history without one."""
    places = [h for h in positions(cells) if h in free and _measure(h) == "m" and not NO_PLACE.search(words_of(h))]
    if kind != "friction_history" or not places:
        return []
    text = "Position whose change over the time is the speed of one body that slides on the other at rest"
    return [Question(SPEED_FROM, text, toml_value(places[0]), needed=False, options=tuple(places))]


def offer_note(question: Question) -> str:
    """Offer in words, with its setting."""
    setting = quoted(f"{question.key}={question.example}")
    return f"{question.example.strip(chr(34))!r} is not taken; its change over the time is the speed by --set {setting}"


def _time(cells: Cells) -> str | None:
    return next((h for h, v in cells.items() if target_of(h) == BY_NAME[TIME] and split(h)[1] and is_numeric(v)), None)


def with_speed(sheet: Sheet, kind: str | None, answers: Answers) -> tuple[Sheet, list[Finding]]:
    """Table with the speed derived from an answered position, by central differences.

    In a history one body slides on the other at rest, so the entrainment speed is half of the speed.
    """
    header = answers.get(SPEED_FROM)
    if header is None:
        return sheet, []
    if header not in positions(sheet.cells):
        rule = "needs a position or an angle with its unit, and a time with its unit in the table"
        raise InputError(f"{rule}; {nearest(str(header), positions(sheet.cells))}", where=SPEED_FROM, value=header)
    time = str(_time(sheet.cells))
    measure = str(_measure(header))
    column, size = SPEEDS[measure]
    factor, _ = change_to(str(split(header)[1]), measure) or (1.0, 0.0)
    place = factor * values_of(sheet.cells[header])
    seconds = convert(values_of(sheet.cells[time]), str(split(time)[1]), BY_NAME[TIME], time)
    known = np.isfinite(place) & np.isfinite(seconds)
    if known.sum() < 2 or np.any(np.diff(seconds[known]) <= 0.0):
        raise InputError(f"needs a time that rises from row to row; {time!r} does not", where=SPEED_FROM, value=header)
    speed = np.full(place.shape, np.nan)
    speed[known] = size * np.gradient(place[known], seconds[known])
    made: dict[str, np.ndarray] = {column: speed}
    if kind == "friction_history":
        if measure != "m" or (not np.all(speed[known] > 0.0) and not np.all(speed[known] < 0.0)):
            rule = "stops or turns, and the speed of a history must be above 0 in every row"
            raise InputError(rule, where=SPEED_FROM, value=header)
        made = {"entrainment_speed_m_s": 0.5 * np.abs(speed), "slide_roll_ratio": np.full(speed.size, PURE_SLIDING)}
        column = "the sliding speed, twice entrainment_speed_m_s,"
    cells = {**sheet.cells, **{name: NumberColumn(rounded(values)) for name, values in made.items()}}
    note = f"{column} is the change of {header!r} over {time!r}, between the rows before and after"
    return replace(sheet, cells=cells), [read_note(note, sheet.name)]
