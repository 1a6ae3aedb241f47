"""The format of a case as text: what each kind records, its columns, and the keys of `system.toml`.

Columns, bounds, keys, defaults and units come from the kinds and from `mixedlub.schema`; only meanings are typed here.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from mixedlub.kinds import Kind, kind
from mixedlub.schema.ranges import key_of, ranges
from mixedlub.schema.system_file import KINDS, System
from mixedlub.schema.table import BOOKKEEPING, RUN, Column
from mixedlub.schema.units import unit_of
from profiles.errors import InputError, nearest

_MEANINGS = """
# columns
run                      | number of the reading, each once
rig                      | which rig or part of it; all share the calibration
sequence                 | place in the test programme, 0 at its start and 1 at its end
setup                    | assembly or campaign; readings of one set-up share an error
torque_Nm                | torque on the pinion
friction_map.torque_Nm   | torque that loads the drive
speed_rpm                | speed of the pinion
friction_map.speed_rpm   | signed speed of the drive; this or sliding_speed_m_s
sliding_speed_m_s        | signed sliding speed; this or speed_rpm
oil_temperature_C        | temperature of the oil where it enters the contact
friction_map.oil_temperature_C | temperature of oil or grease
pinion_surface           | a surface of system.toml
gear_surface             | a surface of system.toml
surface_1                | a surface of system.toml
surface_2                | a surface of system.toml
roll_angle_deg           | roll angle of the contact on the pinion
load_N                   | normal load
friction_map.load_N      | load on the drive
entrainment_speed_m_s    | mean of the two surface speeds
slide_roll_ratio         | sliding speed over mean speed
time_s                   | time since the start of the recording
fringe_order             | interference order that the instrument counted
additive_percent         | content of an additive
motor_torque_Nm          | torque that the controller computes from the motor current
position_deg             | angle the drive has turned
temperature_C            | temperature of the sample
pressure_MPa             | pressure on the sample; ambient where there is no such column
power_loss_W             | power lost
friction_coefficient     | friction over load, positive but for noise
friction_map.friction_coefficient | friction over load, signed with the speed
film_thickness_nm        | central film thickness
friction_torque_Nm       | friction torque of the drive
viscosity_mPa_s          | dynamic viscosity
READING_sd               | sd of each reading, 0 or empty: not told; goes before recording.noise
CHECK                    | the column that recording.check names: never fitted

# top of the file
schema                   | format of the file
kind                     | what was recorded
boundary_friction        | friction coefficient of touching asperities
description              | free text

gears                                | two entries: pinion, gear
gears.teeth                          | numbers of teeth
gears.normal_module_mm               | normal module
gears.pressure_angle_deg             | normal pressure angle
gears.helix_angle_deg                | helix angle at the pitch circle
gears.profile_shift                  | profile shift over module
gears.tip_diameter_mm                | tip diameters; left out: standard addendum
gears.centre_distance_mm             | working centre distance; left out: from profile shift
gears.face_width_mm                  | common face width
gears.youngs_modulus_GPa             | Young's moduli
gears.poisson_ratio                  | Poisson's ratios
gears.load_sharing                   | left out: { model = "rigid" }
gears.load_sharing.table             | CSV of torque_Nm, roll_angle_deg, load_share; this or model
gears.load_sharing.model             | elastic teeth, or equal shares; this or table
gears.load_sharing.tip_relief_um     | model "ldp": tip relief
gears.load_sharing.relief_length_mm  | model "ldp": length of the relief along the profile
gears.load_sharing.lead_crown_um     | model "ldp": crown over the face, both flanks together
gears.load_sharing.misalignment_um   | model "ldp": misalignment over the face width

contact                              | two entries: first and second body
contact.geometry                     | cylinders, or a ball
contact.radius_mm                    | radii; inf is flat
contact.width_mm                     | length of a line contact, which needs it
contact.youngs_modulus_GPa           | Young's moduli
contact.poisson_ratio                | Poisson's ratios

lubricant                            | what is left out is typical of the base stock, and said so
lubricant.name                       | for the report
lubricant.base                       | base stock; left out: mineral
lubricant.temperature_C              | of the next two keys
lubricant.kinematic_viscosity_mm2_s  | ASTM D341 between and beyond
lubricant.pressure_viscosity_per_GPa | linear between and beyond
lubricant.density_15C_kg_m3          | density at 15 C
lubricant.density_change_per_K       | relative fall of density
lubricant.eyring_stress_MPa          | Eyring stress of the film
lubricant.thermal_conductivity_W_mK  | of the oil
lubricant.specific_heat_J_kgK        | of the oil

