"""Traces of a map across and along its lay."""

from __future__ import annotations

import math
from dataclasses import replace

from profiles import Profile
from profiles.image import along_direction
from profiles.maps import HeightMap
from roughness.maps.moments import areal_moments
from roughness.maps.prepare import areal_roughness


def trace_across_lay(area: HeightMap) -> Profile:
    """Longest trace through the middle of a map in the direction of its steepest slopes, across its lay.

    >>> import numpy as np
    >>> y, x = np.mgrid[0:40, 0:60]
    >>> trace_across_lay(HeightMap(1e-7 * np.cos(x), 1e-6, 1e-6)).heights.size
    60
    """
    return trace_at(area, areal_moments(areal_roughness(area)).across_lay, "across")


def trace_at(area: HeightMap, angle: float, which: str) -> Profile:
    """Longest trace through the middle of a map at an angle (rad) to its rows, across or along the lay."""
    trace = along_direction(area, angle)
    said = (
        f"{which} the lay of a map of {' x '.join(map(str, area.heights.shape))} points, at {math.degrees(angle):.3g}"
    )
    return replace(trace, steps=(*trace.steps, f"{said} degrees to its rows"))
