"""Ignored columns that distinguish samples or drives, so that their rows are pooled."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.schema.cells import are_numbers, is_missing
from mixedlub.schema.dates import is_dated
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table
from mixedlub.schema.units import split, words_of

THINGS = re.compile(
    r"(?:drive|driving|sample|specimen|oil|grease|lubricant|fluid|blend|batch|lot|rig|machine|bench|motor|gearbox|"
    r"gear|actuator|bearing|device|unit|serial|material|coating|pair|pairing|group|series|kind|type|probe|antrieb|"
    r"öl|fett|werkstoff|charge|id|no|nr|number|name|code|label|#)\.?"
)
COUNTING = re.compile(
    r"samples|(?:repeat|repetition|replicate|rep|run|point|index|cycle|step|segment|order|count|no|nr|n|#)s?\.?"
)
"""Words in the header of a column that counts readings of one specimen."""
MOST_SPECIMENS = 20
"""Judgement. Most different values of a column that names specimens rather than readings."""
VALUES_LISTED = 3
"""Judgement. Values that a message lists at most."""


def pooled_in(path: Path, table: Table, quantity: str) -> Iterator[Finding]:
    """One finding for each ignored column of a case's table with pooled groups."""
    with path.open(encoding="utf-8-sig", newline="") as file:
        rows = [row for row in csv.reader(file) if any(cell.strip() for cell in row)]
    cells = {h.strip(): [cell.strip() for cell in values] for h, *values in zip(*rows, strict=True)}
    conditions = [v for name, v in table.columns.items() if name not in ("run", "sequence", quantity, f"{quantity}_sd")]
    for header, values in grouping_columns({h: cells[h] for h in table.ignored}, conditions):
        advice = "keep the rows of one, or name each in a column setup"
        yield finding("things_pooled", f"{header!r} is not read, so {pooled_words(values)}: {advice}", path.name)


def grouping_columns(
    free: Mapping[str, Sequence[str]], conditions: Collection[np.ndarray]
) -> Iterator[tuple[str, Sequence[str]]]:
    """Ignored columns that distinguish specimens, without columns that another column subdivides. ``free`` are the
    ignored columns, ``conditions`` the recorded test conditions."""
    candidates = {h: cells for h, cells in free.items() if _few(h, cells) and _distinguishes(h, cells, conditions)}
    for header, cells in candidates.items():
        if not any(_refines(other, cells) for h, other in candidates.items() if h != header):
            yield header, cells


def pooled_words(cells: Sequence[str]) -> str:
    """Words for the groups that are pooled.

    >>> pooled_words(["oil A", "oil B", "oil A"])
    'rows of 2 different things are pooled (oil A, oil B)'
    """
    values = list(dict.fromkeys(cells))
    shown = ", ".join(values[:VALUES_LISTED]) + (", ..." if len(values) > VALUES_LISTED else "")
    return f"rows of {len(values)} different things are pooled ({shown})"


def _few(header: str, cells: Sequence[str]) -> bool:
    """Whether a column holds few names or whole numbers, each repeated, and no unit, date or gap."""
    values = set(cells)
    if split(header)[1] is not None or not 1 < len(values) <= min(MOST_SPECIMENS, len(cells) // 2):
        return False
    if any(is_missing(value) or is_dated(value) for value in values):
        return False
    return not are_numbers(values) or all(float(value).is_integer() for value in values)


def _distinguishes(header: str, cells: Sequence[str], conditions: Collection[np.ndarray]) -> bool:
    """Whether a header names a kind of specimen, or most repeated conditions have more than one value."""
    words = words_of(header).split()
    if all(map(COUNTING.fullmatch, words)):
        return False
    if all(map(THINGS.fullmatch, words)):
        return True
    points: dict[tuple[Any, ...], list[str]] = {}
    for row, cell in enumerate(cells):
        points.setdefault(tuple(values[row] for values in conditions), []).append(cell)
    again = [len(set(values)) > 1 for values in points.values() if len(values) > 1]
    return 2 * sum(again) > len(again)


def _refines(other: Sequence[str], cells: Sequence[str]) -> bool:
    """Whether the other column subdivides the groups of this one."""
    return len(set(other)) > len(set(cells)) and len(set(zip(other, cells, strict=True))) == len(set(other))
