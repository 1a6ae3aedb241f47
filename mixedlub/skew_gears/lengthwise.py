"""Lengthwise shape of the teeth on the crown gear: circle of face milling, epicycloid of face hobbing, or line."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Trace:
    """Tooth trace in the pitch plane; ``along``: distance from the mean point along the generator of the wheel (m).

    ``distance``: mean cone distance, infinite of cylinders; ``spiral``: mean spiral angle; ``centre``: distance of the
    cutter's axis from the apex; ``base``: radius of the base circle of its rolling, equal to ``centre`` for face
    milling.
    """

    distance: float
    spiral: float
    cutter: float
    centre: float
    base: float

    @property
    def is_straight(self) -> bool:
        """Whether the crown gear is a rack."""
        return math.isinf(self.distance)

    def spiral_angle(self, along: np.ndarray) -> np.ndarray:
        r"""Spiral angle, ISO 23509 formulas 181 and 183.

        .. math:: \tan\beta = \frac{R - \rho_b\cos\varphi}{\rho_b\sin\varphi},\quad
                  \cos\varphi = \frac{R^2 + \rho_{P0}^2 - r_{c0}^2}{2 R \rho_{P0}}
        """
        if self.is_straight:
            return np.full(np.shape(along), self.spiral)
        radius = self.distance + along
        phi = self._seen(radius)
        return np.arctan2(radius - self.base * np.cos(phi), self.base * np.sin(phi))

    def polar_angle(self, along: np.ndarray) -> np.ndarray:
        """Turn of the trace about the apex, from the mean point."""
        radius = self.distance + along
        rolled = (self._blade(radius) - self._blade(self.distance)) * (self.centre - self.base) / self.base
        return np.asarray(rolled + self._seen(self.distance) - self._seen(radius))

    def curvature(self, along: np.ndarray) -> np.ndarray:
        """Curvature (1/m), for circles of the cutter 1/r_c0."""
        if self.is_straight:
            return np.zeros(np.shape(along))
        radius = self.distance + along
        phi = self._seen(radius)
        turning = (self.centre**2 - self.cutter**2 - radius**2) / (2 * radius**2 * self.centre * np.sin(phi))
        height, width = radius - self.base * np.cos(phi), self.base * np.sin(phi)
        rise = (1 + width * turning) * width - height * self.base * np.cos(phi) * turning
        beta = np.arctan2(height, width)
        change = rise / width**2 * np.cos(beta) ** 2
        return np.asarray(np.cos(beta) * (np.tan(beta) / radius + change))

    def ends(self) -> tuple[float, float]:
        """Smallest and largest cone distance that the cutter reaches."""
        return abs(self.centre - self.cutter), self.centre + self.cutter

    def _seen(self, radius: np.ndarray | float) -> np.ndarray:
        """Angle at the apex between a point and the cutter's axis."""
        return _angle((radius**2 + self.centre**2 - self.cutter**2) / (2 * radius * self.centre))

    def _blade(self, radius: np.ndarray | float) -> np.ndarray:
        """Angle at the cutter's axis between apex and blade."""
        return _angle((self.centre**2 + self.cutter**2 - radius**2) / (2 * self.centre * self.cutter))


def _angle(cosine: np.ndarray | float) -> np.ndarray:
    """Angle of a cosine; not a number beyond the reach of the cutter."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.arccos(cosine))


def crown_trace(distance: float, spiral: float, cutter: float, ratio: float) -> Trace:
    """Trace of a mean cone distance and spiral angle; ``ratio``: blade groups over teeth of the crown gear.

    ISO 23509 formulas 176 to 178.
    """
    if math.isinf(distance):
        return Trace(distance, spiral, cutter, math.inf, math.inf)
    lead = math.asin(min(1.0, ratio * distance * math.cos(spiral) / cutter))
    centre = math.sqrt(distance**2 + cutter**2 - 2 * distance * cutter * math.sin(spiral - lead))
    return Trace(distance, spiral, cutter, centre, centre / (1 + ratio))
