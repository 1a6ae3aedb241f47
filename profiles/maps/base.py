"""The checks that all readers of height maps share."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from profiles.errors import InputError
from profiles.maps.height_map import MAX_PIXELS, HeightMap
from profiles.readers.base import Source
from profiles.readers.plausible import doubt
from profiles.units import metres

FEWEST_COLUMNS = 16
"""Grid. Fewest columns of numbers in a text that are taken for a map; fewer are columns of a table."""

STEPS = (5e-11, 5e-4)
"""Judgement. Usual steps of maps (m), from atomic force microscopes to fringe projection."""


def make_map(
    source: Source,
    heights: np.ndarray,
    spacings: tuple[float, float],
    origin: Mapping[str, object],
    *,
    units: tuple[str, str] = ("m", "m"),
    steps: tuple[str, ...] = (),
) -> HeightMap:
    """The map of a file, from heights and spacings (x, y) in the units of place and height, checked and in metres.

    Missing heights are nan; units told by the caller overrule the file.
    """
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != 2 or min(heights.shape) < 2:
        raise InputError("holds no regular height map", where=source.where, value=heights.shape)
    if heights.size > MAX_PIXELS:
        raise InputError(f"a map has at most {MAX_PIXELS} points", where=source.where, value=heights.shape)
    kept = dict(origin)
    if source.unit is not None and source.unit != units:
        own, told = (f"place {place}, height {height}" for place, height in (units, source.unit))
        kept["units_overruled"] = f"the file has {own}, taken as {told} as told"
        units = source.unit
    place, height = (metres(unit) for unit in units)
    x, y = (abs(float(step)) * place for step in spacings)
    if not all(math.isfinite(step) and 1e-12 < step < 1.0 for step in (x, y)):
        raise InputError("both spacings must lie between 1 pm and 1 m", where=source.where, value=(x, y))
    heights = np.where(np.isfinite(heights), heights, np.nan) * height
    if not np.isfinite(heights).any():
        raise InputError("no point of the map has a height", where=source.where)
    if not np.nanmax(np.abs(heights)) < 1.0:
        raise InputError("heights must be below 1 m", where=source.where, value=float(np.nanmax(np.abs(heights))))
    if strange := doubt(x, heights, units, steps=STEPS, kind="map"):
        by = "by the file" if source.unit is None else "as told"
        kept["units_doubtful"] = f"place {units[0]}, height {units[1]} {by}: {strange}"
    return HeightMap(heights, x, y, source.name, steps=steps, origin={"file": source.where, **kept})


def own_steps(source: Source) -> None:
    """Raise an error for a step from the caller where the file has steps of its own."""
    if source.spacing is not None:
        raise InputError("a height map has steps of its own", where="spacing", value=source.spacing)
