"""Solutions over a range: contacts of one oil and one pair of bodies, with factors on properties of the oil."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass, replace
from functools import cache, partial
from pathlib import Path

import numpy as np

from mixedlub import ehl
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.run import BATCH, Rows, of_oil, run_parts
from mixedlub.ehl.solve import CONVERGED, build_contacts, solution_rows
from mixedlub.full_base.box import CONDITIONS, FACTORS, Box, spread
from mixedlub.rig import lubricant
from mixedlub.rig.lubricant import Lubricant

LEAST_LOAD = 1.5
"""Judgement. Moes' load parameter M of the least flattened contact that is solved: below, the film is wider than the
contact of Hertz."""
CANDIDATES = 8
"""Cost limit. Contacts drawn per contact that is solved."""
KEPT = ("central_film", "friction_coefficient", "central_film_error", "friction_coefficient_error", "status")


@dataclass(frozen=True)
class Bodies:
    """Reduced modulus (Pa) and thermal properties of both bodies, in SI."""

    modulus: float
    conductivity: float
    density: float
    heat_capacity: float


@dataclass(frozen=True)
class Matter:
    """Oil and bodies of a contact, and whether heat acts."""

    oil: Lubricant
    bodies: Bodies
    thermal: bool = True

    @property
    def digest(self) -> str:
        """Hash of every number and of the code that affects a solution."""
        found = hashlib.sha256(f"{solver_fingerprint()}{self.thermal}".encode())
        numbers = [np.ravel(np.asarray(v, dtype=float)) for v in of_oil(from_lubricant(self.oil))]
        for value in (*np.concatenate(numbers), *astuple(self.bodies)):
            found.update(f"{value:.10g},".encode())
        return found.hexdigest()[:24]


@cache
def solver_fingerprint() -> str:
    """Hash of the code on which a solution depends: solver, oil, and choice of the contacts."""
    solver = sorted(Path(str(ehl.__file__)).parent.rglob("*.py"))
    return hash_of((*solver, Path(str(lubricant.__file__)), Path(__file__), Path(__file__).with_name("box.py")))


def hash_of(paths: Iterable[Path]) -> str:
    """Hash of the content of files and of the version of NumPy."""
    digest = hashlib.sha256(np.__version__.encode())
    for path in paths:
        digest.update(path.read_bytes())
    return digest.hexdigest()


@dataclass(frozen=True)
class Varied(Contacts):
    """Contacts with factors on the viscosity, pressure-viscosity coefficient and Eyring stress of their oil."""

    factors: np.ndarray


def drawn(matter: Matter, box: Box, count: int, seed: int = 1) -> Varied:
    """Contacts spread evenly over a range, those flattened enough; contacts solved together share their factors."""
    from scipy.stats import qmc

    conditions = {name: box[name] for name in CONDITIONS}
    places = qmc.Sobol(len(conditions), rng=seed).random(1 << int(np.ceil(np.log2(CANDIDATES * count))))
    own = {name: ends for name, ends in box.items() if name in FACTORS}
    factors = np.ones((count, len(FACTORS)))
    if own:
        groups = -(-count // BATCH)
        each = spread(own, qmc.Sobol(len(own), rng=seed + 1).random(1 << int(np.ceil(np.log2(groups))))[:groups])
        for name, values in each.items():
            factors[:, FACTORS.index(name)] = np.repeat(values, BATCH)[:count]
    found = at(matter, spread(conditions, places), np.ones((len(places), len(FACTORS))))
    load, _ = found.moes(*from_lubricant(matter.oil).at_ambient(found.oil_temperature))
    chosen = found.take(np.flatnonzero(load >= LEAST_LOAD)[:count])
    return replace(chosen, factors=factors[: len(chosen.radius)])


def at(matter: Matter, values: dict[str, np.ndarray], factors: np.ndarray) -> Varied:
    """Contacts at conditions, with the walls at the temperature of the oil."""
    bodies, speed = matter.bodies, values["entrainment_speed"]
    radius, temperature = values["radius"], values["oil_temperature"]
    flat = {
        "radius": radius,
        "line_load": 2.0 * np.pi * radius * values["hertz_pressure"] ** 2 / bodies.modulus,
        "speed": speed,
        "sliding_speed": values["slide_roll_ratio"] * speed,
        "oil_temperature": temperature,
        "inlet": np.full_like(radius, np.nan),
        "first_bulk_temperature": temperature,
        "second_bulk_temperature": temperature,
    }
    solids = {name: (getattr(bodies, name),) * 2 for name in ("conductivity", "density", "heat_capacity")}
    made = build_contacts(flat, bodies.modulus, solids)
    return Varied(**{name: getattr(made, name) for name in Contacts.__dataclass_fields__}, factors=factors)


def solved(
    matter: Matter,
    contacts: Varied,
    *,
    keep: Path | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> Rows:
    """Films and friction of contacts with their errors; ``keep``, ``scheduler``, ``progress`` as in `run_parts`."""
    return run_parts(partial(_rows, matter), contacts, keep=keep, scheduler=scheduler, progress=progress)


def _rows(matter: Matter, contacts: Contacts) -> Rows:
    """Results of contacts that share their factors."""
    assert isinstance(contacts, Varied)
    same = np.all(contacts.factors == contacts.factors[0])
    parts = [np.arange(len(contacts.radius))] if same else [np.array([i]) for i in range(len(contacts.radius))]
    found = [
        solution_rows(scaled(matter.oil, contacts.factors[part[0]]), contacts.take(part), thermal=matter.thermal)
        for part in parts
    ]
    return {name: np.concatenate([one[name] for one in found]) for name in KEPT}


def scaled(of: Lubricant, factors: np.ndarray) -> Oil:
    """Oil of the solver with factors on its properties; the scaled density takes the viscosity along.

    >>> known = (313.15, 373.15), (23e-6, 4.9e-6), (15e-9, 11e-9)
    >>> oil = Lubricant("ester", *known, 995.0, 8e-4, 5e6, 0.14, 2e3)
    >>> cold = np.array(313.15)
    >>> both = scaled(oil, np.array([1.2, 1.0, 1.0])), scaled(oil, np.ones(3))
    >>> round(float(both[0].at_ambient(cold)[0] / both[1].at_ambient(cold)[0]), 12)
    1.2
    """
    viscosity, coefficient, stress = map(float, factors)
    first, second = of.pressure_viscosity
    moved = replace(
        of,
        density_15=of.density_15 * viscosity,
        pressure_viscosity=(first * coefficient, second * coefficient),
        eyring_stress=of.eyring_stress * stress,
    )
    return replace(from_lubricant(moved), density=of.density_15)


def is_solved(found: Rows) -> np.ndarray:
    """Mask of the contacts with a solution that slides."""
    return np.asarray((found["status"] == CONVERGED) & (np.abs(found["friction_coefficient"]) > 0.0))
