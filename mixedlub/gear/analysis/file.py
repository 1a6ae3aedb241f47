"""File of a gear pair for the analysis of its loaded contact."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from mixedlub.gear import GearPair
from mixedlub.gear.analysis.tooth_contact import MeshConditions
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.gear.mesh import Sharing
from mixedlub.schema.section import Flag, Number, Section, Whole, key
from mixedlub.schema.system_file import Gears
from mixedlub.schema.toml_file import parse, read_toml
from profiles.errors import InputError

Positive = Annotated[Number, Field(gt=0.0)]


def _listed(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else [value]


Torques = Annotated[tuple[Positive, ...], Field(min_length=1, max_length=1000), BeforeValidator(_listed)]


class Load(Section):
    torque_Nm: Torques = key("torque on the pinion, or a list of torques", example=[50, 100, 150])


class MeshTable(Section):
    positions: Whole = key("positions over each base pitch", 64, ge=2, le=10_000)
    slices: Whole | None = key(
        "slices of the face; left out: what the load sharing needs", None, example=21, ge=1, le=400
    )
    edge_contact: Flag = key('model "ldp"; true: edges of tips may touch beyond the path of contact', False)
    pitch_deviation_um: Annotated[tuple[Number, ...], Field(min_length=1, max_length=200)] = key(
        'model "ldp": how far each of some successive tooth pairs stands back; the list repeats', (0.0,)
    )


class Iso6336(Section):
    dedendum: Number | None = key(
        "dedendum of the basic rack, as gears.dedendum",
        None,
        example=1.25,
        alternative=True,
        gt=0.5,
        lt=3.0,
    )
    blank_factor: Number = key("C_R of thin rims; 1: solid discs", 1.0, gt=0.0, le=1.0)
    application_factor: Number = key("K_A, by which the load is larger", 1.0, ge=1.0, le=10.0)


class GearAnalysisFile(Section):
    """A gear pair, its torques, and the resolution of its mesh."""

    schema_: Literal["mixedlub-gear/1"] = key("format of the file", example="mixedlub-gear/1", alias="schema")
    title: str = key("title of the figures", "Gear pair", example="FZG C")
    gears: Gears = key("the gear pair, as in a study")
    load: Load = key("what it transmits")
    mesh: MeshTable = key("positions, slices, edge contact and pitch deviations", MeshTable())
    iso_6336: Iso6336 = key("what the stiffness of ISO 6336-1 reads besides", Iso6336())


@dataclass(frozen=True)
class Problem:
    """A file with its gear pair and load sharing."""

    file: GearAnalysisFile
    pair: GearPair
    sharing: Sharing
    torque: np.ndarray
    conditions: MeshConditions


def read_problem(path: Path) -> Problem:
    """The gear pair of a file, checked."""
    file = parse(GearAnalysisFile, read_toml(path), str(path))
    conditions = MeshConditions(
        positions=file.mesh.positions,
        slices=file.mesh.slices,
        edge_contact=file.mesh.edge_contact,
        pitch_deviation=tuple(value * 1e-6 for value in file.mesh.pitch_deviation_um),
    )
    pair = gear_pair(file.gears)
    if file.iso_6336.dedendum is not None:
        if "dedendum" in file.gears.model_fields_set and file.iso_6336.dedendum != pair.dedendum:
            rule = f"is not gears.dedendum = {pair.dedendum:g}: both are the dedendum of the basic rack; leave one out"
            raise InputError(rule, where=f"{path}: iso_6336.dedendum", value=file.iso_6336.dedendum)
        pair = replace(pair, dedendum=file.iso_6336.dedendum)
    shared = sharing(file.gears.load_sharing, path.parent)
    return Problem(file, pair, shared, np.unique(np.array(file.load.torque_Nm)), conditions)
