"""Format of a planetary stage in a file of `mixedlub efficiency`."""

from __future__ import annotations

from math import prod
from typing import Annotated

from pydantic import Field, model_validator

from mixedlub.efficiency.part_tables import Flanks, NotNegative, Part, Positive, RollingBearing, law_key
from mixedlub.efficiency.train import CARRIER
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.section import Number, NumberOrName, Section, Whole, key
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears
from mixedlub.study.schema import Options
from profiles.errors import nearest

MEMBER = "sun, ring or whatever the meshes name, or carrier"
MOST_COMBINATIONS = 1000
"""Cost limit. Largest number of combinations of finishes: some 20 ms each."""
EVEN = 1e-3
"""Judgement. Tolerance on the mean of the planets' loads, for thirds written with three digits."""


class PlanetBearing(RollingBearing):
    """Rolling bearing between planet and carrier."""

    radial_share: NotNegative = key("share of the planet's radial load that it carries", 1.0)


class MemberBearing(RollingBearing):
    """Rolling bearing of a sun, a ring or the carrier; planets of equal load leave it without mesh force."""

    shaft: str = key(f"the member that it carries: {MEMBER}", example=CARRIER)


class MemberSeal(Part):
    law: str = law_key("seal", "iso_tr_14179_2")
    shaft: str = key(f"the member that it seals: {MEMBER}", example="sun")
    series: str | None = key("type of bearing whose seals they are; only skf_bearing_seals", None)
    diameter_mm: Positive = key("diameter of the shaft at the lip", example=35.0)


class Drag(Part):
    law: str = law_key("other", "own_torque")
    shaft: str = key(f"the member that it brakes: {MEMBER}", example=CARRIER)


class PlanetMesh(Section):
    """Mesh of two wheels, on every planet."""

    wheels: tuple[str, str] = key(
        "bodies of the two wheels, as gears.teeth lists them; wheels of one name turn together",
        example=["sun", "planet"],
    )
    boundary_friction: Number = key("friction coefficient of touching asperities", 0.1)
    gears: Gears = key("two entries, the wheels; a ring is the second and has a number of teeth below zero")
    surfaces: Flanks = key("surfaces of both flanks")
    options: Options = key("laws of the mesh, as in a study", Options())
    effects: dict[str, dict[str, NumberOrName]] = key(
        "EFFECT = { PARAMETER = VALUE }: physics of the mesh beyond the base model, as in a study",
        {},
        example={"rolling_resistance": {"law": "Biboulet and Houpert"}},
    )


class Planet(Section):
    """One body on the carrier, with the wheels that meshes name after it."""

    mass_kg: NotNegative = key("mass of one planet, which turns with the carrier", example=0.4, unit="kg")
    bearings: dict[str, PlanetBearing] = key("one table a bearing of every such planet, by a name of your own", {})


class PlanetaryStage(Section):
    """Planetary train with one fixed member."""

    input: str = key(f"member that drives: {MEMBER}", "sun")
    output: str = key("member that is driven", CARRIER)
    fixed: str = key("member that stands still", "ring")
    planet_count: Whole = key("number of equally spaced planets, or of groups of planets", example=3, ge=1, le=100)
    planet_loads: Annotated[tuple[Positive, ...], Field(max_length=100)] = key(
        "load of each planet over the mean, so that they add up to their number; left out: even",
        (),
        example=[1.1, 0.95, 0.95],
    )
    least_clearance_mm: NotNegative = key("smallest distance of the tips of neighbouring planets", 0.0)
    oil_temperature_C: Number = key("temperature of its oil", example=80.0)
    lubricant: Lubricant | None = key("what is left out is typical of the base stock, and a note says so", None)
    meshes: dict[str, PlanetMesh] = key("one table a mesh", min_length=1)
    planets: dict[str, Planet] = key("one table a body that the carrier takes along", min_length=1)
    finishes: dict[str, SurfaceSection] = key("one table a surface that pairings names", {})
    pairings: dict[str, tuple[str, ...]] = key(
        "WHEEL = [FINISH, ...]: finishes to try in all combinations; other wheels keep the surfaces of their meshes",
        {},
        example={"sun": ["ground", "polished"], "planet": ["ground"]},
    )
    bearings: dict[str, MemberBearing] = key("one table a bearing of a sun, ring or the carrier", {})
    seals: dict[str, MemberSeal] = key("one table a seal", {})
    others: dict[str, Drag] = key("drag of the carrier in oil and air, pumps and others with a torque of your own", {})

    @property
    def members(self) -> tuple[str, ...]:
        """Bodies about the main axis."""
        wheels = dict.fromkeys(wheel for mesh in self.meshes.values() for wheel in mesh.wheels)
        return (*(wheel for wheel in wheels if wheel not in self.planets), CARRIER)

    @model_validator(mode="after")
    def _named(self) -> PlanetaryStage:
        if CARRIER in self.planets or any(CARRIER in mesh.wheels for mesh in self.meshes.values()):
            raise ValueError(f"{CARRIER} has no teeth and is no planet")
        for role in ("input", "output", "fixed"):
            if (name := getattr(self, role)) not in self.members:
                raise ValueError(f"{role} = {name!r} is no member; {nearest(name, self.members)}")
        if len({self.input, self.output, self.fixed}) < 3:
            raise ValueError("input, output and fixed are three members")
        for name, mesh in self.meshes.items():
            if not set(mesh.wheels) & set(self.planets):
                raise ValueError(f"meshes.{name}: one of the wheels {list(mesh.wheels)} must have a table planets.NAME")
            if mesh.wheels[0] == mesh.wheels[1]:
                raise ValueError(f"meshes.{name}: a mesh needs two bodies, not {mesh.wheels[0]!r} twice")
        for name in self.planets:
            if not any(name in mesh.wheels for mesh in self.meshes.values()):
                raise ValueError(f"planets.{name} is in no mesh")
        for table in ("bearings", "seals", "others"):
            for name, part in getattr(self, table).items():
                if part.shaft not in self.members:
                    raise ValueError(f"{table}.{name}: shaft = {part.shaft!r}; {nearest(part.shaft, self.members)}")
                if part.shaft == self.fixed:
                    raise ValueError(f"{table}.{name}: shaft = {part.shaft!r} stands still and loses nothing")
        return self

    @model_validator(mode="after")
    def _paired(self) -> PlanetaryStage:
        wheels = {wheel for mesh in self.meshes.values() for wheel in mesh.wheels}
        for wheel, names in self.pairings.items():
            if wheel not in wheels:
                raise ValueError(f"pairings.{wheel}: no such wheel; {nearest(wheel, wheels)}")
            for name in names:
                if name not in self.finishes:
                    raise ValueError(
                        f"pairings.{wheel} = {name!r} has no table finishes.NAME; {nearest(name, self.finishes)}"
                    )
        if (count := prod(len(names) for names in self.pairings.values())) > MOST_COMBINATIONS:
            raise ValueError(f"pairings have at most {MOST_COMBINATIONS} combinations, not {count}")
        return self

    @model_validator(mode="after")
    def _shared(self) -> PlanetaryStage:
        if self.planet_loads and len(self.planet_loads) != self.planet_count:
            raise ValueError(f"planet_loads needs {self.planet_count} entries, not {len(self.planet_loads)}")
        mean = sum(self.planet_loads) / self.planet_count
        if self.planet_loads and abs(mean - 1.0) > EVEN:
            raise ValueError(f"planet_loads are over their mean, so that they have the mean 1, not {mean:.4g}")
        return self
