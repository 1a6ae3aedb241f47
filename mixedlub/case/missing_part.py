"""Missing part of a base model as a table over conditions, interpolated between its rows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from math import prod

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.ranges import Limit
from mixedlub.kinds import Kind
from mixedlub.schema.table import BOOKKEEPING, Column, Table
from mixedlub.schema.units import unit_of, words_of
from profiles.errors import InputError

FILE = "missing_part.csv"
"""File of the table in the case of an improved model."""
SHARE, ADDITION, SD = "missing_share", "missing_reading", "missing_sd"
"""Columns of the table: the missing part over the simulated reading or in its unit, and the standard deviation."""
OUTSIDE = "missing_part_extrapolated"
"""Code of rows outside the table."""
LITTLE = 0.25
"""Judgement. Share of a range of the table up to which the values at its end are a little extrapolated."""
LOGARITHMIC = 3.0
"""Judgement. Ratio of the ends of a condition from which it is interpolated by its logarithm: as conditions are
compared."""


def table_columns(kind: Kind) -> tuple[Column, ...]:
    """Columns that the table may have."""
    conditions = (*(c for c in BOOKKEEPING if c.name != "setup"), *kind.columns)
    values = (
        Column(SHARE, required=False, meaning="missing part over the simulated reading"),
        Column(ADDITION, required=False, meaning="missing part in the unit of the reading"),
        Column(SD, at_least=0.0, required=False, meaning="standard deviation of the missing part"),
    )
    free = (Column(c.name, c.dtype, required=False, meaning=c.meaning) for c in conditions)
    return (*free, *values)


@dataclass(frozen=True, eq=False)
class Axis:
    """A condition of the table: its levels, which are numbers, or names that stand together."""

    names: tuple[str, ...]
    levels: np.ndarray

    @property
    def named(self) -> bool:
        """Whether the levels are names."""
        return self.levels.dtype.kind in "US"

    def values(self, table: Table) -> np.ndarray:
        """The condition of the rows of a table."""
        for name in self.names:
            if name not in table:
                rule = f"a column is missing over which {FILE} tells the missing part"
                raise InputError(rule, where=table.source, value=name)
        return joined([table[name] for name in self.names]) if self.named else np.asarray(table[self.names[0]], float)

    def around(self, values: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Levels next to values and their weights; the end beyond an end, no level for another name."""
        if self.named:
            place = np.minimum(np.searchsorted(self.levels, values), self.levels.size - 1)
            yield place, (self.levels[place] == values).astype(float)
            return
        low, high = self.levels[0], self.levels[-1]
        logarithmic = low > 0.0 and high > LOGARITHMIC * low and self.names[0] != "sequence"
        levels, held = self.levels, np.clip(values, low, high)
        if levels.size == 1:
            yield np.zeros(held.size, int), np.ones(held.size)
            return
        place = np.clip(np.searchsorted(levels, held, side="right") - 1, 0, levels.size - 2)
        levels, held = (np.log(levels), np.log(held)) if logarithmic else (levels, held)
        share = (held - levels[place]) / (levels[place + 1] - levels[place])
        yield place, 1.0 - share
        yield place + 1, share

    def limit(self) -> Limit:
        """Range of the condition in the table."""
        advice = "the table of the missing part ends, and beyond it the values at its end were taken"
        if self.named:
            advice = "the table of the missing part does not have these names, and nothing was added"
            return Limit(OUTSIDE, self.names[0], (1.0, 1.0), advice, meaning="rows with names of the table (1, else 0)")
        low, high = float(self.levels[0]), float(self.levels[-1])
        more = LITTLE * (high - low)
        meaning = f"{words_of(self.names[0])} in {unit_of(self.names[0]) or '-'}"
        return Limit(OUTSIDE, self.names[0], (low, high), advice, (low - more, high + more), meaning=meaning)

    def judged(self, table: Table) -> np.ndarray:
        """The values compared with the limit, of the shape (rows, 1)."""
        values = self.values(table)
        return (np.isin(values, self.levels).astype(float) if self.named else values)[:, None]


