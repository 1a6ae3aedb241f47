"""Plain text and CSV: one column of heights, or position and height."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, bridged, equal_spacing, make_profile
from profiles.readers.numbers import Table, decoded, split, table
from profiles.readers.plausible import Units, doubt, inferred_note, inferred_units
from profiles.units import METRES, known_unit, length, metres

_LAST_WORD = re.compile(r"([\[(/_ ])\s*([^\s\[\]()/_]+)\s*[\])]?\s*\Z")
_MARKS = {"a": "[(", "in": "[(/", "m": "[(/_"}
_NO_LENGTHS = {"v", "mv", "uv", "kv", "n", "mn", "s", "ms", "deg", "rad", "%"}
_SETTING = re.compile(r"\s*[#%;*/]*\s*([^:=]{1,60}?)\s*[:=]\s*(.*?)\s*\Z")
_STEP_NAMES = ("spacing", "step", "dx", "increment", "sampling interval", "point distance")
_UNIT_NAMES = ("unit", "units", "z unit", "height unit")
_POSITION_UNIT_NAMES = ("x unit", "position unit", *_UNIT_NAMES)


class TextReader:
    """Plain text and CSV with or without a header.

    Line ends of any system (bare CR too), decimal point or comma, tab, blank, comma or semicolon between
    columns. Units come from the caller, else from the header (``x_mm``, ``[mm]``, ``z (um)``,
    ``unit: um``), else, one or both, from the pair of units that is clearly the most plausible; the profile's
    ``steps`` and ``origin`` say when they were inferred, and when those of the heading are not plausible.
    Positions must increase by equal steps, up to their rounding. A height that is empty or reads ``NaN`` is masked.

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
        rule = (
            f"one or two columns are needed, [position,] height, not {columns.shape[0]}: save each column of heights "
            "with its positions as a file of its own"
        )
        raise InputError(rule, where=source.where)
    if columns.shape[1] < 3:
        raise InputError("a profile needs at least three heights", where=source.where, value=columns.shape[1])
    origin = {"format": TextReader.format, **settings} if origin is None else dict(origin)
    origin |= _overruled(source, content, settings)
    written = source.unit or _header_units(content, settings, source.where)
    if columns.shape[0] == 1:
        step = _header_spacing(settings, source.where) or source.spacing
        if step is None:
            raise InputError(
                "one column of heights needs its step: in a line 'spacing: 0.5 um', or as spacing '0.5 um'",
                where=source.where,
            )
        if written[1] is None:
            raise InputError(
                "the unit of the heights is not in the file: put it in a line 'unit: um', or give it as unit 'um'",
                where=source.where,
            )
        heights, present = columns[0] * metres(written[1], source.where), np.isfinite(columns[0])
        return make_profile(source, heights, step, origin, steps=notes, present=present)
    position, present = columns[0], np.isfinite(columns[1])
    heights = bridged(columns[1], present, source.where)
    own, unit = _own_step(source, position, content.quantum, written[0])
    known = unit, written[1]
    named = inferred_units(own, heights, source.where, known)
    origin["units"] = f"position {named[0]}, height {named[1]}"
    if named != known:
        note = inferred_note(known, named)
        origin["units_inferred"] = note
        notes = (*notes, f"units {note.partition('; ')[2]}")
    heights, step = heights * metres(named[1], source.where), own * metres(named[0], source.where)
    strange = doubt(source.spacing or step, heights) if source.unit is None and named == known else None
    if strange:
        origin["units_doubtful"] = f"{origin['units']} by the heading: {strange}, unlike a measured trace"
    return make_profile(source, heights, step, origin, steps=notes, present=present)


def _own_step(source: Source, position: np.ndarray, quantum: float, unit: str | None) -> tuple[float, str | None]:
    """Step and unit of the column of positions; those of the caller where the column has no equal step or no unit."""
    told = source.spacing
    try:
        own = equal_spacing(position, quantum, source.where)
    except InputError:
        if told is None:
            raise
        own, unit = told, None
    return (own, unit) if told is None or unit is not None else (told / METRES["um"], "um")


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


def _header_units(content: Table, settings: dict[str, str], where: str) -> Units:
    """Units written over the columns, else as a setting; None for those that are not.

    A length beside what claims another unit, as a volt, is refused.
    """
    width = content.columns.shape[0]
    found: Units = (None, None)
    for line in reversed(content.header[-3:]):
        cells = split(line.lstrip("#%* "), content.delimiter)
        if len(cells) != width:
            cells = split(line.lstrip("#%* "), None)
        if len(cells) != width:
            continue
        known = [_cell_unit(cell) for cell in cells]
        other = next((cell for cell in cells if _claims_another(cell)), None)
        if any(known) and other is not None:
            raise InputError(
                "names no unit of length: give both as unit 'mm, um'", where=f"{where}: heading", value=other
            )
        if all(known) or not any(found):
            found = known[0], known[-1]
        if all(known):
            break
    position = next((settings[name] for name in _POSITION_UNIT_NAMES if name in settings), None)
    height = next((settings[name] for name in _UNIT_NAMES if name in settings), None)
    return found[0] or position, found[1] or height


def _overruled(source: Source, content: Table, settings: dict[str, str]) -> dict[str, object]:
    """The units in the header where the caller named others; a header that names no lengths is no contradiction."""
    if source.unit is None:
        return {}
    try:
        written = _header_units(content, settings, source.where)
    except InputError:
        return {}
    first = 0 if content.columns.shape[0] == 2 and source.spacing is None else 1
    both = zip(written[first:], source.unit[first:], strict=True)
    if all(own is None or metres(own) == metres(told) for own, told in both):
        return {}
    own, told = _pair(written[first:]), _pair(source.unit[first:])
    return {"units_overruled": f"the file names {own}, taken as {told} as told"}


def _pair(units: Sequence[str | None]) -> str:
    """Units of position and height in words, or of height alone; unknown ones left out.

    >>> _pair(("mm", "um")), _pair(("um",)), _pair((None, "nm"))
    ('position mm, height um', 'height um', 'height nm')
    """
    named = zip(("position", "height")[-len(units) :], units, strict=True)
    return ", ".join(f"{what} {unit}" for what, unit in named if unit)


def _cell_unit(cell: str) -> str | None:
    """The unit in a column's heading: ``x_mm``, ``z [um]``, ``Lateral um``, ``z/nm``, ``(mm)`` or ``mm``.

    Words that mean other things too need more: ``a`` and ``in`` brackets, ``in`` and ``m`` at least a slash,
    ``m`` an underscore.
    """
    mark, word = _last_word(cell)
    return known_unit(word) if mark in _MARKS.get(word.lower(), mark) else None


def _claims_another(cell: str) -> bool:
    """Whether a heading ends in a unit that is no length, or in a marked word that is no unit at all."""
    mark, word = _last_word(cell)
    return not known_unit(word) and (mark != " " or word.lower() in _NO_LENGTHS)


def _last_word(cell: str) -> tuple[str, str]:
    """The last word of a heading and the mark before it, a blank where there is none."""
    cell = cell.strip(' "')
    match = _LAST_WORD.search(cell)
    return (match[1], match[2]) if match else (" ", cell)
