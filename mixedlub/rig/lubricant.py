"""Lubricant of a case: data of the oil and properties at a temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.laws import oil
from mixedlub.schema.traction_part import Traction
from profiles.errors import InputError

LINEAR, ROELANDS, GOLD = "linear", "roelands", "gold"
"""Extensions of the pressure-viscosity coefficient from its two values to other temperatures."""


@dataclass(frozen=True)
class Lubricant:
    """Oil in SI: two points of kinematic viscosity, pressure-viscosity coefficient, density, thermal properties.

    ``carried``: extension of the coefficient to other temperatures, linear in temperature through its two values, at
    the exponent of Roelands, or as a power of kinematic viscosity through the values. ``traction``: Eyring stress and
    limiting stress over pressure and temperature.
    """

    name: str
    temperature: tuple[float, float]
    kinematic_viscosity: tuple[float, float]
    pressure_viscosity: tuple[float, float]
    density_15: float
    density_change: float
    eyring_stress: float
    conductivity: float
    heat_capacity: float
    pressure_modulus: tuple[float, float] | None = None
    modulus_slope: tuple[float, float] | None = None
    carried: str = LINEAR
    traction: Traction | None = None

    def density(self, temperature: np.ndarray) -> np.ndarray:
        """Density at ambient pressure (kg/m^3): linear in temperature (K)."""
        return self.density_15 * (1.0 - self.density_change * (temperature - oil.ZERO_CELSIUS - 15.0))

    def viscosity(self, temperature: np.ndarray) -> np.ndarray:
        """Dynamic viscosity at ambient pressure (Pa s)."""
        nu = oil.kinematic_viscosity(temperature, self.temperature, self.kinematic_viscosity)
        return nu * self.density(temperature)

    def carrying(self, coefficient: float, temperature: float, way: str, power: float) -> Lubricant:
        """Oil with a pressure-viscosity coefficient (1/Pa) known at one temperature (K).

        ``power``: exponent of the kinematic viscosity in the relation of Gold.

        >>> oil = Lubricant("ester", (313.15, 373.15), (23e-6, 4.9e-6), (0, 0), 995.0, 8e-4, 5e6, 0.14, 2e3)
        >>> [round(alpha * 1e9, 1) for alpha in oil.carrying(14.2e-9, 327.15, "roelands", 0.0).pressure_viscosity]
        [15.4, 11.2]
        """
        known = np.array([temperature, *self.temperature])
        if way == ROELANDS:
            shape = np.log(self.viscosity(known)) + oil.ROELANDS_LOG
        else:
            shape = (self.viscosity(known) / self.density(known)) ** power
        first, second = coefficient * shape[1:] / shape[0]
        return replace(self, pressure_viscosity=(float(first), float(second)), carried=way)

    def pressure_coefficient(self, temperature: np.ndarray) -> np.ndarray:
        """Pressure-viscosity coefficient (1/Pa), from its two values."""
        first = self.pressure_viscosity[0]
        if self.carried == ROELANDS:
            exponent = oil.roelands_exponent(self.viscosity(np.array(self.temperature[0])), first)
            return oil.roelands_coefficient(self.viscosity(temperature), exponent)
        if self.carried == GOLD:
            thinner = self.viscosity(temperature) / self.density(temperature) / self.kinematic_viscosity[0]
            return np.asarray(first * thinner**self._power)
        return self._linear(self.pressure_viscosity, temperature)

    @property
    def _power(self) -> float:
        """Exponent of the kinematic viscosity in the pressure-viscosity coefficient, through the two values."""
        (a1, a2), (nu1, nu2) = self.pressure_viscosity, self.kinematic_viscosity
        return float(np.log(a1 / a2) / np.log(nu1 / nu2))

    def fall(self, temperature: np.ndarray) -> np.ndarray:
        """Relative decrease of the viscosity at ambient pressure (1/K)."""
        thinner = self.density_change * self.density_15 / self.density(temperature)
        return oil.temperature_viscosity(temperature, self.temperature, self.kinematic_viscosity) + thinner

    def coefficient_change(self, temperature: np.ndarray) -> np.ndarray:
        """Change of the pressure-viscosity coefficient per kelvin (1/(Pa K))."""
        (t1, t2), (a1, a2) = self.temperature, self.pressure_viscosity
        if self.carried == ROELANDS:
            exponent = oil.roelands_exponent(self.viscosity(np.array(t1)), a1)
            return np.asarray(-exponent * self.fall(temperature) / oil.ROELANDS_PRESSURE)
        if self.carried == GOLD:
            thinner = oil.temperature_viscosity(temperature, self.temperature, self.kinematic_viscosity)
            return np.asarray(-self._power * thinner * self.pressure_coefficient(temperature))
        return np.full_like(temperature, (a2 - a1) / (t2 - t1), dtype=float)

    def log_under_pressure(self, pressure: np.ndarray, temperature: np.ndarray) -> np.ndarray:
        """Logarithm of the viscosity (Pa s) under pressure by Roelands."""
        viscosity, coefficient = self.viscosity(temperature), self.pressure_coefficient(temperature)
        return np.log(oil.roelands_viscosity(viscosity, coefficient, pressure))

    def _linear(self, values: tuple[float, float], temperature: np.ndarray) -> np.ndarray:
        """Property linear in temperature (K), from its values at the two known temperatures."""
        (t1, t2), (a1, a2) = self.temperature, values
        return a1 + (a2 - a1) * (temperature - t1) / (t2 - t1)

    def inputs(self, temperature: np.ndarray) -> dict[str, np.ndarray | float]:
        """Oil inputs of the chain at a temperature (K), by glossary name."""
        coefficient = self.pressure_coefficient(temperature)
        if np.any(coefficient <= 0.0):
            worst = float(np.ravel(temperature)[np.argmin(coefficient)]) - oil.ZERO_CELSIUS
            rule = (
                f"the straight line through both values is below zero at {worst:g} °C; give values on both sides of "
                "the temperatures of use, or known_pressure_viscosity, one value that is carried to others"
            )
            raise InputError(rule, where="lubricant.pressure_viscosity_per_GPa")
        viscosity, known = self.viscosity(temperature), self.viscosity(np.array(self.temperature))
        return {
            "viscosity": viscosity,
            "pressure_viscosity": coefficient,
            "temperature_viscosity": oil.temperature_viscosity(
                temperature, self.temperature, self.kinematic_viscosity, self.density_change
            ),
            "coefficient_fall": -self.coefficient_change(temperature) / coefficient,
            "first_known_temperature": self.temperature[0],
            "second_known_temperature": self.temperature[1],
            "known_fall": float(np.log(known[0] / known[1])),
            "fall_from_first": np.log(known[0] / viscosity),
            "oil_density": self.density(temperature),
            "oil_conductivity": self.conductivity,
            "oil_heat_capacity": self.heat_capacity,
            "eyring_stress": self.eyring_stress,
            **self._modulus(temperature),
            **self._fitted_range(),
        }

    def _fitted_range(self) -> dict[str, float]:
        """Range of the readings behind the traction part, or empty."""
        if self.traction is None:
            return {}
        pressure, temperature = self.traction.pressure_GPa, self.traction.temperature_C
        return {
            "lowest_fitted_pressure": pressure[0] * 1e9,
            "highest_fitted_pressure": pressure[1] * 1e9,
            "lowest_fitted_temperature": temperature[0] + oil.ZERO_CELSIUS,
            "highest_fitted_temperature": temperature[1] + oil.ZERO_CELSIUS,
        }

    def _modulus(self, temperature: np.ndarray) -> dict[str, np.ndarray]:
        """Constants of the modulus equation, or empty."""
        if self.pressure_modulus is None or self.modulus_slope is None:
            return {}
        return {
            "pressure_modulus": self._linear(self.pressure_modulus, temperature),
            "modulus_slope": self._linear(self.modulus_slope, temperature),
        }
