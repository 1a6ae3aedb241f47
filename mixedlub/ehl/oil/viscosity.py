"""Viscosity against pressure and temperature: logarithm, and its slopes in both."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from mixedlub.ehl.oil.oil import Slopes
from mixedlub.laws import oil
from mixedlub.laws.oil import LARGEST_LOG, ROELANDS_LOG, ROELANDS_PRESSURE

ROELANDS_KELVIN = 138.0
"""Temperature of Roelands' law (K)."""


def roelands(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: float,
    viscosity: float,
    pressure_viscosity: float,
    temperature_viscosity: float,
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by Roelands in Houpert's form, with slopes per Pa and per K.

    .. math:: \ln\eta = \ln\eta_0 + (\ln\eta_0 + 9.67)\left[(1 + p/p_r)^Z
              \left(\frac{T - 138}{T_0 - 138}\right)^{-S_0} - 1\right]

    with Z = alpha p_r/(ln eta_0 + 9.67) and S_0 = beta (T_0 - 138)/(ln eta_0 + 9.67); viscosity, alpha and beta are
    those of the known temperature. Good to about 1 GPa; an extrapolation above.
    Source: L. Houpert, J. Tribol. 107 (1985) 241.

    >>> log, slope, fall = roelands(np.array([0.0, 0.9642e9]), 333.15, 333.15, 0.01489, 14.81e-9, 0.030)
    >>> [round(float(v), 2) for v in np.exp(log)], round(float(slope[0]) * 1e9, 2), round(float(fall[0]), 3)
    ([0.01, 80.1], 14.81, -0.03)
    """
    size, exponent = np.log(viscosity) + ROELANDS_LOG, oil.roelands_exponent(viscosity, pressure_viscosity)
    fall = temperature_viscosity * (known_temperature - ROELANDS_KELVIN) / size
    warm = temperature - ROELANDS_KELVIN
    thinned = (warm / (known_temperature - ROELANDS_KELVIN)) ** -fall
    rise = size * oil.roelands_growth(exponent, pressure) * thinned
    return rise - ROELANDS_LOG, rise * exponent / (ROELANDS_PRESSURE + pressure), -rise * fall / warm


def barus(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: float,
    viscosity: float,
    pressure_viscosity: float,
    temperature_viscosity: float,
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by Barus with an exponential fall in temperature.

    .. math:: \ln\eta = \ln\eta_0 + \alpha p - \beta (T - T_0)

    For films; far too high in the contact above 0.3 GPa. Source: C. Barus, Am. J. Sci. 45 (1893) 87; O. Reynolds,
    Phil. Trans. R. Soc. 177 (1886) 157.

    >>> round(float(np.exp(barus(0.1e9, 313.15, 313.15, 0.01, 20e-9, 0.03)[0])), 5)
    0.07389
    """
    log = np.log(viscosity) + pressure_viscosity * pressure - temperature_viscosity * (temperature - known_temperature)
    return log, pressure_viscosity + 0.0 * log, -temperature_viscosity + 0.0 * log


BLEND = (0.7, 1.4)
"""Pressures over that of the transition between which the slope of Allen's law changes."""


def two_slope(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: float,
    viscosity: float,
    pressure_viscosity: float,
    second_pressure_viscosity: float,
    transition: float,
    temperature_viscosity: float,
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) that rises with two slopes over the pressure, joined by a cubic.

    .. math:: \ln\eta = \ln\eta_0 - \beta(T - T_0) + \begin{cases}\alpha_1 p & p < 0.7\,p_t\\
              c_0 + c_1 p + c_2 p^2 + c_3 p^3 & \\ \alpha_1 p_t + \alpha_2(p - p_t) & p > 1.4\,p_t\end{cases}

    The cubic has value and slope of the lines at its ends. Mineral oils change slope near 380 MPa. Source: H. Xu, PhD
    thesis, Ohio State University (2005), equation 2.4, after Allen.

    >>> oil = (313.15, 0.1, 20e-9, 8e-9, 0.38e9, 0.03)
    >>> [round(float(two_slope(p, 313.15, *oil)[0] - np.log(0.1)), 3) for p in (0.2e9, 0.38e9, 1.0e9)]
    [4.0, 7.217, 12.56]
    """
    low, high = (share * transition for share in BLEND)
    first, second = pressure_viscosity, second_pressure_viscosity
    joint = CubicHermiteSpline(
        [low, high], [first * low, first * transition + second * (high - transition)], [first, second]
    )
    between = np.clip(pressure, low, high)
    rise = joint(between) + first * np.minimum(pressure - low, 0.0) + second * np.maximum(pressure - high, 0.0)
    log = np.log(viscosity) + rise - temperature_viscosity * (temperature - known_temperature)
    return log, joint(between, 1) + 0.0 * log, -temperature_viscosity + 0.0 * log


def modulus(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: tuple[float, float],
    known_viscosity: tuple[float, float],
    density: float,
    modulus: tuple[float, float],
    stiffening: tuple[float, float],
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by ASTM D341 and the modulus equation, with slopes per Pa and per K.

    .. math:: \ln\eta = \ln[\rho\,\nu(T)] + \frac{p}{A + Bp},\quad A = a_1 + a_2 T,\quad B = b_1 + b_2 T

    with T in K and the kinematic viscosity (m^2/s) at two known temperatures. Where B is not above zero, the rise is
    Barus'. Source: B. Bode, Tribologie + Schmierungstechnik 36 (1989) 182; constants of oils in A. Arana et al.,
    Tribol. Int. 120 (2018).

    >>> args = ((313.15, 373.15), (94.1e-6, 14.0e-6), 840.0, (-5.73e7, 3.90e5), (-39.5e-3, 23.54e-5))
    >>> round(float(modulus(0.0, 333.15, *args)[1]) * 1e9, 2)   # a polyalphaolefin at 60 degC
    13.77
    """
    nu = oil.kinematic_viscosity(temperature, known_temperature, known_viscosity)
    fall = oil.temperature_viscosity(temperature, known_temperature, known_viscosity)
    base, stiff = modulus[0] + modulus[1] * temperature, stiffening[0] + stiffening[1] * temperature
    stiff_by_t = np.where(stiff > 0.0, stiffening[1], 0.0)
    stiff = np.maximum(stiff, 0.0)
    whole = base + stiff * pressure
    return (
        np.log(density * nu) + oil.modulus_rise(base, stiff, pressure),
        base / whole**2,
        -fall - pressure * (modulus[1] + stiff_by_t * pressure) / whole**2,
    )


def doolittle(
    pressure: np.ndarray,
    temperature: np.ndarray,
    known_temperature: float,
    viscosity: float,
    free_volume_factor: float,
    occupied_share: float,
    occupied_expansion: float,
    volume: Callable[[np.ndarray, np.ndarray], Slopes],
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by the free volume of Doolittle, with slopes per Pa and per K.

    .. math:: \ln\frac{\eta}{\eta_0} = B R_0\left[\frac{w}{V/V_0 - R_0 w} - \frac{1}{1 - R_0}\right],\quad
              w = 1 + \varepsilon(T - T_0)

    with the volume V of the oil over that at ambient pressure and the known temperature, where the viscosity is eta_0
    and the occupied volume the share R_0. The rise is at most exp(500). Source: S. Bair, High-Pressure Rheology for
    Quantitative Elastohydrodynamics (2007), after A. K. Doolittle, J. Appl. Phys. 22 (1951) 1471.

    >>> half = lambda p, t: (np.array(0.8), np.array(-1e-10), np.array(0.0))
    >>> log = doolittle(1e9, 313.15, 313.15, 0.02, 4.0, 0.6, 0.0, half)[0]
    >>> round(float(log - np.log(0.02)), 6)   # 4 x 0.6 x (1/0.2 - 1/0.4)
    6.0
    """
    filled, by_p, by_t = volume(pressure, temperature)
    occupied = 1.0 + occupied_expansion * (temperature - known_temperature)
    scale = free_volume_factor * occupied_share
    free = np.maximum(filled - occupied_share * occupied, scale * occupied / LARGEST_LOG)
    by_free = -scale * occupied / free**2
    return (
        np.log(viscosity) + scale * (occupied / free - 1.0 / (1.0 - occupied_share)),
        by_free * by_p,
        scale * occupied_expansion / free + by_free * (by_t - occupied_share * occupied_expansion),
    )
