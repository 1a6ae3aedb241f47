"""Density relative to ambient pressure and the known temperature, with derivatives by pressure and temperature."""

from __future__ import annotations

import numpy as np

from mixedlub.ehl.oil.declared import DENSITY, GIGA, Given, kelvin, times
from mixedlub.ehl.oil.oil import Slopes

COMPRESSION, STIFFENING = 0.6e-9, 1.7e-9
"""Constants of Dowson and Higginson for mineral oil (1/Pa)."""


TEMPERATURE = Given("known_temperature", "temperature_C", "temperature of that density", kelvin)
EXPANSION = Given("expansion", "expansion_per_K", "thermal expansion")


@DENSITY.offers("Dowson and Higginson, with thermal expansion", TEMPERATURE, EXPANSION)
def dowson_higginson(
    pressure: np.ndarray, temperature: np.ndarray, *, known_temperature: float, expansion: float
) -> Slopes:
    r"""Relative density by Dowson and Higginson, with thermal expansion.

    .. math:: \bar\rho = \left(1 + \frac{0.6\,p}{1 + 1.7\,p}\right)[1 - \beta_\rho (T - T_0)],\quad p\ \text{in GPa}

    Source: D. Dowson, G. R. Higginson, Elastohydrodynamic Lubrication (1966).

    >>> round(float(dowson_higginson(1e9, 313.15, known_temperature=313.15, expansion=6.5e-4)[0]), 4)
    1.2222
    """
    stiff = 1.0 + STIFFENING * pressure
    squeezed, warm = 1.0 + COMPRESSION * pressure / stiff, 1.0 - expansion * (temperature - known_temperature)
    return squeezed * warm, COMPRESSION / stiff**2 * warm, -expansion * squeezed


def tait_volume(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: float,
    expansion: float,
    bulk_modulus: float,
    bulk_modulus_slope: float,
    bulk_modulus_fall: float,
) -> Slopes:
    r"""Volume relative to ambient pressure and the known temperature, with derivatives per Pa and per K.

    .. math:: \frac{V}{V_0} = [1 + a(T - T_0)]
              \left\{1 - \frac{1}{1 + K'}\ln\left[1 + \frac{p\,(1 + K')}{K(T)}\right]\right\},\quad
              K(T) = K_0\,e^{-\beta_K (T - T_0)}

    with thermal expansion a, bulk modulus K_0 at the known temperature, its slope in pressure K' and its relative fall
    per kelvin. Source: the equation of Tait as in S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics
    (2007).

    >>> volume, by_p, _ = tait_volume(0.0, 313.15, 313.15, 8e-4, 1.2e9, 11.0, 6e-3)
    >>> float(volume), round(float(-1.0 / by_p) / 1e9, 3)   # the bulk modulus
    (1.0, 1.2)
    """
    whole = 1.0 + bulk_modulus_slope
    modulus = bulk_modulus * np.exp(-bulk_modulus_fall * (temperature - known_temperature))
    warm = 1.0 + expansion * (temperature - known_temperature)
    squeezed = 1.0 - np.log1p(whole * pressure / modulus) / whole
    by_p = -warm / (modulus + whole * pressure)
    return warm * squeezed, by_p, expansion * squeezed + by_p * bulk_modulus_fall * pressure


@DENSITY.offers(
    "equation of state of Tait",
    TEMPERATURE,
    EXPANSION,
    Given("bulk_modulus", "bulk_modulus_GPa", "bulk modulus at temperature_C", times(GIGA), limits={"gt": 0.0}),
    Given("bulk_modulus_slope", "bulk_modulus_slope", "its slope in pressure", limits={"gt": 0.0}),
    Given("bulk_modulus_fall", "bulk_modulus_fall_per_K", "its relative fall per kelvin", limits={"ge": 0.0}),
    volume=tait_volume,
)
def tait(
    pressure: np.ndarray,
    temperature: np.ndarray,
    *,
    known_temperature: float,
    expansion: float,
    bulk_modulus: float,
    bulk_modulus_slope: float,
    bulk_modulus_fall: float,
) -> Slopes:
    r"""Relative density by Tait's equation of state, the inverse of `tait_volume`.

    .. math:: \bar\rho = V_0/V

    Source: the equation of Tait as in S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics (2007).

    >>> known = dict(known_temperature=313.15, expansion=8e-4, bulk_modulus_fall=6e-3)
    >>> round(float(tait(1e9, 313.15, **known, bulk_modulus=1.2e9, bulk_modulus_slope=11.0)[0]), 4)
    1.2497
    """
    volume, by_p, by_t = tait_volume(
        pressure, temperature, known_temperature, expansion, bulk_modulus, bulk_modulus_slope, bulk_modulus_fall
    )
    return 1.0 / volume, -by_p / volume**2, -by_t / volume**2


@DENSITY.offers("not at all, and no thermal expansion")
def incompressible(pressure: np.ndarray, temperature: np.ndarray) -> Slopes:
    r"""Relative density of an incompressible oil.

    .. math:: \bar\rho = 1

    Source: definition.

    >>> float(incompressible(1e9, 313.15)[0])
    1.0
    """
    one = np.ones(np.broadcast_shapes(np.shape(pressure), np.shape(temperature)))
    return one, 0.0 * one, 0.0 * one
