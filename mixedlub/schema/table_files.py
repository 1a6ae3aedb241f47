"""Tables as CSV, Parquet and workbook, with unit and meaning of every column."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa

    from mixedlub.schema.result import ResultColumn

THREADS = 2
"""Threads that format numbers as text, the slowest step; each holds one table as text."""
DIGITS = "%.12g"
"""Format of numbers in CSV files, precise enough for parts to add up to their total within 1e-9."""
FORMULA = r"^([=+\-@\t\r])"
"""Start of a text read as a formula by spreadsheets."""
MOST_SHEET_ROWS, LONGEST_SHEET_NAME = 1_048_574, 31
"""Limits of a workbook sheet: rows besides two header rows, and length of its name."""


@dataclass(frozen=True)
class CsvStyle:
    """Separator and decimal mark of a CSV file."""

    separator: str = ","
    decimal: str = "."


STYLES = {"plain": CsvStyle(), "german": CsvStyle(";", ",")}


@dataclass(frozen=True)
class LongTable:
    """Table of any length, in pieces with the same columns.

    ``about``: metadata of the whole; ``quoted``: texts may need quotes or escapes in CSV; ``repeating``: columns with
    repeated values; ``csv``: short enough for CSV beside Parquet.
    """

    pieces: Callable[[], Iterable[pa.Table]]
    names: tuple[str, ...]
    about: Mapping[str, str] = field(default_factory=dict)
    quoted: bool = True
    repeating: tuple[str, ...] = ()
    csv: bool = True


def escaped(text: Any) -> Any:
    """Text safe from being read as a formula by spreadsheets; other values unchanged.

    >>> escaped("=1+1"), escaped("ground"), escaped(-1.0)
    ("'=1+1", 'ground', -1.0)
    """
    return re.sub(FORMULA, r"'\1", text) if isinstance(text, str) else text


def write_frame(
    table: pd.DataFrame, columns: Sequence[ResultColumn], csv: Path, parquet: Path, style: CsvStyle, title: str = ""
) -> None:
    """Write a table to a CSV and a Parquet file."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    csv.write_bytes(_as_text(table, style).encode())
    mixed = [name for name in table.columns if table[name].dtype == object and table[name].map(type).nunique() > 1]
    arrow = pa.Table.from_pandas(table.astype(dict.fromkeys(mixed, str)), preserve_index=False)
    pq.write_table(arrow.cast(_described(arrow.schema, columns, {"title": title})), parquet)


def write_long(
    table: LongTable, columns: Sequence[ResultColumn], csv: Path, parquet: Path, style: CsvStyle = STYLES["plain"]
) -> None:
    """Write the pieces of a table to a CSV and a Parquet file."""
    import pyarrow.parquet as pq

    waiting: deque[Future[pa.Buffer]] = deque()
    with ExitStack() as files, ThreadPoolExecutor(THREADS) as pool:
        text: BinaryIO | None = files.enter_context(csv.open("wb")) if table.csv else None
        writer: pq.ParquetWriter | None = None
        for piece in table.pieces():
            if text is not None:
                waiting.append(pool.submit(_as_csv, piece, style, header=writer is None, quoted=table.quoted))
            if writer is None:
                schema = _described(piece.schema, columns, table.about)
                writer = files.enter_context(pq.ParquetWriter(parquet, schema, use_dictionary=list(table.repeating)))
            writer.write_table(piece)
            while text is not None and len(waiting) > THREADS:
                text.write(waiting.popleft().result())
        while text is not None and waiting:
            text.write(waiting.popleft().result())


def write_workbook(
    tables: Mapping[str, tuple[pd.DataFrame | LongTable, Sequence[ResultColumn]]], path: Path
) -> list[str]:
    """Write one sheet per table (names and units in two frozen rows, then values) and a last sheet of meanings.

    Returns the names of tables too long for a sheet, which are left out.
    """
    from openpyxl import Workbook

    book, about, left_out = Workbook(write_only=True), [("table", "column", "unit", "meaning")], []
    for name, (table, columns) in tables.items():
        sheet = book.create_sheet(name[:LONGEST_SHEET_NAME])
        sheet.freeze_panes = "A3"
        sheet.append([escaped(c.name) for c in columns])
        sheet.append([c.unit for c in columns])
        about += [(name, escaped(c.name), c.unit, c.meaning) for c in columns]
        for number, row in enumerate(_rows(table)):
            if number == MOST_SHEET_ROWS:
                left_out.append(name)
                break
            sheet.append([_cell(value) for value in row])
    last = book.create_sheet("columns")
    last.freeze_panes = "A2"
    for line in about:
        last.append(line)
    book.save(path)
    return left_out


def _rows(table: pd.DataFrame | LongTable) -> Iterator[Iterable[Any]]:
    if not isinstance(table, LongTable):
        yield from table.itertuples(index=False, name=None)
        return
    for piece in table.pieces():
        yield from zip(*(column.to_pylist() for column in piece.columns))


def _cell(value: Any) -> Any:
    """Value for a workbook: formulas escaped, non-finite numbers empty."""
    value = value.item() if hasattr(value, "item") else value
    return None if isinstance(value, float) and value - value != 0.0 else escaped(value)


def _as_text(table: pd.DataFrame, style: CsvStyle, *, header: bool = True) -> str:
    """Table as CSV, with texts safe from being read as formulas."""
    texts = [name for name in table.columns if table[name].dtype.kind not in "fiub"]
    plain = table.assign(**{name: table[name].map(escaped) for name in texts}).rename(columns=escaped)
    sep, decimal = style.separator, style.decimal
    return str(
        plain.to_csv(
            None, index=False, header=header, lineterminator="\n", sep=sep, decimal=decimal, float_format=DIGITS
        )
    )


def _as_csv(table: pa.Table, style: CsvStyle, *, header: bool, quoted: bool) -> pa.Buffer:
    import pyarrow as pa
    import pyarrow.compute as pc
    from pyarrow.csv import WriteOptions, write_csv

    if style != STYLES["plain"]:
        text = _as_text(table.to_pandas(), style, header=header)
        return pa.py_buffer(text.encode())
    for place, one in enumerate(table.schema):
        if pa.types.is_string(one.type) and quoted:
            table = table.set_column(place, one.name, pc.replace_substring_regex(table[place], FORMULA, r"'\1"))
    options = WriteOptions(include_header=header, quoting_style="needed" if quoted else "none", quoting_header="none")
    sink = pa.BufferOutputStream()
    write_csv(table, sink, options)
    return sink.getvalue()


def _described(schema: pa.Schema, columns: Collection[ResultColumn], about: Mapping[str, str]) -> pa.Schema:
    """Schema with unit and meaning of each column and the metadata of the table."""
    import pyarrow as pa

    known = {c.name: {"unit": c.unit, "meaning": c.meaning} for c in columns}
    return pa.schema([one.with_metadata(known[one.name]) for one in schema], metadata=dict(about))
