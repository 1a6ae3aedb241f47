"""Columns left out although the reading depends on them: questions before the case is written, or notes."""

from __future__ import annotations

import re
import shlex
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS
from mixedlub.importers.base import Answers, Question
from mixedlub.importers.cell_columns import Cells, is_numeric, values_of
from mixedlub.importers.text_table import ONLY
from mixedlub.schema.toml_file import toml_value
from mixedlub.schema.units import words_of
from profiles.errors import InputError, nearest

LEAVE = "import.leave"
"""Key of the headers left out on purpose although readings change with them."""
CHECK = "recording.check"
SHEAR_RATE = re.compile(r"\b(?:shear[ _-]?rate|scherrate|schergeschwindigkeit|schergefälle)\b")
FEWEST = 3
"""Judgement. Fewest distinct values of a column and readings at equal conditions that show a dependence."""
FOLLOWS, RELATED = 0.9, 0.7
"""Judgement. Rank correlation with the reading at which it depends on the column, at equal conditions; at which a note
reports the column, over all rows."""
MOST_SAID = 3
"""Judgement. Most columns reported as changing with the reading."""


def questions(
    free: Cells,
    conditions: Collection[np.ndarray],
    reading: np.ndarray,
    answers: Answers,
    offered: Mapping[str, str],
) -> list[Question]:
    """Question on omitted columns that explain readings at equal conditions or are shear rates.

    ``offered``: keys that import a column, by its header in TOML.
    """
    left = answers.get(LEAVE, [])
    listed = [left] if isinstance(left, str) else list(left)
    unknown = next((header for header in listed if header not in free), None)
    if unknown is not None:
        raise InputError(f"is no column that is left out; {nearest(str(unknown), free)}", where=LEAVE, value=unknown)
    groups = equal_rows(conditions, reading.size)
    open_columns = [h for h, cells in free.items() if h not in listed and _decides(h, cells, groups, reading)]
    if not open_columns:
        return []
    names = ", ".join(map(repr, open_columns))
    rates = [h for h in open_columns if SHEAR_RATE.search(words_of(h))]
    reason = f"no kind takes a shear rate ({rates[0]!r})" if rates else "readings at equal conditions change with it"
    one = open_columns[0]
    only = shlex.quote(f"{ONLY}{one}={free[one][0]}")
    take = shlex.quote(f"{offered.get(toml_value(one), COLUMNS + 'COLUMN')}={toml_value(one)}")
    text = f"{names} would be left out, and {reason}: keep rows of one value (--set {only}), take it by its column "
    text += f"(--set {take}), or leave it out all the same"
    if listed:
        raise InputError(text, where=LEAVE, value=listed)
    return [Question(LEAVE, text, toml_value(open_columns))]


def equal_rows(conditions: Collection[np.ndarray], rows: int) -> list[np.ndarray]:
    """Groups of rows at equal conditions, each with enough readings to show a dependence.

    >>> [group.tolist() for group in equal_rows([np.array([1.0, 2.0, 1.0, 1.0])], 4)]
    [[0, 2, 3]]
    """
    point = np.zeros(rows, dtype=int)
    for values in conditions:
        numbered = np.unique(values, return_inverse=True)[1].reshape(-1)
        point = np.unique(point * (numbered.max(initial=0) + 1) + numbered, return_inverse=True)[1].reshape(-1)
    order = np.argsort(point, kind="stable")
    starts = np.flatnonzero(np.diff(point[order], prepend=-1))
    return [group for group in np.split(order, starts[1:]) if group.size >= FEWEST]


def _decides(header: str, cells: Sequence[str], groups: Sequence[np.ndarray], reading: np.ndarray) -> bool:
    """Whether a column is a varying shear rate or orders the readings at equal conditions."""
    if not is_numeric(cells):
        return False
    values = values_of(cells)
    if np.unique(values[np.isfinite(values)]).size < 2:
        return False
    if SHEAR_RATE.search(words_of(header)):
        return True
    related = [
        abs(_rank_correlation(values[rows], reading[rows])) for rows in groups if np.unique(values[rows]).size >= FEWEST
    ]
    return len(related) >= 2 and float(np.median(related)) >= FOLLOWS


def _rank_correlation(one: np.ndarray, other: np.ndarray) -> float:
    from scipy.stats import rankdata

    known = np.isfinite(one) & np.isfinite(other)
    first, second = rankdata(one[known]), rankdata(other[known])
    if known.sum() < FEWEST or np.ptp(first) == 0.0 or np.ptp(second) == 0.0:
        return 0.0
    return float(np.corrcoef(first, second)[0, 1])


def changing_with(free: Cells, reading: np.ndarray) -> dict[str, float]:
    """Omitted columns by their rank correlation with the reading, strongest first."""
    related = {
        h: abs(_rank_correlation(values_of(cells), reading)) for h, cells in free.items() if is_numeric(cells) and cells
    }
    near = sorted((h for h, share in related.items() if share >= RELATED), key=lambda h: -related[h])
    return {header: related[header] for header in near[:MOST_SAID]}


def channel_offers(related: Mapping[str, float], quantity: str, answers: Answers) -> tuple[list[Question], list[str]]:
    """Offer to keep the omitted column that changes most with the reading as a second channel, and notes on all."""
    notes = [
        f"{header!r} is not taken, and changes with {quantity} (rank correlation {share:.2f})"
        for header, share in related.items()
    ]
    if not related or CHECK in answers:
        return [], notes
    header = next(iter(related))
    notes[0] += f"; --set {shlex.quote(f'{CHECK}={toml_value(header)}')} keeps it as a second channel"
    text = f"{header!r} would be left out, and changes with {quantity}: keep it as a second channel"
    return [Question(CHECK, text, toml_value(header), needed=False)], notes


def setup_offers(pooled: Collection[str], taken: Collection[str]) -> list[Question]:
    """Offer to take a column that tells specimens apart as the set-up."""
    if not pooled or "setup" in taken:
        return []
    header = next(iter(pooled))
    text = f"{header!r} tells rows of different things apart: take it as the set-up, whose readings share an error"
    return [Question(f"{COLUMNS}setup", text, toml_value(header), needed=False)]
