"""Priors of an unspecified oil: free properties and their ranges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from mixedlub.chain.effect import Parameter
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.kinds.calibration import Calibration
from mixedlub.laws.oil import from_d341, to_d341
from mixedlub.rig import build
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema import system_file
from mixedlub.schema.findings import collected, finding, report
from mixedlub.schema.table import Table

VISCOSITY_SPREAD = 1.0
"""Judgement. Prior sd of the logarithm of an unnamed viscosity: a factor of 2.7 either way."""
PRESSURE_SPREAD = 0.35
"""Judgement. Prior sd of the logarithm of the pressure-viscosity coefficient: a factor of 1.4 either way."""
SLOPE_SPREAD = 0.5
"""Judgement. Prior sd of the logarithm of the slope of ASTM D341: a factor of 1.6 either way."""
DENSITY_SPREAD = 0.04
"""Judgement. Prior sd of the logarithm of the density: 4 %."""
PRESSURE_SLOPE_SPREAD = 0.4
"""Judgement. Prior sd of the change of ln alpha over 100 K: a factor of 1.5 either way."""
PRESSURE_BOW_SPREAD = 0.25
"""Judgement. Prior sd of the curvature of ln alpha over 100 K: 0.2 in ISO/TR 15144, up to 0.5 in powers of
viscosity."""
BOW_SPREAD = 0.04
"""Judgement. Prior sd of the departure of ln viscosity from ASTM D341 over 50 K, from Vogel fits of oils."""
FIFTY_KELVIN, HUNDRED_KELVIN = 50.0, 100.0
"""Definition. Temperature differences over which those priors are stated."""
THINNEST, THICKEST = 0.4e-6, 1.0
"""Judgement. Range of kinematic viscosity (m^2/s) in which the ordinate of D341 is used."""
LEVEL = "viscosity_level"
"""Calibrated viscosity level, the pivot of the slope."""
FALLS = ("temperature_viscosity", "known_fall", "fall_from_first")
"""Other oil properties that depend on the fall of viscosity with temperature."""


def missing(system: system_file.System) -> tuple[str, ...]:
    """Unknown free properties: neither given nor with a stated uncertainty."""
    section, sd = system.lubricant or system_file.Lubricant(), system.uncertainty
    known = section.pressure_viscosity_per_GPa or section.known_pressure_viscosity
    gaps = (
        ("viscosity", section.kinematic_viscosity_mm2_s is None and sd.viscosity == 0),
        ("pressure_viscosity", known is None and sd.pressure_viscosity == 0),
    )
    return tuple(name for name, gap in gaps if gap)


@lru_cache(maxsize=1024)
def moved(oil: Lubricant, pivot: float, level: float = 1.0, slope: float = 1.0) -> Lubricant:
    """The oil with its kinematic viscosity at the pivot (K) and its slope in ASTM D341 multiplied.

    Both act on the ordinate of D341, so that together they cover every oil that follows it and is not thinner than
    THINNEST at the pivot, where the ordinate ends.

    >>> oil = Lubricant("oil", (313.15, 373.15), (34e-6, 7.2e-6), (15e-9, 13e-9), 850.0, 6.5e-4, 5e6, 0.14, 2000.0)
    >>> flat = moved(oil, 313.15, slope=0.5)
    >>> [round(nu * 1e6, 1) for nu in flat.kinematic_viscosity]
    [34.0, 14.3]
    """
    at_pivot = oil.viscosity(np.array(pivot)) / oil.density(np.array(pivot))
    before, after = (to_d341(np.maximum(nu, THINNEST)) for nu in (at_pivot, level * at_pivot))
    known = (to_d341(np.array(nu)) for nu in oil.kinematic_viscosity)
    lowest, highest = to_d341(np.array([THINNEST, THICKEST]))
    first, second = (float(from_d341(np.clip(after + slope * (z - before), lowest, highest))) for z in known)
    return replace(oil, kinematic_viscosity=(first, second))


def calibrations(system: system_file.System, temperature: np.ndarray, *, level: float = 1.0) -> tuple[Calibration, ...]:
    """Broad priors for the properties in ``missing``; ``temperature`` (K): temperatures of the recording.

    ``level``: factor on the assumed viscosity suggested by the readings, already in the inputs. If the recording spans
    temperatures, the slopes against temperature are unknown as well.
    """
    gaps = missing(system)
    if gaps:
        named = " and ".join(g.replace("_", "-") for g in gaps)
        text = (
            f"{named} not given: fitted with broad priors, so the answer rests on these readings and not on known "
            "properties of the oil"
        )
        report(finding("oil_fitted", text, "lubricant"))
    found = []
    pivot = pivot_of(temperature)
    spans = np.ptp(temperature) > 2.0
    with collected():
        oil = build.lubricant(system.lubricant)
    if "viscosity" in gaps:
        parameter = Parameter("viscosity", "-", LogNormal(level, VISCOSITY_SPREAD), "factor on the assumed viscosity")
        found.append(
            Calibration(parameter, _shifted(oil, pivot, level), level, ("viscosity", "oil_temperature"), factor=True)
        )
        if spans:
            slope = Parameter(
                "viscosity_slope", "-", LogNormal(1.0, SLOPE_SPREAD), "factor on the assumed ASTM D341 slope"
            )
            found.append(
                Calibration(slope, _turned(oil, pivot, level), 1.0, ("viscosity", "oil_temperature"), factor=True)
            )
            bow = Parameter(
                "viscosity_bow",
                "-",
                Normal(0.0, BOW_SPREAD),
                "departure of ln viscosity from ASTM D341 at 50 K from the mean temperature",
            )
            found.append(Calibration(bow, _bowed(pivot), 0.0, ("viscosity", "oil_temperature")))
            density = Parameter(
                "density", "-", LogNormal(1.0, DENSITY_SPREAD), "factor on the density between the two viscosities"
            )
            found.append(Calibration(density, _scaled("viscosity", 1.0), 1.0, ("viscosity",), factor=True))
    if "pressure_viscosity" in gaps:
        parameter = Parameter(
            "pressure_viscosity", "-", LogNormal(1.0, PRESSURE_SPREAD), "factor on the assumed pressure-viscosity"
        )
        found.append(
            Calibration(parameter, _scaled("pressure_viscosity", 1.0), 1.0, ("pressure_viscosity",), factor=True)
        )
        if spans:
            low, high = oil.pressure_coefficient(np.array([pivot, pivot + HUNDRED_KELVIN]))
            usual = float(high / low - 1.0)
            fall = Parameter(
                "pressure_viscosity_slope",
                "-",
                Normal(usual, PRESSURE_SLOPE_SPREAD),
                "relative change of pressure-viscosity over 100 K, linear in temperature",
            )
            found.append(Calibration(fall, _tilted(usual, pivot), usual, ("pressure_viscosity", "oil_temperature")))
            bend = Parameter(
                "pressure_viscosity_bow",
                "-",
                Normal(0.0, PRESSURE_BOW_SPREAD),
                "departure of ln pressure-viscosity from that line at 100 K from the mean temperature",
            )
            found.append(Calibration(bend, _bent(pivot), 0.0, ("pressure_viscosity", "oil_temperature")))
    return tuple(found)


def pivot_of(temperature: np.ndarray) -> float:
    """Temperature (K) about which the slope of an unspecified oil is varied."""
    return float(np.exp(np.mean(np.log(temperature))))


def level_of(recorded: Table, quantity: str, guess: np.ndarray) -> float:
    """Median ratio of readings to a first prediction, for priors scaled by the data."""
    if quantity not in recorded:
        return 1.0
    ratio = np.abs(recorded[quantity]) / guess
    return float(np.exp(np.median(np.log(ratio[ratio > 0])))) if (ratio > 0).any() else 1.0


def _scaled(name: str, nominal: float) -> Any:
    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        return {name: inputs[name] * (value / nominal)}

    return apply


def _shifted(oil: Lubricant, pivot: float, nominal: float) -> Any:
    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        change = _exchanged(inputs, moved(oil, pivot, nominal), moved(oil, pivot, value))
        return {**change, LEVEL: value}

    return apply


def _turned(oil: Lubricant, pivot: float, nominal: float) -> Any:
    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        level = inputs.get(LEVEL, nominal)
        return _exchanged(inputs, moved(oil, pivot, level), moved(oil, pivot, level, value))

    return apply


def _bowed(pivot: float) -> Any:
    """Viscosity, and its fall with temperature, of an oil with a parabola in place of the line in ASTM D341."""

    def bow(kelvin: Any) -> Any:
        return ((kelvin - pivot) / FIFTY_KELVIN) ** 2

    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        at = inputs["oil_temperature"]
        changed = {"viscosity": inputs["viscosity"] * np.exp(value * bow(at))}
        if "temperature_viscosity" in inputs:
            steeper = -2.0 * value * (at - pivot) / FIFTY_KELVIN**2
            changed["temperature_viscosity"] = inputs["temperature_viscosity"] + steeper
        if "known_fall" in inputs:
            first, second = (bow(inputs[f"{which}_known_temperature"]) for which in ("first", "second"))
            changed["known_fall"] = inputs["known_fall"] + value * (first - second)
            changed["fall_from_first"] = inputs["fall_from_first"] + value * (first - bow(at))
        return changed

    return apply


def _exchanged(inputs: Mapping[str, Any], old: Lubricant, new: Lubricant) -> dict[str, Any]:
    """Viscosity, and its fall with temperature, of another oil."""
    at = inputs["oil_temperature"]
    changed = {"viscosity": inputs["viscosity"] * (new.viscosity(at) / old.viscosity(at))}
    other = new.inputs(at)
    return changed | {name: other[name] for name in FALLS if name in inputs}


def _tilted(usual: float, pivot: float) -> Any:
    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        rise = (inputs["oil_temperature"] - pivot) / HUNDRED_KELVIN
        turned = np.maximum(1.0 + value * rise, 0.05) / np.maximum(1.0 + usual * rise, 0.05)
        return {"pressure_viscosity": inputs["pressure_viscosity"] * turned}

    return apply


def _bent(pivot: float) -> Any:
    def apply(inputs: Mapping[str, Any], value: float) -> dict[str, Any]:
        rise = (inputs["oil_temperature"] - pivot) / HUNDRED_KELVIN
        return {"pressure_viscosity": inputs["pressure_viscosity"] * np.exp(value * rise**2)}

    return apply
