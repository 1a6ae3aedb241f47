"""Reach of a rig: what its conditions can be set to, as `[rig]` states it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from mixedlub.gear.sharing.table import TableSharing
from mixedlub.kinds import Kind
from mixedlub.rig.rig import Rig
from mixedlub.schema.settable import PAIRINGS, STEPS
from mixedlub.schema.system_file import System
from mixedlub.schema.table import Table
from profiles.errors import InputError, nearest

ROUNDING = 1e-6
"""Judgement. Share of a value within which two settings are equal: the digits of a file."""


@dataclass(frozen=True)
class Reach:
    """Ranges and steps by condition, and pairs of surfaces; a condition without entry is not stated.

    >>> reach = Reach({"speed_rpm": (100.0, 3000.0)}, {"torque_Nm": (50.0, 100.0)})
    >>> [reach.allows(*one) for one in (("speed_rpm", 3500.0), ("torque_Nm", 60.0), ("torque_Nm", 100.0))]
    [False, False, True]
    """

    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    steps: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    pairings: tuple[tuple[str, str], ...] = ()

    def allows(self, name: str, value: float) -> bool:
        """Whether a numeric condition can be set to a value."""
        off = ROUNDING * abs(value)
        if name in self.steps:
            return any(abs(step - value) <= off for step in self.steps[name])
        low, high = self.ranges.get(name, (-np.inf, np.inf))
        return low - off <= value <= high + off

    def beyond(self, table: Table, surfaces: tuple[str, ...]) -> Iterator[tuple[int, str]]:
        """Runs of a table that the rig cannot do, with the reason."""
        for name in (*self.ranges, *self.steps):
            for run, value in zip(table["run"], table[name], strict=True) if name in table else ():
                if not self.allows(name, float(value)):
                    yield int(run), f"{name} {value:g}"
        if self.pairings and len(surfaces) == 2:
            for run, *pair in zip(table["run"], *(table[name] for name in surfaces), strict=True):
                if tuple(map(str, pair)) not in self.pairings:
                    yield int(run), f"{pair[0]} on {pair[1]}"


def surface_columns(kind: Kind) -> tuple[str, ...]:
    """Columns of the two surfaces of a kind; empty for kinds without."""
    return tuple(c.name for c in kind.columns if c.dtype == "name" and "surface" in c.name)


def reach_of(system: System, kind: Kind, where: str) -> Reach:
    """Reach stated in a system, checked against the conditions of its kind."""
    known = {c.name: c for c in kind.columns if c.dtype != "name"}
    names = [*known, *([PAIRINGS] if surface_columns(kind) else [])]
    ranges: dict[str, tuple[float, float]] = {}
    steps: dict[str, tuple[float, ...]] = {}
    pairings: tuple[tuple[str, str], ...] = ()
    for name, value in system.rig.items():
        place = f"{where}: rig.{name}"
        if name not in names:
            raise InputError(f"is no condition of kind {system.kind!r}; {nearest(name, names)}", where=place)
        is_pairs = isinstance(value, list) and isinstance(value[0], list)
        if is_pairs != (name == PAIRINGS):
            rule = 'must be pairs of surfaces: [["a", "b"], ...]' if name == PAIRINGS else "must be numbers"
            raise InputError(rule, where=place, value=value)
        if is_pairs:
            for one in (one for pair in value for one in pair if one not in system.surfaces):
                raise InputError(f"no such surface; {nearest(one, system.surfaces)}", where=place, value=one)
            pairings = tuple((first, second) for first, second in value)
        elif isinstance(value, dict):
            steps[name] = tuple(value[STEPS])
        else:
            ranges[name] = (value[0], value[1])
        for number in (*steps.get(name, ()), *ranges.get(name, ())):
            known[name].parse(f"{number:.12g}", place)
    return Reach(ranges, steps, pairings)


def tabulated(system: System, rig: Rig) -> dict[str, np.ndarray]:
    """Levels of conditions with rows in a table of the rig; between them the model takes the nearest."""
    if system.gears is None or not isinstance(rig.sharing, TableSharing):
        return {}
    return {"torque_Nm": np.unique(rig.sharing.torque)}
