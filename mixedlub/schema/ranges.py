"""What a number may be: the one table of possible and usual ranges, and the unit that a number beyond was meant in."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import islice
from typing import Any

import numpy as np
from pydantic import BaseModel

from mixedlub.schema.units import SLIPS, read_as, unit_of

NO_SHARES = ("poisson_ratio", "sequence")
"""Numbers without a unit that nobody gives in percent."""


@dataclass(frozen=True)
class Range:
    """Lowest and highest possible value, lowest and highest usual one; ends are within."""

    possible: tuple[float, float]
    usual: tuple[float, float]


@cache
def ranges() -> Mapping[str, Range]:
    """The ranges by key of `system.toml`, without the name of a surface.

    >>> ranges()["lubricant.eyring_stress_MPa"].usual
    (0.3, 60.0)
    """
    found: dict[str, Range] = {}

    def walk(place: str, table: Mapping[str, Any]) -> None:
        for key, value in table.items():
            if "usual" in value:
                found[f"{place}{key}"] = Range(tuple(value["possible"]), tuple(value["usual"]))
            else:
                walk(f"{place}{key}.", value)

    walk("", tomllib.loads(files("mixedlub.schema").joinpath("ranges.toml").read_text(encoding="utf-8")))
    return found


def key_of(place: Sequence[Any]) -> str:
    """The key of the table that a place in a file has, without entries of lists and the names of surfaces.

    >>> key_of(("surfaces", "ground", "coating", "thickness_um")), key_of(("gears", "teeth", 1))
    ('surfaces.coating.thickness_um', 'gears.teeth')
    """
    named = [part for part in place if isinstance(part, str)]
    return ".".join(named[:1] + named[2:] if named[:1] == ["surfaces"] else named)


def meant(name: str, value: object, low: float, high: float) -> str:
    """The unit that a number beyond a range would suit, in words; empty where none does.

    >>> meant("kinematic_viscosity_mm2_s", 30e-6, 0.4, 2e6)
    '3e-05 m2/s would be 30 mm²/s: is it in that unit?'
    >>> meant("temperature_C", 313.15, -80, 250), meant("m2", 0.5, 1.0, 2.0)
    ('313.15 K would be 40 °C: is it in that unit?', '')
    >>> meant("poisson_ratio", 0.5, 0.0, 0.4999), meant("sequence", 2.0, 0.0, 1.0)
    ('', '')
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value) or name in NO_SHARES:
        return ""
    for unit, (factor, added) in SLIPS.get(read_as(name), {}).items():
        if low <= value * factor + added <= high:
            return (
                f"{value:.6g} {unit.replace('.', ' ')} would be {value * factor + added:.4g} {unit_of(name)}".rstrip()
                + ASKED
            )
    return ""


ASKED = ": is it in that unit?"


def broken(key: str, value: object) -> str:
    """The rule that an impossible value breaks, and the unit that it would suit; empty where nothing is broken.

    >>> broken("gears.normal_module_mm", 0.0042)
    'must be from 0.01 to 200 mm; 0.0042 m would be 4.2 mm: is it in that unit?'
    >>> broken("lubricant.temperature_C", (40.0, 373.15))
    'entry 2 must be from -150 to 300 °C; 373.15 K would be 100 °C: is it in that unit?'
    """
    if key not in ranges() or value is None:
        return ""
    (low, high), name = ranges()[key].possible, key.rpartition(".")[2]
    for place, entry in _entries(value):
        if not low <= entry <= high:
            ends = f"at least {low:g}" if high == np.inf else f"from {low:g} to {high:g}"
            other = meant(name, entry, *ranges()[key].usual)
            return f"{place}must be {ends} {unit_of(name)}".rstrip() + (f"; {other}" if other else "")
    return ""


def _entries(value: Any) -> Iterator[tuple[str, float]]:
    """The numbers of a key, each with the words that tell it from the others."""
    if isinstance(value, tuple):
        yield from ((f"entry {number} ", entry) for number, entry in enumerate(value, start=1))
    else:
        yield "", value


def beyond_usual(key: str, value: float, place: str) -> str:
    """What is unusual of a possible value, in words with the range that is usual; empty where nothing is.

    >>> beyond_usual("lubricant.eyring_stress_MPa", 90.0, "lubricant.eyring_stress_MPa")
    'lubricant.eyring_stress_MPa is 90, where rigs have 0.3 to 60 MPa: check the number and its unit'
    """
    low, high = ranges()[key].usual
    if low <= value <= high:
        return ""
    name = key.rpartition(".")[2]
    usual = f"at least {low:g}" if high == np.inf else f"{low:g} to {high:g}"
    said = f"{place} is {value:.6g}, where rigs have {usual} {unit_of(name)}".rstrip()
    return f"{said}: {meant(name, value, low, high).removesuffix(ASKED) or 'check the number and its unit'}"


def unusual(table: BaseModel, place: tuple[str, ...] = ()) -> Iterator[str]:
    """What is far from any rig in a validated file: possible numbers outside the usual ranges, one a key."""
    for name in type(table).model_fields:
        yield from _unusual(getattr(table, name), (*place, name))


def _unusual(value: Any, place: tuple[str, ...]) -> Iterator[str]:
    if isinstance(value, BaseModel):
        yield from unusual(value, place)
    elif isinstance(value, dict):
        for name, inner in value.items():
            yield from _unusual(inner, (*place, name))
    elif key_of(place) in ranges() and value is not None:
        where = ".".join(place)
        said = (
            beyond_usual(key_of(place), entry, f"{where}, {words}".rstrip(", ")) for words, entry in _entries(value)
        )
        yield from islice(filter(None, said), 1)
