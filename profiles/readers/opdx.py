"""Bruker Dektak OPDx (binary)."""

from __future__ import annotations

import struct

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, checked_count, make_profile
from profiles.units import metres

_DEPTH = 16
_FIXED = {0x01: 1, 0x06: 4, 0x07: 4, 0x0A: 8, 0x0B: 8, 0x0C: 4, 0x0D: 8, 0x15: 9, 0x7F: 0}
_BLOCKS = (0x12, 0x13, 0x18)
_TYPED_BLOCKS = (0x0E, 0x40, 0x42, 0x7C)
_CONTAINERS = (0x46, 0x47, 0x7D)


class OpdxReader:
    """OPDx: named, typed, length-counted items, nested; the profile is the first scan under ``1D_Data``.

    Height = number x ``DataScale``, spacing = ``Extent`` over the intervals. The layout was worked out from the single
    sample of SurfaceTopography, against the text export of the same scan.
    """

    name = "OPDx"
    format = "Bruker Dektak OPDx"

    def magic(self, source: Source) -> bool:
        return source.data.startswith(b"VCA DATA")

    def read(self, source: Source) -> Profile:
        where = source.where
        try:
            tree = _items(source.data, 12, len(source.data), _DEPTH)
            scan = _first_scan(tree.get("1D_Data"), where)
            count = int.from_bytes(scan["NumPoints"], "little")
            scale, extent = _quantity(scan["DataScale"], where), _quantity(scan["Extent"], where)
            raw = scan["Array"]
            kind, size = raw[0], struct.unpack_from("<I", raw, 1)[0]
        except (struct.error, IndexError, KeyError, TypeError, UnicodeDecodeError) as error:
            raise InputError(f"damaged or unknown OPDx layout ({error})", where=where) from None
        if (kind, size) != (0x0D, 8):
            raise InputError("heights are not in double precision", where=where, value=(kind, size))
        checked_count(count, (len(raw) - 5) // 8, where)
        with np.errstate(over="ignore", invalid="ignore"):  # a height beyond all numbers is none
            heights = np.frombuffer(raw, "<f8", count, 5) * scale
        present = np.isfinite(heights)
        origin: dict[str, object] = {"format": self.format}
        settings = tree.get("MetaData")
        if isinstance(settings, dict):
            texts = {key: value for key, value in settings.items() if isinstance(value, str)}
            origin.update({key.lower(): value for key, value in texts.items()})
        return make_profile(source, heights, extent / (count - 1), origin, present=present)


def _first_scan(data: object, where: str) -> dict:
    if isinstance(data, dict):
        for value in data.values():
            if isinstance(value, dict) and "Array" in value:
                return value
    raise InputError("no one-dimensional scan in the file", where=where)


def _items(data: bytes, start: int, end: int, depth: int) -> dict:
    """Items between two places: containers as dict, text as str, all else as bytes."""
    if depth == 0:
        raise IndexError("nested too deep")
    found: dict[str, object] = {}
    while start < end:
        name, start = _text(data, start, end)
        kind, start = data[start], start + 1
        if kind == 0x7F:
            break
        if kind in _FIXED:
            size = _FIXED[kind]
        elif kind in _BLOCKS + _TYPED_BLOCKS + _CONTAINERS:
            if kind in _TYPED_BLOCKS:
                _, start = _text(data, start, end)
            width = data[start]
            size = int.from_bytes(data[start + 1 : start + 1 + width], "little")
            start += 1 + width
        else:
            raise KeyError(f"item type {kind:#x}")
        if start + size > end:
            raise IndexError(f"item {name[:40]!r} runs past its end")
        block = data[start : start + size]
        if kind in _CONTAINERS:
            found.setdefault(name, _items(data, start, start + size, depth - 1))
        else:
            found.setdefault(name, block.decode("utf-8", "replace") if kind == 0x12 else block)
        start += size
    return found


def _text(data: bytes, start: int, end: int) -> tuple[str, int]:
    size = struct.unpack_from("<I", data, start)[0]
    if start + 4 + size >= end:
        raise IndexError("a name runs past its end")
    return data[start + 4 : start + 4 + size].decode("utf-8", "replace"), start + 4 + size


def _quantity(block: bytes, where: str) -> float:
    """A number with its unit of length, in metres."""
    value = struct.unpack_from("<d", block)[0]
    unit, _ = _text(block, 8, len(block))
    return value * metres(unit, where)
