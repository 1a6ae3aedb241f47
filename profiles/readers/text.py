"""Plain text and CSV: one column of heights, or position and height."""

from __future__ import annotations

import re

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, equal_spacing, make_profile
from profiles.readers.numbers import Table, decoded, split, table
from profiles.units import METRES, known_unit, length, metres

_BRACKETED = re.compile(r"[\[(/_ ]\s*([^\s\[\]()/_]+)\s*[\])]?\s*\Z")
_SETTING = re.compile(r"\s*[#%;*/]*\s*([^:=]{1,60}?)\s*[:=]\s*(.*?)\s*\Z")
_STEP_NAMES = ("spacing", "step", "dx", "increment", "sampling interval", "point distance")
_UNIT_NAMES = ("unit", "units", "z unit", "height unit")
_POSITION_UNIT_NAMES = ("x unit", "position unit", *_UNIT_NAMES)


class TextReader:
    """Plain text and CSV with or without a header.

    Line ends of any system (bare CR too), decimal point or comma, tab, blank, comma or semicolon between
    columns. Units come from the caller, else from the header (``x_mm``, ``[mm]``, ``z (um)``,
    ``unit: um``), else from the only pair of units that makes the trace a plausible surface; the profile's
    ``steps`` and ``origin`` say when they were inferred. Positions must increase by equal steps, up to their rounding.

    Checked against the nine text traces of public repositories in the test data and constructed files.
    """

    name = "text"
    format = "plain text or CSV: [position,] height"

    def magic(self, source: Source) -> bool:
        head = source.data[:4096]
        return head[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\x00" not in head

    def read(self, source: Source) -> Profile:
        return read_table(source, table(decoded(source.data, source.where), source.where))


def read_table(
    source: Source, content: Table, origin: dict[str, object] | None = None, notes: tuple[str, ...] = ()
) -> Profile:
    """The profile of a table of one or two columns; ``origin`` and ``notes`` are what its reader knows."""
    settings = header_settings(content.header)
    columns = content.columns
    if columns.shape[0] > 2:
        raise InputError(
            "one or two columns are needed: [position,] height", where=source.where, value=columns.shape[0]
        )
    if columns.shape[1] < 3:
        raise InputError("a profile needs at least three heights", where=source.where, value=columns.shape[1])
    named = source.unit or _header_units(content, settings, source.where)
    origin = {"format": TextReader.format, **settings} if origin is None else dict(origin)
    origin |= _overruled(source, content, settings)
    if columns.shape[0] == 1:
        spacing = source.spacing or _header_spacing(settings, source.where)
        if spacing is None:
            raise InputError(
                "one column of heights needs its step: in a line 'spacing: 0.5 um', or as spacing '0.5 um'",
                where=source.where,
            )
        if named is None:
            raise InputError(
                "the unit of the heights is not in the file: put it in a line 'unit: um', or give it as unit 'um'",
                where=source.where,
            )
        return make_profile(source, columns[0] * metres(named[1], source.where), spacing, origin, steps=notes)
    position, heights = columns
    step = source.spacing or equal_spacing(position, content.quantum, source.where)
    if named is None:
        named = inferred_units(step if source.spacing is None else None, step, heights, source.where)
        notes = (
            *notes,
            f"units inferred from the numbers: position {named[0]}, height {named[1]}",
        )
        origin["units_inferred"] = True
    if source.spacing is None:
        step *= metres(named[0], source.where)
    origin["units"] = f"position {named[0]}, height {named[1]}"
    return make_profile(source, heights * metres(named[1], source.where), step, origin, steps=notes)


def header_settings(header: tuple[str, ...]) -> dict[str, str]:
    """The ``key: value`` and ``key = value`` lines of a header, keys in lower case."""
    found = {}
    for line in header:
        match = _SETTING.match(line)
        if match and match[1]:
            found[match[1].strip().lower()] = match[2]
    return found


def _header_spacing(settings: dict[str, str], where: str) -> float | None:
    for name, value in settings.items():
        plain, _, unit = name.rpartition("_")
        if name in _STEP_NAMES:
            return length(value, f"{where}: {name}")
        if plain in _STEP_NAMES and known_unit(unit):
            return length(f"{value} {unit}", f"{where}: {name}")
    return None


def _header_units(content: Table, settings: dict[str, str], where: str) -> tuple[str, str] | None:
    """Units written in the header: over the columns, or as a setting; a length beside a volt is refused."""
    width = content.columns.shape[0]
    for line in reversed(content.header[-3:]):
        cells = split(line.lstrip("#%* "), content.delimiter)
        if len(cells) != width:
            cells = split(line.lstrip("#%* "), None)
        known = [_cell_unit(cell) for cell in cells] if len(cells) == width else []
        if known and all(known):
            return str(known[0]), str(known[-1])
        other = next((c for c, unit in zip(cells, known) if not unit and _BRACKETED.search(c.strip(' "'))), None)
        if any(known) and other is not None:
            raise InputError(
                "names no unit of length: give both as unit 'mm, um'", where=f"{where}: heading", value=other
            )
    height = next((settings[name] for name in _UNIT_NAMES if name in settings), None)
    position = next((settings[name] for name in _POSITION_UNIT_NAMES if name in settings), None)
    if height is None or position is None:
        return None
    return position, height


def _overruled(source: Source, content: Table, settings: dict[str, str]) -> dict[str, object]:
    """The units in the header where the caller named others; a header that names no lengths is no contradiction."""
    if source.unit is None:
        return {}
    try:
        written = _header_units(content, settings, source.where)
    except InputError:
        return {}
    first = 0 if content.columns.shape[0] == 2 and source.spacing is None else 1
    if written is None or [metres(u) for u in written[first:]] == [metres(u) for u in source.unit[first:]]:
        return {}
    own, told = _pair(written[first:]), _pair(source.unit[first:])
    return {"units_overruled": f"the file names {own}, taken as {told} as told"}


def _pair(units: tuple[str, ...]) -> str:
    """Units of position and height in words, or of height alone.

    >>> _pair(("mm", "um")), _pair(("um",))
    ('position mm, height um', 'height um')
    """
    return ", ".join(f"{what} {unit}" for what, unit in zip(("position", "height")[-len(units) :], units, strict=True))


def _cell_unit(cell: str) -> str | None:
    """The unit in a column's heading: ``x_mm``, ``z [um]``, ``Lateral um``, ``(mm)`` or ``mm``."""
    cell = cell.strip().strip('"')
    match = _BRACKETED.search(cell)
    return known_unit(match[1]) if match else (known_unit(cell) if cell.lower() not in ("a", "m") else None)


def inferred_units(position_step: float | None, step: float, heights: np.ndarray, where: str) -> tuple[str, str]:
    """The only pair of units that makes the trace a plausible stylus or optical trace, or an error.

    Plausible: a step from 15 nm to 14 um, and a typical local slope
    (1.48 times the median of |dz|/dx) from 0.001 to 0.5, that of engineering surfaces. Each window is
    narrower than the factor 1000 between units, so that two answers are impossible and none is an error.
    """
    if position_step is None:
        positions = ["m"]
    else:
        positions = [u for u in ("m", "mm", "um") if 1.5e-8 <= position_step * METRES[u] <= 1.4e-5]
    rise = 1.4826 * float(np.median(np.abs(np.diff(heights))))
    if rise == 0:
        rise = float(np.abs(np.diff(heights)).mean())
    pairs = [
        (x, z)
        for x in positions
        for z in ("m", "mm", "um", "nm")
        if 1e-3 <= rise * METRES[z] / (step * METRES[x]) <= 0.5
    ]
    if len(pairs) != 1:
        rule = "no units in the file, and none can be inferred: heading 'x_mm, z_um', or give them as unit 'mm, um'"
        raise InputError(rule, where=where)
    return pairs[0]
