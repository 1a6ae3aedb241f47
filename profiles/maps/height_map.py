"""The height map: heights on a grid, and the steps of their processing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from profiles.errors import InputError
from profiles.profile import frozen

MAX_PIXELS = 200_000_000


@dataclass(frozen=True, eq=False)
class HeightMap:
    """Heights (m) on a grid, rows along y and columns along x, with their two spacings (m); nan where missing.

    ``cutoffs``: wavelengths of the applied filters (m), by the names of a profile; ``steps``: processing of the
    heights, in order; ``origin``: statements of the file about itself, keys as for a profile.
    """

    heights: np.ndarray
    spacing_x: float
    spacing_y: float
    name: str = "map"
    cutoffs: Mapping[str, float] = field(default_factory=dict)
    steps: tuple[str, ...] = ()
    origin: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        heights = frozen(self.heights, float)
        if heights.ndim != 2 or min(heights.shape) < 2 or heights.size > MAX_PIXELS:
            raise InputError("a height map has rows and columns", where=f"map {self.name!r}", value=heights.shape)
        if not all(math.isfinite(s) and s > 0 for s in (self.spacing_x, self.spacing_y)):
            raise InputError("both spacings must be above zero", where=f"map {self.name!r}")
        object.__setattr__(self, "heights", heights)

    @property
    def size(self) -> tuple[float, float]:
        """Width and depth from the first point to the last (m)."""
        rows, columns = self.heights.shape
        return (columns - 1) * self.spacing_x, (rows - 1) * self.spacing_y

    @property
    def holes(self) -> float:
        """Share of the points without a height.

        >>> HeightMap(np.array([[0.0, np.nan], [1.0, 2.0]]), 1e-6, 1e-6).holes
        0.25
        """
        return 1.0 - float(np.count_nonzero(np.isfinite(self.heights))) / self.heights.size
