"""The file of an oil: viscosity, shear, density and heat together, since they are fitted together."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import model_validator

from mixedlub.ehl.oil import density, shear, viscosity
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.ehl.oil.oil import Oil, constant, expansion_of
from mixedlub.laws.oil import ROELANDS_LOG, ZERO_CELSIUS
from mixedlub.rig.build import lubricant
from mixedlub.rig.oil_doubts import under_pressure
from mixedlub.schema.findings import collected, report, warn_of
from mixedlub.schema.oil_file import SCHEMA, SUFFIX
from mixedlub.schema.section import Number, Section, check_keys_of, key
from mixedlub.schema.system_file import Lubricant
from mixedlub.schema.toml_file import named_file, parse, read_toml
from profiles.errors import as_path

GIGA, MEGA, MILLI, MICRO = 1e9, 1e6, 1e-3, 1e-6
NEWTON_SCALE = 1e9
"""Scale of stress of a Newtonian oil (Pa): beyond any contact's, so that its law is straight."""
Pair = tuple[Number, Number]


class LawSection(Section):
    """A section that chooses a law: keys that the law needs are required, and keys of other laws are refused."""

    law: str

    @classmethod
    def takes(cls) -> Mapping[str, tuple[str, ...]]:
        """The keys of each law."""
        raise NotImplementedError

    @model_validator(mode="after")
    def _keys_of_the_law(self) -> LawSection:
        check_keys_of(self, "law", self.takes())
        return self


class Viscosity(LawSection):
    law: Literal["roelands", "barus", "two_slope", "modulus", "doolittle"] = key(
        "how the viscosity rises with pressure and falls with temperature",
        "roelands",
        values={
            "roelands": "Roelands in Houpert's form",
            "barus": "exponential; for films only, far too high in the contact above 0.3 GPa",
            "two_slope": "exponential with a smaller coefficient above a transition, after Allen",
            "modulus": "exp[p/(A + Bp)] of Bode, over ASTM D341",
            "doolittle": "free volume of Doolittle, with the volume of the density law tait",
        },
    )
    temperature_C: Number | None = key("temperature of the values below", None, example=60.0, gt=-ZERO_CELSIUS)
    viscosity_mPa_s: Number | None = key("viscosity at ambient pressure", None, example=14.89, gt=0.0)
    pressure_viscosity_per_GPa: Number | None = key("pressure-viscosity coefficient", None, example=14.81, gt=0.0)
    second_pressure_viscosity_per_GPa: Number | None = key(
        "pressure-viscosity coefficient far above the transition", None, alternative=True, gt=0.0
    )
    transition_pressure_MPa: Number | None = key("pressure of the transition", None, alternative=True, gt=0.0)
    temperature_viscosity_per_K: Number | None = key("relative fall of the viscosity", None, example=0.030, ge=0.0)
    known_temperature_C: Pair | None = key("two temperatures of known viscosity", None, alternative=True)
    kinematic_viscosity_mm2_s: Pair | None = key("kinematic viscosity at these", None, alternative=True)
    modulus_GPa: Number | None = key("a1 of A = a1 + a2 T, T in K", None, alternative=True)
    modulus_per_kelvin_MPa: Number | None = key("a2 of A = a1 + a2 T (MPa/K)", None, alternative=True)
    stiffening: Number | None = key("b1 of B = b1 + b2 T, T in K", None, alternative=True)
    stiffening_per_K: Number | None = key("b2 of B = b1 + b2 T", None, alternative=True)
    free_volume_factor: Number | None = key("Doolittle's factor B", None, alternative=True, gt=0.0)
    occupied_share: Number | None = key(
        "occupied volume over the volume, where the viscosity is that given", None, alternative=True, gt=0.0, lt=1.0
    )
    occupied_expansion_per_K: Number | None = key("thermal expansion of the occupied volume", None, alternative=True)

    @classmethod
    def takes(cls) -> Mapping[str, tuple[str, ...]]:
        at_one = ("temperature_C", "viscosity_mPa_s", "pressure_viscosity_per_GPa", "temperature_viscosity_per_K")
        walther = ("known_temperature_C", "kinematic_viscosity_mm2_s")
        free = ("temperature_C", "viscosity_mPa_s", "free_volume_factor", "occupied_share", "occupied_expansion_per_K")
        moduli = ("modulus_GPa", "modulus_per_kelvin_MPa", "stiffening", "stiffening_per_K")
        slopes = (*at_one, "second_pressure_viscosity_per_GPa", "transition_pressure_MPa")
        return {
            "roelands": at_one,
            "barus": at_one,
            "two_slope": slopes,
            "modulus": (*walther, *moduli),
            "doolittle": free,
        }

    @model_validator(mode="after")
    def _above_roelands_pole(self) -> Viscosity:
        least = np.exp(-ROELANDS_LOG) / MILLI
        if self.law == "roelands" and self.viscosity_mPa_s is not None and self.viscosity_mPa_s <= least:
            raise ValueError(f"viscosity_mPa_s: {self.viscosity_mPa_s:g}: must be above {least:.3g} for Roelands' law")
        return self


