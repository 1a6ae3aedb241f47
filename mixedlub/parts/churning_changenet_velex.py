"""Churning of a wheel in oil after Changenet and Velex."""

import numpy as np

from mixedlub.chain.part_law import part_law
from mixedlub.chain.ranges import holds_within
from mixedlub.laws import drag


@holds_within({"bath_acceleration": (0.0, drag.SLOW_BATH)})
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
    slow = drag.churning_changenet_velex(*wheel, viscosity, oil_density, 0.21, 0.60, *ratios, helix_angle)
    fast = drag.churning_at_high_speed(*wheel, oil_density, *ratios, helix_angle)
    acceleration = drag.bath_acceleration(shaft_speed, wheel_radius, face_width, gear_module)
    return drag.churning_at_either_speed(slow, fast, acceleration)
