"""Tables of any length as CSV and Parquet, the latter with unit and meaning of every column."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from mixedlub.study.columns import Column

if TYPE_CHECKING:
    import pyarrow as pa

THREADS = 2
"""Threads that write numbers as text, which takes longest; each holds one table as text."""


def write_tables(
    tables: Iterable[pa.Table],
    columns: Iterable[Column],
    about: Mapping[str, str],
    *,
    csv: Path,
    parquet: Path,
    quoted: bool,
    repeating: list[str],
) -> None:
    """Write tables of the same columns one after another into both files.

    ``about`` is the metadata of the whole, ``quoted`` whether a text may need quotes in CSV, ``repeating`` the columns
    in which values repeat.
    """
    import pyarrow.parquet as pq

    known = {c.name: c for c in columns}
    waiting: deque[Future[pa.Buffer]] = deque()
    with ExitStack() as files, ThreadPoolExecutor(THREADS) as pool:
        text = files.enter_context(csv.open("wb"))
        writer: pq.ParquetWriter | None = None
        for table in tables:
            waiting.append(pool.submit(_as_csv, table, header=writer is None, quoted=quoted))
            if writer is None:
                schema = _described(table.schema, known, about)
                writer = files.enter_context(pq.ParquetWriter(parquet, schema, use_dictionary=repeating))
            writer.write_table(table)
            if len(waiting) > THREADS:
                text.write(waiting.popleft().result())
        for part in waiting:
            text.write(part.result())


def _as_csv(table: pa.Table, *, header: bool, quoted: bool) -> pa.Buffer:
    import pyarrow as pa
    import pyarrow.csv as pc

    options = pc.WriteOptions(
        include_header=header, quoting_style="needed" if quoted else "none", quoting_header="none"
    )
    sink = pa.BufferOutputStream()
    pc.write_csv(table, sink, options)
    return sink.getvalue()


def _described(schema: pa.Schema, known: Mapping[str, Column], about: Mapping[str, str]) -> pa.Schema:
    """The columns with unit and meaning, and the metadata of the table."""
    import pyarrow as pa

    fields = [f.with_metadata({"unit": known[f.name].unit, "meaning": known[f.name].meaning}) for f in schema]
    return pa.schema(fields, metadata=dict(about))
