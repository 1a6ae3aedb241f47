"""Reading of any areal file, and of a file that is a trace or a map."""

from __future__ import annotations

import os
from types import ModuleType

from profiles.errors import InputError, as_path
from profiles.maps import formats, sdf, text, x3p
from profiles.maps.height_map import HeightMap
from profiles.profile import Profile
from profiles.readers.base import HoldsMap, Source
from profiles.readers.foreign import foreign
from profiles.readers.numbers import NO_NUMBERS

READERS: tuple[ModuleType, ...] = (x3p, sdf, text)
"""Readers of maps without the extra; text takes any characters, so it is last."""


def read_map(path: str | os.PathLike[str], *, unit: str | None = None, spacing: float | str | None = None) -> HeightMap:
    """The height map in an areal file: x3p, SDF or text, and many formats of instruments with `mixedlub[formats]`.

    ``unit`` and ``spacing`` as for `profiles.read`; a file with units of its own is overruled by ``unit``, and
    ``origin`` says so. Without units anywhere the map is refused.
    """
    return _read_map(_source(path, unit, spacing))


def read_any(
    path: str | os.PathLike[str], *, unit: str | None = None, spacing: float | str | None = None
) -> Profile | HeightMap:
    """The trace or the height map in a file, recognised by its content."""
    from profiles.read import read_source

    source = _source(path, unit, spacing)
    try:
        return read_source(source)
    except HoldsMap:
        return _read_map(source)


def _source(path: str | os.PathLike[str], unit: str | None, spacing: float | str | None) -> Source:
    from profiles.read import open_source, two_units
    from profiles.units import length

    step = None if spacing is None else length(spacing, "spacing")
    return open_source(as_path(path, "profiles.maps.read_map"), two_units(unit), step)


def _read_map(source: Source) -> HeightMap:
    reader = next((one for one in READERS if one.magic(source)), None)
    known = foreign(source, by_ending=reader is None) if reader in (None, text) else None
    try:
        if known is not None:
            raise known
        if reader is None:
            raise InputError("is no x3p, SDF or text file", where=source.where)
        found: HeightMap = reader.read(source)
        return found
    except InputError as error:
        known = known or (foreign(source, by_ending=True) if _is_no_table(error) else None)
        if known is None:
            raise
        if known.format.readers and formats.is_installed():
            return formats.read_map(source, known.format)
        raise known from None


def _is_no_table(error: InputError) -> bool:
    """Whether a text could not be read as numbers, so that the ending of its name may tell more."""
    return error.rule == NO_NUMBERS or "binary zeros" in error.rule
