r"""Film and asperities that share the load of a line contact, after Johnson, Greenwood and Poon.

The film carries the share :math:`1/\gamma` of the load. It then is as thick as in a smooth contact with
:math:`w/\gamma` for the load and :math:`E'/\gamma` for the modulus, which has the same width. The asperities carry
the rest; `mixedlub.base_model.balanced` finds the film at which both add up.
"""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.laws.film import ELASTIC


def full_load_film(film_thickness: np.ndarray) -> np.ndarray:
    """Film thickness if the film carried the whole load (m): that of the film law and of the effects on it.

    >>> full_load_film(2e-7)
    2e-07
    """
    return film_thickness


def film_load_share(film_thickness: np.ndarray, full_load_film: np.ndarray, sharing_exponent: np.ndarray) -> np.ndarray:
    r"""Share of the load that a film of this thickness carries (-), :math:`1/\gamma = (h/h_0)^{-1/k}`.

    Source: K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91.

    >>> round(float(film_load_share(2.0**0.13, 1.0, 0.13)), 12)
    0.5
    """
    return (film_thickness / full_load_film) ** (-1.0 / sharing_exponent)


def least_film_share(
    moes_load: np.ndarray,
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Share of the load below which the film's own contact leaves the regime that film laws are for (-).

    .. math:: \max\left[\left(\frac{2.05}{1.65}\,M^{-3/40} L^{-3/4}\right)^{5/3},\ \left(\frac{M_0}{M}\right)^2\right]

    of Moes' groups :math:`M = W(2U)^{-1/2}` and :math:`L = G(2U)^{1/4}` at the whole load, which become
    :math:`\gamma^{-1/2} M` and :math:`\gamma^{-3/4} L`. Below the first share the isoviscous elastic film
    :math:`2.05\,M^{-1/5}` is thicker than the piezoviscous one, :math:`1.65\,M^{-1/8} L^{3/4}`; below the second the
    film flattens nothing, with the limit :math:`M_0` of the film laws. Above 1 this holds at the whole load.
    Source: H. Moes, Wear 159 (1992) 57, the elastic asymptotes.

    >>> gear = (8.3262e-3, 2.1630, 0.01489, 14.81e-9, 226.374e9)
    >>> [round(float(least_film_share(load, *gear)), 4) for load in (19.5, 4.0)]
    [0.0724, 0.25]
    """
    material = pressure_viscosity * reduced_modulus
    material = material * power(2.0 * viscosity * entrainment_speed / (reduced_modulus * radius), 0.25)
    isoviscous = power(2.05 / 1.65 * power(moes_load, -0.075) * power(material, -0.75), 5.0 / 3.0)
    return np.maximum(isoviscous, (ELASTIC["moes_load"][0] / moes_load) ** 2)
