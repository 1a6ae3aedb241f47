"""Axes of a pair about its mean point, as exact vectors.

The mean point is the origin. The pitch plane holds the wheel's generator (first axis), its normal points from the
pinion to the wheel (third axis). Everything is per unit angular speed of the pinion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.skew_gears.pitch_cones import PitchCones

NORMAL = np.array([0.0, 0.0, 1.0])
GENERATOR = np.array([1.0, 0.0, 0.0])
ACROSS = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False)
class Axes:
    """Directions of both axes, away from the apexes, points on both axes, and the angular velocities."""

    cones: PitchCones
    direction: tuple[np.ndarray, np.ndarray]
    point: tuple[np.ndarray, np.ndarray]
    turning: tuple[np.ndarray, np.ndarray]

    def velocity(self, wheel: int, place: np.ndarray) -> np.ndarray:
        """Velocity (m per rad of the pinion) of a member, 0 pinion and 1 wheel, at places."""
        return np.cross(self.turning[wheel], place - self.point[wheel])

    @property
    def shaft_angle(self) -> float:
        """Angle between both axes."""
        return float(np.arccos(np.clip(self.direction[0] @ self.direction[1], -1.0, 1.0)))

    @property
    def offset(self) -> float:
        """Shortest distance of both axes; of parallel axes, the centre distance."""
        between = self.point[1] - self.point[0]
        across = np.cross(*self.direction)
        size = float(np.linalg.norm(across))
        if size == 0.0:
            return float(np.linalg.norm(np.cross(between, self.direction[0])))
        return abs(float(between @ across)) / size

    def in_axial_plane(self, wheel: int, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Height above the pitch cone of a member and distance along it from the mean point, of places."""
        own, angle, radius = self.direction[wheel], self.cones.angle[wheel], self.cones.radius[wheel]
        out = place - self.point[wheel]
        along = out @ own
        beyond = np.linalg.norm(out - along[..., None] * own, axis=-1) - radius
        return beyond * np.cos(angle) - along * np.sin(angle), beyond * np.sin(angle) + along * np.cos(angle)


def axes(cones: PitchCones) -> Axes:
    """Axes of a pair of pitch cones; the wheel moves along the second axis where the drive flanks touch."""
    turn = cones.offset_angle
    generators = (np.array([np.cos(turn), -np.sin(turn), 0.0]), GENERATOR)
    direction, point = [], []
    for generator, normal, angle, radius in zip(generators, (NORMAL, -NORMAL), cones.angle, cones.radius, strict=True):
        direction.append(np.cos(angle) * generator - np.sin(angle) * normal)
        point.append(-radius * (np.cos(angle) * normal + np.sin(angle) * generator))
    turning = (-direction[0], direction[1] / cones.ratio)
    return Axes(cones, (direction[0], direction[1]), (point[0], point[1]), turning)
