"""Plain workbook (xlsx): one column of heights, or position and height, under a heading or none."""

from __future__ import annotations

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source
from profiles.readers.numbers import table
from profiles.readers.text import read_table
from profiles.readers.workbook import is_workbook, longest, worksheets


class SpreadsheetReader:
    """Longest sheet of numbers in a workbook, read like a text trace: heading, units, spacing. ``origin`` names the
    sheet if there are several. Checked against workbooks that openpyxl wrote."""

    name = "workbook"
    format = "workbook (xlsx): [position,] height"

    def magic(self, source: Source) -> bool:
        return is_workbook(source.data)

    def read(self, source: Source) -> Profile:
        sheets = worksheets(source.data, source.where)
        chosen = longest(sheets, source.where)
        notes = (f"sheet {chosen.name!r} of {len(sheets)} read",) if len(sheets) > 1 else ()
        try:
            content = table(_without_empty_columns(chosen.text), source.where)
        except InputError:
            rule = "is no trace: other cells than numbers stand below the heading; a trace has [position,] height"
            raise InputError(rule, where=f"{source.where}: sheet {chosen.name!r}") from None
        return read_table(source, content, {"format": self.format, "sheet": chosen.name}, notes)


def _without_empty_columns(text: str) -> str:
    """Rows without the columns that are empty in all of them, at the left of a table or between two columns."""
    rows = [line.split("\t") for line in text.splitlines()]
    kept = [i for i in range(max(map(len, rows))) if any(row[i:] and row[i] for row in rows)]
    return "\n".join("\t".join(row[i] for i in kept if i < len(row)) for row in rows)
