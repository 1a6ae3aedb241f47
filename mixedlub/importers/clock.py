"""Clocks that start anew: run on from step to step, by the dates of the starts where the table has them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import datetime

import numpy as np

from mixedlub.headers import rounded, words_of
from mixedlub.importers.draft import WARNING
from mixedlub.importers.pace import TIME
from mixedlub.importers.sheet import Sheet, places

STEPS = re.compile(r"\b(?:step|cycle|segment|stage|phase|interval|block|schritt|stufe|abschnitt|zyklus)s?\b")
"""Words of a column that tells one step from the next."""
DATES = ("%d/%m/%Y", "%m/%d/%Y", "%Y-%m-%d", "%d.%m.%Y", "%Y/%m/%d")
CLOCKS = ("%H:%M:%S", "%H:%M", "%H:%M:%S.%f")
FORMS = tuple(f"{date}{between}{clock}" for date in DATES for between in " T" for clock in CLOCKS)
BEGINS = 0.1
"""Share of what ran before within which a clock starts anew; one that falls less far only runs backwards."""


def run_on(times: np.ndarray, header: str, sheet: Sheet) -> tuple[np.ndarray, str]:
    """Seconds that run on where their clock starts anew, and what is said of it; nothing where it never falls."""
    falls = np.flatnonzero(np.diff(times) < 0.0) + 1
    if not falls.size:
        return times, ""
    where = places([sheet.lines[i] for i in falls])
    others = {h: cells for h, cells in sheet.cells.items() if h != header}
    step = next((h for h, cells in others.items() if STEPS.search(words_of(h)) and _tells(cells, falls)), None)
    for dated, cells in others.items():
        for seconds in _starts(cells, falls):
            whole = rounded(times + seconds, float(seconds[-1]))
            if np.all(np.diff(whole) >= 0.0):
                return whole, f"{sheet.name}: {TIME} starts anew in {where}, and runs on from the starts in {dated!r}"
    if step is None and not _begins_anew(times, falls):
        return times, f"{WARNING}{sheet.name}: {TIME} runs backwards in {where}, and is left so: sort the rows first"
    ends = np.zeros(times.size)
    ends[falls] = times[falls - 1]
    elapsed = np.cumsum(ends)
    said = f"{sheet.name}: {TIME} starts anew in {where}, "
    said += f"with {step!r}, " if step else ""
    said += "and runs on from there without the pauses between"
    if step is None:
        said = f"{WARNING}{said}; where rows are out of order, sort them first"
    return rounded(times + elapsed, float(elapsed[-1])), said


def follow(parts: Sequence[tuple[str, np.ndarray]]) -> tuple[np.ndarray, list[str]]:
    """The seconds of several files one after the other: a clock that starts anew in one runs on from the one before."""
    (before, first), *rest = parts
    found, said = [first], []
    for name, times in rest:
        end = float(found[-1][-1])
        if times[0] < end:
            said.append(
                f"{WARNING}{name}: {TIME} starts anew, and runs on from the end of {before} without the pause between"
            )
            times = rounded(times + end, end)
        found.append(times)
        before = name
    return np.concatenate(found), said


def _tells(cells: Sequence[str], falls: np.ndarray) -> bool:
    """Whether a column changes wherever the clock falls, and never back to what it was."""
    changes = [i for i in range(1, len(cells)) if cells[i] != cells[i - 1]]
    return set(falls.tolist()) <= set(changes) and len(changes) == len(set(cells)) - 1


def _begins_anew(times: np.ndarray, falls: np.ndarray) -> bool:
    """Whether the clock falls back to where it began, each time after it ran."""
    first = times[0]
    ran = times[falls - 1] - first
    return bool(np.all(ran > 0.0) and np.all(times[falls] - first <= BEGINS * ran))


def _starts(cells: Sequence[str], falls: np.ndarray) -> Iterator[np.ndarray]:
    """Seconds from the first start to that of each row, for each way to read the dates; the shortest test first."""
    steps = np.searchsorted(falls, np.arange(len(cells)), side="right")
    held = [cells[i] for i in (0, *falls.tolist())]
    if any(cell != held[step] for cell, step in zip(cells, steps, strict=True)):
        return
    ways = []
    for form in FORMS:
        try:
            moments = [datetime.strptime(cell, form) for cell in held]
        except ValueError:
            continue
        ways.append(np.array([(moment - moments[0]).total_seconds() for moment in moments]))
    for seconds in sorted(ways, key=lambda starts: starts[-1]):
        yield seconds[steps]
