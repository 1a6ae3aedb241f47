"""Lubricant and surfaces in SI from the sections of `system.toml`."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.laws.oil import ZERO_CELSIUS, gold_pressure_viscosity
from mixedlub.rig.lubricant import ROELANDS, Lubricant
from mixedlub.rig.measured import Measured, Traces
from mixedlub.rig.oil_doubts import doubts
from mixedlub.rig.surface import Surface
from mixedlub.schema import surface_file, system_file
from mixedlub.schema.findings import collected, finding, report
from mixedlub.schema.oil_file import KnownCoefficient, oil_of, overridden
from mixedlub.schema.toml_file import named_file
from profiles import SHIPPED_MARK, shipped
from profiles.errors import InputError
from profiles.profile import Profile

if TYPE_CHECKING:
    from profiles.maps import HeightMap
    from roughness.assumed import AssumedMoments

LEAST_NAYAK = 1.5
"""Least m0 m4 / m2^2 of an isotropic Gaussian surface; Nayak 1971."""
LEAST_SPAN = 30.0
"""Judgement. Temperature difference (K) below which rounding to 0.1 1/GPa would change the slope."""
DEFAULT_BASE = "mineral"
"""Default base stock of an oil: most gear oils are mineral."""


@cache
def named_bases() -> dict[str, dict[str, Any]]:
    """Typical oils by base stock, each number with its source in the file."""
    return tomllib.loads(files("mixedlub.rig").joinpath("lubricants.toml").read_text(encoding="utf-8"))


def typical(section: system_file.Lubricant) -> dict[str, Any]:
    """Typical oil of the base stock, with pressure-viscosity by Gold's relation at the viscosities of the section."""
    base = dict(named_bases()[section.base or DEFAULT_BASE])
    at = section.kinematic_viscosity_mm2_s or base["kinematic_viscosity_mm2_s"]
    gold = base.pop("gold")
    if section.known_pressure_viscosity is not None:
        return base
    alpha = gold_pressure_viscosity(np.array(at) * 1e-6, *gold) * 1e9
    near = abs(np.subtract(*(section.temperature_C or base["temperature_C"]))) < LEAST_SPAN
    return {**base, "pressure_viscosity_per_GPa": alpha.round(4 if near else 1).tolist()}


def lubricant(section: system_file.Lubricant | None, unread: Collection[str] = (), folder: Path = Path()) -> Lubricant:
    """Lubricant of a section; missing values come from the base stock, with a warning.

    ``unread``: keys without warning, not used by the kind of recording; ``folder``: location of an oil file.
    """
    section = section or system_file.Lubricant()
    _report_oil(section, folder)
    words = ("name", "base", "oil", "traction")
    known = {k: v for k, v in section.model_dump().items() if v is not None and k not in words}
    base = typical(section)
    assumed = [key for key in base if key not in known and key != "source" and key not in unread]
    full = {**base, **known}
    t1, t2 = full["temperature_C"]
    nu1, nu2 = full["kinematic_viscosity_mm2_s"]
    if t1 == t2:
        raise InputError("the two temperatures must differ", where="lubricant.temperature_C", value=(t1, t2))
    if (nu2 - nu1) * (t2 - t1) >= 0:
        raise InputError(
            "viscosity must fall with temperature",
            where="lubricant.kinematic_viscosity_mm2_s",
            value=(nu1, nu2),
        )
    a1, a2 = full.get("pressure_viscosity_per_GPa", (0.0, 0.0))
    modulus = full.get("pressure_modulus_MPa")
    oil = Lubricant(
        name=section.name,
        temperature=(t1 + ZERO_CELSIUS, t2 + ZERO_CELSIUS),
        kinematic_viscosity=(nu1 * 1e-6, nu2 * 1e-6),
        pressure_viscosity=(a1 * 1e-9, a2 * 1e-9),
        density_15=full["density_15C_kg_m3"],
        density_change=full["density_change_per_K"],
        eyring_stress=full["eyring_stress_MPa"] * 1e6,
        conductivity=full["thermal_conductivity_W_mK"],
        heat_capacity=full["specific_heat_J_kgK"],
        pressure_modulus=None if modulus is None else (modulus[0] * 1e6, modulus[1] * 1e6),
        modulus_slope=full.get("pressure_modulus_slope"),
        traction=section.traction,
    )
    if section.known_pressure_viscosity is not None:
        oil = _carried(oil, section.known_pressure_viscosity, section.base or DEFAULT_BASE, unread)
    elif "pressure_viscosity_per_GPa" not in known:
        oil = oil.carrying(oil.pressure_viscosity[0], oil.temperature[0], ROELANDS, 0.0)
        base["pressure_viscosity_per_GPa"] = [round(1e9 * alpha, 1) for alpha in oil.pressure_viscosity]
    if assumed:
        stock = section.base or f"{DEFAULT_BASE} (assumed)"
        listed = ", ".join(f"{key} = {base[key]}" for key in assumed)
        report(finding("oil_typical", f"{listed} not given; taken as typical of base {stock}", "lubricant"))
    for one in doubts(oil, unread):
        report(one)
    return oil


