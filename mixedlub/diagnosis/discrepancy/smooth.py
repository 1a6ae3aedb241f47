"""Forms of the discrepancy: smooth functions, waves in time, peaks, steps and boxes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mixedlub.case.forward import Run
from mixedlub.diagnosis.discrepancy.boxes import Box, inside
from mixedlub.diagnosis.discrepancy.local import Place, candidate_places, finer
from mixedlub.diagnosis.discrepancy.modulated import (
    ADDITIVE,
    QUANTITIES,
    READING,
    THERMAL_LAG,
    Scalings,
    TypicalSizes,
    scaling_of,
)
from mixedlub.diagnosis.discrepancy.past import Remembered
from mixedlub.diagnosis.discrepancy.waves import CLOCK, frequencies
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.discrepancy import (
    LOG_FACTOR_SIZES,
    READING_SIZES,
    ROUGH_LENGTH,
    SCREENED_SIZE,
    SMOOTH_LENGTHS,
    WAVE_REFINEMENT,
)
from mixedlub.recording.conditions import PASSING, Coordinates

LOCAL = (READING, ADDITIVE, "running_friction")
"""Quantities that peaks and steps scale with; in a drive also its friction without the payload."""
EVENT, MISCOUNT = "friction_event", "fringe_order"
"""Effects that are a step in time, and an additive step of film thickness."""
REDUNDANT = {"surfaces", "composite_roughness_um"}
"""Two conditions, one a function of the other: their product adds nothing."""


@dataclass(frozen=True)
class DiscrepancyForm:
    """A form of the discrepancy: axes, correlation length, size, and modulated quantity.

    No axes mean all of them. A wave has ``waves`` periods along its axis. A peak or a step lies ``at`` a value of its
    axis, and ``length`` is the width of the peak. A ``box`` is a range of each of its axes. With a ``past`` the form
    is a history coordinate, times a smooth function of its axis if it has one.
    """

    axes: tuple[str, ...]
    length: float
    size: float
    modulates: str
    interactions: bool
    waves: float = 0.0
    at: float | None = None
    box: Box = ()
    past: Remembered | None = None

    @property
    def form(self) -> str:
        """Kind of function."""
        if self.modulates == THERMAL_LAG:
            return "delay"
        if self.past is not None:
            return "history"
        if self.box:
            return "box"
        return "wave" if self.waves else "smooth" if self.at is None else "peak" if self.length else "step"

    def columns(self, space: Coordinates, values: list[np.ndarray], scalings_of: Scalings) -> np.ndarray:
        """Columns of the form, in standard deviations."""
        if self.modulates == THERMAL_LAG or (self.past is not None and not self.axes):
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
        return columns * self._sizes_of_rows(scalings_of)[:, None]

    def _sizes_of_rows(self, scalings_of: Scalings) -> np.ndarray:
        times = scalings_of[self.modulates]
        return self.size * (times if self.past is None else times * scalings_of[self.past.key])

    def faded(
        self, space: Coordinates, recorded: list[np.ndarray], values: list[np.ndarray], scalings_of: Scalings
    ) -> np.ndarray:
        """Prior variance of a smooth function that its columns lack at new rows: they vanish far from recorded ones."""
        if self.form != "smooth" and not (self.form == "history" and self.axes):
            return np.zeros(values[0].size)
        held = [
            (space.columns(v, self.length, self.axes, self.interactions) ** 2).sum(axis=1) for v in (recorded, values)
        ]
        return np.asarray(np.maximum(held[0].min() - held[1], 0.0) * self._sizes_of_rows(scalings_of) ** 2)

    def scalings_at(self, problem: Problem, base: Run, typical: TypicalSizes, space: Coordinates) -> Scalings:
        """The scalings of the form in the rows of a problem."""
        found = {self.modulates: scaling_of(problem, base, typical, self.modulates)}
        return found if self.past is None else {**found, self.past.key: self.past.factor(space, problem.forward)}

    @property
    def sizes(self) -> tuple[float, ...]:
        """Candidate sizes."""
        return READING_SIZES if self.modulates in (READING, ADDITIVE) else LOG_FACTOR_SIZES

    def near(self, space: Coordinates, values: list[np.ndarray]) -> list[DiscrepancyForm]:
        """Forms between the forms of its family: waves of any period, peaks and steps at any level."""
        if self.at is not None:
            between = finer(space, values, space.place(self.axes[0]), self.at, self.length)
            return [replace(self, at=float(at)) for at in between]
        return [replace(self, waves=float(w)) for w in self.waves + WAVE_REFINEMENT] if self.waves else [self]

    def at_other_places(self, space: Coordinates, values: list[np.ndarray]) -> list[DiscrepancyForm]:
        """The same peak or step at all candidate places of its condition; any other form alone."""
        if self.at is None:
            return [self]
        every = (
            p.at for p in candidate_places(space, values, False) if (p.name, p.width) == (self.axes[0], self.length)
        )
        return [replace(self, at=at) for at in dict.fromkeys((self.at, *every))]


def most_flexible(space: Coordinates) -> DiscrepancyForm:
    """The most flexible smooth form."""
    return DiscrepancyForm((), SMOOTH_LENGTHS[0], READING_SIZES[SCREENED_SIZE], READING, len(space.axes) > 1)


def candidate_forms(
    space: Coordinates,
    values: list[np.ndarray],
    scalings_of: Scalings,
    names: Collection[str],
    pasts: Collection[Remembered] = (),
) -> list[list[DiscrepancyForm]]:
    """Candidate forms of size one, by family, without forms that are effects among ``names``."""
    waves = [DiscrepancyForm((CLOCK,), 0.0, 1.0, READING, False, waves=float(w)) for w in frequencies(space, values)]
    local = [
        DiscrepancyForm((place.name,), place.width, 1.0, carrier, False, at=place.at)
        for place in candidate_places(space, values, timeless=EVENT in names)
        for carrier in LOCAL
        if carrier in scalings_of and not (MISCOUNT in names and _is_miscount(place, carrier))
    ]
    peaks, steps = ([s for s in local if s.form == form] for form in ("peak", "step"))
    delay = [DiscrepancyForm((), 0.0, 1.0, THERMAL_LAG, False)] if THERMAL_LAG in scalings_of else []
    history = [
        DiscrepancyForm(axes, SMOOTH_LENGTHS[-1], 1.0, modulated, False, past=past)
        for past in pasts
        for modulated in modulated_in(scalings_of)
        for axes in ((), (past.past.column,))
    ]
    return [family for family in (_smooth(space, scalings_of), waves, peaks, steps, delay, history) if family]


def modulated_in(scalings_of: Scalings) -> list[str]:
    """The reading, the addition and the quantities of the chain among scalings."""
    return [name for name in scalings_of if name in (READING, ADDITIVE, *QUANTITIES)]


def _is_miscount(place: Place, carrier: str) -> bool:
    return place.width == 0.0 and carrier == ADDITIVE and place.name not in PASSING


def _smooth(space: Coordinates, scalings_of: Scalings) -> list[DiscrepancyForm]:
    names = [axis.name for axis in space.axes]
    forms = []
    for length in SMOOTH_LENGTHS:
        for modulated in modulated_in(scalings_of):
            forms.append(DiscrepancyForm((), length, 1.0, modulated, False))
            if len(names) == 1 and length == SMOOTH_LENGTHS[0]:
                forms.append(DiscrepancyForm((), ROUGH_LENGTH, 1.0, modulated, False))
            if len(names) > 1:
                forms.append(DiscrepancyForm((), length, 1.0, modulated, True))
                forms.extend(DiscrepancyForm((name,), length, 1.0, modulated, False) for name in names)
                if length == SMOOTH_LENGTHS[0]:
                    forms.extend(DiscrepancyForm((name,), ROUGH_LENGTH, 1.0, modulated, False) for name in names)
            if len(names) > 2:
                pairs = (two for two in combinations(names, 2) if set(two) != REDUNDANT)
                forms.extend(DiscrepancyForm(two, length, 1.0, modulated, True) for two in pairs)
    return forms
