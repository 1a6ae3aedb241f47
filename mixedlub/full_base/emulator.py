"""Emulator of full solutions: film over the film law and stress over the shear law, with their errors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.ehl.run import Rows
from mixedlub.full_base.box import CONDITIONS, FACTORS, Box
from mixedlub.full_base.gaussian_process import Process, fit
from mixedlub.full_base.solutions import Matter, Varied, is_solved
from mixedlub.laws import contact, film, heating, load, oil, shear
from mixedlub.running.atomic import whole
from profiles.errors import InputError

LEAST_FLATTENED = 2.0
"""Judgement. Moes' load parameter M below which a contact is outside the range of an emulator, as of film laws."""
EVERY = 5
"""Every 5th solution is left out to measure the error; all are in the emulator."""
MOST_UNSOLVED = 0.05
"""Judgement. Share of the contacts of a range without a solution above which the range is refused."""
LEAST_SOLUTIONS = 120
"""Judgement. Solutions for 55 terms of the mean, with twice as many for the rest."""
FILM_GOAL, FRICTION_GOAL = 0.008, 0.02
"""Judgement. Errors of film and friction that 95 % of the left-out solutions should keep."""
OF_OIL = ("viscosity", "pressure_viscosity", "temperature_viscosity", "entering_stress")
"""Properties of the oil that change with temperature or by calibration."""
INPUTS = (
    "radius",
    "line_load",
    "hertz_pressure",
    "hertz_half_width",
    "entrainment_speed",
    "sliding_speed",
    "viscosity",
    "pressure_viscosity",
    "temperature_viscosity",
    "oil_conductivity",
    "entering_stress",
    "reduced_modulus",
)
"""Quantities of the chain that the emulator reads."""


@dataclass(frozen=True)
class Errors:
    """Errors of the logarithm at the solutions left out, and of the solver by its grids: rms, and bound of 95 %."""

    count: int
    unsolved: int
    film_rms: float
    film_95: float
    friction_rms: float
    friction_95: float
    solver_film: float
    solver_friction: float

    @property
    def film(self) -> float:
        """Standard deviation of the film, with the error of the solver."""
        return float(np.hypot(self.film_rms, self.solver_film))

    @property
    def friction(self) -> float:
        """Standard deviation of the friction, with the error of the solver."""
        return float(np.hypot(self.friction_rms, self.solver_friction))

    @property
    def meets_goal(self) -> bool:
        """Whether 95 % of the left-out solutions are within the goals."""
        return self.film_95 <= FILM_GOAL and self.friction_95 <= FRICTION_GOAL

    def __str__(self) -> str:
        film_ = f"film {100 * self.film_rms:.2g} % rms and {100 * self.film_95:.2g} % in 95 of 100"
        friction = f"friction {100 * self.friction_rms:.2g} % and {100 * self.friction_95:.2g} %"
        return f"{self.count} solutions, errors at those left out of the fit: {film_}, {friction}"


@dataclass(frozen=True, eq=False)
class Emulator:
    """Emulator over a range of contacts.

    ``low``, ``high``: ends of the features of its solutions; ``of_oil``: least and largest value of each property of
    the oil there.
    """

    box: Box
    low: np.ndarray
    high: np.ndarray
    of_oil: np.ndarray
    film: Process
    stress: Process
    errors: Errors

    def ratios(self, process: Process, places: np.ndarray) -> np.ndarray:
        """Ratio of solution and law at the places of contacts.

        Rows of equal contacts, as of several pairs of surfaces, are evaluated once.
        """
        return np.exp(_once(process, places))

    def slopes(self, process: Process, places: np.ndarray) -> np.ndarray:
        """Derivatives of the logarithm of the ratio by the places of contacts."""
        return _once(process.slopes, places)

    def places(self, state: Mapping[str, Any]) -> np.ndarray:
        """Features of contacts, on a last axis, from -1 to 1 over those of the solutions.

        Contacts beyond the range are moved to its ends.
        """
        return np.asarray(2.0 * (features(**self._inside(state)) - self.low) / (self.high - self.low) - 1.0)

    def _inside(self, state: Mapping[str, Any]) -> dict[str, Any]:
        """Contacts moved into the range, with the load of their pressure."""
        given = {name: state[name] for name in INPUTS}
        radius, pressure, speed = (
            np.clip(given[name], *self.box[name]) for name in ("radius", "hertz_pressure", "entrainment_speed")
        )
        ratio = load.slide_roll_ratio(given["sliding_speed"], given["entrainment_speed"])
        modulus = given["reduced_modulus"]
        oil_ = {name: np.clip(given[name], *ends) for name, ends in zip(OF_OIL, self.of_oil, strict=True)}
        return {
            **given,
            **oil_,
            "radius": radius,
            "hertz_pressure": pressure,
            "entrainment_speed": speed,
            "line_load": 2.0 * np.pi * radius * pressure**2 / modulus,
            "hertz_half_width": 4.0 * radius * pressure / modulus,
            "sliding_speed": np.clip(ratio, *self.box["slide_roll_ratio"]) * speed,
        }

    @property
    def valid(self) -> dict[str, tuple[float, float]]:
        """Range of the contacts; sliding has no lower end."""
        found = {name: self.box[name] for name in CONDITIONS}
        return {
            **found,
            "slide_roll_ratio": (0.0, found["slide_roll_ratio"][1]),
            "moes_load": (LEAST_FLATTENED, np.inf),
        }

    def save(self, path: Path) -> None:
        """Write to a file."""
        arrays: dict[str, Any] = {f"box_{name}": np.array(ends) for name, ends in self.box.items()}
        arrays |= {"low": self.low, "high": self.high, "of_oil": self.of_oil}
        arrays |= {f"error_{one.name}": np.array(getattr(self.errors, one.name)) for one in fields(Errors)}
        for name, process in (("film", self.film), ("stress", self.stress)):
            arrays |= {f"{name}_{one.name}": getattr(process, one.name) for one in fields(Process)}
        with whole(path) as aside, aside.open("wb") as file:
            np.savez(file, **arrays)


