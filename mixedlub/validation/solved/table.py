"""Solutions over the contacts of a rig, as ratios to the base model's film and stress."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from mixedlub.validation.contact import Calibration, Contact, Inputs, dowson_toyoda, press, shear, start
from mixedlub.validation.solved.fluid import Law, eyring, fluid_of
from mixedlub.validation.solved.mesh import CELLS
from mixedlub.validation.solved.solver import Place, Solution, UnsolvedError, solve

SLIPS, LOADS, SPEEDS = 5, 5, 5
"""Nodes along each condition."""
LEAST_SLIP, MOST_SLIP = 0.015, 1.9
"""Slide-to-roll ratios that are solved; below, friction is linear in the ratio."""
OTHER_CELLS = (CELLS, 200, 110)
"""Numbers of cells tried in turn until a contact has a solution."""


@dataclass(frozen=True)
class Physics:
    """Physics of a solution: law of shear (by default Eyring's of the data sheet), heat, and distance of the oil.

    ``inlet``: half widths before the centre where the film begins, infinite if flooded.
    """

    law: Law | None = None
    thermal: bool = False
    inlet: float = np.inf


def solution(rig: Inputs, calibration: Calibration, physics: Physics, place: Place) -> Solution:
    """Solution of one contact of a rig with a calibrated oil, on the first number of cells that has one."""
    law = eyring(rig.oil.eyring_stress * calibration.eyring_stress) if physics.law is None else physics.law
    fluid = fluid_of(rig.oil, law, calibration.viscosity, calibration.pressure_viscosity)
    failure = UnsolvedError("")
    for cells in OTHER_CELLS:
        try:
            return solve(fluid, place, physics.thermal, cells)
        except UnsolvedError as none:
            failure = none
    raise failure


def between(low: float, high: float, count: int) -> np.ndarray:
    """Extremes of a Chebyshev polynomial on the logarithms of a range; one node if the range is a point.

    >>> [round(float(np.exp(x)), 3) for x in between(1.0, 100.0, 3)]
    [1.0, 10.0, 100.0]
    """
    if high < low * 1.01:
        return np.log([np.sqrt(low * high)])
    first, last = np.log(low), np.log(high)
    return np.asarray(0.5 * (first + last) - 0.5 * (last - first) * np.cos(np.pi * np.arange(count) / (count - 1)))


def shares(nodes: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Weights of the polynomial through the nodes at places, which are held inside the nodes; on a last axis."""
    held = np.clip(x, nodes[0], nodes[-1])[..., None]
    found = np.ones((*np.shape(x), len(nodes)))
    for i, own in enumerate(nodes):
        for j, other in enumerate(nodes):
            if i != j:
                found[..., i] *= (held[..., 0] - other) / (own - other)
    return found


@dataclass(frozen=True)
class Grid:
    """Contacts of a rig that are solved: temperatures (C), sides of the pitch point, and logarithms of the others.

    ``radii``: reduced radius (m) by side and slip.
    """

    temperatures: np.ndarray
    sides: np.ndarray
    slips: np.ndarray
    loads: np.ndarray
    speeds: np.ndarray
    radii: np.ndarray

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(axis) for axis in (self.temperatures, self.sides, self.slips, self.loads, self.speeds))

    def places(self, rig: Inputs) -> list[Place]:
        """Conditions of every node."""
        found = []
        for t, side, slip, load, speed in product(*(range(count) for count in self.shape)):
            u, half = np.exp(self.speeds[speed]), 0.5 * self.sides[side] * np.exp(self.slips[slip])
            speeds = float(u * (1 + half)), float(u * (1 - half))
            radius, force = float(self.radii[side, slip]), float(np.exp(self.loads[load]))
            found.append(Place(radius, force, speeds, float(self.temperatures[t]), solid=rig.solid))
        return found


def slip_of(c: Contact) -> np.ndarray:
    return np.clip(c.sliding / c.entrainment, LEAST_SLIP, MOST_SLIP)


