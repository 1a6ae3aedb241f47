"""Input file of the solver: an oil, the bodies, and either contacts or the path of contact of a gear pair."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from mixedlub.base_model.limits import contact_limits
from mixedlub.chain.ranges import Reached, findings
from mixedlub.chain.slots import ASPERITY_LOAD
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.mixed import Asperities, laws, solve_mixed, yielding
from mixedlub.ehl.oil.file import oil_of
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.solve import Way, build_contacts, check
from mixedlub.gear import mesh
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.laws.contact import reduced_modulus
from mixedlub.laws.load import gear_line_load
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding, collected
from mixedlub.schema.ranges import ranges
from mixedlub.schema.section import Flag, Number, Section, Whole, examples, key
from mixedlub.schema.surface_file import STEEL
from mixedlub.schema.system_file import Gears
from mixedlub.schema.toml_file import parse, read_toml
from profiles.errors import InputError

if TYPE_CHECKING:
    import xarray

EXAMPLE_KEYS = ("radius_mm", "line_load_N_mm", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C")
"""Keys of a contact in the template."""
LAWS, YIELDING = laws(), yielding()
"""Laws of asperities, and the laws that read a hardness."""
STEEL_MODULUS, STEEL_RATIO = (206.0, 206.0), (0.3, 0.3)
"""Young's moduli (GPa) and Poisson's ratios of two steel bodies."""
Positive = Annotated[Number, Field(gt=0.0)]
Pair = tuple[Positive, Positive]
Poisson = Annotated[Number, Field(gt=-1.0, le=0.5)]


def _listed(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else [value]


Each = Annotated[tuple[Number, ...], Field(min_length=1), BeforeValidator(_listed)]
"""A number for all contacts, or a list with a number per contact."""
EachPositive = Annotated[tuple[Positive, ...], Field(min_length=1), BeforeValidator(_listed)]


class Bodies(Section):
    youngs_modulus_GPa: Annotated[Pair | None, ranges()["contact.youngs_modulus_GPa"]] = key(
        "Young's moduli; left out: steel, or those of [gears]", None, example=[206.0, 206.0]
    )
    poisson_ratio: tuple[Poisson, Poisson] | None = key(
        "Poisson's ratios; left out: steel, or those of [gears]", None, example=[0.3, 0.3]
    )
    thermal_conductivity_W_mK: Pair = key("thermal conductivities", (STEEL["conductivity"],) * 2)
    density_kg_m3: Pair = key("densities", (STEEL["density"],) * 2)
    specific_heat_J_kgK: Pair = key("specific heats", (STEEL["heat_capacity"],) * 2)


class ContactList(Section):
    """Contacts: each key a number for all contacts, or a list with a number per contact."""

    radius_mm: EachPositive = key("reduced radius of the two bodies", example=8.69)
    line_load_N_mm: EachPositive | None = key("load per width; or hertz_pressure_GPa", None, example=[100.0, 215.0])
    hertz_pressure_GPa: EachPositive | None = key("largest Hertz pressure", None, example=0.9, alternative=True)
    entrainment_speed_m_s: EachPositive = key("mean speed of the two surfaces", example=2.24)
    slide_roll_ratio: Each = key("speed of the second surface over the first, by the mean", (0.0,), example=0.34)
    oil_temperature_C: Each = key("temperature of the oil where it enters", example=60.0)
    body_temperature_C: tuple[Number, Number] | None = key(
        "bulk temperatures; left out: that of the oil", None, example=[60.0, 60.0]
    )
    inlet_mm: EachPositive | None = key(
        "where the film starts, before the centre; left out: flooded", None, example=0.3
    )

    @model_validator(mode="after")
    def _one_load(self) -> ContactList:
        if (self.line_load_N_mm is None) == (self.hertz_pressure_GPa is None):
            raise ValueError("needs either line_load_N_mm or hertz_pressure_GPa")
        lengths = {name: len(value) for name, value in self if name != "body_temperature_C" and value is not None}
        most = max(lengths.values())
        for name, length in lengths.items():
            if length not in (1, most):
                raise ValueError(f"{name} has {length} numbers, and another key {most}: give one, or one for each")
        return self


class GearPath(Section):
    """Points along the path of contact of `[gears]`, at one torque and speed."""

    torque_Nm: Positive = key("torque on the pinion", example=100.0)
    speed_rpm: Positive = key("speed of the pinion", example=1500.0)
    oil_temperature_C: Number = key("temperature of the oil where it enters", example=60.0)
    body_temperature_C: tuple[Number, Number] | None = key(
        "temperatures of the teeth; left out: that of the oil", None, example=[60.0, 60.0]
    )
    points: Whole = key("places along the path, about", 24, ge=1, le=1000)


class AsperitySection(Section):
    """Combined asperities of both surfaces, which share the load with the film."""

    m0_um2: Positive = key("variance of the heights of both surfaces", example=0.137)
    m2: Positive = key("variance of their slopes", example=0.0031)
    m4_per_um2: Positive = key("variance of their curvatures", example=0.0021)
    # The laws are those of a table, which a type checker does not evaluate.
    law: Literal[LAWS] = key(  # type: ignore[valid-type]
        "law of the asperities", LAWS[0], values={name: ASPERITY_LOAD.choices[name].title for name in LAWS}
    )
    hardness_GPa: Annotated[Positive | None, ranges()["options.hardness_GPa"]] = key(
        "indentation hardness of the softer body, for asperities that yield", None, example=6.0, alternative=True
    )
    boundary_friction: Positive = key("friction coefficient of the asperities", 0.1)

    @model_validator(mode="after")
    def _hardness_where_read(self) -> AsperitySection:
        reads = self.law in YIELDING
        if reads and self.hardness_GPa is None:
            raise ValueError(f'law = "{self.law}" needs hardness_GPa')
        if not reads and self.hardness_GPa is not None:
            raise ValueError(f'hardness_GPa acts only with asperities that yield; with law = "{self.law}" leave it out')
        return self

    def asperities(self) -> Asperities:
        """The asperities in SI."""
        hardness = np.nan if self.hardness_GPa is None else self.hardness_GPa * 1e9
        moments = self.m0_um2 * 1e-12, self.m2, self.m4_per_um2 * 1e12
        return Asperities(*moments, self.law, self.boundary_friction, hardness)


class EhlFile(Section):
    """Input file of the solver."""

    schema_: Literal["mixedlub-ehl/1"] = key("format of the file", example="mixedlub-ehl/1", alias="schema")
    title: str = key("title of the figures", "Line contacts", example="Twin discs")
    oil: str = key("file of the oil, relative to this one, or an oil by name, as in [lubricant]", example="oil.toml")
    thermal: Flag = key("solve for temperatures; false: all is at the oil's temperature", True)
    bodies: Bodies = key("the two bodies; left out: steel", Bodies())
    contacts: ContactList | None = key("contacts; or [gears] and [path]", None)
    gears: Gears | None = key("a gear pair, as in a study", None)
    path: GearPath | None = key("where and how the gear pair runs", None)
    asperities: AsperitySection | None = key("asperities that share the load; left out: smooth surfaces", None)

    @model_validator(mode="after")
    def _contacts_or_path(self) -> EhlFile:
        given = [name for name in ("contacts", "gears", "path") if getattr(self, name) is not None]
        if given not in (["contacts"], ["gears", "path"]):
            raise ValueError("needs either [contacts], or [gears] and [path]; not both")
        if self.gears is not None:
            for name in ("youngs_modulus_GPa", "poisson_ratio"):
                if getattr(self.bodies, name) is not None:
                    raise ValueError(f"bodies.{name}: a gear pair has its own; give it in [gears]")
        return self


@dataclass(frozen=True)
class Problem:
    """Contacts of a file with their oil; ``position``: position on a path of contact (m), else NaN.

    ``notes``: contacts outside the range of elastic bodies, and assumptions on the oil.
    """

    file: EhlFile
    oil: Oil
    contacts: Contacts
    position: np.ndarray
    notes: tuple[Finding, ...] = ()

    @property
    def reached(self) -> Reached:
        """Limits of elastic bodies, with the values of the contacts."""
        limits = contact_limits({"reduced_modulus": self.contacts.modulus})
        return [(limit, self.contacts.pressure) for limit in limits if limit.quantity == "hertz_pressure"]


def read_problem(path: Path) -> Problem:
    """Read and check the contacts of a file."""
    file = parse(EhlFile, read_toml(path), str(path))
    with collected() as notes:
        oil = oil_of(file.oil, path.parent, f"{path}: oil")
    flat, modulus, position = _listed_contacts(file) if file.contacts is not None else _along_path(file, path)
    bodies = file.bodies
    solids = {
        "conductivity": bodies.thermal_conductivity_W_mK,
        "density": bodies.density_kg_m3,
        "heat_capacity": bodies.specific_heat_J_kgK,
    }
    contacts = build_contacts(flat, modulus, solids)
    try:
        check(oil, contacts, thermal=file.thermal)
    except InputError as error:
        raise InputError(error.rule, where=f"{path}: {error.where}", value=error.value) from None
    found = Problem(file, oil, contacts, position)
    return replace(found, notes=(*findings(found.reached, contacts.pressure.shape, "contacts"), *notes))


def solved_problem(problem: Problem, way: Way) -> xarray.Dataset:
    """Solutions of the contacts, including asperities if the file has them."""
    thermal, own = problem.file.thermal, problem.file.asperities
    if own is None:
        return way.solved(problem.oil, problem.contacts, thermal=thermal)
    return solve_mixed(problem.oil, problem.contacts, own.asperities(), thermal=thermal, way=way)


def _listed_contacts(file: EhlFile) -> tuple[dict[str, np.ndarray], float, np.ndarray]:
    """Arrays in SI, E' (Pa) and NaN positions of listed contacts."""
    given, bodies = file.contacts, file.bodies
    assert given is not None
    young = bodies.youngs_modulus_GPa or STEEL_MODULUS
    modulus = reduced_modulus((young[0] * 1e9, young[1] * 1e9), bodies.poisson_ratio or STEEL_RATIO)
    radius = np.array(given.radius_mm) * 1e-3
    if given.line_load_N_mm is not None:
        load = np.array(given.line_load_N_mm) * 1e3
    else:
        load = 2.0 * np.pi * radius * (np.array(given.hertz_pressure_GPa) * 1e9) ** 2 / modulus
    speed = np.array(given.entrainment_speed_m_s)
    temperature = np.array(given.oil_temperature_C) + ZERO_CELSIUS
    inlet = np.nan if given.inlet_mm is None else np.array(given.inlet_mm) * 1e-3
    sliding = speed * np.array(given.slide_roll_ratio)
    flat = _flat(radius, load, speed, sliding, temperature, inlet, _walls(temperature, given.body_temperature_C))
    return flat, modulus, np.full(len(flat["radius"]), np.nan)


