"""Full solution of a smooth line contact: pressure and film by Newton's method, in turns with the temperatures."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from mixedlub.validation.contact import KELVIN, Solid
from mixedlub.validation.solved.flow import flow, heat_shares
from mixedlub.validation.solved.fluid import Fluid
from mixedlub.validation.solved.heat import LAYERS, SQUARES, Sources, Warmth, flash, resting, warmed
from mixedlub.validation.solved.mesh import CELLS, Mesh, mesh, to_ends
from profiles.errors import InputError

ROUNDS, SETTLED, SETTLED_KELVIN = 80, 5e-5, 0.2
"""Largest number of Newton steps, and changes of pressure (p_h) and temperature (K) below which they end."""
WIDEST_STEP, PENALTY, LOWEST, HIGHEST = 0.25, 1e5, 0.1, 1.8
"""Largest change of pressure (p_h) in a step, strength of the penalty on tension, and bounds of the pressure."""
CALM, NEAR, HOTTEST_STEP = 0.1, 5.0, 30.0
"""Change of pressure (p_h) below which heat acts; of temperature (K) near the solution; its bound in a step (K)."""
SLOW = 0.5
"""Share of each further step of the temperatures, once a step near the solution was larger than the one before."""
INSIDE = 1.2
"""Half widths within which temperatures must settle: eddies before the contact settle last and change nothing."""
THINNEST = 1e-5
"""Smallest film of an iteration (b^2/R)."""


class UnsolvedError(InputError):
    """A contact whose iteration does not settle."""


@dataclass(frozen=True)
class Place:
    """Conditions of a contact, in SI and C: reduced radius, load a width, speeds of both surfaces, temperature.

    ``inlet``: half widths before the centre where the film begins, infinite if flooded.
    """

    radius: float
    load: float
    speeds: tuple[float, float]
    celsius: float
    inlet: float = np.inf
    solid: Solid = field(default_factory=Solid)

    @property
    def speed(self) -> float:
        return 0.5 * sum(self.speeds)

    @property
    def slip(self) -> float:
        return self.speeds[1] - self.speeds[0]

    @property
    def pressure(self) -> float:
        """Largest pressure of Hertz (Pa)."""
        return float(np.sqrt(self.load * self.solid.reduced / (2 * np.pi * self.radius)))

    @property
    def half_width(self) -> float:
        return 2 * self.load / (np.pi * self.pressure)

    @property
    def unit(self) -> float:
        """Unit of the film (m): b^2/R."""
        return self.half_width**2 / self.radius

    def moes(self, viscosity: float, slope: float) -> tuple[float, float]:
        """Moes' numbers M and L."""
        modulus = self.solid.reduced
        speed = 2 * viscosity * self.speed / (modulus * self.radius)
        return self.load / (modulus * self.radius) / np.sqrt(speed), slope * modulus * speed**0.25


@dataclass(frozen=True)
class Solution:
    """A solved contact in SI and C: profiles along it, films, friction, and heat balance per width.

    ``flow_film``: film of oil at ambient density with the same flow. ``heat_made``: heat of shear; ``heat_taken``: heat
    into both walls.
    """

    place: np.ndarray
    pressure: np.ndarray
    film: np.ndarray
    stress: np.ndarray
    warmth: Warmth
    central_film: float
    least_film: float
    flow_film: float
    friction: float
    heat_made: float
    heat_taken: float


@dataclass(frozen=True)
class Guess:
    """Pressure (p_h) and rigid approach (b^2/R) of an iteration, with temperatures."""

    pressure: np.ndarray
    approach: float
    warmth: Warmth


@dataclass(frozen=True)
class Heated:
    """Temperatures after a march; film (m), heat of shear and heat into both walls (W/m2) by cell."""

    warmth: Warmth
    film: np.ndarray
    made: np.ndarray
    taken: np.ndarray


def film_of_moes(m: float, group: float) -> float:
    """Film of line contacts over R sqrt(2 U), in all regimes (Moes 1992; Nijenbanning, Venner and Moes 1994).

    >>> round(film_of_moes(0.3, 1.0), 2)
    10.36
    """
    rigid, elastic = 3 / m, 2.621 * m**-0.2
    stiff, soft = 1.287 * group ** (2 / 3), 1.311 * m**-0.125 * group**0.75
    s = (7 + 8 * np.exp(-2 * elastic / rigid)) / 5
    whole = (rigid ** (7 / 3) + elastic ** (7 / 3)) ** (3 * s / 7) + (stiff**-3.5 + soft**-3.5) ** (-2 * s / 7)
    return float(whole ** (1 / s))


