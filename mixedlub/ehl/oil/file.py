"""Oil file of the solver: viscosity, shear, density and thermal properties, which are fitted together."""

from __future__ import annotations

from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np
from pydantic import create_model, model_validator

from mixedlub.ehl.oil.declared import (
    DENSITY,
    GIGA,
    SHEAR,
    VISCOSITY,
    OilLaw,
    OilLaws,
    Pair,
    kelvin,
)
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.ehl.oil.oil import Oil, constant, expansion_of
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.build import lubricant
from mixedlub.rig.oil_doubts import under_pressure
from mixedlub.schema.findings import collected, report, warn_of
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.oil_file import SCHEMA, SUFFIX
from mixedlub.schema.section import Number, Section, check_keys_of, key
from mixedlub.schema.toml_file import named_file, parse, read_toml
from profiles.errors import as_path


class LawSection(Section):
    """A section with a choice of law: keys required by the law are mandatory, keys of other laws raise an error."""

    law: str
    LAWS: ClassVar[OilLaws]
    COMMON: ClassVar[tuple[str, ...]] = ()

    @property
    def chosen(self) -> OilLaw:
        """The chosen law."""
        return self.LAWS.all[self.law]

    @model_validator(mode="after")
    def _keys_of_the_law(self) -> LawSection:
        laws = self.LAWS.all.values()
        taken = {law.name: [given.key for given in law.keys if given.key not in self.COMMON] for law in laws}
        check_keys_of(self, "law", taken)
        if self.chosen.refuse is not None:
            self.chosen.refuse(self)
        return self


class DensitySection(LawSection):
    """Keys of several laws of density; ``COMMON`` keys are accepted with every law."""

    COMMON: ClassVar[tuple[str, ...]] = ("temperature_C",)
    density_kg_m3: Number = key("density at ambient pressure and temperature_C", example=850.0, gt=0.0)
    temperature_C: Number = key("temperature of that density", 60.0, gt=-ZERO_CELSIUS)
    expansion_per_K: Number = key("thermal expansion", 0.0, example=6.5e-4, ge=0.0, lt=0.01)


def _section(base: Any, laws: OilLaws, meaning: str, default: Any = ..., example: str | None = None) -> Any:
    """Section with the laws of a catalogue and the keys of all of them."""
    values = {law.name: law.title for law in laws.all.values()}
    fields: Any = {given.key: given.field for given in laws.keys if given.key not in base.model_fields}
    fields["law"] = (Literal[tuple(values)], key(meaning, default, example=example, values=values))
    made: Any = create_model("OfLaws", __base__=base, **fields)
    made.LAWS = laws
    return made


_PRESSURE = "how the viscosity rises with pressure and falls with temperature"
_Viscosity: Any = _section(LawSection, VISCOSITY, _PRESSURE, "roelands")
_Shear: Any = _section(LawSection, SHEAR, "how the oil yields to shear", example="ree_eyring")
_Density: Any = _section(DensitySection, DENSITY, "how the density rises with pressure", "dowson_higginson")


class Viscosity(_Viscosity):
    pass


class Shear(_Shear):
    pass


class Density(_Density):
    pass


class Thermal(Section):
    thermal_conductivity_W_mK: Number = key("thermal conductivity", example=0.14, gt=0.0)
    specific_heat_J_kgK: Number = key("specific heat", example=2000.0, gt=0.0)


class Range(Section):
    temperature_C: Pair = key("lowest and highest temperature of oil and bodies", example=[20.0, 150.0])
    largest_pressure_GPa: Number = key("largest Hertz pressure", example=2.0, gt=0.0)

    @model_validator(mode="after")
    def _upwards(self) -> Range:
        low, high = self.temperature_C
        if low >= high:
            raise ValueError(f"temperature_C: {high:g}: must be above {low:g}, the lowest temperature")
        return self


