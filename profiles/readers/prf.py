"""Taylor Hobson PRF text profiles."""

from __future__ import annotations

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.base import Source, checked_count, make_profile
from profiles.units import known_length, metres, number_of


class PrfReader:
    """PRF: ``CX`` and ``CZ`` axes, settings with ``SPACING CX``, heights as numbers, each part ended by EOR.

    A height is number x scale x unit of the ``CZ`` line; the spacing has the unit of ``CX``. The format has no masked
    points. No file of an instrument was available: the layout follows NPL's softgauge help page, a public reader and a
    public writer, checked on constructed files.
    """

    name = "PRF"
    format = "Taylor Hobson PRF text"

    def magic(self, source: Source) -> bool:
        lines = source.data[:300].split(b"\n")
        return len(lines) > 2 and lines[1].split()[-1:] == [b"PRF"] and lines[2].split()[:1] == [b"CX"]

    def read(self, source: Source) -> Profile:
        where = source.where
        parts: list[list[list[str]]] = [[]]
        for line in source.data.decode("latin-1").splitlines():
            words = line.split()
            if words == ["EOR"]:
                parts.append([])
            elif words:
                parts[-1].append(words)
        if len(parts) < 3 or not parts[2]:
            raise InputError("cut off: a PRF file has axes, settings and heights", where=where)
        lines = {words[0]: words for part in parts[:2] for words in part}
        spacing_line = next((w for w in parts[1] if w[:2] == ["SPACING", "CX"] and len(w) > 2), None)
        if len(lines.get("CX", [])) < 5 or len(lines.get("CZ", [])) < 5 or spacing_line is None:
            raise InputError("the lines CX, CZ and SPACING CX are needed", where=where)
        if len(parts) == 3:
            raise InputError("cut off: the heights do not end with EOR", where=where)
        try:
            count = round(number_of(lines["CZ"][2]))
            scale = number_of(lines["CZ"][4]) * metres(lines["CZ"][3], f"{where}: CZ")
            spacing = number_of(spacing_line[2]) * number_of(lines["CX"][4]) * metres(lines["CX"][3], f"{where}: CX")
            heights = np.array([number_of(words[0]) for words in parts[2]])
        except (ValueError, OverflowError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"not a number ({error})", where=where) from None
        if checked_count(count, heights.size, where) != heights.size:
            raise InputError(f"the header declares {count} points", where=where, value=heights.size)
        origin: dict[str, object] = {"format": self.format}
        match lines.get("STYLUS_RADIUS"):
            case [_, digits, unit, *_] if known_length(f"{digits} {unit}"):
                origin["tip_radius"] = known_length(f"{digits} {unit}")
        return make_profile(source, heights * scale, spacing, origin)
