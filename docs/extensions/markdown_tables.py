"""Tables in Markdown: rows under a head, the keys of a file, the columns of tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

KEY_HEAD = ("key", "unit", "default", "allowed", "meaning")


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Rows under a head.

    >>> print(table(("key", "meaning"), [("teeth", "z_1|z_2")]))
    | key | meaning |
    |---|---|
    | teeth | z_1\\|z_2 |
    """
    first = tuple(head)
    cells = ((cell.replace("|", "\\|") for cell in row) for row in rows)
    return "\n".join([_line(first), "|---" * len(first) + "|", *map(_line, cells)])


def named_table(head: Iterable[str], rows: Iterable[tuple[str, ...]]) -> str:
    """Rows under a head, the first column as code.

    >>> print(named_table(("key", "meaning"), [("teeth", "numbers of teeth")]))
    | key | meaning |
    |---|---|
    | `teeth` | numbers of teeth |
    """
    return table(head, ((f"`{name}`", *rest) for name, *rest in rows))


def key_tables(file: type) -> str:
    """The keys of every table of a file."""
    from mixedlub.schema.section import tables

    return "\n\n".join(part for table in tables(file) for part in keys(table))


def keys(of: Any, use: str = "") -> Iterator[str]:
    """A table of a file: its meaning and its keys, each with the meanings of its values."""
    from mixedlub.report.format_reference import key_row

    yield f"### [{of.title}]" if of.title else "### Top of the file"
    if of.meaning:
        yield f"{of.meaning[:1].upper()}{of.meaning[1:]}.{use}"
    rows = []
    for key in of.keys:
        *facts, meaning = key_row(key)
        values = "; ".join(f"`{value}`: {text}" for value, text in key.values.items())
        rows.append((*facts, f"{meaning} ({values})" if values else meaning))
    if rows:
        yield named_table(KEY_HEAD, rows)


def columns(tables: Mapping[str, Iterable[Any]]) -> str:
    """Name, unit and meaning of the columns of each table.

    >>> from types import SimpleNamespace
    >>> print(columns({"a.csv": [SimpleNamespace(name="load", unit="N", meaning="force")]}).splitlines()[-1])
    | `load` | N | force |
    """
    head = ("column", "unit", "meaning")
    return "\n\n".join(
        f"### {title}\n\n{named_table(head, [(c.name, c.unit, c.meaning) for c in of_table])}"
        for title, of_table in tables.items()
    )


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"
