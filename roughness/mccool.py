r"""Summits of an isotropic Gaussian surface from the spectral moments of one of its profiles.

Moments are of angular frequency: m0 = <z^2> (m^2), m2 = <z'^2> (-), m4 = <z''^2> (1/m^2). Relations of P. R. Nayak, J.
Lubr. Technol. 93 (1971) 398, as arranged for contact work by J. I. McCool, Wear 107 (1986) 37. Two independent surfaces
combine by adding moments first. Arguments broadcast.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np

Values = TypeVar("Values", float, np.ndarray)
"""Numbers in, a number out; arrays in, their broadcast out."""

SUMMIT_VARIANCE = 1.0 + 16.0 / np.pi - 3.0 * np.sqrt(3.0)
"""The exact constant of the summit variance, 0.896806 (McCool prints 0.8968)."""


def nayak_parameter(m0: Values, m2: Values, m4: Values) -> Values:
    r"""Bandwidth :math:`\alpha = m_0 m_4 / m_2^2` (-); at least 3/2 on a real isotropic Gaussian surface.

    >>> round(float(nayak_parameter(0.16, 0.01, 0.004)), 6)
    6.4
    """
    return m0 * m4 / m2**2


def summit_density(m2: Values, m4: Values) -> Values:
    r"""Summits per area (1/m^2), :math:`D = m_4 / (6\pi\sqrt3\, m_2)`; Nayak 1971.

    >>> round(float(summit_density(0.01, 0.004)), 8)
    0.01225175
    """
    return m4 / (6.0 * np.pi * np.sqrt(3.0) * m2)


def summit_radius(m4: Values) -> Values:
    r"""Radius belonging to the mean summit curvature (m), :math:`R = \tfrac38\sqrt{\pi/m_4}`; McCool 1986.

    >>> round(float(summit_radius(0.004)), 6)
    10.509359
    """
    return 0.375 * np.sqrt(np.pi / m4)


def summit_sigma(m0: Values, m2: Values, m4: Values) -> Values:
    r"""Standard deviation of summit heights (m), :math:`\sigma_s = \sqrt{(1 - 0.8968/\alpha)\,m_0}`.

    Below alpha = 3/2, which no isotropic Gaussian surface has, 3/2 is used.

    >>> round(float(summit_sigma(0.16, 0.01, 0.004)), 6)
    0.370918
    """
    return np.sqrt((1.0 - SUMMIT_VARIANCE / np.maximum(nayak_parameter(m0, m2, m4), 1.5)) * m0)


def plane_offset(m0: Values, m2: Values, m4: Values) -> Values:
    r"""Height of the summit mean plane above the surface mean plane (m), :math:`z_s = 4\sqrt{m_0/(\pi\alpha)}`.

    >>> round(float(plane_offset(0.16, 0.01, 0.004)), 6)
    0.356825
    """
    return 4.0 * np.sqrt(m0 / (np.pi * np.maximum(nayak_parameter(m0, m2, m4), 1.5)))
