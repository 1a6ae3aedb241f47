"""Instrument files as text: plain, compressed by gzip, in UTF-16, or a sheet of a workbook."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from mixedlub.importers.base import HIDDEN_ROWS, SHEET, Answers, read_note
from mixedlub.importers.long_table import long_sheet
from mixedlub.importers.measured import MeasuredTable, joined
from mixedlub.importers.odd_rows import count, places
from mixedlub.importers.text_table import Sheet, read_sheet
from mixedlub.schema.cells import with_hyphens
from mixedlub.schema.discovery import loaded
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError, nearest, refuse_no_file
from profiles.readers.archive import refuse_broken, unpacked
from profiles.readers.base import MAX_BYTES
from profiles.readers.numbers import decoded
from profiles.readers.workbook import Worksheet, is_workbook, longest, worksheets

BYTE_ORDER_MARKS = (b"\xff\xfe", b"\xfe\xff")
SAMPLE_LENGTH = 4096
"""Characters at the start of a file that are checked to be text."""


NO_TABLES = {
    "JSON": re.compile(r"\s*(?:\{\s*[\"}]|\[\s*[\[{\"])"),
    "HTML or XML": re.compile(r"\s*<(?:[!?]|html\b)", re.IGNORECASE),
}
"""Starts of texts without a table, by name of their format."""
READ_FORMS = (
    "text with a header line and a row for each reading (.csv, .txt, .lvm), workbooks (.xlsx), .tdms, .mat and .mf4"
)


@dataclass(frozen=True, eq=False)
class InputFile:
    """Input file: name, text and notes; its table is read once."""

    name: str
    text: str
    notes: tuple[Finding, ...] = ()
    is_workbook: bool = False
    measured: Sheet | None = None
    tables: dict[tuple[str | None, int | None], Sheet] = field(default_factory=dict, repr=False)

    def table(self, decimal: str | None = None, number: int | None = None) -> Sheet:
        """Table in the text; ``decimal``: decimal mark from an answer; ``number``: of several tables, from 1."""
        if self.measured is not None:
            return self.measured
        if (decimal, number) not in self.tables:
            given = (self.text, self.name, decimal, "\t" if self.is_workbook else "")
            self.tables[decimal, number] = long_sheet(*given) or read_sheet(*given, number)
        return self.tables[decimal, number]


def open_file(path: Path, answers: Answers) -> InputFile:
    """Text of a file; for a workbook, of the answered sheet or else the visible sheet with the longest table."""
    try:
        refuse_no_file(path)
        data = path.read_bytes()
    except InputError:
        raise
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    data = unpacked(data, path.name, MAX_BYTES)
    refuse_broken(data, path.name)
    if is_workbook(data):
        return _from_workbook(worksheets(data, path.name), path.name, answers)
    form = next((form for form in _formats() if form.matches(data)), None)
    if form is not None:
        return _from_tables(form.tables(data, path.name), path.name, answers)
    text = with_hyphens(decoded(_with_mark(data), path.name))
    if "\0" in text[:SAMPLE_LENGTH]:
        raise InputError("is not a text file or workbook; export it as text first", where=path.name)
    markup = next((name for name, form in NO_TABLES.items() if form.match(text)), None)
    if markup is not None:
        raise InputError(f"is {markup}, which is no table; import reads {READ_FORMS}", where=path.name)
    return InputFile(path.name, text)


@cache
def _formats() -> tuple[Any, ...]:
    """Modules of the binary formats, of other packages first."""
    return tuple(reversed(loaded("mixedlub.importers.formats", "mixedlub.importers.formats")))


def _from_tables(tables: Sequence[MeasuredTable], name: str, answers: Answers) -> InputFile:
    """The answered table of a binary file, or else its longest one with the channels of other clocks."""
    if not tables:
        raise InputError("holds no channel of numbers", where=name)
    wanted, by_name = answers.get(SHEET), {table.name: table for table in tables}
    if wanted is not None and str(wanted) not in by_name:
        raise InputError(f"no such table in {name}; {nearest(str(wanted), by_name)}", where=SHEET, value=wanted)
    chosen, how = joined(tables) if wanted is None else (by_name[str(wanted)], "")
    others = ", ".join(repr(table.name) for table in tables if table.name != chosen.name)
    notes = [read_note(how, name)] if how else []
    if others:
        why = "" if wanted is not None else f", the longest; {SHEET} names another"
        notes.append(read_note(f"table {chosen.name!r} is read{'' if how else f', not {others}'}{why}", name))
    return InputFile(name, "", tuple(notes), is_workbook=True, measured=chosen.sheet(name))


def _with_mark(data: bytes) -> bytes:
    """UTF-16 data with a byte order mark added if missing; in Western text every second byte is zero.

    >>> _with_mark("load_N".encode("utf-16-le"))[:2], _with_mark("load_N".encode("utf-16-be"))[:2], _with_mark(b"load")
    (b'\\xff\\xfe', b'\\xfe\\xff', b'load')
    """
    if data[:2] in BYTE_ORDER_MARKS:
        return data
    even, odd = data[:SAMPLE_LENGTH:2], data[1:SAMPLE_LENGTH:2]
    if 10 * odd.count(0) > 9 * len(odd) > 0 and not even.count(0):
        return BYTE_ORDER_MARKS[0] + data
    if 10 * even.count(0) > 9 * len(even) > 0 and not odd.count(0):
        return BYTE_ORDER_MARKS[1] + data
    return data


def _from_workbook(sheets: tuple[Worksheet, ...], name: str, answers: Answers) -> InputFile:
    wanted = answers.get(SHEET)
    by_name = {sheet.name: sheet for sheet in sheets}
    if wanted is not None and str(wanted) not in by_name:
        raise InputError(f"no such sheet in {name}; {nearest(str(wanted), by_name)}", where=SHEET, value=wanted)
    chosen = longest(sheets, name) if wanted is None else by_name[str(wanted)]
    notes = []
    if len(sheets) > 1:
        hidden = {True: " (hidden)", False: ""}
        others = ", ".join(repr(s.name) + hidden[s.is_hidden] for s in sheets if s.name != chosen.name)
        of_visible = " of those that are visible" if any(s.is_hidden for s in sheets) else ""
        why = "" if wanted is not None else f", as its table is the longest{of_visible}; {SHEET} names another"
        notes.append(read_note(f"sheet {chosen.name!r}{hidden[chosen.is_hidden]} is read, not {others}{why}", name))
    if chosen.as_text:
        notes.append(read_note(f"{_columns(chosen.as_text)}: numbers stored as text, read as numbers", name))
    text, hidden_rows = _visible(chosen, name, answers)
    notes += hidden_rows
    if chosen.percent:
        columns = _columns(chosen.percent)
        notes.append(finding("percent_as_stored", f"{columns} shown in percent, taken as stored: 5 % is 0.05", name))
    return InputFile(name, with_hyphens(text), tuple(notes), is_workbook=True)


def _columns(letters: Sequence[str]) -> str:
    return ("column " if len(letters) == 1 else "columns ") + ", ".join(letters)


def _visible(sheet: Worksheet, name: str, answers: Answers) -> tuple[str, list[Finding]]:
    """Text of a sheet without hidden rows, unless an answer takes them, and a finding on them."""
    choice = answers.get(HIDDEN_ROWS, "leave")
    if choice not in ("take", "leave"):
        raise InputError("must be 'take' or 'leave'", where=HIDDEN_ROWS, value=choice)
    lines = sheet.text.split("\n")
    hidden = [row for row in sheet.hidden_rows if row <= len(lines) and lines[row - 1].strip()]
    if not hidden:
        return sheet.text, []
    rows = f"{count(len(hidden), 'row')} that the workbook hides, by a filter or by hand"
    if choice == "take":
        return sheet.text, [read_note(f"{rows}: taken, as answered: {places(hidden)}", name)]
    for row in hidden:
        lines[row - 1] = ""
    text = f"{rows}: left out ({places(hidden)}); --set '{HIDDEN_ROWS}=\"take\"' takes them"
    return "\n".join(lines), [finding("rows_left_out", text, name)]
