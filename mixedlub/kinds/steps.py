"""Steps of a condition in a recording, and the slip since each of them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mixedlub.kinds.acceleration import stretches
from mixedlub.schema.table import Table

STEP = 0.1
"""Judgement. Change of the logarithm of a condition that is a step: more than controllers let it vary."""
HELD = 3
"""Judgement. Readings before and after a step at which the condition is held; a sweep has no steps."""
MOST = 64
"""Cost limit. Speeds held one after the other; more are a sweep."""


def steps(values: np.ndarray) -> np.ndarray:
    """Rows at which a positive condition steps from one held value to another.

    >>> steps(np.array([3.0, 3.01, 2.99, 30.0, 30.1, 30.0, 29.9])).tolist()
    [3]
    >>> steps(np.geomspace(1.0, 9.0, 12)).tolist(), steps(np.array([1.0, 1.0, 1.0, 9.0, 1.0, 1.0])).tolist()
    ([], [])
    """
    if values.size < 2 * HELD or values.min() <= 0.0:
        return np.zeros(0, int)
    logs = np.log(values)
    found = []
    for row in np.flatnonzero(np.abs(np.diff(logs)) > STEP) + 1:
        before, after = logs[max(row - HELD, 0) : row], logs[row : row + HELD]
        if min(before.size, after.size) == HELD and max(np.ptp(before), np.ptp(after)) < STEP:
            found.append(row)
    return np.array(found, int)


@dataclass(frozen=True, eq=False)
class Held:
    """Speeds held one after the other, for each row of a table, shape (rows, speeds).

    ``speed`` of each; ``slip`` since each began, if it began at its first reading and (``early``) at the reading
    before; zero for a speed that is still to come.
    """

    speed: np.ndarray
    slip: np.ndarray
    early: np.ndarray


def held_speeds(table: Table, recorded: Table, name: str, sliding: float) -> Held | None:
    """Held speeds of a recording before each row of a table; None without a step or where the speed is swept.

    ``sliding`` is the sliding speed over the speed ``name``. A row before the recorded times has the first speed, a
    row behind them the last.
    """
    parts = stretches(recorded)
    of_rows = _part_of(table, recorded, parts)
    programmes = [_programme(recorded.take(np.flatnonzero(parts == part)), name, sliding) for part in np.unique(parts)]
    most = max(len(begins) for begins, *_ in programmes)
    if not 1 < most <= MOST:
        return None
    shape = (len(table), most)
    speed, slips = np.ones(shape), np.zeros((2, *shape))
    for part, (begins, held, clock) in enumerate(programmes):
        rows = of_rows == part
        speed[rows, : held.size] = held
        speed[rows, held.size :] = held[-1]
        for which in (0, 1):
            starts = np.append(clock[0], begins[1:, which])
            travelled = np.append(0.0, np.cumsum(np.diff(starts) * held[:-1]))
            now = np.maximum(table["time_s"][rows], clock[0])
            at = np.clip(np.searchsorted(starts, now, side="right") - 1, 0, held.size - 1)
            here = travelled[at] + (now - starts[at]) * held[at]
            slips[which][rows, : held.size] = np.maximum(here[:, None] - travelled, 0.0)
    return Held(speed, slips[0], slips[1])


def _part_of(table: Table, recorded: Table, parts: np.ndarray) -> np.ndarray:
    """Stretch of the recording to which each row of a table belongs: that of its set-up, else of the nearest run."""
    names = recorded["setup"] if "setup" in recorded and "setup" in table else None
    if parts[-1] == 0:
        return np.zeros(len(table), int)
    if names is not None:
        first = {name: parts[np.flatnonzero(names == name)[0]] for name in np.unique(names)}
        return np.array([first.get(name, 0) for name in table["setup"]])
    if table is recorded:
        return parts
    return parts[np.abs(table["run"][:, None] - recorded["run"]).argmin(axis=1)]


def _programme(rows: Table, name: str, sliding: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times at which each held speed began, late and early; sliding speeds; and the clock."""
    values, clock = rows[name] * sliding, rows["time_s"]
    at = steps(values)
    edges = np.concatenate([[0], at, [values.size]])
    held = np.array([np.median(values[a:b]) for a, b in pairwise(edges)])
    begins = np.column_stack([clock[edges[:-1]], clock[np.maximum(edges[:-1] - 1, 0)]])
    return begins, held, clock
