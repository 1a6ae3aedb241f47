"""Table headers: column names with the units of the line below."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mixedlub.schema.units import is_unit, split

COUNTED = ("nr", "nr.", "no", "no.", "#", "n", "lfd. nr.", "lfd.nr.")
"""Unit, in lower case, of a column of row numbers."""
UNITS_LABEL = re.compile(r"(?:channel |y[ _])?(?:units?|einheit(?:en)?)(?:[ _]label)?:?", re.IGNORECASE)
"""First cell of a line labelled as units."""
CLOCK_LABEL = re.compile(r"(?:time|sampling)? ?(?:interval|timestamp|start time|delta|dt)\b", re.IGNORECASE)
"""First cell of a line on the clock of a channel."""


def header_of(lines: Sequence[Sequence[str]]) -> tuple[list[str], int]:
    """Unique headers from the lines above the rows of a table, and number of lines they take.

    >>> header_of([["Test 7"], ["Load", "COF"], ["N", "-"]])
    (['Load (N)', 'COF (-)'], 2)
    """
    *above, last = lines
    names = _names_above(above, last)
    if not names:
        return unique(last), 1
    units = ["" if UNITS_LABEL.fullmatch(unit) else unit.strip("()[]") for unit in last]
    return unique([f"{name} ({unit})" if unit else name for name, unit in zip(names, units, strict=True)]), 2


def _names_above(above: Sequence[Sequence[str]], units: Sequence[str]) -> list[str]:
    """Names above a line of units; empty for another line. A line labelled as units may have any units.

    The label of a channel with a clock above it denotes its time.

    >>> _names_above([["Interval", "0.1"], ["Channel name", "Force"]], ["Unit", "V"])
    ['Time', 'Force']
    >>> _names_above([["Channel", "Force"]], ["Unit", "V"]), _names_above([["No", "Force"]], ["1", "V"])
    (['Channel', 'Force'], [])
    """
    names = list(above[-1]) if above else []
    if len(names) != len(units) or not UNITS_LABEL.fullmatch(units[0]):
        return names if names and _are_units(units, names) else []
    clocks = {i for row in above[:-1] for i, cell in enumerate(row) if CLOCK_LABEL.match(cell)}
    labels = {i for i, unit in enumerate(units) if UNITS_LABEL.fullmatch(unit)}
    return ["Time" if i in clocks & labels else name for i, name in enumerate(names)]


def _are_units(cells: Sequence[str], words: Sequence[str]) -> bool:
    """Whether a line holds units of the words above it, at least one known; one cell may count the rows.

    Unknown units must be in brackets, or among twice as many known units below a line that names every column.
    """
    if len(cells) != len(words):
        return False
    named = [cell for cell in cells if cell and cell.lower() not in COUNTED]
    known = sum(is_unit(cell.strip("()[]")) for cell in named)
    new = sum(not is_unit(cell.strip("()[]")) and not _in_brackets(cell) for cell in named)
    every = all(word and not is_unit(word) for word, cell in zip(words, cells, strict=True) if cell)
    return known > 2 * new and (every or new == 0)


def _in_brackets(cell: str) -> bool:
    return (cell[0], cell[-1]) in (("(", ")"), ("[", "]"))


def unique(header: Sequence[str]) -> list[str]:
    """Headers with a number added to repetitions."""
    seen: dict[str, int] = {}
    unique = []
    for h in header:
        seen[h] = seen.get(h, 0) + 1
        words, unit = split(h)
        distinct = h if seen[h] == 1 else f"{words} #{seen[h]}" + (f" ({unit})" if unit else "")
        while h and distinct in unique:
            distinct = f"{distinct} #{seen[h]}"
        unique.append(distinct)
    return unique
