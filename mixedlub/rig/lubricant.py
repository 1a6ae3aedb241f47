"""The lubricant of a case: what is known of the oil, and its properties at a temperature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.laws import oil


@dataclass(frozen=True)
class Lubricant:
    """An oil in SI: two points of kinematic viscosity, pressure-viscosity coefficient, density, heat."""

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

    def density(self, temperature: np.ndarray) -> np.ndarray:
        """Density at ambient pressure (kg/m^3): linear in temperature (K)."""
        return self.density_15 * (1.0 - self.density_change * (temperature - oil.ZERO_CELSIUS - 15.0))

    def viscosity(self, temperature: np.ndarray) -> np.ndarray:
        """Dynamic viscosity at ambient pressure (Pa s)."""
        nu = oil.kinematic_viscosity(temperature, self.temperature, self.kinematic_viscosity)
        return nu * self.density(temperature)

    def pressure_coefficient(self, temperature: np.ndarray) -> np.ndarray:
        """Pressure-viscosity coefficient (1/Pa): linear in temperature through its two values."""
        return self._linear(self.pressure_viscosity, temperature)

    def _linear(self, values: tuple[float, float], temperature: np.ndarray) -> np.ndarray:
        """A property that is linear in temperature (K), by its values at the two known temperatures."""
        (t1, t2), (a1, a2) = self.temperature, values
        return a1 + (a2 - a1) * (temperature - t1) / (t2 - t1)

    def inputs(self, temperature: np.ndarray) -> dict[str, np.ndarray | float]:
        """What the chain wants to know of the oil at a temperature (K), by glossary name."""
        (t1, t2), (a1, a2) = self.temperature, self.pressure_viscosity
        viscosity, known = self.viscosity(temperature), self.viscosity(np.array(self.temperature))
        return {
            "viscosity": viscosity,
            "pressure_viscosity": self.pressure_coefficient(temperature),
            "temperature_viscosity": oil.temperature_viscosity(
                temperature, self.temperature, self.kinematic_viscosity, self.density_change
            ),
            "coefficient_fall": (a1 - a2) / ((t2 - t1) * self.pressure_coefficient(temperature)),
            "first_known_temperature": self.temperature[0],
            "second_known_temperature": self.temperature[1],
            "known_fall": float(np.log(known[0] / known[1])),
            "fall_from_first": np.log(known[0] / viscosity),
            "oil_density": self.density(temperature),
            "oil_conductivity": self.conductivity,
            "oil_heat_capacity": self.heat_capacity,
            "eyring_stress": self.eyring_stress,
            **self._modulus(temperature),
        }

    def _modulus(self, temperature: np.ndarray) -> dict[str, np.ndarray]:
        """Constants of the modulus equation, where the oil has them."""
        if self.pressure_modulus is None or self.modulus_slope is None:
            return {}
        return {
            "pressure_modulus": self._linear(self.pressure_modulus, temperature),
            "modulus_slope": self._linear(self.modulus_slope, temperature),
        }
