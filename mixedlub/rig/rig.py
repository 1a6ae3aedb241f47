"""A rig: the parts that the sections of a file describe, each built once and then kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from mixedlub.gear import GearPair, Mesh, Sharing, mesh
from mixedlub.gear import build as gear_build
from mixedlub.rig import build
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.measured import Measured, Traces
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import Finding, collected, report
from mixedlub.schema.system_file import RigFile
from profiles.profile import Profile

Part = TypeVar("Part")


@dataclass(frozen=True, eq=False)
class Rig:
    """Gears, load sharing, oil and surfaces of a file; what a part needs is read from ``folder`` when it is first used.

    Every use of a part reports what was assumed for it, as the first one did; nothing is reported of keys of the oil
    that the kind of recording leaves ``unread_of_oil``.
    """

    file: RigFile
    folder: Path
    unread_of_oil: tuple[str, ...] = ()
    _built: dict[Hashable, tuple[Any, list[Finding]]] = field(default_factory=dict, repr=False)

    @property
    def gears(self) -> GearPair:
        """The gear pair; only of files that have one."""
        assert self.file.gears is not None
        section = self.file.gears
        return self._once("gears", lambda: gear_build.gear_pair(section))

    @property
    def sharing(self) -> Sharing:
        """How the load divides between the tooth pairs in contact."""
        assert self.file.gears is not None
        section = self.file.gears.load_sharing
        return self._once("sharing", lambda: gear_build.sharing(section, self.folder))

    def mesh(self, points: int, slices: int | None = None) -> Mesh:
        """The contact points of a tooth pair along its path."""
        return self._once(
            ("mesh", points, slices), lambda: mesh(self.gears, self.sharing, points=points, slices=slices)
        )

    def oil(self) -> Lubricant:
        """The lubricant."""
        return self._once("oil", lambda: build.lubricant(self.file.lubricant, self.unread_of_oil, self.folder))

    def trace(self, name: str) -> Profile:
        """The measured trace of a surface, the first of several, as its file has it."""
        return self._traces(name)[0]

    def _traces(self, name: str) -> tuple[Profile, ...]:
        """The measured traces of a surface, those across its lay where it has one."""
        return self._once(("traces", name), lambda: build.traces(name, self.file.surfaces[name], self.folder))

    def _filtered(self, name: str) -> Traces:
        """The traces of a surface with their roughness profiles."""
        section = self.file.surfaces[name]
        return self._once(("filtered", name), lambda: build.filtered(name, section, self._traces(name)))

    def profile(self, name: str) -> Profile:
        """The filtered roughness profile of a surface that names traces, the first of several."""
        return self._filtered(name).filtered[0]

    def measured(self, name: str) -> Measured:
        """What was measured of a surface that names traces or a map, filtered."""
        section = self.file.surfaces[name]
        across = self._filtered(name) if section.files else None
        return self._once(("measured", name), lambda: build.measured(name, section, self.folder, across))

    def surface(self, name: str) -> Surface:
        """A surface, from its moments, or from its traces or map."""
        section = self.file.surfaces[name]

        def built() -> Surface:
            return build.surface(name, section, self.measured(name) if section.is_measured else None)

        return self._once(("surface", name), built)

    def at_short_cutoff(self, name: str, factor: float) -> Surface:
        """A measured surface at a multiple of its short cut-off; as it is where it has none or cannot show such waves.

        What there is to report of the surface is reported with the surface itself.
        """
        own = self.surface(name)
        section = self.file.surfaces[name]
        if not section.is_measured:
            return own

        def built() -> Surface:
            across = self._filtered(name) if section.files else None
            other = build.at_short_cutoff(name, section, self.folder, across, factor)
            return own if other is None else build.surface(name, section, other)

        with collected():
            return self._once(("short_cutoff", name, factor), built)

    def parts(self) -> Iterator[GearPair | Sharing | Lubricant | Surface]:
        """Every part that the file describes: an error names the first one that cannot be built."""
        if self.file.gears is not None:
            yield from (self.gears, self.sharing)
        if self.file.lubricant is not None:
            yield self.oil()
        yield from map(self.surface, self.file.surfaces)

    def _once(self, key: Hashable, make: Callable[[], Part]) -> Part:
        """A part, built at its first use; its findings are reported at every use."""
        if key not in self._built:
            with collected() as found:
                part = make()
            self._built[key] = part, found
        part, found = self._built[key]
        for one in found:
            report(one)
        return part
