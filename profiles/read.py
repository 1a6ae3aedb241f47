"""Reading of any profile file: the first reader that recognises the content reads it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path, PurePath

from profiles.errors import InputError, as_path, refuse_no_file
from profiles.profile import Profile
from profiles.readers.archive import refuse_broken, unpacked
from profiles.readers.base import MAX_BYTES, Reader, Source
from profiles.readers.container import ZipReader
from profiles.readers.dektak import DektakReader
from profiles.readers.foreign import ForeignFormat, foreign
from profiles.readers.hfm import HfmReader
from profiles.readers.mitutoyo import MitutoyoReader
from profiles.readers.nist_xml import NistXmlReader
from profiles.readers.numbers import NO_NUMBERS
from profiles.readers.opdx import OpdxReader
from profiles.readers.prf import PrfReader
from profiles.readers.sdf import SdfReader
from profiles.readers.smd import SmdReader
from profiles.readers.spreadsheet import SpreadsheetReader
from profiles.readers.surfcom import SurfcomReader
from profiles.readers.text import TextReader
from profiles.readers.x3p import X3pReader
from profiles.units import known_unit, length, metres

NO_TEXTS = (".opdx", ".x3p", ".xlsx", ".zip")
"""Endings of formats known by their first bytes, with any other content."""
UNTOLD = (TextReader, ZipReader, type(None))
"""Readers of many kinds of file, and None: files of formats without a reader end with them."""


def read(path: str | os.PathLike[str], *, unit: str | None = None, spacing: float | str | None = None) -> Profile:
    """The profile in a file, recognised by its content.

    ``unit`` names the unit of plain numbers, as ``"um"`` (both columns) or ``"mm, um"`` (position, height);
    ``spacing``: the step, in metres or as ``"0.5 um"``, for one column of heights or bad positions. Formats that carry
    their own units ignore ``unit``; a step of the file that ``spacing`` overrules is in ``origin``.
    """
    return read_source(
        open_source(
            as_path(path, "profiles.read"), two_units(unit), None if spacing is None else length(spacing, "spacing")
        )
    )


def read_source(source: Source) -> Profile:
    """The profile in a file's bytes, by the first reader that recognises them, else by the optional readers."""
    from profiles.maps import formats

    try:
        return _by_base(source)
    except ForeignFormat as known:
        if known.format.readers and formats.is_installed():
            return formats.read_line(source, known.format)
        raise


def _by_base(source: Source) -> Profile:
    if not source.data.strip(b"\x00 \t\r\n"):
        rule = "the file is empty" if b"\x00" not in source.data else "the file holds nothing but zero bytes"
        raise InputError(rule, where=source.where)
    refuse_broken(source.data, source.where)
    reader = next((one for one in readers() if one.magic(source)), None)
    if isinstance(reader, UNTOLD) and (known := foreign(source, by_ending=False)):
        raise known
    if reader is not None:
        with _as_named(source, reader):
            return reader.read(source)
    formats = "; ".join(reader.format for reader in readers())
    with _as_named(source):
        raise InputError(f"no known profile format; known are {formats}", where=source.where)


@cache
def readers() -> tuple[Reader, ...]:
    """All readers in the order of trial; readers of other packages (entry points ``mixedlub.readers``) come first. An
    entry point leads to a module with a ``READER``, or to the reader itself."""
    offered = [point.load() for point in entry_points(group="mixedlub.readers")]
    return (*(getattr(one, "READER", one) for one in offered), *READERS)


@contextmanager
def _as_named(source: Source, reader: Reader | None = None) -> Iterator[None]:
    """Context for errors: content that contradicts the ending of the file name is reported as such first."""
    try:
        yield
    except InputError as error:
        plain = isinstance(reader, TextReader) and error.rule != NO_NUMBERS and b"\x00" not in source.data
        if isinstance(reader, UNTOLD) and not plain and (known := foreign(source, by_ending=True)):
            raise known from None
        ending = PurePath(source.bare).suffix.lower()
        if ending not in NO_TEXTS or not (reader is None or isinstance(reader, TextReader)):
            raise
        why = "damaged or of another format" if error.rule == NO_NUMBERS else error.rule
        rule = f"is no {ending} file although its name says so: {why}"
        raise InputError(rule, where=error.where, value=error.value) from None


def open_source(path: Path, unit: tuple[str, str] | None, spacing: float | None) -> Source:
    """Bytes of a file, unpacked from .gz; an error for a missing file, a folder, or a file larger than any trace."""
    where = str(path)
    refuse_no_file(path)
    size = path.stat().st_size
    if size > MAX_BYTES:
        raise InputError(f"larger than {MAX_BYTES} bytes, the largest file that is read", where=where, value=size)
    try:
        return Source(where, unpacked(path.read_bytes(), where, MAX_BYTES), unit, spacing)
    except OSError as error:
        raise InputError(f"cannot be opened ({error.strerror})", where=where) from None


def two_units(unit: str | None) -> tuple[str, str] | None:
    """Plain names of the units of position and height; a single unit is of both."""
    if unit is None:
        return None
    words = [word for word in unit.replace(",", " ").split() if word] if isinstance(unit, str) else []
    if not 1 <= len(words) <= 2:
        raise InputError("one unit, or two for position and height", where="unit", value=unit)
    for word in words:
        metres(word, "unit")
    return str(known_unit(words[0])), str(known_unit(words[-1]))


# From the most specific content to the least: each reader may claim only what those above it left.
READERS: tuple[Reader, ...] = (
    OpdxReader(),
    SdfReader(),
    SmdReader(),
    X3pReader(),
    MitutoyoReader(),
    SpreadsheetReader(),
    # Any zip: after x3p and xlsx, which are zips with a known member.
    ZipReader(read_source),
    NistXmlReader(),
    # The rest are texts of numbers with a telling first line,
    PrfReader(),
    HfmReader(),
    DektakReader(),
    # told by the file's name alone, so after those told by content,
    SurfcomReader(),
    # and any characters at all, so last.
    TextReader(),
)
