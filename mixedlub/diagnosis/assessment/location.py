"""Location of the mismatch: readings, and the range of conditions that they share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.diagnosis.discrepancy.local import TURNED
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.search.several import CLOCKS
from mixedlub.diagnosis.settings.assessment import CUT_GAIN, LARGE_SHARE, MOST_CUTS, MOST_ENDS, NO_MISMATCH
from mixedlub.recording.conditions import PASSING
from mixedlub.recording.set_points import set_points
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Region:
    """A box of conditions, and the readings within it."""

    where: tuple[dict[str, Any], ...]
    inside: np.ndarray


def region(table: Table, columns: list[str], size: np.ndarray) -> Region:
    """The box of conditions that best separates the readings with the largest mismatch.

    ``size`` is the mismatch of each reading in standard deviations. Up to MOST_CUTS conditions are cut; a cut is kept
    if it improves the F-score.
    """
    absolute = np.abs(size)
    top = float(absolute.max(initial=0.0))
    if top < NO_MISMATCH:
        return Region((), np.ones(absolute.size, bool))
    large = absolute >= max(LARGE_SHARE * top, np.median(absolute))
    inside = np.ones(absolute.size, bool)
    chosen: dict[str, dict[str, Any]] = {}
    score = _f_score(inside, large)
    for _ in range(MOST_CUTS):
        best: tuple[float, str, dict[str, Any], np.ndarray] | None = None
        for name in columns:
            if name in chosen:
                continue
            for cut, mask in _cuts(name, table[name]):
                value = _f_score(inside & mask, large)
                if best is None or value > best[0]:
                    best = (value, name, cut, mask)
        if best is None or best[0] < score + CUT_GAIN:
            break
        score, name, cut, mask = best
        chosen[name] = cut
        inside &= mask
    return Region(tuple(chosen.values()), inside)


def time_columns(search: Search, verdict: Explanation) -> list[str]:
    """Columns of time or position on which the answer depends, so that its region may be a part of the programme."""
    if verdict.is_discrepancy:
        return [name for name in PASSING if name in search.discrepancy.best.axes]
    timed = any(CLOCKS.intersection(e.reads) for e in search.problem.effects_of(verdict.effects))
    return [name for name in PASSING if timed and name != TURNED]


def _cuts(name: str, values: np.ndarray) -> list[tuple[dict[str, Any], np.ndarray]]:
    levels = np.unique(values)
    if levels.size < 2:
        return []
    if values.dtype.kind in "US":
        return [({"column": name, "values": [str(level)]}, values == level) for level in levels]
    points = set_points(values)
    levels = np.unique(points)
    if levels.size > MOST_ENDS:
        levels = np.unique(np.quantile(points, np.linspace(0.0, 1.0, MOST_ENDS)))
    found = []
    for i, low in enumerate(levels):
        for j in range(i, levels.size):
            if i == 0 and j == levels.size - 1:
                continue
            mask = (points >= low) & (points <= levels[j])
            if not mask.any():
                continue
            found.append(({"column": name, "low": float(values[mask].min()), "high": float(values[mask].max())}, mask))
    return found


def _f_score(found: np.ndarray, wanted: np.ndarray) -> float:
    both = float((found & wanted).sum())
    return 2.0 * both / max(float(found.sum() + wanted.sum()), 1.0)
