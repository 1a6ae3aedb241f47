"""Zip archives and XML from outside: sizes checked before anything is unpacked, no entities."""

from __future__ import annotations

import gzip
import io
import lzma
import zipfile
import zlib

from profiles.errors import InputError

MAX_UNPACKED = 128 * 2**20
MAX_INDEX = 2**20

ZIP_FAULTS = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    ValueError,
    NotImplementedError,
    RuntimeError,
    OSError,
    EOFError,
)
"""Exceptions of Python's zip module on a damaged or locked archive."""


GZIP, ZIP = b"\x1f\x8b", (b"PK\x03\x04", b"PK\x05\x06", b"PK\x07\x08")
"""First bytes of a file compressed by gzip, and of a zip archive: whole, empty, or part of several."""


def unpacked(data: bytes, where: str, limit: int) -> bytes:
    """Content of a file compressed by gzip; other content unchanged."""
    if data[:2] != GZIP:
        return data
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as file:
            content = file.read(limit + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(f"damaged gzip file ({error})", where=where) from None
    if len(content) > limit:
        raise InputError(f"unpacks to more than {limit} bytes, the largest file that is read", where=where)
    return content


def refuse_broken(data: bytes, where: str) -> None:
    """Raise an error for content that begins as a zip archive and cannot be listed."""
    if data[:4] in ZIP and not members(data):
        rule = "damaged or unsupported zip archive, which x3p and xlsx files are too: cut off?"
        raise InputError(rule, where=where)


def members(data: bytes) -> tuple[str, ...]:
    """Names in a zip archive; empty for anything else."""
    if data[:4] != b"PK\x03\x04":
        return ()
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return tuple(archive.namelist())
    except ZIP_FAULTS:
        return ()


def member(data: bytes, name: str) -> bytes:
    """One member of a zip archive; empty if unreadable or larger than any list of contents."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return archive.read(name) if archive.getinfo(name).file_size <= MAX_INDEX else b""
    except (KeyError, *ZIP_FAULTS):
        return b""


def check_archive(data: bytes, where: str, limit: int = MAX_UNPACKED) -> None:
    """Raise an error for an archive that unpacks to more than the limit or has XML with entities."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            total = sum(info.file_size for info in archive.infolist())
            if total > limit or len(archive.infolist()) > 10_000:
                raise InputError(f"the archive unpacks to more than {limit} bytes", where=where, value=total)
            for info in archive.infolist():
                if info.filename.lower().endswith((".xml", ".rels")):
                    check_xml(archive.read(info), f"{where}: {info.filename}")
    except InputError:
        raise
    except ZIP_FAULTS as fault:
        raise InputError(f"damaged archive ({fault})", where=where) from None


def check_xml(data: bytes, where: str) -> None:
    """Raise an error for XML that declares entities, by which a small file grows to fill the memory."""
    plain = data.replace(b"\x00", b"") if b"\x00" in data[:4] else data
    if b"<!ENTITY" in plain:
        raise InputError("XML entities are not allowed in a profile file", where=where)
