"""Rows of different things in one table: one of them kept where told, a warning where they would be pooled."""

from __future__ import annotations

import csv
import re
import shlex
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.importers.dates import is_dated
from mixedlub.importers.draft import Answers
from mixedlub.importers.sheet import Cells, Sheet, are_numbers, is_number
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table, is_missing
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import split, words_of
from profiles.errors import InputError, nearest

ONLY = "import.only."
"""Before the name of a header, the value of the rows to keep, or a list of values."""
THINGS = re.compile(
    r"(?:drive|driving|sample|specimen|oil|grease|lubricant|fluid|blend|batch|lot|rig|machine|bench|motor|gearbox|"
    r"gear|actuator|bearing|device|unit|serial|material|coating|pair|pairing|group|series|kind|type|probe|antrieb|"
    r"öl|fett|werkstoff|charge|id|no|nr|number|name|code|label|#)\.?"
)
COUNTING = re.compile(
    r"samples|(?:repeat|repetition|replicate|rep|run|point|index|cycle|step|segment|order|count|no|nr|n|#)s?\.?"
)
"""Words of a column that counts readings of one thing."""
MOST = 20
"""Different values up to which a column names things rather than readings."""
SHOWN = 3


def only_keys(answers: Answers) -> tuple[str, ...]:
    """The answers that keep rows, and the form they have."""
    return (f"{ONLY}COLUMN", *(key for key in answers if key.startswith(ONLY)))


def kept(sheet: Sheet, answers: Answers) -> tuple[Sheet, list[str]]:
    """The rows that the answers keep, and what is said of it."""
    notes = []
    for key, value in answers.items():
        if not key.startswith(ONLY):
            continue
        header = key.removeprefix(ONLY).strip('"')
        if header not in sheet.cells:
            raise InputError(f"no such header; {nearest(header, sheet.cells)}", where=key)
        wanted = value if isinstance(value, list) else [value]
        rows = [i for i, cell in enumerate(sheet.cells[header]) if any(_is(cell, one) for one in wanted)]
        if not rows:
            rule = f"stands in no row; the column has {_listed(sheet.cells[header], MOST)}"
            raise InputError(rule, where=key, value=value)
        said = ", ".join(map(str, wanted))
        notes.append(f"{len(rows)} of {len(sheet.lines)} rows kept, those with {header} {said}")
        cells = {h: [values[i] for i in rows] for h, values in sheet.cells.items()}
        sheet = replace(sheet, cells=cells, lines=tuple(sheet.lines[i] for i in rows))
    return sheet, notes


def pooled(free: Cells, conditions: Collection[np.ndarray], file: str) -> Iterator[Finding]:
    """A finding for every column that nothing is taken from and that tells things apart whose rows are then pooled.

    ``free`` are the columns that nothing is taken from, ``conditions`` those under which the rows were read.
    """
    for header, cells in _telling_apart(free, conditions):
        value = toml_value(cells[0]) if not is_number(cells[0]) and re.search(r"[^\w-]", cells[0]) else cells[0]
        setting = shlex.quote(f"{ONLY}{header}={value}")
        text = f"{header!r} is not taken, so {_pooled(cells)}; to import one of them, say --set {setting}"
        yield finding("things_pooled", text, file)


def pooled_in(path: Path, table: Table, quantity: str) -> Iterator[Finding]:
    """The same of the columns of a case's table that are not read."""
    with path.open(encoding="utf-8-sig", newline="") as file:
        rows = [row for row in csv.reader(file) if any(cell.strip() for cell in row)]
    cells = {h.strip(): [cell.strip() for cell in values] for h, *values in zip(*rows, strict=True)}
    conditions = [v for name, v in table.columns.items() if name not in ("run", "sequence", quantity, f"{quantity}_sd")]
    for header, values in _telling_apart({h: cells[h] for h in table.ignored}, conditions):
        advice = "keep the rows of one, or tell them apart in a column setup"
        yield finding("things_pooled", f"{header!r} is not read, so {_pooled(values)}: {advice}", path.name)


def _telling_apart(free: Cells, conditions: Collection[np.ndarray]) -> Iterator[tuple[str, Sequence[str]]]:
    """The columns that tell things apart, less those of which another tells more."""
    found = {h: cells for h, cells in free.items() if _few(h, cells) and _tells_things(h, cells, conditions)}
    for header, cells in found.items():
        if not any(_tells_more(other, cells) for h, other in found.items() if h != header):
            yield header, cells


def _pooled(cells: Sequence[str]) -> str:
    return f"rows of {len(set(cells))} different things are pooled ({_listed(cells, SHOWN)})"


def _is(cell: str, value: Any) -> bool:
    return cell == str(value) or (is_number(cell) and is_number(str(value)) and float(cell) == float(value))


def _listed(cells: Sequence[str], most: int) -> str:
    values = list(dict.fromkeys(cells))
    return ", ".join(values[:most]) + (", ..." if len(values) > most else "")


def _few(header: str, cells: Sequence[str]) -> bool:
    """Whether a column holds few names or whole numbers that come again, and no unit, date or gap."""
    values = set(cells)
    if split(header)[1] is not None or not 1 < len(values) <= min(MOST, len(cells) // 2):
        return False
    if any(is_missing(value) or is_dated(value) for value in values):
        return False
    return not are_numbers(cells) or all(float(value).is_integer() for value in values)


def _tells_things(header: str, cells: Sequence[str], conditions: Collection[np.ndarray]) -> bool:
    """Whether a column is named as things are, or most conditions that come again do so for more than one value."""
    words = words_of(header).split()
    if all(map(COUNTING.fullmatch, words)):
        return False
    if all(map(THINGS.fullmatch, words)):
        return True
    points: dict[tuple[Any, ...], list[str]] = {}
    for row, cell in enumerate(cells):
        points.setdefault(tuple(values[row] for values in conditions), []).append(cell)
    again = [len(set(values)) > 1 for values in points.values() if len(values) > 1]
    return 2 * sum(again) > len(again)


def _tells_more(other: Sequence[str], cells: Sequence[str]) -> bool:
    """Whether each value of the other column goes with one of this one's, and it has more of them."""
    return len(set(other)) > len(set(cells)) and len(set(zip(other, cells, strict=True))) == len(set(other))
