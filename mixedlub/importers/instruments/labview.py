"""LabVIEW measurement files (.lvm): text tables after headers with units and clock."""

from __future__ import annotations

from dataclasses import replace

from mixedlub.importers import plain
from mixedlub.importers.base import Answers, Draft
from mixedlub.importers.input_file import InputFile

END = "***End_of_Header***"
MARKS = {"Tab": "\t", "Comma": ",", "Multi": "\t"}


def matches(text: str) -> bool:
    """Whether a text starts like a LabVIEW measurement file."""
    return text.startswith("LabVIEW Measurement")


def draft(file: InputFile, answers: Answers) -> Draft:
    """Draft of a case from the table, read as a plain table."""
    return plain.draft(replace(file, text=as_table(file.text), tables={}), answers)


def as_table(text: str) -> str:
    """Table with blank segment headers, which keeps line numbers; times from the clock if their column is missing.

    >>> head = f"LabVIEW Measurement\\nX_Columns\\tNo\\n{END}\\nY_Unit_Label\\tN\\nX0\\t2\\nDelta_X\\t0.5\\n{END}"
    >>> as_table(head + "\\nX_Value\\tLoad\\tComment\\n\\t20\\n\\t21\\n").split("\\n")[7:]
    ['Time (s)\\tLoad (N)', '2.0\\t20', '2.5\\t21', '']
    """
    facts: dict[str, list[str]] = {}
    lines: list[str] = []
    header: list[str] = []
    row = -1
    # Two heads come first: one of the file, one of its first segment; each further segment has one of its own.
    in_head, is_file_head = True, True
    for line in text.split("\n"):
        mark = MARKS.get(facts.get("Separator", ["Tab"])[0], "\t")
        cells = line.split(mark)
        if line.startswith(END):
            in_head, is_file_head, row = is_file_head, False, -1
            lines.append("")
        elif cells[0] == "X_Value":
            in_head, row = False, 0
            header = _named(cells, facts)
            lines.append(mark.join(header))
        elif in_head or row < 0 or cells[0] in ("Channels", "Samples"):
            in_head, row = True, -1
            facts[cells[0]] = [cell for cell in cells[1:] if cell.strip()] or [""]
            lines.append("")
        else:
            if line.strip() and not cells[0].strip():
                start, step = (float(facts.get(key, ["0"])[0].replace(",", ".")) for key in ("X0", "Delta_X"))
                cells[0] = repr(start + row * step)
            row += bool(line.strip())
            lines.append(mark.join(cells[: len(header)]))
    return "\n".join(lines)


def _named(cells: list[str], facts: dict[str, list[str]]) -> list[str]:
    """Header with names of time and units, without the comment column."""
    units = facts.get("Y_Unit_Label", [])
    is_time = facts.get("X_Dimension", ["Time"])[0] == "Time"
    named = ["Time (s)" if is_time else cells[0]]
    for i, cell in enumerate(cell for cell in cells[1:] if cell.strip() not in ("", "Comment")):
        unit = units[i] if i < len(units) and "(" not in cell else ""
        named.append(f"{cell} ({unit})" if unit else cell)
    return named