class Shear(LawSection):
    law: Literal["newton", "ree_eyring", "growing_eyring", "carreau", "limiting"] = key(
        "how the oil yields to shear",
        example="ree_eyring",
        values={
            "newton": "rate in proportion to stress; friction far too high above 0.5 GPa",
            "ree_eyring": "sinh of stress over the Eyring stress",
            "growing_eyring": "the same, with a stress that grows with pressure (Li and Kahraman)",
            "carreau": "power law above a shear modulus",
            "limiting": "limiting stress in proportion to pressure (Bair and Winer)",
        },
    )
    eyring_stress_MPa: Number | None = key(
        "Eyring stress, at ambient pressure where it grows", None, example=5.0, gt=0.0
    )
    eyring_growth: Number | None = key("its growth by pressure", None, alternative=True, ge=0.0)
    growth_start_GPa: Number | None = key("pressure where it begins to grow", None, alternative=True, ge=0.0)
    growth_end_GPa: Number | None = key("pressure where it has grown", None, alternative=True, gt=0.0)
    shear_modulus_MPa: Number | None = key("stress above which the power law acts", None, alternative=True, gt=0.0)
    power: Number | None = key("its exponent", None, alternative=True, gt=0.0, le=1.0)
    limiting_stress_MPa: Number | None = key("limiting stress at ambient pressure", None, alternative=True, gt=0.0)
    limiting_growth: Number | None = key("its growth by pressure", None, alternative=True, gt=0.0, lt=1.0)

    @classmethod
    def takes(cls) -> Mapping[str, tuple[str, ...]]:
        return {
            "newton": (),
            "ree_eyring": ("eyring_stress_MPa",),
            "growing_eyring": ("eyring_stress_MPa", "eyring_growth", "growth_start_GPa", "growth_end_GPa"),
            "carreau": ("shear_modulus_MPa", "power"),
            "limiting": ("limiting_stress_MPa", "limiting_growth"),
        }

    @model_validator(mode="after")
    def _grows_upwards(self) -> Shear:
        start, end = self.growth_start_GPa, self.growth_end_GPa
        if start is not None and end is not None and end <= start:
            raise ValueError(f"growth_end_GPa: {end:g}: must be above growth_start_GPa, {start:g}")
        return self


class Density(LawSection):
    law: Literal["dowson_higginson", "tait", "incompressible"] = key(
        "how the density rises with pressure",
        "dowson_higginson",
        values={
            "dowson_higginson": "Dowson and Higginson, with thermal expansion",
            "tait": "equation of state of Tait",
            "incompressible": "not at all, and no thermal expansion",
        },
    )
    density_kg_m3: Number = key("density at ambient pressure and temperature_C", example=850.0, gt=0.0)
    temperature_C: Number = key("temperature of that density", 60.0, gt=-ZERO_CELSIUS)
    expansion_per_K: Number = key("thermal expansion", 0.0, example=6.5e-4, ge=0.0, lt=0.01)
    bulk_modulus_GPa: Number | None = key("bulk modulus at temperature_C", None, alternative=True, gt=0.0)
    bulk_modulus_slope: Number | None = key("its slope in pressure", None, alternative=True, gt=0.0)
    bulk_modulus_fall_per_K: Number | None = key("its relative fall per kelvin", None, alternative=True, ge=0.0)

    @classmethod
    def takes(cls) -> Mapping[str, tuple[str, ...]]:
        of_state = ("bulk_modulus_GPa", "bulk_modulus_slope", "bulk_modulus_fall_per_K")
        return {
            "dowson_higginson": ("expansion_per_K",),
            "tait": ("expansion_per_K", *of_state),
            "incompressible": (),
        }


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
    """A file of one oil."""

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
        if self.viscosity.law == "doolittle":
            if self.density.law != "tait":
                raise ValueError('viscosity.law = "doolittle" needs density.law = "tait", whose volume it reads')
            if self.viscosity.temperature_C != self.density.temperature_C:
                raise ValueError(
                    "viscosity.temperature_C and density.temperature_C: one temperature with Doolittle's law"
                )
        return self


def read_oil(path: str | PathLike[str]) -> Oil:
    """The oil of a file, or one of the package by its name; what that lacks is typical of its base stock.

    >>> read_oil("pao_vg100").name
    'PAO100, polyalphaolefin ISO VG 100'
    """
    with collected() as notes:
        found = oil_of(str(as_path(path, "ehl.read_oil")), Path(), "ehl.read_oil")
    warn_of(notes)
    return found


def oil_of(named: str, folder: Path, where: str) -> Oil:
    """An oil by name, or by its file relative to a folder: one of the solver's laws, or one of cases and studies."""
    if named.endswith(SUFFIX):
        path = named_file(folder, named, where)
        content = read_toml(path)
        if content.get("schema") != SCHEMA:
            return _judged(parse(OilFile, content, str(path)))
    return from_lubricant(lubricant(parse(Lubricant, {"oil": named}, where), folder=folder))


