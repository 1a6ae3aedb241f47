"""Speed, curvature and load at the pitch point, which friction laws for the whole mesh read."""

from __future__ import annotations

import numpy as np


def pitch_line_speed(pinion_speed: np.ndarray, pinion_radius: float) -> np.ndarray:
    r"""Circumferential speed at the operating pitch circle (m/s), :math:`v_t = \omega_1 r_{w1}`.

    >>> round(float(pitch_line_speed(8.3 / 0.0366, 0.0366)), 1)
    8.3
    """
    return pinion_speed * pinion_radius


def pitch_entrainment_speed(pitch_line_speed: np.ndarray, working_pressure_angle: float) -> np.ndarray:
    r"""Mean surface speed at the pitch point (m/s), :math:`u_C = v_t\sin\alpha_w`, half of the sum speed.

    >>> round(2 * float(pitch_entrainment_speed(8.3, np.radians(22.438))), 3)   # test gear FZG C
    6.336
    """
    return pitch_line_speed * np.sin(working_pressure_angle)


def pitch_radius(
    pinion_radius: float, gear_radius: float, working_pressure_angle: float, base_helix_angle: float
) -> float:
    r"""Reduced radius of curvature at the pitch point (m), normal to the flank.

    .. math:: \rho_C = \frac{r_{w1} r_{w2}}{r_{w1} + r_{w2}}\,\frac{\sin\alpha_w}{\cos\beta_b}

    >>> round(float(pitch_radius(0.0366, 0.0549, np.radians(22.438), 0.0)) * 1e3, 2)   # test gear FZG C
    8.38
    """
    both = pinion_radius * gear_radius / (pinion_radius + gear_radius)
    return float(both * np.sin(working_pressure_angle) / np.cos(base_helix_angle))


def mesh_line_load(transmitted_force: np.ndarray, face_width: float) -> np.ndarray:
    r"""Force at the base circle over face width (N/m), :math:`w_m = T_1/(r_{b1} b)`: that of a single pair.

    >>> round(float(mesh_line_load(183.4 / 33.829e-3, 14e-3)) / 1e3, 1)   # test gear FZG C
    387.2
    """
    return transmitted_force / face_width


def load_intensity(torque: np.ndarray, face_width: float, pinion_radius: float, gear_radius: float) -> np.ndarray:
    r"""Load intensity of the flanks (Pa), the K factor of the rating standards.

    .. math:: K = \frac{T_1}{2 b\, r_{w1}^2}\,\frac{z_1 + z_2}{z_2} = \frac{F_t}{b\,d_{w1}}\,\frac{u + 1}{u}

    >>> round(float(load_intensity(183.4, 14e-3, 36.6e-3, 54.9e-3)) / 1e6, 2)   # test gear FZG C
    8.15
    """
    return torque / (2.0 * face_width * pinion_radius**2) * (1.0 + pinion_radius / gear_radius)
