"""From friction to power."""

from __future__ import annotations

import numpy as np


def mesh_loss(
    friction: np.ndarray,
    load_share: np.ndarray,
    transmitted_force: np.ndarray,
    sliding_speed: np.ndarray,
    path_weight: np.ndarray,
) -> np.ndarray:
    r"""Sliding power lost in the mesh, mean over a mesh cycle (W); the last axis is the path and is summed.

    .. math:: P = \frac{1}{p_{bt}} \int_A^E \mu\, F\, |v_s|\, dx,\quad F = s\, T_1 / r_{b1}

    ``path_weight`` carries dx/p_bt. Source: A. Arana, J. Larranaga, I. Ulacia, Tribol. Int. 2019, eq. 29.

    >>> float(mesh_loss(np.full(3, 0.05), np.ones(3), 1000.0, np.full(3, 2.0), np.array([0.25, 0.5, 0.25])))
    100.0
    """
    if np.ndim(path_weight) == 1 and np.ndim(transmitted_force) and np.shape(transmitted_force)[-1] == 1:
        path = load_share * np.abs(sliding_speed) * path_weight
        return np.einsum("...m,...m->...", friction, path) * transmitted_force[..., 0]
    return np.sum(friction * load_share * transmitted_force * np.abs(sliding_speed) * path_weight, axis=-1)
