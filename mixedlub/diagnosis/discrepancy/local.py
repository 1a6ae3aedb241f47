"""Forms tied to one place of one condition: a peak about it, such as a resonance, or a step there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.discrepancy.waves import goes_with, stepped_levels
from mixedlub.diagnosis.inference.map_fit import OUTLIER_SHARE
from mixedlub.recording.conditions import PASSING, Coordinates
from mixedlub.recording.set_points import set_points

WIDTHS = (0.01, 0.03, 0.1)
"""Standard deviations of a peak, as shares of the condition's range: the least is one level alone."""
LEVELS = 5
"""Levels of a condition, on either side of zero, from which its smooth functions do not follow a peak anyhow."""
MOST_PLACES = 40
"""Places of a condition that are tried at first; those between the best ones are tried later."""
FEWEST = 3.0
"""Readings that a form has to be made of, and no fewer than outliers are usual: fewer are outliers."""
MOST_SHARE = 0.4
"""Share of the readings that a peak may cover: more are a trend."""
SAME = 0.75
"""Share of what happens at one time that goes with a condition from which it is that condition's."""
DERIVED, TURNED = "composite_roughness_um", "position_deg"


@dataclass(frozen=True)
class Place:
    """Where on a condition a form stands; ``width`` is a peak's standard deviation as a share of the range.

    No width stands for a step.
    """

    name: str
    at: float
    width: float


def places(space: Coordinates, values: list[np.ndarray], timeless: bool) -> list[Place]:
    """Peaks and steps that a recording could show; no steps in time where those are ``timeless``.

    What in time goes with the levels of a condition, which were run one after the other, is left to that condition.
    """
    found: list[Place] = []
    for i, axis in enumerate(space.axes):
        if axis.named or axis.name in (DERIVED, TURNED):
            continue
        levels = levels_of(space, values, i)
        if levels.size < LEVELS:
            continue
        points = set_points(values[i])
        passing = axis.name in PASSING
        stepped = stepped_levels(values, i) if passing else []
        for at, edge in zip(thinned(levels), thinned(edges(levels)), strict=True):
            told: list[np.ndarray] = []
            for width in WIDTHS if passing and timeless else (*WIDTHS, 0.0):
                stands = float(at if width else edge)
                near = axis.about(points, stands, width).sum(axis=1)
                if any(goes_with(near[:, None], label, SAME) for label in stepped):
                    continue
                if made_of(near, width > 0.0) and not any(np.allclose(near, other, atol=0.05) for other in told):
                    found.append(Place(axis.name, stands, width))
                    told.append(near)
    return found


def levels_of(space: Coordinates, values: list[np.ndarray], axis: int) -> np.ndarray:
    """Set-points of a condition; of one with both signs those on the positive side."""
    points = set_points(values[axis])
    return np.unique(np.abs(points) if space.axes[axis].folded else points)


def edges(levels: np.ndarray) -> np.ndarray:
    """Where steps stand: midway from each level to the next lower one, and at the lowest.

    >>> edges(np.array([1.0, 3.0, 4.0])).tolist()
    [1.0, 2.0, 3.5]
    """
    return np.concatenate([levels[:1], 0.5 * (levels[1:] + levels[:-1])])


def thinned(places: np.ndarray) -> np.ndarray:
    """Evenly spread ones of very many places."""
    if places.size <= MOST_PLACES:
        return places
    return places[np.linspace(0, places.size - 1, MOST_PLACES).round().astype(int)]


def finer(space: Coordinates, values: list[np.ndarray], axis: int, at: float, width: float) -> np.ndarray:
    """Places about one of the thinned ones, as far as its neighbours."""
    levels = levels_of(space, values, axis)
    every = levels if width else edges(levels)
    few = thinned(every)
    here = int(np.argmin(np.abs(few - at)))
    low, high = few[max(here - 1, 0)], few[min(here + 1, few.size - 1)]
    return thinned(every[(every >= low) & (every <= high)])


def made_of(near: np.ndarray, peak: bool) -> bool:
    """Whether a form is of enough readings to be no outliers, and, if a peak, of few enough to be no trend."""
    readings = float(near.sum() ** 2 / max((near**2).sum(), 1e-300))
    fewest = max(FEWEST, OUTLIER_SHARE * near.size)
    return fewest <= readings <= (MOST_SHARE * near.size if peak else near.size - fewest)
