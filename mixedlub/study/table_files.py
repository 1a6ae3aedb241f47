"""Tables of any length as CSV and Parquet, the latter with unit and meaning of every column."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from mixedlub.study.columns import Column

if TYPE_CHECKING:
    import pyarrow as pa


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
    """Write tables of the same columns one after another, both files at a time.

    ``about`` is the metadata of the whole, ``quoted`` whether a text may need quotes in CSV, ``repeating`` the columns
    in which values repeat.
    """
    import pyarrow as pa
    import pyarrow.csv as pc
    import pyarrow.parquet as pq

    known = {c.name: c for c in columns}
    options = pc.WriteOptions(quoting_style="needed" if quoted else "none", quoting_header="none")
    writers: list[pc.CSVWriter | pq.ParquetWriter] = []
    with ExitStack() as open_files, ThreadPoolExecutor(2) as pool:
        for table in tables:
            if not writers:
                described = [
                    f.with_metadata({"unit": known[f.name].unit, "meaning": known[f.name].meaning})
                    for f in table.schema
                ]
                schema = pa.schema(described, metadata=dict(about))
                writers = [
                    open_files.enter_context(pc.CSVWriter(csv, table.schema, write_options=options)),
                    open_files.enter_context(pq.ParquetWriter(parquet, schema, use_dictionary=repeating)),
                ]
            list(pool.map(lambda writer, part=table: writer.write_table(part), writers))