class OilFile(Section):
    """Oil file of the solver."""

    schema_: Literal["mixedlub-ehl-oil/1"] = key("format of the file", example="mixedlub-ehl-oil/1", alias="schema")
    name: str = key("name of the oil", example="gear oil")
    source: str = key("where the numbers are from", "", example="high-pressure rheometer, 60 degC")
    viscosity: Viscosity = key("viscosity against pressure and temperature")
    shear: Shear = key("stress against shear rate")
    density: Density = key("density against pressure and temperature")
    thermal: Thermal = key("heat in the film")
    range: Range | None = key("where the numbers hold; conditions beyond it are refused", None)

    @model_validator(mode="after")
    def _one_volume(self) -> OilFile:
        """Raise an error if a viscosity law reads the volume but the density law has none, or has another
        temperature."""
        name = self.viscosity.law
        if "volume" in self.viscosity.chosen.reads:
            if self.density.chosen.volume is None:
                having = " or ".join(f'"{law.name}"' for law in DENSITY.all.values() if law.volume is not None)
                raise ValueError(f'viscosity.law = "{name}" needs density.law = {having}, whose volume it reads')
            if self.viscosity.temperature_C != self.density.temperature_C:
                rule = f"one temperature with {name.capitalize()}'s law"
                raise ValueError(f"viscosity.temperature_C and density.temperature_C: {rule}")
        return self


def read_oil(path: str | PathLike[str]) -> Oil:
    """Oil of a file, or an oil of the package by name; missing properties are typical of its base stock.

    >>> read_oil("pao_vg100").name
    'PAO100, polyalphaolefin ISO VG 100'
    """
    with collected() as notes:
        found = oil_of(str(as_path(path, "ehl.read_oil")), Path(), "ehl.read_oil")
    warn_of(notes)
    return found


def oil_of(named: str, folder: Path, where: str) -> Oil:
    """Oil by name, or by its file relative to a folder; either an oil of the solver or of cases and studies."""
    if named.endswith(SUFFIX):
        path = named_file(folder, named, where)
        content = read_toml(path)
        if content.get("schema") != SCHEMA:
            return _judged(parse(OilFile, content, str(path)))
    return from_lubricant(lubricant(parse(Lubricant, {"oil": named}, where), folder=folder))


def _judged(file: OilFile) -> Oil:
    """Oil of a file; doubts about its viscosity under pressure, within its range, are reported."""
    found = build(file)
    limits: dict[str, Any] = {}
    if file.range is not None:
        limits = {"temperatures": found.temperatures, "largest_pressure": found.largest_pressure}
    law = f'viscosity.law = "{file.viscosity.law}"'
    for one in under_pressure(file.name, lambda p, t: found.log_viscosity(p, t)[0], law, "viscosity", **limits):
        report(one)
    return found


def build(file: OilFile) -> Oil:
    """An oil in SI."""
    limits: dict[str, Any] = {}
    if file.range is not None:
        low, high = file.range.temperature_C
        limits["temperatures"] = (kelvin(low), kelvin(high))
        limits["largest_pressure"] = file.range.largest_pressure_GPa * GIGA
    viscosity, density, shear = file.viscosity.chosen, file.density.chosen, file.shear.chosen
    numbers, stress = density.si(file.density), shear.si(file.shear)
    squeezed = partial(density.law, **numbers)
    of_density = {"density": file.density.density_kg_m3}
    if density.volume is not None:
        of_density["volume"] = partial(density.volume, **numbers)
    read = {name: value for name, value in of_density.items() if name in viscosity.reads}
    return Oil(
        name=file.name,
        log_viscosity=partial(viscosity.law, **viscosity.si(file.viscosity), **read),
        density_ratio=squeezed,
        shear=partial(shear.law, **stress),
        stress_scale=shear.stress_scale(stress),
        stress_limit=constant(np.inf) if shear.limit is None else partial(shear.limit, **stress),
        newtonian=shear.newtonian,
        density=file.density.density_kg_m3,
        expansion=expansion_of(squeezed),
        conductivity=file.thermal.thermal_conductivity_W_mK,
        heat_capacity=file.thermal.specific_heat_J_kgK,
        **limits,
    )
