"""Where simulation and recording part: which readings, and the range of conditions they share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.diagnosis.recording.levels import one_point, set_points
from mixedlub.table import Table


@dataclass(frozen=True)
class Region:
    """Conditions joined by "and", and the same in words."""

    where: tuple[dict[str, Any], ...]
    text: str


def region(table: Table, columns: list[str], size: np.ndarray) -> Region:
    """The box of conditions that best marks off the readings with the largest mismatch.

    ``size`` is the mismatch of each reading in sigmas. Up to three conditions are cut, each cut kept only
    if it marks the large readings off better (F-score).
    """
    absolute = np.abs(size)
    top = float(absolute.max(initial=0.0))
    if top < 1e-9:
        return Region((), "Nowhere: the calibrated base model agrees with the readings within their noise.")
    large = absolute >= max(0.5 * top, np.median(absolute))
    inside = np.ones(absolute.size, bool)
    chosen: dict[str, dict[str, Any]] = {}
    score = _f_score(inside, large)
    for _ in range(3):
        best: tuple[float, str, dict[str, Any], np.ndarray] | None = None
        for name in columns:
            if name in chosen:
                continue
            for cut, mask in _cuts(name, table[name]):
                value = _f_score(inside & mask, large)
                if best is None or value > best[0]:
                    best = (value, name, cut, mask)
        if best is None or best[0] < score + 0.02:
            break
        score, name, cut, mask = best
        chosen[name] = cut
        inside &= mask
    return Region(tuple(chosen.values()), _words(tuple(chosen.values()), absolute, inside, size))


def _cuts(name: str, values: np.ndarray) -> list[tuple[dict[str, Any], np.ndarray]]:
    levels = np.unique(values)
    if levels.size < 2:
        return []
    if values.dtype.kind in "US":
        return [({"column": name, "values": [str(level)]}, values == level) for level in levels]
    points = set_points(values)
    levels = np.unique(points)
    if levels.size > 12:
        levels = np.unique(np.quantile(points, np.linspace(0.0, 1.0, 12)))
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


def _words(where: tuple[dict[str, Any], ...], absolute: np.ndarray, inside: np.ndarray, size: np.ndarray) -> str:
    sign = "above" if np.sum(size[inside]) > 0 else "below"
    rms = float(np.sqrt(np.mean(absolute[inside] ** 2))) if inside.any() else 0.0
    if not where:
        return f"Everywhere: the recording lies {sign} the base model by {rms:.1f} sigma (rms)."
    parts = []
    for cut in where:
        if "values" in cut:
            parts.append(f"{cut['column']} is {', '.join(cut['values'])}")
        elif (point := one_point(cut["low"], cut["high"])) is not None:
            parts.append(f"{cut['column']} is {point:g}")
        else:
            parts.append(f"{cut['column']} is {cut['low']:g} to {cut['high']:g}")
    outside = float(np.sqrt(np.mean(absolute[~inside] ** 2))) if (~inside).any() else 0.0
    return (
        f"Where {' and '.join(parts)}: the recording lies {sign} the base model by {rms:.1f} sigma (rms), "
        f"against {outside:.1f} elsewhere."
    )