def _carried(oil: Lubricant, known: KnownCoefficient, base: str, unread: Collection[str]) -> Lubricant:
    """Oil with its one known pressure-viscosity coefficient extended to other temperatures, with a finding."""
    at, (_, power) = known.temperature_C, named_bases()[base]["gold"]
    found = oil.carrying(known.coefficient_per_GPa * 1e-9, at + ZERO_CELSIUS, known.carried, power)
    if "pressure_viscosity_per_GPa" not in unread:
        way = "the exponent of Roelands" if known.carried == ROELANDS else f"Gold's exponent of base {base}"
        values = " and ".join(
            f"{alpha * 1e9:.3g} at {kelvin - ZERO_CELSIUS:g} °C"
            for alpha, kelvin in zip(found.pressure_viscosity, found.temperature, strict=True)
        )
        text = (
            f"pressure-viscosity coefficient of {found.name}, {known.coefficient_per_GPa:g} 1/GPa, known at {at:g} °C "
            f"alone; carried to other temperatures at {way}: {values}"
        )
        report(finding("coefficient_carried", text, "lubricant"))
    return found


def _report_oil(section: system_file.Lubricant, folder: Path) -> None:
    """Report section values that differ from the named oil, and oil values only typical of its class."""
    if section.oil is None:
        return
    stated = section.model_dump()
    other = overridden(stated, folder)
    if other:
        text = ", ".join(
            f"{name} {value} left out" if stated[name] is None else f"{name} = {stated[name]} in place of {value}"
            for name, value in other.items()
        )
        report(finding("oil_overridden", f"{text} of oil {section.oil}", "lubricant"))
    properties = oil_of(section.oil, folder).properties
    typical = [name for name, p in properties.items() if p.status == "typical" and p.entry(name)[0] not in other]
    if typical:
        text = f"{', '.join(typical)} of oil {section.oil} not printed by its source; typical of its class"
        report(finding("oil_typical", text, "lubricant"))


def traces(name: str, section: surface_file.SurfaceSection, folder: Path, key: str = "") -> tuple[Profile, ...]:
    """Traces named by a key of a surface, by default across its lay."""
    of_key = key or ("traces" if section.traces else "profile")
    named = getattr(section, key) if key else section.files
    return tuple(trace(name, section, one, folder, of_key) for one in named)


def trace(name: str, section: surface_file.SurfaceSection, named: str, folder: Path, key: str = "profile") -> Profile:
    """Trace named by a surface; errors name the surface."""
    from profiles.read import read

    place = f"surfaces.{name}"
    with _of_surface(name):
        if not named.startswith(SHIPPED_MARK):
            return read(named_file(folder, named, f"{place}.{key}"), unit=section.unit, spacing=section.spacing)
        for own in ("unit", "spacing"):
            if getattr(section, own) is not None:
                rule = "a shipped trace has its own; leave it out"
                raise InputError(rule, where=f"{place}.{own}", value=getattr(section, own))
        found = shipped(named, f"{place}.{key}")
    text = "a synthetic trace: only Ra, Rq and Rz are of a measured flank, its slopes and curvatures were chosen"
    report(finding("trace_synthetic", text, place))
    return found


@contextmanager
def _of_surface(name: str) -> Iterator[None]:
    """Add the surface to errors about a trace or its filters."""
    try:
        yield
    except InputError as error:
        if error.where.startswith("surfaces."):
            raise
        rule = error.rule.replace("as unit '", "as unit = '").replace("as spacing '", "as spacing = '")
        place = f"surfaces.{name}{'.' if error.where in ('unit', 'spacing') else ': '}{error.where}"
        raise InputError(rule, where=place, value=error.value) from None


