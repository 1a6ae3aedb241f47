"""Roughness that yields in the film, as part of the base model of a case."""

from __future__ import annotations

from mixedlub.base_model.flattened import with_flattening
from mixedlub.case.base import Base
from mixedlub.chain.model import Chain
from mixedlub.kinds import Kind
from mixedlub.rig.rig import Rig
from mixedlub.rig.waves import OUTSIDE, WAVES, wave_rows
from mixedlub.schema import system_file
from mixedlub.schema.table import Table
from profiles.errors import InputError

SIDES = (("pinion_surface", "gear_surface"), ("surface_1", "surface_2"))
"""Columns with the names of both surfaces of a contact, by kind."""
SHARE = "short_cutoff_over_half_width"
NEEDED = {"moes_load", "summit_density"}
"""Quantities of contacts along a line with asperities."""


def flattened(kind: Kind, system: system_file.System, rig: Rig, table: Table, chain: Chain) -> Base:
    """Base of a case whose asperities have the roughness inside the film; the chain itself if not chosen."""
    share = system.short_cutoff_over_half_width
    rows = wave_rows(system.flattening, share, system.effects, "")
    if rows is None:
        return Base(chain)
    sides = next((both for both in SIDES if set(both) <= {c.name for c in kind.columns}), None)
    if sides is None or not {name for name, _ in chain} >= NEEDED:
        where, value = ("flattening", system.flattening) if system.flattening == WAVES else (SHARE, share)
        rule = "is of rough contacts along a line: kinds gear_pair and mesh_friction, and disc without a point contact"
        raise InputError(rule, where=where, value=value)
    surfaces = {name: rig.surface(name) for name in system.surfaces}
    for one in surfaces.values():
        rows.row(one)
    first, second = ([surfaces[name] for name in table[side].tolist()] for side in sides)
    inputs = {name: values[:, None] for name, values in rows.inputs(first, second).items()}
    contained = ("micro_ehl", OUTSIDE) if system.flattening == WAVES else (OUTSIDE,)
    return Base(with_flattening(chain, rows.tables(system.flattening, share)), inputs, contained=contained)
