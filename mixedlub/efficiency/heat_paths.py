"""Heat from the oil sump of a gearbox to its surroundings, by way, as functions of the sump temperature."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.efficiency.thermal_file import Housing, Thermal
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import Lubricant

STEFAN_BOLTZMANN = 5.670374419e-8
"""Definition. Constant of radiation (W/(m^2 K^4)), CODATA 2018."""
WALL_STEPS = 50
"""Grid. Most steps of Newton for the temperature of the wall; four reach rounding."""
LITRE_A_MINUTE = 1e-3 / 60.0
CONVECTION, RADIATION, FOUNDATION, COOLER, OIL_FLOW = (
    "housing_convection",
    "housing_radiation",
    "foundation",
    "cooler",
    "oil_flow",
)


@dataclass(frozen=True)
class HeatPaths:
    """Ways of the heat; ``oil`` gives density and specific heat of circulating oil."""

    section: Thermal
    oil: Lubricant

    @property
    def ambient(self) -> float:
        """Ambient temperature (K)."""
        return self.section.ambient_temperature_C + ZERO_CELSIUS

    def wall(self, sump: np.ndarray) -> np.ndarray:
        r"""Temperature (K) of the outer wall of the housing, at which both sides pass the same heat.

        .. math:: h_i (T - T_w) = h_a (T_w - T_a) + \varepsilon\sigma (T_w^4 - T_a^4)
        """
        housing = self.section.housing
        if housing is None or housing.oil_side_W_m2K is None:
            return np.asarray(sump, dtype=float)
        inner, found = housing.oil_side_W_m2K, np.asarray(sump, dtype=float)
        for _ in range(WALL_STEPS):
            passed = housing.coefficient_W_m2K * (found - self.ambient) + self._radiated(housing, found)
            slope = inner + housing.coefficient_W_m2K + 4.0 * housing.emissivity * STEFAN_BOLTZMANN * found**3
            step = (inner * (sump - found) - passed) / slope
            found = found + step
            if np.all(np.abs(step) < 1e-12 * found):
                break
        return found

    def _radiated(self, housing: Housing, wall: np.ndarray) -> np.ndarray:
        """Radiation (W/m^2) of the wall to surroundings at ambient temperature."""
        return np.asarray(housing.emissivity * STEFAN_BOLTZMANN * (wall**4 - self.ambient**4))

    def heat(self, sump: np.ndarray) -> Mapping[str, np.ndarray]:
        """Heat (W) by way at sump temperatures (K)."""
        section, housing = self.section, self.section.housing
        found = {}
        if housing is not None:
            wall = self.wall(sump)
            found[CONVECTION] = housing.area_m2 * housing.coefficient_W_m2K * (wall - self.ambient)
            if housing.emissivity > 0.0:
                found[RADIATION] = housing.area_m2 * self._radiated(housing, wall)
        if section.foundation_W_K > 0.0:
            found[FOUNDATION] = section.foundation_W_K * (sump - self.ambient)
        if section.cooler is not None:
            coolant = section.cooler.coolant_temperature_C + ZERO_CELSIUS
            found[COOLER] = section.cooler.conductance_W_K * (sump - coolant)
        if section.oil_flow is not None:
            back = section.oil_flow.return_temperature_C + ZERO_CELSIUS
            mass = section.oil_flow.flow_l_min * LITRE_A_MINUTE * float(self.oil.density(np.array(back)))
            found[OIL_FLOW] = mass * self.oil.heat_capacity * (sump - back)
        return found

    def total(self, sump: np.ndarray) -> np.ndarray:
        """Heat (W) by all ways."""
        return np.sum(list(self.heat(sump).values()), axis=0)
