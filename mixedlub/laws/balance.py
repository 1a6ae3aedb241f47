r"""Film and asperities that share the load of a line contact, after Johnson, Greenwood and Poon.

The film carries the share :math:`1/\gamma` of the load. It then is as thick as in a smooth contact with
:math:`w/\gamma` for the load and :math:`E'/\gamma` for the modulus, which has the same width. The asperities carry
the rest; `mixedlub.base_model.balanced` finds the film at which both add up.
"""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.laws.film import ELASTIC

LEAST_ASPERITY_SHARE = 0.05
"""Judgement. Share of the load from which asperities decide about the film's own contact: its M is then 2.5 % less."""


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


def least_film_share(moes_load: np.ndarray, isoviscous_ratio: np.ndarray) -> np.ndarray:
    r"""Share of the load below which the film's own contact leaves the regime that film laws are for (-).

    .. math:: \max\left[q_{EI}^{5/3},\ (M_0/M)^2\right]

    with Moes' load M and the ratio q of the elastic films, isoviscous over piezoviscous, at the whole load: a film
    that carries the share :math:`1/\gamma` has :math:`\gamma^{-1/2} M` and :math:`\gamma^{3/5} q`. Below the first
    share the isoviscous film is the thicker one; below the second the film flattens nothing, with the limit
    :math:`M_0` of the film laws. Above 1 the law is outside its range at the whole load.

    >>> [round(float(least_film_share(load, 0.207)), 4) for load in (19.5, 4.0)]
    [0.0724, 0.25]
    """
    return np.maximum(power(isoviscous_ratio, 5.0 / 3.0), (ELASTIC["moes_load"][0] / moes_load) ** 2)


def share_lacking(film_load_share: np.ndarray, least_film_share: np.ndarray) -> np.ndarray:
    """Least share of a film over the one that it carries (-), where asperities carry enough to change its contact.

    Source: K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91: the film's own contact.

    >>> share_lacking(np.array([0.99, 0.5]), np.array([1.4, 1.4])).round(9).tolist()
    [0.0, 2.8]
    """
    return np.where(film_load_share > 1.0 - LEAST_ASPERITY_SHARE, 0.0, least_film_share / film_load_share)
