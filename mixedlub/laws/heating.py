"""How hot sliding makes the contact, and how much softer that leaves the film."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.laws.oil import ROELANDS_LOG

_ITERATIONS = 4
TOOTH_RISE_EXPONENT = 0.72
"""Exponent of the loss in the rise of the teeth, ISO/TR 15144-1."""
_LARGEST_OVER_MEAN = 0.786 / 0.542
"""Largest over mean rise of a contact with semi-elliptic heat flux, from the integral of the line source."""


def contact_softening(
    temperature_viscosity: np.ndarray, viscosity: np.ndarray, contact_viscosity: np.ndarray
) -> np.ndarray:
    r"""Relative fall of viscosity per kelvin under pressure (1/K), larger than at ambient pressure.

    .. math:: \beta_p = \beta\left(1 + \frac{p}{p_r}\right)^Z
              = \beta\left(1 + \frac{\ln(\eta_p/\eta_0)}{\ln\eta_0 + 9.67}\right)

    The 9.67 makes the form belong to Pa s. Source: the slope in temperature of Roelands' equation as written by
    L. Houpert, J. Tribol. 107 (1985) 241.

    >>> round(float(contact_softening(0.026, 0.01489, 80.1)), 4)   # at 0.9642 GPa
    0.0669
    """
    return temperature_viscosity * (1.0 + np.log(contact_viscosity / viscosity) / (np.log(viscosity) + ROELANDS_LOG))


def shear_heating(
    contact_viscosity: np.ndarray,
    viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    oil_conductivity: np.ndarray | float,
    sliding_speed: np.ndarray,
) -> np.ndarray:
    r"""Number by which shear heats a Newtonian film between walls of one temperature (-), :math:`x^2`.

    .. math:: x^2 = \frac{\beta_p\,\eta_p\,v_s^2}{8 k_f}

    The slope beta_p, as `contact_softening` has it, makes the form belong to Pa s.
    Source: A. W. Crook, Phil. Trans. R. Soc. A 254 (1961) 237.

    >>> round(float(shear_heating(10.0, 10.0, 0.04, 0.125, 1.0)), 9)   # without pressure the slope is that of the oil
    0.4
    """
    beta = contact_softening(temperature_viscosity, viscosity, contact_viscosity)
    return beta * contact_viscosity * sliding_speed**2 / (8.0 * oil_conductivity)


def film_rise(
    contact_viscosity: np.ndarray,
    viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    oil_conductivity: np.ndarray | float,
    sliding_speed: np.ndarray,
) -> np.ndarray:
    r"""Rise of the middle of a Newtonian film above its walls by shear (K); the walls keep the oil's temperature.

    .. math:: \Delta\theta = \frac{1}{\beta_p}\ln(1 + x^2)

    The slope beta_p, as `contact_softening` has it, makes the form belong to Pa s.
    Source: A. W. Crook, Phil. Trans. R. Soc. A 254 (1961) 237, the film with heat conducted to its walls.

    >>> softening = 1 + np.log(10.0 / 0.02) / (np.log(0.02) + 9.67)
    >>> round(float(film_rise(10.0, 0.02, 0.04 / softening, 0.125, 1.0)), 2)   # ln(1.4)/0.04
    8.41
    """
    beta = contact_softening(temperature_viscosity, viscosity, contact_viscosity)
    given = contact_viscosity, viscosity, temperature_viscosity, oil_conductivity, sliding_speed
    return np.log1p(shear_heating(*given)) / beta


def flash_temperature(
    heat_flux: np.ndarray,
    hertz_half_width: np.ndarray,
    entrainment_speed: np.ndarray,
    sliding_speed: np.ndarray,
    solid_conductivity: np.ndarray,
    solid_density: np.ndarray,
    solid_heat_capacity: np.ndarray,
) -> np.ndarray:
    r"""Rise of the surfaces above their bulk, mean over the contact (K), from the mean heat flux (W/m^2).

    .. math:: \Delta T = 0.542\,\frac{2 b\,\bar q}{\sqrt{k\rho c}\,(\sqrt{u_1} + \sqrt{u_2})\sqrt b}

    Semi-elliptic flux on bodies of like material that share it so that their temperatures agree; both moving
    fast (u b rho c / 2k above 5). The largest rise has 0.786 in place of 0.542.
    Source: H. Blok, Proc. Gen. Disc. Lubrication, IMechE 2 (1937) 222; the constants integrate his line source.

    >>> flux = 0.05 * 381e3 * 5.0 / (2 * 0.18e-3)   # friction 0.05, 381 N/mm, 5 m/s, half width 0.18 mm
    >>> round(float(flash_temperature(flux, 0.18e-3, 7.0, 5.0, 46.0, 7800.0, 470.0)))
    57
    """
    first = np.sqrt(np.abs(entrainment_speed + 0.5 * sliding_speed))
    second = np.sqrt(np.abs(entrainment_speed - 0.5 * sliding_speed))
    effusivity = np.sqrt(solid_conductivity * solid_density * solid_heat_capacity)
    return 1.084 * heat_flux * np.sqrt(hertz_half_width) / (effusivity * (first + second))


def flash_per_friction(
    hertz_pressure: np.ndarray,
    hertz_half_width: np.ndarray,
    entrainment_speed: np.ndarray,
    sliding_speed: np.ndarray,
    solid_conductivity: np.ndarray,
    solid_density: np.ndarray,
    solid_heat_capacity: np.ndarray,
) -> np.ndarray:
    r"""Rise of the surfaces above their bulk per unit of friction coefficient, mean over the contact (K).

    .. math:: \theta_\mu = 1.084\,\frac{\bar p\,v_s\sqrt b}{\sqrt{k\rho c}\,(\sqrt{u_1} + \sqrt{u_2})},\quad
              \bar p = \frac{\pi}{4}\,p_0

    A line contact's mean pressure; a point contact has 2/3 in place of pi/4, but heat that also flows sideways.
    Source: as for the flash temperature, with the heat flux of friction under the mean pressure.

    >>> speeds, steel = (7.0, 5.0), (46.0, 7800.0, 470.0)
    >>> pressure = 4 / 3.14159 * 381e3 / (2 * 0.18e-3)   # of 381 N/mm, as in the flash temperature's example
    >>> round(0.05 * float(flash_per_friction(pressure, 0.18e-3, *speeds, *steel)))
    57
    """
    flux = 0.25 * np.pi * hertz_pressure * sliding_speed
    return flash_temperature(
        flux, hertz_half_width, entrainment_speed, sliding_speed, solid_conductivity, solid_density, solid_heat_capacity
    )


def largest_flash_temperature(flash_per_friction: np.ndarray, friction: np.ndarray) -> np.ndarray:
    r"""Rise of the surfaces above their bulk at the hottest place of a line contact (K).

    .. math:: \Delta T_{max} = \frac{0.786}{0.542}\,\theta_\mu\,\mu

    Semi-elliptic heat flux, as in the mean rise. Blok's own constant, 1.11 over the root of the contact's full width,
    gives 0.785 in place of 0.786. Source: H. Blok, Proc. Gen. Disc. Lubrication, IMechE 2 (1937) 222.

    >>> round(float(largest_flash_temperature(57.0 / 0.05, 0.05)))   # mean rise of 57 K
    83
    """
    return _LARGEST_OVER_MEAN * flash_per_friction * friction


def softened_stress(
    shear_stress: np.ndarray, eyring_stress: np.ndarray, given: np.ndarray | float, per_stress: np.ndarray
) -> np.ndarray:
    r"""Eyring stress of a film that the stress itself softens (Pa).

    .. math:: \tau' = \tau_0 \operatorname{asinh}\left(\sinh\frac{\tau}{\tau_0}\; e^{-x}\right),\quad x = a + c\,\tau'

    with a (-) softening that does not depend on the stress and c (1/Pa) that does. Newton's iteration from x = a
    rises to the root without overshoot, because x - a - c tau'(x) grows and curves downward.
    Source: J. F. Archard, Wear 2 (1959) 438, the mean temperature of a sheared film, with an Eyring liquid.

    >>> round(float(softened_stress(20e6, 5e6, 0.5, 1e-7)) / 1e6, 3)
    11.697
    >>> bool(abs(np.sinh(11.697 / 5) / np.sinh(4.0) / np.exp(-0.5 - 1.1697) - 1) < 1e-3)
    True
    """
    rate = np.maximum(np.sinh(shear_stress / eyring_stress), 1e-12)
    slope = per_stress * eyring_stress
    softening = given
    for _ in range(_ITERATIONS):
        reduced = rate * np.exp(-softening)
        error = softening - given - slope * np.arcsinh(reduced)
        softening = softening - error / (1.0 + slope * reduced / np.sqrt(1.0 + reduced**2))
    return shear_stress * (np.arcsinh(rate * np.exp(-softening)) / np.arcsinh(rate))


def tooth_rise(power_loss: np.ndarray, pinion_radius: float, gear_radius: float, face_width: float) -> np.ndarray:
    r"""Mean rise of the teeth of a gear pair above the oil (K).

    .. math:: \Delta\theta = 7400\left[\frac{P}{a\,b}\right]^{0.72} \frac{X_S}{1.2\,X_{Ca}},\quad a = r_1 + r_2

    with P in kW, a and b in mm; X_S = 1.2 is that of oil sprayed on, X_Ca = 1.95 of teeth relieved enough at a
    contact ratio of 1. The constant makes this form belong to SI. Source: ISO/TR 15144-1.

    >>> round(float(tooth_rise(500.0, 0.0366, 0.0549, 0.014)), 1)
    13.3
    """
    load = power_loss * 1e-3 / ((pinion_radius + gear_radius) * face_width * 1e6)
    return 7400.0 * power(load, TOOTH_RISE_EXPONENT) / 1.95
