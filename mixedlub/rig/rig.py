"""A rig with the parts described in a file, each built once."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
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
    """Gears, load sharing, oil and surfaces of a file; files of a part are read from ``folder`` at its first use.

    Assumptions for a part are reported at each use. ``unread_of_oil``: oil keys not used by the kind of recording,
    which are not reported.
    """

    file: RigFile
    folder: Path
    unread_of_oil: tuple[str, ...] = ()
    _built: dict[Hashable, tuple[Any, list[Finding]]] = field(default_factory=dict, repr=False)

    @property
    def gears(self) -> GearPair:
        """Gear pair, only for files with gears."""
        assert self.file.gears is not None
        section = self.file.gears
        return self._once("gears", lambda: gear_build.gear_pair(section))

    @property
    def sharing(self) -> Sharing:
        """Load sharing between the tooth pairs in contact."""
        assert self.file.gears is not None
        section = self.file.gears.load_sharing
        return self._once("sharing", lambda: gear_build.sharing(section, self.folder))

    def mesh(self, points: int, slices: int | None = None) -> Mesh:
        """Contact points of a tooth pair along its path."""
        return self._once(
            ("mesh", points, slices), lambda: mesh(self.gears, self.sharing, points=points, slices=slices)
        )

    def oil(self) -> Lubricant:
        """Lubricant."""
        return self._once("oil", lambda: build.lubricant(self.file.lubricant, self.unread_of_oil, self.folder))

    def trace(self, name: str) -> Profile:
        """First measured trace of a surface, as in its file."""
        return self._traces(name)[0]

    def _traces(self, name: str) -> tuple[Profile, ...]:
        """Measured traces; on a surface with a lay, the traces across it."""
        return self._once(("traces", name), lambda: build.traces(name, self.file.surfaces[name], self.folder))

    def _filtered(self, name: str) -> Traces:
        """Traces of a surface with roughness profiles."""
        section = self.file.surfaces[name]
        return self._once(("filtered", name), lambda: build.filtered(name, section, self._traces(name)))

    def profile(self, name: str) -> Profile:
        """Filtered roughness profile of the first trace of a surface."""
        return self._filtered(name).filtered[0]

    def measured(self, name: str) -> Measured:
        """Filtered traces or map of a measured surface."""
        section = self.file.surfaces[name]
        across = self._filtered(name) if section.files else None
        return self._once(("measured", name), lambda: build.measured(name, section, self.folder, across))

    def axes(self, name: str) -> tuple[Mapping[str, float], ...]:
        """Changes of the logarithms of the moments at the ends of their scatter or assumed band, by axis."""
        alone = build.assumed(name, self.file.surfaces[name])
        return self.measured(name).axes(name) if alone is None else alone.axes

    def freedom(self, name: str) -> tuple[tuple[int, int], ...]:
        """Number of axes of `axes` that share their degrees of freedom, and these; 0 where an assumption sets them."""
        alone = build.assumed(name, self.file.surfaces[name])
        return self.measured(name).freedom if alone is None else tuple((1, 0) for _ in alone.axes)

    def surface(self, name: str) -> Surface:
        """Surface from its moments, traces or map."""
        section = self.file.surfaces[name]

        def built() -> Surface:
            return build.surface(name, section, self.measured(name) if section.is_measured else None)

        return self._once(("surface", name), built)

    def at_short_cutoff(self, name: str, factor: float) -> Surface:
        """Measured surface at a multiple of its short cut-off; unchanged without a cut-off or if unresolved.

        Findings are reported with the surface itself.
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
        """All parts described in the file; an error names the first part that cannot be built."""
        if self.file.gears is not None:
            yield from (self.gears, self.sharing)
        if self.file.lubricant is not None:
            yield self.oil()
        yield from map(self.surface, self.file.surfaces)

    def _once(self, key: Hashable, make: Callable[[], Part]) -> Part:
        """Part, built at its first use; its findings are reported at every use."""
        if key not in self._built:
            with collected() as found:
                part = make()
            self._built[key] = part, found
        part, found = self._built[key]
        for one in found:
            report(one)
        return part
