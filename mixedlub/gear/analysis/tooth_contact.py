"""The mesh of a gear pair at given torques: load on every slice of a tooth pair along its path."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.gear import (
    GearPair,
    LdpSharing,
    LoadDistribution,
    Sharing,
    at_roll_angle,
    local_loss_factor,
    mesh,
    transmission_error,
)
from mixedlub.gear.contact_lines import mid_face_path, rise
from mixedlub.gear.corner_contact import REACH
from mixedlub.laws.contact import line_hertz_pressure
from profiles.errors import InputError

FINE = 64
"""Slices of oblique lines without a contact problem: each is on the path as a whole or not at all."""


@dataclass(frozen=True)
class MeshConditions:
    """Resolution of a mesh and deviations from the ideal; lengths in m. ``positions`` over each base pitch, ``slices``
    of the face (None: default of the sharing); ``pitch_deviation`` of successive tooth pairs."""

    positions: int = 64
    slices: int | None = None
    edge_contact: bool = False
    pitch_deviation: tuple[float, ...] = (0.0,)

    @property
    def ideal(self) -> bool:
        """Whether contact keeps to the path and all tooth pairs are alike."""
        return not self.edge_contact and not any(self.pitch_deviation)


@dataclass(frozen=True, eq=False)
class ToothContact:
    """Contact of T torques (N m) for M positions of one tooth pair with N slices, in SI.

    - ``middle`` (M,): position of the pair on the path at the middle of the face; ``face`` (N,): middles of the slices
    - ``position`` (M, N): where on the path each slice is; ``force`` (T, M, N): along the line of action
    - ``distribution``: the solved contact problems of elastic teeth, None of others
    """

    pair: GearPair
    sharing: Sharing
    conditions: MeshConditions
    torque: np.ndarray
    middle: np.ndarray
    face: np.ndarray
    position: np.ndarray
    force: np.ndarray
    distribution: LoadDistribution | None

    @property
    def base_force(self) -> np.ndarray:
        """T1/r_b1 (T,), N."""
        return self.torque / self.pair.base_radius[0]

    @property
    def roll_angle(self) -> np.ndarray:
        """Roll angle of the pinion at the middle of the face (M,), rad."""
        return self.middle / self.pair.base_radius[0]

    @property
    def load_share(self) -> np.ndarray:
        """Load of the tooth pair over T1/r_b1 (T, M)."""
        return self.force.sum(axis=2) / self.base_force[:, None]

    @property
    def line_load(self) -> np.ndarray:
        """Normal force per length of contact line (T, M, N), N/m: the transverse force per face width."""
        return self.force * self.face.size / self.pair.face_width

    @property
    def on_path(self) -> np.ndarray:
        """Whether a slice lies on the path of contact (M, N)."""
        rounding = 1e-8 * self.pair.base_pitch
        low, high = self.pair.path_start - rounding, self.pair.path_end + rounding
        return (self.position >= low) & (self.position <= high)

    @cached_property
    def pressure(self) -> np.ndarray:
        """Largest Hertz pressure (T, M, N), Pa; beyond the path, with the curvature of its end."""
        inside = np.clip(self.position, self.pair.path_start, self.pair.path_end)
        length = self.pair.line_of_action_length
        radius = inside * (length - inside) / (length * math.cos(self.pair.base_helix_angle))
        # A base tangent point, where a path may end, has no curvature to carry a load.
        return line_hertz_pressure(self.line_load, np.maximum(radius, 1e-9), np.array(self.pair.reduced_modulus))

    @property
    def sliding(self) -> np.ndarray:
        """Sliding speed over the speed of the base circle (M, N), positive where the pinion's flank is faster."""
        return self._sliding_at(self.position)

    def _sliding_at(self, position: np.ndarray) -> np.ndarray:
        other = self.pair.line_of_action_length - position
        return (position - other / self.pair.teeth_ratio) / self.pair.base_radius[0]

    @cached_property
    def face_load(self) -> np.ndarray:
        """Load per face width of all tooth pairs together, mean over the mesh (T, N), N/m."""
        every = self.distribution
        cycle = self.force.sum(axis=1) if every is None else every.force.sum(axis=(1, 2))
        mean = cycle / cycle.sum(axis=1, keepdims=True) * self.base_force[:, None]
        return mean * self.face.size / self.pair.face_width

    @property
    def face_load_factor(self) -> np.ndarray:
        """Largest over mean load per face width (T,)."""
        return self.face_load.max(axis=1) / self.face_load.mean(axis=1)

    @cached_property
    def loss_factor(self) -> np.ndarray:
        """Loss factor of the local load, H_VL (T,); with edge contact or pitch deviations, of the solved positions."""
        if self.conditions.ideal or self.distribution is None:
            return local_loss_factor(mesh(self.pair, self.sharing, slices=self.conditions.slices), self.torque)
        sliding = np.abs(self._sliding_at(self.distribution.position))
        carried = (self.distribution.force * sliding).sum(axis=(2, 3)).mean(axis=1) / self.base_force
        return carried / math.cos(self.pair.base_helix_angle)

    @property
    def pattern(self) -> np.ndarray:
        """Share of the flank's path and face that carries load (T,)."""
        return (self.force > 0)[:, self.on_path].mean(axis=1)

    @property
    def beyond_path(self) -> np.ndarray:
        """Share of the load on tip edges beyond the path of contact (T,)."""
        return np.where(self.on_path, 0.0, self.force).sum(axis=(1, 2)) / self.force.sum(axis=(1, 2))


