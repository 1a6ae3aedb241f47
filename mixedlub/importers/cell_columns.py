"""Columns of cells: as text, or as numbers alone where a long table holds nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import overload

import numpy as np

from mixedlub.schema.cells import are_numbers, is_missing, is_number

Cells = Mapping[str, Sequence[str]]


class TextColumn(list[str]):
    """Immutable cells of a column; whether they are numbers is determined once."""

    @cached_property
    def numeric(self) -> bool:
        """Whether every filled cell is a number."""
        return are_numbers(self)

    @cached_property
    def values(self) -> np.ndarray:
        """Numbers in the cells; nan for other cells."""
        return np.array([float(cell) if is_number(cell) else np.nan for cell in self])


class NumberColumn(Sequence[str]):
    """Cells that are numbers or empty, kept as numbers; their text is made on request.

    >>> column = NumberColumn(np.array([40.0, 0.5, np.nan]))
    >>> list(column), column[0], column == NumberColumn(column.values)
    (['40', '0.5', ''], '40', True)
    """

    def __init__(self, values: np.ndarray) -> None:
        self.values = values
        self.numeric = len(values) == 0 or not np.isnan(values).all()

    def __len__(self) -> int:
        return len(self.values)

    @overload
    def __getitem__(self, row: int) -> str: ...
    @overload
    def __getitem__(self, row: slice) -> Sequence[str]: ...
    def __getitem__(self, row: int | slice) -> str | Sequence[str]:
        return NumberColumn(self.values[row]) if isinstance(row, slice) else _text(float(self.values[row]))

    def __iter__(self) -> Iterator[str]:
        return map(_text, self.values.tolist())

    def __eq__(self, other: object) -> bool:
        if isinstance(other, NumberColumn):
            return np.array_equal(self.values, other.values, equal_nan=True)
        return NotImplemented

    __hash__ = None  # type: ignore[assignment]


def _text(value: float) -> str:
    return "" if value != value else repr(value).removesuffix(".0")


def is_numeric(cells: Sequence[str]) -> bool:
    """Whether a column holds only numbers and empty cells."""
    return cells.numeric if isinstance(cells, TextColumn | NumberColumn) else are_numbers(cells)


def values_of(cells: Sequence[str]) -> np.ndarray:
    """Numbers in cells; nan for other cells."""
    return (cells if isinstance(cells, TextColumn | NumberColumn) else TextColumn(cells)).values


def missing_rows(cells: Sequence[str]) -> list[int]:
    """Rows with a missing cell."""
    if isinstance(cells, NumberColumn):
        return np.flatnonzero(np.isnan(cells.values)).tolist()
    return [i for i, cell in enumerate(cells) if is_missing(cell)]


def taken(cells: Sequence[str], rows: Iterable[int]) -> Sequence[str]:
    """Cells of some rows."""
    if isinstance(cells, NumberColumn):
        return NumberColumn(cells.values[list(rows)])
    return TextColumn(cells[i] for i in rows)