def _once(function: Callable[[np.ndarray], np.ndarray], places: np.ndarray) -> np.ndarray:
    """Values of a function of places on the last axis; equal rows of contacts are evaluated once."""
    if places.ndim == 3 and len(places) > 1:
        rows = np.ascontiguousarray(places.reshape(len(places), -1))
        _, first, back = np.unique(rows.view(f"V{rows.dtype.itemsize * rows.shape[1]}"), True, True)
        return np.asarray(_each(function, places[first])[back.ravel()])
    return _each(function, places)


def _each(function: Callable[[np.ndarray], np.ndarray], places: np.ndarray) -> np.ndarray:
    found = function(places.reshape(-1, places.shape[-1]))
    return found.reshape((*places.shape[:-1], *found.shape[1:]))


def read(path: Path) -> Emulator:
    """Emulator of a file."""
    with np.load(path) as file:
        known = {name: file[name] for name in file.files}
    box = {n: tuple(known[f"box_{n}"].tolist()) for n in (*CONDITIONS, *FACTORS) if f"box_{n}" in known}
    errors = Errors(**{one.name: known[f"error_{one.name}"].item() for one in fields(Errors)})
    film_, stress = (
        Process(**{one.name: known[f"{name}_{one.name}"] for one in fields(Process)}) for name in ("film", "stress")
    )
    return Emulator(box, known["low"], known["high"], known["of_oil"], film_, stress, errors)


