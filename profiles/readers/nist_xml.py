"""Softgauge XML of the NIST surface metrology database."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.archive import MAX_UNPACKED, check_xml
from profiles.readers.base import Source, checked_count, foreign_parser, make_profile
from profiles.units import known_unit, metres, number_of

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element


class NistXmlReader:
    """NIST XML: ``DATAFILE`` with UNITS, NUMPOINTS, SPACING and DATA_POINT_VALUES.

    NIST's parameters go to ``origin["stated"]``; a short cut-off before them to ``origin["stated_short_cutoff"]``.
    Checked against four softgauges (NPL mill and EDM, ASME sine and square).
    """

    name = "NIST XML"
    format = "NIST softgauge XML"

    def magic(self, source: Source) -> bool:
        head = source.data[:2048]
        return b"<DATA>" in head and b"<?xml" in head

    def read(self, source: Source) -> Profile:
        where = source.where
        if len(source.data) > MAX_UNPACKED:
            raise InputError(f"XML above {MAX_UNPACKED} bytes is not read", where=where, value=len(source.data))
        check_xml(source.data, where)
        from xml.etree import ElementTree

        with foreign_parser("XML", where):
            root = ElementTree.fromstring(source.data)
        file = root.find("DATAFILE")
        if file is None:
            raise InputError("no element DATAFILE", where=where)
        unit = file.findtext("UNITS", "").strip()
        scale = metres(unit, f"{where}: UNITS")
        try:
            count = int(file.findtext("NUMPOINTS", ""))
            spacing = number_of(file.findtext("SPACING", "")) * scale
            heights = np.array([number_of(word) for word in file.findtext("DATA_POINT_VALUES", "").split()]) * scale
        except ValueError as error:
            raise InputError(f"not a number ({error})", where=f"{where}: DATAFILE") from None
        if checked_count(count, heights.size, where) != heights.size:
            raise InputError(f"the header declares {count} points", where=where, value=heights.size)
        origin: dict[str, object] = {"format": self.format, "convention": "NIST"}
        after, short = _values(root, "SHORT_CUTOFF_PROFILE"), _short_cutoff(root)
        if after and short:
            origin |= {"stated": after, "stated_short_cutoff": short}
        elif raw := _values(root, "RAW_PROFILE"):
            origin["stated"] = raw
        origin["part"] = (root.findtext("PART/PART_DESCRIPTION") or "").strip()
        return make_profile(source, heights, spacing, origin)


def _short_cutoff(root: Element) -> float | None:
    """Short cut-off (m) applied by NIST, or None."""
    try:
        cutoff = number_of(root.findtext("ANALYSIS/FILTER/SHORT_CUTOFF", "")) * metres(
            root.findtext("ANALYSIS/FILTER/UNITS", "")
        )
    except ValueError:
        return None
    return cutoff if cutoff > 0 else None


def _values(root: Element, profile: str) -> dict[str, float]:
    """Parameters of one profile by ISO symbol, lengths in m; empty entries are left out."""
    results = root.find(f".//{profile}_SURFACE_PARAMETERS")
    if results is None:
        return {}
    unit = known_unit(results.findtext("UNITS", "").strip())
    scale = metres(unit) if unit else 1.0
    found = {}
    for item in results:
        try:
            value = number_of(item.text or "")
        except ValueError:
            continue
        name = item.tag.capitalize() if item.tag.isupper() else item.tag.replace("Dq", "dq")
        found[name] = value if name[1:] in ("sk", "ku", "dq") else value * scale
    return found
