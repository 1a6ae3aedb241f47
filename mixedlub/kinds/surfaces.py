"""Surfaces named in the rows of a table."""

from __future__ import annotations

from mixedlub.kinds.kind import Inputs
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import paired
from mixedlub.schema.table import Table
from profiles.errors import InputError, nearest


def pair_of_surfaces(rig: Rig, table: Table, first: str, second: str) -> Inputs:
    """Chain inputs of the two surfaces named in two columns, shaped (rows, 1)."""
    known = {}
    for place in (first, second):
        for row, name in enumerate(table[place].tolist()):
            if name not in rig.file.surfaces:
                raise InputError(
                    f"no such surface in system.toml; {nearest(name, rig.file.surfaces)}",
                    where=f"{table.source}: row {row + 1}, {place}",
                    value=name,
                )
            if name not in known:
                known[name] = rig.surface(name)
    # Rows may be a part of a recording whose other rows have coated surfaces.
    coated = any(section.coating is not None for section in rig.file.surfaces.values())
    both = paired([known[n] for n in table[first].tolist()], [known[n] for n in table[second].tolist()], coated)
    return {name: values[:, None] for name, values in both.items()}
