"""Start and end of contact of tooth pairs, and the length of their contact lines."""

from __future__ import annotations

import math

import numpy as np

from mixedlub.gear.geometry import GearPair


def contact_limits(pair: GearPair) -> np.ndarray:
    """Positions where the number of pairs in contact changes: the ends shifted by whole base pitches."""
    shifts = pair.base_pitch * np.arange(int(pair.contact_ratio) + 1)
    limits = np.concatenate([pair.path_start + shifts, pair.path_end - shifts])
    return limits[(limits >= pair.path_start) & (limits <= pair.path_end)]


def rise(pair: GearPair) -> float:
    """Distance of the back of a contact line ahead of its front on the path, m; 0 for spur gears."""
    return pair.face_width * math.tan(abs(pair.base_helix_angle))


def mid_face_path(pair: GearPair) -> tuple[float, float]:
    """Positions (m) at the middle of the face between which any part of a tooth pair is in contact."""
    return pair.path_start - rise(pair) / 2, pair.path_end + rise(pair) / 2


def contact_line_length(pair: GearPair, position: np.ndarray) -> np.ndarray:
    """Total length (m) of the contact lines when one of them passes ``position`` (m) on the front face.

    Summed over the tooth pairs, each line x(y) = position + y tan(beta_b) cut off at the ends of the path;
    spur gears: face width times the number of pairs in contact. Any shape; exact.

    >>> spur = GearPair((17, 26), 4.2333333e-3, np.radians(22.5), 14e-3)
    >>> contact_line_length(spur, np.array([spur.path_start + 1e-4, spur.pitch_point])) / spur.face_width
    array([2., 1.])
    """
    further = rise(pair)
    phase = (np.asarray(position, dtype=float) - pair.path_start) % pair.base_pitch
    reach = int(np.ceil((pair.path_end - pair.path_start + further) / pair.base_pitch)) + 1
    front = phase[..., None] + pair.base_pitch * np.arange(-reach, reach + 1)
    length = pair.path_end - pair.path_start
    if further < 1e-9 * pair.base_pitch:
        inside = (front >= -1e-9 * length) & (front <= length * (1 + 1e-9))
        return pair.face_width * inside.sum(axis=-1)
    overlap = np.minimum(front + further, length) - np.maximum(front, 0)
    return np.clip(overlap, 0, None).sum(axis=-1) / np.sin(abs(pair.base_helix_angle))
