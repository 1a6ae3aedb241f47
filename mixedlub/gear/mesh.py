"""The contact points of one tooth pair along its path: position, curvature, speeds and load.

Everything is per unit of pinion speed, so that one mesh serves every operating condition:

- power loss ``sum(weight * mu * share * T1 / r_b1 * |sliding_per_speed| * omega1)``,
- line load ``share * T1 / r_b1 / (face_fraction * face_width)``, which is `Mesh.line_load`,
- plain mean over the path ``sum(weight * face_fraction * q) / sum(weight * face_fraction)``.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np

from mixedlub.gear.checks import column, torques_above_zero, whole
from mixedlub.gear.geometry import GearPair
from mixedlub.laws.load import gear_line_load
from mixedlub.schema.findings import Finding
from profiles.errors import InputError, refuse_other

ROUNDED = 0.005
"""Largest distance of a recorded roll angle beyond the path of contact, over its length: ends are rounded."""


@runtime_checkable
class Sharing(Protocol):
    """Interface of a load sharing for a mesh."""

    def default_slices(self, pair: GearPair) -> int:
        """Slices across the face when the caller names no number."""

    def check(self, pair: GearPair) -> tuple[Finding, ...]:
        """Raise an error for an unsuitable gear pair; else return findings about the sharing."""

    def breakpoints(self, pair: GearPair) -> np.ndarray:
        """Positions (m) where the share may kink or jump."""

    def load_share(self, mesh: Mesh, torque: np.ndarray) -> np.ndarray:
        """Share of the base-tangent force at each point, shape ``torque.shape + (M,)``."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Points of one tooth pair, position by position along the path and slice by slice across the face.

    All arrays have length M = positions x slices, slices fastest.

    - ``position``: x from the pinion's base tangent point, m; ``roll_angle``: x / r_b1, rad
    - ``radius``: effective radius of the contact normal to the flank, m
    - ``entrainment_per_speed``: mean surface speed over omega1, m
    - ``sliding_per_speed``: u1 - u2 over omega1, m; negative before the pitch point, positive after
    - ``weight``: quadrature weight dx / (p_bt cos(beta_b)); zero where the points are no quadrature
    - ``face_fraction``: slice width over face width; ``face_position``: its middle, m from the front
    - ``notes``: findings about the sharing
    """

    pair: GearPair
    sharing: Sharing
    slices: int
    position: np.ndarray
    roll_angle: np.ndarray
    radius: np.ndarray
    entrainment_per_speed: np.ndarray
    sliding_per_speed: np.ndarray
    weight: np.ndarray
    face_fraction: np.ndarray
    face_position: np.ndarray
    notes: tuple[Finding, ...]

    @property
    def contact_width(self) -> np.ndarray:
        """Width (m) of the contact at each point, which carries its share of the load: one slice."""
        return self.face_fraction * self.pair.face_width

    @property
    def lag(self) -> np.ndarray:
        """Delay of each slice behind the front of the face (base pitches); helical pairs touch there first."""
        return self.face_position * np.tan(abs(self.pair.base_helix_angle)) / self.pair.base_pitch

    def load_share(self, torque: object) -> np.ndarray:
        """Share of T1/r_b1 that each point's slice carries, shape ``torque.shape + (M,)``; torque in N m.

        Its sum over the slices is the share of the tooth pair at that position. It acts on `contact_width`, not on the
        whole face: `line_load` is the force per length.
        """
        return self.sharing.load_share(self, torques_above_zero(torque))

    def line_load(self, torque: object) -> np.ndarray:
        """Normal force per length (N/m) at each point, shape ``torque.shape + (M,)``; torque on the pinion in N m.

        The share of each slice acts on the width of that slice, so the number of slices does not change the result.

        >>> from mixedlub.gear import LdpSharing
        >>> fzg = GearPair(
        ...     (16, 24), 4.5e-3, np.radians(20), 14e-3, profile_shift=(0.182, 0.172), centre_distance=91.5e-3
        ... )
        >>> print(round(mesh(fzg, LdpSharing()).line_load(302.0).max() / 1e3), "N/mm")
        651 N/mm
        """
        force = torques_above_zero(torque)[..., None] / self.pair.base_radius[0]
        return gear_line_load(self.load_share(torque), force, self.contact_width)


def mesh(pair: GearPair, sharing: Sharing, *, points: int = 48, slices: int | None = None) -> Mesh:
    """The quadrature mesh over the whole path of contact.

    Gauss-Legendre panels between the pitch point and every position where the sharing kinks or jumps, at least three
    points each and about ``points`` in all; ``slices`` equal slices across the face (default of the sharing).
    ``sum(weight * f)`` is (1/p_bt) times the integral of f over the path (spur).

    Equal sharing between rigid teeth gives back Ohlendorf's loss factor of the FZG C test gear:

    >>> from mixedlub.gear.sharing.rigid import RigidSharing
    >>> fzg = GearPair(teeth=(16, 24), normal_module=4.5e-3, pressure_angle=np.radians(20),
    ...                profile_shift=(0.1817, 0.1715), tip_radius=(41.23e-3, 59.18e-3),
    ...                centre_distance=91.5e-3, face_width=14e-3)
    >>> points = mesh(fzg, RigidSharing())
    >>> sliding = np.abs(points.sliding_per_speed) / fzg.base_radius[0]
    >>> print(round((points.weight * points.load_share(100.0) * sliding).sum(), 4))
    0.195
    """
    _check_parts(pair, sharing, "gear.mesh")
    points = whole("points", points, 1, 100_000)
    slices = sharing.default_slices(pair) if slices is None else whole("slices", slices, 1, 1000)
    notes = sharing.check(pair)
    position, width = panel_rule(pair, sharing.breakpoints(pair), points)
    return _lay_out(pair, sharing, position, width / pair.base_pitch, slices, notes)


def at_roll_angle(pair: GearPair, sharing: Sharing, roll_angle: object, *, slices: int | None = None) -> Mesh:
    """The contact points at given pinion roll angles (rad, one-dimensional), in the order given.

    For local quantities such as the friction coefficient of one tooth; the weights are zero. Angles beyond the path of
    contact by up to 0.5 % of its length are moved to its end (rounded recordings); others raise an error.
    """
    _check_parts(pair, sharing, "gear.at_roll_angle")
    angles = column("roll_angle_deg", np.atleast_1d(np.asarray(roll_angle)))
    slices = sharing.default_slices(pair) if slices is None else whole("slices", slices, 1, 1000)
    notes = sharing.check(pair)
    start, end = pair.path_start / pair.base_radius[0], pair.path_end / pair.base_radius[0]
    margin = ROUNDED * (end - start)
    wrong = ~((angles >= start - margin) & (angles <= end + margin))
    if np.any(wrong):
        raise InputError(
            f"the path of contact runs from {np.degrees(start):.4g} to {np.degrees(end):.4g} deg",
            where="roll_angle_deg",
            value=round(float(np.degrees(angles[wrong][0])), 6),
        )
    position = np.clip(angles * pair.base_radius[0], pair.path_start, pair.path_end)
    return _lay_out(pair, sharing, position, np.zeros_like(position), slices, notes)


def _check_parts(pair: object, sharing: object, call: str) -> None:
    refuse_other(pair, GearPair, "ml.gear.GearPair(...)", f"{call}: pair")
    refuse_other(sharing, Sharing, "a sharing, as ml.gear.RigidSharing() makes it", f"{call}: sharing")


def panel_rule(pair: GearPair, breakpoints: np.ndarray, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Gauss-Legendre positions and weights (m) over the path, in panels between the breakpoints."""
    start, end = pair.path_start, pair.path_end
    inner = np.concatenate([np.asarray(breakpoints, dtype=float), [pair.pitch_point]])
    close = 1e-6 * (end - start)
    inner = np.sort(inner[(inner > start + close) & (inner < end - close)])
    inner = inner[np.diff(inner, prepend=start) > close]
    edges = np.concatenate([[start], inner, [end]])
    position, width = [], []
    for low, high in pairwise(edges):
        count = max(3, round(points * (high - low) / (end - start)))
        node, weight = np.polynomial.legendre.leggauss(count)
        position.append((low + high) / 2 + (high - low) / 2 * node)
        width.append((high - low) / 2 * weight)
    return np.concatenate(position), np.concatenate(width)


def _lay_out(
    pair: GearPair,
    sharing: Sharing,
    position: np.ndarray,
    weight: np.ndarray,
    slices: int,
    notes: tuple[Finding, ...],
) -> Mesh:
    """Repeat positions over the slices and compute the kinematics."""
    x = np.repeat(position, slices)
    other = pair.line_of_action_length - x
    fraction = np.full(x.size, 1.0 / slices)
    middle = np.tile((np.arange(slices) + 0.5) * pair.face_width / slices, position.size)
    cosine = np.cos(pair.base_helix_angle)
    arrays = {
        "position": x,
        "roll_angle": x / pair.base_radius[0],
        "radius": x * other / (pair.line_of_action_length * cosine),
        "entrainment_per_speed": (x + other / pair.teeth_ratio) / 2,
        "sliding_per_speed": x - other / pair.teeth_ratio,
        "weight": np.repeat(weight, slices) / cosine,
        "face_fraction": fraction,
        "face_position": middle,
    }
    for array in arrays.values():
        array.flags.writeable = False
    return Mesh(pair=pair, sharing=sharing, slices=slices, notes=notes, **arrays)
