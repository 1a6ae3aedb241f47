"""Parts of SKF's model of the frictional moment of rolling bearings."""

from __future__ import annotations

import numpy as np

from mixedlub.laws.drag import bearing_asperity_share, oil_motion


def skf_rolling_torque(
    rolling_variable: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    shaft_speed: np.ndarray,
    bore_diameter: np.ndarray,
    outside_diameter: np.ndarray,
    replenishment: float,
    geometry: float,
) -> np.ndarray:
    r"""Rolling frictional moment (N m).

    .. math:: M_{rr} = \phi_{ish}\,\phi_{rs}\,G_{rr}(\nu n)^{0.6},\quad
              \phi_{ish} = \frac{1}{1 + 1.84\times10^{-9}(n d_m)^{1.28}\nu^{0.64}},\quad
              \phi_{rs} = \exp\left[-K_{rs}\,\nu n (d + D)\sqrt{\frac{K_z}{2(D - d)}}\right]

    with n in rpm, nu in mm^2/s, lengths in mm and M in N mm; `rolling_variable` is G_rr. Its constants make the form
    belong to SI. Source: SKF, Rolling Bearings, 2018, model of the frictional moment.

    >>> oil = dict(viscosity=20e-6 * 850, oil_density=850.0, shaft_speed=1000 * np.pi / 30)
    >>> size = dict(bore_diameter=0.035, outside_diameter=0.072, replenishment=3e-8, geometry=3.1)
    >>> round(float(skf_rolling_torque(0.07183, **oil, **size)) * 1e3, 1)   # by a public program
    26.6
    """
    motion = oil_motion(viscosity, oil_density, shaft_speed)
    speed = np.abs(shaft_speed) * 30.0 / np.pi
    bore, outside, nu = bore_diameter * 1e3, outside_diameter * 1e3, viscosity / oil_density * 1e6
    heating = 1.0 / (1.0 + 1.84e-9 * (speed * 0.5 * (bore + outside)) ** 1.28 * nu**0.64)
    starved = np.exp(-replenishment * motion * (bore + outside) * np.sqrt(geometry / (2.0 * (outside - bore))))
    return heating * starved * rolling_variable * motion**0.6 * 1e-3


def skf_sliding_friction(
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    shaft_speed: np.ndarray,
    mean_diameter: np.ndarray,
    boundary_friction: float,
    film_friction: float,
) -> np.ndarray:
    r"""Sliding friction of a rolling bearing (-), :math:`\mu_{sl} = \phi_{bl}\mu_{bl} + (1 - \phi_{bl})\mu_{EHL}`.

    Source: SKF, Rolling Bearings, 2018, model of the frictional moment.

    >>> float(skf_sliding_friction(0.01, 850.0, 0.0, 0.045, 0.12, 0.05))   # at rest: no film
    0.12
    """
    share = bearing_asperity_share(viscosity, oil_density, shaft_speed, mean_diameter)
    return share * boundary_friction + (1.0 - share) * film_friction
