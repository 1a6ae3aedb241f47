"""Inputs missing in system.toml for a kind of case: as a list, and as comments to fill in."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.case.defaults import BROAD, broadly_fitted, gears_taken, oil_taken
from mixedlub.kinds import kind as kind_of
from mixedlub.kinds.calibration import calibrations
from mixedlub.schema import system_file
from mixedlub.schema.section import Key, Section, is_valid, needed, table
from mixedlub.schema.table import Table
from mixedlub.schema.toml_file import default_of, toml_key, toml_value


@dataclass(frozen=True)
class Gap:
    """Keys missing in a table of system.toml; ``required``: the case is invalid without the table.

    Each key of ``enough`` replaces all needed keys.
    """

    table: str
    absent: bool
    required: bool
    needed: tuple[str, ...]
    assumed: Mapping[str, str]
    keys: Mapping[str, Key]
    enough: tuple[str, ...] = ()

    def comments(self) -> Iterator[str]:
        """Comment lines for the file; removing the comment mark sets the value."""
        if self.absent:
            yield f"# [{self.table}]" + ("  # needed" if self.required else "")
        for key in (*self.needed, *self.assumed):
            described, left_out = self.keys[key], self.assumed.get(key)
            meaning = f"needed: {described.words}" if key in self.needed else described.words
            meaning += f": {' or '.join(map(toml_value, described.values))}" if described.values else ""
            meaning += f"; {left_out} where left out" if left_out else ""
            yield f"# {key} = {toml_value(described.example)}  # {meaning}"

    @property
    def blocking(self) -> str:
        """Needed keys in one line, the shortest sufficient keys first."""
        if not self.needed:
            choices = (f", if only {k} = {toml_value(key.example)}" for k, key in self.keys.items() if key.values)
            return f"[{self.table}] with what is known{next(choices, '')}; the rest is taken as typical"
        every = f"with {', '.join(self.needed)}"
        return f"[{self.table}] " + (f"with {' or '.join(self.enough)}; or {every}" if self.enough else every)

    def open(self, taken: Mapping[str, str]) -> str:
        """Optional keys not given, in one line, with the values ``taken`` or else the defaults."""
        place = f"{self.table}." if self.table else ""
        values = {key: taken.get(key, value) for key, value in self.assumed.items()}
        return "; ".join(place + key + (f" ({value})" if value else "") for key, value in values.items())


def gaps(system: system_file.System, columns: Mapping[str, np.ndarray]) -> tuple[Gap, ...]:
    """Inputs of the kind missing in the system; the rows name the surfaces."""
    rules = kind_of(system.kind)
    reads = _reads(system, columns)
    head = _keys("")
    not_given = [k for k, key in head.items() if not key.required and k not in system.model_fields_set]
    broad = broadly_fitted(system, columns)
    defaults = {k: BROAD if k in broad else default_of(head[k]) for k in not_given if k in ("description", *reads)}
    every = [Gap("", False, False, (), defaults, head)]
    sections = [s for s in ("gears", "contact", "lubricant") if s in rules.sections]
    if "viscosity" in reads and "lubricant" not in sections:
        sections.append("lubricant")
    for section in sections:
        unread = rules.unread_of_oil if section == "lubricant" else ()
        every.append(_gap(section, section, getattr(system, section), section in rules.sections, set(unread)))
    for name in undescribed(system, columns):
        every.append(_gap("surfaces", f"surfaces.{toml_key(name)}", None, True))
    stated = system.uncertainty.model_fields_set
    movable = {c.name for c in _movable(system) if set(c.needs) <= reads} - stated
    uncertainty_keys = _keys("uncertainty")
    uncertain = {k: BROAD if k in broad else "treated as exact" for k in uncertainty_keys if k in movable}
    every.append(Gap("uncertainty", not stated, False, (), uncertain, uncertainty_keys))
    noise_given = {"noise"} if f"{system.recording.quantity}_sd" in columns else set()
    every.append(_gap("recording", "recording", system.recording, False, noise_given))
    return tuple(gap for gap in every if gap.needed or gap.assumed)


def _reads(system: system_file.System, columns: Mapping[str, np.ndarray]) -> set[str]:
    """Inputs of the laws in the chain of the kind."""
    chain = kind_of(system.kind).chain(system, Table(columns))
    return {name for _, law in chain for name in inspect.signature(law).parameters}


def _movable(system: system_file.System) -> tuple[Any, ...]:
    """All inputs that calibration can change."""
    everything = system_file.Uncertainty(**dict.fromkeys(system_file.Uncertainty.model_fields, 1.0))
    return calibrations(system.model_copy(update={"uncertainty": everything}))


def undescribed(system: system_file.System, columns: Mapping[str, np.ndarray]) -> list[str]:
    """Surfaces named in the rows but missing in the system, if the kind uses surfaces."""
    if "surfaces" not in kind_of(system.kind).sections:
        return []
    named = [c.name for c in kind_of(system.kind).columns if c.dtype == "name" and "surface" in c.name]
    names = {str(value) for name in named if name in columns for value in np.unique(columns[name])}
    return sorted(names - set(system.surfaces))


def _keys(section: str) -> dict[str, Key]:
    """Keys of a table of system.toml; at the top level without tables."""
    described = table(system_file.System, section)
    return {key.name: key for key in (described.fields if section else described.keys)}


def _gap(section: str, name: str, given: Section | None, required: bool, known: Set[str] = frozenset()) -> Gap:
    """Keys missing in a section; a key is needed if the section is invalid without it."""
    keys = _keys(section)
    present = known if given is None else known | given.model_fields_set
    model = table(system_file.System, section).model
    lacking = needed(model) if given is None else ()
    enough = tuple(k for k, key in keys.items() if lacking and is_valid(model, {k: key.example}))
    assumed = {k: default_of(key) for k, key in keys.items() if k not in present and k not in lacking}
    return Gap(name, given is None, required and given is None, lacking, assumed, keys, enough)


def gap_lines(open_gaps: tuple[Gap, ...], file: str, system: system_file.System) -> Iterator[str]:
    """Gaps in words, one per line, first the gaps that prevent a computation."""
    taken = {"lubricant": oil_taken(system.lubricant)}
    if system.gears is not None:
        taken["gears"] = gears_taken(system.gears)
    blocking = [gap for gap in open_gaps if gap.required]
    if blocking:
        yield f"needed before the case can be used ({file} has each as a comment with an example):"
        yield from (f"  {gap.blocking}" for gap in blocking)
    assumed = [
        gap.open(taken.get(gap.table, {})) for gap in open_gaps if gap.assumed and not gap.table.startswith("surfaces.")
    ]
    if assumed:
        yield "not given, with the default or typical value that is taken:"
        yield from (f"  {text}" for text in assumed)
