"""Definition of an evaluation, and case folders for the diagnosis."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.schema.result import CaseDraft, Curve, Panel, Result, ResultColumn
from mixedlub.schema.section import Section
from mixedlub.schema.table import Column
from mixedlub.schema.toml_file import read_toml
from profiles.errors import InputError, nearest

__all__ = ["CaseDraft", "Curve", "Evaluated", "Evaluation", "Panel"]
Evaluated = Result
"""Result of an evaluation."""


@dataclass(frozen=True)
class Evaluation:
    """Method to obtain friction from recordings.

    ``file``: class of its TOML file; ``columns``: columns of each table named in the file; ``run(file, path)``:
    evaluation of a file read from ``path``; ``results``: columns of the result tables; ``example``: sections of the
    template, with tables in ``templates/NAME`` beside the module of ``run``.
    """

    name: str
    about: str
    source: str
    file: type[Section]
    columns: Mapping[str, tuple[Column, ...]]
    run: Callable[[Any, Path], Evaluated]
    example: Mapping[str, Any]
    results: Mapping[str, tuple[ResultColumn, ...]] = field(default_factory=dict)

    @property
    def folder(self) -> Path:
        """Folder of the template's tables."""
        return Path(inspect.getfile(self.run)).parent / "templates" / self.name.replace("-", "_")


BEYOND_VISCOSITY = (
    "pressure_viscosity_per_GPa",
    "eyring_stress_MPa",
    "thermal_conductivity_W_mK",
    "specific_heat_J_kgK",
)
"""Oil keys without effect in evaluations that use viscosity only."""
FILES = ("table", "profile", "traces", "traces_along", "map", "oil")
"""Keys with values that may be names of files."""


def attachments(sections: Any, folder: Path) -> dict[str, bytes]:
    """Files named in the sections of a case, by path relative to the case."""
    found: dict[str, bytes] = {}
    for key, value in sections.items() if isinstance(sections, Mapping) else ():
        found |= attachments(value, folder)
        named = value if isinstance(value, list | tuple) else [value]
        for name in named if key in FILES else ():
            inside = isinstance(name, str) and not Path(name).is_absolute() and ".." not in Path(name).parts
            if inside and (folder / name).is_file():
                found[name] = (folder / name).read_bytes()
    return found


def file_name(name: str) -> str:
    """User-given name as part of a file name.

    >>> file_name("ground / polished, both signs")
    'ground_polished_both_signs'
    """
    return re.sub(r"\W+", "_", name).strip("_")


def check_surfaces(known: Collection[str], named: Iterable[object], where: str) -> None:
    """Raise an error for a surface missing from the file."""
    for name in sorted({str(one) for one in named} - set(known)):
        raise InputError(f"the file has no such surface; {nearest(name, known)}", where=where, value=name)


def case_draft(
    path: Path,
    kind: str,
    sections: tuple[str, ...],
    recording: Mapping[str, Any],
    columns: Mapping[str, np.ndarray],
    **further: Any,
) -> CaseDraft:
    """Case with ``sections`` copied from the file at ``path`` and ``further`` sections."""
    given = read_toml(path)
    taken = ("boundary_friction", "description", *sections)
    system = {"kind": kind, **{name: given[name] for name in taken if name in given}, **further}
    return CaseDraft({**system, "recording": recording}, columns, attachments(system, path.parent))
