"""Small gear and disc rigs on which every effect of the catalogue is put through its contract."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from mixedlub import standard
from mixedlub.chain import Chain, Model
from mixedlub.effect import Effect, catalogue
from mixedlub.forward import Forward
from mixedlub.quantities import GLOSSARY

RIGS = ("gear_pair", "disc")
LEVELS = {
    "gear_pair": {"load": (60.0, 140.0), "speed": (600.0, 2800.0), "oil_temperature": (45.0, 95.0)},
    "disc": {
        "load": (400.0, 2000.0),
        "speed": (1.5, 9.0),
        "slide_roll_ratio": (0.0, 0.5),
        "oil_temperature": (45.0, 95.0),
    },
}
ELSEWHERE = {
    "face_position": 0.5,
    "tangential_friction": 0.05,
    "friction_torque": 0.3,
    "sliding_position": -0.2,
    "drive_speed": -12.0,
    "bulk_viscosity": 0.4,
    "pressure": 2e8,
    "time": 500.0,
    "heat_flux": 1e7,
    "wheel_radius": 0.04,
    "wheel_speed": 150.0,
    "wheel_teeth": 25.0,
    "bearing_diameter": 0.045,
    "seal_diameter": 0.04,
    "transverse_radius": 0.02,
}
"""Plausible values of what neither rig has."""


@cache
def rig(name: str) -> Forward:
    """The forward problem of a small rig."""
    return Forward(standard.case(name), standard.table(name, **LEVELS[name]))


@cache
def acting(name: str) -> tuple[Effect, ...]:
    """Effects that a rig can show."""
    return rig(name).effects()


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
    """Values of every word of the glossary on each rig, the other rig's or a plausible number where it lacks one."""
    own = {name: everything(rig(name).chain, rig(name).inputs) for name in RIGS}
    anywhere = {k: float(np.ravel(v)[0]) for name in RIGS for k, v in own[name].items()}
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
