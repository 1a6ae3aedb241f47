"""Reference of the file formats: columns of each kind of case, keys of `system.toml` and of a study file.

All content comes from the declarations of columns and keys: the kinds, and the classes of the files.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any, Literal, get_args, get_origin

import numpy as np

from mixedlub.chain.documented import described
from mixedlub.chain.plain_text import entry
from mixedlub.evaluate import EVALUATIONS
from mixedlub.friction import catalogue
from mixedlub.kinds import KINDS, Kind, kind
from mixedlub.report.file_classes import EVERY_CASE, FILES, file_class, file_title
from mixedlub.schema.section import FileTable, Key, Section, plain, tables
from mixedlub.schema.system_file import System
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, check_column, sd_column
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import unit_of
from profiles.errors import InputError, nearest

WIDTH = 80
"""Columns of a terminal."""
LEAST_MEANING_WIDTH = 22
"""Smallest width of a meaning to the right of its key: about three words."""
FRICTION_LAWS = "friction-laws"
_GAP = "  "

Row = tuple[str, ...]
"""Cells of a line; the last is the meaning."""


def kinds_text(name: str | None = None) -> str:
    """Format of a kind of case, of all kinds, of a study file, or of a file of another command."""
    if name in FILES:
        return "\n".join(_file(file_title(name), file_class(name)))
    if name == FRICTION_LAWS:
        return "\n".join(_friction_laws())
    if name is not None and name not in KINDS:
        if name in EVALUATIONS:
            return "\n".join(_evaluation(name))
        known = (*KINDS, *FILES, FRICTION_LAWS, *EVALUATIONS)
        raise InputError(f"no such kind; {nearest(name, known)}", where="KIND", value=name)
    chosen = [kind(n) for n in (KINDS if name is None else (name,))]
    taken = {*EVERY_CASE, *(section for k in chosen for section in (*k.sections, *k.uses))}
    lines = [] if name else [f"{len(KINDS)} kinds of case. `mixedlub kinds KIND` shows one, with the keys it takes;"]
    lines += (
        []
        if name
        else ["Files: `mixedlub kinds study`, `factors`, `gear`, `bevel`, `worm`, `efficiency`,", "`ehl`, `law`."]
    )
    for k in chosen:
        lines += ["", *_kind(k)]
    lines += ["", "columns of every kind (conditions.csv has all but the reading)", *aligned(common_rows())]
    lines += ["", "keys of system.toml: unit, default, what is allowed, meaning"]
    for table in tables(System):
        if table.name.split(".")[0] in taken:
            lines += ["", *_title(table), *(_users(table) if name is None else ()), *_keys(table)]
    return "\n".join(lines).lstrip("\n")


def _file(what: str, file: type[Section]) -> Iterator[str]:
    yield from _wrapped(f"keys of {what}: unit, default, what is allowed, meaning", 0, 2)
    for table in tables(file):
        yield from ("", *_title(table), *_keys(table))


def _evaluation(name: str) -> Iterator[str]:
    one = EVALUATIONS[name]
    yield from _wrapped(f"{name}: {one.about}", 0, 2)
    yield from _wrapped(f"source: {one.source}", 2, 4)
    for table, columns in one.columns.items():
        yield from ("", f"columns of {table}", *aligned(column_rows(columns)))
    yield ""
    yield from _file(f"a file of `mixedlub evaluate {name}`", one.file)


def _friction_laws() -> Iterator[str]:
    """Coefficients of laws, by the table of a file for `--coefficients`."""
    about = (
        "keys of a file for `mixedlub friction-laws --study STUDY.toml --coefficients FILE.toml`: a table a law, whose "
        "keys a study takes in `friction_coefficients` as well"
    )
    yield from _wrapped(about, 0, 2)
    yield "condensed = FILE.toml, which `mixedlub condense` or `mixedlub evaluate` wrote"
    for law in catalogue().values():
        if law.coefficients and not law.of_oil:
            width = 4 + max(len(c.name) for c in law.coefficients)
            yield from ("", f"[{law.name}]  {law.title}")
            yield from (entry(f"  {c.name}", described(c), width) for c in law.coefficients)


def about(kind_name: str) -> str:
    """Line on the recorded quantity of a kind of case.

    >>> about("viscosity")
    'viscosity: viscosity of a sample against temperature and pressure'
    """
    text = kind(kind_name).about
    return f"{kind_name}: {text[:1].lower()}{text[1:].rstrip('.')}"


def _kind(k: Kind) -> Iterator[str]:
    yield from _wrapped(about(k.name), 0, 2)
    used = f"; uses where given {_named(k.uses)}" if k.uses else ""
    yield from _wrapped(f"needs {_named(k.sections) or 'no section but [recording]'}{used}", 2, 4)
    yield from _wrapped(f"base model: {k.base_model}", 2, 4)
    if k.part_rigs:
        rigs = " or ".join(k.part_rigs)
        yield from _wrapped(f"readings of the rig {rigs} are compared with a part of the base model", 2, 4)
    yield from aligned(kind_rows(k), indent=4)


def kind_rows(k: Kind) -> list[Row]:
    """The columns of a kind, readings last."""
    if k.shown:
        return [_column(c, unit="any") for c in k.shown]
    one = "reading" if len(k.readings) == 1 else "one of these"
    rows = [_column(c) for c in (*k.columns, *k.instrument_channels)]
    return [*rows, *(_column(c, needed=one) for c in k.readings)]


def column_rows(columns: Sequence[Column]) -> list[Row]:
    """Rows of columns of any table."""
    return [_column(c) for c in columns]


def _named(sections: Sequence[str]) -> str:
    """Table names as written in the file.

    >>> _named(["contact", "surfaces"])
    '[contact] [surfaces.NAME]'
    """
    titles = {table.name: table.title for table in tables(System)}
    return " ".join(f"[{titles[section]}]" for section in sections)


def common_rows() -> list[Row]:
    """The columns common to all kinds."""
    sd, check = sd_column("READING"), check_column("CHECK")
    return [*map(_column, (RUN, *BOOKKEEPING)), _column(sd, unit="as read"), _column(check, unit="any")]


def _column(c: Column, needed: str = "", unit: str = "") -> Row:
    unit = "" if c.dtype == "name" else unit or unit_of(c.name) or "-"
    return c.name, unit, needed or ("required" if c.required else "optional"), _bounds(c), c.meaning


def _bounds(c: Column) -> str:
    if c.dtype != "number":
        return {"whole": "whole number"}.get(c.dtype, c.dtype)
    if np.isfinite(c.above):
        return f"above {c.above:g}"
    return _span(c.at_least, c.at_most)


def _span(low: float, high: float, number: str = "number") -> str:
    """A range of numbers as text.

    >>> _span(0.0, 1.0), _span(0.0, np.inf), _span(-np.inf, np.inf)
    ('0 to 1', 'from 0', 'number')
    """
    if not np.isfinite(low):
        return number
    return f"{low:g} to {high:g}" if np.isfinite(high) else f"from {low:g}"


def _title(table: FileTable) -> Iterator[str]:
    if not table.title:
        yield "top of the file"
        return
    yield from _wrapped(f"[{table.title}]  {table.meaning}", 0, 4)


def _users(table: FileTable) -> Iterator[str]:
    """Kinds that need or use a table, as text."""
    needed = [n for n in KINDS if table.name in kind(n).sections]
    used = [n for n in KINDS if table.name in kind(n).uses]
    for word, names in (("needed by", needed), ("used where given by", used)):
        if names:
            yield from _wrapped(f"{word} {', '.join(names)}", 2, 4)


def _keys(table: FileTable) -> Iterator[str]:
    """Keys of a table, and the meaning of each allowed value if there are few."""
    for key, lines in zip(table.keys, _blocks([key_row(key) for key in table.keys], 2), strict=True):
        yield from lines
        yield from aligned([(toml_value(value), meaning) for value, meaning in key.values.items()], indent=6)


def key_row(key: Key) -> Row:
    """A key with its unit, default, allowed values and meaning."""
    allowed, numeric = _allowed(key.type, key)
    unit = (key.unit or "-") if numeric else ""
    default = "required" if key.required else _default(key.field.get_default(call_default_factory=True))
    return key.name, unit, default, allowed, key.meaning


def _allowed(annotation: Any, key: Key) -> tuple[str, bool]:
    """Allowed values of a key, and whether they are numbers."""
    of = plain(annotation)
    entries = get_args(of)
    if get_origin(of) is tuple:
        one, numeric = _allowed(entries[0], key)
        return f"list of {one}" if entries[-1] is ... else f"[{one}] x {len(entries)}", numeric
    if get_origin(of) is Literal:
        return ("one of these" if key.values else "see above" if len(entries) > 1 else toml_value(entries[0])), False
    if get_origin(of) is dict:
        return "tables" if get_origin(entries[1]) is dict else "table", False
    if of in (bool, str):
        return "see above" if key.is_looked_up else {bool: "true, false", str: "text"}[of], False
    ends = (-np.inf, np.inf) if key.range is None else key.range.possible
    return _span(*ends, number="whole number" if of is int else "number"), True


def _default(value: Any) -> str:
    """Default of a key as TOML in the fewest digits.

    >>> _default((206.0, 0.05)), _default(None), _default(1.5)
    ('[206, 0.05]', '-', '1.5')
    """
    return "-" if value is None else re.sub(r"\.0(?=[,\]]|$)", "", toml_value(value))


def _wrapped(text: str, indent: int, hanging: int) -> list[str]:
    return textwrap.wrap(
        text, WIDTH, initial_indent=" " * indent, subsequent_indent=" " * hanging, break_on_hyphens=False
    )


def aligned(rows: Sequence[Row], indent: int = 2) -> list[str]:
    """Rows as lines in columns, the last cell wrapped."""
    return [line for lines in _blocks(rows, indent) for line in lines]


def _blocks(rows: Sequence[Row], indent: int) -> Iterator[list[str]]:
    """Lines of each row, in columns; the meaning is in the last column, or below if that is too narrow."""
    widths = [max(map(len, cells)) for cells in zip(*rows, strict=True)][:-1]
    width_before = indent + sum(widths) + len(_GAP) * len(widths)
    below = WIDTH - width_before < LEAST_MEANING_WIDTH
    for *facts, meaning in rows:
        start = " " * indent + _GAP.join(f"{cell:{width}}" for cell, width in zip(facts, widths, strict=True))
        lines = _wrapped(meaning, *(2 * [indent + 4 if below else width_before]))
        yield [start.rstrip(), *lines] if below else [start + lines[0][len(start) :], *lines[1:]]
