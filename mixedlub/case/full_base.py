"""Full solutions as the base of a case: its emulator, over the range of its recordings and conditions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.case.base import Base
from mixedlub.chain.effect import Parameter
from mixedlub.chain.model import Chain, Model
from mixedlub.chain.priors import LogNormal
from mixedlub.full_base.box import CONDITIONS, FACTORS, Box, needed, union, with_factors
from mixedlub.full_base.chain import matter_of, noted, refuse_contained, refuse_oil, with_full_base
from mixedlub.full_base.store import emulator
from mixedlub.full_base.words import CONTAINED, FULL, FULL_INPUTS
from mixedlub.kinds import Kind
from mixedlub.kinds.calibration import Calibration, Inputs
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Table
from profiles.errors import InputError

KINDS = ("gear_pair", "mesh_friction", "disc")
"""Kinds of recordings with line contacts of an oil."""


def refuse(kind: Kind, system: system_file.System, rig: Rig, tables: Sequence[Table | None]) -> None:
    """Raise an error for a case that full solutions cannot be the base of."""
    if kind.name not in KINDS:
        rule = f"is a base of the kinds {', '.join(KINDS)}, not of {kind.name}"
        raise InputError(rule, where="base", value=FULL)
    if system.contact is not None and system.contact.geometry == "point":
        raise InputError(f'"point": base = "{FULL}" is of line contacts', where="contact.geometry")
    refuse_contained(system.effects)
    hot = [
        float(end(t["oil_temperature_C"])) + ZERO_CELSIUS for t in tables if t is not None for end in (np.min, np.max)
    ]
    refuse_oil(system.lubricant, rig.oil, hot)


def full_base(
    kind: Kind, system: system_file.System, rig: Rig, tables: Sequence[Table], chain: Chain, inputs: Mapping[str, Any]
) -> Base:
    """Full solutions as the base in place of a chain; ``tables``: rows covered by the emulator."""
    sds = {name: getattr(system.uncertainty, name) for name in FACTORS}
    box = with_factors(union(_range(chain, kind.inputs(system, rig, t, tables[0])) for t in tables), sds)
    found, built = emulator(matter_of(rig.oil(), inputs), box)
    noted(found, built)
    own = {**FULL_INPUTS, "entering_stress": inputs["eyring_stress"]}
    errors = (
        ("film", found.errors.film, "film of full solutions"),
        ("stress", found.errors.friction, "film friction of full solutions"),
    )
    calibrations = tuple(_of_error(*error) for error in errors)
    return Base(with_full_base(chain, found), own, calibrations, CONTAINED, {"eyring_stress": with_entering_stress})


def _range(chain: Chain, inputs: Inputs) -> Box:
    """Range of the loaded contacts of rows."""
    want = [name for name in (*CONDITIONS, "line_load") if name not in inputs]
    return needed({**inputs, **Model(chain, tuple(inputs), want)(inputs)})


def _of_error(quantity: str, sd: float, meaning: str) -> Calibration:
    """Calibration of a factor on a ratio, within the error of the emulator and the solver."""
    name = f"{quantity}_ratio_factor"
    parameter = Parameter(f"{FULL}.{quantity}", "-", LogNormal(1.0, sd), f"factor on the {meaning}, for their error")
    return Calibration(parameter, lambda inputs, value: {name: value}, 1.0, (name,), factor=True, base_law=FULL)


def with_entering_stress(one: Calibration) -> Calibration:
    """Calibration of the Eyring stress that moves the stress of the entering oil too."""
    names = (*one.needs, "entering_stress")
    return replace(one, needs=names, apply=lambda inputs, value: {name: inputs[name] * value for name in names})
