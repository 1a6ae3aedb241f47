"""Surfcom text export: .tx1 primary profile, .tx2 roughness profile, .tx3 settings."""

from __future__ import annotations

from dataclasses import replace

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source
from profiles.readers.numbers import decoded, table
from profiles.readers.text import read_table


class SurfcomReader:
    """Surfcom text: rows ``position, height`` in mm and um without a header, recognised by the ending of the name. The
    settings are in a separate .tx3: the cut-offs of a .tx2 are unknown, and the profile's ``steps`` say so. Checked
    against a public .tx1 file."""

    name = "Surfcom text"
    format = "Accretech Surfcom text, .tx1 .tx2"

    def magic(self, source: Source) -> bool:
        return source.bare.lower().endswith((".tx1", ".tx2", ".tx3"))

    def read(self, source: Source) -> Profile:
        kind = source.bare.lower()[-4:]
        if kind == ".tx3":
            raise InputError("a .tx3 file holds settings; the profiles are in .tx1 and .tx2", where=source.where)
        content = table(decoded(source.data, source.where), source.where)
        named = replace(source, unit=source.unit or ("mm", "um"))
        notes = ("roughness profile filtered by the instrument, cut-offs unknown",) if kind == ".tx2" else ()
        return read_table(named, content, {"format": self.format}, notes)
