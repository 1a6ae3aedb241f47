"""Speeds of single surfaces, which are neither entrainment nor sliding speed."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mixedlub.importers.cell_columns import Cells, values_of
from mixedlub.schema.units import change_to, split, words_of
from profiles.errors import InputError

SIDES = (("1", "2"), ("a", "b"), ("disc", "ball"), ("disk", "ball"), ("lower", "upper"), ("scheibe", "kugel"))
"""Words that distinguish the speeds of two surfaces."""
SPEED = re.compile(r"speed|velocity|geschwindigkeit|^[uv]\W?(?:\d|\b)")
EQUAL_WITHIN = 0.02
"""Relative difference from the mean speed up to which two surfaces move equally: beyond slip by creep alone."""
FROM_BOTH_SPEEDS = {
    "entrainment_speed_m_s": "entrainment is the mean with that of",
    "sliding_speed_m_s": "sliding is the difference to that of",
}


SUM = re.compile(r"\bsum\b|\bsumme|\b[uv][ _]?1 *\+ *[uv][ _]?2\b|\b[uv][ _]?(?:sum|\u03c3)\b")
"""Words of the sum of both surface speeds, which is twice the entrainment speed."""
TURNING = (
    "surface speeds are pi n R/30 with n in 1/min and R in m; entrainment is their mean, the slide-roll ratio their "
    "difference over the mean"
)


def halved_sum(speeds: np.ndarray, header: str) -> tuple[np.ndarray, str]:
    """Entrainment speed from a column, with a note if that is the sum of both surface speeds.

    >>> halved_sum(np.array([4.0]), "Sum speed u1+u2 (m/s)")[0].tolist(), halved_sum(np.array([4.0]), "u (m/s)")[1]
    ([2.0], '')
    """
    if not SUM.search(words_of(header)):
        return speeds, ""
    return 0.5 * speeds, f"{header!r} is a sum of both surface speeds: half of it is the entrainment_speed_m_s"


def turning(cells: Cells) -> list[str]:
    """Headers of rotational speeds of two bodies.

    >>> turning({"n1 (U/min)": ["1"], "n2 (min-1)": ["1"], "motor (rpm)": ["1"]})
    ['n1 (U/min)', 'n2 (min-1)']
    """
    words = {words_of(h): h for h in cells if change_to(split(h)[1] or "", "rpm") is not None}
    return [h for w, h in words.items() if any(other in words for other in _opposite(w))]


def other_surface(header: str, cells: Cells) -> str | None:
    """Header of the other surface's speed, if the table has both speeds and they differ.

    >>> other_surface("v1 (m/s)", {"v1 (m/s)": ["2.0", "4.0"], "v2 (m/s)": ["1.0", "2.0"], "mu": ["0.1", "0.2"]})
    'v2 (m/s)'
    >>> other_surface("v1 (m/s)", {"v1 (m/s)": ["2.0", "4.0"], "v2 (m/s)": ["2.0", "4.0"]})
    """
    unit, words = split(header)[1], words_of(header)
    if not (SPEED.search(words) if unit is None else change_to(unit, "m_s")):
        return None
    same_unit = {words_of(h): h for h in cells if split(h)[1] == unit}
    for other in (same_unit[w] for w in _opposite(words) if w in same_unit):
        both = np.abs([values_of(cells[header]), values_of(cells[other])])
        first, second = both[:, np.isfinite(both).all(axis=0)]
        if not first.size:
            continue
        if np.max(np.abs(first - second)) > 2.0 * EQUAL_WITHIN * np.max(np.abs(first)):
            return other
    return None


def _opposite(words: str) -> Iterator[str]:
    for pair in SIDES:
        for one, other in (pair, pair[::-1]):
            edge = "0-9" if one.isdigit() else "a-z0-9"
            changed = re.sub(rf"(?<![{edge}]){one}(?![{edge}])", other, words)
            if changed != words:
                yield changed


def refuse_one_surface(headers: Mapping[str, str], cells: Cells, name: str) -> None:
    """Raise an error if the speed of one of two recorded surfaces is taken as the speed of the contact.

    With one surface at rest, the speed of the other is the sliding speed.

    >>> cells = {"Disc Speed (m/s)": ["1.0", "2.0"], "Ball Speed (m/s)": ["0", "0"]}
    >>> refuse_one_surface({"entrainment_speed_m_s": "Ball Speed (m/s)"}, {"Ball Speed (m/s)": ["1.0"]}, "a.txt")
    >>> refuse_one_surface({"sliding_speed_m_s": "Disc Speed (m/s)"}, cells, "a.txt")
    >>> refuse_one_surface({"entrainment_speed_m_s": "Disc Speed (m/s)"}, cells, "a.txt")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: a.txt: entrainment_speed_m_s: 'Disc Speed (m/s)': is the speed of one surface; \
    entrainment is the mean with that of 'Ball Speed (m/s)': add a column of it to the file
    """
    for column, made in FROM_BOTH_SPEEDS.items():
        taken = headers.get(column)
        other = None if taken is None else other_surface(taken, cells)
        if other is None or (column == "sliding_speed_m_s" and _at_rest(cells[other])):
            continue
        rule = f"is the speed of one surface; {made} {other!r}: add a column of it to the file"
        raise InputError(rule, where=f"{name}: {column}", value=taken)


def _at_rest(cells: Sequence[str]) -> bool:
    return not np.nan_to_num(values_of(cells)).any()
