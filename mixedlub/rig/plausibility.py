"""Plausibility checks of a case or study: numbers, traces and load shares possible but unlike any rig."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from mixedlub.laws.film import ELLIPTICITY, ellipticity
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import Surface
from mixedlub.schema import ranges, surface_file
from mixedlub.schema.findings import Finding, collected, finding
from mixedlub.schema.system_file import Contact, System
from profiles.errors import InputError

ELASTOMER = (0.3, 0.45)
"""Source: M. F. Ashby, Materials Selection in Mechanical Design, 4th ed. (2011). Largest modulus (GPa) of rubber and
foam, and least Poisson ratio of rubber."""
MOST_BACKLASH = 0.1
"""Judgement. Backlash over normal module; ISO/TR 10064-2 recommends at least 0.02 to 0.05 for industrial gears."""
BANDWIDTH = (1.0 - 1e-6, 1e5)
"""Nayak's m0 m4/m2^2: at least 1 for any profile (Cauchy and Schwarz), at most this for two scales 300 apart."""


def implausible(rig: Rig, surfaces: Collection[str] | None = None) -> Iterator[Finding]:
    """Findings on implausible parts of a rig, with the given or all surfaces."""
    yield from (one for one in ranges.unusual(rig.file) if not _of_elastomer(rig, one))
    if rig.file.gears is not None:
        yield from rig.sharing.check(rig.gears)
        yield from _backlash(rig)
    if isinstance(rig.file, System) and rig.file.contact is not None:
        yield from _ellipticity(rig.file.contact)
    for name in rig.file.surfaces if surfaces is None else surfaces:
        found = _surface(rig, name)
        if found is not None:
            yield from _roughness(found, f"surfaces.{name}", rig.file.surfaces[name])


def _of_elastomer(rig: Rig, found: Finding) -> bool:
    """Whether a finding doubts the small modulus of a nearly incompressible body, such as rubber."""
    contact = rig.file.contact if isinstance(rig.file, System) else None
    if contact is None or not found.place.startswith("contact.youngs_modulus_GPa"):
        return False
    both = zip(contact.youngs_modulus_GPa, contact.poisson_ratio, strict=True)
    return all(e > ELASTOMER[0] or nu >= ELASTOMER[1] for e, nu in both)


def _backlash(rig: Rig) -> Iterator[Finding]:
    """Finding on a centre distance with large backlash for the profile shifts."""
    pair = rig.gears
    if pair.centre_distance is not None and pair.backlash > MOST_BACKLASH * pair.normal_module:
        text = (
            f"{pair.backlash * 1e3:.3g} mm of backlash, {pair.backlash / pair.normal_module:.2g} of the "
            "module, for these profile shifts: check both"
        )
        yield finding("backlash_large", text, "gears.centre_distance_mm")


def _ellipticity(contact: Contact) -> Iterator[Finding]:
    """Finding on a point contact with an ellipse outside the range of the base model's film law."""
    if contact.geometry != "point" or contact.transverse_radius_mm is None:
        return
    along, across = (_reduced(radii) for radii in (contact.radius_mm, contact.transverse_radius_mm))
    found, (low, high) = float(ellipticity(along, across)), ELLIPTICITY
    if not low <= found <= high:
        text = f"the film law of Hamrock and Dowson holds for ellipticities of {low:g} to {high:g}, here {found:.3g}"
        yield finding("law_extrapolated", text, "contact.transverse_radius_mm")


def _reduced(radii: tuple[float, float]) -> np.ndarray:
    return np.asarray(1.0 / sum(1.0 / r for r in radii))


def _surface(rig: Rig, name: str) -> Surface | None:
    """Surface, or None if its trace cannot be read, which is an error in a computation only."""
    with collected():
        try:
            return rig.surface(name)
        except InputError:
            return None


def _roughness(surface: Surface, place: str, section: surface_file.SurfaceSection) -> Iterator[Finding]:
    """Findings on implausible moments of a trace, and on the three moments together."""
    if section.is_measured:
        moments = (("m0_um2", surface.m0 * 1e12), ("m2", surface.m2), ("m4_per_um2", surface.m4 * 1e-12))
        for key, value in moments:
            advice = "check the units, cut-offs and form of the measured heights"
            yield from ranges.atypical(f"surfaces.{key}", value, f"{place}, {key} as measured", advice)
    bandwidth = surface.m0 * surface.m4 / surface.m2**2
    if not BANDWIDTH[0] <= bandwidth <= BANDWIDTH[1]:
        text = (
            f"m0 m4/m2^2 is {bandwidth:.3g}, where surfaces have {BANDWIDTH[0]:g} to {BANDWIDTH[1]:g}: the three "
            "moments do not belong together, or one is in another unit"
        )
        yield finding("moments_inconsistent", text, place)
