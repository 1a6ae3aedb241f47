"""Small rigs of every kind of recording on which every effect of the catalogue is put through its contract."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from mixedlub.case import reference_rigs
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Chain, Model
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.effects import catalogue
from mixedlub.kinds import NATIVE

RIGS = NATIVE
LEVELS = {
    "gear_pair": {"load": (60.0, 140.0), "speed": (600.0, 2800.0), "oil_temperature": (45.0, 95.0)},
    "disc": {
        "load": (400.0, 2000.0),
        "speed": (1.5, 9.0),
        "slide_roll_ratio": (0.0, 0.5),
        "oil_temperature": (45.0, 95.0),
    },
    "film": {
        "load": (10.0, 40.0),
        "speed": tuple(np.geomspace(0.02, 4.0, 40)),
        "slide_roll_ratio": (0.0, 0.5),
        "oil_temperature": (45.0, 95.0),
    },
    "friction_history": {"sequence": (0.0, 900.0, 3600.0, 7200.0), "oil_temperature": (70.0,)},
    "friction_map": {"drive_angle": (0.0, 100.0, 250.0)},
    "viscosity": {},
    "mesh_friction": {"speed": (600.0, 2800.0), "roll_angle": (16.0, 21.0, 24.0, 31.0)},
}
DISSIPATED = {
    "gear_pair": "power_loss",
    "disc": "tangential_friction",
    "film": "film_thickness",
    "friction_history": "tangential_friction",
    "friction_map": "running_friction",
    "viscosity": "contact_viscosity",
    "mesh_friction": "friction",
}
"""What is positive on each rig whatever the effects, the reading's own faults aside."""

ELSEWHERE = {
    "pressure": 2e8,
    "heat_flux": 1e7,
    "wheel_radius": 0.04,
    "wheel_speed": 150.0,
    "wheel_teeth": 25.0,
    "bearing_diameter": 0.045,
    "seal_diameter": 0.04,
}
"""Plausible values of what no rig has."""


@cache
def rig(name: str) -> Forward:
    """The forward problem of a small rig; the load drives the motor in every third row of a drive."""
    table = reference_rigs.table(name, **LEVELS[name])
    if name == "friction_map":
        driven = np.where(np.arange(len(table)) % 3 == 0, -1.0, 1.0)
        table = replace(table, columns={**table.columns, "motor_torque_Nm": driven * table["motor_torque_Nm"]})
    return Forward(reference_rigs.case(name), table)


@cache
def acting(name: str) -> tuple[Effect, ...]:
    """Effects that a rig can show."""
    return rig(name).effects()


def on_rigs(effect: Effect) -> list[str]:
    """The rigs on which an effect can act."""
    return [name for name in RIGS if effect.id in {e.id for e in acting(name)}]


def cases() -> list[tuple[str, str]]:
    """Every effect on every rig where it can act, as (rig, effect id)."""
    return [(name, e.id) for name in RIGS for e in acting(name)]


def moved(effect: Effect, z: float = 0.3) -> dict[str, float]:
    """Parameter values off the middle of the prior, hence off null."""
    return {p.name: p.prior.value(z) for p in effect.parameters}


def everything(chain: Chain, given: dict[str, Any]) -> dict[str, Any]:
    """All quantities of a chain."""
    names = [name for name, _ in chain]
    return {**given, **Model(chain, tuple(given), names)(given)}


@cache
def states() -> dict[str, dict[str, Any]]:
    """Values of every word of the glossary on each rig, another rig's or a plausible number where it lacks one."""
    own = {name: everything(rig(name).chain, rig(name).inputs) for name in RIGS}
    anywhere = {k: float(np.ravel(v)[-1]) for name in reversed(RIGS) for k, v in own[name].items()}
    return {
        name: {word: own[name].get(word, anywhere.get(word, ELSEWHERE.get(word, 1.0))) for word in GLOSSARY}
        for name in RIGS
    }


def apply(effect: Effect, state: dict[str, Any], values: dict[str, float]) -> dict[str, Any]:
    """The state after an effect."""
    arguments = [state[name] for name in (*effect.acts_on, *effect.reads)]
    result = effect.law(*arguments, **values)
    changed = (result,) if len(effect.acts_on) == 1 else result
    return {**state, **dict(zip(effect.acts_on, changed, strict=True))}


EFFECTS = tuple(catalogue().values())
