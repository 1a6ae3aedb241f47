"""Tables in text: separator, header, units, rows and run numbers."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.importers.base import Answers
from mixedlub.importers.cell_columns import Cells, TextColumn, missing_rows, taken
from mixedlub.importers.decimals import Line, common_length, is_written_number, with_points
from mixedlub.importers.header import header_of
from mixedlub.importers.odd_rows import cleared, count, places, without_repeated_headers, without_summaries
from mixedlub.schema.cells import csv_rows, is_missing, is_number
from mixedlub.schema.findings import listed
from mixedlub.schema.table import LARGEST
from mixedlub.schema.units import words_of
from profiles.errors import InputError, nearest
from profiles.readers.workbook import UNCALCULATED
from profiles.units import number_of

SEPARATORS = "\t;,"
UNIT = r"[(\[](?:[^()\[\]]|/\s*\([^()\[\]]*\))*[)\]]"
WORD = re.compile(rf"(?:{UNIT}|\S)+")
WORD_AND_UNIT = re.compile(rf"(?:\s*{UNIT}|\S)+")
WORDS = re.compile(r"\S+(?:\s\S+)*")
"""Cell between blanks: a word, a word and its unit, or words with single blanks between."""


def rows_of(numbered: Sequence[tuple[int, str]], name: str, separator: str = "") -> list[Line]:
    """Cells of numbered lines; blanks separate only if they give more rows of numbers than any separator."""
    mark = separator or max(SEPARATORS, key=lambda mark: _regularity([line.count(mark) for _, line in numbered]))
    marked = [(number, [cell.strip() for cell in row]) for number, row in csv_rows(numbered, name, mark, headings=True)]
    if separator or not any(_tally(line.split())[0] for _, line in numbered if len(line.split(None, 1)) > 1):
        return marked
    blank = _by_blanks(numbered)
    return blank if _readable(blank) > _readable(marked) else marked


def _regularity(counts: list[int]) -> int:
    """Number of lines with the most common count of a separator; on a tie the comma may be a decimal mark."""
    return max(Counter(n for n in counts if n).values(), default=0)


def with_header(rows: Sequence[Line], lines: Mapping[int, str]) -> list[Line]:
    """Rows with the header split at blanks, if only the numbers below have separators.

    >>> lines = {1: "Time Load", 2: "0\\t20", 3: "1\\t21"}
    >>> with_header([(1, ["Time Load"]), (2, ["0", "20"]), (3, ["1", "21"])], lines)[0]
    (1, ['Time', 'Load'])
    """
    width = common_length([row for _, row in rows])
    first = next((i for i, (_, row) in enumerate(rows) if len(row) == width > 1 and _tally(row)[0]), 0)
    if first == 0:
        return list(rows)
    number, above = rows[first - 1]
    ways = [form.findall(lines[number]) for form in (WORD, WORD_AND_UNIT, WORDS)]
    words = next((way for way in ways if len(way) == width), None)
    if len(above) > 1 or words is None or any(map(is_number, words)):
        return list(rows)
    return [*rows[: first - 1], (number, [word.strip() for word in words]), *rows[first:]]


def _by_blanks(numbered: Sequence[tuple[int, str]]) -> list[Line]:
    """Rows of numbers split at blanks; other lines are split into equally many cells if possible."""
    plain = [line.split() for _, line in numbered]
    width = common_length([row for row in plain if _tally(row)[0]])
    rows = []
    for (number, line), row in zip(numbered, plain, strict=True):
        if len(row) != width or "(" in line or "[" in line:
            ways = [form.findall(line) for form in (WORD, WORD_AND_UNIT, WORDS)]
            row = next((way for way in ways if len(way) == width), ways[0])
        rows.append((number, [cell.strip() for cell in row]))
    return rows


def _readable(rows: Sequence[Line]) -> tuple[int, int]:
    """Numbers of rows of the most common length with only numbers, and with mostly numbers."""
    tallies = [(len(row), *_tally(row)) for _, row in rows]
    mostly = Counter(length for length, most, _ in tallies if most)
    width, n_rows = max(mostly.items(), key=lambda item: item[1], default=(0, 0))
    return sum(every for length, _, every in tallies if length == width), n_rows


def _tally(row: Sequence[str]) -> tuple[bool, bool]:
    """Whether a row holds mostly numbers, at least two; whether it holds only numbers."""
    numbers = sum(map(is_written_number, row))
    filled = sum(map(bool, row))
    most = numbers > 1 and 2 * numbers > filled
    return most, most and numbers == filled


TABLE = "import.table"
"""Key of the number of the table to read, where a text has several."""
ONLY = "import.only."
"""Prefix of a header in the answer with the value, or list of values, of the rows to keep."""
VALUES_LISTED = 20
"""Most values of a column listed in an error."""
NUMBERS_SHOWN = 3
"""Most numbers of a header listed in an error."""


@dataclass(frozen=True)
class Sheet:
    """Cells of a table by header, line of each row, lines outside the table, and notes.

    ``repeated``: text on repeated headers; ``summaries``: text on omitted rows of means or sums; ``faults``: cells with
    a spreadsheet error or an infinite number, by header and line, which are empty in ``cells``. ``tables``: lines and
    first headers of every table of a text with several.
    """

    name: str
    cells: Cells
    lines: tuple[int, ...]
    left_out: str = ""
    notes: tuple[str, ...] = ()
    repeated: str = ""
    summaries: str = ""
    faults: Mapping[str, Mapping[int, str]] = field(default_factory=dict)
    tables: tuple[str, ...] = ()


def read_sheet(
    text: str, name: str, decimal: str | None = None, separator: str = "", number: int | None = None
) -> Sheet:
    """Longest table of a text: rows of equal length under a header without numbers.

    Lines before and after the table are left out; a row of another length within it is an error. ``decimal``: decimal
    mark from an answer; ``separator``: separator of cells, if known; ``number``: of several tables, from 1.
    """
    numbered = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    every = with_header([line for line in rows_of(numbered, name, separator) if any(line[1])], dict(numbered))
    rows, repeated = without_repeated_headers(every)
    if len(rows) < 2:
        raise InputError("needs a header line and at least one row", where=name)
    rows, notes = with_points(rows, name, decimal)
    tables = [(i, end) for i, end in _tables(rows) if end - i > 1 and all(_numbers(row) > 1 for _, row in rows[i:end])]
    if number is not None and not 1 <= number <= max(len(tables), 1):
        raise InputError(f"must be a table of {name}, from 1 to {max(len(tables), 1)}", where=TABLE, value=number)
    before, after = (0, len(rows)) if len(tables) < 2 else _surroundings(tables, number, len(rows))
    first, last = (before + row for row in _table_rows(rows[before:after], name))
    header, n_lines = header_of([row for _, row in rows[before:first]])
    above = first - n_lines
    table, summaries = without_summaries(rows[first:last])
    lines = tuple(number for number, _ in table)
    cells = {h: TextColumn(row[i] for _, row in table) for i, h in enumerate(header) if h}
    faults = {h: found for h, column in cells.items() if (found := cleared(column, lines))}
    parts = [part for part in (_range(rows[:above]), _range(rows[last:])) if part]
    described = tuple(_described(rows, *one) for one in tables) if len(tables) > 1 else ()
    return Sheet(name, cells, lines, " and ".join(parts), tuple(notes), repeated, summaries, faults, described)


def complete_rows(sheet: Sheet, needed: Sequence[str]) -> tuple[Sheet, list[str]]:
    """Rows without missing cells in the needed columns, and a note for every column that loses rows."""
    missing = {h: missing_rows(sheet.cells[h]) for h in needed}
    if not any(missing.values()):
        return sheet, []
    incomplete = {i for rows in missing.values() for i in rows}
    if len(incomplete) == len(sheet.lines):
        most = max(missing, key=lambda h: len(missing[h]))
        rule = f"no row is complete: {most!r} is missing in {len(missing[most])} of them"
        raise InputError(rule + _faults_of(sheet, most), where=sheet.name)
    complete = [i for i in range(len(sheet.lines)) if i not in incomplete]
    cells = {h: taken(values, complete) for h, values in sheet.cells.items()}
    notes = [
        f"{count(len(rows), 'row')} left out, as {h!r} is missing: {places([sheet.lines[i] for i in rows])}"
        + _faults_of(sheet, h)
        for h, rows in missing.items()
        if rows
    ]
    return replace(sheet, cells=cells, lines=tuple(sheet.lines[i] for i in complete)), notes


def _faults_of(sheet: Sheet, header: str) -> str:
    """Text on cells without a number, and a remedy."""
    texts = list(dict.fromkeys(sheet.faults.get(header, {}).values()))
    if UNCALCULATED in texts:
        return (
            "; it holds formulas whose values the file lacks: open it in Excel or LibreOffice and save it, then they "
            "are calculated"
        )
    return f"; there is {', '.join(map(repr, texts[:NUMBERS_SHOWN]))} in its place" if texts else ""


def only_keys(answers: Answers) -> tuple[str, ...]:
    """Keys of the answers that select rows, and their form."""
    return (f"{ONLY}COLUMN", *(key for key in answers if key.startswith(ONLY)))


def selected_rows(sheet: Sheet, answers: Answers) -> tuple[Sheet, list[str]]:
    """Rows selected by the answers, and a note on each selection."""
    notes = []
    for key, value in answers.items():
        if not key.startswith(ONLY):
            continue
        header = key.removeprefix(ONLY).strip('"')
        if header not in sheet.cells:
            raise InputError(f"no such header; {nearest(header, sheet.cells)}", where=key)
        wanted = value if isinstance(value, list) else [value]
        rows = [i for i, cell in enumerate(sheet.cells[header]) if any(_cell_equals(cell, one) for one in wanted)]
        if not rows:
            values = list(dict.fromkeys(sheet.cells[header]))
            listed = ", ".join(values[:VALUES_LISTED]) + (", ..." if len(values) > VALUES_LISTED else "")
            raise InputError(f"is in no row; the column has {listed}", where=key, value=value)
        names = ", ".join(map(str, wanted))
        notes.append(f"{len(rows)} of {len(sheet.lines)} rows kept, those with {header} {names}")
        cells = {h: taken(values, rows) for h, values in sheet.cells.items()}
        sheet = replace(sheet, cells=cells, lines=tuple(sheet.lines[i] for i in rows))
    return sheet, notes


def _cell_equals(cell: str, value: Any) -> bool:
    """Whether a cell equals the value of an answer or lies in its range.

    >>> [_cell_equals(cell, "273..400") for cell in ("300", "680", "hot")], _cell_equals("20.0", 20)
    ([True, False, False], True)
    """
    low, dots, high = str(value).partition("..")
    if dots and all(not end or is_number(end) for end in (low, high)):
        return is_number(cell) and float(low or "-inf") <= float(cell) <= float(high or "inf")
    return cell == str(value) or (is_number(cell) and is_number(str(value)) and float(cell) == float(value))


def not_above_zero(quantity: str, values: Iterable[float], lines: Iterable[int]) -> list[str]:
    """Note on readings at or below zero, from noise or a channel not yet switched on.

    >>> not_above_zero("friction_coefficient", [0.0, 0.1], [2, 3])
    ['1 reading of friction_coefficient at zero or below, taken as read: line 2']
    """
    at_lines = [line for line, value in zip(lines, values, strict=True) if value <= 0.0]
    note = f"{count(len(at_lines), 'reading')} of {quantity} at zero or below, taken as read: {places(at_lines)}"
    return [note] if at_lines else []


def _tables(rows: Sequence[Line]) -> list[tuple[int, int]]:
    """First and end row of each table: rows of numbers of the same length as the header above."""
    numbers = [_numbers(row) for _, row in rows]
    words = [not n and sum(map(bool, row)) > 1 for n, (_, row) in zip(numbers, rows, strict=True)]
    found, end = [], len(rows)
    for i in range(len(rows) - 1, 0, -1):
        # Here ``end`` is where rows of this length end, if they reach back to this one.
        if (words[i] and not all(map(is_missing, rows[i][1]))) or len(rows[i][1]) != len(rows[i - 1][1]):
            end = i
        elif words[i - 1] and numbers[i]:
            found.append((i, end))
    return found[::-1]


def _surroundings(tables: Sequence[tuple[int, int]], number: int | None, rows: int) -> tuple[int, int]:
    """Rows of the chosen table, or the longest, with the lines around it that belong to no other table."""
    place = max(range(len(tables)), key=lambda i: tables[i][1] - tables[i][0]) if number is None else number - 1
    before = tables[place - 1][1] if place else 0
    return before, tables[place + 1][0] - 1 if place + 1 < len(tables) else rows


def _described(rows: Sequence[Line], first: int, end: int) -> str:
    header, _ = header_of([row for _, row in rows[max(first - 2, 0) : first]])
    return f"{_range(rows[first:end])}: {listed([h for h in header if h], VALUES_LISTED // 4)}"


def _table_rows(rows: Sequence[Line], name: str) -> tuple[int, int]:
    """First and end row of the longest table."""
    first, last = max(_tables(rows), key=lambda one: one[1] - one[0], default=(0, 0))
    if not first:
        _refuse_numbers_above(rows, name)
        first, last = 1, len(rows)
    width = len(rows[first - 1][1])
    _refuse_other_rows(rows[: first - 1], rows[last:], width, name)
    for number, row in rows[first:last]:
        if len(row) != width:
            raise InputError(_uneven(width), where=f"{name}: line {number}")
    return first, last


def _refuse_numbers_above(rows: Sequence[Line], name: str) -> None:
    """Raise an error if the first line holds numbers: the names are missing, or quantities are in rows."""
    number, first = rows[0]
    values = [cell for cell in first if is_number(cell)]
    if len(values) == len(first) and _numbers(rows[1][1]):
        turned = "; if they are values of a quantity, turn the table, so that each quantity has one column"
        raise InputError(f"no header: the first line holds numbers only; name the columns above it{turned}", where=name)
    if len(values) > 2 and 2 * len(values) > sum(map(bool, first)):
        shown = ", ".join(values[:NUMBERS_SHOWN])
        alike = [*map(is_number, first)] == [*map(is_number, rows[1][1])]
        seems = "seems to be turned, or has no header" if alike else "seems to be turned"
        rule = f"the header holds numbers ({shown}, ...), so the table {seems}: each quantity, such as the "
        rule += "temperature, must have one column, with its name in the header, and each reading one row"
        raise InputError(rule, where=f"{name}: line {number}")


def _refuse_other_rows(before: Sequence[Line], after: Sequence[Line], width: int, name: str) -> None:
    """Raise an error for rows of numbers outside the table, which would be lost: uneven rows or another table."""
    if any(_numbers(row) > 1 for _, row in after):
        number, row = after[0]
        rule = _uneven(width) if len(row) != width else "begins another table; put one table in a file"
        raise InputError(rule, where=f"{name}: line {number}")
    outside = [number for number, row in before if _numbers(row) > 1]
    if len(outside) > 1:
        rule = "holds other rows of numbers before its longest table; put one table in a file"
        raise InputError(rule, where=f"{name}: lines {outside[0]} to {outside[-1]}")


def _uneven(width: int) -> str:
    return f"has not as many cells as the header ({width})"


def _numbers(cells: Sequence[str]) -> int:
    return sum(is_number(cell) for cell in cells)


def _range(rows: Sequence[Line]) -> str:
    if not rows:
        return ""
    low, high = rows[0][0], rows[-1][0]
    return f"line {low}" if low == high else f"lines {low} to {high}"


RUN_KEY = "import.columns.run"
RUN_WORDS = ("run", "run number", "run no", "run nr", "test no", "versuch nr", "lfd. nr", "lfd.nr", "nr", "no", "#")
WORD_BEFORE_NUMBER = re.compile(r"[^\W\d_][^\d]*(?=\d)")
"""Word before a run number, as in T-017."""
ANEW = "so readings are renumbered from 1"


def header_of_runs(sheet: Sheet, answers: Answers) -> str | None:
    """Header of the run numbers."""
    named = answers.get(RUN_KEY)
    if named is not None and str(named) not in sheet.cells:
        raise InputError(f"no such header; {nearest(str(named), sheet.cells)}", where=RUN_KEY, value=named)
    if named is not None:
        return str(named)
    spoken = [words_of(header) for header in sheet.cells]
    return next((h for words in RUN_WORDS for h, word in zip(sheet.cells, spoken, strict=True) if word == words), None)


def runs_of(sheet: Sheet, header: str) -> tuple[np.ndarray | None, str | None]:
    """Run numbers if whole and unique, behind the same word or none; else None and the reason."""
    line_of: dict[int, int] = {}
    word = WORD_BEFORE_NUMBER.match(sheet.cells[header][0])
    before = word[0] if word is not None and all(cell.startswith(word[0]) for cell in sheet.cells[header]) else ""
    for line, cell in zip(sheet.lines, sheet.cells[header], strict=True):
        number = _whole(cell[len(before) :])
        if number is None:
            return None, f"{sheet.name}: line {line}, {header}: {cell!r} is no whole number, {ANEW}"
        if number in line_of:
            return None, f"{sheet.name}: {header} {number} is in lines {line_of[number]} and {line}, {ANEW}"
        line_of[number] = line
    return np.array(list(line_of)), None


def joined_runs(parts: Sequence[tuple[str, np.ndarray | None]]) -> tuple[np.ndarray | None, str | None]:
    """Run numbers of several files; None if a file has none or a number is in two files."""
    numbered = [(name, runs) for name, runs in parts if runs is not None]
    if len(numbered) < len(parts):
        absent = next(name for name, runs in parts if runs is None)
        return None, f"{absent} has no run numbers to keep, {ANEW}" if numbered else None
    names = [name for name, runs in numbered for _ in runs]
    every = np.concatenate([runs for _, runs in numbered])
    first = np.unique(every, return_index=True)[1]
    if first.size == every.size:
        return every, None
    repeated = int(np.setdiff1d(np.arange(every.size), first)[0])
    first_file = names[int(np.argmax(every == every[repeated]))]
    return None, f"run {every[repeated]} is in {first_file} and {names[repeated]}, {ANEW}"


def _whole(cell: str) -> int | None:
    try:
        value = number_of(cell)
    except ValueError:
        return None
    return int(value) if abs(value) < LARGEST and value == int(value) else None
