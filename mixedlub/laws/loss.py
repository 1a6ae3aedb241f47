"""From friction to power."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.slots import SLIDING_POWER


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


def friction_line_load(friction: np.ndarray, line_load: np.ndarray) -> np.ndarray:
    r"""Friction force per width of the contact (N/m), :math:`w_f = \mu w`, against the sliding.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, eq. 2.13.

    >>> float(friction_line_load(0.05, 2e5))
    10000.0
    """
    return friction * line_load


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

    >>> round(float(mean_friction(np.array([100.0]), np.array([500.0, 1000.0, 500.0]))[0]), 9)
    0.05
    """
    return mesh_loss / sliding_power.sum(axis=-1, keepdims=True)


def sliding_integral(
    load_share: np.ndarray, transmitted_force: np.ndarray, sliding_speed: np.ndarray, path_weight: np.ndarray
) -> np.ndarray:
    r"""Load times sliding speed, mean over a mesh cycle (W), :math:`\sum F |v_s|\, dx / p_{bt}`.

    The last axis, the path, shrinks to one.

    >>> float(sliding_integral(np.ones(3), 1000.0, 2.0, np.array([0.25, 0.5, 0.25]))[0])
    2000.0
    """
    return sliding_power(load_share, transmitted_force, sliding_speed, path_weight).sum(axis=-1, keepdims=True)


def friction_of_path(
    friction: np.ndarray,
    load_share: np.ndarray,
    transmitted_force: np.ndarray,
    sliding_speed: np.ndarray,
    path_weight: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of the mesh (-), whatever averages the power loss follows.

    .. math:: \hat\mu = \frac{\sum \mu\, F |v_s|\, dx}{\sum F |v_s|\, dx}

    >>> path = (np.ones(3), 1000.0, np.array([2.0, 0.0, 1.0]), np.array([0.25, 0.5, 0.25]))
    >>> round(float(friction_of_path(np.array([0.06, 0.01, 0.03]), *path)[0]), 3)
    0.05
    """
    power = sliding_power(load_share, transmitted_force, sliding_speed, path_weight)
    return mean_friction(mesh_loss(friction, power), power)


def load_loss_factor(sliding_integral: np.ndarray, torque: np.ndarray, pinion_speed: np.ndarray) -> np.ndarray:
    r"""Tooth loss factor of the load sharing at hand (-), :math:`H_{VL} = \sum F |v_s|\, dx / (p_{bt}\, T_1 \omega_1)`.

    With it the loss of the mesh is input power times mean friction times this factor. The divisor is the base pitch,
    so that rigid teeth which share the load equally have Ohlendorf's factor.
    Source: A. Wimmer, thesis, TU Munich, 2006, the local loss factor.

    >>> round(float(load_loss_factor(3063.0, 100.0, 157.1)), 3)
    0.195
    """
    return sliding_integral / (torque * pinion_speed)


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

    >>> round(float(rolling_loss(np.full(2, 10.0), np.full(2, 3.0), 0.01, np.array([0.5, 0.5]))[0]), 9)
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

    >>> round(float(tangential_friction(0.05, 100.0, 2e5)), 9)
    0.0505
    """
    return friction + rolling_force / line_load
