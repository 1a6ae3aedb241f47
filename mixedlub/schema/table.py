"""Tables of readings and conditions from CSV files; errors name the cell."""

from __future__ import annotations

import csv
import difflib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.schema.cells import csv_rows, is_missing, with_hyphens
from mixedlub.schema.findings import Finding, finding, report
from mixedlub.schema.long_text import LONG, regular_columns
from mixedlub.schema.ranges import probable_unit
from mixedlub.schema.units import fits, read_as, split, unit_of, words_of
from profiles.errors import InputError, nearest, refuse_no_file
from profiles.units import number_of

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Column:
    """Description of a column: a number within bounds, an integer, or a name (among ``names`` if given).

    ``optional_cells``: empty cells are nan. ``words``: names in instrument files; ``hints``: ambiguous names.
    """

    name: str
    dtype: str = "number"
    above: float = -np.inf
    at_least: float = -np.inf
    at_most: float = np.inf
    required: bool = True
    names: tuple[str, ...] = ()
    optional_cells: bool = False
    meaning: str = ""
    words: tuple[str, ...] = ()
    hints: tuple[str, ...] = ()

    def allows(self, value: float) -> bool:
        """Whether a number lies within the bounds."""
        return value > self.above and self.at_least <= value <= self.at_most

    def parse(self, text: str, where: str) -> float | int | str:
        """Value of a cell; raise an error with the place if it is invalid."""
        text = text.strip()
        if self.dtype == "name":
            if not text:
                raise InputError(f"{self.name} must name something", where=where, value=text)
            if self.names and text not in self.names:
                raise InputError(f"no such name in system.toml; {nearest(text, self.names)}", where=where, value=text)
            return text
        if self.optional_cells and is_missing(text):
            return float("nan")
        try:
            value = number_of(text)
        except ValueError:
            raise InputError(f"{self.name} must be a number", where=where, value=text) from None
        if not np.isfinite(value):
            raise InputError(f"{self.name} must be a finite number", where=where, value=text)
        if not self.allows(value):
            low = value <= self.above
            rule = f"be above {self.above:g}" if low else f"lie between {self.at_least:g} and {self.at_most:g}"
            other = probable_unit(self.name, value, self.at_least, self.at_most) if np.isfinite(self.at_most) else ""
            raise InputError(f"{self.name} must {rule}" + (f"; {other}" if other else ""), where=where, value=value)
        if self.dtype == "whole":
            if value != int(value):
                raise InputError(f"{self.name} must be a whole number", where=where, value=text)
            if abs(value) >= LARGEST:
                raise InputError(f"{self.name} must be a whole number below {LARGEST}", where=where, value=text)
            return int(value)
        return value

    def parse_all(self, cells: Sequence[str]) -> np.ndarray | None:
        """Values of all cells; None if a cell is empty or invalid, for ``parse`` to report."""
        try:
            if self.dtype == "name":
                names = {cell: self.parse(cell, self.name) for cell in set(cells)}
                return np.array([names[cell] for cell in cells])
            values = np.fromiter(map(number_of, cells), float, len(cells))
        except ValueError:
            return None
        return self.converted(values)

    def converted(self, values: np.ndarray | Sequence[str]) -> np.ndarray | None:
        """Numbers in the type of the column, or names; None if one is missing, invalid or of the other sort."""
        if not isinstance(values, np.ndarray):
            return self.parse_all(values) if self.dtype == "name" else None
        if self.dtype == "name":
            return None
        allowed = (values > self.above) & (values >= self.at_least) & (values <= self.at_most) & np.isfinite(values)
        if self.dtype == "whole":
            allowed &= (np.abs(values) < LARGEST) & (values == np.trunc(values))
        if not allowed.all():
            return None
        return values.astype(int) if self.dtype == "whole" else values


