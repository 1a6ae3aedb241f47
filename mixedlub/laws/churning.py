"""Power of a gear wheel that dips into oil: the laws beside that of `drag`."""

from __future__ import annotations

import numpy as np

from mixedlub.laws.drag import GRAVITY, wetted_area

LOW, HIGH = 750.0, 1250.0
"""Accelerations (m/s^2) below and above which one of the two laws of Changenet and Velex holds alone."""


def churning_at_high_speed(
    wheel_radius: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    wheel_teeth: np.ndarray,
    oil_density: np.ndarray,
    immersion_ratio: np.ndarray,
    volume_ratio: np.ndarray,
) -> np.ndarray:
    r"""Power of one wheel that dips into oil (W), at high centrifugal acceleration, whatever the viscosity.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad
              C_m = 3.644\left(\tfrac hD\right)^{0.1}\left(\tfrac{V_0}{D^3}\right)^{-0.35} Fr^{-0.88}
              \left(\tfrac bD\right)^{0.85}

    The acceleration of gravity makes the form belong to m/s^2.
    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; constants as quoted in reviews.

    >>> speed = np.array([1000.0, 2000.0, 3000.0, 5000.0]) * np.pi / 30
    >>> churning_at_high_speed(0.05, speed, 0.02, 4e-3, 25.0, 850.0, 0.5, 1.5).round().tolist()
    [10.0, 24.0, 40.0, 76.0]
    """
    froude = np.maximum(wheel_speed, 1e-9) ** 2 * wheel_radius / GRAVITY
    slim = (face_width / (2.0 * wheel_radius)) ** 0.85
    drag = 3.644 * (0.5 * immersion_ratio) ** 0.1 * volume_ratio**-0.35 * froude**-0.88 * slim
    area = wetted_area(wheel_radius, face_width, gear_module, wheel_teeth, immersion_ratio)
    return 0.5 * oil_density * wheel_speed**3 * wheel_radius**3 * area * drag


def churning_boness(
    wheel_radius: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    immersion_ratio: np.ndarray,
) -> np.ndarray:
    r"""Power of a disc that dips into oil (W): laminar, turbulent, and beyond.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad C_m = \frac{20}{Re},\ 8.6\times10^{-4} Re^{1/3},\
              \frac{5\times10^8}{Re^2},\quad Re = \frac{\omega R\,\ell}{\nu}

    for Re below 2000, to 1e5, and above; the length l is that of the chord at the oil level, S_m has no teeth.
    Source: R. J. Boness, Proc. Int. Symp. Gearing 1989; constants as quoted in reviews.

    >>> wheel = dict(wheel_radius=0.108, face_width=0.0245, oil_density=850.0, immersion_ratio=54 / 108)
    >>> torque = churning_boness(wheel_speed=150 * np.pi, viscosity=160e-6 * 850, **wheel) / (150 * np.pi)
    >>> round(float(torque))   # Luke and Olver: 75 N m
    79
    """
    chord = 2.0 * wheel_radius * np.sqrt(immersion_ratio * (2.0 - immersion_ratio))
    reynolds = np.maximum(wheel_speed, 1e-9) * wheel_radius * chord * oil_density / viscosity
    turbulent = np.where(reynolds < 1e5, 8.6e-4 * reynolds ** (1.0 / 3.0), 5e8 / reynolds**2)
    drag = np.where(reynolds < 2000.0, 20.0 / reynolds, turbulent)
    area = wetted_area(wheel_radius, face_width, 0.0, 0.0, immersion_ratio)
    return 0.5 * oil_density * wheel_speed**3 * wheel_radius**3 * area * drag


def churning_iso_tr_14179_1(
    outside_diameter: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    transverse_module: np.ndarray,
    helix_angle: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    dip_factor: float,
    arrangement: float = 0.2,
) -> np.ndarray:
    r"""Power of one wheel that dips into oil (W): its two sides and its teeth.

    .. math:: P = \frac{f_g\nu n^3 D^{4.7}}{10^{23} A_g}\left(1.474\,D + 7.37\,b\,
              \frac{R_f}{\sqrt{\tan\beta}}\right),\quad R_f = 7.93 - \frac{4.648}{m_t}

    with nu in mm^2/s, n in rpm, D, b, m_t in mm, beta from 10 degrees on; f_g is 0 of a free wheel and 1 of one in oil.
    Its constants make the form belong to SI. Source: ISO/TR 14179-1, gear churning; constants as quoted in reviews.

    >>> wheel = dict(face_width=0.02, transverse_module=4e-3, helix_angle=0.0, viscosity=50e-6 * 850, oil_density=850.0)
    >>> speed = np.array([1000.0, 2000.0, 3000.0]) * np.pi / 30
    >>> churning_iso_tr_14179_1(0.1, speed, **wheel, dip_factor=0.25).round().tolist()
    [4.0, 32.0, 107.0]
    """
    speed, outside, nu = wheel_speed * 30.0 / np.pi, outside_diameter * 1e3, viscosity / oil_density * 1e6
    rough = 7.93 - 4.648 / (transverse_module * 1e3)
    teeth = 7.37 * face_width * 1e3 * rough / np.sqrt(np.tan(np.maximum(helix_angle, np.radians(10.0))))
    return dip_factor * nu * speed**3 * outside**4.7 / (1e23 * arrangement) * (1.474 * outside + teeth)
