"""The record of a result: the study file as given and every input as used."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub import friction
from mixedlub.rig.build import DEFAULT_BASE, ZERO_CELSIUS
from mixedlub.rig.lubricant import LINEAR, Lubricant
from mixedlub.rig.surface import Surface
from mixedlub.running.atomic import is_alive
from mixedlub.running.origin import Origin, is_same
from mixedlub.schema.oil_file import KNOWN
from mixedlub.schema.section import Section
from mixedlub.schema.surface_file import SURFACE_FILES, SurfaceSection
from mixedlub.schema.system_file import Gears
from mixedlub.study.checkpoint import fingerprint, input_fingerprint
from mixedlub.study.options import ignored
from mixedlub.study.plan import Study
from mixedlub.study.results import versions
from profiles.errors import InputError
from roughness.mccool import nayak_parameter, summit_density, summit_radius

SCHEMA = "mixedlub-study-result/1"
GIVEN, RESOLVED = "study.toml", "resolved.json"
TABLES = ("results", "fits", "ranking", "comparisons", "curves")
"""Tables of a result."""
WRITTEN = ("index.html", GIVEN, RESOLVED)
"""Other files of a result outside the folder of figures."""


def resolved(study: Study) -> dict[str, Any]:
    """All inputs as used, by the keys of a study file and with defaults, and the quantities derived from them."""
    file, pair = study.file, study.pair
    inputs = file.model_dump(by_alias=True, exclude_none=True)
    inputs["gears"] |= {
        "tip_diameter_mm": [_plain(2e3 * abs(radius)) for radius in pair.tip_radii],
        "centre_distance_mm": _plain(abs(pair.working_centre_distance) * 1e3),
    }
    sharing = file.gears.load_sharing
    taken = {"model", *sharing.chosen.keys.model_fields}
    inputs["gears"]["load_sharing"] = sharing.model_dump(include=taken, exclude_none=True)
    inputs["lubricant"] = _oil(study.oil) | _base(study)
    inputs["surfaces"] = {name: as_moments(s, file.surfaces[name]) for name, s in study.surfaces.items()}
    inputs.setdefault("pairings", {"every": list(study.surfaces)})
    law = friction.find(file.options.friction)
    inputs["options"]["friction_coefficients"] = law.values(file.options.friction_coefficients)
    for option in ignored(file.options, study.plan.model()):
        del inputs["options"][option]
    inputs["effects"] = {name: dict(values) for name, values in study.plan.parameters.items()}
    return {
        "inputs": inputs,
        "assumed": list(assumed(study)),
        "derived": {"gears": _geometry(study), "surfaces": {n: asperities(s) for n, s in study.surfaces.items()}},
        "traces": {
            name: file.surfaces[name].model_dump(include=set(SURFACE_FILES), exclude_none=True)
            | {"steps": list(s.steps), **_cutoffs(s)}
            for name, s in study.surfaces.items()
            if file.surfaces[name].is_measured
        },
    }


def _cutoffs(surface: Surface) -> dict[str, float | None]:
    """Cut-offs by the keys of a surface; None where no filter was applied."""
    used = {"cutoff_mm": (surface.cutoff, 1e3), "short_cutoff_um": (surface.short_cutoff, 1e6)}
    return {key: None if length is None else _plain(length * scale) for key, (length, scale) in used.items()}


def _base(study: Study) -> dict[str, str]:
    """Base stock of the oil, if given or if its typical values replace missing ones."""
    given = study.file.lubricant and study.file.lubricant.base
    if given:
        return {"base": given}
    return {"base": DEFAULT_BASE} if any(key.startswith("lubricant.") for key in assumed(study)) else {}


def assumed(study: Study) -> Iterator[str]:
    """Dotted keys needed by the run and absent from the file, so that defaults apply."""
    file = study.file
    yield from _left_out(file, "", ("boundary_friction",))
    yield from _left_out(file.gears, "gears", tuple(Gears.model_fields))
    sharing = file.gears.load_sharing
    yield from _left_out(sharing, "gears.load_sharing", tuple(sharing.chosen.keys.model_fields))
    given = {} if file.lubricant is None else file.lubricant.model_dump(exclude_none=True)
    left_out = [key for key in _oil(study.oil) if key not in given and key != "name"]
    yield from (f"lubricant.{key}" for key in (*left_out, *(["base"] if left_out and "base" not in given else [])))
    for name in study.surfaces:
        section, keys = file.surfaces[name], ("thermal_conductivity_W_mK", "density_kg_m3", "specific_heat_J_kgK")
        yield from _left_out(section, f"surfaces.{name}", keys)
    unread = ignored(file.options, study.plan.model())
    yield from _left_out(file.options, "options", tuple(n for n in type(file.options).model_fields if n not in unread))
    for effect, values in study.plan.parameters.items():
        yield from (f"effects.{effect}.{name}" for name in values if name not in study.stated[effect])


def _left_out(section: Section, place: str, keys: tuple[str, ...]) -> Iterator[str]:
    given = section.model_fields_set
    yield from (f"{place}.{key}".lstrip(".") for key in keys if key not in given)


def _geometry(study: Study) -> dict[str, Any]:
    pair = study.pair
    return {
        "contact_ratio": pair.contact_ratio,
        "overlap_ratio": pair.overlap_ratio,
        "working_pressure_angle_deg": float(np.degrees(pair.working_pressure_angle)),
        "backlash_um": pair.backlash * 1e6,
        "reduced_modulus_GPa": pair.reduced_modulus * 1e-9,
        "mesh_points": int(study.mesh.position.size),
    }


def _oil(oil: Lubricant) -> dict[str, Any]:
    modulus = {}
    if oil.pressure_modulus is not None and oil.modulus_slope is not None:
        modulus["pressure_modulus_MPa"] = [_plain(a * 1e-6) for a in oil.pressure_modulus]
        modulus["pressure_modulus_slope"] = list(oil.modulus_slope)
    return {
        **modulus,
        "name": oil.name,
        "temperature_C": [_plain(t - ZERO_CELSIUS) for t in oil.temperature],
        "kinematic_viscosity_mm2_s": [_plain(nu * 1e6) for nu in oil.kinematic_viscosity],
        **_coefficient(oil),
        "density_15C_kg_m3": oil.density_15,
        "density_change_per_K": oil.density_change,
        "eyring_stress_MPa": _plain(oil.eyring_stress * 1e-6),
        "thermal_conductivity_W_mK": oil.conductivity,
        "specific_heat_J_kgK": oil.heat_capacity,
    }


def _coefficient(oil: Lubricant) -> dict[str, Any]:
    """Pressure-viscosity coefficient: at both temperatures, or at the first with the rule for others."""
    both = [_plain(alpha * 1e9) for alpha in oil.pressure_viscosity]
    if oil.carried == LINEAR:
        return {"pressure_viscosity_per_GPa": both}
    first = _plain(oil.temperature[0] - ZERO_CELSIUS)
    return {KNOWN: {"coefficient_per_GPa": both[0], "temperature_C": first, "carried": oil.carried}}


def _plain(value: float) -> float:
    """A number without the rounding error of a unit conversion.

    >>> _plain(18.05e-6 * 1e6)
    18.05
    """
    return float(f"{value:.14g}")


def as_moments(surface: Surface, section: SurfaceSection) -> dict[str, Any]:
    """Keys of a surface given by moments, either stated or computed from a trace."""
    body = section.model_dump(
        include={"coating", "thermal_conductivity_W_mK", "density_kg_m3", "specific_heat_J_kgK"}, exclude_none=True
    )
    moments = {"m0_um2": surface.m0 * 1e12, "m2": surface.m2, "m4_per_um2": surface.m4 * 1e-12}
    if surface.m2_along is not None and surface.m4_along is not None:
        moments |= {"m2_along": surface.m2_along, "m4_along_per_um2": surface.m4_along * 1e-12}
    lay = {} if surface.lay is None else {"lay": surface.lay}
    return {name: _plain(value) for name, value in moments.items()} | lay | body


def asperities(surface: Surface) -> dict[str, float]:
    """Roughness and asperities of a surface, from its moments; with a lay, of its isotropic equivalent."""
    m2, m4 = ((across * (along or across)) ** 0.5 for across, along in _directions(surface))
    moments = (np.array(surface.m0), np.array(m2), np.array(m4))
    with np.errstate(divide="ignore"):
        found = {
            "Rq_um": np.sqrt(surface.m0) * 1e6,
            "rms_slope": np.sqrt(m2),
            "rms_curvature_per_mm": np.sqrt(m4) * 1e-3,
            "nayak": nayak_parameter(*moments),
            "density_per_mm2": summit_density(*moments[1:]) * 1e-6,
            "radius_um": summit_radius(moments[2]) * 1e6,
        }
    if surface.lay is not None:
        found |= {"rms_slope_across_lay": surface.m2**0.5, "peklenik_number": np.array(surface.orientation)}
    return {name: float(value) for name, value in found.items() if np.isfinite(value)}


def _directions(surface: Surface) -> tuple[tuple[float, float | None], tuple[float, float | None]]:
    """m2 and m4, each across and along the lay."""
    return (surface.m2, surface.m2_along), (surface.m4, surface.m4_along)


def record_files(folder: Path, study: Study, file: Path, given: bytes) -> dict[str, str | bytes]:
    """Record of the result, and the study file as given unless it lies in the folder of the result."""
    record = {
        "schema": SCHEMA,
        "title": study.file.title,
        "fingerprint": fingerprint(study.plan),
        "versions": versions(),
        **resolved(study),
    }
    text = json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False)
    copy = {} if is_same(folder / GIVEN, file) else {GIVEN: given}
    return {**copy, RESOLVED: text + "\n"}


def study_origin(study: Study, file: Path) -> Origin:
    """A study as the origin of a result."""
    return Origin(file, input_fingerprint(study.plan))


@contextmanager
def running(folder: Path, study: Study) -> Iterator[None]:
    """Context marking a folder as in use; raises an error while a run of another study writes there."""
    whose = input_fingerprint(study.plan)[:16]
    own = folder / f".running-{whose}-{os.getpid()}"
    own.touch()
    try:
        for path in folder.glob(".running-*"):
            _, other, process = path.name.rsplit("-", 2)
            if path != own and not is_alive(process):
                path.unlink(missing_ok=True)
            elif other != whose:
                rule = f"a run of another study writes there (process {process}); wait for it, or name another --out"
                raise InputError(rule, where="--out", value=str(folder))
        yield
    finally:
        own.unlink(missing_ok=True)
