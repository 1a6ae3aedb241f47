"""The forms that a mismatch without a name may have: smooth functions, waves in time, peaks and steps at one place."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.discrepancy.boxes import Box, inside
from mixedlub.diagnosis.discrepancy.local import Place, finer, places
from mixedlub.diagnosis.discrepancy.modulated import ADDITIVE, LATE, READING, Carriers
from mixedlub.diagnosis.discrepancy.waves import CLOCK, FINER, frequencies
from mixedlub.recording.conditions import PASSING, Coordinates

LENGTHS = (0.25, 0.7)
"""How far a smooth form reaches along a condition, as shares of its range."""
ROUGH = 0.08
"""Length of a form of one condition whose neighbouring levels are all but independent of one another."""
SIZES = (0.7, 2.0, 6.0, 20.0, 60.0)
"""How large a mismatch of the reading may be, in sigmas."""
FACTORS = (0.03, 0.1, 0.3, 1.0)
"""How large one of a quantity of the chain may be, in its logarithm."""
LOCAL = (READING, ADDITIVE, "running_friction")
"""What peaks and steps ride on: in a drive also its friction, without the payload."""
EVENT, MISCOUNT = "friction_event", "fringe_order"
"""Effects that are the names of a step in time, and of an added step in what moves a film."""
SAME = {"surfaces", "composite_roughness_um"}
"""The roughness is a function of the surfaces: together they say no more than these."""


@dataclass(frozen=True)
class Shape:
    """One form an unnamed mismatch may have: along which axes, how smooth, how large, and what it rides on.

    No axes stand for all of them; most laws depend on one or two. A wave goes through ``waves`` periods of its axis; a
    peak or a step stands ``at`` a place of its axis, and ``length`` is the width of the peak. A ``box`` is a range of
    each of its axes.
    """

    axes: tuple[str, ...]
    length: float
    size: float
    carrier: str
    interactions: bool
    waves: float = 0.0
    at: float | None = None
    box: Box = ()

    @property
    def form(self) -> str:
        """What kind of function it is."""
        if self.carrier == LATE:
            return "delay"
        if self.box:
            return "box"
        return "wave" if self.waves else "smooth" if self.at is None else "peak" if self.length else "step"

    def columns(self, space: Coordinates, values: list[np.ndarray], carriers: Carriers) -> np.ndarray:
        """The shape's columns in sigmas."""
        if self.carrier == LATE:
            columns = np.ones((values[0].size, 1))
        elif self.box:
            columns = inside(self.box, space, values).astype(float)[:, None]
        elif self.waves:
            place = space.place(self.axes[0])
            columns = space.axes[place].wave(values[place], self.waves)
        elif self.at is not None:
            place = space.place(self.axes[0])
            columns = space.axes[place].about(values[place], self.at, self.length)
        else:
            columns = space.columns(values, self.length, self.axes, self.interactions)
        return self.size * columns * carriers[self.carrier][:, None]

    @property
    def sizes(self) -> tuple[float, ...]:
        """The sizes it is tried with."""
        return SIZES if self.carrier in (READING, ADDITIVE) else FACTORS

    def near(self, space: Coordinates, values: list[np.ndarray]) -> list[Shape]:
        """Shapes between those of its family: waves of any period, peaks and steps at any level."""
        if self.at is not None:
            between = finer(space, values, space.place(self.axes[0]), self.at, self.length)
            return [replace(self, at=float(at)) for at in between]
        return [replace(self, waves=float(w)) for w in self.waves + FINER] if self.waves else [self]

    def elsewhere(self, space: Coordinates, values: list[np.ndarray]) -> list[Shape]:
        """The same peak or step wherever on its condition one is tried; of other forms itself alone."""
        if self.at is None:
            return [self]
        alike = (p.at for p in places(space, values, False) if (p.name, p.width) == (self.axes[0], self.length))
        return [replace(self, at=at) for at in dict.fromkeys((self.at, *alike))]


def rich(space: Coordinates) -> Shape:
    """The smooth shape that follows most."""
    return Shape((), LENGTHS[0], 6.0, READING, len(space.axes) > 1)


def families(
    space: Coordinates, values: list[np.ndarray], carriers: Carriers, names: Collection[str]
) -> list[list[Shape]]:
    """All shapes that are tried, of size one, by their form, but those that are effects among ``names``."""
    waves = [Shape((CLOCK,), 0.0, 1.0, READING, False, waves=float(w)) for w in frequencies(space, values)]
    local = [
        Shape((place.name,), place.width, 1.0, carrier, False, at=place.at)
        for place in places(space, values, timeless=EVENT in names)
        for carrier in LOCAL
        if carrier in carriers and not (MISCOUNT in names and _is_miscount(place, carrier))
    ]
    peaks, steps = ([s for s in local if s.form == form] for form in ("peak", "step"))
    delay = [Shape((), 0.0, 1.0, LATE, False)] if LATE in carriers else []
    return [family for family in (_smooth(space, carriers), waves, peaks, steps, delay) if family]


def _is_miscount(place: Place, carrier: str) -> bool:
    return place.width == 0.0 and carrier == ADDITIVE and place.name not in PASSING


def _smooth(space: Coordinates, carriers: Carriers) -> list[Shape]:
    names = [axis.name for axis in space.axes]
    found = []
    for length in LENGTHS:
        for carrier in (name for name in carriers if name != LATE):
            found.append(Shape((), length, 1.0, carrier, False))
            if len(names) == 1 and length == LENGTHS[0]:
                found.append(Shape((), ROUGH, 1.0, carrier, False))
            if len(names) > 1:
                found.append(Shape((), length, 1.0, carrier, True))
                found.extend(Shape((name,), length, 1.0, carrier, False) for name in names)
                if length == LENGTHS[0]:
                    found.extend(Shape((name,), ROUGH, 1.0, carrier, False) for name in names)
            if len(names) > 2:
                pairs = (two for two in combinations(names, 2) if set(two) != SAME)
                found.extend(Shape(two, length, 1.0, carrier, True) for two in pairs)
    return found
