"""A friction coefficient that a table holds as two forces: the friction force over the load."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS, UNIT_KEYS, VALUES
from mixedlub.importers.base import Answers
from mixedlub.importers.likeness import likely_headers, spread_of
from mixedlub.importers.text_table import Cells, Sheet, TextColumn, is_numeric, values_of
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.schema.units import change_to, split, words_of

COEFFICIENT, LOAD = "friction_coefficient", "load_N"
FRICTION = re.compile(r"\b(?:friction|tangential|traction|reib)")
"""Words of a force that is friction."""


def over_load(sheet: Sheet, answers: Answers) -> tuple[Sheet, Answers, str]:
    """The table with the coefficient in place of the friction force, what is then answered, and a note.

    All as they are, without a note, where the table has a coefficient, or not one friction force and one load in units
    of force.
    """
    force = _friction_force(sheet.cells, answers)
    load = None if force is None else _load(sheet, force, answers)
    if force is None or load is None:
        return sheet, answers, ""
    loads, words = load
    newtons = convert(values_of(sheet.cells[force]), _unit(force, COEFFICIENT, answers), BY_NAME[LOAD], force)
    # Bodies that do not touch have no coefficient; loads that are all negative are refused as such later.
    touching = loads > 0.0 if np.any(loads > 0.0) else loads != 0.0
    share = np.divide(newtons, loads, out=np.full(newtons.shape, np.nan), where=touching)
    column = TextColumn("" if np.isnan(value) else repr(value) for value in share.tolist())
    cells = {(COEFFICIENT if h == force else h): (column if h == force else v) for h, v in sheet.cells.items()}
    others = {key: v for key, v in answers.items() if key not in (COLUMNS + COEFFICIENT, UNIT_KEYS + COEFFICIENT)}
    return replace(sheet, cells=cells), others, f"{COEFFICIENT} is {force!r} over {words}"


def _unit(header: str, column: str, answers: Answers) -> str:
    """The unit of a force, by answer or by header; empty where neither tells one."""
    unit = str(answers.get(UNIT_KEYS + column) or split(header)[1] or "")
    return unit if unit and change_to(unit, "N") is not None else ""


def _friction_force(cells: Cells, answers: Answers) -> str | None:
    """The header of the friction force; None where there are several, or a coefficient."""
    named = answers.get(COLUMNS + COEFFICIENT)
    spoken = [h for h in cells if FRICTION.search(words_of(h)) and spread_of(h) is None] if named is None else [named]
    forces = [h for h in spoken if h in cells and is_numeric(cells[h]) and _unit(h, COEFFICIENT, answers)]
    if len(forces) != 1:
        return None
    others = {h: values for h, values in cells.items() if h != forces[0]}
    return forces[0] if named is not None or not likely_headers([COEFFICIENT], others) else None


def _load(sheet: Sheet, force: str, answers: Answers) -> tuple[np.ndarray, str] | None:
    """The load of each row in newtons, and what it is called; None where no header or several may be it."""
    constant: Any = answers.get(VALUES + LOAD)
    if isinstance(constant, int | float):
        return np.full(len(sheet.lines), float(constant)), f"the load of {constant:g} N"
    others = {h: values for h, values in sheet.cells.items() if h != force and is_numeric(values)}
    named = answers.get(COLUMNS + LOAD)
    headers: Sequence[Any] = [h for h in others if target_of(h) == BY_NAME[LOAD]] if named is None else [named]
    headers = headers or list(likely_headers([LOAD], others).values())
    loads = [h for h in headers if h in others and _unit(h, LOAD, answers)]
    if len(loads) != 1:
        return None
    return convert(values_of(others[loads[0]]), _unit(loads[0], LOAD, answers), BY_NAME[LOAD], loads[0]), repr(loads[0])
