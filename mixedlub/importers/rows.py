"""Lines of a text as cells: parted by a mark, or by blanks where those make more rows of numbers."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence

from mixedlub.importers.marks import Line, is_written_number

SEPARATORS = "\t;,"
UNIT = r"[(\[][^()\[\]]*[)\]]"
WORD = re.compile(rf"(?:{UNIT}|\S)+")
WORD_AND_UNIT = re.compile(rf"(?:\s*{UNIT}|\S)+")
WORDS = re.compile(r"\S+(?:\s\S+)*")
"""What a cell between blanks may be: a word, a word and its unit, words with single blanks between."""


def rows_of(numbered: Sequence[tuple[int, str]]) -> list[Line]:
    """The cells of numbered lines; blanks part them only where no mark makes as many rows of numbers."""
    separator = max(SEPARATORS, key=lambda mark: _regularity([line.count(mark) for _, line in numbered]))
    reader = csv.reader((line for _, line in numbered), delimiter=separator)
    marked = [(numbered[reader.line_num - 1][0], [cell.strip() for cell in row]) for row in reader]
    blank = _by_blanks(numbered)
    return blank if _readable(blank) > _readable(marked) else marked


def _regularity(counts: list[int]) -> int:
    """How many lines have the most common number of separators; where two tie, a comma may be a decimal mark."""
    found = [n for n in counts if n]
    return max((found.count(n) for n in set(found)), default=0)


def _by_blanks(numbered: Sequence[tuple[int, str]]) -> list[Line]:
    """Rows of numbers at their blanks; other lines so that they have as many cells, where one way gives those."""
    plain = [(number, line.split()) for number, line in numbered]
    width = _usual([row for _, row in plain if _mostly_numbers(row)])
    rows = []
    for number, line in numbered:
        ways = [form.findall(line) for form in (WORD, WORD_AND_UNIT, WORDS)]
        row = next((way for way in ways if len(way) == width), ways[0])
        rows.append((number, [cell.strip() for cell in row]))
    return rows


def _readable(rows: Sequence[Line]) -> tuple[int, int]:
    """How many rows of the usual length hold nothing but numbers, and how many hold mostly numbers."""
    mostly = [row for _, row in rows if _mostly_numbers(row)]
    usual = [row for row in mostly if len(row) == _usual(mostly)]
    return (sum(all(is_written_number(cell) for cell in row if cell) for row in usual), len(usual))


def _usual(rows: Sequence[Sequence[str]]) -> int:
    lengths = [len(row) for row in rows]
    return max(set(lengths), key=lengths.count, default=0)


def _mostly_numbers(row: Sequence[str]) -> bool:
    numbers = sum(is_written_number(cell) for cell in row)
    return numbers > 1 and 2 * numbers > sum(bool(cell) for cell in row)