def flank_profile(name: str, section: surface_file.SurfaceSection, trace: Profile) -> Profile:
    """Roughness profile of a trace, prepared as by `mixedlub profile`.

    Missing cut-offs are taken from the filters stated in the trace file, or else from ISO 4288 and ISO 3274. A short
    cut-off of fewer than two points is left out, since the trace does not resolve such waves.
    """
    from roughness import evaluation_profile

    short = None if section.short_cutoff_um is None else section.short_cutoff_um * 1e-6
    too_fine = short is not None and short < 2.0 * trace.spacing
    with _of_surface(name):
        profile = evaluation_profile(
            trace,
            form=section.form or "line",
            cutoff="auto" if section.cutoff_mm is None else section.cutoff_mm * 1e-3,
            short_cutoff=None if too_fine else short or "auto",
            edges=section.edges,
            outliers=section.outliers,
        )
    used = {"cutoff_mm": ("cutoff", 1e3, "ISO 4288"), "short_cutoff_um": ("short_cutoff", 1e6, "ISO 3274")}
    assumed = [
        f"{key} = {profile.cutoffs[cutoff] * factor:.4g} ({rule})"
        for key, (cutoff, factor, rule) in used.items()
        if getattr(section, key) is None and profile.cutoffs.get(cutoff) != trace.cutoffs.get(cutoff)
    ]
    if assumed:
        report(finding("cutoff_assumed", f"{', '.join(assumed)} assumed", f"surfaces.{name}"))
    if "short_cutoff" not in profile.cutoffs and "cutoff" not in trace.cutoffs:
        text = (
            f"short cut-off not applied: the spacing of the trace, {trace.spacing * 1e6:.3g} um, is too coarse, so "
            "slope and curvature are those of the spacing"
        )
        report(finding("short_cutoff_skipped", text, f"surfaces.{name}"))
    return profile


def filtered(name: str, section: surface_file.SurfaceSection, raw: tuple[Profile, ...]) -> Traces:
    """Traces with roughness profiles; all have the cut-offs of the first unless their files state cut-offs."""
    first = flank_profile(name, section, raw[0])
    of_all = _with_cutoffs(section, first)
    with collected() as found:
        others = [flank_profile(name, section if one.cutoffs else of_all, one) for one in raw[1:]]
    for one in dict.fromkeys(found):
        report(one)
    return Traces(raw, (first, *others))


def _with_cutoffs(section: surface_file.SurfaceSection, profile: Profile) -> surface_file.SurfaceSection:
    """Section with the cut-offs of a profile."""
    used = {"cutoff_mm": ("cutoff", 1e3), "short_cutoff_um": ("short_cutoff", 1e6)}
    known = {key: profile.cutoffs[name] * scale for key, (name, scale) in used.items() if name in profile.cutoffs}
    return section.model_copy(update=known)


def measured(name: str, section: surface_file.SurfaceSection, folder: Path, across: Traces | None) -> Measured:
    """Measured traces, with given traces across the lay, or measured map of a surface."""
    if across is None:
        return Measured(area=flank_map(name, section, folder), isotropic=section.lay == "isotropic")
    if section.traces_along is None:
        return Measured(across)
    raw = traces(name, section, folder, "traces_along")
    along = filtered(name, _with_cutoffs(section, across.filtered[0]), raw)
    return Measured(across, along)


def at_short_cutoff(
    name: str, section: surface_file.SurfaceSection, folder: Path, across: Traces | None, factor: float
) -> Measured | None:
    """Measured traces or map at a multiple of the short cut-off; None if it is not resolved or missing."""
    if across is None:
        from roughness.maps.prepare import SHORT_CUTOFF

        short = SHORT_CUTOFF * 1e6 if section.short_cutoff_um is None else section.short_cutoff_um
        other = section.model_copy(update={"short_cutoff_um": factor * short})
        with collected() as found:
            area = flank_map(name, other, folder)
        resolved = all(one.code != "short_cutoff_skipped" for one in found)
        return Measured(area=area, isotropic=section.lay == "isotropic") if resolved else None
    first, raw = across.filtered[0], across.raw[0]
    own = first.cutoffs.get("short_cutoff")
    long = first.cutoffs.get("cutoff", np.inf)
    if (
        own is None
        or "short_cutoff" in raw.cutoffs
        or not 2.0 * raw.spacing <= factor * own < min(long, raw.length / 2)
    ):
        return None
    other = _with_cutoffs(section, first).model_copy(update={"short_cutoff_um": factor * own * 1e6})
    return measured(name, other, folder, filtered(name, other, across.raw))


def flank_map(name: str, section: surface_file.SurfaceSection, folder: Path) -> HeightMap:
    """Roughness of a height map; default cut-offs are 0.8 mm and 2.5 um as far as they fit."""
    from profiles.maps import read_map
    from roughness.maps.prepare import prepared_map

    with _of_surface(name):
        file = named_file(folder, section.map or "", f"surfaces.{name}.map")
        area = read_map(file, unit=section.unit, spacing=section.spacing)
        rough = prepared_map(
            area,
            form=section.form or "line",
            cutoff=None if section.cutoff_mm is None else section.cutoff_mm * 1e-3,
            short_cutoff=None if section.short_cutoff_um is None else section.short_cutoff_um * 1e-6,
            holes=section.holes,
        )
    long, short = (rough.cutoffs.get(key) for key in ("cutoff", "short_cutoff"))
    if doubtful := area.origin.get("units_doubtful"):
        report(finding("value_unusual", str(doubtful), f"surfaces.{name}"))
    holes = int(np.count_nonzero(~np.isfinite(area.heights)))
    if holes:
        treated = "are filled from their rims" if section.holes == "fill" else "are left out of its moments"
        text = (
            f"{holes} of {area.heights.size} points ({100 * area.holes:.2g} %) of the map have no height and {treated}"
        )
        report(finding("trace_quality", text, f"surfaces.{name}"))
    said = "no cut-off, as the map is shorter than 0.8 mm" if long is None else f"cutoff_mm = {long * 1e3:g}"
    said += "" if short is None else f", short_cutoff_um = {short * 1e6:g}"
    if section.cutoff_mm is None or section.short_cutoff_um is None:
        report(finding("cutoff_assumed", f"{said} assumed for the map", f"surfaces.{name}"))
    if short is None:
        coarse = max(area.spacing_x, area.spacing_y) * 1e6
        text = f"short cut-off not applied: the spacing of the map, {coarse:.3g} um, is too coarse"
        report(finding("short_cutoff_skipped", text, f"surfaces.{name}"))
    return rough


