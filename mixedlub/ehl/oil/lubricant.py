"""Oil of a case or study for the solver: the same laws, with derivatives of the viscosity."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from mixedlub.ehl.oil import density, shear
from mixedlub.ehl.oil.fitted_shear import laws_of
from mixedlub.ehl.oil.oil import Oil, Slopes, constant, expansion_of
from mixedlub.laws import oil
from mixedlub.laws.oil import ROELANDS_LOG, ROELANDS_PRESSURE
from mixedlub.rig.lubricant import Lubricant


def from_lubricant(of: Lubricant) -> Oil:
    """A Ree-Eyring oil, or one with a traction part, with viscosity by the modulus equation if its constants are given,
    else by Roelands."""
    stress: dict[str, Any] = {
        "shear": partial(shear.ree_eyring, eyring_stress=of.eyring_stress),
        "stress_scale": constant(of.eyring_stress),
        "stress_limit": constant(np.inf),
    }
    squeezed = partial(density.dowson_higginson, known_temperature=oil.ZERO_CELSIUS + 15.0, expansion=of.density_change)
    return Oil(
        name=of.name,
        log_viscosity=partial(roelands if of.pressure_modulus is None else modulus, of=of),
        density_ratio=squeezed,
        **(stress if of.traction is None else laws_of(of.traction, of.eyring_stress)),
        newtonian=False,
        density=of.density_15,
        expansion=expansion_of(squeezed),
        conductivity=of.conductivity,
        heat_capacity=of.heat_capacity,
    )


def roelands(pressure: np.ndarray, temperature: np.ndarray, of: Lubricant) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by ASTM D341 and Roelands, with derivatives per Pa and per K.

    .. math:: \ln\eta + 9.67 = s\,(1 + p/p_r)^Z,\quad s = \ln\eta_0(T) + 9.67,\quad Z = \alpha(T)\,p_r/s

    Source: as `mixedlub.laws.oil.roelands_viscosity`.
    """
    ambient, alpha = of.viscosity(temperature), of.pressure_coefficient(temperature)
    size, exponent, fall = np.log(ambient) + ROELANDS_LOG, oil.roelands_exponent(ambient, alpha), of.fall(temperature)
    growth, squeezed = oil.roelands_growth(exponent, pressure), np.log1p(pressure / ROELANDS_PRESSURE)
    by_alpha = squeezed * of.coefficient_change(temperature) * ROELANDS_PRESSURE
    return (
        size * growth - ROELANDS_LOG,
        size * growth * exponent / (ROELANDS_PRESSURE + pressure),
        growth * (by_alpha - fall * (1.0 - exponent * squeezed)),
    )


def modulus(pressure: np.ndarray, temperature: np.ndarray, of: Lubricant) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by ASTM D341 and the modulus equation, with derivatives per Pa and per K.

    .. math:: \ln\eta = \ln\eta_0(T) + p/(A + B p)

    with A and B linear in temperature. Source: as `mixedlub.laws.oil.modulus_viscosity`.
    """
    known = of.inputs(temperature)
    base, slope = np.asarray(known["pressure_modulus"]), np.asarray(known["modulus_slope"])
    whole = base + slope * pressure
    stiffer = _change(of.pressure_modulus, of) + _change(of.modulus_slope, of) * pressure
    return (
        np.log(known["viscosity"]) + oil.modulus_rise(base, slope, pressure),
        base / whole**2,
        -of.fall(temperature) - pressure * stiffer / whole**2,
    )


def _change(values: tuple[float, float] | None, of: Lubricant) -> float:
    """Temperature coefficient (per K) of a property linear in temperature; zero for a missing property."""
    first, second = values or (0.0, 0.0)
    return (second - first) / (of.temperature[1] - of.temperature[0])
