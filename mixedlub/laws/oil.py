"""The lubricant: viscosity and density against temperature and pressure."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.chain.slots import VISCOSITY

ROELANDS_PRESSURE = 1.96e8
ROELANDS_LOG = 9.67
ZERO_CELSIUS = 273.15
LARGEST_LOG = 500.0
"""Logarithm of a viscosity's rise that stands for any above, far beyond every liquid: it stays a number."""
D341_CONSTANT = 0.7
D341_PLAIN, D341_FULL, D341_LEAST = 2.0, 1.9, 0.21
"""Source: ASTM D341. Kinematic viscosities (mm^2/s) above which the standard takes the constant alone, where
this package has all terms in full, and at which the standard ends."""
D341_TERMS = (
    (1.0, -1.14883, 2.65868),
    (-1.0, -0.0038138, 12.5645),
    (1.0, 5.46491, 37.6289),
    (-1.0, 13.0458, 74.6851),
    (1.0, 37.4619, 192.643),
    (-1.0, 80.4945, 400.468),
)
"""Source: ASTM D341. Sign, start and fall of the exponential terms C to H."""
D341_STEPS = 12
"""Newton's steps of the inverse, with margin: eight reach rounding from 0.21 to 2 mm^2/s."""
LIQUID = {"contact_viscosity": (0.0, 1e12)}
"""Definition. Range of laws of viscosity under pressure (Pa s): an oil with more is a glass."""


def kinematic_viscosity(
    temperature: np.ndarray, known_temperature: tuple[float, float], known_viscosity: tuple[float, float]
) -> np.ndarray:
    r"""Kinematic viscosity (m^2/s) at a temperature (K) from two known points; ASTM D341 with its terms of thin oils.

    .. math:: \log\log Z = A - B \log T, \quad Z = \nu + 0.7 + f(\nu),\quad \nu\ \text{in mm}^2/\text{s}

    The exponential terms f are left out above 2 mm^2/s. The logarithms make this form belong to mm^2/s; the conversion
    is inside. Valid from 0.21 mm^2/s. Source: ASTM D341, the Walther equation.

    >>> celsius = np.array([60.0, 80.0, 100.0])   # automatic transmission fluid, 850 kg/m^3 at 15 degC
    >>> nu = kinematic_viscosity(celsius + 273.15, (313.15, 373.15), (34e-6, 7.2e-6))
    >>> [round(float(v) * 1e3, 1) for v in nu * 850.0 * (1.0 - 6.5e-4 * (celsius - 15.0))]
    [14.9, 8.9, 5.8]
    >>> round(float(kinematic_viscosity(423.15, (313.15, 373.15), (5e-6, 1.7e-6))) * 1e6, 3)   # 1.007 by 0.7 alone
    0.987
    """
    start, slope = _d341_line(known_temperature, known_viscosity)
    return from_d341(start - slope * np.log10(temperature / known_temperature[0]))


def kinematic(viscosity: np.ndarray, oil_density: np.ndarray) -> np.ndarray:
    r"""Kinematic viscosity (m^2/s), :math:`\nu = \eta/\rho`.

    >>> round(float(kinematic(0.0106, 799.3)) * 1e6, 2)
    13.26
    """
    return viscosity / oil_density


def to_d341(kinematic_viscosity: np.ndarray) -> np.ndarray:
    """The ordinate of the ASTM D341 chart, log log Z, which makes the form belong to mm^2/s.

    >>> round(float(to_d341(99.3e-6)), 5)   # nu + 0.7 = 100
    0.30103
    """
    return np.log10(np.log10(_d341_number(kinematic_viscosity * 1e6)[0]))


def from_d341(ordinate: np.ndarray) -> np.ndarray:
    """Kinematic viscosity (m^2/s) at an ordinate of the ASTM D341 chart, which makes the form belong to mm^2/s.

    >>> round(float(from_d341(to_d341(34e-6))) * 1e6, 9), round(float(from_d341(to_d341(0.5e-6))) * 1e6, 9)
    (34.0, 0.5)
    """
    return _of_d341_number(10.0 ** (10.0**ordinate)) * 1e-6


