"""Contacts to be solved: bodies, load, speeds and temperatures, as arrays in SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.ehl.batch import Batch
from mixedlub.laws import contact
from profiles.errors import InputError


def numbers(where: str, value: object) -> np.ndarray:
    """A number or an array of numbers; another value raises an error at the place ``where``."""
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError("must be a number or an array of numbers", where=where, value=value) from None


def of_both(where: str, value: Any) -> tuple[np.ndarray, np.ndarray]:
    """A pair of values for both bodies; another length raises an error at the place ``where``."""
    try:
        first, second = value
    except (TypeError, ValueError):
        raise InputError("must be two, one for each body", where=where, value=value) from None
    return numbers(where, first), numbers(where, second)


@dataclass(frozen=True)
class Solids(Batch):
    """A wall of each contact: surface speed, bulk temperature and thermal properties."""

    speed: np.ndarray
    temperature: np.ndarray
    conductivity: np.ndarray
    density: np.ndarray
    heat_capacity: np.ndarray

    @property
    def effusivity(self) -> np.ndarray:
        """Thermal effusivity (W s^0.5/(m^2 K))."""
        return np.sqrt(self.conductivity * self.density * self.heat_capacity)


@dataclass(frozen=True)
class Contacts(Batch):
    """Line contacts; ``inlet``: start of the film (half widths before the centre), NaN: flooded."""

    radius: np.ndarray
    modulus: np.ndarray
    line_load: np.ndarray
    oil_temperature: np.ndarray
    inlet: np.ndarray
    first: Solids
    second: Solids

    @property
    def speed(self) -> np.ndarray:
        """Entrainment speed, the mean of both surface speeds (m/s)."""
        return 0.5 * (self.first.speed + self.second.speed)

    @property
    def sliding(self) -> np.ndarray:
        """Speed of the second surface relative to the first (m/s)."""
        return self.second.speed - self.first.speed

    @property
    def half_width(self) -> np.ndarray:
        """Hertz half width (m)."""
        return contact.line_hertz_half_width(self.line_load, self.radius, self.modulus)

    @property
    def pressure(self) -> np.ndarray:
        """Largest Hertz pressure (Pa)."""
        return contact.line_hertz_pressure(self.line_load, self.radius, self.modulus)

    @property
    def gap_unit(self) -> np.ndarray:
        """Unit of the gap, b^2/R (m)."""
        return self.half_width**2 / self.radius

    def moes(self, viscosity: np.ndarray, pressure_viscosity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Moes' load and lubricant parameters M and L, at ambient pressure."""
        speed = 2.0 * viscosity * self.speed / (self.modulus * self.radius)
        return self.line_load / (self.modulus * self.radius * np.sqrt(speed)), (
            pressure_viscosity * self.modulus * speed**0.25
        )
