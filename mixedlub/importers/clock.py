"""Clocks that start anew: run on from step to step, by the dates of the starts where the table has them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from mixedlub.importers.dates import KEY, ORDERS, moments, resolution
from mixedlub.importers.draft import Answers, read_note
from mixedlub.importers.pace import TIME
from mixedlub.importers.sheet import Sheet, places
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import rounded, words_of
from profiles.errors import InputError

STEPS = re.compile(r"\b(?:step|cycle|segment|stage|phase|interval|block|schritt|stufe|abschnitt|zyklus)s?\b")
"""Words of a column that tells one step from the next."""
BEGINS = 0.1
"""Share of what ran before within which a clock starts anew; one that falls less far only runs backwards."""


def date_order(answers: Answers) -> str | None:
    """What is told of the order of day and month."""
    told = answers.get(KEY)
    if told is not None and told not in ORDERS:
        raise InputError(f"must be {' or '.join(map(repr, ORDERS))}", where=KEY, value=told)
    return told


def run_on(times: np.ndarray, header: str, sheet: Sheet, told: str | None = None) -> tuple[np.ndarray, list[Finding]]:
    """Seconds that run on where their clock starts anew, and a note on that; none where it never falls.

    ``told`` is which of day and month stands first in dates that leave it open.
    """
    falls = np.flatnonzero(np.diff(times) < 0.0) + 1
    if not falls.size:
        return times, []
    where = places([sheet.lines[i] for i in falls])
    others = {h: cells for h, cells in sheet.cells.items() if h != header}
    step = next((h for h, cells in others.items() if STEPS.search(words_of(h)) and _tells(cells, falls)), None)
    for dated, cells in others.items():
        ways = sorted(_by_dates(times, cells, falls, told), key=lambda way: float(way[1][-1]))
        if not ways:
            continue
        order, whole, how = ways[0]
        said = f"{TIME} starts anew in {where}, and runs on {how} {dated!r}"
        if np.array_equal(whole, ways[-1][1]):
            return whole, [read_note(said, sheet.name)]
        other = ORDERS[1 - ORDERS.index(order)]
        first = order.removesuffix(" first")
        said += f", read with the {first} first, as that makes the shorter test; {KEY} = {other!r} says otherwise"
        return whole, [finding("date_order_assumed", said, sheet.name)]
    if step is None and not _begins_anew(times, falls):
        said = f"{TIME} runs backwards in {where}, and is left so: sort the rows first"
        return times, [finding("clock_backwards", said, sheet.name)]
    ends = np.zeros(times.size)
    ends[falls] = times[falls - 1]
    elapsed = np.cumsum(ends)
    said = f"{TIME} starts anew in {where}, "
    said += f"with {step!r}, " if step else ""
    said += "and runs on from there without the pauses between"
    note = read_note(said, sheet.name)
    if step is None:
        note = finding("clock_restarted", f"{said}; where rows are out of order, sort them first", sheet.name)
    return rounded(times + elapsed, float(elapsed[-1])), [note]


def follow(parts: Sequence[tuple[str, np.ndarray]]) -> tuple[np.ndarray, list[Finding]]:
    """The seconds of several files one after the other: a clock that starts anew in one runs on from the one before."""
    (before, first), *rest = parts
    found = [first]
    notes: list[Finding] = []
    for name, times in rest:
        end = float(found[-1][-1])
        if times[0] < end:
            said = f"{TIME} starts anew, and runs on from the end of {before} without the pause between"
            notes.append(finding("clock_restarted", said, name))
            times = rounded(times + end, end)
        found.append(times)
        before = name
    return np.concatenate(found), notes


def _tells(cells: Sequence[str], falls: np.ndarray) -> bool:
    """Whether a column changes wherever the clock falls, and never back to what it was."""
    changes = [i for i in range(1, len(cells)) if cells[i] != cells[i - 1]]
    return set(falls.tolist()) <= set(changes) and len(changes) == len(set(cells)) - 1


def _begins_anew(times: np.ndarray, falls: np.ndarray) -> bool:
    """Whether the clock falls back to where it began, each time after it ran."""
    first = times[0]
    ran = times[falls - 1] - first
    return bool(np.all(ran > 0.0) and np.all(times[falls] - first <= BEGINS * ran))


def _by_dates(
    times: np.ndarray, cells: Sequence[str], falls: np.ndarray, told: str | None
) -> Iterator[tuple[str, np.ndarray, str]]:
    """For each order of day and month the seconds that run on by the dates of a column, and by what of them."""
    for order, found in moments(cells).items():
        if told in ORDERS and order not in ("", told):
            continue
        dates = np.array([(moment - found[0]).total_seconds() for moment in found])
        for place, how in ((_by_clock, "by the clock in"), (_by_starts, "from the starts in")):
            whole = place(times, dates, falls, resolution(cells))
            if whole is not None:
                yield order, rounded(whole, float(dates[-1])), how
                break


def _by_clock(times: np.ndarray, dates: np.ndarray, falls: np.ndarray, within: float) -> np.ndarray | None:
    """Each step where a clock puts it that goes with the rows; None where it does not go with them."""
    steps = np.split(np.arange(times.size), falls)
    off = dates - times
    if any(np.ptp(off[rows]) > within for rows in steps) or all(np.ptp(dates[rows]) == 0.0 for rows in steps):
        return None
    whole = np.concatenate([times[rows] + off[rows].max() for rows in steps]) - off[steps[0]].max()
    return whole if np.all(np.diff(whole) >= 0.0) else None


def _by_starts(times: np.ndarray, dates: np.ndarray, falls: np.ndarray, within: float) -> np.ndarray | None:
    """Each step at its start; None where starts overlap by more than they tell, or are those of no steps.

    A step that is no longer than the stamps tell may bear that of the one before, and runs on from it.
    """
    changes = np.flatnonzero(np.diff(dates) != 0.0) + 1
    begun = np.union1d(changes, falls)
    again = np.setdiff1d(falls, changes)
    if 2 * again.size > falls.size or np.setdiff1d(changes, falls).size > falls.size:
        return None
    whole = times + dates
    for first, rows in zip(begun, np.split(np.arange(times.size), begun)[1:], strict=True):
        late = whole[first - 1] - whole[first]
        if late > within and first not in again:
            return None
        whole[rows] += max(float(late), 0.0)
    return whole if np.all(np.diff(whole) >= 0.0) else None
