"""Load on the contact, and how fast its surfaces slide."""

from __future__ import annotations

import numpy as np

LEAST_SHARE = 1e-6
LIGHT = 0.1
"""Judgement. Line load over the largest of the flank up to which a contact point decides about no range of a law."""


def gear_line_load(load_share: np.ndarray, transmitted_force: np.ndarray, contact_width: np.ndarray) -> np.ndarray:
    r"""Normal force per length on one tooth contact (N/m), :math:`w = s\,T_1 / (r_{b1} b)` (spur).

    ``contact_width`` is the width that carries the share: the face, or one slice of it where a mesh is sliced
    (`gear.Mesh.contact_width`); with the whole face and the share of one slice, the result is too small.

    A point that carries nothing (relief, edge of a misaligned flank) is given a millionth of the force, so that
    its film and friction stay finite; its share in any sum of forces or power is still zero.

    >>> round(float(gear_line_load(1.0, 100.0 / 33.245e-3, 14e-3)) / 1e3, 1)
    214.9
    """
    return np.maximum(load_share, LEAST_SHARE) * (transmitted_force / contact_width)


def carries_load(line_load: np.ndarray) -> np.ndarray:
    """Whether contact points of a path carry enough for the ranges of laws to matter there; none does without load.

    Points with less than a tenth of the largest line load, as relief and misalignment leave at ends and edges, carry
    hardly any of the loss.

    >>> carries_load(np.array([[1e-15, 9.0, 11.0, 100.0], [0.0, 0.0, 0.0, 0.0]])).tolist()
    [[False, False, True, True], [False, False, False, False]]
    """
    return np.asarray((line_load >= LIGHT * np.max(line_load, axis=-1, keepdims=True)) & (line_load > 0.0))


def disc_line_load(load: np.ndarray, contact_width: np.ndarray) -> np.ndarray:
    r"""Normal force per length on a line contact (N/m), :math:`w = F/b`.

    >>> float(disc_line_load(1200.0, 6e-3))
    200000.0
    """
    return load / contact_width


def slide_roll_ratio(sliding_speed: np.ndarray, entrainment_speed: np.ndarray) -> np.ndarray:
    r"""Sliding over mean speed (-), :math:`S = |v_s| / u`.

    >>> float(slide_roll_ratio(0.5, 1.0))
    0.5
    """
    return sliding_speed / entrainment_speed


def rolling_force(entrainment_speed: np.ndarray) -> np.ndarray:
    """Resistance to rolling (N/m): none in the base model.

    >>> float(rolling_force(2.0))
    0.0
    """
    return np.zeros(np.shape(entrainment_speed))
