"""Plain text and CSV: one column of heights, or position and height."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import HoldsMap, Source, bridged, make_profile
from profiles.readers.numbers import Counted, Table, decoded, split, table
from profiles.readers.plausible import Units, doubt, inferred_note, inferred_units
from profiles.readers.positions import RESAMPLED, Sampled, sampled
from profiles.units import METRES, known_unit, length, metres, number_of

_LAST_WORD = re.compile(r"([\[(/_ ])\s*([^\s\[\]()/_]+)\s*[\])]?\s*\Z")
_MARKS = {"a": "[(", "in": "[(/", "m": "[(/_"}
_NO_LENGTHS = {"v", "mv", "uv", "kv", "n", "mn", "s", "ms", "deg", "rad", "%"}
_SETTING = re.compile(r"\s*[#%;*/]*\s*([^:=]{1,60}?)\s*[:=]\s*(.*?)\s*\Z")
_STEP_NAMES = ("spacing", "step", "dx", "increment", "sampling interval", "point distance")
_UNIT_NAMES = ("unit", "units", "z unit", "height unit")
_POSITION_UNIT_NAMES = ("x unit", "position unit", *_UNIT_NAMES)
_COUNT_NAMES = ("points", "number of points", "count", "samples", "data points")
_RESULT = re.compile(
    r"\W*([PRW][A-Za-z]\w{0,4})\W*?(?:[\[(]\s*([^\])]*?)\s*[\])])?"
    r"[\s,;:=\"]+([-+]?\d[\d.,]*)[\"\s,;]*(\S*)\s*\Z"
)
_HEIGHTS_STATED = "aqztpv"
"""Second letters of height parameters: without a unit they have the unit of the heights."""


class TextReader:
    """Plain text and CSV with or without a header.

    Line ends of any system (bare CR too), decimal point or comma, tab, blank, comma or semicolon between columns. Units
    come from the caller, else from the header (``x_mm``, ``[mm]``, ``z (um)``, ``unit: um``), else, one or both, from
    the clearly most plausible pair of units; the profile's ``steps`` and ``origin`` name inferred units and implausible
    units of a heading. Falling positions are reversed, unequal steps resampled. A height that is empty or reads ``NaN``
    is masked. A count of the heights in the first lines of numbers is not a height; with a length beside it, it gives
    the step. Results below the numbers go to ``origin["stated"]``.

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
    """Profile of a table of one or two columns; ``origin`` and ``notes`` come from its reader."""
    settings = header_settings(content.header)
    columns = content.columns
    if columns.shape[0] > 2:
        from profiles.maps.text import is_map

        if is_map(columns):
            raise HoldsMap(source.where, columns.T.shape)
        rule = (
            f"one or two columns are needed, [position,] height, not {columns.shape[0]}: save each column of heights "
            "with its positions as a file of its own; a height map is read from x3p and SDF files, and from text of 16 "
            "columns and more, or of x, y and height"
        )
        raise InputError(rule, where=source.where)
    if columns.shape[1] < 3:
        raise InputError("a profile needs at least three heights", where=source.where, value=columns.shape[1])
    origin = {"format": TextReader.format, **settings} if origin is None else dict(origin)
    origin |= _overruled(source, content, settings)
    notes = (*notes, *_count_notes(content, settings, origin))
    written = source.unit or _header_units(content, settings, source.where)
    read = _read_heights if columns.shape[0] == 1 else _read_pairs
    found, units, more = read(source, content, settings, written, origin)
    notes = (*notes, *found.notes, *more, *_results(content, metres(units[1]), origin))
    heights, step = found.heights * metres(units[1]), found.step * metres(units[0])
    strange = doubt(source.spacing or step, heights, units) if source.unit is None and units[1] == written[1] else None
    if strange and (columns.shape[0] == 1 or units == written):
        origin["units_doubtful"] = f"{origin.get('units', f'height {units[1]}')} by the heading: {strange}"
    return make_profile(source, heights, step, origin, steps=notes, present=found.present)


Read = tuple[Sampled, tuple[str, str], tuple[str, ...]]
"""Heights and step as written, their units of position and height, and further notes."""


def _read_heights(
    source: Source, content: Table, settings: dict[str, str], written: Units, origin: dict[str, object]
) -> Read:
    """One column of heights; the step comes from a setting, the caller, or a length over a count."""
    heights, present = content.columns[0], np.isfinite(content.columns[0])
    step = _header_spacing(settings, source.where)
    if written[0] == written[1]:  # one unit is that of the heights
        written = next((settings[name] for name in _POSITION_UNIT_NAMES[:2] if name in settings), None), written[1]
    if step is None and content.counted and content.counted.length and (written[0] or source.spacing is None):
        own = content.counted.length / content.counted.count
        units = inferred_units(own, bridged(heights, present, source.where), source.where, written)
        said = f"step {own:.6g} {units[0]}: the length {content.counted.length:g} over the count in"
        if units != written:
            origin["units_inferred"] = inferred_note(written, units)
        notes = () if source.spacing else (f"{said} line {content.counted.line}",)
        return Sampled(heights, present, own), units, notes
    step = step or source.spacing
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
    return Sampled(heights, present, step), ("m", written[1]), ()


def _read_pairs(
    source: Source, content: Table, settings: dict[str, str], written: Units, origin: dict[str, object]
) -> Read:
    """Positions and heights; units missing in the file are inferred."""
    position, present = content.columns[0], np.isfinite(content.columns[1])
    found, unit = _own_steps(source, position, content.columns[1], present, content.quantum, written[0], origin)
    known = unit, written[1]
    units = inferred_units(found.step, bridged(found.heights, found.present, source.where), source.where, known)
    origin["units"] = f"position {units[0]}, height {units[1]}"
    if units == known:
        return found, units, ()
    note = inferred_note(known, units)
    origin["units_inferred"] = note
    return found, units, (f"units {note.partition('; ')[2]}",)


