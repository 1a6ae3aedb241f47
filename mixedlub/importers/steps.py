"""Steps of a file of PCS Instruments rigs: their type, their start, their columns of numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime

import numpy as np

from mixedlub.importers.sheet import count, is_number, places
from mixedlub.importers.vocabulary import BY_NAME, convert, target_of
from mixedlub.schema.table import is_missing
from mixedlub.schema.units import rounded, split
from profiles.errors import InputError

STEP = re.compile(r'^Step (\d+)(?: "[^"]*")? started at (\d\d/\d\d/\d{4} \d\d:\d\d(?::\d\d)?)')
TYPE = re.compile(r"^Step type\t([^\t]*)(?:\tStep description\t([^\t]*))?")
MOSTLY = 0.5
"""Share of the cells that a column must hold to be one."""
TIMED = "TIMED"
"""How the types of steps end in which conditions are held."""
VARIES = 0.2
"""Share of its largest value over which most of a condition that is swept extends."""


@dataclass(frozen=True)
class Step:
    """One step with readings: its type, its start, its columns by header (nan where one is missing), its lines."""

    number: int
    form: str
    start: datetime
    columns: dict[str, np.ndarray]
    lines: tuple[int, ...]

    def header(self, target: str) -> str | None:
        """The header that means a column; of several the later, more precise one, but one without gaps first."""
        exact = [h for h in self.columns if (t := target_of(h)) is not None and t.name == target]
        return max(exact, key=lambda h: (int(np.isfinite(self.columns[h]).sum()), exact.index(h)), default=None)

    def has(self, target: str) -> bool:
        """Whether a column is there."""
        return self.header(target) is not None

    def whole(self, target: str) -> bool:
        """Whether a column is there without gaps."""
        header = self.header(target)
        return header is not None and bool(np.isfinite(self.columns[header]).all())

    def read(self, target: str, name: str) -> np.ndarray:
        """A column in the unit of a case."""
        header = self.header(target)
        assert header is not None
        unit = split(header)[1] or ("-" if BY_NAME[target].unit == "ratio" else None)
        if unit is None:
            raise InputError("header without a unit", where=f"{name}: step {self.number}", value=header)
        return convert(self.columns[header], unit, BY_NAME[target], f"{name}: {header}")

    def varies(self, target: str) -> bool:
        """Whether a condition is swept."""
        header = self.header(target)
        if header is None or self.form.endswith(TIMED):
            return False
        values = self.columns[header]
        low, high = np.nanquantile(values, (0.1, 0.9))
        return bool(high - low > VARIES * np.nanmax(np.abs(values)))

    def since(self, first: datetime, name: str) -> np.ndarray:
        """Seconds of the readings since the start of the first step."""
        before = (self.start - first).total_seconds()
        return rounded(before + self.read("time_s", name), before)


def steps_of(text: str, name: str) -> tuple[Step, ...]:
    """The steps that hold readings."""
    found: list[Step] = []
    number, start, form = 0, None, ""
    lines = iter(enumerate(text.splitlines(), start=1))
    for place, line in lines:
        if begun := STEP.match(line):
            number, start = int(begun.group(1)), _moment(begun.group(2))
        elif typed := TYPE.match(line):
            form = typed.group(1).strip().upper()
        elif start is not None and _is_header(line):
            rows = {}
            for at, row in lines:
                if not row.strip():
                    break
                rows[at] = row.split("\t")
            if rows:
                columns = _columns(line, list(rows.values()), f"{name}: line {place}")
                found.append(Step(number, form, start, columns, tuple(rows)))
    return tuple(found)


def without_gaps(steps: tuple[Step, ...], targets: Sequence[str], name: str) -> tuple[tuple[Step, ...], list[str]]:
    """The steps less the readings that lack one of the columns, and a line for every column that has gaps."""
    gaps: dict[str, list[int]] = {}
    found = []
    for step in steps:
        kept = np.ones(len(step.lines), dtype=bool)
        for header in filter(None, map(step.header, targets)):
            there = np.isfinite(step.columns[header])
            kept &= there
            gaps.setdefault(header, []).extend(np.array(step.lines)[~there].tolist())
        columns = {h: values[kept] for h, values in step.columns.items()}
        found.append(replace(step, columns=columns, lines=tuple(np.array(step.lines)[kept].tolist())))
    notes = [
        f"{count(len(lines), 'row')} left out, as {header!r} is missing: {places(lines)}"
        for header, lines in gaps.items()
        if lines
    ]
    whole = tuple(step for step in found if step.lines)
    if not whole:
        raise InputError(f"no reading is complete: {'; '.join(notes)}", where=name)
    return whole, notes


def _moment(text: str) -> datetime:
    return datetime.strptime(text, "%d/%m/%Y %H:%M:%S" if text.count(":") == 2 else "%d/%m/%Y %H:%M")


def _is_header(line: str) -> bool:
    cells = line.split("\t")
    return len(cells) > 5 and sum("(" in cell for cell in cells) > 5


def _columns(header: str, rows: list[list[str]], where: str) -> dict[str, np.ndarray]:
    """Columns that hold numbers; of a header that comes twice the later, more precise one."""
    found: dict[str, np.ndarray] = {}
    for i, name in enumerate(header.split("\t")):
        cells = [row[i] if i < len(row) else "" for row in rows]
        if not name.strip() or not all(is_missing(cell) or is_number(cell) for cell in cells):
            continue
        values = np.array([np.nan if is_missing(cell) else float(cell) for cell in cells])
        values[~np.isfinite(values)] = np.nan
        before = found.get(name.strip(), np.array([]))
        held = int(np.isfinite(values).sum())
        if held > MOSTLY * len(rows) and held >= int(np.isfinite(before).sum()):
            found[name.strip()] = values
    if not found:
        raise InputError("a table without a complete column of numbers", where=where)
    return found
