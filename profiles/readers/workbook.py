"""Workbooks (xlsx) as text tables: styles and texts by the library openpyxl, rows straight from the XML."""

from __future__ import annotations

import csv
import io
import re
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any
from xml.parsers import expat

from profiles.errors import InputError
from profiles.readers.archive import check_archive, members
from profiles.readers.base import foreign_parser

UNCALCULATED = "#FORMULA"
"""Cell of a formula without a calculated value in the file."""
_NUMBER = re.compile(
    r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+|\d{1,3}(?:[ '’]\d{3})+(?:[.,]\d*)?|\d{1,3}(?:([.,])\d{3})(?:\1\d{3})*[.,]\d+)"
    r"(?:[eE][-+]?\d+)?"
)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?")
"""A number with commas as thousands separators."""
_ENGLISH = re.compile(r"[-+]?[1-9]\d{0,2}(?:(?:,\d{3})+\.\d*|(?:,\d{3}){2,})")
"""A number with commas that can only be thousands separators."""
_POINTED = re.compile(r"[-+]?[1-9]\d{0,2}(?:\.\d{3})+")
"""A number with points that may be thousands separators."""
LAST_ROW, LAST_COLUMN = 1_048_576, 16_384
"""Size of a sheet in the format."""


@dataclass(frozen=True)
class Worksheet:
    """A sheet of a workbook: a line of text a row, tabs between cells; number of rows with numbers.

    ``percent``: letters of the columns with numbers shown times 100; ``as_text``: columns with numbers stored as text.
    ``hidden_rows`` are in the text too.
    """

    name: str
    text: str
    rows: int
    percent: tuple[str, ...] = ()
    as_text: tuple[str, ...] = ()
    is_hidden: bool = False
    hidden_rows: tuple[int, ...] = ()


def is_workbook(data: bytes) -> bool:
    """Whether the bytes are an xlsx file."""
    return "xl/workbook.xml" in members(data)


def worksheets(data: bytes, where: str) -> tuple[Worksheet, ...]:
    """Sheets of a workbook, with the values of formulas when it was saved."""
    check_archive(data, where)
    from openpyxl.reader.excel import ExcelReader
    from openpyxl.styles.stylesheet import apply_stylesheet

    # openpyxl remarks on styles it does not know, which is nothing to the user of a table.
    with foreign_parser("xlsx", where), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        reader = ExcelReader(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        reader.read_manifest()
        reader.read_strings()
        reader.read_workbook()
        apply_stylesheet(reader.archive, reader.wb)
        found = [(sheet, rel) for sheet, rel in reader.parser.find_sheets() if rel.target in reader.valid_files]
        return tuple(
            _Rows(reader, where, sheet.name, sheet.state != "visible").read(reader.archive.read(relation.target))
            for sheet, relation in found
            if "chartsheet" not in relation.Type
        )


def longest(sheets: Iterable[Worksheet], where: str) -> Worksheet:
    """The visible sheet with most rows of numbers; the first of several."""
    every = tuple(sheets)
    found = max((sheet for sheet in every if not sheet.is_hidden), key=lambda sheet: sheet.rows, default=None)
    if found is None or not found.rows:
        hidden = [repr(sheet.name) for sheet in every if sheet.is_hidden and sheet.rows]
        rule = "no sheet of the workbook holds numbers"
        raise InputError(f"{rule} but {', '.join(hidden)}, which is hidden" if hidden else rule, where=where)
    return found


@dataclass
class _Rows:
    """The rows of one sheet as its XML is parsed."""

    reader: Any
    where: str
    name: str
    is_hidden: bool
    cells: dict[int, list[str]] = field(default_factory=dict)
    numbered: set[int] = field(default_factory=set)
    hidden: list[int] = field(default_factory=list)
    percent: set[int] = field(default_factory=set)
    texts: list[tuple[int, int]] = field(default_factory=list)
    row: int = 0
    column: int = 0
    cell: dict[str, str] = field(default_factory=dict)
    value: list[str] = field(default_factory=list)
    is_value: bool = False
    is_phonetic: bool = False
    is_formula: bool = False

    def __post_init__(self) -> None:
        book = self.reader.wb
        self.strings = self.reader.shared_strings
        self.dates = book._date_formats | book._timedelta_formats
        self.percent_styles = {str(i) for i, style in enumerate(book._cell_styles) if "%" in _format(book, style)}

    def read(self, xml: bytes) -> Worksheet:
        """Sheet from its XML, after the check for entities."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.CharacterDataHandler = self._characters
        parser.Parse(xml, True)
        texts = [self.cells[row][column] for row, column in self.texts]
        if any("," in text and not _THOUSANDS.fullmatch(text) for text in texts):
            placed = [(row, column, text) for (row, column), text in zip(self.texts, texts, strict=True)]
            self._refuse_both_marks(placed)
            points = {
                column for _, column, text in placed if "." in text and "," not in text and not _POINTED.fullmatch(text)
            }
            for row, column, text in placed:
                if "," in text or (_POINTED.fullmatch(text) and column not in points):
                    self.cells[row][column] = text.replace(".", "").replace(",", ".")
        width = max(map(len, self.cells.values()), default=0)
        empty = [""] * width
        table = io.StringIO()
        writer = csv.writer(table, delimiter="\t", lineterminator="\n")
        for number in range(1, max(self.cells, default=0) + 1):
            cells = self.cells.get(number, empty)
            writer.writerow(cells + empty[len(cells) :])
        as_text = _letters({column for _, column in self.texts})
        rows = len(self.numbered)
        return Worksheet(
            self.name, table.getvalue(), rows, _letters(self.percent), as_text, self.is_hidden, tuple(self.hidden)
        )

    def _refuse_both_marks(self, placed: Sequence[tuple[int, int, str]]) -> None:
        """Refuse a text with a decimal comma beside a text whose commas separate thousands."""
        commas = [one for one in placed if "," in one[2]]
        other = next((one for one in commas if _ENGLISH.fullmatch(one[2])), None)
        if other is not None:
            row, column, text = next(one for one in commas if not _THOUSANDS.fullmatch(one[2]))
            (first,), (second,) = _letters([column]), _letters([other[1]])
            rule = (
                f"has a decimal comma, cell {second}{other[0]} separates thousands by commas ({other[2]!r}); write all "
            )
            raise InputError(
                f"{rule}numbers in one way", where=f"{self.where}: sheet {self.name!r}, cell {first}{row}", value=text
            )

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        if ":" in tag:
            tag = tag.rpartition(":")[2]
        if tag == "c":
            self.cell, self.value, self.is_formula = attributes, [], False
            place = attributes.get("r")
            self.column = _column(place) if place else self.column + 1
        elif tag in ("v", "t"):
            self.is_value = not self.is_phonetic
        elif tag == "rPh":
            self.is_phonetic = True
        elif tag == "f":
            self.is_formula = True
        elif tag == "row":
            self.row = int(attributes.get("r", self.row + 1))
            self.column = -1
            if attributes.get("hidden") in ("1", "true"):
                self.hidden.append(self.row)

    def _characters(self, text: str) -> None:
        if self.is_value:
            self.value.append(text)

    def _end(self, tag: str) -> None:
        if ":" in tag:
            tag = tag.rpartition(":")[2]
        if tag in ("v", "t"):
            self.is_value = False
        elif tag == "rPh":
            self.is_phonetic = False
        elif tag == "c":
            text = self._text("".join(self.value))
            if text:
                row = self.cells.setdefault(self.row, [])
                if not len(row) <= self.column < LAST_COLUMN or not 0 < self.row <= LAST_ROW:
                    raise ValueError(f"no place for {self.cell.get('r')}")
                row += [""] * (self.column - len(row))
                row.append(text)

    def _text(self, written: str) -> str:
        """Value of a cell in one line; a number in the fewest digits that read back equal."""
        kind, style = self.cell.get("t", "n"), self.cell.get("s", "0")
        if kind in ("s", "str", "inlineStr"):
            text = " ".join((self.strings[int(written)] if kind == "s" else written).split())
            if _NUMBER.fullmatch(text):
                self.numbered.add(self.row)
                self.texts.append((self.row, self.column))
            return text
        if not written:
            if not self.is_formula:
                return ""
            self.numbered.add(self.row)
            return UNCALCULATED
        if kind == "b":
            return str(written == "1")
        if kind != "n":
            return written
        if int(style) in self.dates:
            return _date(float(written), self.reader.wb, int(style))
        self.numbered.add(self.row)
        if style in self.percent_styles:
            self.percent.add(self.column)
        return written if written.isdigit() else repr(float(written)).removesuffix(".0")


def _date(number: float, book: Any, style: int) -> str:
    from openpyxl.utils.datetime import from_excel

    try:
        return str(from_excel(number, book.epoch, timedelta=style in book._timedelta_formats))
    except (OverflowError, ValueError):
        return "#VALUE!"


def _format(book: Any, style: Any) -> str:
    from openpyxl.styles.numbers import BUILTIN_FORMATS, BUILTIN_FORMATS_MAX_SIZE

    number = style.numFmtId
    if number < BUILTIN_FORMATS_MAX_SIZE:
        return str(BUILTIN_FORMATS.get(number, ""))
    return str(book._number_formats[number - BUILTIN_FORMATS_MAX_SIZE])


def _column(place: str) -> int:
    """Number, from 0, of the column of a cell.

    >>> _column("A1"), _column("AB12")
    (0, 27)
    """
    column = 0
    for letter in place:
        if not letter.isalpha():
            break
        column = 26 * column + ord(letter) - 64
    return column - 1


def _letters(columns: Iterable[int]) -> tuple[str, ...]:
    from openpyxl.utils import get_column_letter

    return tuple(get_column_letter(column + 1) for column in sorted(columns))
