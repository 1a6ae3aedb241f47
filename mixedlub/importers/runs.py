"""Numbers of readings: those of the files where each stands once, else new ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.importers.draft import Answers
from mixedlub.importers.sheet import Sheet
from mixedlub.schema.table import LARGEST
from mixedlub.schema.units import words_of
from profiles.errors import InputError, nearest

KEY = "import.columns.run"
SPOKEN = ("run", "run number", "run no", "run no.", "run nr", "run nr.")
ANEW = "so readings are numbered anew from 1"


def header_of_runs(sheet: Sheet, answers: Answers) -> str | None:
    """The header over the numbers of the readings."""
    told = answers.get(KEY)
    if told is not None and str(told) not in sheet.cells:
        raise InputError(f"no such header; {nearest(str(told), sheet.cells)}", where=KEY, value=told)
    return str(told) if told is not None else next((h for h in sheet.cells if words_of(h) in SPOKEN), None)


def runs_of(sheet: Sheet, header: str) -> tuple[np.ndarray | None, str | None]:
    """Whole numbers that each stand once; else none, and why."""
    found: dict[int, int] = {}
    for line, cell in zip(sheet.lines, sheet.cells[header], strict=True):
        number = _whole(cell)
        if number is None:
            return None, f"{sheet.name}: line {line}, {header}: {cell!r} is no whole number, {ANEW}"
        if number in found:
            return None, f"{sheet.name}: {header} {number} stands in lines {found[number]} and {line}, {ANEW}"
        found[number] = line
    return np.array(list(found)), None


def together(parts: Sequence[tuple[str, np.ndarray | None]]) -> tuple[np.ndarray | None, str | None]:
    """The numbers of several files, each with its name; none where a file has none, or one stands in two files."""
    known = [(name, runs) for name, runs in parts if runs is not None]
    if len(known) < len(parts):
        absent = next(name for name, runs in parts if runs is None)
        return None, f"{absent} has no run numbers to keep, {ANEW}" if known else None
    names = [name for name, runs in known for _ in runs]
    every = np.concatenate([runs for _, runs in known])
    first = np.unique(every, return_index=True)[1]
    if first.size == every.size:
        return every, None
    again = int(np.setdiff1d(np.arange(every.size), first)[0])
    before = names[int(np.argmax(every == every[again]))]
    return None, f"run {every[again]} stands in {before} and {names[again]}, {ANEW}"


def _whole(cell: str) -> int | None:
    try:
        value = float(cell)
    except ValueError:
        return None
    return int(value) if abs(value) < LARGEST and value == int(value) else None
