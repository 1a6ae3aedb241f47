"""Plain tables: one header line, any of the usual separators."""

from __future__ import annotations

import csv

import numpy as np

from mixedlub.config import KINDS
from mixedlub.importers.columns import BY_NAME, UNITS, Target, convert, split, target_of
from mixedlub.importers.draft import Answers, Draft, Question, questions_of
from mixedlub.kinds import kind as kind_of
from profiles.errors import InputError, nearest

TEXT_COLUMNS = ("rig", "setup", "surface_1", "surface_2", "pinion_surface", "gear_surface")


def matches(text: str) -> bool:
    """Any text may be a table."""
    return True


def draft(text: str, name: str, answers: Answers) -> Draft:
    """A case from a table: kind and quantity are asked, columns by their headers, units where a header has none."""
    cells = _cells(text, name)
    kind = answers.get("kind")
    if kind is None:
        words = ", ".join(KINDS)
        return Draft(None, None, {}, {}, (Question("kind", f"Kind of recording, one of {words}", '"film"'),))
    if kind not in KINDS:
        raise InputError(f"no such kind; {nearest(str(kind), KINDS)}", where="kind", value=kind)
    rules = kind_of(kind)
    quantity = answers.get("recording.quantity")
    if quantity is None and len(rules.quantities) == 1:
        quantity = rules.quantities[0]
    if quantity is None:
        text = f"Recorded quantity, one of {', '.join(rules.quantities)}"
        return Draft(kind, None, {}, {}, (Question("recording.quantity", text, f'"{rules.quantities[0]}"'),))
    columns: dict[str, np.ndarray] = {}
    questions: list[Question] = []
    wanted = [*(c.name for c in rules.columns), quantity, f"{quantity}_sd", "rig", "sequence", "setup"]
    needed = {c.name for c in rules.columns if c.required} | {quantity}
    for column in wanted:
        header = _header(column, cells, answers, kind)
        if header is None:
            if column in needed:
                text = f"Header of the column that holds {column}; the file has {', '.join(cells)}"
                questions.append(Question(f"import.columns.{column}", text, f'"{next(iter(cells))}"'))
            continue
        found = _values(column, header, cells[header], answers, name)
        if isinstance(found, Question):
            questions.append(found)
        else:
            columns[column] = found
    return Draft(kind, quantity, columns, {}, (*questions, *questions_of(kind)), _notes(name, cells, columns))


def _notes(name: str, cells: dict[str, list[str]], columns: dict[str, np.ndarray]) -> tuple[str, ...]:
    return (f"{name}: {len(columns)} of {len(cells)} columns taken: {', '.join(columns)}",)


def _cells(text: str, name: str) -> dict[str, list[str]]:
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise InputError("needs a header line and at least one row", where=name)
    separator = max("\t;,", key=lines[0].count)
    rows = list(csv.reader(lines, delimiter=separator))
    header = [cell.strip() for cell in rows[0]]
    wrong = next((i for i, row in enumerate(rows[1:], start=2) if len(row) != len(header)), None)
    if wrong is not None:
        raise InputError(f"has not as many cells as the header ({len(header)})", where=f"{name}: line {wrong}")
    decimal_comma = separator != ","
    return {
        h: [_point(row[i]) if decimal_comma else row[i].strip() for row in rows[1:]] for i, h in enumerate(header) if h
    }


def _point(cell: str) -> str:
    """A number with a decimal comma as one with a point; one with both is left to fail."""
    cell = cell.strip()
    return cell.replace(",", ".") if cell.count(",") == 1 and "." not in cell else cell


def _header(column: str, cells: dict[str, list[str]], answers: Answers, kind: str) -> str | None:
    told = answers.get(f"import.columns.{column}")
    if told is not None:
        if told not in cells:
            raise InputError(
                f"no such header; {nearest(str(told), cells)}", where=f"import.columns.{column}", value=told
            )
        return str(told)
    if column in cells:
        return column
    for header in cells:
        target = target_of(header)
        if target is not None and target.name == column:
            return header
    return None


def _values(column: str, header: str, cells: list[str], answers: Answers, name: str) -> np.ndarray | Question:
    if column in TEXT_COLUMNS:
        return np.array(cells)
    try:
        values = np.array([float(cell) for cell in cells])
    except ValueError:
        bad = next(c for c in cells if not _is_number(c))
        raise InputError("is not a number", where=f"{name}: {header}", value=bad) from None
    target: Target | None = BY_NAME.get(column)
    if target is None or header == column:
        return values
    unit = answers.get(f"import.units.{column}") or split(header)[1]
    if unit is None and target.unit != "ratio":
        known = ", ".join(UNITS[target.unit])
        text = f"Unit of the column {header!r}, taken as {column}: one of {known}"
        return Question(f"import.units.{column}", text, f'"{next(iter(UNITS[target.unit]))}"')
    if unit is None:
        text = f"Is the column {header!r}, taken as {column}, a ratio (-) or per cent (%)"
        return Question(f"import.units.{column}", text, '"-"')
    return convert(values, str(unit), target, f"{name}: {header}")


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
