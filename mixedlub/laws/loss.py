"""From friction to power."""

from __future__ import annotations

import numpy as np

from mixedlub.slots import SLIDING_POWER


@SLIDING_POWER.offers(
    "mesh_integral", "power loss by the integral of friction times load times sliding speed over the path"
)
def sliding_power(
    load_share: np.ndarray, transmitted_force: np.ndarray, sliding_speed: np.ndarray, path_weight: np.ndarray
) -> np.ndarray:
    r"""Load times sliding speed of each point of the path with its part of the path (W).

    .. math:: F\, |v_s|\, dx / p_{bt},\quad F = s\, T_1 / r_{b1}

    ``path_weight`` carries dx/p_bt.

    Source: A. Arana, J. Larranaga, I. Ulacia, Proc. IMechE J 233 (2019) 303, eq. 29.

    >>> sliding_power(np.ones(3), 1000.0, 2.0, np.array([0.25, 0.5, 0.25])).tolist()
    [500.0, 1000.0, 500.0]
    """
    return load_share * transmitted_force * sliding_speed * path_weight


@SLIDING_POWER.offers("paper", "power loss by the paper's separate averages, its eq. 3 and 4")
def averaged_sliding_power(
    mean_weight: np.ndarray, mean_sliding_speed: np.ndarray, transmitted_force: np.ndarray
) -> np.ndarray:
    r"""Force at the base circle times mean sliding speed, spread evenly over the path (W).

    The mesh loss is then :math:`P = \hat\mu\, \hat V_s\, F_m`: the plain mean of friction over the path, a quarter of
    the sum of the sliding speeds at its two ends, and the force at the base circle.
    Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 3 and 4.

    >>> averaged_sliding_power(np.array([0.25, 0.5, 0.25]), 2.0, 1000.0).tolist()
    [500.0, 1000.0, 500.0]
    """
    return mean_weight * (mean_sliding_speed * transmitted_force)


def mesh_loss(friction: np.ndarray, sliding_power: np.ndarray) -> np.ndarray:
    r"""Sliding power lost in the mesh, mean over a mesh cycle (W), :math:`P_m = \sum \mu\, F |v_s|\, dx / p_{bt}`.

    The last axis, the path, shrinks to one.

    >>> float(mesh_loss(np.full((1, 3), 0.05), np.array([[500.0, 1000.0, 500.0]]))[0, 0])
    100.0
    """
    return over_path(friction, sliding_power)


def mean_friction(mesh_loss: np.ndarray, sliding_power: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the mesh (-): sliding loss over load times sliding speed, both over the path.

    .. math:: \hat\mu = \frac{P_m}{\sum F |v_s|\, dx / p_{bt}}

    >>> float(mean_friction(np.array([100.0]), np.array([500.0, 1000.0, 500.0]))[0])
    0.05
    """
    return mesh_loss / sliding_power.sum(axis=-1, keepdims=True)


def over_path(value: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Sum of value times weight over the last axis, kept with length one; the product is never formed.

    >>> over_path(np.array([1.0, 3.0]), np.array([0.5, 0.25])).tolist()
    [1.25]
    """
    return np.einsum("...m,...m->...", value, weight)[..., None]


def rolling_loss(
    rolling_force: np.ndarray,
    entrainment_speed: np.ndarray,
    contact_width: np.ndarray,
    path_weight: np.ndarray,
) -> np.ndarray:
    r"""Rolling power lost in the mesh, mean over a mesh cycle (W), :math:`\frac{1}{p_{bt}}\int f_r\, b\, 2u\, dx`.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, section 2.2, in the power form.

    >>> float(rolling_loss(np.full(2, 10.0), np.full(2, 3.0), 0.01, np.array([0.5, 0.5]))[0])
    0.6
    """
    return over_path(rolling_force * entrainment_speed, 2.0 * contact_width * path_weight)


def power_loss(mesh_loss: np.ndarray, rolling_loss: np.ndarray) -> np.ndarray:
    """Total power loss (W): sliding and rolling in the mesh.

    >>> float(power_loss(100.0, 2.0))
    102.0
    """
    return mesh_loss + rolling_loss


def tangential_friction(friction: np.ndarray, rolling_force: np.ndarray, line_load: np.ndarray) -> np.ndarray:
    """Tangential over normal force on a body (-), what a traction rig weighs.

    >>> float(tangential_friction(0.05, 100.0, 2e5))
    0.0505
    """
    return friction + rolling_force / line_load
