"""The reference rig of each kind of recording as a case, on which the catalogue compares effects."""

from __future__ import annotations

from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.kinds import kind
from mixedlub.kinds.standard import RELATIVE_NOISE, ROUGHNESS_UM, UNCERTAINTY, Levels
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.table import Table


def conditions(name: str) -> dict[str, tuple[str, Levels]]:
    """Conditions varied on the reference rig of a kind: by name, the column and its levels."""
    return dict(kind(name).standard.conditions)


def table(name: str, **fixed: Any) -> Table:
    """All combinations of the levels in randomised order; ``fixed`` restricts a condition to given levels."""
    levels = {column: fixed.get(c, values) for c, (column, values) in conditions(name).items()}
    rows = list(product(*levels.values()))
    columns = {column: np.array(cells) for column, cells in zip(levels, zip(*rows), strict=True)}
    if "surfaces" in conditions(name):
        # Both surfaces of a contact are the same.
        surfaces = columns[conditions(name)["surfaces"][0]]
        columns |= {c.name: surfaces for c in kind(name).columns if c.dtype == "name"}
    columns["run"] = np.arange(1, len(rows) + 1)
    if "time_s" not in columns:
        columns["sequence"] = np.random.default_rng(0).permutation(len(rows)) / max(len(rows) - 1, 1)
    source = f"standard {name}"
    channels = kind(name).standard.channels(columns, lambda: Forward(case(name), Table(columns, source)).predict())
    return Table(columns | channels, source)


@cache
def case(name: str) -> Case:
    """The reference rig of a kind."""
    found = kind(name)
    surfaces = {
        s: {"m0_um2": rq**2, "m2": 0.0025, "m4_per_um2": 0.0036}
        | ({"coating": {"thickness_um": 3.0, "thermal_conductivity_W_mK": 2.0}} if s == "coated" else {})
        for s, rq in ROUGHNESS_UM.items()
    }
    system = {
        "schema": "mixedlub-case/1",
        "kind": name,
        **found.standard.sections,
        "surfaces": surfaces if "surfaces" in conditions(name) else {},
        "uncertainty": found.standard.sections.get("uncertainty", UNCERTAINTY),
        "recording": {
            "quantity": found.quantities[0],
            "noise": {"relative": RELATIVE_NOISE, "absolute": found.standard.noise},
        },
    }
    parsed = toml_file.parse(system_file.System, system, f"standard {name}")
    here, headers = Path("."), [column for column, _ in conditions(name).values()]
    return Case(f"standard_{name}", here, parsed, found.of_case(parsed, headers), Rig(parsed, here), None, None, ())


@cache
def forward(name: str) -> Forward:
    """The forward model of the reference rig at all its conditions."""
    return Forward(case(name), table(name))
