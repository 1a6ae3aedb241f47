"""Time in seconds from cycles or a distance, continued across restarts of a clock."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.importers.base import Answers, Question, read_note
from mixedlub.importers.cell_columns import Cells, is_numeric
from mixedlub.importers.header import COUNTED
from mixedlub.importers.odd_rows import places
from mixedlub.importers.text_table import Sheet
from mixedlub.importers.vocabulary import BY_NAME, Target, family
from mixedlub.schema.dates import ORDERS, moments, resolution
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import change_to, fits, rounded, split, words_of
from profiles.errors import InputError

TIME = "time_s"
CYCLES = re.compile(
    r"(?:(?:number|no|nr|total)\W+)?(?:of )?(?:cycles?|strokes|revolutions|laps)(?:\W+(?:number|no|nr|#))?"
)
DISTANCES = re.compile(r"(?:total |test )?(?:distance|sliding distance|sliding path)(?: slid)?")
NO_UNIT = (*COUNTED, "-", "1")


@dataclass(frozen=True)
class Pace:
    """Conversion of a count to seconds: key of the answer, question, example, and text of the note."""

    key: str
    text: str
    example: str
    note: str


PACES: Mapping[str, Pace] = {
    "cycle": Pace(
        "import.seconds_a_cycle",
        "Seconds that a cycle takes, as {header!r} counts cycles",
        "0.5",
        "{header!r} times {rate:g} s a cycle",
    ),
    "m": Pace(
        "import.speed_m_s",
        "Sliding speed in m/s that was held, as {header!r} is a distance",
        "0.1",
        "{header!r} over {rate:g} m/s",
    ),
}
"""Conversions by the unit of the count."""
PACE_KEYS = tuple(pace.key for pace in PACES.values())


def unit_of_count(header: str) -> str | None:
    """Unit of a header that may be a time; "cycle" for a count of cycles without a unit.

    >>> unit_of_count("Cycle"), unit_of_count("No. of cycles [-]"), unit_of_count("Distance (km)"), unit_of_count("t")
    ('cycle', 'cycle', 'km', None)
    """
    unit = split(header)[1]
    bare = unit is None or unit.lower() in NO_UNIT
    return "cycle" if bare and CYCLES.fullmatch(words_of(header)) else unit


def counted(header: str) -> str | None:
    """Unit of a header that counts cycles or metres in place of time, or None.

    >>> [counted(h) for h in ("Cycles", "Sliding distance [m]", "Distance", "Stroke (mm)", "Cycle time (s)")]
    ['cycle', 'm', 'm', None, None]
    """
    unit = unit_of_count(header)
    if unit == "cycle":
        return unit
    long = unit is None or change_to(unit, "m") is not None
    return "m" if long and DISTANCES.fullmatch(words_of(header)) else None


def header_of_count(cells: Cells) -> str | None:
    """Header of a count of cycles or a distance."""
    return next((h for h in cells if counted(h) is not None and is_numeric(cells[h])), None)


def headers_in_time(cells: Cells) -> list[str]:
    """Headers of numbers in a unit of time, of any name."""
    in_time = [h for h in cells if fits(split(h)[1] or "", BY_NAME[TIME].unit)]
    return [h for h in in_time if is_numeric(cells[h])]


def target_in(target: Target, unit: str) -> Target:
    """Target with the unit for conversion: time may be counted in cycles or metres, viscosity may be kinematic."""
    counts = (f for f in PACES if target.name == TIME and change_to(unit, f) is not None)
    return replace(target, unit=next(counts, family(target, unit)))


def pace_questions(headers: Mapping[str, str], units: Mapping[str, str], answers: Answers) -> list[Question]:
    """Question on seconds per cycle or speed; raise an error for an answer without use."""
    header = headers.get(TIME)
    if header is None or not (header == TIME or TIME in units):
        return []
    unit = units.get(TIME, BY_NAME[TIME].unit)
    family = target_in(BY_NAME[TIME], unit).unit
    idle = next((p.key for f, p in PACES.items() if f != family and p.key in answers), None)
    if idle is not None:
        raise InputError(f"{TIME} is taken from {header!r}, in {unit}, which needs no such answer", where=idle)
    if family not in PACES or PACES[family].key in answers:
        return []
    pace = PACES[family]
    return [Question(pace.key, f"{pace.text.format(header=header)} and {TIME} is in seconds", pace.example)]


def in_seconds(values: np.ndarray, header: str, unit: str, answers: Answers) -> tuple[np.ndarray, str]:
    """Count converted to seconds, and a note; a time is returned unchanged without a note."""
    family = target_in(BY_NAME[TIME], unit).unit
    if family not in PACES:
        return values, ""
    rate = answers[PACES[family].key]
    if isinstance(rate, bool) or not isinstance(rate, int | float) or not 0.0 < rate < math.inf:
        raise InputError("must be a number above 0", where=PACES[family].key, value=rate)
    seconds = rounded(values * rate if family == "cycle" else values / rate)
    return seconds, f"{TIME} is {PACES[family].note.format(header=header, rate=rate)}"


STEPS = re.compile(r"\b(?:step|cycle|segment|stage|phase|interval|block|schritt|stufe|abschnitt|zyklus)s?\b")
"""Words of a column with the step numbers of a test."""
DATES = "import.dates"
RESTART_BELOW = 0.1
"""Share of the elapsed time within which a falling clock has restarted; otherwise it runs backwards."""


def date_order(answers: Answers) -> str | None:
    """Order of day and month from the answers."""
    order = answers.get(DATES)
    if order is not None and order not in ORDERS:
        raise InputError(f"must be {' or '.join(map(repr, ORDERS))}", where=DATES, value=order)
    return order


def continued(
    times: np.ndarray, header: str, sheet: Sheet, named_order: str | None = None
) -> tuple[np.ndarray, list[Finding]]:
    """Time continued across restarts of its clock, and a note; no note if the clock never falls.

    ``named_order``: order of day and month from an answer.
    """
    falls = np.flatnonzero(np.diff(times) < 0.0) + 1
    if not falls.size:
        return times, []
    where = places([sheet.lines[i] for i in falls])
    others = {h: cells for h, cells in sheet.cells.items() if h != header}
    step = next((h for h, cells in others.items() if STEPS.search(words_of(h)) and _numbers_steps(cells, falls)), None)
    for dated, cells in others.items():
        continuations = sorted(_by_dates(times, cells, falls, named_order), key=lambda one: float(one[1][-1]))
        if not continuations:
            continue
        order, joined, how = continuations[0]
        note = f"{TIME} restarts in {where}; continued {how} {dated!r}"
        if np.array_equal(joined, continuations[-1][1]):
            return joined, [read_note(note, sheet.name)]
        other = ORDERS[1 - ORDERS.index(order)]
        first = order.removesuffix(" first")
        note += f", read with the {first} first, which makes the shorter test; {DATES} = {other!r} reads it the "
        return joined, [finding("date_order_assumed", f"{note}other way", sheet.name)]
    if step is None and not _restarts(times, falls):
        note = f"{TIME} runs backwards in {where}, taken as read: sort the rows first"
        return times, [finding("clock_backwards", note, sheet.name)]
    ends = np.zeros(times.size)
    ends[falls] = times[falls - 1]
    elapsed = np.cumsum(ends)
    note = f"{TIME} restarts in {where}" + (f" with {step!r}" if step else "")
    note += "; continued from there without the pauses between"
    if step is None:
        restart = finding("clock_restarted", f"{note}; where rows are out of order, sort them first", sheet.name)
    else:
        restart = read_note(note, sheet.name)
    return rounded(times + elapsed, float(elapsed[-1])), [restart]


def joined_times(parts: Sequence[tuple[str, np.ndarray]]) -> tuple[np.ndarray, list[Finding]]:
    """Times of several files in sequence; a restarted clock continues from the previous file."""
    (file_before, first), *rest = parts
    joined = [first]
    notes: list[Finding] = []
    for name, times in rest:
        end = float(joined[-1][-1])
        if times[0] < end:
            note = f"{TIME} restarts; continued from the end of {file_before} without the pause between"
            notes.append(finding("clock_restarted", note, name))
            times = rounded(times + end, end)
        joined.append(times)
        file_before = name
    return np.concatenate(joined), notes


def _numbers_steps(cells: Sequence[str], falls: np.ndarray) -> bool:
    """Whether a column changes at every fall of the clock, and never back to an earlier value."""
    changes = [i for i in range(1, len(cells)) if cells[i] != cells[i - 1]]
    return set(falls.tolist()) <= set(changes) and len(changes) == len(set(cells)) - 1


def _restarts(times: np.ndarray, falls: np.ndarray) -> bool:
    """Whether the clock falls back to its start each time, after it ran."""
    first = times[0]
    ran = times[falls - 1] - first
    return bool(np.all(ran > 0.0) and np.all(times[falls] - first <= RESTART_BELOW * ran))


def _by_dates(
    times: np.ndarray, cells: Sequence[str], falls: np.ndarray, named_order: str | None
) -> Iterator[tuple[str, np.ndarray, str]]:
    """Time continued by the dates of a column, for each order of day and month, with a text on the method."""
    for order, stamps in moments(cells).items():
        if named_order in ORDERS and order not in ("", named_order):
            continue
        dates = np.array([(moment - stamps[0]).total_seconds() for moment in stamps])
        for method, how in ((_by_clock, "by the clock in"), (_by_starts, "from the starts in")):
            joined = method(times, dates, falls, resolution(cells))
            if joined is not None:
                yield order, rounded(joined, float(dates[-1])), how
                break


def _by_clock(times: np.ndarray, dates: np.ndarray, falls: np.ndarray, within: float) -> np.ndarray | None:
    """Steps placed by a clock that runs with the rows; None for a column without such a clock."""
    steps = np.split(np.arange(times.size), falls)
    offset = dates - times
    if any(np.ptp(offset[rows]) > within for rows in steps) or all(np.ptp(dates[rows]) == 0.0 for rows in steps):
        return None
    joined = np.concatenate([times[rows] + offset[rows].max() for rows in steps]) - offset[steps[0]].max()
    return joined if np.all(np.diff(joined) >= 0.0) else None


def _by_starts(times: np.ndarray, dates: np.ndarray, falls: np.ndarray, within: float) -> np.ndarray | None:
    """Steps placed at their starts; None if starts overlap beyond their resolution or do not mark steps.

    A step shorter than the resolution may carry the start of the previous step, and is continued from it.
    """
    changes = np.flatnonzero(np.diff(dates) != 0.0) + 1
    begun = np.union1d(changes, falls)
    unmarked = np.setdiff1d(falls, changes)
    if 2 * unmarked.size > falls.size or np.setdiff1d(changes, falls).size > falls.size:
        return None
    joined = times + dates
    for first, rows in zip(begun, np.split(np.arange(times.size), begun)[1:], strict=True):
        overlap = joined[first - 1] - joined[first]
        if overlap > within and first not in unmarked:
            return None
        joined[rows] += max(float(overlap), 0.0)
    return joined if np.all(np.diff(joined) >= 0.0) else None
