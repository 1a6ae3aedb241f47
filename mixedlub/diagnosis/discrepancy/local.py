"""Local discrepancy at one value of one condition: a peak, such as a resonance, or a step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.discrepancy.waves import is_explained_by, stepped_levels
from mixedlub.diagnosis.settings.discrepancy import (
    LOCAL_CONFOUNDED,
    LOCAL_LEVELS,
    LOCAL_READINGS,
    MOST_PLACES,
    PEAK_SHARE,
    PEAK_WIDTHS,
    SAME_FORM_WITHIN,
)
from mixedlub.diagnosis.settings.inference import OUTLIER_SHARE
from mixedlub.recording.conditions import PASSING, Coordinates
from mixedlub.recording.set_points import set_points

DERIVED, TURNED = "composite_roughness_um", "position_deg"


@dataclass(frozen=True)
class Place:
    """Position of a local form: a condition, a value, and the width of a peak as a share of the range (step: zero)."""

    name: str
    at: float
    width: float


def candidate_places(space: Coordinates, values: list[np.ndarray], timeless: bool) -> list[Place]:
    """Peaks and steps that a recording could show; no steps in time if ``timeless``.

    Forms in time that coincide with consecutive levels of a condition are attributed to the condition.
    """
    found: list[Place] = []
    for i, axis in enumerate(space.axes):
        if axis.named or axis.name in (DERIVED, TURNED):
            continue
        levels = levels_of(space, values, i)
        if levels.size < LOCAL_LEVELS:
            continue
        points = set_points(values[i])
        passing = axis.name in PASSING
        stepped = stepped_levels(values, i) if passing else []
        for at, edge in zip(thinned(levels), thinned(edges(levels)), strict=True):
            tried: list[np.ndarray] = []
            for width in PEAK_WIDTHS if passing and timeless else (*PEAK_WIDTHS, 0.0):
                value = float(at if width else edge)
                near = axis.about(points, value, width).sum(axis=1)
                if any(is_explained_by(near[:, None], label, LOCAL_CONFOUNDED) for label in stepped):
                    continue
                if is_identifiable(near, width > 0.0) and not any(
                    np.allclose(near, other, atol=SAME_FORM_WITHIN) for other in tried
                ):
                    found.append(Place(axis.name, value, width))
                    tried.append(near)
    return found


def levels_of(space: Coordinates, values: list[np.ndarray], axis: int) -> np.ndarray:
    """Set points of a condition; absolute values if it has both signs."""
    points = set_points(values[axis])
    return np.unique(np.abs(points) if space.axes[axis].symmetric_log else points)


def edges(levels: np.ndarray) -> np.ndarray:
    """Places of steps: midway between neighbouring levels, and at the lowest level.

    >>> edges(np.array([1.0, 3.0, 4.0])).tolist()
    [1.0, 2.0, 3.5]
    """
    return np.concatenate([levels[:1], 0.5 * (levels[1:] + levels[:-1])])


def thinned(candidate_places: np.ndarray) -> np.ndarray:
    """Even subset of at most MOST_PLACES places."""
    if candidate_places.size <= MOST_PLACES:
        return candidate_places
    return candidate_places[np.linspace(0, candidate_places.size - 1, MOST_PLACES).round().astype(int)]


def finer(space: Coordinates, values: list[np.ndarray], axis: int, at: float, width: float) -> np.ndarray:
    """Places between the neighbours of a thinned place."""
    levels = levels_of(space, values, axis)
    every = levels if width else edges(levels)
    few = thinned(every)
    here = int(np.argmin(np.abs(few - at)))
    low, high = few[max(here - 1, 0)], few[min(here + 1, few.size - 1)]
    return thinned(every[(every >= low) & (every <= high)])


def is_identifiable(near: np.ndarray, peak: bool) -> bool:
    """Whether a form has enough readings not to be outliers and, if a peak, few enough not to be a trend."""
    readings = float(near.sum() ** 2 / max((near**2).sum(), 1e-300))
    least = max(LOCAL_READINGS, OUTLIER_SHARE * near.size)
    return least <= readings <= (PEAK_SHARE * near.size if peak else near.size - least)
