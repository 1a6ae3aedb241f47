"""Oils by name: one file per oil with viscosity, shear and heat, and the source of each number."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, model_validator

from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.schema.traction_part import Traction
from profiles.errors import InputError, nearest

SUFFIX, SCHEMA = ".toml", "mixedlub-oil/1"
KNOWN = "known_pressure_viscosity"
"""Key of a pressure-viscosity coefficient known at one temperature."""
Status = Literal["stated", "derived", "typical"]
STATUSES: Mapping[str, str] = {
    "stated": "printed by the source",
    "derived": "computed from what the source prints",
    "typical": "not of this oil: typical of its class or base stock",
}
Base = Literal["mineral", "pao", "ester", "pag"]
STOCKS: Mapping[str, str] = {
    "mineral": "mineral oil",
    "pao": "polyalphaolefin",
    "ester": "synthetic ester",
    "pag": "polyalkylene glycol",
}


Carried = Literal["roelands", "gold"]
WAYS: Mapping[str, str] = {
    "roelands": "at the same exponent Z of Roelands: alpha = Z (ln eta + 9.67)/p_r",
    "gold": "as the power of the kinematic viscosity that Gold gives for the base stock",
}


class KnownCoefficient(Section):
    coefficient_per_GPa: Number = key("pressure-viscosity coefficient", example=14.2)
    temperature_C: Number = key("temperature at which it is known", example=54.0)
    carried: Carried = key("its way to other temperatures", "roelands", values=WAYS)


def one_or_two_numbers(value: Any) -> Any:
    """Number as given or two numbers as a tuple; raise an error otherwise."""
    entries = value if isinstance(value, (list, tuple)) else [value]
    if len(entries) not in (1, 2) or any(isinstance(x, bool) or not isinstance(x, (int, float)) for x in entries):
        raise ValueError("is a number, or a list of two")
    return tuple(value) if isinstance(value, (list, tuple)) else value


class Property(Section):
    """Number of an oil, or two at its two temperatures."""

    value: Annotated[Any, AfterValidator(one_or_two_numbers)] = key(
        "the number, or two at temperature_C", example=[97.9, 8.61]
    )
    status: Status = key("where it comes from", example="stated", values=STATUSES)
    source: str = key("its source", example="data sheet")
    temperature_C: Number | None = key(
        "temperature of a pressure-viscosity coefficient known at one alone",
        None,
        example=54.0,
        alternative=True,
    )
    carried: Carried | None = key("way of that coefficient to other temperatures", None, values=WAYS, alternative=True)

    @model_validator(mode="after")
    def _known_at_one(self) -> Property:
        if (self.temperature_C is None) != (self.carried is None):
            raise ValueError("a coefficient known at one temperature has both temperature_C and carried")
        if self.carried is not None and isinstance(self.value, tuple):
            raise ValueError("value: one number where temperature_C says at which temperature it is known")
        return self

    def entry(self, name: str) -> tuple[str, Any]:
        """Key and value in a section ``[lubricant]`` for this property."""
        if self.carried is None:
            return name, self.value
        known = {"coefficient_per_GPa": self.value, "temperature_C": self.temperature_C, "carried": self.carried}
        return KNOWN, known


class FurtherLaw(Section):
    """Data of a law beyond this package, kept with the oil but not used."""

    equation: str = key("the law, in words or symbols with units", example="eta = K exp(C/(D + T))")
    values: dict[str, float] = key("its numbers", example={"K": 1e-4})
    status: Status = key("where they come from", example="stated", values=STATUSES)
    source: str = key("their source", example="data sheet")


class OilFile(Section):
    """File of an oil."""

    schema_: Literal["mixedlub-oil/1"] = key("format of the file", example="mixedlub-oil/1", alias="schema")
    name: str = key("name of the oil, for the report", example="gear oil of the rig")
    about: str = key("what is known of it, free text", "")
    base: Base = key("base stock, whose typical values fill what the file leaves out", example="mineral", values=STOCKS)
    properties: Annotated[dict[str, Property], Field(min_length=1)] = key(
        "one table a key of [lubricant], with its value, status and source"
    )
    traction: Traction | None = key(
        "Eyring stress and limiting stress over pressure and temperature, in place of eyring_stress_MPa", None
    )
    further: dict[str, FurtherLaw] = key("laws of the oil beyond those of this package", {})

    @property
    def keys(self) -> dict[str, Any]:
        """Keys of a section ``[lubricant]`` for this oil."""
        found = {"name": self.name, "base": self.base} | dict(p.entry(name) for name, p in self.properties.items())
        if self.traction is not None:
            found |= {STRESS: self.traction.eyring_stress_MPa.value, TRACTION: self.traction}
        return found


def oil_names() -> tuple[str, ...]:
    """Oils of the package.

    >>> oil_names()[:2]
    ('75w90', 'agma_7ep')
    """
    found = files("mixedlub").joinpath("rig").joinpath("oils").iterdir()
    return tuple(sorted(path.name.removesuffix(SUFFIX) for path in found if path.name.endswith(SUFFIX)))


def _text(name: str) -> str:
    return files("mixedlub").joinpath("rig", "oils", name + SUFFIX).read_text(encoding="utf-8")


@cache
def shipped_oil(name: str) -> OilFile:
    """Oil of the package; raise an error with the nearest known name for an unknown name.

    >>> shipped_oil("n100").base
    'mineral'
    """
    if name not in oil_names():
        bases = f"base stocks are {', '.join(STOCKS)}, by the key base"
        own = f"{bases}; an oil of your own is a file whose name ends in {SUFFIX}"
        raise InputError(f"no such oil; {nearest(name, oil_names())}; {own}", where="oil", value=name)
    return parse(OilFile, tomllib.loads(_text(name)), f"oil {name}")


def oil_of(named: str, folder: Path) -> OilFile:
    """Oil by name, or from a file relative to a folder."""
    if not named.endswith(SUFFIX):
        return shipped_oil(named)
    return parse(OilFile, read_toml(folder / named), named)


PAIRS = ("kinematic_viscosity_mm2_s", "pressure_viscosity_per_GPa")
"""Keys with a value at each of the two temperatures of the section."""
STRESS, TRACTION = "eyring_stress_MPa", "traction"
"""Keys of a constant Eyring stress and of the law that replaces it."""
MODULUS = ("pressure_modulus_MPa", "pressure_modulus_slope")
"""Keys of the modulus equation, at the same temperatures; another pressure-viscosity coefficient contradicts them."""


def with_oil(given: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Section ``[lubricant]`` completed by its oil; keys stated in the section take precedence.

    >>> with_oil({"oil": "n100", "eyring_stress_MPa": 6.0}, Path())["kinematic_viscosity_mm2_s"]
    (97.9, 8.61)
    """
    own = oil_of(str(given["oil"]), folder).keys
    moved = "temperature_C" in given and tuple(given["temperature_C"]) != tuple(own.get("temperature_C", ()))
    lacking = [name for name in PAIRS if moved and name in own and name not in given]
    if lacking:
        at = list(own["temperature_C"])
        rule = f"the oil has its values at {at} °C: leave it out, or give {' and '.join(lacking)} too"
        raise InputError(rule, where="temperature_C", value=given["temperature_C"])
    if PAIRS[1] in given or KNOWN in given:
        own = {name: value for name, value in own.items() if name not in (*MODULUS, PAIRS[1], KNOWN)}
    if STRESS in given or TRACTION in given:
        own = {name: value for name, value in own.items() if name not in (STRESS, TRACTION)}
    return {**own, **given}


def overridden(section: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Values of the oil that its section states differently or does not use, except the name."""
    own = oil_of(str(section["oil"]), folder).keys
    if TRACTION in own:
        own[TRACTION] = own[TRACTION].model_dump()
    other = {name: value for name, value in own.items() if name != "name" and section[name] != value}
    return {name: "law" if name == TRACTION else value for name, value in other.items()}
