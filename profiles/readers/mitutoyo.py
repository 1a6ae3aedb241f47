"""Mitutoyo SurfTest report (xlsx), by the library openpyxl."""

from __future__ import annotations

import io
import itertools
import re
import warnings

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.readers.archive import check_archive, member
from profiles.readers.base import MAX_POINTS, Source, foreign_parser, make_profile
from profiles.readers.positions import sampled
from profiles.readers.workbook import is_workbook
from profiles.units import known_unit, length, metres

_PARAMETER = re.compile(r"([A-Za-z][A-Za-z0-9()µμ]*)\s+([-+]?[0-9.]+)\s*(\S*)\s*\Z")
_SETTING = re.compile(r"(CUT|LS|CUV|N|FIL|STD)\s+(.*?)\s*\Z")


class MitutoyoReader:
    """SurfTest report: sheet DATA, column A the instrument's parameters, B its settings, E and F the profile.

    Position in mm, height in um. The instrument's values, its convention and its number of sampling lengths go
    to ``origin``, so that they can be recomputed and compared; the cut-offs of an R profile to ``cutoffs``.
    Checked against the two reports of SurfaceTopography.
    """

    name = "Mitutoyo report"
    format = "Mitutoyo SurfTest report, xlsx"

    def magic(self, source: Source) -> bool:
        return is_workbook(source.data) and b'name="DATA"' in member(source.data, "xl/workbook.xml")

    def read(self, source: Source) -> Profile:
        where = source.where
        check_archive(source.data, where)
        import openpyxl

        # openpyxl remarks on styles it does not know, which is nothing to the user of a profile.
        with foreign_parser("xlsx", where), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            book = openpyxl.load_workbook(io.BytesIO(source.data), read_only=True, data_only=True, keep_links=False)
            rows = [
                (row + (None,) * 6)[:6]
                for row in book["DATA"].iter_rows(max_col=6, max_row=MAX_POINTS, values_only=True)
            ]
            facts = list(book[book.sheetnames[0]].iter_rows(max_row=200, max_col=40, values_only=True))
        pairs = [(row[4], row[5]) for row in rows if row[4] is not None or row[5] is not None]
        for number, pair in enumerate(pairs, start=1):
            if not all(isinstance(value, int | float) for value in pair):
                raise InputError("not a number", where=f"{where}: DATA, point {number}", value=pair)
        if len(pairs) < 3:
            raise InputError("no profile in columns E and F of sheet DATA", where=where)
        x, z = np.array(pairs, dtype=float).T
        stated, unit = _stated([row[0] for row in rows if isinstance(row[0], str)], where)
        settings = _settings([row[1] for row in rows if isinstance(row[1], str)], facts)
        cutoffs = _cutoffs(settings, where)
        origin: dict[str, object] = {"format": self.format, "settings": settings, "convention": "Mitutoyo"}
        if stated:
            origin["stated"] = stated
        if settings.get("N", "").isdigit() and int(settings["N"]) > 0:
            origin["sampling_lengths"] = int(settings["N"])
        steps = ("roughness profile filtered by the instrument",) if cutoffs else ()
        trace = sampled(x, z * metres(unit, where), np.ones(z.size, bool), 1e-4, where)
        return make_profile(
            source,
            trace.heights,
            trace.step * 1e-3,
            origin,
            present=trace.present,
            steps=(*steps, *trace.notes),
            cutoffs=cutoffs,
        )


def _stated(lines: list[str], where: str) -> tuple[dict[str, float], str]:
    """Instrument values by ISO symbol, lengths in m, and the unit heights are written in."""
    found: dict[str, float] = {}
    unit = "um"
    for line in lines:
        match = _PARAMETER.match(line.strip())
        if not match:
            continue
        try:
            value = float(match[2])
        except ValueError:
            raise InputError("not a number", where=f"{where}: DATA, {match[1]}", value=match[2]) from None
        # the report writes Rku with the sign for micro
        name = match[1].replace("µ", "u").replace("μ", "u").replace("Dq", "dq")
        if known_unit(match[3]):
            value *= metres(match[3], where)
            unit = str(known_unit(match[3])) if name == "Ra" else unit
        found[name] = value
    return found, unit


def _settings(lines: list[str], facts: list[tuple]) -> dict[str, str]:
    """Settings of sheet DATA, completed from the certificate's pairs of neighbouring cells."""
    found = {match[1]: match[2] for line in lines if (match := _SETTING.match(line.strip()))}
    labels = {"Profile": "CUV", "Cut-Off": "CUT", "N": "N"}
    for row in facts:
        cells = [str(cell).strip() for cell in row if cell is not None]
        for label, value in itertools.pairwise(cells):
            if label in labels:
                found.setdefault(labels[label], value)
    return found


def _cutoffs(settings: dict[str, str], where: str) -> dict[str, float]:
    """Filter limits (m) of a roughness profile; none for a primary profile."""
    if settings.get("CUV") != "R":
        return {}
    names = {"CUT": "cutoff", "LS": "short_cutoff"}
    lengths = {names[k]: v.replace("mm", " mm").replace("µm", " um").strip() for k, v in settings.items() if k in names}
    return {name: length(text, f"{where}: {name}") for name, text in lengths.items() if text[:1].isdigit()}
