"""Units of length in input: names as instruments write them, converted to metres."""

from __future__ import annotations

import math
import re

from profiles.errors import InputError, nearest

METRES = {
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "nm": 1e-9,
    "pm": 1e-12,
    "angstrom": 1e-10,
    "in": 0.0254,
    "mil": 2.54e-5,
    "uin": 2.54e-8,
}

_ALIASES = {
    "meter": "m", "metre": "m", "meters": "m", "metres": "m",
    "millimeter": "mm", "millimetre": "mm", "millimeters": "mm", "millimetres": "mm",
    "micron": "um", "microns": "um", "micrometer": "um", "micrometre": "um",
    "micrometers": "um", "micrometres": "um", "mikrometer": "um", "mum": "um",
    "nanometer": "nm", "nanometre": "nm", "nanometers": "nm", "nanometres": "nm",
    "a": "angstrom", "ang": "angstrom",
    "inch": "in", "inches": "in", "microinch": "uin", "microinches": "uin", "uinch": "uin",
}  # fmt: skip

_MICRO = str.maketrans({"\u00b5": "u", "\u03bc": "u", "\u00c5": "a", "\u212b": "a"})
_QUANTITY = re.compile(r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*([^\d\s.]\S*)\s*\Z")


def known_unit(word: str) -> str | None:
    """The plain name of a unit of length, or None for any other word.

    >>> known_unit("µm"), known_unit("Microns"), known_unit("mV")
    ('um', 'um', None)
    """
    word = word.strip().translate(_MICRO)
    plain = word if word in METRES else word.lower()
    plain = _ALIASES.get(plain, plain)
    return plain if plain in METRES else None


def number_of(text: str) -> float:
    """Number in a text; unlike in Python, an underscore between digits is an error.

    >>> number_of(" 17.49 ")
    17.49
    >>> number_of("1_7.49")
    Traceback (most recent call last):
    ...
    ValueError: not a number: '1_7.49'
    """
    if "_" in text:
        raise ValueError(f"not a number: {text!r}")
    return float(text)


def metres(word: str, where: str = "unit") -> float:
    """How many metres the unit is.

    >>> metres("um")
    1e-06
    """
    unit = known_unit(word)
    if unit is None:
        raise InputError(f"not a unit of length; {nearest(word, METRES)}", where=where, value=word)
    return METRES[unit]


def known_length(text: str) -> float | None:
    """Length in metres named by a text, or None for any other text: for incidental words of a header.

    >>> known_length("2 mm"), known_length("2.5"), known_length("0 um")
    (0.002, None, None)
    """
    try:
        return length(text, "")
    except InputError:
        return None


def length(value: float | str, where: str) -> float:
    """A length in metres from a number (metres) or a text with its unit.

    >>> length("0.5 um", "spacing"), length(2e-6, "spacing")
    (5e-07, 2e-06)
    """
    if isinstance(value, str):
        match = _QUANTITY.match(value)
        if not match:
            raise InputError("a length is a number and a unit, as in '0.5 um'", where=where, value=value)
        try:
            size = number_of(match[1])
        except ValueError:
            raise InputError("not a number", where=where, value=match[1]) from None
        value = size * metres(match[2], where)
    if not (math.isfinite(value) and value > 0):
        raise InputError("must be a finite length above zero", where=where, value=value)
    return float(value)
