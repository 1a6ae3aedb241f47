"""Profiles from pictures: a trace across an areal height map, and a curve digitised from a chart."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np

from profiles.errors import InputError
from profiles.maps.height_map import HeightMap
from profiles.profile import Profile
from profiles.readers.base import MAX_POINTS, foreign_parser


def across(area: HeightMap, start: tuple[float, float], end: tuple[float, float], *, order: int = 3) -> Profile:
    """Trace along the straight line between two places (x, y in m) of a map.

    Sampled at the finer of the two spacings, by splines of the given ``order`` (1 linear, 3 cubic); points next to
    missing heights are masked. A diagonal trace holds no waves shorter than two grid steps.

    >>> ramp = HeightMap(np.outer(np.ones(5), np.arange(9.0)) * 1e-6, 1e-6, 1e-6)
    >>> across(ramp, (0.0, 2e-6), (8e-6, 2e-6), order=1).heights[:3] * 1e6
    array([0., 1., 2.])
    """
    from scipy.ndimage import map_coordinates

    if order not in (1, 2, 3, 4, 5):
        raise InputError("the order of a spline is 1 to 5", where="order", value=order)
    where = f"map {area.name!r}"
    for place in (start, end):
        if not all(-1e-9 * full <= value <= full * (1 + 1e-9) for value, full in zip(place, area.size)):
            raise InputError(f"the place lies off the map of {area.size} m", where=where, value=place)
    length = math.dist(start, end)
    step = min(area.spacing_x, area.spacing_y)
    count = int(length / step + 1e-9) + 1
    if not 3 <= count <= MAX_POINTS:
        raise InputError("a trace needs at least three points", where=where, value=count)
    along = np.arange(count) * step / length
    columns = (start[0] + along * (end[0] - start[0])) / area.spacing_x
    rows = (start[1] + along * (end[1] - start[1])) / area.spacing_y
    missing = ~np.isfinite(area.heights)
    if missing.all():
        raise InputError("no point of the map has a height", where=where)
    filled = np.where(missing, area.heights[~missing].mean(), area.heights)
    z = map_coordinates(filled, (rows, columns), order=order, mode="nearest")
    absent = map_coordinates(missing.astype(float), (rows, columns), order=1, mode="nearest") > 1e-6
    if 2 * np.count_nonzero(absent) > count:
        raise InputError("more than half of the trace is missing", where=where, value=int(absent.sum()))
    if absent.any():
        index = np.arange(count)
        z = np.interp(index, index[~absent], z[~absent])
    said = f"trace across {area.name} from {_place(start)} to {_place(end)} um, spline order {order}"
    return Profile(z, step, name=f"{area.name} trace", steps=(said,), origin={"map": area.name}, valid=~absent)


def along_direction(area: HeightMap, angle: float, *, order: int = 3) -> Profile:
    """The longest trace through the middle of a map at an angle (rad) from the x axis.

    >>> bumps = HeightMap(np.outer(np.arange(5.0), np.ones(9)) * 1e-6, 1e-6, 1e-6)
    >>> round(along_direction(bumps, np.pi / 2).length * 1e6, 6)
    4.0
    """
    width, depth = area.size
    across_x, across_y = abs(math.cos(angle)), abs(math.sin(angle))
    reach = min(
        width / 2 / across_x if across_x > 1e-12 else math.inf, depth / 2 / across_y if across_y > 1e-12 else math.inf
    )
    dx, dy = reach * math.cos(angle), reach * math.sin(angle)
    return across(area, (width / 2 - dx, depth / 2 - dy), (width / 2 + dx, depth / 2 + dy), order=order)


def digitised(
    picture: np.ndarray | str | os.PathLike[str],
    *,
    box: tuple[int, int, int, int],
    x_range: tuple[float, float],
    z_range: tuple[float, float],
    colour: tuple[int, int, int] = (0, 0, 0),
    tolerance: float = 25.0,
    name: str = "digitised",
) -> Profile:
    """The curve of one colour in a chart, one point a pixel column.

    ``box`` is the plotting area in pixels (left, top, right, bottom); its edges stand for ``x_range`` and ``z_range``
    (m; left to right, bottom to top). Pixels within ``tolerance`` (CIELAB distance) of the ``colour`` (red, green,
    blue, 0 to 255) belong to the curve; grid lines of that colour and specks are dropped. The height of a column is the
    middle of its pixels; empty columns are bridged and masked. The error is half a pixel where the curve is flat and
    half its vertical run in a steep column; ``origin`` keeps the pixel's height.
    """
    from skimage import color, io, measure, util

    if isinstance(picture, str | os.PathLike):
        if not Path(picture).is_file():
            raise InputError("no such file", where=str(picture))
        with foreign_parser("image", Path(picture).name):
            picture = io.imread(os.fspath(picture))
    pixels = np.asarray(picture)
    if pixels.ndim == 2:
        pixels = color.gray2rgb(pixels)
    left, top, right, bottom = box
    if pixels.ndim != 3 or not (0 <= left < right <= pixels.shape[1] and 0 <= top < bottom <= pixels.shape[0]):
        raise InputError("the box must lie within the picture", where=name, value=box)
    if not (x_range[0] < x_range[1] and z_range[0] < z_range[1] and right - left >= 3):
        raise InputError("ranges must increase and the box be three pixels wide", where=name, value=(x_range, z_range))
    inside = util.img_as_float(pixels[top:bottom, left:right, :3])
    distance = color.deltaE_cie76(color.rgb2lab(inside), color.rgb2lab(np.array(colour) / 255.0))
    curve = distance < tolerance
    curve[curve.mean(axis=1) > 0.8, :] = False
    curve[:, curve.mean(axis=0) > 0.8] = False
    labels = measure.label(curve, connectivity=2)
    extent = {region.label: region.bbox[3] - region.bbox[1] for region in measure.regionprops(labels)}
    if not extent:
        raise InputError("no pixel of that colour in the box", where=name, value=colour)
    wide = [label for label, columns in extent.items() if columns >= 0.05 * max(extent.values())]
    curve = np.isin(labels, wide)
    present = curve.any(axis=0)
    if 2 * np.count_nonzero(present) < present.size:
        raise InputError("more than half of the columns hold no curve", where=name, value=int((~present).sum()))
    rows = np.arange(curve.shape[0])[:, None]
    middle = (curve * rows).sum(axis=0) / np.maximum(curve.sum(axis=0), 1)
    columns = np.arange(present.size)
    middle = np.interp(columns, columns[present], middle[present])
    pixel_height = (z_range[1] - z_range[0]) / (bottom - top)
    pixel_width = (x_range[1] - x_range[0]) / (right - left)
    z = z_range[1] - (middle + 0.5) * pixel_height
    said = f"digitised from a chart, pixel {pixel_width * 1e6:.4g} um x {pixel_height * 1e6:.4g} um"
    return Profile(
        z, pixel_width, name=name, steps=(said,), origin={"pixel_height_m": pixel_height}, valid=np.asarray(present)
    )


def _place(place: tuple[float, float]) -> str:
    return f"({place[0] * 1e6:.6g}, {place[1] * 1e6:.6g})"
