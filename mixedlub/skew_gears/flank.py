"""Conjugate flanks of a pair: contact point, velocities and relative curvature of any point of the crown gear's flank.

The crown gear's flank is straight in profile and follows the tooth trace in length. The wheel's flank is its envelope
where both roll without slip, the pinion's flank the envelope of the wheel's. Both contacts are exact: they hold the
equation of meshing, n · (v1 - v2) = 0, in closed form.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.skew_gears.blank import Blank
from mixedlub.skew_gears.placing import ACROSS, GENERATOR, NORMAL, Axes


@dataclass(frozen=True, eq=False)
class Contact:
    """Contact points, all arrays of one shape (vectors with a last axis of three), per unit speed of the pinion.

    ``place``: from the mean point (m); ``wheel_angle``: turn of the wheel (rad); ``normal``: into the wheel;
    ``velocity``: of pinion and wheel (m); ``across``: unit vector in the flank across the contact line; ``passing``:
    speed of the contact across the pinion's and the wheel's flank (m); ``curvature``: relative curvature across the
    line (1/m), negative where the flanks would cut each other; ``lengthwise``: unit vector along the tooth.
    """

    place: np.ndarray
    wheel_angle: np.ndarray
    normal: np.ndarray
    velocity: tuple[np.ndarray, np.ndarray]
    across: np.ndarray
    passing: tuple[np.ndarray, np.ndarray]
    curvature: np.ndarray
    lengthwise: np.ndarray

    @property
    def sliding(self) -> np.ndarray:
        """Sliding velocity, pinion less wheel (m)."""
        return self.velocity[0] - self.velocity[1]

    @property
    def sliding_speed(self) -> np.ndarray:
        """Size of the sliding velocity (m)."""
        return np.asarray(np.linalg.norm(self.sliding, axis=-1))

    @property
    def entrainment(self) -> np.ndarray:
        """Mean of both speeds across the line, seen from the moving line (m)."""
        return np.abs(self.passing[0] + self.passing[1]) / 2

    @property
    def radius(self) -> np.ndarray:
        """Reduced radius of curvature across the line (m)."""
        return 1 / np.abs(self.curvature)


@dataclass(frozen=True, eq=False)
class _Flank:
    """Points of a flank with their curvatures: normal, and two unit directions each with a curvature (1/m)."""

    place: np.ndarray
    normal: np.ndarray
    directions: tuple[np.ndarray, ...]
    curvatures: tuple[np.ndarray, ...]

    def shape(self, vector: np.ndarray) -> np.ndarray:
        """Fall of the normal along a tangent vector."""
        return sum(
            (k * _dot(one, vector))[..., None] * one for one, k in zip(self.directions, self.curvatures, strict=True)
        )


def contact_at(blank: Blank, axes: Axes, along: np.ndarray, height: np.ndarray, *, drive: bool = True) -> Contact:
    """Contact of points of the crown gear's flank, of the drive or the coast side.

    ``along``: cone distance of the trace less the mean one (m); ``height``: above the pitch plane, towards the wheel's
    root (m).
    """
    along, height = np.broadcast_arrays(np.asarray(along, float), np.asarray(height, float))
    angle = blank.pressure_angle[0] if drive else -blank.pressure_angle[1]
    crown, turned = _rolled(blank, _crown(blank, angle, along, height))
    found = _of_pinion(axes, _of_wheel(blank, axes, crown), turned)
    return found if drive else replace(found, normal=-found.normal, curvature=-found.curvature)


def _crown(blank: Blank, angle: float, along: np.ndarray, height: np.ndarray) -> _Flank:
    trace = blank.trace
    beta, bend = trace.spiral_angle(along), trace.curvature(along)
    if trace.is_straight:
        turn = np.zeros(along.shape)
        foot = np.stack([along, along * np.tan(beta), np.zeros(along.shape)], axis=-1)
    else:
        turn, radius = trace.polar_angle(along), trace.distance + along
        # 1 - cos in its stable form, as the apex is far away.
        foot = np.stack(
            [along - 2 * radius * np.sin(turn / 2) ** 2, radius * np.sin(turn), np.zeros(along.shape)], axis=-1
        )
    heading = turn + beta
    zero = np.zeros(along.shape)
    length = np.stack([np.cos(heading), np.sin(heading), zero], axis=-1)
    side = np.stack([-np.sin(heading), np.cos(heading), zero], axis=-1)
    place = foot + height[..., None] * (NORMAL - np.tan(angle) * side)
    normal = np.cos(angle) * side + np.sin(angle) * NORMAL
    # The normal turns with the trace; the flank is longer or shorter off the pitch plane.
    curvature = bend * np.cos(angle) / (1 + height * np.tan(angle) * bend)
    return _Flank(place, normal, (length,), (curvature,))


def _rolled(blank: Blank, crown: _Flank) -> tuple[_Flank, np.ndarray]:
    """Crown flank turned into its contact with the wheel, and how far the wheel has turned.

    The normal then meets the generator along which crown gear and wheel roll on each other.
    """
    cones = blank.cones
    if blank.trace.is_straight:
        moment = np.cross(crown.place, crown.normal)
        moved = -moment[..., 0] / np.cross(ACROSS, crown.normal)[..., 0]
        return _Flank(crown.place + moved[..., None] * ACROSS, crown.normal, crown.directions, crown.curvatures), (
            moved / cones.radius[1]
        )
    apex = -cones.cone_distance[1] * GENERATOR
    moment = np.cross(crown.place - apex, crown.normal)
    # The moment in the pitch plane turns until it stands across the generator.
    angle = np.arctan2(moment[..., 0], moment[..., 1])
    angle -= np.pi * np.round(angle / np.pi)
    turned = _Flank(
        apex + _turn(NORMAL, angle, crown.place - apex),
        _turn(NORMAL, angle, crown.normal),
        tuple(_turn(NORMAL, angle, one) for one in crown.directions),
        crown.curvatures,
    )
    return turned, angle / np.sin(cones.angle[1])


def _of_wheel(blank: Blank, axes: Axes, crown: _Flank) -> _Flank:
    """Wheel flank, as the envelope of the crown's, in place at its contact with the crown gear."""
    own, cones = axes.turning[1], blank.cones
    speed = float(np.linalg.norm(own))
    crown_turning = speed * np.sin(cones.angle[1]) * NORMAL
    of_wheel = axes.velocity(1, crown.place)
    of_crown = axes.velocity(1, np.zeros(3)) + np.cross(crown_turning, crown.place)
    across, curvature, _ = _envelope(crown, (own, crown_turning), (of_wheel, of_crown))
    return _Flank(crown.place, crown.normal, (*crown.directions, across), (*crown.curvatures, curvature))


