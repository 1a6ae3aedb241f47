"""Oil of the solver: laws with derivatives, as functions of pressure (Pa) and temperature (K)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Slopes = tuple[np.ndarray, np.ndarray, np.ndarray]
"""A quantity and its derivatives by the two arguments of its law."""
WarmSlopes = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""A quantity and its derivatives by stress, pressure and temperature."""


def constant(value: float) -> Callable[[np.ndarray], np.ndarray]:
    """A quantity independent of pressure."""
    return lambda pressure: np.full_like(pressure, value)


def expansion_of(density_ratio: Callable[[np.ndarray, np.ndarray], Slopes]) -> Callable[..., np.ndarray]:
    """Thermal expansion (1/K) of a law of density, as a function of pressure and temperature."""

    def law(pressure: np.ndarray, temperature: np.ndarray) -> np.ndarray:
        density, _, by_temperature = density_ratio(pressure, temperature)
        return -by_temperature / density

    return law


@dataclass(frozen=True)
class Oil:
    """Laws and constants of an oil.

    ``log_viscosity``, ``density_ratio``, ``expansion`` (1/K): functions of pressure and temperature. ``shear``:
    viscosity times shear rate as a function of stress and pressure. ``stress_scale``, ``stress_limit`` (Pa): onset of
    non-Newtonian flow and upper bound of the stress, by pressure. ``warm_shear``: shear of an oil with stresses that
    depend on temperature too. Densities are relative to ``density``.
    """

    name: str
    log_viscosity: Callable[[np.ndarray, np.ndarray], Slopes]
    density_ratio: Callable[[np.ndarray, np.ndarray], Slopes]
    shear: Callable[[np.ndarray, np.ndarray], Slopes]
    stress_scale: Callable[[np.ndarray], np.ndarray]
    newtonian: bool
    stress_limit: Callable[[np.ndarray], np.ndarray]
    density: float
    expansion: Callable[[np.ndarray, np.ndarray], np.ndarray]
    conductivity: float
    heat_capacity: float
    temperatures: tuple[float, float] = (0.0, np.inf)
    largest_pressure: float = np.inf
    warm_shear: Callable[[np.ndarray, np.ndarray, np.ndarray], WarmSlopes] | None = None

    def sheared(self, stress: np.ndarray, pressure: np.ndarray, temperature: np.ndarray) -> WarmSlopes:
        """Viscosity times shear rate, with derivatives by stress, pressure and temperature."""
        if self.warm_shear is not None:
            return self.warm_shear(stress, pressure, temperature)
        rate, by_stress, by_pressure = self.shear(stress, pressure)
        return rate, by_stress, by_pressure, np.zeros_like(rate)

    def at_ambient(self, temperature: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Viscosity (Pa s) and pressure-viscosity coefficient (1/Pa) at ambient pressure."""
        log, slope, _ = self.log_viscosity(np.zeros_like(temperature), temperature)
        return np.exp(log), slope

    @property
    def eyring_stress(self) -> float:
        """Eyring stress (Pa) of a Ree-Eyring oil with a stress independent of pressure and temperature; zero for other
        oils."""
        if self.warm_shear is not None:
            return 0.0
        pressure = np.array([0.0, 1e9])
        own = self.stress_scale(pressure)
        rates = [self.shear(ratio * own, pressure)[0] / (np.sinh(ratio) * own) for ratio in (1.0, 3.0)]
        same = np.ptp(own) == 0.0 and np.allclose(rates, 1.0, rtol=1e-6)
        return float(own[0]) if same else 0.0
