"""Fluids of a solved contact: viscosity and density over pressure and temperature, and laws of shear."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.validation.contact import ROELANDS_PRESSURE, Oil

State = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""A property over pressure (Pa) and temperature (C)."""
Shear = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""A stress, or viscosity times shear rate, from the other of the two and the pressure (all Pa)."""
FULL_SHEAR = 700.0
"""Largest argument of a hyperbolic function."""


@dataclass(frozen=True)
class Law:
    """A law of shear: stress from viscosity times shear rate, and the reverse, at a pressure (Pa).

    ``limit``: limiting stress of the slip over its pressure, infinite without; the flow by pressure does not know it.
    ``name``: for the truth of a case.
    """

    stress: Shear
    rate: Shear
    limit: float = np.inf
    name: str = ""

    def limited(self, stress: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        """Stress of the slip below the limit: t/[1 + (t/t_L)^4]^(1/4)."""
        if not np.isfinite(self.limit):
            return stress
        most = self.limit * np.maximum(pressure, 0.0) + 1e5
        return np.asarray(stress / (1 + (stress / most) ** 4) ** 0.25)


def newton() -> Law:
    return Law(lambda rate, pressure: rate, lambda stress, pressure: stress)


def eyring(scale: Callable[[np.ndarray], np.ndarray] | float, name: str = "Eyring") -> Law:
    """Ree and Eyring's stress s asinh(eta g/s), with a scale s (Pa) that may depend on the pressure."""

    def of(pressure: np.ndarray) -> np.ndarray:
        return np.asarray(scale(pressure) if callable(scale) else scale)

    def rate(stress: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        s = of(pressure)
        return np.asarray(s * np.sinh(np.clip(stress / s, -FULL_SHEAR, FULL_SHEAR)))

    return Law(lambda rate, pressure: of(pressure) * np.arcsinh(rate / of(pressure)), rate, name=name)


def carreau(scale: float, index: float) -> Law:
    """Carreau's law in the stress: eta g = t [1 + (t/G)^2]^((1/n - 1)/2), Newtonian below G (Bair 2002).

    >>> law = carreau(3e6, 0.5)
    >>> round(float(law.stress(law.rate(np.array(9e6), 0.0), 0.0)) / 1e6, 6)
    9.0
    """
    power = 0.5 * (1 / index - 1)

    def rate(stress: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        return np.asarray(stress * (1 + (stress / scale) ** 2) ** power)

    def stress(rate_: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        size = np.maximum(np.abs(rate_), 1e-9)
        found = np.log(np.minimum(size, scale * (size / scale) ** index))
        for _ in range(6):
            square = (np.exp(found) / scale) ** 2
            slope = 1 + 2 * power * square / (1 + square)
            found = found - (found + power * np.log1p(square) - np.log(size)) / slope
        return np.asarray(np.sign(rate_) * np.exp(found))

    return Law(stress, rate, name="Carreau")


def limited(law: Law, share: float) -> Law:
    """A law with a limiting stress, a share of the pressure.

    >>> law = limited(newton(), 0.05)
    >>> round(float(law.limited(np.array(5e7), np.array(1e9))) / 1e6, 2)  # a limit of 50 MPa
    42.09
    """
    return replace(law, limit=share)


@dataclass(frozen=True)
class Fluid:
    """An oil of the solver: logarithm of viscosity (Pa s), density (kg/m3), shear, heat conduction in SI.

    ``expansion``: relative density loss per kelvin over temperature (C), in the heat of compression.
    """

    log_viscosity: State
    density: State
    law: Law
    conductivity: float
    specific_heat: float
    expansion: Callable[[np.ndarray], np.ndarray | float]

    def thinning(self, pressure: np.ndarray, celsius: np.ndarray) -> np.ndarray:
        """Derivative of the logarithm of viscosity by temperature (1/K), below zero."""
        return (self.log_viscosity(pressure, celsius + 0.5) - self.log_viscosity(pressure, celsius - 0.5)) / 1.0


def dowson_higginson(pressure: np.ndarray) -> np.ndarray:
    """Density over density at rest: 1 + 0.6 p/(1 + 1.7 p), p in GPa (Dowson and Higginson 1966).

    >>> round(float(dowson_higginson(np.array(1e9))), 4)
    1.2222
    """
    giga = 1e-9 * np.maximum(pressure, 0.0)
    return np.asarray(1 + 0.6 * giga / (1 + 1.7 * giga))


def roelands(rest: np.ndarray, slope: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Logarithm of viscosity by Roelands from that at rest and its slope in pressure (1/Pa)."""
    level = rest + 9.67
    return np.asarray(
        level * (1 + np.maximum(pressure, 0.0) / ROELANDS_PRESSURE) ** (slope * ROELANDS_PRESSURE / level) - 9.67
    )


LEAST_SLOPE = 2e-9
"""Smallest pressure-viscosity coefficient (1/Pa) of an oil far above its data sheet."""


def fluid_of(oil: Oil, law: Law, viscosity: float = 1.0, pressure_viscosity: float = 1.0) -> Fluid:
    """Fluid of a data sheet with factors on its viscosity and pressure-viscosity coefficient, by Roelands' law."""

    def log_viscosity(pressure: np.ndarray, celsius: np.ndarray) -> np.ndarray:
        rest = np.log(viscosity * oil.viscosity_at(celsius))
        slope = np.maximum(pressure_viscosity * oil.pressure_viscosity_at(celsius), LEAST_SLOPE)
        return roelands(rest, slope, pressure)

    return Fluid(
        log_viscosity,
        lambda pressure, celsius: dowson_higginson(pressure) * oil.density_at(celsius),
        law,
        oil.conductivity,
        oil.specific_heat,
        lambda celsius: oil.expansion * oil.density_15 / oil.density_at(celsius),
    )
