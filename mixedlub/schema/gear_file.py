"""Gear pairs by name: one file per pair, with the source of each number."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from mixedlub.schema.oil_file import one_or_two_numbers
from mixedlub.schema.section import Section, key
from mixedlub.schema.toml_file import parse
from profiles.errors import InputError, nearest

SUFFIX = ".toml"
Status = Literal["stated", "derived", "assumed"]
STATUSES: Mapping[str, str] = {
    "stated": "printed by the source",
    "derived": "computed from what the source prints",
    "assumed": "not printed: as such gears have it",
}


class Property(Section):
    """Number of a gear pair, or two for pinion and gear."""

    value: Annotated[Any, AfterValidator(one_or_two_numbers)] = key("the number, or two", example=[16, 24])
    status: Status = key("where it comes from", "stated", values=STATUSES)
    note: str = key("how it was derived, or why it was assumed", "")


class GearFile(Section):
    """File of a gear pair."""

    schema_: Literal["mixedlub-gears/1"] = key("format of the file", example="mixedlub-gears/1", alias="schema")
    name: str = key("name of the gears, for the report", example="FZG C")
    source: str = key("where the stated numbers are printed", example="ISO 14635-3")
    about: str = key("what is known of them beyond the numbers, free text", "")
    properties: Annotated[dict[str, Property], Field(min_length=1)] = key("one table a key of [gears]")

    @property
    def keys(self) -> dict[str, Any]:
        """Keys of a section ``[gears]`` for this pair."""
        return {name: p.value for name, p in self.properties.items()}


def gear_names() -> tuple[str, ...]:
    """Gear pairs of the package.

    >>> "fzg_c" in gear_names()
    True
    """
    found = files("mixedlub").joinpath("rig").joinpath("gears").iterdir()
    return tuple(sorted(path.name.removesuffix(SUFFIX) for path in found if path.name.endswith(SUFFIX)))


@cache
def shipped_gears(name: str) -> GearFile:
    """Gear pair of the package; raise an error with the nearest known name for an unknown name.

    >>> shipped_gears("fzg_c").keys["teeth"]
    (16, 24)
    """
    if name not in gear_names():
        raise InputError(f"no such gears; {nearest(name, gear_names())}", where="preset", value=name)
    text = files("mixedlub").joinpath("rig", "gears", name + SUFFIX).read_text(encoding="utf-8")
    return parse(GearFile, tomllib.loads(text), f"gears {name}")


def with_preset(given: Mapping[str, Any]) -> dict[str, Any]:
    """Section ``[gears]`` completed by its preset; keys stated in the section take precedence.

    >>> with_preset({"preset": "fzg_c", "face_width_mm": 20.0})["face_width_mm"]
    20.0
    """
    return {**shipped_gears(str(given["preset"])).keys, **given}


def stated_otherwise(section: Mapping[str, Any]) -> dict[str, Any]:
    """Values of the preset that the section states differently."""
    own = shipped_gears(str(section["preset"])).keys
    return {name: value for name, value in own.items() if section[name] != value}
