"""Churning of a wheel in oil after Changenet and Velex."""

import numpy as np

from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import GRAVITY, bath_acceleration, churning_changenet_velex, wetted_area

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
    helix_angle: float | np.ndarray = 0.0,
) -> np.ndarray:
    r"""Power of one wheel that dips into oil (W), at high centrifugal acceleration, whatever the viscosity.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad
              C_m = 3.644\left(\tfrac{h}{D}\right)^{0.1}\left(\tfrac{V_0}{D^3}\right)^{-0.35} Fr^{-0.88}
              \left(\tfrac{b}{D}\right)^{0.85}

    The acceleration of gravity makes the form belong to m/s^2.
    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; constants as quoted in reviews.

    >>> speed = np.array([1000.0, 2000.0, 3000.0, 5000.0]) * np.pi / 30
    >>> churning_at_high_speed(0.05, speed, 0.02, 4e-3, 25.0, 850.0, 0.5, 1.5).round().tolist()
    [10.0, 24.0, 40.0, 76.0]
    """
    froude = np.maximum(wheel_speed, 1e-9) ** 2 * wheel_radius / GRAVITY
    slim = (face_width / (2.0 * wheel_radius)) ** 0.85
    drag = 3.644 * (0.5 * immersion_ratio) ** 0.1 * volume_ratio**-0.35 * froude**-0.88 * slim
    area = wetted_area(wheel_radius, face_width, gear_module, wheel_teeth, immersion_ratio, helix_angle)
    return 0.5 * oil_density * wheel_speed**3 * wheel_radius**3 * area * drag


@part_law(
    "churning",
    "changenet_velex",
    "Changenet and Velex",
    sources=0,
    status="constants as quoted in reviews, not confirmed by the paper",
)
def churning_both(
    wheel_radius: np.ndarray,
    shaft_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    wheel_teeth: np.ndarray,
    helix_angle: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    immersion: np.ndarray,
    oil_volume: np.ndarray,
) -> np.ndarray:
    r"""Power of a wheel that dips into oil (W), by either law and between them.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad \gamma = \omega^2 (R\,b\,m_n)^{1/3}

    C_m of low speed for gamma below 750 m/s^2, of high speed above 1250 m/s^2, linear in gamma between.

    Source: C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128.

    >>> wheel = dict(face_width=0.02, gear_module=4e-3, wheel_teeth=25.0, helix_angle=0.0)
    >>> oil = dict(viscosity=50e-6 * 850, oil_density=850.0, immersion=0.025, oil_volume=1.5e-3)
    >>> speed = np.array([1000.0, 5000.0]) * np.pi / 30
    >>> churning_both(0.05, speed, **wheel, **oil).round(1).tolist()   # 5.8 by the first law, 76 by the second
    [5.8, 76.2]
    """
    ratios = immersion / wheel_radius, oil_volume / (2.0 * wheel_radius) ** 3
    wheel = (wheel_radius, shaft_speed, face_width, gear_module, wheel_teeth)
    slow = churning_changenet_velex(*wheel, viscosity, oil_density, 0.21, 0.60, *ratios, helix_angle)
    fast = churning_at_high_speed(*wheel, oil_density, *ratios, helix_angle)
    acceleration = bath_acceleration(shaft_speed, wheel_radius, face_width, gear_module)
    share = np.clip((acceleration - LOW) / (HIGH - LOW), 0.0, 1.0)
    return (1.0 - share) * slow + share * fast
