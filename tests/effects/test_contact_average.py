"""Film friction as the mean over the contact: integrals of Hertz pressure, and full solutions."""

import numpy as np
import pytest
from scipy.integrate import quad

from mixedlub import ehl
from mixedlub.effects.contact_average import contact_average
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.laws import contact, oil, shear
from mixedlub.rig.lubricant import Lubricant

ETA, ALPHA, FILM, STRESS = 0.02, 18e-9, 0.3e-6, 5e6


def by_integral(pressure, sliding, of_point):
    """Mean stress over mean pressure, over both at the largest pressure."""

    def stress(place):
        there = oil.roelands_viscosity(ETA, ALPHA, pressure * np.sqrt(1.0 - place**2))
        return float(shear.ree_eyring(there, sliding, FILM, STRESS)) * (2.0 * place if of_point else 1.0)

    mean = quad(stress, 0.0, 1.0, epsabs=0.0, epsrel=1e-8)[0]
    return mean / stress_at_middle(pressure, sliding) * (1.5 if of_point else 4.0 / np.pi)


def stress_at_middle(pressure, sliding):
    return float(shear.ree_eyring(oil.roelands_viscosity(ETA, ALPHA, pressure), sliding, FILM, STRESS))


@pytest.mark.parametrize(("of_point", "near"), [(False, 0.01), (True, 0.03)])
@pytest.mark.parametrize("sliding", [1e-5, 0.01, 1.0])
@pytest.mark.parametrize("pressure", [0.5e9, 1.0e9, 1.5e9])
def test_four_places_are_the_integral_over_the_contact(pressure, sliding, of_point, near):
    mean = contact.point_mean_pressure(pressure) if of_point else contact.mean_hertz_pressure(pressure)
    given = (oil.roelands_viscosity(ETA, ALPHA, pressure), ETA, ALPHA, pressure, mean, sliding, FILM, STRESS)
    found = contact_average(1.0, *given, share=1.0)
    assert found == pytest.approx(by_integral(pressure, sliding, of_point), rel=near)


def test_full_solutions_have_the_mean_over_the_contact():
    """Isothermal friction is within 7 % of the mean, and at little sliding far from the largest pressure's."""
    slide = np.array([0.005, 0.05, 0.3, 1.0])
    known = Lubricant("oil", (313.15, 373.15), (60e-6, 8.5e-6), (20e-9, 15e-9), 865.0, 7e-4, STRESS, 0.14, 2000.0)
    given = {"radius": 0.01, "line_load": 2e5, "speed": 3.0, "oil_temperature": 353.15}
    solved = ehl.solve(from_lubricant(known), sliding_speed=3.0 * slide, thermal=False, **given)
    pressure = contact.line_hertz_pressure(2e5, 0.01, 206e9 / (1.0 - 0.3**2))
    warm = known.inputs(np.array(353.15))
    thick = oil.roelands_viscosity(warm["viscosity"], warm["pressure_viscosity"], pressure)
    film = solved.central_film.values
    largest = shear.ree_eyring(thick, 3.0 * slide, film, STRESS)
    given = (thick, warm["viscosity"], warm["pressure_viscosity"], pressure, contact.mean_hertz_pressure(pressure))
    mean = contact_average(largest, *given, 3.0 * slide, film, STRESS, share=1.0) / pressure
    friction = np.abs(solved.friction_coefficient.values)
    assert friction == pytest.approx(mean, rel=0.07)
    assert friction[0] < 0.7 * largest[0] / pressure


def test_contacts_at_rest_or_without_pressure_keep_numbers():
    given = {"viscosity": 0.01, "pressure_viscosity": 2e-8, "film_thickness": 1e-6, "eyring_stress": STRESS}
    pressures = {"hertz_pressure": np.array([0.0, 1e9]), "mean_pressure": np.array([0.0, 0.785e9])}
    found = contact_average(
        1.0, np.array([0.01, 50.0]), sliding_speed=np.array([1.0, 0.0]), share=1.0, **given, **pressures
    )
    assert np.all(np.isfinite(found))
    assert found[1] == 1.0
