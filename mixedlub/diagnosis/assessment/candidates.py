"""Candidate tests: conditions that the rig can run, and conditions beyond with their needs."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from itertools import product
from typing import Any

import numpy as np

from mixedlub.case.added import whole_rig
from mixedlub.case.folder import Case
from mixedlub.case.reach import Reach, surface_columns, tabulated
from mixedlub.diagnosis.labels import amount, words_of
from mixedlub.diagnosis.settings.assessment import (
    BEYOND_LOWEST,
    BEYOND_SPAN,
    INNER_LEVELS,
    MOST_CONDITIONS,
    TEST_DIGITS,
    TEST_LEVELS,
    WIDE_RATIO,
)
from mixedlub.diagnosis.settings.inference import SEED
from mixedlub.recording.conditions import PASSING, noisy_set_point
from mixedlub.recording.set_points import roundest, set_points
from mixedlub.schema.table import Column, Table

Levels = dict[str, np.ndarray]


def _held(column: Column, values: np.ndarray, varied: Collection[str] | None) -> float | None:
    """Set point of a condition that was not varied; None for a varied one."""
    at = noisy_set_point(column.name, values)
    if at is None and varied is not None and column.name not in varied:
        levels = np.unique(set_points(values))
        at = roundest(float(levels[0]), float(levels[-1]))
    return at


def _thinned(levels: np.ndarray, most: int) -> np.ndarray:
    return levels if levels.size <= most else levels[np.linspace(0, levels.size - 1, most).astype(int)]


def _with_between(levels: np.ndarray) -> np.ndarray:
    """Levels, and one in the middle of each two neighbours, rounded.

    >>> [_with_between(np.array(levels)).round(2).tolist() for levels in ([40.0, 60.0, 100.0], [1.0, 10.0])]
    [[40.0, 50.0, 60.0, 80.0, 100.0], [1.0, 3.16, 10.0]]
    """
    low, high = levels[:-1], levels[1:]
    wide = low[0] > 0.0 and levels[-1] > WIDE_RATIO * low[0] if levels.size > 1 else False
    middle = np.sqrt(low * high) if wide else 0.5 * (low + high)
    rounded = [float(f"{m:.{TEST_DIGITS}g}") for m in middle]
    return np.unique([*levels, *(m for m, a, b in zip(rounded, low, high, strict=True) if a < m < b)])


def _within_reach(reach: Reach, name: str, levels: np.ndarray) -> np.ndarray:
    """Levels of a condition that the rig can set, with the ends of its range."""
    if name in reach.steps:
        return np.array(reach.steps[name])
    low, high = reach.ranges[name]
    return np.unique([low, *levels[(levels > low) & (levels < high)], high])


def _levels(case: Case, rows: Table, column: Column, varied: Collection[str] | None, stated: bool) -> np.ndarray:
    """Levels of a numeric condition inside the recorded range, or inside the reach of the rig where it is stated."""
    name, values, reach = column.name, rows[column.name].astype(float), case.reach
    at = _held(column, values, varied)
    if stated and (name in reach.ranges or name in reach.steps):
        levels = _within_reach(reach, name, np.unique(values) if at is None else np.array([at]))
    elif at is not None:
        return np.array([at])
    else:
        levels = np.unique(set_points(values))
    if name in PASSING:
        return _thinned(levels, TEST_LEVELS)
    low, high = case.kind.column_limits(case.system).get(name, (-np.inf, np.inf))
    possible = levels[(levels >= low) & (levels <= high)]
    levels = possible if possible.size else levels
    rows_there = tabulated(case.system, case.rig).get(name)
    if rows_there is not None:
        there = rows_there[(rows_there >= levels[0]) & (rows_there <= levels[-1])]
        return _thinned(there if there.size else levels, TEST_LEVELS)
    if name in reach.steps:
        return _thinned(levels, TEST_LEVELS)
    return _with_between(_thinned(levels, INNER_LEVELS))


def _pairs(rows: Table, names: list[str], pairings: tuple[tuple[str, str], ...]) -> list[tuple[str, ...]]:
    """Recorded combinations of names, or the pairings that the rig can mount."""
    if pairings and len(names) == len(pairings[0]):
        return list(pairings)
    return sorted({*zip(*(map(str, rows[name]) for name in names), strict=True)}) if names else [()]


def _table(case: Case, rows: Table, names: list[str], pairs: list[tuple[str, ...]], levels: Levels) -> Table:
    """All combinations, thinned to a few hundred, with the columns of a programme that the recording has."""
    grid = [(*pair, *numbers) for pair in pairs for numbers in product(*levels.values())]
    if len(grid) > MOST_CONDITIONS:
        # At random: every so many would go round with the levels of a condition, and miss some of them.
        kept = np.random.default_rng(SEED).choice(len(grid), MOST_CONDITIONS, replace=False)
        grid = [grid[i] for i in np.sort(kept)]
    columns = {name: np.array([row[i] for row in grid]) for i, name in enumerate((*names, *levels))}
    columns["run"] = np.arange(1, len(grid) + 1)
    if "sequence" in rows:
        columns["sequence"] = np.ones(len(grid))
    if "rig" in rows:
        columns["rig"] = np.full(len(grid), whole_rig(case))
    return Table(columns, "next tests")


def inside(case: Case, rows: Table, conditions: list[Column], varied: Collection[str]) -> Table:
    """Conditions at recorded levels, between them and on recorded pairs, or anywhere that `[rig]` states."""
    names = [c.name for c in conditions if c.dtype == "name"]
    levels = {c.name: _levels(case, rows, c, varied, True) for c in conditions if c.dtype != "name"}
    return _table(case, rows, names, _pairs(rows, names, case.reach.pairings), levels)


def outside(
    case: Case, rows: Table, conditions: list[Column], varied: Collection[str]
) -> tuple[Table, list[list[str]]]:
    """Conditions a little beyond the recorded range or on pairs never recorded, with the needs of each.

    Conditions that `[rig]` excludes are left out.
    """
    names = [c.name for c in conditions if c.dtype == "name"]
    every = list(product(*(sorted(set(map(str, rows[name]))) for name in names)))
    levels = {c.name: _levels(case, rows, c, varied, False) for c in conditions if c.dtype != "name"}
    limits = case.kind.column_limits(case.system)
    for column in conditions:
        own = levels.get(column.name)
        if own is not None and own.size > 1:
            levels[column.name] = np.unique([*_thinned(own, INNER_LEVELS), *_ends_beyond(column, own, limits)])
    table = _table(case, rows, names, every, levels)
    needs = needs_of(case, rows, table)
    impossible = {run for run, _ in case.reach.beyond(table, surface_columns(case.kind))}
    kept = np.array([bool(need) and run not in impossible for run, need in zip(table["run"], needs, strict=True)])
    return table.take(kept), [need for need, one in zip(needs, kept, strict=True) if one]


def _ends_beyond(column: Column, levels: np.ndarray, limits: Mapping[str, tuple[float, float]]) -> list[float]:
    """A level beyond either end of the recorded levels that the column and the rig allow.

    >>> share = Column("slide_roll_ratio", at_least=0.0, at_most=2.0)
    >>> [round(x, 3) for x in _ends_beyond(share, np.array([0.5, 1.9]), {})]
    [0.3]
    """
    low, high = float(levels[0]), float(levels[-1])
    wide = BEYOND_SPAN * (high - low)
    lowest, highest = limits.get(column.name, (-np.inf, np.inf))
    ends = [low - wide if low < 0 else max(low - wide, BEYOND_LOWEST * low), high + wide]
    return [x for x in ends if column.allows(x) and lowest <= x <= highest]


def needs_of(case: Case, rows: Table, table: Table) -> list[list[str]]:
    """Needs of each test beyond the recording, in words; empty for a test inside."""
    needs: list[list[str]] = [[] for _ in range(len(table))]
    for column in (c for c in case.kind.columns if c.name in table and c.name in rows and c.dtype != "name"):
        low, high = float(rows[column.name].min()), float(rows[column.name].max())
        for i in np.flatnonzero((table[column.name] < low) | (table[column.name] > high)):
            value = float(table[column.name][i])
            side = f"up to {amount(high, column.name)}" if value > high else f"down to {amount(low, column.name)}"
            needs[i].append(f"{words_of(column.name)} {amount(value, column.name)} (recorded {side})")
    names = [n for n in surface_columns(case.kind) if n in table and n in rows]
    known = set(_pairs(rows, names, ()))
    for row, pair in enumerate(zip(*(map(str, table[name]) for name in names), strict=True) if names else ()):
        if pair not in known:
            needs[row].append(f"the pair {' on '.join(pair)}, never recorded")
    for name, there in tabulated(case.system, case.rig).items():
        for row, value in enumerate(table[name]):
            if not np.isclose(value, there, rtol=1e-6).any():
                needs[row].append(f"rows at {amount(float(value), name)} in the load-share table")
    return needs


def conditions_at(table: Table, columns: list[Column], row: int) -> dict[str, Any]:
    """Conditions of a row, numbers rounded as printed."""
    values = {c.name: table[c.name][row] for c in columns}
    return {name: str(x) if isinstance(x, str) else float(f"{x:.6g}") for name, x in values.items()}