def features(
    radius: np.ndarray,
    line_load: np.ndarray,
    hertz_pressure: np.ndarray,
    hertz_half_width: np.ndarray,
    entrainment_speed: np.ndarray,
    sliding_speed: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    oil_conductivity: np.ndarray,
    entering_stress: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    """Logarithms in which the ratios are smooth, on a last axis.

    Moes' load parameter, Hertz pressure, heat of the inlet, viscosity, slide-to-roll ratio; rise of the viscosity under
    pressure, Newtonian over Eyring stress, and softening of the film by heat of film and walls, all by
    the laws of the formulas at the film of the film law. Bodies of one material have the flash temperature of steel but
    for a factor.
    """
    thickness = film.dowson_toyoda(
        *(radius, entrainment_speed, line_load, viscosity, pressure_viscosity, reduced_modulus)
    )
    squeezed = oil.roelands_viscosity(viscosity, pressure_viscosity, hertz_pressure)
    stress = shear.ree_eyring(squeezed, sliding_speed, thickness, entering_stress)
    softening = heating.contact_softening(temperature_viscosity, viscosity, squeezed)
    slip = np.minimum(sliding_speed, 2.0 * entrainment_speed)
    flash = heating.flash_per_friction(hertz_pressure, hertz_half_width, entrainment_speed, slip, *STEEL)
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = [
            np.log(value)
            for value in (
                film.moes_load(radius, entrainment_speed, line_load, viscosity, reduced_modulus),
                hertz_pressure,
                temperature_viscosity * viscosity * entrainment_speed**2 / oil_conductivity,
                viscosity,
                load.slide_roll_ratio(sliding_speed, entrainment_speed),
                np.log(squeezed / viscosity),
                squeezed * sliding_speed / (thickness * entering_stress),
                softening * stress * sliding_speed * thickness / oil_conductivity,
                softening * flash * stress / hertz_pressure,
            )
        ]
    return np.stack(np.broadcast_arrays(*logs), axis=-1)


STEEL: tuple[Any, ...] = (46.0, 7800.0, 470.0)
"""Definition. Thermal properties of steel (SI)."""


def inputs_of(matter: Matter, contacts: Varied) -> dict[str, Any]:
    """Quantities of the chain at contacts of an oil with factors."""
    known = matter.oil.inputs(contacts.oil_temperature)
    viscosity, coefficient, stress = contacts.factors.T
    pressure = contact.line_hertz_pressure(contacts.line_load, contacts.radius, contacts.modulus)
    return {
        "radius": contacts.radius,
        "line_load": contacts.line_load,
        "hertz_pressure": pressure,
        "hertz_half_width": contacts.half_width,
        "entrainment_speed": contacts.speed,
        "sliding_speed": np.abs(contacts.sliding),
        "viscosity": known["viscosity"] * viscosity,
        "pressure_viscosity": known["pressure_viscosity"] * coefficient,
        "temperature_viscosity": known["temperature_viscosity"],
        "oil_conductivity": known["oil_conductivity"],
        "entering_stress": known["eyring_stress"] * stress,
        "reduced_modulus": contacts.modulus,
    }


def laws(state: Mapping[str, Any]) -> tuple[np.ndarray, Callable[[np.ndarray], np.ndarray]]:
    """Film by the film law, and the friction of the film law's shear at a film."""
    names = ("radius", "entrainment_speed", "line_load", "viscosity", "pressure_viscosity", "reduced_modulus")
    squeezed = oil.roelands_viscosity(state["viscosity"], state["pressure_viscosity"], state["hertz_pressure"])

    def friction(thickness: np.ndarray) -> np.ndarray:
        stress = shear.ree_eyring(squeezed, state["sliding_speed"], thickness, state["entering_stress"])
        return np.asarray(stress / state["hertz_pressure"])

    return film.dowson_toyoda(*(state[name] for name in names)), friction


def trained(matter: Matter, box: Box, contacts: Varied, found: Rows) -> Emulator:
    """Emulator of solutions; too large a share without a solution raises an error with the share."""
    good = is_solved(found)
    share = float(np.mean(~good))
    name = from_lubricant(matter.oil).name
    if share > MOST_UNSOLVED:
        rule = f"{100 * share:.3g} % of the contacts of its range have no full solution, more than 5 %"
        raise InputError(f"{rule}; take the formulas as base, or leave out the heaviest and fastest", where=name)
    if np.count_nonzero(good) < LEAST_SOLUTIONS:
        rule = f"needs {LEAST_SOLUTIONS} contacts of its range that are flattened, M above 1.5"
        raise InputError(f"full_solution {rule}", where=name, value=int(np.count_nonzero(good)))
    state = inputs_of(matter, contacts.take(np.flatnonzero(good)))
    thickness, friction = found["central_film"][good], np.abs(found["friction_coefficient"][good])
    law_film, law_friction = laws(state)
    logs = {"film": np.log(thickness / law_film), "stress": np.log(friction / law_friction(thickness))}
    places = features(**state)
    low, high = places.min(axis=0), places.max(axis=0)
    high = np.where(high > low, high, low + 1.0)
    scaled = 2.0 * (places - low) / (high - low) - 1.0
    out = np.arange(len(scaled)) % EVERY == EVERY - 1
    left: dict[str, np.ndarray] = {}
    for quantity, values in logs.items():
        part = fit(scaled[~out], values[~out])
        left[quantity] = part(scaled[out]) - values[out]
    whole_ = {quantity: fit(scaled, values) for quantity, values in logs.items()}
    moved = np.exp(left["film"]) * thickness[out]
    by_film = np.log(_taken(state, out)(moved) / _taken(state, out)(thickness[out]))
    both = left["stress"] + by_film
    errors = Errors(
        int(np.count_nonzero(good)),
        int(np.count_nonzero(~good)),
        *(_rms(left["film"]), _bound(left["film"]), _rms(both), _bound(both)),
        float(np.median(found["central_film_error"][good])),
        float(np.median(found["friction_coefficient_error"][good])),
    )
    ends = np.array([(np.min(state[name]), np.max(state[name])) for name in OF_OIL])
    return Emulator(box, low, high, ends, whole_["film"], whole_["stress"], errors)


def _taken(state: Mapping[str, Any], rows: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """Friction of the laws at some of the contacts."""
    return laws({name: np.broadcast_to(value, rows.shape)[rows] for name, value in state.items()})[1]


def _rms(error: np.ndarray) -> float:
    return float(np.sqrt(np.mean(error**2)))


def _bound(error: np.ndarray) -> float:
    return float(np.quantile(np.abs(error), 0.95))