def _d341_number(nu: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    r"""Number Z of ASTM D341 of a kinematic viscosity (mm^2/s), and its slope.

    .. math:: Z = \nu + 0.7 + C - D + E - F + G - H,\quad C = e^{-1.14883 - 2.65868\nu}\ \text{and so on}

    The standard leaves out the exponential terms above 2 mm^2/s; they fade in from there to 1.9 mm^2/s, so that the
    viscosity has no step (of 0.08 %). Below 0.21 mm^2/s, the end of the standard, Z goes on as a straight line.
    Source: ASTM D341-09, equations 1 to 9.

    >>> [round(float(_d341_number(np.array(nu))[0]), 4) for nu in (5.0, 1.0, 0.5, 0.21)]
    [5.7, 1.7222, 1.282, 1.059]
    """
    nu = np.asarray(nu, dtype=float)
    number, slope = nu + D341_CONSTANT, np.ones_like(nu)
    if not np.any(nu < D341_PLAIN):
        return number, slope
    held = np.clip(nu, D341_LEAST, D341_PLAIN)
    terms = [sign * np.exp(start - fall * held) for sign, start, fall in D341_TERMS]
    added = sum(terms)
    steepness = sum(-fall * term for term, (_, _, fall) in zip(terms, D341_TERMS, strict=True))
    width = D341_PLAIN - D341_FULL
    part = np.clip((D341_PLAIN - held) / width, 0.0, 1.0)
    share, by_nu = part**2 * (3.0 - 2.0 * part), -6.0 * part * (1.0 - part) / width
    steepness = share * steepness + by_nu * added
    return number + share * added + steepness * np.minimum(nu - D341_LEAST, 0.0), slope + steepness


def _of_d341_number(number: np.ndarray) -> np.ndarray:
    """Kinematic viscosity (mm^2/s) of a number Z of ASTM D341: the inverse of `_d341_number`, by Newton's steps."""
    nu = np.asarray(number - D341_CONSTANT)
    thin = nu < D341_PLAIN
    if not np.any(thin):
        return nu
    low, high = np.zeros_like(nu), np.full_like(nu, D341_PLAIN)
    found = np.clip(nu, D341_LEAST, D341_PLAIN)
    for _ in range(D341_STEPS):
        value, slope = _d341_number(found)
        low, high = np.where(value < number, found, low), np.where(value < number, high, found)
        step = found - (value - number) / slope
        found = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
    return np.where(thin, found, nu)


def _d341_line(
    known_temperature: tuple[float, float], known_viscosity: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Ordinate at the first known point and the fall a decade of temperature."""
    z1, z2 = (to_d341(np.asarray(v)) for v in known_viscosity)
    return z1, (z1 - z2) / np.log10(known_temperature[1] / known_temperature[0])


def temperature_viscosity(
    temperature: np.ndarray,
    known_temperature: tuple[float, float],
    known_viscosity: tuple[float, float],
    density_change: float = 0.0,
) -> np.ndarray:
    r"""Relative fall of dynamic viscosity per kelvin (1/K), from the slope of ASTM D341.

    .. math:: \beta = B\,\frac{Z\ln Z}{\nu\,T\,dZ/d\nu} + c

    with c the relative change of density, and Z = nu + 0.7 above 2 mm^2/s, which makes the form belong to mm^2/s.
    Source: derivative of ASTM D341.

    >>> beta = temperature_viscosity(343.15, (313.15, 373.15), (34e-6, 7.2e-6), 6.5e-4)
    >>> round(float(beta), 3)   # automatic transmission fluid at 70 degC
    0.026
    """
    _, slope = _d341_line(known_temperature, known_viscosity)
    nu = kinematic_viscosity(temperature, known_temperature, known_viscosity) * 1e6
    number, by_nu = _d341_number(nu)
    return slope * number * np.log(number) / (nu * temperature * by_nu) + density_change


def warmed_viscosity(
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    temperature_viscosity: np.ndarray,
    temperature: np.ndarray,
    rise: np.ndarray,
) -> np.ndarray:
    r"""Dynamic viscosity of an oil that has become warmer by a rise (K) (Pa s).

    .. math:: \ln Z(\nu') = \ln Z(\nu)\,(1 + \Delta T/T)^{-B},\quad
              B = \frac{\beta\,\nu\,T\,dZ/d\nu}{Z\ln Z}

    The line of ASTM D341 with the fall that the oil has; the part of the density is taken into the line. Z is nu + 0.7
    above 2 mm^2/s, which makes the form belong to mm^2/s. Source: ASTM D341.

    >>> beta = temperature_viscosity(313.15, (313.15, 373.15), (34e-6, 7.2e-6))
    >>> warm = warmed_viscosity(34e-6 * 850.0, 850.0, beta, 313.15, 60.0)
    >>> round(float(warm) / 850.0 * 1e6, 6)
    7.2
    """
    nu = viscosity / oil_density * 1e6
    number, by_nu = _d341_number(nu)
    log = np.log(number)
    slope = temperature_viscosity * nu * temperature * by_nu / (number * log)
    gone = log * ((1.0 + rise / temperature) ** -slope - 1.0)
    plain = 1.0 + (number / nu) * np.expm1(gone)
    thin = np.minimum(nu, nu * plain) < D341_PLAIN
    if np.any(thin):
        plain = np.where(thin, _of_d341_number(number * np.exp(gone)) / nu, plain)
    return viscosity * plain


@VISCOSITY.offers("roelands", "viscosity in the contact by Roelands", LIQUID)
def roelands_viscosity(viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Viscosity under pressure (Pa s), isothermal.

    .. math:: \eta = \eta_0 \exp\{(\ln\eta_0 + 9.67)[(1 + p/p_r)^Z - 1]\},\quad
              Z = \frac{\alpha p_r}{\ln\eta_0 + 9.67},\quad p_r = 1.96\times10^8\ \text{Pa}

    The 9.67 and p_r make the form belong to Pa s and Pa. Slope at p = 0 is alpha. Valid to about 1 GPa for Z 0.4-0.8.
    Source: C. J. A. Roelands, thesis, Delft 1966, as written by L. Houpert, J. Tribol. 107 (1985) 241.

    >>> round(float(roelands_viscosity(0.01489, 14.81e-9, 0.9642e9)), 1)
    80.1
    """
    growth = roelands_growth(roelands_exponent(viscosity, pressure_viscosity), hertz_pressure)
    rise = (np.log(viscosity) + ROELANDS_LOG) * (growth - 1.0)
    return viscosity * np.exp(np.minimum(rise, LARGEST_LOG))


def roelands_growth(exponent: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    r"""Growth of Roelands' logarithm :math:`\ln\eta + 9.67` under pressure (-), :math:`(1 + p/p_r)^Z`.

    p_r makes the form belong to Pa. Source: as `roelands_viscosity`.

    >>> round(float(roelands_growth(0.5, 3 * ROELANDS_PRESSURE)), 9)
    2.0
    """
    return power(1.0 + pressure / ROELANDS_PRESSURE, exponent)


def roelands_exponent(viscosity: np.ndarray | float, pressure_viscosity: np.ndarray | float) -> np.ndarray:
    r"""Exponent of Roelands that a pressure-viscosity coefficient means (-), :math:`Z = \alpha p_r/(\ln\eta_0 + 9.67)`.

    The 9.67 and p_r make the form belong to Pa s and Pa. Source: as `roelands_viscosity`.

    >>> round(float(roelands_exponent(0.01489, 14.81e-9)), 4)
    0.5314
    """
    return pressure_viscosity * ROELANDS_PRESSURE / (np.log(viscosity) + ROELANDS_LOG)


def roelands_coefficient(viscosity: np.ndarray, exponent: np.ndarray | float) -> np.ndarray:
    r"""Pressure-viscosity coefficient that the exponent of Roelands means (1/Pa).

    .. math:: \alpha = Z(\ln\eta_0 + 9.67)/p_r

    One Z at all temperatures lets the coefficient fall as the oil thins. The 9.67 and p_r make the form belong to
    Pa s and Pa. Source: as `roelands_viscosity`.

    >>> round(float(roelands_coefficient(0.01489, 0.5314)) * 1e9, 2)
    14.81
    """
    return exponent * (np.log(viscosity) + ROELANDS_LOG) / ROELANDS_PRESSURE


@VISCOSITY.offers(
    "modulus", "viscosity in the contact by the modulus equation, of an oil that has its constants", LIQUID
)
def modulus_viscosity(
    viscosity: np.ndarray, pressure_modulus: np.ndarray, modulus_slope: np.ndarray, hertz_pressure: np.ndarray
) -> np.ndarray:
    r"""Viscosity under pressure (Pa s), :math:`\eta = \eta_0\exp[p/(A + B p)]`.

    The pressure-viscosity coefficient falls from 1/A at no pressure for B above 0. Below 0 it grows, and where A + B p
    would reach 0 the viscosity is held at a rise of exp(500).
    Source: A. Arana, J. Larranaga, I. Ulacia, Proc. IMechE J 233 (2019) 303, eq. 30.

    >>> a, b = 1e9 * np.array([0.043639, 0.052494, 0.072629]), np.array([-1.0966e-3, 24.016e-3, 38.924e-3])
    >>> rise = np.log(modulus_viscosity(1.0, a, b, 1e9))   # N100, M100 and PAO100 at 60 degC
    >>> rise.round(2).tolist()
    [23.51, 13.07, 8.96]
    """
    return viscosity * np.exp(modulus_rise(pressure_modulus, modulus_slope, hertz_pressure))


def modulus_rise(pressure_modulus: np.ndarray, modulus_slope: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    r"""Logarithm of the viscosity over that at no pressure (-), :math:`p/(A + B p)`, at most 500.

    Source: as `modulus_viscosity`.

    >>> round(float(modulus_rise(72.629e6, 38.924e-3, 1e9)), 2)   # PAO100 at 60 degC
    8.96
    """
    stiffness = pressure_modulus + modulus_slope * pressure
    return np.where(stiffness > pressure / LARGEST_LOG, pressure / np.maximum(stiffness, 1.0), LARGEST_LOG)


@VISCOSITY.offers("barus", "viscosity in the contact by Barus (far too high above 0.3 GPa)", LIQUID)
def barus_in_contact(viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Barus viscosity at the largest Hertz pressure (Pa s), :math:`\eta_0 e^{\alpha p_0}`.

    Source: as `barus_viscosity`.

    >>> round(float(barus_in_contact(0.01489, 14.81e-9, 0.9642e9)))
    23688
    """
    return barus_viscosity(viscosity, pressure_viscosity, hertz_pressure)


def barus_viscosity(viscosity: np.ndarray, pressure_viscosity: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    r"""Viscosity under pressure (Pa s), :math:`\eta = \eta_0 e^{\alpha p}`; good below about 0.3 GPa.

    Source: C. Barus, Am. J. Sci. 45 (1893) 87.

    >>> round(float(barus_viscosity(0.01, 20e-9, 0.1e9)), 5)
    0.07389
    """
    return viscosity * np.exp(pressure_viscosity * pressure)


def gold_pressure_viscosity(kinematic_viscosity: np.ndarray, scale: float, exponent: float) -> np.ndarray:
    r"""Pressure-viscosity coefficient of an oil by its base stock (1/Pa), :math:`\alpha = s\,\nu^t`.

    With nu in mm^2/s and s in 1/GPa: 9.904 and 0.1390 of mineral oils, 7.382 and 0.1335 of polyalphaolefins, 6.605 and
    0.1360 of esters, 5.489 and 0.1485 of polyglycols. These make the form belong to Pa and m^2/s.
    Source: P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, J. Synth. Lubr. 18 (2001) 51.

    >>> [round(float(alpha) * 1e9, 1) for alpha in gold_pressure_viscosity(np.array([460e-6, 45e-6]), 7.382, 0.1335)]
    [16.7, 12.3]
    """
    return scale * power(kinematic_viscosity * 1e6, exponent) * 1e-9
