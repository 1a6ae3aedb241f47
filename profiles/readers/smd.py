"""SMD softgauge profiles (ISO 5436-2)."""

from __future__ import annotations

import math

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, checked_count, make_profile
from profiles.readers.numbers import table
from profiles.units import metres, number_of


class SmdReader:
    """SMD: record 1 with the axes, record 2 with notes, record 3 with heights, record 4 with a checksum.

    Records end with the character 3; fields may end with the character 0. Only equally spaced profiles (axis ``CX I``)
    are read; the checksum is not verified. No file of an instrument was available: the layout follows NPL's softgauge
    help page and a public writer, checked on constructed files.
    """

    name = "SMD"
    format = "software measurement standard, ISO 5436-2"

    def magic(self, source: Source) -> bool:
        return source.data.startswith(b"ISO 5436") and b"PRF" in source.data[:400]

    def read(self, source: Source) -> Profile:
        where = source.where
        text = source.data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")
        records = [record.strip("\n") for record in text.split("\x03")]
        if len(records) < 3:
            raise InputError("cut off: an SMD file has a header, notes and heights", where=where)
        axes = {}
        for line in records[0].split("\n"):
            words = line.replace("\x00", " ").split()
            if words and words[0] in ("CX", "CZ"):
                axes[words[0]] = words
        count, _, step_scale, step = _axis(axes.get("CX"), 7, where)
        if axes["CX"][1] != "I":
            raise InputError("only equally spaced profiles (I) are read", where=f"{where}: CX", value=axes["CX"][1])
        points, _, scale, _ = _axis(axes.get("CZ"), 5, where)
        heights = table(records[2].replace("\x00", ""), f"{where}: heights").alone(where).columns
        if heights.shape[0] != 1 or heights.shape[1] != count or points != count:
            raise InputError(f"the header declares {count} and {points} points", where=where, value=heights.shape[1])
        checked_count(count, heights.shape[1], where)
        notes = [line.replace("\x00", "").strip() for line in records[1].split("\n")]
        origin: dict[str, object] = {"format": self.format, "notes": tuple(note for note in notes if note)}
        return make_profile(source, heights[0] * scale, step * step_scale, origin)


def _axis(words: list[str] | None, least: int, where: str) -> tuple[int, str, float, float]:
    """Points, unit, metres per written number, and step of an axis line ``CX I 22401 mm 1.0e0 D 2.5e-4``."""
    if words is None or len(words) < least:
        raise InputError("the axis line is missing or cut off", where=where, value=words)
    try:
        count, scale = int(words[2]), number_of(words[4])
        step = number_of(words[6]) if len(words) > 6 else math.nan
    except ValueError:
        raise InputError("not a number in the axis line", where=f"{where}: {words[0]}", value=" ".join(words)) from None
    return count, words[3], scale * metres(words[3], f"{where}: {words[0]}"), step
