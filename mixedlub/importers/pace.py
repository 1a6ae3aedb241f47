"""Recordings against cycles or a distance: seconds by what one cycle takes, or by the speed, which is asked."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.importers.draft import Answers, Question
from mixedlub.importers.sheet import COUNTED, Cells, are_numbers
from mixedlub.importers.vocabulary import BY_NAME, Target
from mixedlub.schema.units import change_to, fits, rounded, split, words_of
from profiles.errors import InputError

TIME = "time_s"
CYCLES = re.compile(
    r"(?:(?:number|no|nr|total)\W+)?(?:of )?(?:cycles?|strokes|revolutions|laps)(?:\W+(?:number|no|nr|#))?"
)
DISTANCES = re.compile(r"(?:total |test )?(?:distance|sliding distance|sliding path)(?: slid)?")
NO_UNIT = (*COUNTED, "-", "1")


@dataclass(frozen=True)
class Pace:
    """What turns a count into seconds: the answer that tells it, what to ask, an example, what is said of it."""

    key: str
    text: str
    example: str
    said: str


PACES: Mapping[str, Pace] = {
    "cycle": Pace(
        "import.seconds_a_cycle",
        "Seconds that a cycle takes, as {header!r} counts cycles",
        "0.5",
        "{header!r} times {rate:g} s a cycle",
    ),
    "m": Pace(
        "import.speed_m_s",
        "Sliding speed in m/s that was held, as {header!r} is a distance",
        "0.1",
        "{header!r} over {rate:g} m/s",
    ),
}
"""By the unit that is counted in."""
KEYS = tuple(pace.key for pace in PACES.values())


def unit_of_count(header: str) -> str | None:
    """The unit of a header that may hold a time: cycles have none of their own.

    >>> unit_of_count("Cycle"), unit_of_count("No. of cycles [-]"), unit_of_count("Distance (km)"), unit_of_count("t")
    ('cycle', 'cycle', 'km', None)
    """
    unit = split(header)[1]
    bare = unit is None or unit.lower() in NO_UNIT
    return "cycle" if bare and CYCLES.fullmatch(words_of(header)) else unit


def counted(header: str) -> str | None:
    """In what a header says that it counts instead of time: cycles or metres.

    >>> [counted(h) for h in ("Cycles", "Sliding distance [m]", "Distance", "Stroke (mm)", "Cycle time (s)")]
    ['cycle', 'm', 'm', None, None]
    """
    unit = unit_of_count(header)
    if unit == "cycle":
        return unit
    long = unit is None or change_to(unit, "m") is not None
    return "m" if long and DISTANCES.fullmatch(words_of(header)) else None


def header_of_count(cells: Cells) -> str | None:
    """The header that counts cycles or a distance."""
    return next((h for h in cells if counted(h) is not None and are_numbers(cells[h])), None)


def headers_in_time(cells: Cells) -> list[str]:
    """The headers of numbers in a unit of time, whatever their words."""
    in_time = [h for h in cells if fits(split(h)[1] or "", BY_NAME[TIME].unit)]
    return [h for h in in_time if are_numbers(cells[h])]


def target_in(target: Target, unit: str) -> Target:
    """The target with the unit that its column is counted in; a time may be counted in cycles or metres."""
    family = next((f for f in PACES if target.name == TIME and change_to(unit, f) is not None), target.unit)
    return replace(target, unit=family)


def pace_questions(headers: Mapping[str, str], units: Mapping[str, str], answers: Answers) -> list[Question]:
    """What to ask of a column that counts; an error about an answer that the column taken as time has no use for."""
    header = headers.get(TIME)
    if header is None or not (header == TIME or TIME in units):
        return []
    unit = units.get(TIME, BY_NAME[TIME].unit)
    family = target_in(BY_NAME[TIME], unit).unit
    idle = next((p.key for f, p in PACES.items() if f != family and p.key in answers), None)
    if idle is not None:
        raise InputError(f"{TIME} is taken from {header!r}, in {unit}, and has no use for it", where=idle)
    if family not in PACES or PACES[family].key in answers:
        return []
    pace = PACES[family]
    return [Question(pace.key, f"{pace.text.format(header=header)} and {TIME} is in seconds", pace.example)]


def in_seconds(values: np.ndarray, header: str, unit: str, answers: Answers) -> tuple[np.ndarray, str]:
    """What was counted as seconds, and what was done in words; a time stays as it is, and nothing is said."""
    family = target_in(BY_NAME[TIME], unit).unit
    if family not in PACES:
        return values, ""
    rate = answers[PACES[family].key]
    if isinstance(rate, bool) or not isinstance(rate, int | float) or not 0.0 < rate < math.inf:
        raise InputError("must be a number above 0", where=PACES[family].key, value=rate)
    seconds = rounded(values * rate if family == "cycle" else values / rate)
    return seconds, f"{TIME} is {PACES[family].said.format(header=header, rate=rate)}"