def _along_path(file: EhlFile, path: Path) -> tuple[dict[str, np.ndarray], float, np.ndarray]:
    """Arrays in SI, E' (Pa) and positions (m) along the path of contact; the pinion is the first body."""
    assert file.gears is not None
    assert file.path is not None
    pair, run = gear_pair(file.gears), file.path
    points = mesh(pair, sharing(file.gears.load_sharing, path.parent), points=run.points, slices=1)
    force = run.torque_Nm / pair.base_radius[0]
    load = gear_line_load(points.load_share(run.torque_Nm), np.array(force), points.contact_width)
    turning = run.speed_rpm * np.pi / 30.0
    speed, sliding = turning * points.entrainment_per_speed, -turning * points.sliding_per_speed
    temperature = np.array([run.oil_temperature_C + ZERO_CELSIUS])
    walls = _walls(temperature, run.body_temperature_C)
    flat = _flat(points.radius, load, speed, sliding, temperature, np.nan, walls)
    return flat, reduced_modulus(pair.youngs_modulus, pair.poisson_ratio), points.position


def _walls(oil: np.ndarray, given: tuple[float, float] | None) -> tuple[Any, Any]:
    """Bulk temperatures of both bodies (K)."""
    return (oil, oil) if given is None else (given[0] + ZERO_CELSIUS, given[1] + ZERO_CELSIUS)


def _flat(*values: Any) -> dict[str, np.ndarray]:
    """Arrays of equal length by name; the last entry is the pair of bulk temperatures."""
    names = ("radius", "line_load", "speed", "sliding_speed", "oil_temperature", "inlet")
    walls = ("first_bulk_temperature", "second_bulk_temperature")
    arrays = np.broadcast_arrays(*np.atleast_1d(*values[:-1], *values[-1]))
    return {name: np.array(array, dtype=float) for name, array in zip((*names, *walls), arrays, strict=True)}


def examples_of_contacts() -> dict[str, Any]:
    """Keys of `[contacts]` with consistent values."""
    found = examples(ContactList)
    return {name: found[name] for name in found if name in EXAMPLE_KEYS}
