"""Margins of flanks against scuffing and micropitting, in the forms of the standards of gear rating."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power
from mixedlub.laws.oil import warmed_viscosity


def flash_safety(
    contact_temperature: np.ndarray, oil_temperature: np.ndarray, scuffing_temperature: float
) -> np.ndarray:
    r"""Safety against scuffing by the flash temperature (-).

    .. math:: S_B = \frac{\theta_S - \theta_{oil}}{\theta_B - \theta_{oil}}

    with the largest contact temperature on the path and that at which the oil scuffs. Source: ISO/TS 6336-20 (before
    ISO/TR 13989-1); its form is from memory, without a second source.

    >>> float(flash_safety(433.15, 363.15, 503.15))   # oil of 90, contact of 160, scuffing at 230 degC
    2.0
    """
    return np.asarray((scuffing_temperature - oil_temperature) / (contact_temperature - oil_temperature))


def integral_temperature(
    bulk_temperature: np.ndarray, mean_flash_temperature: np.ndarray, flash_weight: float
) -> np.ndarray:
    r"""Integral temperature of a mesh (K), :math:`\theta_{int} = \theta_M + C_2\,\bar\theta_{fl}`.

    Bulk temperature and mean flash temperature along the path, with a weight C_2. Source: ISO/TS 6336-21 (before
    ISO/TR 13989-2); its form is from memory, without a second source.

    >>> round(float(integral_temperature(363.15, 30.0, 1.5)), 2)
    408.15
    """
    return np.asarray(bulk_temperature + flash_weight * mean_flash_temperature)


def integral_safety(integral_temperature: np.ndarray, scuffing_temperature: float) -> np.ndarray:
    r"""Safety against scuffing by the integral temperature (-), :math:`S_{int} = \theta_{S,int}/\theta_{int}`.

    Of temperatures that count from 0 degC. Source: ISO/TS 6336-21; its form is from memory, without a second source.

    >>> float(integral_safety(373.15, 473.15))
    2.0
    """
    zero = 273.15
    return np.asarray((scuffing_temperature - zero) / (integral_temperature - zero))


def specific_film(
    radius: np.ndarray,
    hertz_pressure: np.ndarray,
    entrainment_speed: np.ndarray,
    reduced_modulus: np.ndarray,
    mean_roughness: np.ndarray,
    entering_viscosity: np.ndarray,
    entering_coefficient: np.ndarray,
    bulk_rise: np.ndarray,
    flash_temperature: np.ndarray,
    oil_temperature: np.ndarray,
    oil_density: np.ndarray,
    temperature_viscosity: np.ndarray,
    coefficient_fall: np.ndarray,
) -> np.ndarray:
    r"""Local film thickness over mean roughness by which micropitting is rated (-).

    .. math:: \lambda = \frac{h}{R_a},\quad h = 1.6\,R\,G^{0.6}U^{0.7}W^{-0.13}S^{0.22},\quad
              G = \alpha_M E',\ U = \frac{\eta_M u}{E'R},\ W = 2\pi\frac{p_0^2}{E'^2},\
              S = \frac{\alpha_B\eta_B}{\alpha_M\eta_M}

    with the oil at the temperature of the teeth (M) and of the contact (B). The viscosities of ASTM D341 make the form
    belong to Pa s and kg/m^3. Source: ISO/TS 6336-22 (before ISO/TR 15144-1), 1600 for lengths in mm and films in um;
    constants as in D. Jbily and others, Procedia Structural Integrity 57 (2024) 199, equation 10.

    >>> contact = (8.3262e-3, 0.9642e9, 2.1630, 226.374e9, 0.2e-6)
    >>> warmth = (333.15, 819.6, 0.03, 0.0036)
    >>> cool = specific_film(*contact, 0.01489, 14.81e-9, 0.0, 0.0, *warmth)
    >>> round(float(cool) * 0.2, 4)   # um: 1.6 of 8326.2 um, G 3352.6, U 1.709e-11, W 1.140e-4
    0.1642
    >>> bool(specific_film(*contact, 0.01489, 14.81e-9, 0.0, 50.0, *warmth) < 0.8 * cool)
    True
    """
    rises = bulk_rise, bulk_rise + flash_temperature
    teeth, contact = (
        warmed_viscosity(entering_viscosity, oil_density, temperature_viscosity, oil_temperature, rise)
        for rise in rises
    )
    share, hot = (np.maximum(1.0 - coefficient_fall * rise, 0.2) for rise in rises)
    groups = (
        power(share * entering_coefficient * reduced_modulus, 0.6)
        * power(teeth * entrainment_speed / (reduced_modulus * radius), 0.7)
        * power(2.0 * np.pi * (hertz_pressure / reduced_modulus) ** 2, -0.13)
        * power(hot * contact / (share * teeth), 0.22)
    )
    return np.asarray(1.6 * radius * groups / mean_roughness)