LARGEST = 2**53
"""Largest integer up to which doubles represent all integers."""
RUN = Column("run", "whole", meaning="number of the reading, each once")
SETUP = "setup"
GROUPS = ("specimen", "laboratory", "lab", "assembly", "campaign", "session", "file")
"""Headers of columns that name groups of readings, in the order in which one is taken as the set-up."""
MOST_GROUPS = 20
"""Judgement. Most groups of such a column; more are names of single readings."""
BOOKKEEPING = (
    Column("rig", "name", required=False, meaning="which rig or part of it; all share the calibration"),
    Column(
        "sequence",
        at_least=0.0,
        at_most=1.0,
        required=False,
        meaning="place in the test programme, 0 at its start and 1 at its end",
    ),
    Column(SETUP, "name", required=False, meaning="assembly, specimen or laboratory, whose readings share an error"),
)


def sd_column(quantity: str) -> Column:
    """Column of the standard deviations of the readings."""
    meaning = "standard deviation of each reading; 0 or empty: not given; it overrides recording.noise"
    return Column(f"{quantity}_sd", at_least=0.0, required=False, optional_cells=True, meaning=meaning)


def check_column(name: str) -> Column:
    """Column of a second channel."""
    return Column(
        name, required=False, optional_cells=True, meaning="the column that recording.check names: never fitted"
    )


@dataclass(frozen=True)
class Table:
    """Columns of equal length by name; ``ignored``: other headers of the file."""

    columns: Mapping[str, np.ndarray]
    source: str = "table"
    ignored: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def take(self, rows: np.ndarray) -> Table:
        """Rows selected by a mask or index."""
        return Table({name: column[rows] for name, column in self.columns.items()}, self.source)


def read_table(
    path: Path,
    columns: tuple[Column, ...],
    *,
    key: tuple[str, ...] = ("run",),
    first_run: int | None = None,
    imported: bool = False,
) -> Table:
    """Read a CSV with the given columns, unique in the columns of ``key``; other columns are ignored and reported.

    Without a column ``run``, rows are numbered from ``first_run``, if given. ``imported``: table written by `mixedlub
    import`, which messages on other formats and units then name.
    """
    where, advice = str(path), _IMPORTED if imported else _SAVED
    try:
        refuse_no_file(path)
        text = with_hyphens(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise InputError(f"is not text in UTF-8; {advice}", where=where) from None
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=where) from None
    if "\0" in text:
        raise InputError(f"is not a text table; {advice}", where=where)
    long = _long_table(text, columns, key, path.name) if len(text) >= LONG else None
    if long is not None:
        return long
    try:
        lines = [
            line
            for line in csv_rows([*enumerate(text.splitlines(), start=1)], where)
            if any(cell.strip() for cell in line[1])
        ]
    except csv.Error as error:
        raise InputError(f"is not a comma-separated table ({error})", where=where) from None
    header = [cell.strip() for cell in lines[0][1]] if lines else []
    separator = next((mark for mark in (";", "\t") if len(header) == 1 and mark in header[0]), None)
    if separator is not None:
        rule = f"columns are separated by commas, numbers have a decimal point; {advice}"
        raise InputError(rule, where=where, value=separator)
    if first_run is None or RUN.name in map(str.lower, header):
        return _table(lines, columns, key, path.name, where, imported=imported)
    found = _table(lines, tuple(c for c in columns if c != RUN), (), path.name, where, imported=imported)
    runs = np.arange(first_run, first_run + len(found))
    text = f"no column {RUN.name}: rows are numbered from {runs[0]} to {runs[-1]}"
    report(finding("runs_numbered", text, path.name))
    return replace(found, columns={RUN.name: runs, **found.columns})


def _long_table(text: str, columns: tuple[Column, ...], key: tuple[str, ...], source: str) -> Table | None:
    """Table of a long text with known and valid columns only; None for the reading row by row."""
    top, _, body = text.partition("\n")
    header = [cell.strip() for cell in top.split(",")]
    known = {c.name: c for c in columns}
    required = {*key, *(c.name for c in columns if c.required)}
    if not required <= set(header) <= set(known) or len(set(header)) < len(header):
        return None
    cells = regular_columns(body.rstrip("\n"), width=len(header))
    if cells is None:
        return None
    found = {name: known[name].converted(values) for name, values in zip(header, cells, strict=True)}
    valid = {name: values for name, values in found.items() if values is not None}
    if len(valid) < len(found) or any(np.unique(valid[name]).size < len(valid[name]) for name in key):
        return None
    return Table(valid, source)