def _judged(file: OilFile) -> Oil:
    """The oil of a file; doubts of its viscosity under pressure, within its range, are reported."""
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
        limits["temperatures"] = (low + ZERO_CELSIUS, high + ZERO_CELSIUS)
        limits["largest_pressure"] = file.range.largest_pressure_GPa * GIGA
    own = file.density
    law, scale, limit = _shear(file.shear)
    return Oil(
        name=file.name,
        log_viscosity=_viscosity(file.viscosity, own),
        density_ratio=_density(own),
        shear=law,
        stress_scale=scale,
        stress_limit=limit,
        newtonian=file.shear.law == "newton",
        density=own.density_kg_m3,
        expansion=expansion_of(_density(own)),
        conductivity=file.thermal.thermal_conductivity_W_mK,
        heat_capacity=file.thermal.specific_heat_J_kgK,
        **limits,
    )


def _density(section: Density) -> Any:
    """Density over that at ambient pressure and the known temperature."""
    known: dict[str, Any] = {
        "known_temperature": section.temperature_C + ZERO_CELSIUS,
        "expansion": section.expansion_per_K,
    }
    if section.law == "tait":
        return partial(density.tait, **known, **_bulk_modulus(section))
    return partial(density.dowson_higginson, **known) if section.law == "dowson_higginson" else density.incompressible


def _bulk_modulus(section: Density) -> dict[str, Any]:
    return {
        "bulk_modulus": _of(section.bulk_modulus_GPa) * GIGA,
        "bulk_modulus_slope": _of(section.bulk_modulus_slope),
        "bulk_modulus_fall": _of(section.bulk_modulus_fall_per_K),
    }


def _viscosity(section: Viscosity, of: Density) -> Any:
    if section.law == "doolittle":
        known = of.temperature_C + ZERO_CELSIUS
        return partial(
            viscosity.doolittle,
            known_temperature=known,
            viscosity=_of(section.viscosity_mPa_s) * MILLI,
            free_volume_factor=_of(section.free_volume_factor),
            occupied_share=_of(section.occupied_share),
            occupied_expansion=_of(section.occupied_expansion_per_K),
            volume=partial(
                density.tait_volume, known_temperature=known, expansion=of.expansion_per_K, **_bulk_modulus(of)
            ),
        )
    if section.law == "modulus":
        (t1, t2), (nu1, nu2) = section.known_temperature_C or (0, 0), section.kinematic_viscosity_mm2_s or (0, 0)
        return partial(
            viscosity.modulus,
            known_temperature=(t1 + ZERO_CELSIUS, t2 + ZERO_CELSIUS),
            known_viscosity=(nu1 * MICRO, nu2 * MICRO),
            density=of.density_kg_m3,
            modulus=(_of(section.modulus_GPa) * GIGA, _of(section.modulus_per_kelvin_MPa) * MEGA),
            stiffening=(_of(section.stiffening), _of(section.stiffening_per_K)),
        )
    at_one: dict[str, Any] = {
        "known_temperature": _of(section.temperature_C) + ZERO_CELSIUS,
        "viscosity": _of(section.viscosity_mPa_s) * MILLI,
        "pressure_viscosity": _of(section.pressure_viscosity_per_GPa) / GIGA,
        "temperature_viscosity": _of(section.temperature_viscosity_per_K),
    }
    if section.law == "two_slope":
        second, transition = section.second_pressure_viscosity_per_GPa, section.transition_pressure_MPa
        return partial(
            viscosity.two_slope,
            second_pressure_viscosity=_of(second) / GIGA,
            transition=_of(transition) * MEGA,
            **at_one,
        )
    return partial(viscosity.roelands if section.law == "roelands" else viscosity.barus, **at_one)


def _shear(section: Shear) -> tuple[Any, Any, Any]:
    """The law of shear, and by pressure the stress (Pa) at which it leaves Newton and the one that it never reaches."""
    never = constant(np.inf)
    own = _of(section.eyring_stress_MPa) * MEGA
    if section.law == "ree_eyring":
        return partial(shear.ree_eyring, eyring_stress=own), constant(own), never
    if section.law == "growing_eyring":
        grown: dict[str, Any] = {
            "eyring_stress": own,
            "eyring_growth": _of(section.eyring_growth),
            "growth_start": _of(section.growth_start_GPa) * GIGA,
            "growth_end": _of(section.growth_end_GPa) * GIGA,
        }
        return partial(shear.growing_eyring, **grown), lambda p: shear.eyring_stress_at(p, **grown)[0], never
    if section.law == "carreau":
        modulus = _of(section.shear_modulus_MPa) * MEGA
        return partial(shear.carreau, shear_modulus=modulus, power=_of(section.power)), constant(modulus), never
    if section.law == "limiting":
        start, growth = _of(section.limiting_stress_MPa) * MEGA, _of(section.limiting_growth)
        capped = partial(shear.limiting, limiting_stress=start, limiting_growth=growth)
        return capped, lambda p: start + growth * p, lambda p: shear.PASSED * (start + growth * p)
    return shear.newton, constant(NEWTON_SCALE), never


def _of(value: float | None) -> float:
    """A number that the checks of its section found where its law needs it; zero where no law does."""
    return 0.0 if value is None else value
