"""Description of an evaluation, and the case folder for the diagnosis."""

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
"""Findings of an evaluation."""


@dataclass(frozen=True)
class Evaluation:
    """A way from recordings to friction.

    ``file`` is the class of its TOML file, ``columns`` are those of each table that it names; ``run(file, path)``
    evaluates a file that was read from ``path``. ``results`` describes the tables of results. ``example`` has the
    sections of its template; the tables that these name are in ``templates/NAME`` beside the module of ``run``.
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
        """The folder with the tables of its template."""
        return Path(inspect.getfile(self.run)).parent / "templates" / self.name.replace("-", "_")


BEYOND_VISCOSITY = (
    "pressure_viscosity_per_GPa",
    "eyring_stress_MPa",
    "thermal_conductivity_W_mK",
    "specific_heat_J_kgK",
)
"""Keys of the oil that an evaluation which reads its viscosity alone does not read."""
FILES = ("table", "profile", "traces", "traces_along", "map", "oil")
"""Keys whose values may be files beside the one that names them."""


def attachments(sections: Any, folder: Path) -> dict[str, bytes]:
    """The files that sections of a case name, by their path in the case."""
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
    """A name of the user as part of a file name.

    >>> file_name("ground / polished, both signs")
    'ground_polished_both_signs'
    """
    return re.sub(r"\W+", "_", name).strip("_")


def check_surfaces(known: Collection[str], named: Iterable[object], where: str) -> None:
    """Refuse a surface that the file does not describe."""
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
    """A case of a kind with sections as the file at ``path`` has them, and ``further`` ones."""
    given = read_toml(path)
    taken = ("boundary_friction", "description", *sections)
    system = {"kind": kind, **{name: given[name] for name in taken if name in given}, **further}
    return CaseDraft({**system, "recording": recording}, columns, attachments(system, path.parent))
