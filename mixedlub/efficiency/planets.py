"""Planets on their carrier: their places, whether they can be assembled and clear each other, and their pin forces."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations

import numpy as np

from mixedlub.efficiency.train import Coupling, PlanetaryTrain
from mixedlub.gear import GearPair
from profiles.errors import InputError

AGREES = 0.01
"""Judgement. Difference of two centre distances of one planet, in modules, above which they are two distances."""
SAME_SHAPE = 1e-6
"""Judgement. Difference over module up to which profile shifts or tip diameters of one wheel are the same."""
MOST_PLANETS = 24
"""Judgement. Largest number of planets named as one that can be assembled."""


@dataclass(frozen=True)
class PlanetSet:
    """Equally spaced groups of planets of a train; ``pairs``: gear pair of each mesh, by its name."""

    train: PlanetaryTrain
    pairs: Mapping[str, GearPair]
    count: int

    @cached_property
    def places(self) -> Mapping[str, complex]:
        """Centres (m) of the planets of one group in the plane of the carrier; the first lies on the real axis."""
        radii = {planet: self._radius(planet) for planet in self.train.planets}
        first = self.train.planets[0]
        found = {first: complex(radii[first])}
        waiting = [one for one in self.train.couplings if set(one.wheels) <= set(radii)]
        while waiting:
            ready = [one for one in waiting if set(one.wheels) & set(found)]
            if not ready:
                break
            for one in ready:
                waiting.remove(one)
                self._place(one, radii, found)
        for planet in radii:
            # A planet without mesh with another one may sit at any angle: on the same radius.
            found.setdefault(planet, complex(radii[planet]))
        return found

    def _place(self, one: Coupling, radii: Mapping[str, float], found: dict[str, complex]) -> None:
        """Place the second planet of a mesh of two planets by the triangle of the three centres."""
        known, new = one.wheels if one.wheels[0] in found else one.wheels[::-1]
        between = abs(self.pairs[one.name].working_centre_distance)
        cosine = (radii[known] ** 2 + radii[new] ** 2 - between**2) / (2 * radii[known] * radii[new])
        if new not in found and abs(cosine) > 1.0:
            rule = (
                f"{known} at {1e3 * radii[known]:.5g} mm and {new} at {1e3 * radii[new]:.5g} mm from the main axis "
                f"cannot be {1e3 * between:.5g} mm apart"
            )
            raise InputError(rule, where=f"meshes.{one.name}.gears")
        if new not in found:
            found[new] = radii[new] * cmath.exp(1j * (cmath.phase(found[known]) + math.acos(cosine)))

    def _radius(self, planet: str) -> float:
        """Distance (m) of a planet from the main axis, the same by each of its meshes with a sun or ring."""
        own = [one for one in self.train.couplings if planet in one.wheels]
        central = {
            one.name: abs(self.pairs[one.name].working_centre_distance)
            for one in own
            if not set(one.wheels) <= set(self.train.planets)
        }
        if not central:
            rule = (
                f"planet {planet!r} meshes with neither sun nor ring, so that nothing sets its distance from the axis"
            )
            raise InputError(rule, where="meshes")
        (low, near), (high, far) = (pick(central.items(), key=lambda item: item[1]) for pick in (min, max))
        if far - near > AGREES * self.pairs[low].normal_module:
            rule = (
                f"{planet} has one distance from the main axis, but the mesh {low} needs {1e3 * near:.6g} mm and "
                f"the mesh {high} {1e3 * far:.6g} mm: give gears.centre_distance_mm and profile_shift that agree"
            )
            raise InputError(rule, where=f"meshes.{high}.gears")
        return near

    def can_be_assembled(self, count: int) -> bool:
        r"""Whether so many identical planets, equally spaced, find teeth and spaces.

        Planet k stands where planet 0 stood, turned by k/n turns. A wheel of z teeth there needs a turn ``a`` of its
        body with a z = z_c/n modulo 1 against a central wheel of z_c teeth (below zero for a ring), and a z + b z' = 0
        modulo 1 against another planet. A simple train has the solution if (z_s + z_r)/n is whole.

        Source: the condition of Mueller, Epicyclic Drive Trains, for planets of one and of two wheels, derived for any.
        """
        return self._fits({}, count, list(self.train.planets))

    def _fits(self, turns: dict[str, Fraction], count: int, left: list[str]) -> bool:
        if not left:
            return True
        body, *others = left
        for turn in self._turns(body, count):
            trial = {**turns, body: turn}
            fits = all(self._in_phase(one, trial, count) for one in self.train.couplings if body in one.wheels)
            if fits and self._fits(trial, count, others):
                return True
        return False

    def _turns(self, body: str, count: int) -> Iterator[Fraction]:
        """Turns of a body that suit its first mesh with a central wheel."""
        for one in self.train.couplings:
            if body in one.wheels and not set(one.wheels) <= set(self.train.planets):
                index = one.wheels.index(body)
                own, other = one.teeth[index], one.teeth[1 - index]
                yield from ((Fraction(other, count) + whole) / own for whole in range(abs(own)))
                return

    def _in_phase(self, one: Coupling, turns: Mapping[str, Fraction], count: int) -> bool:
        """Whether teeth meet spaces in a mesh; True while one of its planets has no turn yet."""
        total = Fraction(0)
        for wheel, teeth in zip(one.wheels, one.teeth, strict=True):
            if wheel in self.train.planets:
                if wheel not in turns:
                    return True
                total += turns[wheel] * teeth
            else:
                total -= Fraction(teeth, count)
        return total.denominator == 1

    def check(self, least: float) -> None:
        """Raise an error for planets of two shapes, not assembled, or nearer than ``least`` (m) to each other."""
        self._check_shapes()
        if not self.can_be_assembled(self.count):
            fitting = [str(n) for n in range(1, MOST_PLANETS + 1) if self.can_be_assembled(n)]
            rule = f"so many equally spaced planets cannot be assembled{self._sum()}; {', '.join(fitting)} can"
            raise InputError(rule, where="planet_count", value=self.count)
        places = self.places
        if self.count == 1:
            return
        step = cmath.exp(2j * math.pi / self.count)
        for first, second, tips in self._neighbours():
            ways = (step, step.conjugate()) if first != second else (step,)
            gap = min(abs(places[first] - places[second] * turn) for turn in ways) - tips
            if gap < least:
                says = f"overlap by {-1e3 * gap:.4g} mm" if gap < 0 else f"have only {1e3 * gap:.4g} mm between them"
                rule = f"the tips of neighbouring planets ({' and '.join(dict.fromkeys((first, second)))}) {says}"
                raise InputError(rule, where="planet_count", value=self.count)

    def _check_shapes(self) -> None:
        """Raise an error for a planet that has two shapes in two meshes as one wheel.

        A planet is never a ring, so its profile shift has one sign in all meshes.
        """
        for planet in self.train.planets:
            for first, second in combinations(self._of(planet), 2):
                (one, i), (other, j) = ((self.pairs[own.name], own.wheels.index(planet)) for own in (first, second))
                if _wheel(one, i) != _wheel(other, j):
                    continue
                shapes = {"profile_shift": (one.profile_shift[i], other.profile_shift[j])}
                if one.tip_radius is not None and other.tip_radius is not None:
                    scale = 2.0 / one.normal_module
                    shapes["tip_diameter_mm"] = (scale * one.tip_radius[i], scale * other.tip_radius[j])
                for key, (here, there) in shapes.items():
                    if abs(here - there) > SAME_SHAPE:
                        unit = 1.0 if key == "profile_shift" else 1e3 * one.normal_module
                        rule = (
                            f"{planet} is one wheel, but has {key} {here * unit:.6g} in the mesh {first.name} and "
                            f"{there * unit:.6g} in the mesh {second.name}: give one value"
                        )
                        raise InputError(rule, where=f"meshes.{second.name}.gears.{key}")

    def _neighbours(self) -> Iterator[tuple[str, str, float]]:
        """Pairs of planets of neighbouring groups, with the sum of their tip radii (m)."""
        tips: dict[str, float] = {}
        for one in self.train.couplings:
            for wheel, tip in zip(one.wheels, self.pairs[one.name].tip_radii, strict=True):
                tips[wheel] = max(tips.get(wheel, 0.0), tip)
            if set(one.wheels) <= set(self.train.planets):
                yield (*one.wheels, sum(self.pairs[one.name].tip_radii))
        for planet in self.train.planets:
            yield planet, planet, 2 * tips[planet]

    def _sum(self) -> str:
        """The condition of a simple train as text."""
        central = [one.teeth[1 - one.wheels.index(p)] for p in self.train.planets for one in self._of(p)]
        own = {one.teeth[one.wheels.index(p)] for p in self.train.planets for one in self._of(p)}
        if len(self.train.planets) > 1 or len(central) != 2 or len(own) > 1:
            return ""
        first, second = (abs(teeth) for teeth in central)
        sign, total = ("+", first + second) if min(central) < 0 < max(central) else ("-", first - second)
        return f": ({first} {sign} {second})/{self.count} = {total / self.count:.6g} is not whole"

    def _of(self, planet: str) -> list[Coupling]:
        return [one for one in self.train.couplings if planet in one.wheels]

    def pin_forces(
        self, force: np.ndarray, carrier_speed: np.ndarray, mass: Mapping[str, float]
    ) -> dict[str, np.ndarray]:
        """Forces (N) of the planets on their pins in one group, as complex numbers in the plane of `places`.

        ``force``: torque (N m) over teeth of each mesh of this group (M, N); ``carrier_speed`` (rad/s); ``mass`` (kg):
        centrifugal force m r omega_c^2 outwards. In the mesh the tangential force with its radial part tan(alpha_wt),
        which pushes the planet away from the pitch point. Without weight.
        """
        found = {}
        for planet in self.train.planets:
            place = self.places[planet]
            total = mass[planet] * place * carrier_speed**2 + 0j
            for row, one in enumerate(self.train.couplings):
                if planet not in one.wheels:
                    continue
                index = one.wheels.index(planet)
                pair, other = self.pairs[one.name], one.wheels[1 - index]
                towards = self.places[other] - place if other in self.places else -place
                towards = (towards if not pair.ring else -towards) / abs(towards)
                tangential = force[row] * one.teeth[index] / abs(pair.operating_radius[index])
                total = total + towards * (1j * tangential - np.abs(tangential) * math.tan(pair.working_pressure_angle))
            found[planet] = total
        return found


def _wheel(pair: GearPair, index: int) -> tuple[float, ...]:
    """Teeth, module, pressure angle and helix angle of a wheel, alike for the same wheel in two meshes."""
    sizes = (pair.normal_module * 1e3, pair.pressure_angle, abs(pair.helix_angle))
    return (float(pair.teeth[index]), *(round(size, 9) for size in sizes))
