"""Laws of viscosity over pressure and temperature: logarithm, and its derivatives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from mixedlub.ehl.oil.declared import GIGA, MEGA, MICRO, MILLI, VISCOSITY, Given, Pair, kelvin, times
from mixedlub.ehl.oil.oil import Slopes
from mixedlub.laws import oil
from mixedlub.laws.oil import LARGEST_LOG, ROELANDS_LOG, ROELANDS_PRESSURE

ABOVE = {"gt": 0.0}
ROELANDS_KELVIN = 138.0
"""Temperature of Roelands' law (K)."""

TEMPERATURE = Given(
    "known_temperature",
    "temperature_C",
    "temperature of the values below",
    kelvin,
    example=60.0,
    limits={"gt": -oil.ZERO_CELSIUS},
)
KNOWN = Given(
    "viscosity",
    "viscosity_mPa_s",
    "viscosity at ambient pressure",
    times(MILLI),
    example=14.89,
    limits=ABOVE,
    usual=(2.0, 1000.0),
)
COEFFICIENT = Given(
    "pressure_viscosity",
    "pressure_viscosity_per_GPa",
    "pressure-viscosity coefficient",
    lambda value: value / GIGA,
    example=14.81,
    limits=ABOVE,
    usual=(10.0, 32.0),
)
FALL = Given(
    "temperature_viscosity",
    "temperature_viscosity_per_K",
    "relative fall of the viscosity",
    example=0.030,
    limits={"ge": 0.0},
    usual=(0.015, 0.07),
)
AT_ONE = (TEMPERATURE, KNOWN, COEFFICIENT, FALL)


def _above_the_pole(section: Any) -> None:
    least = np.exp(-ROELANDS_LOG) / MILLI
    if section.viscosity_mPa_s <= least:
        raise ValueError(f"viscosity_mPa_s: {section.viscosity_mPa_s:g}: must be above {least:.3g} for Roelands' law")


