"""The table in a text file: its separator, its header, a line of units, and what stands before and after it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from mixedlub.importers.marks import Line, with_points
from mixedlub.importers.rows import rows_of
from mixedlub.schema.table import is_missing
from mixedlub.schema.units import is_unit, split
from profiles.errors import InputError

Cells = Mapping[str, list[str]]
SHOWN = 5
"""Lines that a note lists at most."""
COUNTED = ("nr", "nr.", "no", "no.", "#", "n", "lfd. nr.", "lfd.nr.")
"""What stands for a unit, in small letters, where a column counts the rows."""


@dataclass(frozen=True)
class Sheet:
    """The cells of a file by header, the line each row stands in, and which lines are no part of the table."""

    name: str
    cells: Cells
    lines: tuple[int, ...]
    left_out: str = ""


def read_sheet(text: str, name: str, decimal: str | None = None) -> Sheet:
    """The longest table of a text: rows of equal length under a header without numbers.

    What an instrument writes before and after it is left out; a row of another length amid rows is an error.
    ``decimal`` is the mark before decimals where the file's numbers do not tell.
    """
    numbered = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    rows = [line for line in rows_of(numbered) if any(line[1])]
    if len(rows) < 2:
        raise InputError("needs a header line and at least one row", where=name)
    rows = with_points(rows, name, decimal)
    first, last = _extent(rows, name)
    above = first - 1
    header = rows[above][1]
    if above and _are_units(header, rows[above - 1][1]):
        above -= 1
        units = [unit.strip("()[]") for unit in header]
        header = [f"{word} ({unit})" if unit else word for word, unit in zip(rows[above][1], units, strict=True)]
    table = rows[first:last]
    cells = {h: [row[i] for _, row in table] for i, h in enumerate(_told_apart(header)) if h}
    parts = [part for part in (_range(rows[:above]), _range(rows[last:])) if part]
    return Sheet(name, cells, tuple(number for number, _ in table), " and ".join(parts))


def whole(sheet: Sheet, needed: Sequence[str]) -> tuple[Sheet, list[str]]:
    """The rows in which no needed cell is left out, and a line for every header by which rows are lost."""
    lost = {h: [i for i, cell in enumerate(sheet.cells[h]) if is_missing(cell)] for h in needed}
    if not any(lost.values()):
        return sheet, []
    gone = {i for rows in lost.values() for i in rows}
    if len(gone) == len(sheet.lines):
        most = max(lost, key=lambda h: len(lost[h]))
        raise InputError(f"no row is complete: {most!r} is missing in {len(lost[most])} of them", where=sheet.name)
    kept = [i for i in range(len(sheet.lines)) if i not in gone]
    cells = {h: [values[i] for i in kept] for h, values in sheet.cells.items()}
    notes = [
        f"{count(len(rows), 'row')} left out, as {h!r} is missing: {places([sheet.lines[i] for i in rows])}"
        for h, rows in lost.items()
        if rows
    ]
    return replace(sheet, cells=cells, lines=tuple(sheet.lines[i] for i in kept)), notes


def count(number: int, thing: str) -> str:
    """A number of things in words.

    >>> count(1, "row"), count(3, "row")
    ('1 row', '3 rows')
    """
    return f"{number} {thing}" + ("" if number == 1 else "s")


def places(lines: Sequence[int]) -> str:
    """Numbers of lines in words.

    >>> places([14]), places([3, 9]), places(list(range(2, 20)))
    ('line 14', 'lines 3, 9', 'lines 2, 3, 4, 5, 6 and 13 more')
    """
    more = f" and {len(lines) - SHOWN} more" if len(lines) > SHOWN else ""
    return ("line " if len(lines) == 1 else "lines ") + ", ".join(map(str, lines[:SHOWN])) + more


def not_above_zero(quantity: str, values: Iterable[float], lines: Iterable[int]) -> list[str]:
    """What is said of readings that only noise, or a channel that is not on yet, can bring to zero or below.

    >>> not_above_zero("friction_coefficient", [0.0, 0.1], [2, 3])
    ['1 reading of friction_coefficient at zero or below, taken as read: line 2']
    """
    low = [line for line, value in zip(lines, values, strict=True) if value <= 0.0]
    said = f"{count(len(low), 'reading')} of {quantity} at zero or below, taken as read: {places(low)}"
    return [said] if low else []


def _extent(rows: Sequence[Line], name: str) -> tuple[int, int]:
    """First row of data and the end of it: the longest run of rows as long as the header before them."""
    best = (0, 0)
    for i in range(1, len(rows)):
        header, row = rows[i - 1][1], rows[i][1]
        if len(header) != len(row) or not _are_words(header) or not _numbers(row):
            continue
        end = i
        while end < len(rows) and len(rows[end][1]) == len(header) and not _is_header(rows[end][1]):
            end += 1
        if end - i > best[1] - best[0]:
            best = (i, end)
    if not best[1]:
        if _numbers(rows[0][1]) == len(rows[0][1]) and _numbers(rows[1][1]):
            raise InputError("no header: the first line holds numbers only; name the columns above it", where=name)
        best = (1, len(rows))
    first, last = best
    width = len(rows[first - 1][1])
    _refuse_other_rows(rows[: first - 1], rows[last:], width, name)
    for number, row in rows[first:last]:
        if len(row) != width:
            raise InputError(_uneven(width), where=f"{name}: line {number}")
    return first, last


def _refuse_other_rows(before: Sequence[Line], after: Sequence[Line], width: int, name: str) -> None:
    """Rows of numbers beside the table are data that would be lost: a row of another length, or another table."""
    if any(_numbers(row) > 1 for _, row in after):
        number, row = after[0]
        rule = _uneven(width) if len(row) != width else "begins another table; put one table in a file"
        raise InputError(rule, where=f"{name}: line {number}")
    lost = [number for number, row in before if _numbers(row) > 1]
    if len(lost) > 1:
        rule = "holds other rows of numbers before its longest table; put one table in a file"
        raise InputError(rule, where=f"{name}: lines {lost[0]} to {lost[-1]}")


def _uneven(width: int) -> str:
    return f"has not as many cells as the header ({width})"


def _are_words(cells: Sequence[str]) -> bool:
    """Whether a line could be a header: some words and no numbers."""
    return sum(bool(cell) for cell in cells) > 1 and not _numbers(cells)


def _is_header(cells: Sequence[str]) -> bool:
    return _are_words(cells) and not all(is_missing(cell) for cell in cells)


def _numbers(cells: Sequence[str]) -> int:
    return sum(is_number(cell) for cell in cells)


def is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def are_numbers(cells: Sequence[str]) -> bool:
    """Whether a column is one of numbers, beside cells that are left out.

    >>> are_numbers(["1", "n/a", "2"]), are_numbers(["1", "stuck"]), are_numbers(["", ""])
    (True, False, False)
    """
    present = [cell for cell in cells if not is_missing(cell)]
    return all(map(is_number, present)) and (bool(present) or not cells)


def _are_units(cells: Sequence[str], words: Sequence[str]) -> bool:
    """Whether a line names units of the words above it, at least one that is known; one cell may count the rows.

    A new unit stands in brackets, or among twice as many that are known under a line that names every column.
    """
    if len(cells) != len(words):
        return False
    named = [cell for cell in cells if cell and cell.lower() not in COUNTED]
    known = sum(is_unit(cell.strip("()[]")) for cell in named)
    new = sum(not is_unit(cell.strip("()[]")) and not _in_brackets(cell) for cell in named)
    every = all(word and not is_unit(word) for word, cell in zip(words, cells, strict=True) if cell)
    return known > 2 * new and (every or new == 0)


def _in_brackets(cell: str) -> bool:
    return (cell[0], cell[-1]) in (("(", ")"), ("[", "]"))


def _told_apart(header: Sequence[str]) -> list[str]:
    """Headers that stand twice get their place among those alike."""
    seen: dict[str, int] = {}
    found = []
    for h in header:
        seen[h] = seen.get(h, 0) + 1
        words, unit = split(h)
        again = h if seen[h] == 1 else f"{words} #{seen[h]}" + (f" ({unit})" if unit else "")
        while h and again in found:
            again = f"{again} #{seen[h]}"
        found.append(again)
    return found


def _range(rows: Sequence[Line]) -> str:
    if not rows:
        return ""
    low, high = rows[0][0], rows[-1][0]
    return f"line {low}" if low == high else f"lines {low} to {high}"
