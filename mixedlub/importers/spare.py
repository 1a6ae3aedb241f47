"""Headers that nothing is taken from although they come near to a column that a kind would take into account."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable, Mapping, Sequence

from mixedlub.importers.draft import Question
from mixedlub.importers.likely import likely_headers
from mixedlub.importers.sheet import Cells, are_numbers
from mixedlub.schema.table import Column
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import split, words_of

SLIP = "slide_roll_ratio"
SLIDES = re.compile(r"\b(?:slip|schlupf|slid|gleit)")
"""Words of a share in percent that may be the slip."""
NO_CONDITION = ("stress", "spannung", "friction", "traction", "reib")
"""What a header says that has the unit or the words of a condition and is none: a stress, a friction at some slip."""


def spare_headers(columns: Iterable[Column], cells: Cells) -> dict[str, str]:
    """The header that may hold each of the columns, none of which is needed; a share of sliding may be the slip.

    >>> spare_headers([Column("pressure_MPa"), Column("slide_roll_ratio")], {"p (bar)": ["1", "5"], "note": ["", "x"]})
    {'pressure_MPa': 'p (bar)'}
    >>> spare_headers([Column("slide_roll_ratio")], {"Schlupf (%)": ["1", "5"]})
    {'slide_roll_ratio': 'Schlupf (%)'}
    >>> spare_headers([Column("slide_roll_ratio")], {"Pump speed (%)": ["90", "100"]})
    {}
    """
    names = [column.name for column in columns if column.form == "number" and not column.blank]
    cells = {h: values for h, values in cells.items() if not any(word in h.lower() for word in NO_CONDITION)}
    found = likely_headers(names, cells)
    shares = [h for h in cells if split(h)[1] == "%" and SLIDES.search(words_of(h)) and h not in found.values()]
    slip = next((h for h in shares if are_numbers(cells[h])), None)
    if SLIP in names and SLIP not in found and slip is not None:
        found[SLIP] = slip
    return found


def spare_questions(spare: Mapping[str, str], key: str) -> list[Question]:
    """Whether to take them, asked where somebody can answer."""
    text = "is taken into account where it is recorded: header of its column"
    return [Question(key + column, f"{column} {text}", toml_value(h), needed=False) for column, h in spare.items()]


def spare_notes(spare: Mapping[str, str], key: str) -> Sequence[str]:
    """What is left out, and the setting that takes it."""
    return [
        f"{h!r} is not taken; if it is {column}, say --set {shlex.quote(f'{key}{column}={toml_value(h)}')}"
        for column, h in spare.items()
    ]
