"""Friction of a whole drive, as its motor feels it."""

from __future__ import annotations

import numpy as np


def coulomb_viscous(
    coulomb_torque: np.ndarray, viscous_torque: np.ndarray, drive_speed: np.ndarray, reference_speed: np.ndarray
) -> np.ndarray:
    r"""Friction torque of the moving parts (N m), dry friction plus a part that grows with speed.

    .. math:: T_r = T_c \operatorname{sgn}\omega + T_v\,\omega/\omega_0

    Source: B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083, section 2.1.

    >>> coulomb_viscous(2.0, 1.0, np.array([-10.0, 0.0, 20.0]), 20.0).tolist()
    [-2.5, 0.0, 3.0]
    """
    return coulomb_torque * np.sign(drive_speed) + viscous_torque * (drive_speed / reference_speed)


def motor_friction(running_friction: np.ndarray, payload_torque: np.ndarray, gears_fitted: np.ndarray) -> np.ndarray:
    """What the motor has to overcome at steady speed (N m): friction of the parts that are fitted, and the payload.

    >>> motor_friction(np.array([2.5, 2.5]), 0.5, np.array([1.0, 0.0])).tolist()
    [3.0, 0.5]
    """
    return running_friction * gears_fitted + payload_torque