@dataclass(frozen=True, eq=False)
class MissingPart:
    """The table of a case: every combination of the levels of its axes has one row."""

    table: Table
    part_rigs: tuple[str, ...] = field(default=())

    @property
    def is_share(self) -> bool:
        """Whether the values are shares of the simulated reading."""
        return SHARE in self.table

    @cached_property
    def axes(self) -> tuple[Axis, ...]:
        """The conditions of the table, names first."""
        found = {name: v for name, v in self.table.columns.items() if name not in (SHARE, ADDITION, SD)}
        surfaces = tuple(n for n, v in found.items() if v.dtype.kind in "US" and n != "rig")
        groups = [*([("rig",)] if "rig" in found else []), *([surfaces] if surfaces else [])]
        axes = [Axis(group, np.unique(joined([found[name] for name in group]))) for group in groups]
        numbers = [Axis((n,), np.unique(v.astype(float))) for n, v in found.items() if v.dtype.kind not in "US"]
        return (*axes, *numbers)

    @cached_property
    def _places(self) -> np.ndarray:
        """Row of each combination of levels."""
        place = np.zeros(len(self.table), int)
        for axis in self.axes:
            place = place * axis.levels.size + np.searchsorted(axis.levels, axis.values(self.table))
        return np.asarray(np.argsort(place, kind="stable"))

    def checked(self, where: str) -> MissingPart:
        """The table; raise an error if a combination of levels has no row or several."""
        if (SHARE in self.table) == (ADDITION in self.table):
            raise InputError(f"needs one of the columns {SHARE} and {ADDITION}", where=where)
        count = prod(axis.levels.size for axis in self.axes)
        rows = {tuple(row) for row in zip(*(axis.values(self.table).tolist() for axis in self.axes), strict=True)}
        if not self.axes or len(rows) != count or len(self.table) != count:
            rule = f"needs one row for each of the {count} combinations of its conditions"
            raise InputError(rule, where=where, value=len(self.table))
        return self

    def at(self, table: Table, column: str = "") -> np.ndarray:
        """A column, by default the missing part, interpolated at the conditions of a table.

        >>> grid = {"speed_rpm": np.array([1.0, 2.0]), "missing_share": np.array([0.1, 0.3])}
        >>> MissingPart(Table(grid)).at(Table({"speed_rpm": np.array([0.5, 1.5, 9.0])})).round(3).tolist()
        [0.1, 0.2, 0.3]
        """
        values = self.table[column or (SHARE if self.is_share else ADDITION)][self._places]
        table = self._with_rig(table)
        found = np.zeros(len(table))
        for corner in product(*(tuple(axis.around(axis.values(table))) for axis in self.axes)):
            place, weight = np.zeros(len(table), int), np.ones(len(table))
            for axis, (index, share) in zip(self.axes, corner, strict=True):
                place, weight = place * axis.levels.size + index, weight * share
            found += weight * values[place]
        return found

    def without(self, reading: np.ndarray, table: Table) -> np.ndarray:
        """Readings of a model that has this part, without it."""
        return reading / (1.0 + self.at(table)) if self.is_share else reading - self.at(table)

    def reached(self, table: Table) -> list[tuple[Limit, np.ndarray]]:
        """The limits of the table, each with the values of rows."""
        table = self._with_rig(table)
        return [(axis.limit(), axis.judged(table)) for axis in self.axes]

    def _with_rig(self, table: Table) -> Table:
        """The rows, on the whole rig where they do not name a part of it."""
        if "rig" not in self.table or "rig" in table:
            return table
        whole = next((name for name in np.unique(self.table["rig"]) if name not in self.part_rigs), "")
        return Table({**table.columns, "rig": np.full(len(table), whole)}, table.source)


def joined(columns: list[np.ndarray]) -> np.ndarray:
    """Names that stand together as one.

    >>> joined([np.array(["a", "a"]), np.array(["a", "b"])]).tolist()
    ['a / a', 'a / b']
    """
    found = columns[0].astype(str)
    for column in columns[1:]:
        found = np.char.add(np.char.add(found, " / "), column.astype(str))
    return found


def _with_share(reading: np.ndarray, missing_share: np.ndarray) -> np.ndarray:
    return reading * (1.0 + missing_share)


def _with_addition(reading: np.ndarray, missing_reading: np.ndarray) -> np.ndarray:
    return reading + missing_reading


def as_effect(is_share: bool) -> Effect:
    """The missing part as an effect without parameters; its values are an input of the model."""
    return Effect(
        name="missing_part",
        law=_with_share if is_share else _with_addition,
        stage="measurement",
        acts_on=("reading",),
        parameters=(),
        fingerprint={},
        separated_by="",
    )