def _check(name: str, across: Traces) -> None:
    """Report doubts about traces."""
    from roughness import moments
    from roughness.guards import trace_warnings

    with _of_surface(name):
        texts = [t for raw, one in zip(across.raw, across.filtered) for t in trace_warnings(one, moments(one), raw=raw)]
    doubtful = {one.origin.get("units_doubtful") for one in across.raw}
    for text in dict.fromkeys(texts):
        report(finding("value_unusual" if text in doubtful else "trace_quality", text, f"surfaces.{name}"))


def surface(name: str, section: surface_file.SurfaceSection, found: Measured | None = None) -> Surface:
    """Surface from its moments or from measured traces or map."""
    values: dict[str, float]
    alone = assumed(name, section)
    if alone is not None:
        values = {"m0": alone.m0, "m2": alone.m2, "m4": alone.m4}
        ends = {key: alone.ends(key) for key in ("m2", "m4")}
        band = f"m2 {_span(ends['m2'])}, m4 {_span([end * 1e-12 for end in ends['m4']])} 1/um2"
        report(finding("moments_assumed", f"{alone.words}; bands: {band}", f"surfaces.{name}"))
    elif found is None:
        m0, m2, m4 = section.m0_um2 or 0.0, section.m2 or 0.0, section.m4_per_um2 or 0.0
        values = {"m0": m0 * 1e-12, "m2": m2, "m4": m4 * 1e12}
        if section.m2_along is not None and section.m4_along_per_um2 is not None:
            values |= {"m2_along": section.m2_along, "m4_along": section.m4_along_per_um2 * 1e12}
    else:
        with _of_surface(name):
            values = dict(found.values())
        if found.across is not None:
            _check(name, found.across)
    coating = section.coating
    made = Surface(
        name=name,
        **values,
        lay=section.lay or ("transverse" if section.has_two_directions else None),
        peklenik=None if found is None else found.peklenik,
        mean_over_rms=None if found is None else found.mean_over_rms,
        coating_thickness=0.0 if coating is None else coating.thickness_um * 1e-6,
        coating_conductivity=2.0 if coating is None else coating.thermal_conductivity_W_mK,
        conductivity=section.thermal_conductivity_W_mK,
        density=section.density_kg_m3,
        heat_capacity=section.specific_heat_J_kgK,
        steps=() if found is None else found.steps,
        cutoff=None if found is None else found.cutoffs.get("cutoff"),
        short_cutoff=None if found is None else found.cutoffs.get("short_cutoff"),
        profiles=() if found is None or found.across is None else found.across.filtered,
    )
    if made.bandwidth < LEAST_NAYAK:
        text = f"Nayak alpha is {made.bandwidth:.2f}, below the 1.5 of any isotropic Gaussian surface"
        report(finding("nayak_below_limit", text, f"surfaces.{name}"))
    return made


def assumed(name: str, section: surface_file.SurfaceSection) -> AssumedMoments | None:
    """Moments of a surface by Ra, Rq or Rz alone; None for any other surface."""
    from roughness.assumed import assumed_moments

    if section.one_number is None:
        return None
    with _of_surface(name):
        return assumed_moments(*section.one_number)


def _span(ends: Sequence[float]) -> str:
    return " to ".join(f"{end:.2g}" for end in ends)


def check_bandwidth(surface: Surface, section: surface_file.SurfaceSection) -> None:
    """Raise an error for stated moments below Nayak's limit; traces may be sampled coarsely, and are flagged."""
    if not section.is_measured and section.one_number is None and surface.bandwidth < LEAST_NAYAK:
        rule = (
            f"Nayak's m0 m4 / m2^2 is {surface.bandwidth:.3g}, and no isotropic Gaussian surface has less than 1.5; "
            "check the units of m0_um2 and m4_per_um2, and that all three are of one short cut-off"
        )
        raise InputError(rule, where=f"surfaces.{surface.name}")
