"""The mixture of film and boundary friction of the base model."""

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.laws.mixture import tallian_friction


@friction_law("Tallian mixture", "contact", sources=2, status="base model; film and asperities are computed")
def tallian_mixture(fluid_friction: np.ndarray, boundary_friction: np.ndarray, area_ratio: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the base model (-), film and asperities weighted.

    .. math:: \mu = \mu_E (1 - P_B) + \mu_B P_B

    The options of a study choose film, viscosity under pressure, shear and mixture.

    Source: T. E. Tallian, Wear 21 (1972) 49; Hong, Aneshansley, Talbot, Gear Technology, eq. 1.

    >>> round(float(tallian_mixture(0.02392, 0.1, 0.16309)), 5)
    0.03633
    """
    return tallian_friction(fluid_friction, boundary_friction, area_ratio)