def tooth_contact(
    pair: GearPair, sharing: Sharing, torque: np.ndarray, conditions: MeshConditions | None = None
) -> ToothContact:
    """Loaded contact of a pair at torques on the pinion (N m).

    >>> from mixedlub.gear import RigidSharing
    >>> hong = GearPair((17, 26), 25.4e-3 / 6, math.radians(22.5), 14e-3)
    >>> tooth_contact(hong, RigidSharing(), np.array([100.0])).load_share.max().round(9)
    np.float64(1.0)
    """
    conditions = MeshConditions() if conditions is None else conditions
    if isinstance(sharing, LdpSharing):
        return _elastic(pair, sharing, torque, conditions)
    for name, given in (
        ("edge_contact", conditions.edge_contact),
        ("pitch_deviation_um", any(conditions.pitch_deviation)),
    ):
        if given:
            raise InputError('acts only with load_sharing = { model = "ldp" }', where=f"mesh.{name}")
    return _shared(pair, sharing, torque, conditions)


def _elastic(pair: GearPair, sharing: LdpSharing, torque: np.ndarray, conditions: MeshConditions) -> ToothContact:
    """Contact of elastic teeth: passage of the first tooth pair, assembled from the contact problems."""
    solved = transmission_error(
        pair,
        sharing,
        torque,
        phases=conditions.positions,
        slices=conditions.slices,
        edge_contact=conditions.edge_contact,
        pitch_deviation=conditions.pitch_deviation,
    )
    pairs, count = solved.position.shape[1], len(conditions.pitch_deviation)
    # In base pitch number c, the first tooth pair is the one that is c base pitches on, and again whole lists later.
    blocks = [
        slice(number % count * conditions.positions, (number % count + 1) * conditions.positions)
        for number in range(pairs)
    ]
    position = np.concatenate([solved.position[block, number] for number, block in enumerate(blocks)])
    force = np.concatenate([solved.force[:, block, number] for number, block in enumerate(blocks)], axis=1)
    middle = position[:, 0] + (pair.face_width / 2 - solved.face[0]) * math.tan(abs(pair.base_helix_angle))
    beyond = pair.base_pitch * (REACH if conditions.edge_contact else 1e-8)
    kept = ((position >= pair.path_start - beyond) & (position <= pair.path_end + beyond)).any(axis=1)
    return ToothContact(
        pair, sharing, conditions, torque, middle[kept], solved.face, position[kept], force[:, kept], solved
    )


def _shared(pair: GearPair, sharing: Sharing, torque: np.ndarray, conditions: MeshConditions) -> ToothContact:
    """Contact of tabulated or rigid teeth: share of each slice along the passage of the pair."""
    slices = conditions.slices or (sharing.default_slices(pair) if pair.helix_angle == 0 else FINE)
    start, end = mid_face_path(pair)
    step = pair.base_pitch / conditions.positions
    middle = start + step * (np.arange(math.ceil((end - start) / step - 1e-9)) + 0.5)
    middle = middle[middle <= end]
    across = (np.arange(slices) + 0.5) / slices
    position = middle[:, None] + (across - 0.5) * rise(pair)
    share = np.zeros((torque.size, *position.shape))
    for index in range(slices):
        on = (position[:, index] >= pair.path_start) & (position[:, index] <= pair.path_end)
        if not on.any():
            continue
        points = at_roll_angle(pair, sharing, position[on, index] / pair.base_radius[0], slices=slices)
        share[:, on, index] = points.load_share(torque).reshape(torque.size, -1, slices)[..., index]
    force = share * (torque / pair.base_radius[0])[:, None, None]
    face = across * pair.face_width
    return ToothContact(pair, sharing, conditions, torque, middle, face, position, force, None)
