"""Entrainment speed, slide-roll ratio and sliding speed from the speeds of two surfaces, or of two turning bodies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS, VALUES
from mixedlub.importers.base import Answers, Question, read_note
from mixedlub.importers.cell_columns import Cells, NumberColumn, is_numeric, values_of
from mixedlub.importers.surface_speeds import TURNING, other_surface, turning
from mixedlub.importers.text_table import Sheet
from mixedlub.importers.vocabulary import BY_NAME, target_of
from mixedlub.kinds import Kind
from mixedlub.schema.findings import Finding
from mixedlub.schema.units import change_to, fits, rounded, split
from profiles.errors import InputError

RADII = "import.running_radius_mm"
"""Key of the two radii at which the bodies touch, from their axes."""
MEAN, RATIO, SLIDING = "entrainment_speed_m_s", "slide_roll_ratio", "sliding_speed_m_s"
MADE = {MEAN: "the mean of {0}", RATIO: "the difference of {0} over their mean", SLIDING: "the difference of {0}"}


@dataclass(frozen=True)
class Made:
    """Table with the derived columns, the question on the radii with the columns that it replaces, and notes."""

    sheet: Sheet
    questions: tuple[Question, ...] = ()
    replaced: tuple[str, ...] = ()
    notes: tuple[Finding, ...] = field(default=())


def with_both_speeds(sheet: Sheet, kind: Kind, answers: Answers) -> Made:
    """Table with the speeds of the contact, where the speeds of both surfaces are recorded and these are not."""
    possible = {column.name: column for column in kind.columns}
    absent = [c for c in MADE if c in possible and not _is_given(c, sheet.cells, answers)]
    if not absent:
        return Made(sheet)
    pair = _pair(sheet.cells)
    radii = _radii(answers)
    bodies = [] if pair else turning(sheet.cells)[:2]
    if len(bodies) == 2 and radii is None:
        needed = any(possible[c].required for c in absent) or set(absent) & set(kind.either) == set(kind.either)
        text = f"Radii (mm) from the axes to the contact, as {bodies[0]!r} and {bodies[1]!r} are speeds of turning "
        text += f"bodies: {TURNING}"
        question = Question(RADII, text, "[20.0, 20.0]", needed, placeholder="[RADIUS, RADIUS]")
        return Made(sheet, (question,), tuple(COLUMNS + c for c in absent))
    if pair:
        first, second = (_speed(sheet.cells, header) for header in pair)
        words = " and ".join(map(repr, pair))
    elif len(bodies) == 2 and radii is not None:
        first, second = (
            np.pi / 30e3 * radius * _speed(sheet.cells, header) for header, radius in zip(bodies, radii, strict=True)
        )
        words = f"{bodies[0]!r} and {bodies[1]!r} at radii of {radii[0]:g} and {radii[1]:g} mm"
    else:
        return Made(sheet)
    how = ""
    if np.nanmax(first * second) < 0.0:
        second, how = -second, ", whose opposite signs are those of bodies that turn against each other"
    with np.errstate(divide="ignore", invalid="ignore"):
        values = {
            MEAN: (first + second) / 2.0,
            SLIDING: first - second,
            RATIO: 2.0 * (first - second) / (first + second),
        }
    values[RATIO] = np.where(np.isfinite(values[RATIO]), values[RATIO], np.nan)
    cells = {**sheet.cells, **{c: NumberColumn(rounded(values[c])) for c in absent}}
    notes = [read_note(f"{c} is {MADE[c].format(words)}{how}", sheet.name) for c in absent]
    return Made(replace(sheet, cells=cells), notes=tuple(notes))


def _is_given(column: str, cells: Cells, answers: Answers) -> bool:
    """Whether a header or an answer gives the column."""
    if COLUMNS + column in answers or VALUES + column in answers:
        return True
    named = [h for h in cells if (found := target_of(h)) is not None and found.name == column and is_numeric(cells[h])]
    return any((unit := split(h)[1]) is None or fits(unit, BY_NAME[column].unit) for h in named)


def _pair(cells: Cells) -> list[str]:
    """Headers of the speeds of both surfaces, in metres a second or the like."""
    for header in cells:
        other = other_surface(header, cells)
        if other is not None and change_to(split(header)[1] or "", "m_s") is not None:
            return [header, other]
    return []


def _speed(cells: Mapping[str, Any], header: str) -> np.ndarray:
    """Speeds of a column in m/s, or in 1/min."""
    unit = split(header)[1] or ""
    factor, _ = change_to(unit, "m_s") or change_to(unit, "rpm") or (1.0, 0.0)
    return factor * values_of(cells[header])


def _radii(answers: Answers) -> tuple[float, float] | None:
    """Running radii (mm) from their answer, or else the finite radii of the contact."""
    given = answers.get(RADII)
    if given is None:
        contact = answers.get("contact.radius_mm")
        if not isinstance(contact, list) or len(contact) != 2 or not np.all(np.isfinite(contact)):
            return None
        return float(contact[0]), float(contact[1])
    is_pair = isinstance(given, list) and len(given) == 2 and all(isinstance(one, int | float) for one in given)
    if not is_pair or not all(0.0 < one < np.inf for one in given):
        raise InputError("must be two radii in mm, such as [20.0, 25.4]", where=RADII, value=given)
    return float(given[0]), float(given[1])
