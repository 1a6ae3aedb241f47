"""Measured surface: filtered traces or height map, with the scatter of moments over the surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.rig.surface import Surface
from profiles.errors import InputError
from profiles.profile import Profile

if TYPE_CHECKING:
    from profiles.maps import HeightMap
    from roughness import Moments

LEVEL = 0.9
"""Probability of the true value in a band of the scatter."""
ACROSS, ALONG = ("m0", "m2", "m4"), ("m2_along", "m4_along")
FEWEST = 3
"""Fewest traces or sampling lengths for an estimate of scatter."""
TILES = 3
"""Parts per side of a map; their scatter is the scatter of the map."""


@dataclass(frozen=True, eq=False)
class Traces:
    """Traces in one direction, as read and filtered."""

    raw: tuple[Profile, ...]
    filtered: tuple[Profile, ...]

    @property
    def moments(self) -> Moments:
        """Mean of the moments."""
        from roughness import moments
        from roughness.lay import mean_moments

        return mean_moments([moments(one) for one in self.filtered])

    def samples(self) -> np.ndarray:
        """m0, m2 and m4 of each trace; with fewer than three traces, of each sampling length."""
        from roughness import moments
        from roughness.parameters import section_count

        parts = list(self.filtered)
        if len(parts) < FEWEST:
            parts = [part for one in parts for part in _cut(one, section_count(one))]
        return np.array([(m.m0, m.m2, m.m4) for m in map(moments, parts)])


def _cut(profile: Profile, count: int) -> list[Profile]:
    heights, valid = (np.array_split(values, count) for values in (profile.heights, profile.valid))
    return [Profile(z, profile.spacing, valid=v) for z, v in zip(heights, valid)]


@dataclass(frozen=True, eq=False)
class Measured:
    """Measured data of a surface: traces across (or in one direction), traces along, or a filtered map."""

    across: Traces | None = None
    along: Traces | None = None
    area: HeightMap | None = None
    isotropic: bool = False

    def values(self) -> Mapping[str, float]:
        """Moments by the fields of a surface, along the lay only if known."""
        if self.area is not None:
            return self._of_map(self.area)
        assert self.across is not None
        found = self.across.moments
        values = {"m0": found.m0, "m2": found.m2, "m4": found.m4}
        if self.along is None:
            return values
        beside = self.along.moments
        return values | {"m2_along": beside.m2, "m4_along": beside.m4}

    @property
    def mean_over_rms(self) -> float:
        """Measured Ra over Rq: mean height of the sampling lengths of all traces, or of the map, over its rms."""
        from roughness.parameters import evaluation_length

        if self.area is not None:
            heights = self.area.heights[np.isfinite(self.area.heights)]
            return float(np.abs(heights - heights.mean()).mean() / heights.std())
        assert self.across is not None
        parts = [evaluation_length(one) for one in self.across.filtered]
        ra = float(np.mean([np.abs(one.heights[one.valid]).mean() for one in parts]))
        return ra / self.across.moments.m0**0.5

    def axes(self, name: str) -> tuple[Mapping[str, float], ...]:
        """Changes of the logarithms of the moments at the ends of their scatter bands, by axis."""
        from roughness.lay import mean_axes

        found: list[Mapping[str, float]] = []
        for keys, samples, least in self._scatter:
            if len(samples) < FEWEST:
                rule = (
                    "the scatter needs three traces in each direction, or traces of three sampling lengths; "
                    f"here are {len(samples)}: give more traces"
                )
                raise InputError(rule, where=f"surfaces.{name}")
            found += [dict(zip(keys, row, strict=True)) for row in mean_axes(samples, LEVEL, least).tolist()]
        return tuple(found)

    @property
    def freedom(self) -> tuple[tuple[int, int], ...]:
        """Number of axes of each direction of traces or of the map, and their degrees of freedom."""
        return tuple((len(keys), len(samples) - 1) for keys, samples, _ in self._scatter)

    @cached_property
    def _scatter(self) -> list[tuple[Sequence[str], np.ndarray, np.ndarray | float]]:
        """Moments by name, their values in each trace or part of the map, and lower bounds on their scatter."""
        groups: list[tuple[Sequence[str], np.ndarray, np.ndarray | float]] = []
        if self.area is not None:
            from roughness.maps.moments import tiles

            rows = [self._of_map(part) for part in tiles(self.area, TILES)]
            groups.append(
                (tuple(rows[0]), np.array([list(row.values()) for row in rows]), self._least_scatter(self.area))
            )
        if self.across is not None:
            groups.append((ACROSS, self.across.samples(), 0.0))
        if self.along is not None:
            groups.append((ALONG, self.along.samples()[:, 1:], 0.0))
        return groups

    @cached_property
    def _angle(self) -> float:
        """Direction across the lay of a map (rad from its x axis)."""
        from roughness.maps.moments import areal_moments

        assert self.area is not None
        return areal_moments(self.area).across_lay

    def _of_map(self, area: HeightMap) -> Mapping[str, float]:
        """Moments of a map or part of it, across and along its lay; without a lay, means of both directions."""
        from roughness.maps.moments import areal_moments

        found = areal_moments(area)
        across, along = found.profile(self._angle), found.profile(self._angle + 0.5 * np.pi)
        if self.isotropic:
            return {"m0": across.m0, "m2": 0.5 * (across.m2 + along.m2), "m4": 0.5 * (across.m4 + along.m4)}
        return {"m0": across.m0, "m2": across.m2, "m4": across.m4, "m2_along": along.m2, "m4_along": along.m4}

    def _least_scatter(self, area: HeightMap) -> np.ndarray:
        """Relative standard deviations of `_of_map` for Gaussian heights: parts with common waves scatter less."""
        from roughness.maps.moments import gaussian_scatter

        across, along = self._angle, self._angle + 0.5 * np.pi
        if self.isotropic:
            return gaussian_scatter(area, across, along)
        return np.concatenate([gaussian_scatter(area, across), gaussian_scatter(area, along)[1:]])

    @property
    def by_lengths(self) -> bool:
        """Whether the scatter is of sampling lengths, since traces are too few."""
        return any(one is not None and len(one.filtered) < FEWEST for one in (self.across, self.along))

    def profile(self) -> Profile:
        """Filtered heights across the lay as one profile; for a map, its longest trace across the lay."""
        if self.area is not None:
            from profiles.image import along_direction

            return along_direction(self.area, self._angle)
        assert self.across is not None
        first, *others = self.across.filtered
        if not others:
            return first
        heights = np.concatenate([one.heights - one.heights[one.valid].mean() for one in self.across.filtered])
        return replace(first, heights=heights, valid=np.concatenate([one.valid for one in self.across.filtered]))

    def heights(self) -> np.ndarray:
        """Filtered heights of the map or of the traces across the lay (m)."""
        if self.area is not None:
            return self.area.heights[np.isfinite(self.area.heights)]
        profile = self.profile()
        return profile.heights[profile.valid]

    @property
    def cutoffs(self) -> Mapping[str, float]:
        """Cut-offs of the filters applied to the map or the traces across the lay (m)."""
        if self.area is not None:
            return self.area.cutoffs
        assert self.across is not None
        return self.across.filtered[0].cutoffs

    @property
    def steps(self) -> tuple[str, ...]:
        """Processing steps of the first trace; empty for a map."""
        return () if self.across is None else self.across.filtered[0].steps

    @property
    def peklenik(self) -> float | None:
        """Correlation length across over along the lay, for traces in both directions."""
        from roughness.lay import peklenik_number

        if self.across is None or self.along is None:
            return None
        return peklenik_number(self.across.filtered, self.along.filtered)


def moved(surface: Surface, axis: Mapping[str, float], sign: float) -> Surface:
    """Surface at one end of an axis of its scatter.

    >>> one = Surface("a", 1e-14, 1e-3, 1e9, 0.0, 0.0, 46.0, 7800.0, 470.0)
    >>> moved(one, {"m2": 0.1}, -1.0).m2 < one.m2
    True
    """
    changed: dict[str, Any] = {key: getattr(surface, key) * float(np.exp(sign * step)) for key, step in axis.items()}
    return replace(surface, **changed)
