"""History of the conditions of a recording: direction of the last change, level before, time since, fading memory."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mixedlub.kinds.acceleration import stretches
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.past import BEFORE, CLOCKS, DIRECTION, MEMORY, SINCE, Past
from mixedlub.schema.table import Table
from mixedlub.schema.units import without_unit

NEAR_SIZE, NEAR_SPAN = 0.015, 0.005
"""Judgement. Change that is none, as a share of the value and of the whole span: controllers let a value vary so."""
SCATTER = 6.0
"""Judgement. Standard deviations of a logged value within which it has not changed: four of a difference of two."""
MOST_SCATTER = 0.05
"""Judgement. Scatter as a share of the span above which a value jumps between readings rather than scatters."""
CLEAR_JUMP = 2.0
"""Judgement. Size of a typical step over the least change; a sweep moves by little more than the least change."""
ORDERED = 0.5
"""Judgement. Changes or turns over those of a random order, up to which an order is a programme: half."""
RANDOM_TURNS = 2.0 / 3.0
"""Definition. Share of the readings at which values in random order turn back."""
FEWEST_ROWS, FEWEST_CHANGES = 10, 2
"""Judgement. Readings and changes from which a history can be told from a step in time."""
UNCHANGED = 1e9
"""Definition. Duration since the last change, in any unit, of rows without an order: long enough to be forgotten."""
FALLS_BACK = 0.1
"""Judgement. Stretches of a clock over readings above which rows are rather listed in another order."""


@dataclass(frozen=True, eq=False)
class Order:
    """Column that orders the rows, its values, and the stretch of the programme to which each row belongs."""

    name: str
    clock: np.ndarray
    part: np.ndarray

    @property
    def unit(self) -> str:
        """Unit of durations in the names of history coordinates."""
        return CLOCKS[self.name]

    @property
    def span(self) -> float:
        """Duration of the rows."""
        return float(np.ptp(self.clock))


def order_of(table: Table, by_run: bool = False) -> Order | None:
    """Order of the rows by time or place in the programme, in a history also by run; None without one.

    >>> order_of(Table({"run": np.arange(3), "time_s": np.array([0.0, 2.0, 4.0])})).unit
    's'
    >>> order_of(Table({"run": np.arange(3), "sequence": np.ones(3)})), order_of(Table({"run": np.arange(3)}))
    (None, None)
    """
    for name in ("time_s", "sequence", *(("run",) if by_run else ())):
        if name not in table:
            continue
        clock, part = np.asarray(table[name], float), _set_ups(table, name)
        most = np.unique(table["setup"]).size if "setup" in table else 1
        if part.max() + 1 > max(FALLS_BACK * len(table), most):
            part = np.zeros(len(table), int)
        if 2 * len(set(zip(part.tolist(), clock.tolist(), strict=True))) > len(table):
            return Order(name, clock, part)
    return None


def _set_ups(table: Table, name: str) -> np.ndarray:
    """Stretch of each row: by time in the order of the rows, else by changes of set-up in the order of the clock."""
    part = np.zeros(len(table), int)
    if name == "time_s":
        return stretches(table)
    if "setup" in table:
        order = np.argsort(table[name], kind="stable")
        names = table["setup"][order]
        part[order[1:]] = np.cumsum(names[1:] != names[:-1])
    return part


@dataclass(frozen=True, eq=False)
class Programme:
    """A numeric condition through a recording: ``least`` change that counts, and whether it is stepped or swept.

    ``planned``: it changes or turns far less often than in a random order, so that readings can show its history.
    """

    column: str
    order: Order
    values: np.ndarray
    least: float
    stepped: bool = True
    planned: bool = False

    def threshold(self, level: np.ndarray) -> np.ndarray:
        """Change from a level that counts as one."""
        return np.maximum(self.least, NEAR_SIZE * np.abs(level))

    @cached_property
    def lines(self) -> list[Line]:
        """The stretches of the programme."""
        every = range(int(self.order.part.max()) + 1)
        return [self.line(self.order.clock[rows], self.values[rows]) for rows in (self.order.part == k for k in every)]

    def line(self, clock: np.ndarray, values: np.ndarray) -> Line:
        """Times and values in order, with the state of the condition after each."""
        order = np.argsort(clock, kind="stable")
        clock, values = clock[order], values[order]
        level, direction, before = float(values[0]), 0.0, float(values[0])
        moved, changed = float(clock[0]), float(clock[0]) - self.order.span
        found = np.empty((4, values.size))
        rows = zip(clock.tolist(), values.tolist(), strict=True)
        for i, (t, x) in enumerate(rows):
            if abs(x - level) > max(self.least, NEAR_SIZE * abs(level)):
                sense = 1.0 if x > level else -1.0
                # A sweep changes where it turns back, a stepped condition at every step.
                if self.stepped or sense != direction:
                    before, changed = level, t if self.stepped else moved
                level, direction, moved = x, sense, t
            found[:, i] = level, direction, before, changed
        if not self.stepped and found[1].any():
            # A sweep moves from its first reading on.
            found[1][: np.flatnonzero(found[1])[0]] = found[1][np.flatnonzero(found[1])[0]]
        return Line(clock, values, found[0], found[1], found[2], found[3], order)


@dataclass(frozen=True, eq=False)
class Line:
    """Times in order, and after each the value, the level held, and direction of, level before and time of its last
    change; ``order`` sorts the rows."""

    clock: np.ndarray
    value: np.ndarray
    level: np.ndarray
    direction: np.ndarray
    before: np.ndarray
    changed: np.ndarray
    order: np.ndarray

    def memory(self, fading: float) -> np.ndarray:
        """Exponential memory of the value, which held its first value for long."""
        kept = np.exp(-np.diff(self.clock, prepend=self.clock[0]) / fading).tolist()
        now, found = float(self.value[0]), []
        for x, share in zip(self.value.tolist(), kept, strict=True):
            now = x + (now - x) * share
            found.append(now)
        return np.array(found)

    def at(self, past: Past) -> np.ndarray:
        """A history coordinate in the order of the rows."""
        if past.what == MEMORY:
            found = self.memory(past.fading)
        elif past.what == SINCE:
            found = self.clock - self.changed
        elif past.what == BEFORE:
            found = np.where(self.direction == 0.0, self.value, self.before)
        else:
            found = self.direction
        rows = np.empty(found.size)
        rows[self.order] = found
        return rows


def programme_of(recorded: Table, column: str, by_run: bool = False) -> Programme | None:
    """The programme of a condition; None without an order.

    >>> steps = Table({"time_s": np.arange(24.0), "load_N": np.repeat([10.0, 20.0, 10.0, 20.0], 6)})
    >>> mixed = np.random.default_rng(0).permutation(steps["load_N"])
    >>> [programme_of(Table({**steps.columns, "load_N": v}), "load_N").planned for v in (steps["load_N"], mixed)]
    [True, False]
    """
    order = order_of(recorded, by_run)
    if order is None:
        return None
    values = np.asarray(recorded[column], float)
    least = max(NEAR_SPAN * float(np.ptp(values)), _scatter(values[np.lexsort((order.clock, order.part))]))
    found = Programme(column, order, values, least)
    level = np.concatenate([line.level for line in found.lines])
    jumps = np.concatenate([np.diff(line.level) for line in found.lines])
    jumps = jumps[jumps != 0.0]
    if jumps.size < FEWEST_CHANGES or level.size < FEWEST_ROWS:
        return found
    ranked = np.sort(level)
    cluster = np.cumsum(np.diff(ranked, prepend=ranked[0]) > found.threshold(ranked))
    at_random = 1.0 - float(np.sum((np.bincount(cluster) / level.size) ** 2))
    clear = float(np.median(np.abs(jumps))) > CLEAR_JUMP * least
    if clear and jumps.size <= ORDERED * at_random * level.size:
        return replace(found, planned=True)
    turns = int((np.sign(jumps[1:]) != np.sign(jumps[:-1])).sum())
    swept = 1 <= turns <= ORDERED * RANDOM_TURNS * level.size
    return replace(found, stepped=not swept, planned=swept)


def _scatter(values: np.ndarray) -> float:
    """Scatter of a logged value that counts as no change; zero where values jump from reading to reading."""
    bends = np.abs(np.diff(values, 2))
    noise = SCATTER * float(np.median(bends)) / (0.6745 * np.sqrt(6.0)) if bends.size else 0.0
    return noise if noise < MOST_SCATTER * float(np.ptp(values)) else 0.0


def histories(pasts: Iterable[Past], table: Table, recorded: Table, by_run: bool = False) -> dict[str, np.ndarray]:
    """History coordinates of the rows of a table by name, without durations in the unit of another order.

    Recorded rows have their place in the recording. Rows of another table go on from the reading before them; from
    the first reading or before it on they are a programme of their own, and without an order all changes are long ago.

    >>> log = Table({"run": np.arange(12), "time_s": np.arange(12.0), "load_N": np.repeat([10.0, 20.0, 10.0], 4)})
    >>> [past] = [Past("load_N", SINCE, "s")]
    >>> histories([past], log, log)["load_since_s"].tolist()
    [11.0, 12.0, 13.0, 14.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]
    >>> later = Table({"run": np.array([12]), "time_s": np.array([13.0]), "load_N": np.array([10.0])})
    >>> histories([past], later, log)["load_since_s"].tolist()
    [5.0]
    """
    found: dict[str, np.ndarray] = {}
    programmes: dict[str, tuple[Programme | None, list[tuple[Line, np.ndarray, np.ndarray]]]] = {}
    for past in pasts:
        if past.column not in table or past.column not in recorded:
            continue
        if past.column not in programmes:
            programme = programme_of(recorded, past.column, by_run)
            own = [] if programme is None else _placed(programme, table, recorded, by_run)
            programmes[past.column] = programme, own
        programme, own = programmes[past.column]
        if programme is not None and past.clock not in ("", programme.order.unit):
            continue
        values = _steady(past, np.asarray(table[past.column], float), programme)
        for line, rows, places in own:
            values[rows] = line.at(past)[places]
        found[past.name] = values
    return found


def _steady(past: Past, values: np.ndarray, programme: Programme | None) -> np.ndarray:
    """A history coordinate long after the last change."""
    if past.what == DIRECTION:
        return np.zeros(values.size)
    long = UNCHANGED if programme is None else 2.0 * programme.order.span
    return np.full(values.size, long) if past.what == SINCE else values.copy()


@dataclass(frozen=True, eq=False)
class _Places:
    """Where the rows of a table stand in a recording: index of the recorded row or -1, and rows that go on from it.

    ``part``: stretch from which each of these goes on; ``own``: the new rows are a programme of their own. Other new
    rows have no order.
    """

    known: np.ndarray
    following: np.ndarray
    part: np.ndarray
    own: bool

    @classmethod
    def of(cls, order: Order, table: Table, recorded: Table, by_run: bool) -> _Places:
        """The places by run number and by the column that orders the recording."""
        place = {run: row for row, run in enumerate(recorded["run"].tolist())} if "run" in recorded else {}
        known = np.array([place.get(run, -1) for run in table["run"].tolist()] if place else [-1] * len(table), int)
        none = np.zeros(0, int)
        if order.name not in table:
            return cls(np.full(len(table), -1), none, none, False)
        clock = np.asarray(table[order.name], float)
        known[(known >= 0) & (order.clock[known] != clock)] = -1
        new = np.flatnonzero(known < 0)
        if new.size > 1 and clock[new].min() <= order.clock.min():
            return cls(known, none, none, order_of(table.take(new), by_run) is not None)
        part = _followed(order, table.take(new), recorded)
        places = list(zip(part.tolist(), clock[new].tolist(), strict=True))
        taken = Counter([*places, *zip(order.part.tolist(), order.clock.tolist(), strict=True)])
        alone = np.array([taken[place] == 1 for place in places], bool)
        return cls(known, new[alone], part[alone], False)


def _followed(order: Order, table: Table, recorded: Table) -> np.ndarray:
    """Stretch from which each row goes on: the last of its set-up, else the last of all."""
    last = int(order.part.max())
    if "setup" not in table or "setup" not in recorded:
        return np.full(len(table), last)
    by_name: dict[str, int] = {}
    for name, part in zip(recorded["setup"].tolist(), order.part.tolist(), strict=True):
        by_name[name] = max(part, by_name.get(name, 0))
    return np.array([by_name.get(name, last) for name in table["setup"].tolist()], int)


def _placed(
    programme: Programme, table: Table, recorded: Table, by_run: bool
) -> list[tuple[Line, np.ndarray, np.ndarray]]:
    """Lines that hold rows of a table, each with these rows and their places in it; rows without an order have none."""
    order = programme.order
    if table is recorded:
        rows = [np.flatnonzero(order.part == k) for k in range(len(programme.lines))]
        return [(line, own, np.arange(own.size)) for line, own in zip(programme.lines, rows, strict=True)]
    places, found = _Places.of(order, table, recorded, by_run), []
    known = places.known
    for k in np.unique(order.part[known[known >= 0]]):
        here = np.flatnonzero((known >= 0) & (order.part[known] == k))
        found.append((programme.lines[k], here, np.searchsorted(np.flatnonzero(order.part == k), known[here])))
    if order.name not in table:
        return found
    clock, values = np.asarray(table[order.name], float), np.asarray(table[programme.column], float)
    if places.own:
        new = np.flatnonzero(known < 0)
        return [*found, (programme.line(clock[new], values[new]), new, np.arange(new.size))]
    for k in np.unique(places.part):
        last, following = order.part == k, places.following[places.part == k]
        late = clock[following] > order.clock[last].max()
        size = int(last.sum())
        for here in [following[late], *following[~late][:, None]]:
            times, all_values = (
                np.concatenate([a[last], b[here]]) for a, b in ((order.clock, clock), (programme.values, values))
            )
            found.append((programme.line(times, all_values), here, np.arange(size, size + here.size)))
    return found


def assumed(pasts: Iterable[Past], table: Table, recorded: Table, by_run: bool = False) -> Finding | None:
    """Report the history that rows of another table are given; None for recorded rows, and where no history is read."""
    words = ", ".join(dict.fromkeys(without_unit(past.column).replace("_", " ") for past in pasts))
    order = order_of(recorded, by_run)
    if not words or table is recorded or order is None:
        return None
    places = _Places.of(order, table, recorded, by_run)
    new = int((places.known < 0).sum())
    following = places.following.size
    if not new:
        return None
    if places.own:
        how = f"the rows are a programme of their own, in the order of {order.name}"
    elif following == new:
        how = f"each row goes on from the reading before it, by {order.name}"
    else:
        how = f"{new - following} of {new} rows have no place in the recording by {order.name}: long after any change"
    return finding("history_assumed", f"the result depends on the history of {words}: {how}", table.source)