@VISCOSITY.offers("Roelands in Houpert's form", *AT_ONE, refuse=_above_the_pole)
def roelands(
    pressure: np.ndarray,
    temperature: np.ndarray,
    *,
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

    >>> known = dict(known_temperature=333.15, viscosity=0.01489, pressure_viscosity=14.81e-9)
    >>> log, slope, fall = roelands(np.array([0.0, 0.9642e9]), 333.15, **known, temperature_viscosity=0.030)
    >>> [round(float(v), 2) for v in np.exp(log)], round(float(slope[0]) * 1e9, 2), round(float(fall[0]), 3)
    ([0.01, 80.1], 14.81, -0.03)
    """
    size, exponent = np.log(viscosity) + ROELANDS_LOG, oil.roelands_exponent(viscosity, pressure_viscosity)
    fall = temperature_viscosity * (known_temperature - ROELANDS_KELVIN) / size
    warm = temperature - ROELANDS_KELVIN
    thinned = (warm / (known_temperature - ROELANDS_KELVIN)) ** -fall
    rise = size * oil.roelands_growth(exponent, pressure) * thinned
    return rise - ROELANDS_LOG, rise * exponent / (ROELANDS_PRESSURE + pressure), -rise * fall / warm


@VISCOSITY.offers("exponential; for films only, far too high in the contact above 0.3 GPa", *AT_ONE)
def barus(
    pressure: np.ndarray,
    temperature: np.ndarray,
    *,
    known_temperature: float,
    viscosity: float,
    pressure_viscosity: float,
    temperature_viscosity: float,
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by Barus with an exponential fall in temperature.

    .. math:: \ln\eta = \ln\eta_0 + \alpha p - \beta (T - T_0)

    For films; far too high in the contact above 0.3 GPa. Source: C. Barus, Am. J. Sci. 45 (1893) 87; O. Reynolds,
    Phil. Trans. R. Soc. 177 (1886) 157.

    >>> known = dict(known_temperature=313.15, viscosity=0.01, pressure_viscosity=20e-9)
    >>> round(float(np.exp(barus(0.1e9, 313.15, **known, temperature_viscosity=0.03)[0])), 5)
    0.07389
    """
    log = np.log(viscosity) + pressure_viscosity * pressure - temperature_viscosity * (temperature - known_temperature)
    return log, pressure_viscosity + 0.0 * log, -temperature_viscosity + 0.0 * log


BLEND = (0.7, 1.4)
"""Pressures relative to the transition between which the slope of Allen's law changes."""


@VISCOSITY.offers(
    "exponential with a smaller coefficient above a transition, after Allen",
    *AT_ONE[:3],
    Given(
        "second_pressure_viscosity",
        "second_pressure_viscosity_per_GPa",
        "pressure-viscosity coefficient far above the transition",
        lambda value: value / GIGA,
        limits=ABOVE,
        usual=(4.0, 16.0),
    ),
    Given(
        "transition",
        "transition_pressure_MPa",
        "pressure of the transition",
        times(MEGA),
        limits=ABOVE,
        usual=(150.0, 1000.0),
    ),
    FALL,
)
def two_slope(
    pressure: np.ndarray,
    temperature: np.ndarray,
    *,
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

    >>> oil = dict(known_temperature=313.15, viscosity=0.1, pressure_viscosity=20e-9, temperature_viscosity=0.03)
    >>> oil |= dict(second_pressure_viscosity=8e-9, transition=0.38e9)
    >>> [round(float(two_slope(p, 313.15, **oil)[0] - np.log(0.1)), 3) for p in (0.2e9, 0.38e9, 1.0e9)]
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


@VISCOSITY.offers(
    "exp[p/(A + Bp)] of Bode, over ASTM D341",
    Given("known_temperature", "known_temperature_C", "two temperatures of known viscosity", kelvin, Pair),
    Given(
        "known_viscosity",
        "kinematic_viscosity_mm2_s",
        "kinematic viscosity at these",
        times(MICRO),
        Pair,
        usual=((5.0, 1000.0), (1.5, 60.0)),
    ),
    Given("modulus", "modulus_GPa", "a1 of A = a1 + a2 T, T in K", times(GIGA), usual=(-0.15, 0.05)),
    Given("modulus", "modulus_per_kelvin_MPa", "a2 of A = a1 + a2 T (MPa/K)", times(MEGA), usual=(0.15, 0.7)),
    Given("stiffening", "stiffening", "b1 of B = b1 + b2 T, T in K", usual=(-0.2, 0.1)),
    Given("stiffening", "stiffening_per_K", "b2 of B = b1 + b2 T", usual=(0.0, 7e-4)),
)
def modulus(
    pressure: np.ndarray,
    temperature: np.ndarray,
    density: float,
    *,
    known_temperature: tuple[float, float],
    known_viscosity: tuple[float, float],
    modulus: tuple[float, float],
    stiffening: tuple[float, float],
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by ASTM D341 and the modulus equation, with slopes per Pa and per K.

    .. math:: \ln\eta = \ln[\rho\,\nu(T)] + \frac{p}{A + Bp},\quad A = a_1 + a_2 T,\quad B = b_1 + b_2 T

    with T in K and the kinematic viscosity (m^2/s) at two known temperatures. Where B is not above zero, the rise is
    Barus'. Source: B. Bode, Tribologie + Schmierungstechnik 36 (1989) 182; constants of oils in A. Arana et al.,
    Tribol. Int. 120 (2018).

    >>> known = dict(known_temperature=(313.15, 373.15), known_viscosity=(94.1e-6, 14.0e-6))
    >>> args = dict(modulus=(-5.73e7, 3.90e5), stiffening=(-39.5e-3, 23.54e-5))
    >>> round(float(modulus(0.0, 333.15, 840.0, **known, **args)[1]) * 1e9, 2)   # a polyalphaolefin at 60 degC
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


@VISCOSITY.offers(
    "free volume of Doolittle, with the volume of the density law tait",
    Given("free_volume_factor", "free_volume_factor", "Doolittle's factor B", limits=ABOVE),
    Given(
        "occupied_share",
        "occupied_share",
        "occupied volume over the volume, where the viscosity is that given",
        limits={"gt": 0.0, "lt": 1.0},
    ),
    Given("occupied_expansion", "occupied_expansion_per_K", "thermal expansion of the occupied volume"),
    TEMPERATURE,
    KNOWN,
)
def doolittle(
    pressure: np.ndarray,
    temperature: np.ndarray,
    volume: Callable[[np.ndarray, np.ndarray], Slopes],
    *,
    known_temperature: float,
    viscosity: float,
    free_volume_factor: float,
    occupied_share: float,
    occupied_expansion: float,
) -> Slopes:
    r"""Logarithm of the viscosity (Pa s) by the free volume of Doolittle, with slopes per Pa and per K.

    .. math:: \ln\frac{\eta}{\eta_0} = B R_0\left[\frac{w}{V/V_0 - R_0 w} - \frac{1}{1 - R_0}\right],\quad
              w = 1 + \varepsilon(T - T_0)

    with the volume V of the oil over that at ambient pressure and the known temperature, where the viscosity is eta_0
    and the occupied volume the share R_0. The rise is at most exp(500). Source: S. Bair, High-Pressure Rheology for
    Quantitative Elastohydrodynamics (2007), after A. K. Doolittle, J. Appl. Phys. 22 (1951) 1471.

    >>> half = lambda p, t: (np.array(0.8), np.array(-1e-10), np.array(0.0))
    >>> known = dict(known_temperature=313.15, viscosity=0.02, free_volume_factor=4.0, occupied_share=0.6)
    >>> log = doolittle(1e9, 313.15, half, **known, occupied_expansion=0.0)[0]
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
