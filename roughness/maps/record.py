"""One map, evaluated: the areal part of its row in ``profile.json``."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict

import numpy as np

from profiles import InputError
from profiles.maps import HeightMap
from roughness.maps.heights import height_parameters, hybrid_parameters
from roughness.maps.material import material_parameters
from roughness.maps.moments import areal_moments
from roughness.maps.texture import texture_direction, texture_parameters
from roughness.mccool import nayak_parameter, summit_density, summit_radius, summit_sigma

LAID = 0.5
"""Judgement. Aspect ratio Str above which a surface has no clear lay; ISO 25178-2 calls it near 1 isotropic."""
FEW_HOLES = 0.05
"""Judgement. Share of holes from which a map is doubted: steep places are missing first."""
_IN_PERCENT = ("Smr1", "Smr2")


def map_record(area: HeightMap, raw: HeightMap) -> dict[str, object]:
    """Areal parameters of an evaluated map, with the map as read; units in the names, None for undefined values."""
    warnings = [*_of_origin(raw), *_of_preparation(area, raw)]
    hybrid, material = hybrid_parameters(area), material_parameters(area)
    found: dict[str, object] = {
        **{
            name: value if name in ("Ssk", "Sku") else value * 1e6
            for name, value in asdict(height_parameters(area)).items()
        },
        **_spatial(area, warnings),
        "Sdq": hybrid.Sdq,
        "Sdr": 100.0 * hybrid.Sdr,
    }
    core = ("Sk", "Spk", "Svk", "Smr1", "Smr2")
    for name, value in asdict(material).items():
        if name == "s_shaped":
            continue
        defined = material.s_shaped or name not in core
        found[name] = (value if name in _IN_PERCENT else value * 1e6) if defined else None
    if not material.s_shaped:
        warnings.append("the material ratio curve has no S shape: the Sk family is undefined")
    return {
        "points": list(raw.heights.shape),
        "spacing_um": [raw.spacing_x * 1e6, raw.spacing_y * 1e6],
        "size_mm": [length * 1e3 for length in raw.size],
        "holes_percent": 100.0 * raw.holes,
        "cutoff_mm": _scaled(area.cutoffs.get("cutoff"), 1e3),
        "short_cutoff_um": _scaled(area.cutoffs.get("short_cutoff"), 1e6),
        "steps": list(area.steps),
        "parameters": {f"{name}{_UNITS.get(name, '')}": value for name, value in found.items()},
        "moments": _moments(area),
        "warnings": warnings,
    }


_UNITS = {
    **dict.fromkeys(
        ("Sa", "Sq", "Sz", "Sp", "Sv", "Sal", "Sk", "Spk", "Svk", "Sxp", "Vmp", "Vmc", "Vvc", "Vvv"), "_um"
    ),
    **dict.fromkeys(("Sdr", "Smr1", "Smr2"), "_percent"),
    "Std": "_deg",
}


def _spatial(area: HeightMap, warnings: list[str]) -> dict[str, object]:
    """Spatial parameters; a map without a correlation length leaves them undefined, with a warning."""
    direction = texture_direction(area)
    try:
        texture = texture_parameters(area)
    except InputError as error:
        warnings.append(f"Sal and Str are undefined: {error.rule}")
        return {"Sal": None, "Str": None, "Std": math.degrees(direction)}
    if texture.is_bound:
        warnings.append(
            f"Str is at most {texture.Str:.2g}: along the lay the correlation stays above 0.2 over half of the map"
        )
    elif texture.Str > LAID:
        warnings.append(f"Str is {texture.Str:.2g}: the surface has no clear lay, and Std says little")
    return {"Sal": texture.Sal * 1e6, "Str": texture.Str, "Std": math.degrees(direction)}


def _moments(area: HeightMap) -> dict[str, float]:
    """Moments across and along the lay, and the asperities of the isotropic surface with their geometric means."""
    found = areal_moments(area)
    across, along = found.profile(found.across_lay), found.profile(found.across_lay + 0.5 * math.pi)
    m0, m2, m4 = found.m00, math.sqrt(across.m2 * along.m2), math.sqrt(across.m4 * along.m4)
    return {
        "m0_um2": m0 * 1e12,
        "m2": across.m2,
        "m4_per_um2": across.m4 * 1e-12,
        "m2_along": along.m2,
        "m4_along_per_um2": along.m4 * 1e-12,
        "across_lay_deg": math.degrees(found.across_lay),
        "anisotropy": found.anisotropy,
        "density_per_mm2": float(summit_density(m2, m4)) * 1e-6,
        "radius_um": float(summit_radius(m4)) * 1e6,
        "sigma_um": float(summit_sigma(m0, m2, m4)) * 1e6,
        "nayak": float(nayak_parameter(m0, m2, m4)),
    }


def _of_origin(raw: HeightMap) -> Iterator[str]:
    if "units_overruled" in raw.origin:
        yield f"units: {raw.origin['units_overruled']}"
    if "units_doubtful" in raw.origin:
        yield str(raw.origin["units_doubtful"])


def _of_preparation(area: HeightMap, raw: HeightMap) -> Iterator[str]:
    if raw.holes > 0.0:
        points = int(np.count_nonzero(~np.isfinite(raw.heights)))
        share = f"{points} of {raw.heights.size} points ({100 * raw.holes:.2g} %) have no height"
        steep = ": steep places are missing first, so slopes come out low" if raw.holes > FEW_HOLES else ""
        treated = "are filled from their rims" if np.isfinite(area.heights).all() else "are left out"
        yield f"{share} and {treated}{steep}"
    if "cutoff" not in area.cutoffs:
        yield "no cut-off: heights contain waviness and what is left of the form"
    if "short_cutoff" not in area.cutoffs:
        coarse = max(area.spacing_x, area.spacing_y) * 1e6
        yield f"no short cut-off: slopes and curvatures are set by the spacing of {coarse:.3g} um, not by the surface"


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor
