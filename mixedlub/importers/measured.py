"""Tables of binary measurement files: columns by header, joined where channels have clocks of their own."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.importers.cell_columns import NumberColumn, TextColumn
from mixedlub.importers.header import unique
from mixedlub.importers.text_table import Sheet
from mixedlub.importers.vocabulary import BY_NAME, target_of
from mixedlub.schema.units import change_to, split
from profiles.errors import InputError

TIME = BY_NAME["time_s"]
FEWEST = 3
"""Judgement. Fewest common times at which the channels of two clocks are joined."""
DATES = "datetime64"


@dataclass(frozen=True, eq=False)
class MeasuredTable:
    """Channels of equal length by header with unit: numbers, or texts."""

    name: str
    columns: Mapping[str, np.ndarray]

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self.columns.values())))

    @property
    def clock(self) -> tuple[str, np.ndarray] | None:
        """Header of a time that rises from row to row, and its seconds."""
        for header, values in self.columns.items():
            change = change_to(split(header)[1] or "", TIME.unit)
            if target_of(header) == TIME and change is not None and values.dtype.kind == "f":
                seconds = values * change[0]
                return (header, seconds) if np.all(np.diff(seconds) > 0.0) else None
        return None

    def sheet(self, file: str) -> Sheet:
        """Table for the reading of headers and units; its lines are the rows from 1."""
        cells = {
            header: NumberColumn(values) if values.dtype.kind == "f" else TextColumn(map(str, values.tolist()))
            for header, values in self.columns.items()
        }
        return Sheet(file, cells, tuple(range(1, self.rows + 1)))


def tables_of(channels: Sequence[tuple[str, str, np.ndarray]]) -> list[MeasuredTable]:
    """Tables of channels (table, header, values), one for each table and length; names are kept unique.

    >>> found = tables_of([("rig", "Load (N)", np.ones(3)), ("rig", "Film (nm)", np.ones(2)), ("rig", "T", np.ones(3))])
    >>> [(table.name, list(table.columns)) for table in found]
    [('rig, 3 rows', ['Load (N)', 'T']), ('rig, 2 rows', ['Film (nm)'])]
    """
    grouped: dict[tuple[str, int], list[tuple[str, np.ndarray]]] = {}
    dates = [np.fmin.reduce(values, axis=None) for _, _, values in channels if values.dtype.kind == "M" and values.size]
    first = min((date for date in dates if not np.isnat(date)), default=None)
    for table, header, values in channels:
        found = _values(values, first)
        if found is not None and len(found):
            name = f"{header} (s)" if values.dtype.kind == "M" and split(header)[1] is None else header
            grouped.setdefault((table, len(found)), []).append((name, found))
    names = [table for table, _ in grouped]
    return [
        MeasuredTable(
            table if names.count(table) == 1 else f"{table}, {rows} rows",
            dict(zip(unique([h for h, _ in columns]), (v for _, v in columns), strict=True)),
        )
        for (table, rows), columns in grouped.items()
    ]


def _values(values: np.ndarray, first: np.datetime64 | None) -> np.ndarray | None:
    """Numbers as floats, times as seconds since the first of the file, or texts; None for other channels."""
    values = np.asarray(values)
    if values.ndim != 1:
        return None
    if values.dtype.kind == "M":
        return None if first is None else (values - first) / np.timedelta64(1, "ns") * 1e-9
    if values.dtype.kind in "iufb":
        return values.astype(float)
    texts = values.dtype.kind in "US" or all(isinstance(one, str | bytes) for one in values.tolist())
    return (
        np.array([one.decode(errors="replace") if isinstance(one, bytes) else one for one in values]) if texts else None
    )


def named(name: str, unit: object) -> str:
    """Header of a channel with its unit, if it has one that the name lacks.

    >>> named("Load", "N"), named("Load [N]", "N"), named("COF", "")
    ('Load (N)', 'Load [N]', 'COF')
    """
    unit = str(unit or "").strip().strip("()[]")
    return f"{name} ({unit})" if unit and split(name)[1] is None else name


def joined(tables: Sequence[MeasuredTable]) -> tuple[MeasuredTable, str]:
    """Longest table with the channels of slower clocks at its times, and a text on them; empty without such."""
    longest = max(tables, key=lambda table: (is_numeric_table(table), table.rows))
    clock = longest.clock
    if clock is None:
        return longest, ""
    columns, places, joined_to = dict(longest.columns), [], []
    first, last = -math.inf, math.inf
    for table in tables:
        other = None if table is longest else table.clock
        if other is None or np.count_nonzero((clock[1] >= other[1][0]) & (clock[1] <= other[1][-1])) < FEWEST:
            continue
        numbers = {h: v for h, v in table.columns.items() if h != other[0] and v.dtype.kind == "f"}
        for header, values in numbers.items():
            known = np.isfinite(values)
            if known.any():
                columns[unique([*columns, header])[-1]] = np.interp(clock[1], other[1][known], values[known])
                places.append(header)
        first, last = max(first, other[1][0]), min(last, other[1][-1])
        joined_to.append(table.name)
    inside = (clock[1] >= first) & (clock[1] <= last)
    if not places or np.count_nonzero(inside) < FEWEST:
        return longest, ""
    text = f"{', '.join(map(repr, places))} of {', '.join(map(repr, joined_to))} interpolated at the times of "
    text += f"{longest.name!r}, in the {np.count_nonzero(inside)} of its {longest.rows} rows that all cover"
    return replace(longest, columns={header: values[inside] for header, values in columns.items()}), text


def is_numeric_table(table: MeasuredTable) -> bool:
    """Whether a table has a channel of numbers."""
    return any(values.dtype.kind == "f" for values in table.columns.values())


def refuse_without(package: str, what: str, where: str) -> InputError:
    """Error for a file that needs an absent optional package."""
    return InputError(f"is {what}, read by the package {package}: pip install '.[rig-files]' in the clone", where=where)
