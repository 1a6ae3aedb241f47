"""Maps in plain text: a matrix of heights, or rows of x, y and height on a grid."""

from __future__ import annotations

import re

import numpy as np

from profiles.errors import InputError
from profiles.maps.base import FEWEST_COLUMNS, make_map, own_steps
from profiles.maps.height_map import HeightMap
from profiles.readers.base import Source
from profiles.readers.numbers import Table, decoded, is_absent, row_of, split, table
from profiles.readers.text import cell_unit, header_settings
from profiles.units import known_length, known_unit

NAME = "text"
FORMAT = "plain text: a matrix of heights, or x, y, height"
SETTINGS = {
    "height unit": ("unit", "units", "z unit", "height unit", "value units", "werteeinheiten"),
    "place unit": ("x unit", "position unit"),
    "step": ("spacing", "step", "increment", "sampling interval", "point distance"),
    "step x": ("x spacing", "spacing x", "dx", "x step", "x increment"),
    "step y": ("y spacing", "spacing y", "dy", "y step", "y increment"),
    "width": ("width", "breite"),
    "depth": ("depth", "height", "höhe"),
}
"""Words of a header by meaning; width and height of a map as Gwyddion writes them above a matrix."""
_NEVER = re.compile(r"\W*(channel|kanal)\b", re.IGNORECASE)


def is_map(columns: np.ndarray) -> bool:
    """Whether columns of numbers are a map: many columns, or three with the places of a grid in the first two."""
    return columns.shape[0] >= FEWEST_COLUMNS or (columns.shape[0] == 3 and _grid(columns) is not None)


def magic(source: Source) -> bool:
    """Whether the content can be text."""
    head = source.data[:4096]
    return head[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\x00" not in head


def read(source: Source) -> HeightMap:
    """The map of a matrix of heights, or of rows x, y, height; units and steps by the header or the caller.

    A map without units or steps is refused: a wrong guess would be a wrong surface.
    """
    content = table(decoded(source.data, source.where), source.where)
    settings = header_settings(tuple(line for line in content.header if not _NEVER.match(line)))
    if content.columns.shape[0] == 3:
        return _of_rows(source, content, settings)
    if content.columns.shape[0] < FEWEST_COLUMNS:
        rule = (
            f"a height map in text is a matrix of at least {FEWEST_COLUMNS} columns, or rows of x, y and height, "
            f"not {content.columns.shape[0]} columns"
        )
        raise InputError(rule, where=source.where)
    heights = np.concatenate((_rows_above(content, source.where), content.columns.T))
    unit = _setting(settings, "height unit")
    if source.unit is None and known_unit(unit or "") is None:
        rule = "the map has no unit of its heights: put a line 'unit: um' above them, or give it as unit 'um'"
        raise InputError(rule, where=source.where, value=unit)
    steps = _steps(settings, heights.shape)
    if steps is None:
        if source.spacing is None:
            rule = "the map has no steps: put a line 'spacing: 0.5 um' above them, or give them as spacing '0.5 um'"
            raise InputError(rule, where=source.where)
        steps = (source.spacing, source.spacing)
    else:
        own_steps(source)
    origin = {"format": FORMAT}
    told = source.unit or ("m", str(known_unit(unit or "")))
    # the steps of a matrix are lengths with their units already
    plain = Source(source.where, b"", ("m", told[1]) if source.unit else None)
    return make_map(plain, heights, steps, origin, units=("m", told[1]))


def _of_rows(source: Source, content: Table, settings: dict[str, str]) -> HeightMap:
    own_steps(source)
    found = _grid(content.columns)
    if found is None:
        rule = "rows of x, y and height must cover a grid of equal steps, row by row or column by column"
        raise InputError(rule, where=source.where)
    heights, steps = found
    units = source.unit or _heading_units(content, settings)
    if units is None:
        rule = "the map has no units: head its columns 'x_mm y_mm z_um', or give them as unit 'mm, um' (place, height)"
        raise InputError(rule, where=source.where)
    return make_map(source, heights, steps, {"format": FORMAT}, units=units)


def _heading_units(content: Table, settings: dict[str, str]) -> tuple[str, str] | None:
    """Units of place and height over the columns, or in the settings."""
    for line in reversed(content.header[-3:]):
        cells = split(line.lstrip("#%* "), content.delimiter)
        cells = cells if len(cells) == 3 else line.lstrip("#%* ").split()
        units = [cell_unit(cell) for cell in cells]
        if len(units) == 3 and all(units) and units[0] == units[1]:
            return str(units[0]), str(units[2])
    height, place = (known_unit(_setting(settings, name) or "") for name in ("height unit", "place unit"))
    return (place or height or "", height) if height else None


def _grid(columns: np.ndarray) -> tuple[np.ndarray, tuple[float, float]] | None:
    """Heights and steps of rows x, y, height that cover a grid in order; None for any other rows."""
    x, y, z = columns
    if x.size < 4 or not (np.isfinite(x).all() and np.isfinite(y).all()):
        return None
    by_rows = x[1] != x[0]
    fast, slow = (x, y) if by_rows else (y, x)
    turns = np.flatnonzero(slow != slow[0])
    width = int(turns[0]) if turns.size else 0
    if width < 2 or x.size % width:
        return None
    first, second = fast.reshape(-1, width), slow.reshape(-1, width)
    step, other = ((v[-1] - v[0]) / (v.size - 1) for v in (first[0], second[:, 0]))
    if not (step and other):
        return None
    off = np.abs(first - first[0, 0] - step * np.arange(width)).max() / abs(step)
    off_slow = np.abs(second - second[0, 0] - other * np.arange(second.shape[0])[:, None]).max() / abs(other)
    if max(off, off_slow) > _OFF:
        return None
    heights = z.reshape(-1, width)
    return (heights, (abs(step), abs(other))) if by_rows else (heights.T, (abs(other), abs(step)))


_OFF = 0.1
"""Judgement. Departure of places from a grid, in steps: rounded places are a grid, scattered ones are not."""


def _rows_above(content: Table, where: str) -> np.ndarray:
    """Rows with missing heights directly above the first complete row, which the table takes for its header."""
    rows: list[list[float]] = []
    width = content.columns.shape[0]
    for line in reversed(content.header):
        cells = split(line, content.delimiter)
        if len(cells) != width or not is_absent(line) or any(re.search(r"[=:]", cell) for cell in cells):
            break
        rows.insert(0, row_of(line, content.delimiter, width, where))
    return np.array(rows).reshape(-1, width)


def _setting(settings: dict[str, str], name: str) -> str | None:
    return next((settings[word] for word in SETTINGS[name] if settings.get(word)), None)


def _steps(settings: dict[str, str], shape: tuple[int, int]) -> tuple[float, float] | None:
    """Steps along x and y (m) by the header: stated, or from width and depth of the map."""
    both = known_length(_setting(settings, "step") or "")
    x, y = (known_length(_setting(settings, f"step {axis}") or "") or both for axis in "xy")
    width, depth = (known_length(_setting(settings, name) or "") for name in ("width", "depth"))
    x = x or (width / shape[1] if width else None)
    y = y or (depth / shape[0] if depth else None)
    return (x or y or 0.0, y or x or 0.0) if x or y else None
