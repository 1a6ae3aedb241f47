"""Shear of the film by other laws than one Ree-Eyring stress at the largest pressure.

Each law gives a stress (Pa); its ratio to the largest Hertz pressure is the friction coefficient of the film.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact, sheared, thick
from mixedlub.validation.rig import SHEAR, Knob, Law
from mixedlub.validation.worlds import follow

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
Warmer = np.ndarray | float


def at(c: Contact, share: float, warmer: Warmer) -> np.ndarray:
    """Ree-Eyring stress at a share of the largest pressure."""
    there = replace(c, pressure=share * c.pressure)
    return sheared(there, thick(there, warmer))


def at_mean_pressure(c: Contact, warmer: Warmer = 0.0) -> np.ndarray:
    """tau(p_m)/p_m with the mean Hertz pressure: pi/4 of the maximum in a line contact, 2/3 in a point contact."""
    mean = 2 / 3 if c.rig.is_point else np.pi / 4
    return np.asarray(at(c, mean, warmer) / mean)


def over_contact(c: Contact, warmer: Warmer = 0.0) -> np.ndarray:
    """Stress integrated over the Hertz ellipse, over the load: isothermal traction of a film of uniform thickness.

    With p = p_0 cos(a) at the place sin(a) of the half width: for a line 4/pi times the integral of tau(p) cos(a) from
    the middle to the edge, for a point 3 times the integral of tau(p) sin(a) cos(a).
    """
    total = np.zeros_like(c.film)
    for node, weight in zip(NODES, WEIGHTS):
        angle = 0.25 * np.pi * (1 + node)
        ring = 3 * np.sin(angle) if c.rig.is_point else 4 / np.pi
        total = total + 0.25 * np.pi * weight * ring * np.cos(angle) * at(c, float(np.cos(angle)), warmer)
    return total


def of_limiting_stress(c: Contact, warmer: Warmer = 0.0) -> np.ndarray:
    """Eyring stress 2 Lambda/alpha(T, p), alpha ln(eta/eta_0)/p (Bair and Winer; Arana, Larranaga and Ulacia 2018).

    Lambda from the data-sheet stress at rest and its first temperature; the stress grows as alpha falls with p and T.
    """
    oil, thickened = c.rig.oil, thick(c, warmer)
    rest = c.viscosity * oil.viscosity_at(c.temperature + warmer) / oil.viscosity_at(c.temperature)
    secant = np.log(thickened / rest) / c.pressure
    cold = c.pressure_viscosity * oil.pressure_viscosity[0] / oil.pressure_viscosity_at(c.temperature)
    return sheared(replace(c, eyring_stress=c.eyring_stress * cold / np.maximum(secant, 1e-10)), thickened)


def li_kahraman(pressure: np.ndarray) -> np.ndarray:
    """Eyring stress (Pa) of a 75W90: tau_a + (tau_e/2) [1 + tanh(h (2 p/(p_s + p_e) - 1))] (Li and Kahraman 2011).

    tau_a = 5 MPa, p_s = 0.5 and p_e = 3.5 GPa, tau_e = tau_a + 0.035 (p_e - p_s), h = 0.035 (p_e - p_s)/tau_e.

    >>> [round(float(1e-6 * li_kahraman(1e9 * np.array(p))), 1) for p in (0.5, 1.0, 1.5, 2.0)]
    [26.2, 35.6, 47.1, 60.0]
    """
    least, rise = 5e6, 0.035 * 3e9
    top = least + rise
    return np.asarray(least + 0.5 * top * (1 + np.tanh(rise / top * (2 * pressure / 4e9 - 1))))


def grown_as_li_kahraman(c: Contact, warmer: Warmer = 0.0) -> np.ndarray:
    """Data-sheet stress at 0.5 GPa, growing with pressure as in Li and Kahraman's 75W90."""
    grown = c.eyring_stress * li_kahraman(c.pressure) / li_kahraman(np.array(0.5e9))
    return sheared(replace(c, eyring_stress=grown), thick(c, warmer))


def carreau(c: Contact, warmer: Warmer = 0.0, index: float = 0.4) -> np.ndarray:
    """eta g [1 + (eta g/G)^2]^((n - 1)/2) at the rate g (Carreau; Newtonian limit G in Bair and Winer).

    G is the Eyring stress of the data sheet, ``index`` the n of the oil, 0.3 to 0.5 for most oils.
    """
    newton = thick(c, warmer) * c.sliding / c.film
    return np.asarray(newton * (1 + (newton / c.eyring_stress) ** 2) ** (0.5 * (index - 1)))


def _law(name: str, source: str, stress: Callable[..., np.ndarray], average: bool = False) -> Law:
    return Law(SHEAR, name, source, lambda c: follow(c, "shear", stress), average=average)


def _of_carreau(c: Contact, index: float) -> Contact:
    return follow(c, "shear", lambda state, warmer=0.0: carreau(state, warmer, index))


EVERY = (
    _law("at the mean pressure", "Johnson and Tevaarwerk 1977", at_mean_pressure, average=True),
    _law("over the Hertz contact", "Evans and Johnson 1986", over_contact, average=True),
    _law("Eyring stress by Bair and Winer", "Arana, Larranaga and Ulacia 2018", of_limiting_stress),
    _law("Eyring stress that grows with pressure", "Li and Kahraman 2011", grown_as_li_kahraman),
    Law(SHEAR, "Carreau", "Carreau 1972, Bair and Winer", _of_carreau, (Knob("index", 0.2, 0.6, (0.3, 0.5)),)),
)
