"""Rejection of tables that fit no kind, in place of questions for an unlikely kind."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS
from mixedlub.importers.base import Answers
from mixedlub.importers.cell_columns import Cells
from mixedlub.importers.kinematic import VISCOSITY
from mixedlub.importers.likeness import likely_headers, likeness_of_reading
from mixedlub.kinds import NATIVE
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.findings import listed
from mixedlub.schema.units import words_of
from profiles.errors import InputError

LOGARITHM = re.compile(r"(?:\b|_)(?:ln|lg|log(?:2|10|e)?)(?:\b|_|(?=visc|eta|nu))")
LARGEST_LOGARITHM = 15.0
"""Judgement. Largest natural logarithm of a viscosity in mPa s: 3e6 mPa s."""
HEADERS_SHOWN = 8


def holds_reading(cells: Cells, readings: Iterable[str]) -> bool:
    """Whether a column may be one of the readings."""
    return any(likeness_of_reading(q, cells, likely_headers([q], cells).get(q)) for q in readings)


def refuse_unrecognised(cells: Cells, name: str, answers: Answers) -> None:
    """Raise an error if no column may be the reading of any kind, unless an answer names a reading."""
    readings: dict[str, list[str]] = {}
    for kind in NATIVE:
        for quantity in kind_of(kind).quantities:
            readings.setdefault(quantity, []).append(kind)
    if any(COLUMNS + quantity in answers for quantity in readings) or holds_reading(cells, readings):
        return
    taken = ", ".join(f"{quantity} ({', '.join(kinds)})" for quantity, kinds in readings.items())
    rule = f"nothing here is recognised as a reading ({listed(list(cells), HEADERS_SHOWN)}); import takes {taken}. If "
    rule += f"a column is one of these, name the kind and the column: --set kind=KIND --set {COLUMNS}READING=HEADER"
    raise InputError(rule, where=name)


def logarithm_doubt(quantity: str, header: str, reading: np.ndarray) -> Iterator[str]:
    """Question on viscosities with header and size of a logarithm.

    >>> list(logarithm_doubt("viscosity_mPa_s", "lnviscosity", np.array([5.7, 2.4])))
    ["'lnviscosity' has a logarithm in its name, and values of 2.4 to 5.7 as logarithms have: are they viscosities?"]
    >>> list(logarithm_doubt("viscosity_mPa_s", "Logged viscosity", np.array([5.7, 2.4])))
    []
    """
    largest = float(np.max(reading, initial=-np.inf))
    if quantity == VISCOSITY and LOGARITHM.search(words_of(header)) and largest < LARGEST_LOGARITHM:
        ends = f"{float(np.min(reading)):g} to {largest:g}"
        yield (
            f"{header!r} has a logarithm in its name, and values of {ends} as logarithms have: are they viscosities?"
        )
