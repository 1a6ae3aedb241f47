"""Changes of a study file by the level of a factor."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mixedlub.schema.gear_file import SUFFIX, GearFile, gear_names, shipped_gears, with_preset
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.study.factor_file import OVER
from profiles.errors import InputError, nearest

Content = dict[str, Any]
MEASURED = {"profile", "traces", "map"}
"""Keys of a measured surface."""
LENGTHS = ("tip_diameter_mm", "centre_distance_mm")
"""Lengths of gears that scale with the module; the face width is a separate factor."""


def set_level(content: Content, factor: str, level: Any, folder: Path) -> None:
    """Set a factor in the content of a study file to a level."""
    if factor == "gears":
        _set_gears(content, level, folder)
    else:
        _SETTERS[factor](content, level)


def _set_gears(content: Content, level: str, folder: Path) -> None:
    """Set gears by name or file; load sharing is kept from the study unless the file states it."""
    _refuse_table(content, "gears")
    sharing = {"load_sharing": content["gears"]["load_sharing"]} if "load_sharing" in content["gears"] else {}
    content["gears"] = sharing | _gears(level, folder)


def _gears(level: str, folder: Path) -> Content:
    if not level.endswith(SUFFIX):
        if level not in gear_names():
            rule = f"no such gears, and no file of that name ends in {SUFFIX}; {nearest(level, gear_names())}"
            raise InputError(rule, where="factors.gears", value=level)
        return dict(shipped_gears(level).keys)
    content = read_toml(folder / level)
    if "properties" in content:
        return parse(GearFile, content, str(folder / level)).keys
    if not isinstance(content.get("gears"), dict):
        raise InputError("has no section [gears]", where=f"factors.gears: {folder / level}")
    return with_preset(content["gears"]) if "preset" in content["gears"] else dict(content["gears"])


def _set_module(content: Content, level: float) -> None:
    """Scale the teeth: all lengths of the gears except the face width are proportional to the module."""
    _refuse_table(content, "normal_module_mm")
    gears = with_preset(content["gears"]) if "preset" in content["gears"] else content["gears"]
    ratio = level / gears["normal_module_mm"]
    for key in LENGTHS:
        if key in gears:
            given = gears[key]
            gears[key] = [ratio * one for one in given] if isinstance(given, list | tuple) else ratio * given
    content["gears"] = gears | {"normal_module_mm": level}


def _refuse_table(content: Content, factor: str) -> None:
    if "table" in content["gears"].get("load_sharing", {}):
        rule = "the study has a table of load shares, which belongs to its gears; leave the factor out"
        raise InputError(rule, where=f"factors.{factor}")


def _set_key(*place: str) -> Callable[[Content, Any], None]:
    """Setter of a key within tables, created if missing."""

    def change(content: Content, level: Any) -> None:
        table = content
        for name in place[:-1]:
            table = table.setdefault(name, {})
        table[place[-1]] = level

    return change


def _set_oil(content: Content, level: str) -> None:
    content["lubricant"] = {"oil": level}


def _set_relief(content: Content, level: float) -> None:
    content["gears"].setdefault("load_sharing", {})["tip_relief_um"] = [level, level]


def _set_slope(content: Content, level: float) -> None:
    content["gears"].setdefault("load_sharing", {})["profile_slope_deviation_um"] = [level, 0.0]


def _set_cutoff(key: str) -> Callable[[Content, float], None]:
    def change(content: Content, level: float) -> None:
        for surface in traced(content, key).values():
            surface[key] = level

    return change


def _set_condition(key: str) -> Callable[[Content, float], None]:
    def change(content: Content, level: float) -> None:
        content["conditions"][key] = [level]

    return change


def traced(content: Mapping[str, Any], factor: str) -> dict[str, dict[str, Any]]:
    """Measured surfaces."""
    found = {name: one for name, one in content["surfaces"].items() if MEASURED.intersection(one)}
    if not found:
        raise InputError("no surface of the study has a trace", where=f"factors.{factor}")
    if factor == "replicate":
        for name, one in found.items():
            if {"map", "traces_along"}.intersection(one):
                rule = f"takes traces in one direction, and surfaces.{name} has a map or traces along its lay"
                raise InputError(rule, where="factors.replicate")
    return found


_SETTERS: Mapping[str, Callable[[Content, Any], None]] = {
    "boundary_friction": _set_key("boundary_friction"),
    "oil": _set_oil,
    "friction": _set_key("options", "friction"),
    "normal_module_mm": _set_module,
    **{
        key: _set_key("gears", key)
        for key in ("face_width_mm", "pressure_angle_deg", "helix_angle_deg", "centre_distance_mm")
    },
    "load_sharing": _set_key("gears", "load_sharing", "model"),
    "tip_relief_um": _set_relief,
    "profile_slope_deviation_um": _set_slope,
    **{key: _set_key("gears", "load_sharing", key) for key in ("lead_crown_um", "misalignment_um")},
    **{key: _set_cutoff(key) for key in ("cutoff_mm", "short_cutoff_um")},
    **{key: _set_condition(key) for key in OVER},
}
