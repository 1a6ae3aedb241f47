"""What of a case or study is far from any rig, though possible: its numbers, traces and load shares."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from mixedlub.gear import TableSharing
from mixedlub.rig import build
from mixedlub.rig.surface import Surface
from mixedlub.schema import ranges, system_file
from mixedlub.schema.table import CaseWarning
from profiles.errors import InputError

BANDWIDTH = (1.0 - 1e-6, 1e5)
"""Nayak's m0 m4/m2^2: no profile has less than 1 (Cauchy and Schwarz), none of two scales apart by 300 more."""
GRAVE_IMBALANCE = 0.1
"""Shares that add up to 1 within that are what gear programs give under tip relief, or round."""


@dataclass(frozen=True)
class Odd:
    """A sentence about something odd, and whether it questions every number that is computed."""

    text: str
    grave: bool = True


def far_off(file: system_file.RigFile, folder: Path, surfaces: Mapping[str, Surface] | None = None) -> Iterator[Odd]:
    """What is odd in a file; ``surfaces`` where they have been read already."""
    yield from map(Odd, ranges.unusual(file))
    if file.gears is not None:
        pair, share = build.gear_pair(file.gears), build.sharing(file.gears.load_sharing, folder)
        said = share.check(pair)
        grave = isinstance(share, TableSharing) and share.imbalance(pair) > GRAVE_IMBALANCE
        yield from (Odd(text, grave) for text in said)
    for name, section in file.surfaces.items():
        found = _surface(name, section, folder) if surfaces is None else surfaces.get(name)
        if found is not None:
            yield from map(Odd, _roughness(found, f"surfaces.{name}", section))


def _surface(name: str, section: system_file.SurfaceSection, folder: Path) -> Surface | None:
    """The surface; None where its trace cannot be read, which is told where it is computed with."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CaseWarning)
        try:
            return build.surface(name, section, folder)
        except InputError:
            return None


def _roughness(surface: Surface, place: str, section: system_file.SurfaceSection) -> Iterator[str]:
    """What is odd of the moments of a trace, and of three moments together."""
    if section.profile is not None:
        moments = (("m0_um2", surface.m0 * 1e12), ("m2", surface.m2), ("m4_per_um2", surface.m4 * 1e-12))
        said = (ranges.beyond_usual(f"surfaces.{key}", value, f"{place}: {key} of its trace") for key, value in moments)
        yield from filter(None, said)
    bandwidth = surface.m0 * surface.m4 / surface.m2**2
    if not BANDWIDTH[0] <= bandwidth <= BANDWIDTH[1]:
        yield (
            f"{place}: m0 m4/m2^2 is {bandwidth:.3g}, where surfaces have {BANDWIDTH[0]:g} to {BANDWIDTH[1]:g}: the "
            "three moments do not belong together, or one is in another unit"
        )
