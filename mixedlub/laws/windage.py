"""Power of a gear wheel that turns in air: the empirical laws beside that of `drag`."""

from __future__ import annotations

import numpy as np


def windage_dawson(
    root_diameter: np.ndarray,
    wheel_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    oil_mist: float = 1.0,
    space: float = 1.0,
) -> np.ndarray:
    r"""Power of one wheel against air (W).

    .. math:: P = 10^{-17} n^{2.9}\left(0.16 D^{3.9} + D^{2.9} b^{0.75} m^{1.15}\right)\Phi\lambda

    with n in rpm and root diameter D, b, m in mm. The first term is of large wheels: not for D below about 100 mm.
    Source: P. H. Dawson, Proc. IMechE A 198 (1984) 51; constants as quoted in reviews.

    >>> round(float(windage_dawson(0.090, 10_000 * np.pi / 30, 0.020, 4e-3)))   # Diab: 114 W
    113
    """
    speed, root, face, size = wheel_speed * 30.0 / np.pi, root_diameter * 1e3, face_width * 1e3, gear_module * 1e3
    shape = 0.16 * root**3.9 + root**2.9 * face**0.75 * size**1.15
    return 1e-17 * speed**2.9 * shape * oil_mist * space


def windage_anderson_loewenthal(
    wheel_radius: np.ndarray, wheel_speed: np.ndarray, face_width: np.ndarray, viscosity: np.ndarray
) -> np.ndarray:
    r"""Power of one wheel in the mist of a gearbox (W).

    .. math:: P = 2.82\times10^{-4}\left(1 + 2.3\,\frac bR\right) n^{2.8} R^{4.6} (0.028\,\eta + 0.019)^{0.2}

    with n in rpm, eta in mPa s. A mist of 34 parts of air to one of oil is part of the law.
    Source: N. E. Anderson, S. H. Loewenthal, NASA TP-1622, 1980; constants as quoted in reviews.

    >>> round(float(windage_anderson_loewenthal(0.050, 10_000 * np.pi / 30, 0.020, 0.010)))
    70
    """
    speed = wheel_speed * 30.0 / np.pi
    mist = (0.028 * viscosity * 1e3 + 0.019) ** 0.2
    return 2.82e-4 * (1.0 + 2.3 * face_width / wheel_radius) * speed**2.8 * wheel_radius**4.6 * mist


def windage_maurer(
    wheel_radius: np.ndarray, wheel_speed: np.ndarray, face_width: np.ndarray, gear_module: np.ndarray
) -> np.ndarray:
    r"""Power of one wheel against air (W).

    .. math:: P = 1.37\times10^{-9} v^{1.9} d^{1.6} b^{0.52} m^{0.69}\,\omega

    with the pitch line speed v in m/s and pitch diameter d, b, m in mm.
    Source: J. Maurer, thesis, University of Stuttgart, 1994; constants as a public program has them.

    >>> round(float(windage_maurer(0.050, 10_000 * np.pi / 30, 0.020, 4e-3)))
    52
    """
    speed = wheel_speed * wheel_radius
    torque = (
        1.37e-9 * speed**1.9 * (2e3 * wheel_radius) ** 1.6 * (1e3 * face_width) ** 0.52 * (1e3 * gear_module) ** 0.69
    )
    return torque * wheel_speed
