"""Churning of a disc in oil after Boness."""

import numpy as np

from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import wetted_area


@part_law(
    "churning",
    "boness",
    "Boness",
    sources=1,
    status="constants as quoted in reviews; the torque that Luke and Olver print for this law is met",
)
def churning_boness(
    wheel_radius: np.ndarray,
    shaft_speed: np.ndarray,
    face_width: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    immersion: np.ndarray,
) -> np.ndarray:
    r"""Power of a wheel, taken as a disc, that dips into oil (W): laminar, turbulent and beyond.

    .. math:: P = \tfrac12\rho\omega^3R^3 S_m C_m,\quad C_m = \frac{20}{Re},\ 8.6\times10^{-4} Re^{1/3},\
              \frac{5\times10^8}{Re^2}

    for Re below 2000, to 1e5, and above.

    Source: R. J. Boness, Proc. Int. Symp. Gearing, 1989.

    >>> torque = churning_boness(0.108, 150 * np.pi, 0.0245, 160e-6 * 850, 850.0, 0.054) / (150 * np.pi)
    >>> round(float(torque))
    79
    """
    depth = immersion / wheel_radius
    chord = 2.0 * wheel_radius * np.sqrt(depth * (2.0 - depth))
    reynolds = np.maximum(shaft_speed, 1e-9) * wheel_radius * chord * oil_density / viscosity
    turbulent = np.where(reynolds < 1e5, 8.6e-4 * reynolds ** (1.0 / 3.0), 5e8 / reynolds**2)
    drag = np.where(reynolds < 2000.0, 20.0 / reynolds, turbulent)
    area = wetted_area(wheel_radius, face_width, 0.0, 0.0, depth)
    return 0.5 * oil_density * shaft_speed**3 * wheel_radius**3 * area * drag
