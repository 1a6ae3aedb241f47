"""Defaults for keys missing in `system.toml`: each key with the value used in the model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.gear.build import gear_pair
from mixedlub.kinds import kind as kind_of
from mixedlub.rig import build
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Table
from profiles.errors import InputError

if TYPE_CHECKING:
    from mixedlub.case.folder import Case
    from mixedlub.case.forward import Forward

SHARING = "rigid: the pairs in contact share equally"
BROAD = "fitted with a broad prior"
MINERAL = "mineral"
"""Base stock of an oil that is not specified."""


def gears_taken(section: system_file.Gears) -> dict[str, str]:
    """Keys of the gears that are not given, with their defaults.

    >>> pair = system_file.Gears(teeth=(17, 26), normal_module_mm=4.0, face_width_mm=14.0)
    >>> gears_taken(pair)["tip_diameter_mm"], gears_taken(pair)["load_sharing"]
    ('[76, 112], standard addendum', 'rigid: the pairs in contact share equally')
    """
    pair = gear_pair(section)
    made = {
        "tip_diameter_mm": f"{_shown([2e3 * abs(r) for r in pair.tip_radii])}, standard addendum",
        "centre_distance_mm": f"{_shown(1e3 * abs(pair.working_centre_distance))}, from the profile shift",
        "load_sharing": SHARING,
    }
    left = [key for key in _open(section) if key in made or getattr(section, key) is not None]
    return {key: made[key] if key in made else _shown(getattr(section, key)) for key in left}


def oil_taken(section: system_file.Lubricant | None) -> dict[str, str]:
    """Keys of the oil that are not given, with typical values of its base stock."""
    section = section or system_file.Lubricant()
    typical = build.typical(section)
    base = {} if section.base else {"base": f"{MINERAL}, if needed"}
    return base | {key: _shown(value) for key, value in typical.items() if getattr(section, key, "") is None}


def broadly_fitted(system: system_file.System, columns: Mapping[str, np.ndarray]) -> set[str]:
    """Unspecified inputs, fitted to a recording of these columns with a broad prior. Empty for an invalid case; reading
    the case reports that error."""
    rules = kind_of(system.kind).of_case(system, columns)
    if any(column.required and column.name not in columns for column in rules.columns):
        return set()
    try:
        with collected():
            return {entry.name for entry in rules.extra_calibration(system, Table(columns))}
    except InputError:
        return set()


def assumed(case: Case, forward: Forward | None) -> Iterator[str]:
    """All defaults used for a case, one line per table; missing oil properties are reported where the oil is read."""
    system, sections = case.system, case.kind.sections
    read = {"boundary_friction"} if forward is None and "surfaces" in sections else _not_fitted(forward)
    if "boundary_friction" not in system.model_fields_set and "boundary_friction" in read:
        yield f"boundary_friction = {system.boundary_friction:g}"
    if system.gears is not None:
        yield from _line("gears", gears_taken(system.gears))
    if system.contact is not None and "contact" in sections:
        given = {key: getattr(system.contact, key) for key in _open(system.contact)}
        yield from _line("contact", {key: _shown(value) for key, value in given.items() if value is not None})
    yield from _surfaces(system) if "surfaces" in sections else ()
    effects = () if forward is None else forward.effects()
    ambient = "ambient_temperature_C" not in system.recording.model_fields_set
    if ambient and any("ambient_temperature" in effect.reads for effect in effects):
        yield f"recording: ambient_temperature_C = {system.recording.ambient_temperature_C:g}"


def _not_fitted(forward: Forward | None) -> set[str]:
    """Inputs of the rows, without unspecified inputs that are fitted to the readings."""
    if forward is None:
        return set()
    stated = set(forward.case.system.uncertainty.stated)
    return set(forward.inputs) - ({entry.name for entry in forward.calibrations} - stated)


def _surfaces(system: system_file.System) -> Iterator[str]:
    """Defaults of the surfaces (steel, trace levelled by a line); surfaces with equal defaults share one line."""
    equal: dict[tuple[str, ...], list[str]] = {}
    for name, section in system.surfaces.items():
        values = {key: getattr(section, key) for key in _open(section)}
        left = [f"{key} = {_shown(value)}" for key, value in values.items() if isinstance(value, float)]
        left += ['form = "line"'] if section.is_measured and section.form is None else []
        equal.setdefault(tuple(left), []).append(name)
    for defaults, names in equal.items():
        if defaults:
            yield f"surfaces.{', surfaces.'.join(names)}: {', '.join(defaults)}"


def _line(table: str, values: Mapping[str, str]) -> Iterator[str]:
    if values:
        yield f"{table}: " + "; ".join(f"{key} = {value}" for key, value in values.items())


def _open(section: system_file.Section) -> list[str]:
    return [key for key in type(section).model_fields if key not in section.model_fields_set]


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return value
    return f"[{', '.join(map(_shown, value))}]" if isinstance(value, (list, tuple)) else f"{value:.6g}"
