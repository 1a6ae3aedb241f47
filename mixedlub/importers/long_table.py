"""Long tables of numbers, read column by column after the usual reading of their first lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from mixedlub.importers.cell_columns import NumberColumn, TextColumn
from mixedlub.importers.decimals import MARKS, is_written_number
from mixedlub.importers.odd_rows import FAULT, is_summary
from mixedlub.importers.text_table import SEPARATORS, Sheet, read_sheet
from mixedlub.schema.long_text import LONG, regular_columns
from profiles.errors import InputError

HEAD = 400
"""Judgement. Lines read in the usual way, which decide header, separator and decimal mark."""


def long_sheet(text: str, name: str, decimal: str | None = None, separator: str = "") -> Sheet | None:
    """Table of a long text; None if it is short or holds anything but regular rows, for the usual reading."""
    if len(text) < LONG:
        return None
    lines = text[: LONG // 2].split("\n", HEAD)[:-1]
    try:
        first = read_sheet("\n".join(lines), name, decimal, separator)
    except InputError:
        return None
    start = first.lines[0]
    is_regular = first.lines == tuple(range(start, len(lines) + 1)) and not any(
        (first.notes, first.repeated, first.summaries, first.faults)
    )
    form = _form(first, lines[start - 1 :]) if is_regular else None
    if form is None:
        return None
    body = text[sum(len(line) + 1 for line in lines[: start - 1]) :].rstrip("\n")
    columns = None if "\n#" in body else _columns(body, *form, len(first.cells))
    if columns is None:
        return None
    rows = len(columns[0])
    cells = dict(zip(first.cells, columns, strict=True))
    return replace(first, cells=cells, lines=tuple(range(start, start + rows)))


def _form(first: Sheet, lines: Sequence[str]) -> tuple[str, str] | None:
    """Separator, empty for blanks, and decimal mark that give the cells already read."""
    wanted = [list(row) for row in zip(*first.cells.values(), strict=True)]
    for mark, decimal in product((*SEPARATORS, ""), reversed(MARKS)):
        if mark == decimal:
            continue
        rows = [[cell.strip() for cell in line.split(mark or None)] for line in lines]
        if [[_pointed(cell, decimal) for cell in row] for row in rows] == wanted:
            return mark, decimal
    return None


def _pointed(cell: str, decimal: str) -> str:
    return cell.replace(decimal, ".") if is_written_number(cell) else cell


def _columns(body: str, mark: str, decimal: str, width: int) -> list[NumberColumn | TextColumn] | None:
    """Columns of numbers or texts; None if a text is a number, an error or a summary of other rows."""
    found = regular_columns(body, mark, decimal, width=width)
    if found is None:
        return None
    columns = [NumberColumn(cells) if isinstance(cells, np.ndarray) else TextColumn(cells) for cells in found]
    texts = {cell for column in columns if isinstance(column, TextColumn) for cell in set(column)}
    odd = any(is_written_number(cell) or FAULT.fullmatch(cell) or is_summary(cell) for cell in texts)
    return None if odd else columns