def _own_steps(
    source: Source,
    position: np.ndarray,
    heights: np.ndarray,
    present: np.ndarray,
    quantum: float,
    unit: str | None,
    origin: dict[str, object],
) -> tuple[Sampled, str | None]:
    """Trace at equal steps and its unit; the caller's step for positions without an equal step or unit."""
    told = source.spacing
    if told is None:
        return sampled(position, heights, present, quantum, source.where), unit
    as_told = told / METRES["um"]
    try:
        found = sampled(position, heights, present, quantum, source.where)
    except InputError as error:
        origin["spacing_overruled"] = f"{error.rule.partition(';')[0]}, taken as rising by {as_told:.6g} um as told"
        return Sampled(heights, present, as_told), "um"
    if any(note.startswith(RESAMPLED) for note in found.notes):
        said = found.notes[-1].partition("as its ")[2]
        origin["spacing_overruled"] = (
            f"the positions rise, but their {said}: taken as equal steps of {as_told:.6g} um as told; "
            "without a step that is told they are resampled"
        )
        return Sampled(heights, present, as_told), "um"
    if unit is not None:
        return found, unit
    ratios = [told / (found.step * size) for size in METRES.values()]
    if found.step != 1.0 and not any(abs(ratio - 1.0) < 1e-3 for ratio in ratios):
        origin["spacing_overruled"] = (
            f"the positions rise by {found.step:.6g} of a unit that is not named, taken as {as_told:.6g} um as told"
        )
    return Sampled(found.heights, found.present, as_told, found.notes), "um"


def _count_notes(content: Table, settings: dict[str, str], origin: dict[str, object]) -> tuple[str, ...]:
    """Note on a count above the heights; a count different from their number is stated in ``origin``."""
    counted = content.counted
    if counted is None:
        stated = next((settings[name] for name in _COUNT_NAMES if settings.get(name, "").isdecimal()), None)
        counted = Counted(int(stated), 0) if stated else None
    if counted is None:
        return ()
    heights = content.columns.shape[1]
    where = f"line {counted.line}" if counted.line else "the header"
    if counted.count != heights:
        why = "cut short?" if counted.count > heights else "are others among them?"
        origin["count_differs"] = f"{where} counts {counted.count} heights, {heights} follow: {why}"
    return (f"{where} counts {counted.count} heights, read as no height",) if counted.line else ()


def _results(content: Table, unit: float, origin: dict[str, object]) -> tuple[str, ...]:
    """Note on the lines below the heights; the instrument's results among them go to ``origin``."""
    if not content.footer:
        return ()
    stated = {}
    for match in filter(None, map(_RESULT.match, content.footer)):
        name, bracketed, digits, behind = match.groups()
        named = known_unit(bracketed or behind or "")
        try:
            value = number_of(digits if content.delimiter == "," else digits.replace(",", "."))
        except ValueError:
            continue
        size = metres(named) if named else unit if name[1:] and name[1:] in _HEIGHTS_STATED else 1.0
        stated[name] = value * size
    if stated:
        origin |= {"stated": stated, "stated_filtered": True}
    kept = f": {', '.join(stated)} kept as stated by the instrument" if stated else ""
    others = len(content.footer) - len(stated)
    left = f"; {others} left out" if stated and others else "" if stated else " left out"
    return (f"{len(content.footer)} lines below the heights, from line {content.footer_line} on{kept}{left}",)


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
    """Units written over the columns, else in a setting, else None. An error for a length beside another unit, such as
    a volt."""
    width = content.columns.shape[0]
    found: Units = (None, None)
    for line in reversed(content.header[-3:]):
        cells = split(line.lstrip("#%* "), content.delimiter)
        if len(cells) != width:
            cells = split(line.lstrip("#%* "), None)
        if len(cells) != width:
            continue
        known = [cell_unit(cell) for cell in cells]
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
    """Units of the header overruled by the caller; a header without lengths does not contradict."""
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
    """Units of position and height in words, or of height alone; without unknown units.

    >>> _pair(("mm", "um")), _pair(("um",)), _pair((None, "nm"))
    ('position mm, height um', 'height um', 'height nm')
    """
    named = zip(("position", "height")[-len(units) :], units, strict=True)
    return ", ".join(f"{what} {unit}" for what, unit in named if unit)


def cell_unit(cell: str) -> str | None:
    """The unit in a column's heading: ``x_mm``, ``z [um]``, ``Lateral um``, ``z/nm``, ``(mm)`` or ``mm``.

    Ambiguous words need more: ``a`` and ``in`` brackets, ``in`` and ``m`` at least a slash, ``m`` an underscore.
    """
    mark, word = _last_word(cell)
    return known_unit(word) if mark in _MARKS.get(word.lower(), mark) else None


def _claims_another(cell: str) -> bool:
    """Whether a heading ends in a unit other than a length, or in a marked word that names no unit."""
    mark, word = _last_word(cell)
    return not known_unit(word) and (mark != " " or word.lower() in _NO_LENGTHS)


def _last_word(cell: str) -> tuple[str, str]:
    """Last word of a heading and the mark before it, a blank if none."""
    cell = cell.strip(' "')
    match = _LAST_WORD.search(cell)
    return (match[1], match[2]) if match else (" ", cell)
