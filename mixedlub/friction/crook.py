"""Friction after Crook: a Newtonian film with shear heating."""

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.laws.contact import mean_hertz_pressure
from mixedlub.laws.heating import shear_heating


@friction_law(
    "Crook's thermal theory",
    "contact",
    sources=2,
    status="derived: the exact solution of a film between walls of one temperature, checked by a numerical one",
)
def crook(
    contact_viscosity: np.ndarray,
    viscosity: np.ndarray,
    temperature_viscosity: np.ndarray,
    oil_conductivity: float,
    sliding_speed: np.ndarray,
    film_thickness: np.ndarray,
    hertz_pressure: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of a Newtonian film with shear heating (-).

    .. math:: \mu = \frac{\eta_p v_s}{h\,\bar p}\,\frac{\operatorname{asinh} x}{x\sqrt{1 + x^2}},\quad
              x^2 = \frac{\beta_p\,\eta_p\,v_s^2}{8 k_f}

    for a viscosity that falls exponentially, by beta_p per kelvin at the pressure of the contact, between walls at
    the temperature of the oil; the mean Hertz pressure. Friction falls as sliding grows. No asperities and no Eyring
    stress: above the Eyring stress of the oil it overrates friction.

    Source: A. W. Crook, Phil. Trans. R. Soc. A 254 (1961) 237, the film with heat conducted to its walls.

    >>> slow = crook(10.0, 0.02, 0.0, 0.14, 1.0, 1e-6, 1e9)   # no softening: the Newtonian film
    >>> round(float(slow) * 0.25 * np.pi * 1e9 / 10.0 / 1e6, 6)
    1.0
    >>> x = 1.0
    >>> softening = 1 + np.log(10.0 / 0.02) / (np.log(0.02) + 9.67)   # at the pressure of the contact
    >>> hot = crook(10.0, 0.02, 8 * 0.14 * x**2 / 10.0 / softening, 0.14, 1.0, 1e-6, 1e9)
    >>> round(float(hot / slow), 5)
    0.62323
    """
    square = shear_heating(contact_viscosity, viscosity, temperature_viscosity, oil_conductivity, sliding_speed)
    x = np.sqrt(np.maximum(square, 1e-16))
    newtonian = contact_viscosity * sliding_speed / film_thickness / mean_hertz_pressure(hertz_pressure)
    return newtonian * np.arcsinh(x) / (x * np.sqrt(1.0 + x**2))
