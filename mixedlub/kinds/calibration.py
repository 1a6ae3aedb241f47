"""Calibration: free inputs of the base model, each with the uncertainty stated in the case."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.schema import system_file
from profiles.errors import InputError

Inputs = Mapping[str, Any]


@dataclass(frozen=True)
class Calibration:
    """A calibrated input: its prior and the change it makes to the inputs. ``factor``: multiplicative.

    ``base_law``: id of a base law if the input is its uncertainty; readings are nearly linear in such an input.
    """

    parameter: Parameter
    apply: Callable[[Inputs, float], dict[str, Any]]
    nominal: float
    needs: tuple[str, ...]
    factor: bool = False
    base_law: str = ""

    @property
    def name(self) -> str:
        """Name in the report."""
        return self.parameter.name


def _scaled(*names: str, power: int = 1) -> Callable[[Inputs, float], dict[str, Any]]:
    def apply(inputs: Inputs, value: float) -> dict[str, Any]:
        return {name: inputs[name] * value**power for name in names}

    return apply


def _replaced(name: str) -> Callable[[Inputs, float], dict[str, Any]]:
    def apply(inputs: Inputs, value: float) -> dict[str, Any]:
        return {name: value}

    return apply


def _factor(name: str, spread: float, meaning: str, *inputs: str, power: int = 1) -> Calibration:
    parameter = Parameter(name, "-", LogNormal(1.0, spread), f"factor on {meaning}")
    return Calibration(parameter, _scaled(*inputs, power=power), 1.0, inputs, factor=True)


def of_parameter(effect: Effect, name: str, value: float, sd: float) -> Calibration:
    """Calibration of a known effect's parameter with a stated standard deviation; lognormal if it must be positive."""
    (p,) = (p for p in effect.parameters if p.name == name)
    if p.prior.value(-math.inf) < 0.0:
        prior: Normal | LogNormal = Normal(value, sd)
    elif value > 0.0:
        prior = LogNormal(value, sd / value)
    else:
        rule = "a parameter that cannot be negative is uncertain only above zero"
        raise InputError(rule, where=f"effects.{effect.id}.{name}", value=value)
    own = replace(p, name=f"{effect.id}.{name}", prior=prior)
    return Calibration(own, lambda inputs, value: {}, value, ())


def of_base_law(effect: Effect, parameter: Parameter) -> Calibration:
    """Calibration of a parameter for the uncertainty of a base law, as published laws of the same step differ."""
    null = parameter.null_value
    own = replace(parameter, name=f"{effect.id}.{parameter.name}", prior=Normal(null, parameter.base_sd))
    return Calibration(own, lambda inputs, value: {}, null, (), base_law=effect.id)


def calibrations(system: system_file.System) -> tuple[Calibration, ...]:
    """Free inputs of a case: inputs with a stated uncertainty above zero."""
    sd = system.uncertainty
    boundary = Parameter(
        "boundary_friction",
        "-",
        Normal(system.boundary_friction, sd.boundary_friction),
        "friction coefficient of touching asperities",
    )
    return tuple(
        entry
        for entry, spread in (
            (
                Calibration(boundary, _replaced("boundary_friction"), system.boundary_friction, ("boundary_friction",)),
                sd.boundary_friction,
            ),
            (_factor("viscosity", sd.viscosity, "viscosity", "viscosity"), sd.viscosity),
            (
                _factor("pressure_viscosity", sd.pressure_viscosity, "pressure-viscosity", "pressure_viscosity"),
                sd.pressure_viscosity,
            ),
            (_factor("eyring_stress", sd.eyring_stress, "Eyring stress", "eyring_stress"), sd.eyring_stress),
            (
                _factor("roughness", sd.roughness, "Rq of all surfaces", "m0", "m2", "m4", power=2),
                sd.roughness,
            ),
        )
        if spread > 0
    )