def grid_of(rig: Inputs) -> Grid:
    """Grid over the loaded contacts of a rig; on each side of the pitch point the radius follows the slip."""
    c = start(rig, Calibration())
    slip, side = np.broadcast_arrays(slip_of(c), np.sign(rig.speed_1 - rig.speed_2))
    radius = np.broadcast_to(rig.radius, slip.shape)
    loads, speeds = c.line_load[c.line_load > 0], c.entrainment
    slips = between(float(slip.min()), float(slip.max()), SLIPS)
    sides = np.array([-1.0, 1.0]) if rig.is_mesh else np.array([1.0])
    radii = np.empty((len(sides), len(slips)))
    for i, one in enumerate(sides):
        there = side[0] == one if rig.is_mesh else np.ones(slip.shape[1], dtype=bool)
        order = np.argsort(slip[0, there])
        radii[i] = np.interp(slips, np.log(slip[0, there][order]), radius[0, there][order])
    return Grid(
        np.unique(rig.temperature),
        sides,
        slips,
        between(float(loads.min()), float(loads.max()), LOADS),
        between(float(speeds.min()), float(speeds.max()), SPEEDS),
        radii,
    )


def formulas(rig: Inputs, calibration: Calibration, places: Sequence[Place]) -> Contact:
    """Base model of contacts up to the film, one a row."""

    def column(values: list[float]) -> np.ndarray:
        return np.array(values)[:, None]

    own = replace(
        rig,
        radius=column([place.radius for place in places]),
        speed_1=column([place.speeds[0] for place in places]),
        speed_2=column([place.speeds[1] for place in places]),
        share_force=column([place.load * rig.width for place in places]),
        temperature=np.array([place.celsius for place in places]),
        moments=np.repeat(rig.moments[:1], len(places), axis=0),
        shares=np.full((1, 2, 3), 0.5),
        laws={},
    )
    return dowson_toyoda(press(start(own, calibration)))


def ratios(
    rig: Inputs, calibration: Calibration, physics: Physics, places: Sequence[Place]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Logarithms of solved over formula's film and stress, the stress at the solved film, and the friction."""
    found = [solution(rig, calibration, physics, replace(place, inlet=physics.inlet)) for place in places]
    film, friction = np.array([one.central_film for one in found]), np.array([one.friction for one in found])
    c = formulas(rig, calibration, places)
    stress = shear(replace(c, film=film[:, None])).stress[:, 0]
    return np.log(film / c.film[:, 0]), np.log(friction * c.pressure[:, 0] / stress), friction


@dataclass
class Table:
    """Ratios on the grid of a rig (logarithms), interpolated by polynomials in the logarithms of its conditions."""

    grid: Grid
    film: np.ndarray
    stress: np.ndarray
    friction: np.ndarray
    kept: list[tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]] = field(default_factory=list)

    def at(self, c: Contact) -> tuple[np.ndarray, np.ndarray]:
        """Ratios of film and stress (logarithms) at contacts; the last few answers are kept."""
        key = (c.line_load, c.entrainment)
        for known, values in self.kept:
            if all(a.shape == b.shape and np.array_equal(a, b) for a, b in zip(known, key)):
                return values
        values = self._at(c)
        self.kept = [(key, values), *self.kept[:3]]
        return values

    def _at(self, c: Contact) -> tuple[np.ndarray, np.ndarray]:
        arrays = (np.log(slip_of(c)), np.log(np.maximum(c.line_load, 1.0)), np.log(c.entrainment))
        side = np.sign(c.rig.speed_1 - c.rig.speed_2) if c.rig.is_mesh else np.ones((1, 1))
        slip, load, speed, side, celsius = np.broadcast_arrays(*arrays, side, c.temperature)
        weights = [
            np.argmin(np.abs(celsius[..., None] - self.grid.temperatures), axis=-1),
            np.argmin(np.abs(side[..., None] - self.grid.sides), axis=-1),
        ]
        one, two, three = shares(self.grid.slips, slip), shares(self.grid.loads, load), shares(self.grid.speeds, speed)
        return tuple(
            np.einsum("...ijk,...i,...j,...k->...", values[weights[0], weights[1]], one, two, three)
            for values in (self.film, self.stress)
        )


def table(rig: Inputs, calibration: Calibration, physics: Physics) -> Table:
    """Table of a rig."""
    grid = grid_of(rig)
    film, stress, friction = ratios(rig, calibration, physics, grid.places(rig))
    return Table(grid, film.reshape(grid.shape), stress.reshape(grid.shape), friction.reshape(grid.shape))
