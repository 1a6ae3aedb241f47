"""Line contacts solved together, as a data set in SI with a status and an error for each contact."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.ehl.levels import NODES, Solved, solve_levels
from mixedlub.ehl.line_contacts import Contacts, Solids, numbers, of_both
from mixedlub.ehl.measures import CHECKS, PROFILES, QUANTITIES, measures
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.run import parts_folder, run_parts
from mixedlub.laws.contact import reduced_modulus
from mixedlub.schema.surface_file import STEEL
from profiles.errors import InputError, refuse_other

if TYPE_CHECKING:
    import xarray

CONVERGED, DIVERGED = "converged", "no solution"
"""Values of the status."""
LARGEST_STRESS_IMBALANCE = 1e-6
"""Change of the shear stress in its last iteration above which a contact has no solution."""
FILM_SHARE = 0.5
"""Error of a film over the difference of the two finest grids: a third by Richardson, for second order, times 1.5."""
Each = float | Sequence[float] | np.ndarray
Pair = tuple[Each, Each]


def solve(oil: Oil, *, thermal: bool = True, **given: Any) -> xarray.Dataset:
    """Film, friction and temperatures of smooth line contacts in SI, by the full equations.

    Arguments as for `contacts`; without ``thermal``, friction neglects all heat. The result has a row per contact, NaN
    with the status ``no solution`` without convergence; ``NAME_error``: relative error of NAME (of the rise for
    temperatures), estimated from grids of 121 and 241 nodes.

    >>> import mixedlub as ml
    >>> oil = ml.ehl.example_oil()
    >>> where = {"radius": 8.69e-3, "line_load": 215e3, "oil_temperature": 333.15}
    >>> found = ml.ehl.solve(oil, **where, speed=2.24, sliding_speed=0.75)
    >>> round(float(found.central_film[0]) * 1e6, 2), round(float(found.friction_coefficient[0]), 4)
    (0.19, 0.0197)
    """
    refuse_other(oil, Oil, "ml.ehl.read_oil(...)", "ehl.solve: oil")
    every = contacts(**given)
    check(oil, every, thermal=thermal)
    return solved(oil, every, thermal=thermal)


def contacts(
    *,
    radius: Each,
    line_load: Each,
    speed: Each,
    oil_temperature: Each,
    sliding_speed: Each = 0.0,
    bulk_temperature: Pair | None = None,
    inlet: Each = np.nan,
    youngs_modulus: tuple[float, float] = (206e9, 206e9),
    poisson_ratio: tuple[float, float] = (0.3, 0.3),
    conductivity: tuple[float, float] = (STEEL["conductivity"],) * 2,
    density: tuple[float, float] = (STEEL["density"],) * 2,
    heat_capacity: tuple[float, float] = (STEEL["heat_capacity"],) * 2,
) -> Contacts:
    """Line contacts from numbers or arrays in SI that broadcast.

    Reduced radius (m), load per width (N/m), mean speed and speed of the second surface relative to the first (m/s),
    temperature of the oil and of both bodies (K; default: oil temperature), position of the inlet meniscus (m before
    the centre; NaN: flooded); for both bodies: moduli (Pa), thermal conductivity (W/(m K)), density (kg/m^3) and
    specific heat (J/(kg K)), default: steel.
    """
    given = {"radius": radius, "line_load": line_load, "speed": speed, "oil_temperature": oil_temperature}
    given |= {"sliding_speed": sliding_speed, "inlet": inlet}
    place = "ehl.contacts: "
    bulk = (np.nan, np.nan) if bulk_temperature is None else bulk_temperature
    first_bulk, second_bulk = of_both(f"{place}bulk_temperature", bulk)
    given |= {"first_bulk_temperature": first_bulk, "second_bulk_temperature": second_bulk}
    arrays = np.broadcast_arrays(*(numbers(place + name, value) for name, value in given.items()))
    flat = {name: value.ravel() for name, value in zip(given, arrays, strict=True)}
    for wall in ("first", "second"):
        own = flat[f"{wall}_bulk_temperature"]
        flat[f"{wall}_bulk_temperature"] = np.where(np.isnan(own), flat["oil_temperature"], own)
    solids = {"conductivity": conductivity, "density": density, "heat_capacity": heat_capacity}
    for name, pair in {"youngs_modulus": youngs_modulus, "poisson_ratio": poisson_ratio, **solids}.items():
        of_both(place + name, pair)
    return build_contacts(flat, reduced_modulus(youngs_modulus, poisson_ratio), solids)


def build_contacts(flat: dict[str, np.ndarray], modulus: float, solids: dict[str, tuple[float, float]]) -> Contacts:
    """Contacts from arrays of equal length."""
    one = np.ones_like(flat["radius"])
    walls = [
        Solids(
            flat["speed"] + side * 0.5 * flat["sliding_speed"],
            flat[f"{wall}_bulk_temperature"],
            *(one * solids[name][number] for name in ("conductivity", "density", "heat_capacity")),
        )
        for number, (wall, side) in enumerate((("first", -1.0), ("second", 1.0)))
    ]
    found = Contacts(
        flat["radius"], one * modulus, flat["line_load"], flat["oil_temperature"], flat["inlet"], walls[0], walls[1]
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        return replace(found, inlet=-flat["inlet"] / found.half_width)


def check(oil: Oil, contacts: Contacts, *, thermal: bool) -> None:
    """Raise an error for contacts without a solution or outside the range of the oil's file, by the first wrong
    number."""
    if not len(contacts.radius):
        raise InputError("at least one is needed", where="contacts")
    with np.errstate(invalid="ignore"):
        pressure = contacts.pressure
    rules: list[tuple[str, np.ndarray, np.ndarray, str]] = [
        ("radius", contacts.radius, contacts.radius > 0.0, "must be above zero"),
        ("line_load", contacts.line_load, contacts.line_load > 0.0, "must be above zero"),
        ("speed", contacts.speed, contacts.speed > 0.0, "must be above zero: without it no film forms"),
        (
            "inlet",
            -contacts.inlet,
            ~(contacts.inlet > -1.0),
            "(half widths) must be above 1: the oil starts inside the contact",
        ),
    ]
    low, high = oil.temperatures
    rule = f"must be from {low:g} to {high:g} K, the range of the oil's file"
    rules += [("oil_temperature", contacts.oil_temperature, _within(contacts.oil_temperature, low, high), rule)]
    for name, wall in (("first", contacts.first), ("second", contacts.second)):
        own = f"{name} surface: bulk_temperature"
        rules += [(own, wall.temperature, _within(wall.temperature, low, high), rule)] if thermal else []
        moving = "must be above zero: heat enters moving surfaces only; slide less, or solve isothermally"
        rules += [(f"{name} surface: speed", wall.speed, wall.speed > 0.0, moving)] if thermal else []
    most = f"Pa: must be up to {oil.largest_pressure / 1e9:g} GPa, the range of the oil's file"
    rules += [("Hertz pressure", pressure, pressure <= oil.largest_pressure, most)]
    for name, value, fine, text in rules:
        if not np.all(fine & ~np.isinf(value)):
            wrong = int(np.argmin(fine & ~np.isinf(value)))
            raise InputError(text, where=f"contact {wrong + 1}: {name}", value=float(f"{value[wrong]:.6g}"))


def _within(value: np.ndarray, low: float, high: float) -> np.ndarray:
    return (value >= low) & (value <= high)


def solved(
    oil: Oil,
    contacts: Contacts,
    *,
    thermal: bool,
    keep: Path | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> xarray.Dataset:
    """Solutions of checked contacts; ``keep``, ``scheduler`` and ``progress`` as in `run_parts`."""
    import xarray

    solver = partial(solution_rows, oil, thermal=thermal)
    columns: dict[str, Any] = run_parts(solver, contacts, keep=keep, scheduler=scheduler, progress=progress)
    every = {**QUANTITIES, **CHECKS, **PROFILES}
    data = xarray.Dataset()
    for name, values in columns.items():
        dims = ("contact", "node") if values.ndim == 2 else ("contact",)
        known = every.get(name)
        attributes = {"units": "1"} if known is None else {"units": known.unit, "long_name": known.meaning}
        data[name] = (dims, values, {} if name == "status" else attributes)
    return data


@dataclass(frozen=True)
class Way:
    """Mode of computation: folder for parts, Dask scheduler, and function for the progress."""

    folder: Path | None = None
    scheduler: str | None = None
    progress: Callable[[int, int], None] = lambda done, of: None

    def solved(self, oil: Oil, found: Contacts, *, thermal: bool) -> xarray.Dataset:
        """Solutions of contacts."""
        keep = None if self.folder is None else parts_folder(self.folder, oil, found, thermal=thermal)
        return solved(oil, found, thermal=thermal, keep=keep, scheduler=self.scheduler, progress=self.progress)


def solution_rows(oil: Oil, contacts: Contacts, *, thermal: bool) -> dict[str, np.ndarray]:
    """Results of a batch."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = solve_levels(oil, contacts, thermal=thermal)
        kept = contacts.take(found.index)
        fine = measures(oil, kept, found.fine, thermal=thermal)
        coarse = measures(oil, kept, found.coarse, thermal=thermal)
    sheared = fine["stress_imbalance"] < LARGEST_STRESS_IMBALANCE
    found.stopped_at[found.index[~sheared]] = NODES[-1]
    rows = {name: _filled(found, values) for name, values in fine.items() if name in {**QUANTITIES, **CHECKS}}
    for name in QUANTITIES:
        rows[f"{name}_error"] = _filled(found, _error(name, fine[name], coarse[name], kept.oil_temperature))
    rows["status"] = np.where(found.stopped_at == 0, CONVERGED, DIVERGED)
    rows["stopped_at_nodes"] = found.stopped_at
    return rows | {name: _filled(found, fine[name]) for name in PROFILES}


def _filled(found: Solved, values: np.ndarray) -> np.ndarray:
    """Values of the converged contacts; NaN for the others."""
    filled = np.full((len(found.stopped_at), *values.shape[1:]), np.nan)
    filled[found.index] = values
    filled[found.stopped_at > 0] = np.nan
    return filled


def _error(name: str, fine: np.ndarray, coarse: np.ndarray, oil_temperature: np.ndarray) -> np.ndarray:
    """Relative error on the finer of two grids, from the difference."""
    size = np.abs(fine - oil_temperature if name.endswith("_temperature") else fine)
    share = FILM_SHARE if name.endswith("_film") else 1.0
    return share * np.abs(fine - coarse) / np.where(size > 0.0, size, np.nan)
