"""Stretches in which a channel was dead, stuck or at its limit: one fault with a beginning and an end."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.recording.conditions import PASSING, clock_of
from mixedlub.recording.noise import successive_difference_sd
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table

FEWEST = 30
"""Judgement. Readings of a series from which its usual level and noise are known."""
CLEAR_OF_ZERO = 10.0
"""Judgement. Usual level over the noise, from which a reading at zero or below is no friction, film or loss."""
TOO_LARGE = 5.0
"""Judgement. Size of an impossible reading over the usual level, beside readings of the wrong sign."""
BELOW = 5.0
"""Judgement. Noise below zero at which an unsigned reading is impossible."""
FAR = 8.0
"""Judgement. Distance from the readings beside a stretch, in noise, at which a reading shares its fault."""
MOST_BETWEEN = 5
"""Judgement. Possible readings in a row between impossible ones of one fault."""
LEAST_IMPOSSIBLE, LEAST_WRONG = 3, 0.5
"""Judgement. Impossible readings of a fault, and the share of its readings that are impossible or far off."""
OF_OTHER_SIGN = 0.25
"""Judgement. Share of the impossible readings at or below zero: large readings alone may be an event."""
BESIDE = 9
"""Judgement. Readings beside a stretch that tell the level there."""
STUCK = 8
"""Judgement. Equal readings in a row of a channel that is stuck."""
STEPS_OF_NOISE = 2.0
"""Judgement. Noise in steps of the channel from which neighbours seldom agree: eight by chance in one of 1e6 places."""
MOST_OF_RECORDING = 0.5
"""Judgement. Share of the recording above which a fault is none: the channel reads that way."""


@dataclass(frozen=True, eq=False)
class Fault:
    """Rows of one fault, in the order of time, and what the channel did."""

    rows: np.ndarray
    text: str


def set_aside(case: Case) -> tuple[Case, Table | None, tuple[Finding, ...]]:
    """The case without the readings of faulty stretches, these readings, and a finding on each stretch."""
    rows = rows_of(case)
    found = faults(case)
    if not found:
        return case, None, ()
    faulty = np.zeros(len(rows), bool)
    for one in found:
        faulty[one.rows] = True
    return replace(case, recordings=rows.take(~faulty)), rows.take(faulty), _told(rows, found)


def faulty_stretches(case: Case) -> tuple[Finding, ...]:
    """A finding on each faulty stretch."""
    return _told(rows_of(case), faults(case))


def _told(rows: Table, found: list[Fault]) -> tuple[Finding, ...]:
    runs = rows["run"]
    return tuple(
        finding("channel_faulty", f"{one.text}: one fault of the instrument, all of its readings are left out", place)
        for one in found
        for place in [f"run {runs[one.rows[0]]} to run {runs[one.rows[-1]]}"]
    )


def faults(case: Case) -> list[Fault]:
    """Faults of the recording in the order of time; none without a clock, or where they would be most of it."""
    rows, y = rows_of(case), readings_of(case)
    # Steady readings in the order of a programme are no series: neighbours differ by their conditions.
    clock = clock_of(rows, ties=True) if "time_s" in rows else None
    if clock is None or y.size < FEWEST:
        return []
    order = np.argsort(clock, kind="stable")
    found = _stuck(case, rows, order)
    if case.kind.is_unsigned(case.quantity):
        found += _impossible(case.quantity, y, order)
    taken = np.zeros(y.size, bool)
    kept = []
    for one in sorted(found, key=lambda fault: -fault.rows.size):
        if not taken[one.rows].any():
            taken[one.rows] = True
            kept.append(one)
    if taken.mean() > MOST_OF_RECORDING:
        return []
    place = np.empty(y.size, int)
    place[order] = np.arange(y.size)
    return sorted(kept, key=lambda fault: int(place[fault.rows[0]]))


def _impossible(quantity: str, y: np.ndarray, order: np.ndarray) -> list[Fault]:
    """Stretches in which most readings are of the wrong sign, zero, or far too large."""
    series = y[order]
    usual = float(np.median(series))
    positive = series[series > 0.0]
    noise = successive_difference_sd(positive) if positive.size > FEWEST else np.inf
    if usual < CLEAR_OF_ZERO * noise:
        return []
    negative = (series < -BELOW * noise) | (series == 0.0)
    wild = negative | (series > TOO_LARGE * usual)
    found = []
    for first, last in _clusters(np.flatnonzero(wild)):
        first, last = _widened(series, wild, first, last, noise)
        inside = slice(first, last + 1)
        beside = np.concatenate([series[max(first - BESIDE, 0) : first], series[last + 1 : last + 1 + BESIDE]])
        level = float(np.median(beside)) if beside.size else usual
        wrong = wild[inside] | (np.abs(series[inside] - level) > FAR * noise)
        count = int(wild[inside].sum())
        if count < LEAST_IMPOSSIBLE or wrong.mean() < LEAST_WRONG or negative[inside].sum() < OF_OTHER_SIGN * count:
            continue
        low, high = float(series[inside].min()), float(series[inside].max())
        text = (
            f"{quantity} reads {low:.3g} to {high:.3g} where the readings beside are {level:.3g}, which no change of a "
            "surface or film can give"
        )
        found.append(Fault(order[inside], text))
    return found


def _clusters(places: np.ndarray) -> list[tuple[int, int]]:
    """First and last of the places that follow each other closely.

    >>> _clusters(np.array([2, 4, 5, 30, 33]))
    [(2, 5), (30, 33)]
    """
    if not places.size:
        return []
    cut = np.flatnonzero(np.diff(places) > MOST_BETWEEN + 1)
    firsts, lasts = places[np.append(0, cut + 1)], places[np.append(cut, places.size - 1)]
    return [(int(a), int(b)) for a, b in zip(firsts, lasts, strict=True)]


def _widened(series: np.ndarray, wild: np.ndarray, first: int, last: int, noise: float) -> tuple[int, int]:
    """Ends of a stretch moved outwards over readings far from those that follow them."""

    def far(place: int, beyond: np.ndarray) -> bool:
        return beyond.size > 2 and abs(series[place] - float(np.median(beyond))) > FAR * noise

    while first > 0 and far(first - 1, series[max(first - 1 - BESIDE, 0) : first - 1]):
        first -= 1
    while last + 1 < series.size and far(last + 1, series[last + 2 : last + 2 + BESIDE]):
        last += 1
    return first, last


def _stuck(case: Case, rows: Table, order: np.ndarray) -> list[Fault]:
    """Stretches in which a noisy channel, the reading or a measured condition, keeps one value."""
    found = []
    conditions = [c.name for c in case.kind.columns if c.name in rows and c.dtype != "name" and c.name not in PASSING]
    for name in (case.quantity, *conditions):
        series = rows[name][order].astype(float)
        different = np.unique(series)
        noise = successive_difference_sd(series)
        if different.size < FEWEST or noise < STEPS_OF_NOISE * float(np.min(np.diff(different))):
            continue
        starts = np.flatnonzero(np.diff(series, prepend=np.nan) != 0.0)
        lengths = np.diff(np.append(starts, series.size))
        for start, length in zip(starts[lengths >= STUCK], lengths[lengths >= STUCK], strict=True):
            value = series[start]
            limit = ", the limit of its range," if value in (different[0], different[-1]) else ""
            text = f"{name} is exactly {value:g}{limit} in {length} readings in a row, where its noise is {noise:.2g}"
            found.append(Fault(order[start : start + length], text))
    return found
