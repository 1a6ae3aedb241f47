"""Load shared by rigid teeth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.gear.contact_lines import contact_limits, contact_line_length
from mixedlub.gear.geometry import GearPair
from mixedlub.gear.mesh import Mesh
from mixedlub.gear.sharing.model import SharingModel
from mixedlub.schema.findings import Finding


@dataclass(frozen=True)
class RigidSharing:
    """Rigid, perfect teeth: the same load on every length of contact line.

    Spur gears: each of the pairs in contact carries an equal share. Helical gears: the force is spread evenly
    over the total length of the contact lines, which changes as the teeth roll through the mesh.
    """

    def default_slices(self, pair: GearPair) -> int:
        """One for spur gears; the oblique lines of helical gears need several."""
        return 1 if pair.helix_angle == 0 else 16

    def check(self, pair: GearPair) -> tuple[Finding, ...]:
        """No findings: valid for every gear pair."""
        return ()

    def breakpoints(self, pair: GearPair) -> np.ndarray:
        """Positions where the number of pairs in contact changes."""
        return contact_limits(pair)

    def load_share(self, mesh: Mesh, torque: np.ndarray) -> np.ndarray:
        """Length of each slice's line over the total length, independent of torque."""
        pair = mesh.pair
        front = mesh.position - mesh.face_position * np.tan(abs(pair.base_helix_angle))
        line = mesh.face_fraction * pair.face_width / np.cos(pair.base_helix_angle)
        share = line / contact_line_length(pair, front)
        return np.broadcast_to(share, np.shape(torque) + share.shape).copy()


MODEL = SharingModel(
    name="rigid", meaning="equal shares of the pairs in contact", build=lambda section, folder: RigidSharing()
)