surfaces.NAME                        | one table a surface; NAME stands in the tables of readings
surfaces.NAME.m0_um2                 | variance of heights; the three moments, or a profile
surfaces.NAME.m2                     | variance of slopes of the profile
surfaces.NAME.m4_per_um2             | variance of curvatures of the profile
surfaces.NAME.profile                | file of a trace, path from the case folder; or shipped:NAME
surfaces.NAME.cutoff_mm              | long cut-off; left out: 0.8, or the trace's own
surfaces.NAME.short_cutoff_um        | short cut-off; left out: 2.5, or the trace's own
surfaces.NAME.form                  | default line; none, mean, circle, polynomial-N, involute-MM
surfaces.NAME.edges                 | true: chamfers and falling ends are cut off a trace
surfaces.NAME.outliers              | a trace is masked beyond so many robust sigmas
surfaces.NAME.thermal_conductivity_W_mK | of the body
surfaces.NAME.density_kg_m3          | of the body
surfaces.NAME.specific_heat_J_kgK    | of the body
surfaces.NAME.coating                | only where there is one
surfaces.NAME.coating.name           | for the report
surfaces.NAME.coating.thickness_um   | thickness of the coating
surfaces.NAME.coating.thermal_conductivity_W_mK | of the coating

uncertainty                          | one standard deviation of what calibration may move; 0: known
uncertainty.boundary_friction        | absolute
uncertainty.viscosity                | relative, one factor for the case
uncertainty.pressure_viscosity       | relative, one factor for the case
uncertainty.eyring_stress            | relative, one factor for the case
uncertainty.roughness                | relative, one factor on the Rq of all surfaces

