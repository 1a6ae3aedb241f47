"""Workbooks (xlsx) as text tables, by the library openpyxl."""

from __future__ import annotations

import csv
import io
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from profiles.errors import InputError
from profiles.readers.archive import check_archive, members
from profiles.readers.base import MAX_POINTS, foreign_parser

FORMATTED_ROWS = 60
"""Rows of a sheet whose number formats are looked at: a column has one format below its heading."""


@dataclass(frozen=True)
class Worksheet:
    """A sheet of a workbook: a line of text a row, tabs between cells; how many rows hold numbers.

    ``percent`` are the columns, by their letters, whose numbers the workbook shows times 100.
    """

    name: str
    text: str
    rows: int
    percent: tuple[str, ...] = ()


def is_workbook(data: bytes) -> bool:
    """Whether the bytes are an xlsx file."""
    return "xl/workbook.xml" in members(data)


def worksheets(data: bytes, where: str) -> tuple[Worksheet, ...]:
    """The sheets of a workbook, with the values that its formulas had when it was saved."""
    check_archive(data, where)
    import openpyxl

    # openpyxl remarks on styles it does not know, which is nothing to the user of a table.
    with foreign_parser("xlsx", where), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        return tuple(_worksheet(sheet) for sheet in book.worksheets)


def longest(sheets: Iterable[Worksheet], where: str) -> Worksheet:
    """The sheet with most rows of numbers; the first of several."""
    found = max(sheets, key=lambda sheet: sheet.rows, default=None)
    if found is None or not found.rows:
        raise InputError("no sheet of the workbook holds numbers", where=where)
    return found


def _worksheet(sheet: Any) -> Worksheet:
    # Some programs write a wrong size of the sheet, behind which rows would be lost.
    sheet.reset_dimensions()
    rows = [list(row) for row in sheet.iter_rows(max_row=MAX_POINTS, values_only=True)]
    width = max((i for row in rows for i, value in enumerate(row, start=1) if value is not None), default=0)
    text = io.StringIO()
    writer = csv.writer(text, delimiter="\t", lineterminator="\n")
    writer.writerows([_text(value) for value in (row + [None] * width)[:width]] for row in rows)
    numbers = sum(any(map(_is_number, row)) for row in rows)
    shown = {
        cell.column_letter
        for row in sheet.iter_rows(max_row=FORMATTED_ROWS)
        for cell in row
        if _is_number(cell.value) and "%" in (cell.number_format or "")
    }
    return Worksheet(sheet.title, text.getvalue(), numbers, tuple(sorted(shown)))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _text(value: Any) -> str:
    """A cell in one line; a number in the fewest digits that read back equal.

    >>> _text(40.0), _text(0.1), _text(None), _text("oil\\nA")
    ('40', '0.1', '', 'oil A')
    """
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return "" if value is None else " ".join(str(value).split())