@dataclass(frozen=True)
class Problem:
    """A contact on its cells; ``rises``: of both surfaces by fluxes; ``bulk``: temperatures of both bodies."""

    fluid: Fluid
    place: Place
    mesh: Mesh
    rises: tuple[np.ndarray, np.ndarray]
    bulk: tuple[float, float]

    @property
    def resting_density(self) -> float:
        return float(self.fluid.density(np.zeros(1), np.full(1, self.place.celsius))[0])

    def gap(self, guess: Guess) -> np.ndarray:
        """Film by cell (b^2/R)."""
        gap = guess.approach + 0.5 * self.mesh.middles**2 + self.mesh.kernel @ guess.pressure
        return np.asarray(np.maximum(gap, THINNEST))

    def slopes(self, guess: Guess) -> np.ndarray:
        """Gradient of the pressure at the ends of cells (Pa/m)."""
        p = np.concatenate([[0.0], guess.pressure, [0.0]])
        return np.diff(p) / self.mesh.gaps * (self.place.pressure / self.place.half_width)

    def step(self, guess: Guess) -> tuple[np.ndarray, float]:
        """Change of pressure and approach by Newton's method on the balances of mass and load."""
        place, mesh, count = self.place, self.mesh, len(guess.pressure)
        film, pressure, gradient = self.gap(guess), place.pressure * guess.pressure, self.slopes(guess)
        at, celsius = to_ends(np.concatenate([[0.0], guess.pressure, [0.0]]))[1:-1] * place.pressure, guess.warmth.film
        moved = flow(self.fluid, at, to_ends(film) * place.unit, gradient, _at_ends(guess.warmth), place.slip)
        thicker = self.fluid.log_viscosity(at + 1e5, to_ends(celsius)) - self.fluid.log_viscosity(at, to_ends(celsius))
        density = self.fluid.density(pressure, celsius) / self.resting_density
        denser = self.fluid.density(pressure + 1e6, celsius) / self.resting_density - density
        scale, dense = place.speed * place.unit, to_ends(density)
        push = dense * moved.mobility * gradient / scale
        # Couette flow: density times film, extrapolated from the two cells before each end.
        before, earlier, lean = mesh.upstream
        carried = density * film
        flux = carried[before] + lean * (carried[before] - carried[earlier])
        flux -= dense * moved.lost * to_ends(film) / place.speed + push
        by = density[:, None] * mesh.kernel
        by[np.arange(count), np.arange(count)] += denser * film * place.pressure / 1e6
        jacobian = (1 + lean)[:, None] * by[before] - lean[:, None] * by[earlier]
        by_approach = (1 + lean) * density[before] - lean * density[earlier]
        by_film = -push * moved.by_film / to_ends(film) - dense * moved.lost / place.speed
        jacobian += by_film[:, None] * to_ends(mesh.kernel)
        # Flow by pressure: viscosity at the mean of both sides, and the gradient.
        by_mean = -0.5 * push * moved.by_viscosity * thicker * place.pressure / 1e5
        by_rise = -dense * moved.mobility * (1 + moved.by_gradient) / scale
        by_rise = by_rise * place.pressure / place.half_width / mesh.gaps
        cells = np.arange(count)
        jacobian[cells + 1, cells] += (by_mean - by_rise)[1:]
        jacobian[cells, cells] += (by_mean + by_rise)[:-1]
        matrix = np.zeros((count + 1, count + 1))
        matrix[:count, :count] = np.diff(jacobian, axis=0)
        matrix[cells, cells] += np.where(guess.pressure < 0, PENALTY * mesh.widths, 0.0)
        matrix[:count, count] = np.diff(by_approach + by_film)
        matrix[count, :count] = mesh.widths
        balance = np.diff(flux) + np.minimum(guess.pressure, 0.0) * PENALTY * mesh.widths
        load = 0.5 * np.pi - mesh.widths @ guess.pressure
        change = np.linalg.solve(matrix, np.append(-balance, load))
        return change[:-1], float(change[-1])

    def heated(self, guess: Guess, near: bool = True) -> Heated:
        """Temperatures after a march at the pressures of a guess.

        Unless ``near`` the solution, warm layers do not draw further heat in the step, which would run away.
        """
        place, fluid = self.place, self.fluid
        film, pressure, full = self.gap(guess) * place.unit, place.pressure * guess.pressure, _filled(guess.pressure)
        rise = self.slopes(guess)
        gradient = 0.5 * (rise[1:] + rise[:-1])
        moved = flow(fluid, pressure, film, gradient, guess.warmth, place.slip)
        slid, rolled = full * moved.stress * place.slip, full * gradient**2 * moved.mobility
        share, part = moved.rates, heat_shares(fluid, pressure, film, gradient, moved)
        made = (slid + rolled)[:, None] * part
        thinning = -fluid.thinning(pressure[:, None], guess.warmth.layers)
        drawn = ((slid + rolled) * near)[:, None] * part * thinning
        weaker = (full * moved.softness * abs(place.slip))[:, None] * share * thinning
        slopes = -part[:, :, None] * (drawn + weaker)[:, None, :]
        each = np.arange(LAYERS)
        slopes[:, each, each] += drawn
        # Speed of the slip by the fluidities below a layer, and a parabola of the flow by pressure.
        speeds = place.speeds[0] + place.slip * (np.cumsum(share, axis=1) - 0.5 * share)
        speeds = speeds - 6 * (gradient * moved.mobility / film)[:, None] * (0.25 - SQUARES)
        expansion = fluid.expansion(guess.warmth.layers)
        squeezed = expansion * (guess.warmth.layers + KELVIN) * speeds * (full * gradient * film)[:, None]
        mass = (fluid.density(pressure, guess.warmth.film) * film)[:, None] * speeds / LAYERS
        carried = mass * fluid.specific_heat
        widths = self.mesh.widths * place.half_width
        sources = Sources(made + squeezed / LAYERS, slopes, fluid.conductivity / film, carried, widths)
        warmth, flux = warmed(guess.warmth, sources, self.rises, (place.celsius, *self.bulk))
        return Heated(warmth, film, made.sum(axis=1), full * flux.sum(axis=0))


