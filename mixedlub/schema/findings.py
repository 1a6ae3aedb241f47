"""Findings: messages on an input or a result, each with a code for programs."""

from __future__ import annotations

import re
import tomllib
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from functools import cache
from importlib.resources import files

from profiles.errors import nearest

PLACES_LISTED = 3
"""Largest number of places listed for a group of findings; longer lists are not read."""
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


class Severity(StrEnum):
    """Severity of a finding, in ascending order."""

    NOTE = "note"
    """Something was assumed, replaced or left out."""
    CAUTION = "caution"
    """A part of the input is implausible, or a part of the result is not reliable."""
    DOUBT = "doubt"
    """All computed numbers are in question."""


@dataclass(frozen=True)
class FindingKind:
    """Meaning of a code and its default severity."""

    severity: Severity
    meaning: str


@cache
def registered() -> Mapping[str, FindingKind]:
    """Kinds of findings by code.

    >>> registered()["columns_unknown"].severity
    <Severity.NOTE: 'note'>
    """
    table = tomllib.loads(files("mixedlub.schema").joinpath("findings.toml").read_text(encoding="utf-8"))
    return {code: FindingKind(Severity(entry["severity"]), entry["meaning"]) for code, entry in table.items()}


@dataclass(frozen=True)
class Finding:
    """Message to the user: kind, severity, place and text.

    The place is a file, key, column or run; empty for the input or the result as a whole.

    >>> str(finding("columns_unknown", "columns ignored: colour", "recordings.csv"))
    'recordings.csv: columns ignored: colour'
    >>> finding("colums_unknown", "columns ignored: colour")
    Traceback (most recent call last):
    ...
    ValueError: 'colums_unknown': no such kind of finding; nearest known: 'columns_unknown'
    """

    code: str
    severity: Severity
    place: str
    text: str

    def __post_init__(self) -> None:
        _kind(self.code)

    def __str__(self) -> str:
        return f"{self.place}: {self.text}" if self.place else self.text


def finding(code: str, text: str, place: str = "", severity: Severity | None = None) -> Finding:
    """Finding of a registered kind, with the default severity of the kind unless given."""
    return Finding(code, severity or _kind(code).severity, place, text)


def _kind(code: str) -> FindingKind:
    try:
        return registered()[code]
    except KeyError:
        raise ValueError(f"{code!r}: no such kind of finding; {nearest(code, registered())}") from None


class FindingWarning(UserWarning):
    """Python warning that carries a finding out of a function with another return value."""

    def __init__(self, found: Finding) -> None:
        super().__init__(str(found))
        self.finding = found


class CautionWarning(UserWarning):
    """Caution or doubt about a Python call; its text begins with the severity."""


def gravest_first(found: Iterable[Finding]) -> list[Finding]:
    """Findings by descending severity, otherwise in their order."""
    return sorted(found, key=lambda one: -list(Severity).index(one.severity))


def as_texts(found: Iterable[Finding]) -> list[str]:
    """Findings as printed by the commands: severity, place and text, merged by kind.

    >>> as_texts([finding("columns_unknown", "columns ignored: colour", "recordings.csv")])
    ['note: recordings.csv: columns ignored: colour']
    """
    return [f"{one.severity}: {one}" for one in grouped(found)]


def warn_of(found: Iterable[Finding], stacklevel: int = 3) -> None:
    """Warn once of each caution and doubt, by default at the line of the caller's caller; notes do not warn."""
    for text in as_texts(of_severity(found, Severity.CAUTION, Severity.DOUBT)):
        warnings.warn(text, CautionWarning, stacklevel=stacklevel)


def report(found: Finding) -> None:
    """Report a finding to the active `collected` context, or else as a Python warning."""
    warnings.warn(FindingWarning(found), stacklevel=3)


@contextmanager
def collected() -> Iterator[list[Finding]]:
    """Collect the distinct findings reported in the context; other warnings pass through.

    >>> with collected() as found:
    ...     report(finding("columns_unknown", "columns ignored: colour", "recordings.csv"))
    >>> [one.code for one in found]
    ['columns_unknown']
    """
    found: list[Finding] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield found
    for w in caught:
        if isinstance(w.message, FindingWarning):
            found += [w.message.finding] if w.message.finding not in found else []
        else:
            warnings.warn_explicit(w.message, w.category, w.filename, w.lineno)


def codes(found: Iterable[Finding]) -> list[str]:
    """Codes of the findings."""
    return [one.code for one in found]


def of_severity(found: Iterable[Finding], *wanted: Severity) -> tuple[Finding, ...]:
    """Findings of the given severities."""
    return tuple(one for one in found if one.severity in wanted)


def grouped(found: Iterable[Finding]) -> tuple[Finding, ...]:
    """Merge findings of a kind that differ only in place or number; the merged finding lists the places.

    >>> runs = [finding("reading_too_large", f"reads {y}, far above the others", f"run {y}") for y in (70, 80, 90)]
    >>> print(*grouped(runs))
    run 70: reads 70, far above the others; likewise run 80, run 90
    >>> traces = [finding("cutoff_assumed", "cutoff_mm = 0.8 assumed", f"surfaces.{name}") for name in "abcde"]
    >>> print(*grouped(traces))
    surfaces.a, surfaces.b, surfaces.c and 2 more: cutoff_mm = 0.8 assumed
    """
    groups: dict[tuple[str, Severity, bool, str], list[Finding]] = {}
    for one in found:
        alike = (one.code, one.severity, bool(one.place), NUMBER.sub("#", one.text) if one.place else one.text)
        groups.setdefault(alike, []).append(one)
    return tuple(_as_one(group) for group in groups.values())


def _as_one(group: Sequence[Finding]) -> Finding:
    first, *others = group
    places = list(dict.fromkeys(one.place for one in group))
    if len(places) == 1:
        return first
    if all(one.text == first.text for one in others):
        return replace(first, place=listed(places))
    return replace(first, text=f"{first.text.removesuffix('.')}; likewise {listed(places[1:])}")


def listed(items: Sequence[object], most: int = PLACES_LISTED) -> str:
    """First items and the number of remaining items.

    >>> listed([3, 4]), listed([1, 2, 3, 4, 5])
    ('3, 4', '1, 2, 3 and 2 more')
    """
    more = len(items) - most
    return ", ".join(map(str, items[:most])) + (f" and {more} more" if more > 0 else "")


def as_records(found: Iterable[Finding]) -> list[dict[str, str]]:
    """Findings as JSON-compatible dictionaries.

    >>> as_records([finding("columns_unknown", "columns ignored: colour", "recordings.csv")])[0]["severity"]
    'note'
    """
    return [{**asdict(one), "severity": one.severity.value} for one in found]
