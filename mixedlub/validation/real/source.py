"""Recordings of the battery: where they come from, and what is known about them."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from profiles.errors import InputError, nearest

SOURCE, SPLIT = "source.toml", "split.toml"
SPLITS = ("development", "test")
REQUIRED = ("title", "authors", "year", "url", "licence", "obtained", "kind", "understood", "acts", "why")
OPTIONAL = ("doi", "rows", "faults", "fault_runs", "hidden", "paired")
OUTSIDE = "outside"
"""Start of a cause that has no id."""


@dataclass(frozen=True)
class Concealed:
    """A channel that can be hidden, or two groups of rows that differ by one known thing.

    ``right``: ids that name the cause; ``where``: columns at which the mismatch then sits; ``beside``: further columns
    that would give it away. ``values``: names of the two groups, none for a hidden channel.
    """

    column: str
    expected: str
    right: frozenset[str]
    where: frozenset[str]
    beside: tuple[str, ...] = ()
    values: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Recording:
    """A recording with its source.

    ``acts``: ids that act by the source; ``named``: whether all that acts has an id. ``understood``: nothing else acts.
    """

    folder: Path
    source: str
    split: str
    kind: str
    facts: Mapping[str, Any]
    acts: frozenset[str]
    named: bool
    understood: bool
    fault_runs: frozenset[int]
    hidden: tuple[Concealed, ...]
    paired: tuple[Concealed, ...]

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.folder.name


def recordings(folder: Path) -> list[Recording]:
    """Recordings of a folder that have readings, in the order of their names."""
    return [one for one in described(folder) if (one.folder / "recordings.csv").exists()]


def described(folder: Path) -> list[Recording]:
    """Recordings of a folder in the order of their names, with or without readings."""
    if not (folder / SPLIT).exists():
        raise InputError(f"has no {SPLIT}, which names the sources of the test", where=str(folder))
    test = frozenset(tomllib.loads((folder / SPLIT).read_text(encoding="utf-8"))["test"])
    found = [read_recording(place.parent, test) for place in sorted(folder.glob(f"*/{SOURCE}"))]
    unknown = test - {one.source for one in found}
    if unknown:
        raise InputError("names no source of this folder", where=f"{folder / SPLIT}: test", value=sorted(unknown)[0])
    return found


def read_recording(folder: Path, test: frozenset[str] = frozenset()) -> Recording:
    """Recording of a folder; an error names a key that is missing or unknown."""
    where = folder / SOURCE
    with open(where, "rb") as stream:
        facts = tomllib.load(stream)
    for key in facts:
        if key not in (*REQUIRED, *OPTIONAL):
            raise InputError(f"is unknown; {nearest(key, (*REQUIRED, *OPTIONAL))}", where=str(where), value=key)
    missing = [key for key in REQUIRED if key not in facts]
    if missing:
        raise InputError(f"lacks {', '.join(missing)}", where=str(where))
    if not str(facts["licence"]).strip():
        raise InputError("names no licence; write 'none stated' where the source has none", where=str(where))
    source = folder.name.split("__")[0]
    named = frozenset(name for name in facts["acts"] if not name.startswith(OUTSIDE))
    return Recording(
        folder=folder,
        source=source,
        split=SPLITS[source in test],
        kind=facts["kind"],
        facts=facts,
        acts=named,
        named=len(named) == len(facts["acts"]),
        understood=facts["understood"],
        fault_runs=frozenset(facts.get("fault_runs", ())),
        hidden=tuple(_concealed(entry, where) for entry in facts.get("hidden", ())),
        paired=tuple(_concealed(entry, where) for entry in facts.get("paired", ())),
    )


def _concealed(entry: Mapping[str, Any], where: Path) -> Concealed:
    try:
        column = entry.get("column") or entry["split_by"]
        right, place = frozenset(entry["right"]), frozenset(entry.get("where", ()))
        return Concealed(
            column, entry["expected"], right, place, tuple(entry.get("beside", ())), tuple(entry.get("values", ()))
        )
    except KeyError as missing:
        raise InputError(f"an entry lacks {missing.args[0]!r}", where=str(where)) from None


def licences(found: Sequence[Recording]) -> list[str]:
    """One line a source: authors, year, title, licence."""
    first = {one.source: one.facts for one in reversed(found)}
    return [f"{f['authors']} ({f['year']}): {f['title']}. {f['licence']}" for _, f in sorted(first.items())]
