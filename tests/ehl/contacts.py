"""Contacts of the reference solutions: by Moes' numbers, and by size, pressure and speeds."""

from functools import partial

import numpy as np

from mixedlub.ehl.line_contacts import Contacts, Solids
from mixedlub.ehl.oil import density, shear, viscosity
from mixedlub.ehl.oil.oil import Oil
from mixedlub.laws.contact import reduced_modulus

MODULUS = reduced_modulus((206e9, 206e9), (0.3, 0.3))
EXPONENT, COEFFICIENT, TEMPERATURE = 0.65, 20e-9, 313.15
VISCOSITY = float(np.exp(COEFFICIENT * 1.96e8 / EXPONENT - 9.67))
"""Of the oil with Roelands' exponent 0.65 and 20 per GPa."""
EYRING = {name: partial(shear.ree_eyring, eyring_stress=name * 1e6) for name in (5, 6, 10)}


def roelands_oil(
    law=shear.newton,
    *,
    scale=1e9,
    known=TEMPERATURE,
    eta=VISCOSITY,
    alpha=COEFFICIENT,
    beta=0.03,
    compressible=True,
    expansion=6.5e-4,
    conductivity=0.14,
):
    """An oil that expands with heat in the energy equation, but not in the balance of mass, as in the references."""
    squeezed = partial(density.dowson_higginson, known_temperature=known, expansion=0.0)
    return Oil(
        name="reference",
        log_viscosity=partial(
            viscosity.roelands,
            known_temperature=known,
            viscosity=eta,
            pressure_viscosity=alpha,
            temperature_viscosity=beta,
        ),
        density_ratio=squeezed if compressible else density.incompressible,
        shear=law,
        stress_scale=lambda pressure: np.full_like(pressure, scale),
        stress_limit=lambda pressure: np.full_like(pressure, np.inf),
        newtonian=law is shear.newton,
        density=850.0,
        expansion=lambda p, t: np.full(np.broadcast_shapes(np.shape(p), np.shape(t)), expansion),
        conductivity=conductivity,
        heat_capacity=2000.0,
    )


def contacts(radius, line_load, first_speed, second_speed, temperature, inlet=np.nan, steel=46.0):
    """Steel bodies at the temperature of the oil."""
    arrays = np.broadcast_arrays(*np.atleast_1d(radius, line_load, first_speed, second_speed, temperature, inlet))
    radius, load, first, second, temperature, inlet = (np.array(a, dtype=float) for a in arrays)
    one = np.ones_like(radius)
    walls = [Solids(speed, temperature, steel * one, 7850.0 * one, 470.0 * one) for speed in (first, second)]
    return Contacts(radius, MODULUS * one, load, temperature, inlet, *walls)


def by_moes(load, material):
    """Contacts of the oil without other arguments that have Moes' numbers M and L."""
    load, material = np.broadcast_arrays(*np.atleast_1d(load, material))
    twice = (material / (COEFFICIENT * MODULUS)) ** 4.0
    speed = twice * MODULUS * 0.01 / (2.0 * VISCOSITY)
    return contacts(0.01, load * np.sqrt(twice) * MODULUS * 0.01, speed, speed, TEMPERATURE)


def by_pressure(radius, pressure, first_speed, second_speed, temperature):
    """Contacts with a largest Hertz pressure."""
    return contacts(radius, 2.0 * np.pi * radius * pressure**2 / MODULUS, first_speed, second_speed, temperature)