def frame_of(given: object, where: str) -> pd.DataFrame:
    """Data frame as given, or from columns by name; raise an error at the place ``where`` otherwise.

    >>> frame_of({"speed_rpm": [150.0, 250.0], "load_N": 40.0}, "conditions").shape
    (2, 2)
    """
    import pandas as pd

    if isinstance(given, pd.DataFrame):
        return given
    if not isinstance(given, Mapping):
        rule = f"needs a pandas DataFrame, or lists by the name of their column, not {type(given).__name__}"
        raise InputError(rule, where=where)
    try:
        alone = all(np.ndim(values) == 0 for values in given.values())
        return pd.DataFrame(dict(given), index=[0] if alone else None)
    except ValueError as error:
        raise InputError(f"these columns make no DataFrame ({error})", where=where) from None


def table_of(frame: pd.DataFrame, columns: tuple[Column, ...], source: str = "table") -> Table:
    """Table from a data frame, checked like a file; rows are numbered without a column ``run``."""
    if RUN.name not in frame:
        frame = frame.assign(**{RUN.name: np.arange(1, len(frame) + 1)})
    rows = frame.astype(object).where(frame.notna(), "").astype(str).to_numpy().tolist()
    lines = [(0, list(map(str, frame.columns))), *enumerate(rows, start=1)]
    return _table(lines, columns, (RUN.name,), source, source, unit="row", imported=True)


def _table(
    lines: list[tuple[int, list[str]]],
    columns: tuple[Column, ...],
    key: tuple[str, ...],
    source: str,
    where: str,
    unit: str = "line",
    *,
    imported: bool,
) -> Table:
    """Table from a header and rows of cells, each with its number in ``unit`` (line of a file or row of a frame)."""
    if len(lines) < 2:
        raise InputError("needs a header line and at least one row", where=where)
    header = [cell.strip() for cell in lines[0][1]]
    doubled = {name for name in header if name and header.count(name) > 1}
    if doubled:
        raise InputError("column appears twice", where=where, value=sorted(doubled)[0])
    known = {c.name: c for c in columns}
    header = _with_groups(lines, header, known, source)
    unknown = [name for name in header if name and name not in known]
    for column in columns:
        if column.required and column.name not in header:
            raise InputError(
                f"column {column.name!r} is missing{_instead(column, unknown, imported)}", where=f"{where}: header"
            )
    if unknown:
        absent = [column for column in columns if column.name not in header]
        for found in _ignored(source, unknown, absent, imported):
            report(found)
    cells = _parse(lines, header, known, where, unit)
    together = list(zip(*(cells[name].tolist() for name in key), strict=True))
    if len(set(together)) < len(together):
        first = {values: row for row, values in reversed(list(enumerate(together)))}
        again = next(row for row, values in enumerate(together) if first[values] < row)
        value, named = together[again], " and ".join(key)
        place = f"{where}: {unit} {lines[again + 1][0]}, {named}"
        rule = f"{named} must be unique" + (" together" if len(key) > 1 else "")
        raise InputError(rule, where=place, value=value[0] if len(key) == 1 else value)
    return Table(cells, source, tuple(unknown))


def _with_groups(
    lines: list[tuple[int, list[str]]], header: list[str], known: Mapping[str, Column], source: str
) -> list[str]:
    """The header with a column that names specimens or laboratories taken as the set-up, if there is no such column."""
    if SETUP not in known or SETUP in header:
        return header
    for name in (word for word in GROUPS if word in header and word not in known):
        place = header.index(name)
        cells = [row[place].strip() for _, row in lines[1:] if place < len(row)]
        count = [cells.count(value) for value in dict.fromkeys(cells)]
        if 1 < len(count) <= MOST_GROUPS and min(count) > 1 and all(cells):
            text = f"column taken as {SETUP}: its {len(count)} groups may each have an error of their own"
            report(finding("column_as_setup", text, f"{source}, {name}"))
            return [SETUP if cell == name else cell for cell in header]
    return header


