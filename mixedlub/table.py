"""Tables of readings and conditions: CSV in, columns out, every wrong cell named."""

from __future__ import annotations

import csv
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from profiles.errors import InputError, nearest


class CaseWarning(UserWarning):
    """Something in the input was assumed, ignored or replaced; the user should know."""


@dataclass(frozen=True)
class Column:
    """What a column holds: a number within bounds, a whole number, or a name."""

    name: str
    form: str = "number"
    above: float = -np.inf
    at_least: float = -np.inf
    at_most: float = np.inf
    required: bool = True

    def parse(self, text: str, where: str) -> float | int | str:
        """The cell's value, or an error that names the place."""
        text = text.strip()
        if self.form == "name":
            if not text:
                raise InputError(f"{self.name} must name something", where=where, value=text)
            return text
        try:
            value = float(text)
        except ValueError:
            raise InputError(f"{self.name} must be a number", where=where, value=text) from None
        if not np.isfinite(value):
            raise InputError(f"{self.name} must be a finite number", where=where, value=text)
        if value <= self.above:
            raise InputError(f"{self.name} must be above {self.above:g}", where=where, value=value)
        if value < self.at_least or value > self.at_most:
            raise InputError(
                f"{self.name} must lie between {self.at_least:g} and {self.at_most:g}",
                where=where,
                value=value,
            )
        if self.form == "whole":
            if value != int(value):
                raise InputError(f"{self.name} must be a whole number", where=where, value=text)
            return int(value)
        return value


RUN = Column("run", "whole")
BOOKKEEPING = (
    Column("rig", "name", required=False),
    Column("sequence", at_least=0.0, at_most=1.0, required=False),
    Column("setup", "name", required=False),
)


@dataclass(frozen=True)
class Table:
    """Columns of equal length by name."""

    columns: Mapping[str, np.ndarray]
    source: str = "table"

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def take(self, rows: np.ndarray) -> Table:
        """The rows of a mask or index."""
        return Table({name: column[rows] for name, column in self.columns.items()}, self.source)


def read_table(path: Path, columns: tuple[Column, ...], *, key: str | None = "run") -> Table:
    """Read a CSV with the given columns, ``key`` unique; others are ignored with a warning."""
    where = path.name
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError("no such file", where=str(path)) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot be read as UTF-8 text ({error})", where=str(path)) from None
    if "\0" in text:
        raise InputError("is not a text table", where=where)
    try:
        lines = [row for row in csv.reader(text.splitlines()) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise InputError(f"is not a comma-separated table ({error})", where=where) from None
    if len(lines) < 2:
        raise InputError("needs a header line and at least one row", where=where)
    header = [cell.strip() for cell in lines[0]]
    doubled = {name for name in header if header.count(name) > 1}
    if doubled:
        raise InputError("column appears twice", where=where, value=sorted(doubled)[0])
    known = {c.name: c for c in columns}
    for column in columns:
        if column.required and column.name not in header:
            hint = nearest(column.name, [name for name in header if name not in known])
            raise InputError(f"column {column.name!r} is missing; {hint}", where=f"{where}: header")
    unknown = [name for name in header if name and name not in known]
    if unknown:
        warnings.warn(
            f"{where}: columns ignored because they are not known: {', '.join(unknown)}",
            CaseWarning,
            stacklevel=2,
        )
    cells = _parse(lines, header, known, where)
    if key is not None:
        values, counts = np.unique(cells[key], return_counts=True)
        if (counts > 1).any():
            raise InputError(f"{key} must be unique", where=f"{where}: {key}", value=int(values[counts > 1][0]))
    return Table(cells, where)


def _parse(lines: list[list[str]], header: list[str], known: Mapping[str, Column], where: str) -> dict[str, np.ndarray]:
    cells: dict[str, list[float | int | str]] = {name: [] for name in header if name in known}
    for number, row in enumerate(lines[1:], start=2):
        if len(row) != len(header):
            raise InputError(
                f"has {len(row)} cells where the header has {len(header)}", where=f"{where}: line {number}"
            )
        for name, cell in zip(header, row, strict=True):
            if name in known:
                cells[name].append(known[name].parse(cell, f"{where}: line {number}, {name}"))
    return {name: np.array(values) for name, values in cells.items()}
