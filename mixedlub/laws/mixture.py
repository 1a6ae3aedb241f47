"""Friction of film and asperities together."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.slots import FILM_FRICTION, MIXTURE
from mixedlub.laws.contact import mean_hertz_pressure


@FILM_FRICTION.offers("maximum", "film friction is shear stress over the largest Hertz pressure")
def fluid_friction(shear_stress: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the film (-), :math:`\mu_E = \tau / p_0`.

    Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 2, with the largest Hertz pressure.

    >>> round(float(fluid_friction(22.57e6, 0.9437e9)), 5)
    0.02392
    """
    return shear_stress / hertz_pressure


@FILM_FRICTION.offers("mean", "film friction is shear stress over the mean Hertz pressure")
def fluid_friction_at_mean_pressure(shear_stress: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the film (-), :math:`\mu_E = \tau / p_m`, with the mean Hertz pressure.

    A second reading of the contact pressure. Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 2.

    >>> round(float(fluid_friction_at_mean_pressure(22.57e6, 0.9437e9)), 5)
    0.03045
    """
    return shear_stress / mean_hertz_pressure(hertz_pressure)


@MIXTURE.offers("tallian", "film and asperity friction weighted by the boundary area ratio, after Tallian")
def tallian_friction(fluid_friction: np.ndarray, boundary_friction: np.ndarray, area_ratio: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the contact (-), :math:`\mu = \mu_E (1 - P_B) + \mu_B P_B`.

    Source: T. E. Tallian, Wear 21 (1972) 49; Hong, Aneshansley, Talbot, Gear Technology, eq. 1.

    >>> round(float(tallian_friction(0.02392, 0.1, 0.16309)), 5)
    0.03633
    """
    return fluid_friction + (boundary_friction - fluid_friction) * area_ratio


@MIXTURE.offers("load_weighted", "film and asperity friction weighted by the load that each carries")
def load_weighted_friction(
    fluid_friction: np.ndarray, boundary_friction: np.ndarray, asperity_load_share: np.ndarray
) -> np.ndarray:
    r"""Friction coefficient of the contact (-), :math:`\mu = \mu_E (1 - L) + \mu_B L`.

    L is the share of the load that asperities carry. Meant for contacts in which film and asperities balance the load;
    under an imposed film L is often limited to 1.
    Source: E. R. M. Gelinck, D. J. Schipper, Tribol. Int. 33 (2000) 175, with the film friction of the whole load.

    >>> round(float(load_weighted_friction(0.0236, 0.1, 0.91)), 4)
    0.0931
    """
    return fluid_friction + (boundary_friction - fluid_friction) * asperity_load_share
