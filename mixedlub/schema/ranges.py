"""Possible and typical ranges of all numbers, and probable units of numbers outside."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import SLIPS, read_as, unit_of

NO_SHARES = ("poisson_ratio", "sequence", "path_points", "face_slices")
"""Dimensionless numbers never given in percent."""


@dataclass(frozen=True)
class Range:
    """Possible and typical range of a key, limits included."""

    key: str
    possible: tuple[float, float]
    typical: tuple[float, float]


@cache
def ranges() -> Mapping[str, Range]:
    """Ranges by key of `system.toml`, without the name of a surface.

    >>> ranges()["lubricant.eyring_stress_MPa"].typical
    (0.3, 60.0)
    """
    found: dict[str, Range] = {}

    def walk(place: str, table: Mapping[str, Any]) -> None:
        for key, value in table.items():
            if "typical" in value:
                found[f"{place}{key}"] = Range(f"{place}{key}", tuple(value["possible"]), tuple(value["typical"]))
            else:
                walk(f"{place}{key}.", value)

    walk("", tomllib.loads(files("mixedlub.schema").joinpath("ranges.toml").read_text(encoding="utf-8")))
    return found


def range_of(field: FieldInfo) -> Range | None:
    """Range of a field of a file."""
    return next((m for m in field.metadata if isinstance(m, Range)), None)


def probable_unit(name: str, value: object, low: float, high: float) -> str:
    """Question on the unit in which a number outside a range lies within it; empty if no unit fits.

    >>> probable_unit("kinematic_viscosity_mm2_s", 30e-6, 0.4, 2e6)
    '3e-05 m2/s would be 30 mm²/s: is it in that unit?'
    >>> probable_unit("temperature_C", 313.15, -80, 250), probable_unit("m2", 0.5, 1.0, 2.0)
    ('313.15 K would be 40 °C: is it in that unit?', '')
    >>> probable_unit("poisson_ratio", 0.5, 0.0, 0.4999), probable_unit("sequence", 2.0, 0.0, 1.0)
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


def range_violation(key: str | Range, value: object) -> str:
    """Rule violated by an impossible value, with its probable unit; empty for a possible value.

    >>> range_violation("gears.normal_module_mm", 0.0042)
    'must be from 0.01 to 200 mm; 0.0042 m would be 4.2 mm: is it in that unit?'
    >>> range_violation("lubricant.temperature_C", (40.0, 373.15))
    'entry 2 must be from -150 to 300 °C; 373.15 K would be 100 °C: is it in that unit?'
    """
    within = key if isinstance(key, Range) else ranges()[key]
    (low, high), name = within.possible, within.key.rpartition(".")[2]
    for place, entry in _entries(value):
        if not low <= entry <= high:
            ends = f"at least {low:g}" if high == np.inf else f"from {low:g} to {high:g}"
            other = probable_unit(name, entry, *within.typical)
            return f"{place}must be {ends} {unit_of(name)}".rstrip() + (f"; {other}" if other else "")
    return ""


def _entries(value: Any) -> Iterator[tuple[str, float]]:
    """Numbers of a key, each with identifying words."""
    if isinstance(value, tuple):
        yield from ((f"entry {number} ", entry) for number, entry in enumerate(value, start=1))
    else:
        yield "", value


def atypical(key: str | Range, value: float, place: str, advice: str = "") -> list[Finding]:
    """Finding on a possible value outside the typical range, with its probable unit unless other ``advice`` is given;
    empty for a typical value.

    >>> print(*atypical("lubricant.eyring_stress_MPa", 90.0, "lubricant.eyring_stress_MPa"))
    lubricant.eyring_stress_MPa: 90, where rigs have 0.3 to 60 MPa: check the number and its unit
    """
    within = key if isinstance(key, Range) else ranges()[key]
    low, high = within.typical
    if low <= value <= high:
        return []
    name = within.key.rpartition(".")[2]
    typical = f"at least {low:g}" if high == np.inf else f"{low:g} to {high:g}"
    unit = advice or probable_unit(name, value, low, high).removesuffix(ASKED) or "check the number and its unit"
    text = f"{value:.6g}, where rigs have {typical} {unit_of(name)}".rstrip()
    return [finding("value_unusual", f"{text}: {unit}", place)]


def unusual(table: BaseModel, place: tuple[str, ...] = ()) -> Iterator[Finding]:
    """Findings on possible but atypical numbers of a validated file, at most one per key."""
    for name, field in type(table).model_fields.items():
        value, within = getattr(table, name), range_of(field)
        if within is not None and value is not None:
            where = ".".join((*place, name))
            each = (atypical(within, x, f"{where}, {words}".rstrip(", ")) for words, x in _entries(value))
            yield from next(filter(None, each), [])
        named = value.items() if isinstance(value, dict) else [("", value)]
        for inner, section in named:
            if isinstance(section, BaseModel):
                yield from unusual(section, (*place, name, *filter(None, [inner])))
