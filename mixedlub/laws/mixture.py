"""Friction of film and asperities together."""

from __future__ import annotations

import numpy as np


def fluid_friction(shear_stress: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the film (-), :math:`\mu_E = \tau / p_0`.

    Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 2, with the largest Hertz pressure.

    >>> round(float(fluid_friction(22.57e6, 0.9437e9)), 5)
    0.02392
    """
    return shear_stress / hertz_pressure


def tallian_friction(fluid_friction: np.ndarray, boundary_friction: np.ndarray, area_ratio: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the contact (-), :math:`\mu = \mu_E (1 - P_B) + \mu_B P_B`.

    Source: T. E. Tallian, Wear 21 (1972) 49; Hong, Aneshansley, Talbot, Gear Technology, eq. 1.

    >>> round(float(tallian_friction(0.02392, 0.1, 0.16309)), 5)
    0.03633
    """
    return fluid_friction + (boundary_friction - fluid_friction) * area_ratio