def _of_pinion(axes: Axes, wheel: _Flank, turned: np.ndarray) -> Contact:
    """Contact of the wheel's flank with the pinion: the wheel turns on until the equation of meshing holds."""
    pinion, own = axes.turning
    direction, speed = axes.direction[1], float(np.linalg.norm(own))
    moment = np.cross(wheel.place - axes.point[1], wheel.normal)
    reach = np.cross(pinion, axes.point[1] - axes.point[0])
    # f = A cos + B sin + C over the wheel's turn: moments about both axes.
    even, odd = (
        _along_turn(pinion, direction, moment, part) + _along_turn(reach, direction, wheel.normal, part)
        for part in ("cos", "sin")
    )
    fixed = (
        _along_turn(pinion, direction, moment, "fixed")
        + _along_turn(reach, direction, wheel.normal, "fixed")
        - speed * moment @ direction
    )
    size = np.hypot(even, odd)
    with np.errstate(invalid="ignore"):
        first, half = np.arctan2(odd, even), np.arccos(-fixed / size)
    ends = np.stack([first + half, first - half])
    ends -= 2 * np.pi * np.round(ends / (2 * np.pi))
    angle = np.where(np.abs(ends[0]) <= np.abs(ends[1]), ends[0], ends[1])
    off = even * np.cos(angle) + odd * np.sin(angle) + fixed
    angle = angle - off / (odd * np.cos(angle) - even * np.sin(angle))
    flank = _Flank(
        axes.point[1] + _turn(direction, angle, wheel.place - axes.point[1]),
        _turn(direction, angle, wheel.normal),
        tuple(_turn(direction, angle, one) for one in wheel.directions),
        wheel.curvatures,
    )
    velocity = axes.velocity(0, flank.place), axes.velocity(1, flank.place)
    across, curvature, passing = _envelope(flank, (pinion, own), velocity)
    return Contact(
        flank.place, turned + angle, flank.normal, velocity, across, passing, -curvature, flank.directions[0]
    )


def _envelope(
    flank: _Flank, turning: tuple[np.ndarray, np.ndarray], velocity: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]]:
    r"""Direction across the contact line, curvature of the envelope less that of the flank, and passing speeds.

    The first of both bodies carries the envelope, the second the flank of shape operator K:

    .. math:: p = n\times(\omega_1 - \omega_2) - K (v_1 - v_2),\quad
              \kappa = \frac{p^2}{n\cdot(\omega_1\times v_2 - \omega_2\times v_1) + p\cdot(v_1 - v_2)}
    """
    sliding = velocity[0] - velocity[1]
    slope = np.cross(flank.normal, turning[0] - turning[1]) - flank.shape(sliding)
    advance = _dot(flank.normal, np.cross(turning[0], velocity[1]) - np.cross(turning[1], velocity[0]))
    size = np.linalg.norm(slope, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        across = slope / size[..., None]
        on_flank = -advance / size
        on_envelope = on_flank - _dot(across, sliding)
        return across, -size / on_envelope, (on_envelope, on_flank)


def _along_turn(fixed: np.ndarray, axis: np.ndarray, vector: np.ndarray, part: str) -> np.ndarray:
    """Part of ``fixed`` · (vector turned about an axis): the constant one, or the factor of the cosine or sine."""
    if part == "fixed":
        return np.asarray((fixed @ axis) * (vector @ axis))
    if part == "cos":
        return np.asarray(vector @ fixed - (fixed @ axis) * (vector @ axis))
    return np.asarray(np.cross(axis, vector) @ fixed)


def _turn(axis: np.ndarray, angle: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """A vector turned about a unit axis (Rodrigues)."""
    cosine, sine = np.cos(angle)[..., None], np.sin(angle)[..., None]
    along = (vector @ axis)[..., None] * axis
    return np.asarray(along + cosine * (vector - along) + sine * np.cross(axis, vector))


def _dot(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("...i,...i->...", one, other))
