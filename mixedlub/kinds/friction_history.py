"""Friction coefficient against time at constant or nearly constant conditions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.model import Chain
from mixedlub.chain.priors import LogNormal
from mixedlub.kinds import columns, disc, oil_priors
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import Inputs, Kind, bookkeeping_inputs, column, inverse_load, programme
from mixedlub.kinds.standard import DISCS, OIL, StandardRig
from mixedlub.kinds.steps import held_speeds
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.table import Table

COLUMNS = (
    replace(columns.TIME, required=True),
    *(replace(c, required=False) for c in (*disc.COLUMNS, *disc.SURFACES)),
)
NEEDED = tuple(c.name for c in (*disc.COLUMNS, *disc.SURFACES))
FRICTION_SPREAD = 1.0
"""Judgement. Prior sd of the logarithm of the friction at the start: a factor of 2.7 either way."""
USUAL_PRESSURE = 1e9
"""Judgement. Typical Hertz pressure (Pa) of a ball on a disc in traction machines."""

PURE_SLIDING = 2.0
"""Definition. Sliding over entrainment speed of a body on one that rests."""
UNKNOWN_SPEED = 1.0
"""Definition. Sliding speed (m/s) if none is recorded: any constant, since only its ratios matter."""


def constant_friction(boundary_friction: np.ndarray) -> np.ndarray:
    """Friction of unchanging surfaces (-): a constant coefficient.

    >>> float(constant_friction(0.1))
    0.1
    """
    return boundary_friction


def resolved(system: system_file.System, table: Table) -> bool:
    """Whether film and asperities can be computed: contact, oil, surfaces and all conditions are given."""
    sections = system.contact is not None and system.lubricant is not None and bool(system.surfaces)
    return sections and all(name in table for name in NEEDED)


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    if resolved(system, table):
        return {**disc.inputs(system, rig, table, recorded), **programme(table, recorded), **_held(table, recorded)}
    absent = [name for name in NEEDED if name not in table]
    if system.contact is not None and system.lubricant is not None and system.surfaces:
        text = (
            f"no {', '.join(absent)}, so film and asperities cannot be computed; the base model is one constant "
            "friction coefficient"
        )
        report(finding("film_not_computed", text, table.source))
    return {
        "sliding_speed": UNKNOWN_SPEED,
        **_conditions(table, recorded),
        **bookkeeping_inputs(system, table),
        **inverse_load(system, table, recorded),
        **programme(table, recorded),
        **_held(table, recorded),
        "boundary_friction": _level(system, recorded),
        "area_ratio": 0.0,
        "fluid_friction": 0.0,
        "flash_per_friction": 0.0,
    }


def _conditions(table: Table, recorded: Table) -> Inputs:
    """Operating conditions of the rows, for effects without other inputs.

    The bodies are unknown: at the largest load the contact has a typical pressure of such rigs.
    """
    inputs: Inputs = {}
    if "entrainment_speed_m_s" in table:
        inputs["entrainment_speed"] = column(table["entrainment_speed_m_s"])
    if "slide_roll_ratio" in table:
        inputs["slide_roll_ratio"] = np.abs(column(table["slide_roll_ratio"]))
    if {"entrainment_speed", "slide_roll_ratio"} <= set(inputs):
        inputs["sliding_speed"] = inputs["slide_roll_ratio"] * inputs["entrainment_speed"]
    inputs["hertz_pressure"] = USUAL_PRESSURE
    if "load_N" in table:
        inputs["load"] = column(table["load_N"])
        if "load_N" in recorded:
            share = table["load_N"] / max(float(np.max(np.abs(recorded["load_N"]))), 1e-300)
            inputs["hertz_pressure"] = USUAL_PRESSURE * column(np.cbrt(np.abs(share)))
    if "oil_temperature_C" in table:
        inputs["oil_temperature"] = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    return inputs


def _held(table: Table, recorded: Table) -> Inputs:
    """Sliding speeds that were held one after the other, if the speed was stepped; without a ratio in pure sliding."""
    name, ratio = "entrainment_speed_m_s", "slide_roll_ratio"
    if not {name, "time_s"} <= set(table.columns) or not {name, "time_s"} <= set(recorded.columns):
        return {}
    sliding = float(np.median(np.abs(recorded[ratio]))) if ratio in recorded else PURE_SLIDING
    held = held_speeds(table, recorded, name, sliding) if sliding > 0.0 else None
    if held is None:
        return {}
    first = sliding * float(recorded[name][0])
    return {"held_speed": held.speed, "slip_since": held.slip, "slip_since_early": held.early, "first_speed": first}


def _friction_is_given(system: system_file.System) -> bool:
    return system.uncertainty.boundary_friction > 0


def _level(system: system_file.System, recorded: Table) -> float:
    if _friction_is_given(system) or "friction_coefficient" not in recorded:
        return system.boundary_friction
    return max(float(np.median(np.abs(recorded["friction_coefficient"]))), 1e-3)


def extra_calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
    """Broad priors for an unspecified friction coefficient, or for an unspecified oil if the film is computed."""
    if resolved(system, recorded):
        return oil_priors.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)
    if _friction_is_given(system):
        return ()
    level = _level(system, recorded)
    parameter = Parameter(
        "boundary_friction",
        "-",
        LogNormal(level, FRICTION_SPREAD),
        "friction coefficient at the start of the recording",
    )
    return (Calibration(parameter, lambda inputs, value: {"boundary_friction": value}, level, ("boundary_friction",)),)


def chain(system: system_file.System, table: Table) -> Chain:
    """Film and asperity friction if they can be computed, else a constant coefficient."""
    if resolved(system, table):
        return disc.chain(system, table)
    return (("friction", constant_friction), ("reading", disc.point_reading))


STANDARD = StandardRig(
    sections={"contact": DISCS, "lubricant": OIL},
    noise=2e-4,
    conditions={
        "sequence": ("time_s", tuple(np.linspace(0.0, 7200.0, 13))),
        "load": ("load_N", (400.0, 2200.0)),
        "speed": ("entrainment_speed_m_s", (1.0, 6.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.005, 0.6)),
        "oil_temperature": ("oil_temperature_C", (50.0, 90.0)),
        "surfaces": ("surface_1", ("superfinished", "coarse", "coated")),
    },
)

KIND = Kind(
    name="friction_history",
    subject="contact",
    readings=(columns.FRICTION,),
    columns=COLUMNS,
    sections=(),
    uses=("contact", "lubricant", "surfaces"),
    base_model="A constant friction coefficient, or that of kind disc where oil, surfaces and conditions are given.",
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    is_history=True,
    is_logged=True,
    standard=STANDARD,
)