def _at_ends(warmth: Warmth) -> Warmth:
    return Warmth(to_ends(warmth.layers), to_ends(warmth.first), to_ends(warmth.second))


def _filled(pressure: np.ndarray) -> np.ndarray:
    """Cells before cavitation, as numbers 1 and 0."""
    behind = np.arange(len(pressure)) > np.argmax(pressure)
    return np.where(behind & (pressure <= 0), 0.0, 1.0)


def solve(
    fluid: Fluid,
    place: Place,
    thermal: bool = True,
    cells: int = CELLS,
    bulk: tuple[float, float] | None = None,
) -> Solution:
    """Film, friction and temperatures of a line contact; an error if the iteration does not settle.

    ``bulk``: temperatures of both bodies (C), by default the oil's.
    """
    rest = np.full(1, place.celsius)
    at_rest, at_mega = (float(fluid.log_viscosity(np.full(1, p), rest)[0]) for p in (0.0, 1e6))
    numbers = place.moes(float(np.exp(at_rest)), (at_mega - at_rest) / 1e6)
    start = film_of_moes(*numbers) * place.load / (place.solid.reduced * numbers[0]) / place.unit
    flooded = 1 + max(1.5, np.sqrt(80 * start))
    cut = mesh(-min(place.inlet, flooded), start, cells)
    lengths = cut.ends * place.half_width, cut.middles * place.half_width
    first, second = (flash(*lengths, speed, place.solid) for speed in place.speeds)
    problem = Problem(fluid, place, cut, (first, second), bulk or (place.celsius,) * 2)
    hertz = np.sqrt(np.maximum(1 - cut.middles**2, 0.0))
    flat = float(np.mean((0.5 * cut.middles**2 + cut.kernel @ hertz)[np.abs(cut.middles) < 0.5]))
    guess = Guess(hertz, start - flat, resting(cells, place.celsius, problem.bulk))
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = _settled(problem, guess, thermal)
    if found is None:
        raise UnsolvedError("the contact has no solution", where="solved contact", value=place)
    return _solution(problem, found)


def _settled(problem: Problem, guess: Guess, thermal: bool) -> Guess | None:
    """Solution of the iteration; None if it does not settle."""
    near, inside, pace, last = False, np.abs(problem.mesh.middles) < INSIDE, 1.0, np.inf
    for _ in range(ROUNDS):
        change, rise = problem.step(guess)
        size = float(np.max(np.abs(change)))
        if not np.isfinite(size):
            return None
        share = min(1.0, WIDEST_STEP / max(size, 1e-12))
        pressure = np.clip(guess.pressure + share * change, -LOWEST, HIGHEST)
        guess = replace(guess, pressure=pressure, approach=guess.approach + share * rise)
        drift = np.inf if thermal else 0.0
        if thermal and size < CALM:
            warmth = problem.heated(guess, near).warmth
            drift = float(np.max(np.abs(warmth.layers - guess.warmth.layers)[inside]))
            pace = SLOW if near and drift > last else pace
            near, last = drift < NEAR, drift
            guess = replace(guess, warmth=guess.warmth.towards(warmth, pace, HOTTEST_STEP))
        if size < SETTLED and drift < SETTLED_KELVIN:
            return guess
    return None


def _solution(problem: Problem, guess: Guess) -> Solution:
    place, middles = problem.place, problem.mesh.middles
    found = problem.heated(guess)
    widths, film = problem.mesh.widths * place.half_width, found.film
    pressure, rise = place.pressure * guess.pressure, problem.slopes(guess)
    # The stress of the slip is far from linear in the gradient, which jumps from one side of a cell to the other.
    sides = [flow(problem.fluid, pressure, film, one, guess.warmth, place.slip) for one in (rise[1:], rise[:-1])]
    stress = 0.5 * (sides[0].middle + sides[1].middle) * _filled(guess.pressure)
    dense = problem.fluid.density(pressure, guess.warmth.film) / problem.resting_density
    central, flowing = (float(np.interp(0.0, middles, values)) for values in (film, film * dense))
    return Solution(
        place=middles * place.half_width,
        pressure=pressure,
        film=film,
        stress=stress,
        warmth=guess.warmth,
        central_film=central,
        least_film=float(np.min(film[middles > -1])),
        flow_film=flowing,
        friction=float(abs(stress @ widths) / place.load),
        heat_made=float(found.made @ widths),
        heat_taken=float(found.taken @ widths),
    )