recording.quantity                   | the column that was recorded
recording.includes                   | free text: what the number holds beside the contact
recording.ambient_temperature_C      | temperature around the rig
recording.check                      | a column of a second channel: never fitted, compared afterwards
recording.noise                      | left out: estimated from repeats, else from the fit
recording.noise.relative             | sd of a reading over its size; its square adds to the next one's
recording.noise.absolute             | sd of a reading, in its unit
recording.noise.setup_relative       | sd of the error shared within a set-up, over the reading
recording.noise.setup_absolute       | sd of the error shared within a set-up, in the unit of the reading
"""

USED = {
    "film": ("lubricant",),
    "friction_history": ("contact", "lubricant", "surfaces"),
    "viscosity": ("lubricant",),
}
"""Sections that a kind computes with where they are given, beyond those it needs."""

FEW = 4
"""Longer lists of options stand elsewhere: kinds and what they record."""

_NAMED = {"surfaces": "surfaces.NAME"}
_GAP = "  "


def _read(text: str) -> dict[str, str]:
    lines = (line.partition("|") for line in text.splitlines() if "|" in line)
    return {name.strip(): meaning.strip() for name, _, meaning in lines}


MEANINGS = _read(_MEANINGS)
"""What a column (where kinds differ, KIND.column), a section, or a key (SECTION.key) of `system.toml` means."""


def kinds_text(name: str | None = None) -> str:
    """The format of one kind of case, or of all of them."""
    if name is not None and name not in KINDS:
        raise InputError(f"no such kind; {nearest(name, KINDS)}", where="KIND", value=name)
    chosen = [kind(n) for n in (KINDS if name is None else (name,))]
    taken = {section for k in chosen for section in (*k.sections, *USED.get(k.name, ()))}
    lines = (
        [f"{len(KINDS)} kinds of case. `mixedlub kinds KIND` shows one, with the keys it takes."] if not name else []
    )
    for k in chosen:
        lines += ["", *_kind(k)]
    lines += ["", "columns of every kind (conditions.csv has all but the reading)", *_aligned(_common())]
    lines += ["", "keys of system.toml: unit, default, what is allowed, meaning"]
    for section, rows in sections().items():
        if section.split(".")[0] in {"", "uncertainty", "recording"} | taken:
            lines += ["", *_title(section, told=name is None), *_aligned([_key(section, *row) for row in rows])]
    return "\n".join(lines).lstrip("\n")


def _kind(k: Kind) -> Iterator[str]:
    about = (importlib.import_module(f"mixedlub.kinds.{k.name}").__doc__ or "").splitlines()[0]
    yield f"{k.name}: {about[:1].lower()}{about[1:].rstrip('.')}"
    yield f"  needs {_tables(k.sections) or 'no section but [recording]'}" + (
        f"; uses where given {_tables(USED[k.name])}" if k.name in USED else ""
    )
    if k.part_rigs:
        yield f"  readings of the rig {' or '.join(k.part_rigs)} are compared with a part of the base model"
    readings = [Column(q, above=0.0 if k.logarithmic else -np.inf) for q in k.quantities]
    one = "reading" if len(readings) == 1 else "one of these"
    rows = [_column(k.name, c) for c in (*k.columns, *k.channels)]
    yield from _aligned([*rows, *((*_column(k.name, c)[:2], one, *_column(k.name, c)[3:]) for c in readings)], indent=4)


def _tables(names: Sequence[str]) -> str:
    return " ".join(f"[{_NAMED.get(name, name)}]" for name in names)


def _common() -> list[tuple[str, ...]]:
    told = [_column("", c) for c in (RUN, *BOOKKEEPING)]
    told.append(("READING_sd", "as read", "optional", "from 0", MEANINGS["READING_sd"]))
    return [*told, ("CHECK", "any", "optional", "number", MEANINGS["CHECK"])]


def _column(of_kind: str, c: Column) -> tuple[str, ...]:
    numeric = c.form != "name"
    meaning = MEANINGS.get(f"{of_kind}.{c.name}") or MEANINGS[c.name]
    needed = "required" if c.required else "optional"
    return c.name, (unit_of(c.name) or "-") if numeric else "", needed, _bounds(c), meaning


def _bounds(c: Column) -> str:
    if c.form != "number":
        return {"whole": "whole number"}.get(c.form, c.form)
    if np.isfinite(c.above):
        return f"above {c.above:g}"
    if np.isfinite(c.at_least):
        return f"{c.at_least:g} to {c.at_most:g}" if np.isfinite(c.at_most) else f"{c.at_least:g} or more"
    return "number"


def sections() -> dict[str, list[tuple[str, dict[str, Any], bool]]]:
    """Tables of `system.toml` ("" is its top) with their keys: name, JSON schema, whether it must be given."""
    whole = System.model_json_schema()
    found: dict[str, list[tuple[str, dict[str, Any], bool]]] = {}

    def walk(place: str, table: Mapping[str, Any]) -> None:
        found[place] = []
        inner = []
        for key, schema in table["properties"].items():
            of = schema.get("additionalProperties") or next((s for s in schema.get("anyOf", ()) if "$ref" in s), schema)
            if "$ref" in of:
                inner.append((f"{place}.{key}".lstrip(".") if place else _NAMED.get(key, key), of["$ref"]))
            else:
                found[place].append((key, schema, key in table.get("required", ())))
        for name, reference in inner:
            walk(name, whole["$defs"][reference.rpartition("/")[2]])

    walk("", whole)
    return found


def _title(section: str, told: bool) -> Iterator[str]:
    """A section and its meaning; which kinds take it where that is to be ``told``."""
    yield f"[{section}]  {MEANINGS.get(section, '')}".rstrip() if section else "top of the file"
    first = section.split(".")[0]
    needed = [n for n in KINDS if first in kind(n).sections]
    used = [n for n in KINDS if first in USED.get(n, ())]
    if told and section in (first, _NAMED.get(first)):
        yield from (
            f"  {word} {', '.join(names)}"
            for word, names in (("needed by", needed), ("used where given by", used))
            if names
        )


def _key(section: str, key: str, schema: Mapping[str, Any], required: bool) -> tuple[str, ...]:
    plain = next((s for s in schema.get("anyOf", ()) if s.get("type") != "null"), schema)
    values, numeric = _allowed(plain, bounds_of(section, key))
    default = "required" if required else _toml(schema.get("default"))
    unit = ("as read" if key.endswith("absolute") else unit_of(key) or "-") if numeric else ""
    return key, unit, default, values, MEANINGS[f"{section}.{key}".lstrip(".")]


def bounds_of(section: str, key: str) -> tuple[float, float]:
    """Lowest and highest value of a key that the table of bounds allows.

    >>> bounds_of("surfaces.NAME.coating", "thickness_um"), bounds_of("gears", "teeth")
    ((0.0001, 20000.0), (-inf, inf))
    """
    found = ranges().get(key_of((*section.split("."), key) if section else (key,)))
    return (-np.inf, np.inf) if found is None else found.possible


def _allowed(schema: Mapping[str, Any], bounds: tuple[float, float]) -> tuple[str, bool]:
    """What a key may hold, and whether that is numbers."""
    if "prefixItems" in schema:
        one, numeric = _allowed(schema["prefixItems"][0], bounds)
        return f"[{one}] x {len(schema['prefixItems'])}", numeric
    if "const" in schema or "enum" in schema:
        options = [_toml(option) for option in schema.get("enum", [schema.get("const")])]
        return (", ".join(options) if len(options) <= FEW else "see above"), False
    if schema["type"] == "boolean":
        return "true, false", False
    if schema["type"] == "string":
        return "text", False
    least, most = max(bounds[0], schema.get("minimum", schema.get("ge", -np.inf))), bounds[1]
    if np.isfinite(least):
        return f"{least:g} to {most:g}" if np.isfinite(most) else f"from {least:g}", True
    return "whole number" if schema["type"] == "integer" else "number", True


def _toml(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    return f"[{', '.join(map(_toml, value))}]" if isinstance(value, (list, tuple)) else f"{value:g}"


def _aligned(rows: Sequence[tuple[str, ...]], indent: int = 2) -> list[str]:
    widths = [max(map(len, cells)) for cells in zip(*rows, strict=True)]
    return [
        " " * indent + _GAP.join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
