"""Friction coefficient from the friction force and load of a table."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS, UNIT_KEYS, VALUES
from mixedlub.importers.base import Answers, read_note
from mixedlub.importers.cell_columns import Cells, TextColumn, is_numeric, values_of
from mixedlub.importers.likeness import likely_headers, likely_spread, spare_notes, spread_of
from mixedlub.importers.text_table import Sheet
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import change_to, split, words_of

COEFFICIENT, SD, LOAD = "friction_coefficient", "friction_coefficient_sd", "load_N"
FRICTION = re.compile(r"\b(?:friction|tangential|traction|reib)")
"""Words of a friction force."""
NORMAL = re.compile(r"normal ?(?:force|load|kraft)\b")
"""First words of a load, which a symbol may follow."""
LEAST_LOAD = 0.01
"""Judgement. Load over the median load below which bodies do not touch and the load cell shows noise."""


def over_load(sheet: Sheet, answers: Answers) -> tuple[Sheet, Answers, list[Finding]]:
    """Table with the coefficient in place of the friction force, remaining answers, and notes.

    An answered standard deviation of the force is divided too. Without change or notes if the table has a coefficient,
    or not exactly one friction force and one load in units of force.
    """
    force = _friction_force(sheet.cells, answers)
    load = None if force is None else _load(sheet, force, answers)
    if force is None or load is None:
        return sheet, answers, []
    loads, words = load
    forces = {COEFFICIENT: force}
    in_force = {h: v for h, v in sheet.cells.items() if h != force and is_numeric(v) and _unit(h, SD, answers)}
    spread = answers.get(COLUMNS + SD)
    if spread in in_force:
        forces[SD] = str(spread)
    columns = {h: (c, _divided(sheet, h, _unit(h, c, answers), loads)) for c, h in forces.items()}
    cells = dict(columns.get(h, (h, values)) for h, values in sheet.cells.items())
    told = {key + column for key in (COLUMNS, UNIT_KEYS) for column in forces}
    others = {key: v for key, v in answers.items() if key not in told}
    notes = [read_note(f"{column} is {h!r} divided by {words}", sheet.name) for column, h in forces.items()]
    likely = None if spread else likely_spread(replace(BY_NAME[COEFFICIENT], unit="N"), force, in_force)
    left = {} if likely is None else {SD: likely}
    notes += [finding("column_not_taken", text, sheet.name) for text in spare_notes(left)]
    return replace(sheet, cells=cells), others, notes


def _divided(sheet: Sheet, header: str, unit: str, loads: np.ndarray) -> TextColumn:
    """Force over load, empty in rows without load."""
    newtons = convert(values_of(sheet.cells[header]), unit, BY_NAME[LOAD], header)
    # Loads that are all negative are refused as such later.
    pressed = loads[loads > 0.0]
    touching = loads >= LEAST_LOAD * np.median(pressed) if pressed.size else loads != 0.0
    share = np.divide(newtons, loads, out=np.full(newtons.shape, np.nan), where=touching)
    return TextColumn("" if np.isnan(value) else repr(value) for value in share.tolist())


def _unit(header: str, column: str, answers: Answers) -> str:
    """Unit of a force from answer or header, or empty."""
    unit = str(answers.get(UNIT_KEYS + column) or split(header)[1] or "")
    return unit if unit and change_to(unit, "N") is not None else ""


def _friction_force(cells: Cells, answers: Answers) -> str | None:
    """Header of the friction force; None if it is not unique or the table has a coefficient."""
    named = answers.get(COLUMNS + COEFFICIENT)
    spoken = [h for h in cells if FRICTION.search(words_of(h)) and spread_of(h) is None] if named is None else [named]
    forces = [h for h in spoken if h in cells and is_numeric(cells[h]) and _unit(h, COEFFICIENT, answers)]
    if len(forces) != 1:
        return None
    others = {h: values for h, values in cells.items() if h != forces[0]}
    return forces[0] if named is not None or not likely_headers([COEFFICIENT], others) else None


def _load(sheet: Sheet, force: str, answers: Answers) -> tuple[np.ndarray, str] | None:
    """Load of each row (N) and its name; None without a unique header."""
    constant: Any = answers.get(VALUES + LOAD)
    if isinstance(constant, int | float):
        return np.full(len(sheet.lines), float(constant)), f"the load of {constant:g} N"
    others = {h: values for h, values in sheet.cells.items() if h != force and is_numeric(values)}
    named = answers.get(COLUMNS + LOAD)
    headers = (
        [h for h in others if target_of(h) == BY_NAME[LOAD] or NORMAL.match(words_of(h))] if named is None else [named]
    )
    loads = [h for h in headers if h in others and _unit(h, LOAD, answers)]
    if len(loads) != 1:
        return None
    return convert(values_of(others[loads[0]]), _unit(loads[0], LOAD, answers), BY_NAME[LOAD], loads[0]), repr(loads[0])
