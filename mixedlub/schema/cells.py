"""Cells of text tables: lines into cells, numbers and missing values."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Iterator, Sequence

from profiles.errors import InputError
from profiles.units import number_of

PRINTED_MINUS = re.compile(r"(?:(?<=\d[eE])|(?<![\w)]))\u2212(?=[\d.,])")
BLANK = ("", "-", "--", "---", "\u2013", "\u2014", "nan", "na", "n/a", "n.a.", "#n/a", "#nv", "null", "none")
"""Texts of an empty cell, in lower case."""


def is_missing(cell: str) -> bool:
    """Whether a cell denotes a missing value.

    >>> [is_missing(cell) for cell in ("", "n/a", " - ", "NaN", "0", "-1", "abc")]
    [True, True, True, True, False, False, False]
    """
    return cell.strip().lower() in BLANK


def is_number(cell: str) -> bool:
    """Whether a cell is a number."""
    try:
        number_of(cell)
    except ValueError:
        return False
    return True


def are_numbers(cells: Collection[str]) -> bool:
    """Whether all cells are numbers or empty, with at least one number.

    >>> are_numbers(["1", "n/a", "2"]), are_numbers(["1", "stuck"]), are_numbers(["", ""])
    (True, False, False)
    """
    if not all(is_number(cell) or is_missing(cell) for cell in cells):
        return False
    return not cells or not all(map(is_missing, cells))


def with_hyphens(text: str) -> str:
    """Text with a hyphen in place of the typographic minus (U+2212) before numbers.

    >>> with_hyphens("\u22120.5;1.2e\u22123;m s\u22121")
    '-0.5;1.2e-3;m s\u22121'
    """
    return PRINTED_MINUS.sub("-", text) if "\u2212" in text else text


def csv_rows(
    numbered: Sequence[tuple[int, str]], where: str, separator: str = ",", *, headings: bool = False
) -> Iterator[tuple[int, list[str]]]:
    """Cells of numbered lines; raise an error for a quoted cell that continues in the next line.

    With ``headings``, cells of words may continue, as in headings of spreadsheets; a blank replaces the line end.

    >>> list(csv_rows([(3, 'a,"b, c"')], "t.csv"))
    [(3, ['a', 'b, c'])]
    >>> list(csv_rows([(3, 'a,"b'), (4, 'c"')], "t.csv"))
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: t.csv: line 3: 'b c': a quoted cell must end in its line
    """
    reader, first = csv.reader((f"{line}\n" for _, line in numbered), delimiter=separator), 0
    for row in reader:
        number = numbered[first][0]
        broken = [cell for cell in row if "\n" in cell and not (headings and separator not in cell)]
        if broken:
            rule = "a quoted cell must end in its line"
            raise InputError(rule, where=f"{where}: line {number}", value=" ".join(broken[0].split()))
        yield number, [cell.replace("\n", " ") for cell in row] if headings else row
        first = reader.line_num