_IMPORTED = "use `mixedlub import`, which reads it and writes the table of a case"
_SAVED = "save it as comma-separated text in UTF-8"
_CONVERTED = {True: "units are not converted here; `mixedlub import` does", False: "units are not converted here"}


def _instead(column: Column, unknown: list[str], imported: bool) -> str:
    """Hint on a missing column: the same column in another unit, a similar name, or the names in the file.

    >>> _instead(Column("speed_rpm"), ["sped_rpm", "colour"], True)
    "; the file has 'sped_rpm'"
    >>> _instead(Column("speed_rpm"), ["speed_rad_s"], True)
    "; the file has 'speed_rad_s': units are not converted here; `mixedlub import` does"
    """
    if not unknown:
        return ""
    other = _other_unit(column, unknown)
    if other:
        return f"; the file has {other!r}: {_CONVERTED[imported]}"
    close = difflib.get_close_matches(column.name, unknown, n=1, cutoff=0.5)
    return (
        f"; the file has {close[0]!r}" if close else f"; the file has {', '.join(map(repr, unknown))}, not known here"
    )


def _ignored(file: str, unknown: list[str], absent: list[Column], imported: bool) -> Iterator[Finding]:
    """Findings on unknown columns; a probable ``absent`` column has a separate finding."""
    converted = [other for column in absent if (other := _other_unit(column, unknown))]
    others = []
    for name in unknown:
        close = None if name in converted else _nearest_absent(name, absent)
        if name in converted:
            yield finding("column_other_unit", f"column ignored: {_CONVERTED[imported]}", f"{file}, {name}")
        elif close is not None:
            yield finding("column_near_known", f"column ignored; nearest known: {close!r}", f"{file}, {name}")
        else:
            others.append(name)
    if others:
        yield finding("columns_unknown", f"columns ignored because they are not known: {', '.join(others)}", file)


def _nearest_absent(name: str, absent: list[Column]) -> str | None:
    """Absent column probably meant by an ignored column: of the same unit or a similar name.

    >>> _nearest_absent("load_Nm", [Column("load_N"), Column("torque_Nm"), Column("motor_torque_Nm")])
    'torque_Nm'
    >>> _nearest_absent("colour", [Column("torque_Nm")]), _nearest_absent("surface2", [Column("surface_2")])
    (None, 'surface_2')
    >>> _nearest_absent("power_loss_sd", [Column("power_loss_W_sd")])
    'power_loss_W_sd'
    """
    unit = unit_of(name)
    known = [c.name for c in absent if c.name.endswith("_sd") == name.endswith("_sd")]
    alike = [other for other in known if unit and unit_of(other) == unit]
    close = difflib.get_close_matches(name, alike or known, n=1, cutoff=0.0 if alike else 0.8)
    return close[0] if close else None


def _other_unit(column: Column, unknown: list[str]) -> str | None:
    """Header of the same column in another unit, convertible by the import."""
    for name in unknown:
        unit = split(name)[1]
        if unit and words_of(name) in (split(column.name)[0], *column.words) and fits(unit, read_as(column.name)):
            return name
    return None


def _parse(
    lines: list[tuple[int, list[str]]], header: list[str], known: Mapping[str, Column], where: str, unit: str
) -> dict[str, np.ndarray]:
    if all(len(row) == len(header) for _, row in lines):
        columns = dict(zip(header, zip(*(row for _, row in lines[1:]), strict=True), strict=True))
        found = {name: known[name].parse_all(texts) for name, texts in columns.items() if name in known}
        if all(values is not None for values in found.values()):
            return {name: values for name, values in found.items() if values is not None}
    # A cell is empty or invalid: parse cell by cell, so that the error names the first one.
    cells: dict[str, list[float | int | str]] = {name: [] for name in header if name in known}
    for number, row in lines[1:]:
        if len(row) != len(header):
            raise InputError(
                f"has {len(row)} cells where the header has {len(header)}", where=f"{where}: {unit} {number}"
            )
        for name, cell in zip(header, row, strict=True):
            if name in known:
                cells[name].append(known[name].parse(cell, f"{where}: {unit} {number}, {name}"))
    return {name: np.array(values) for name, values in cells.items()}
