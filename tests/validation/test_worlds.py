"""Traction, oils and load sharing that rigs of the proof follow, against papers and independent computations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from mixedlub.validation.contact import Calibration, Oil, shear, start, touch
from mixedlub.validation.planted.shear import film_heating
from mixedlub.validation.rigs import discs
from mixedlub.validation.worlds import follow
from mixedlub.validation.worlds.oils import OilBy, barus, free_volume, mcewen, modulus, roelands
from mixedlub.validation.worlds.sharing import by_iso_6336, equal, trapezoid
from mixedlub.validation.worlds.traction import (
    at_mean_pressure,
    carreau,
    grown_as_li_kahraman,
    of_limiting_stress,
    over_contact,
)


def _mean_by_integral(c, place):
    """Friction of one contact: the stress over a line contact integrated numerically, over the load."""

    def stress(x):
        there = replace(c, pressure=np.sqrt(1 - x**2) * c.pressure)
        return float(shear(there).stress[0, place])

    return 4 / np.pi * quad(stress, 0, 1, limit=200)[0]


def test_traction_over_a_line_contact_is_the_integral(contact):
    for place in (0, 1):
        assert over_contact(contact)[0, place] == pytest.approx(_mean_by_integral(contact, place), rel=2e-3)


def test_traction_over_a_point_contact_is_the_integral(ball):
    def stress(r):
        return float(shear(replace(ball, pressure=np.sqrt(1 - r**2) * ball.pressure)).stress[1, 0]) * 2 * r

    assert over_contact(ball)[1, 0] == pytest.approx(1.5 * quad(stress, 0, 1, limit=200)[0], rel=2e-3)


def test_a_newtonian_oil_of_even_viscosity_shears_alike_at_any_pressure(contact):
    """Friction is tau over the mean pressure then, whichever average is taken."""
    flat = follow(contact, "thick", lambda c, warmer=0.0: c.viscosity + 0 * c.pressure)
    flat = replace(flat, eyring_stress=1e12 + 0 * flat.eyring_stress)
    expected = flat.viscosity * flat.sliding / flat.film * 4 / np.pi
    assert at_mean_pressure(flat) == pytest.approx(expected, rel=1e-6)
    assert over_contact(flat) == pytest.approx(expected, rel=1e-4)


def test_the_eyring_stress_of_bair_and_winer_grows_as_the_coefficient_falls(contact):
    """Barus' coefficient does not fall, and at the temperature of the data sheet the stress is that of the sheet."""
    cold = start(replace(contact.rig, temperature=np.array([40.0])), Calibration())
    cold = replace(contact, temperature=cold.temperature, viscosity=cold.viscosity)
    cold = replace(cold, pressure_viscosity=np.full((1, 1), 18e-9))
    even = follow(cold, "thick", lambda c, warmer=0.0: c.viscosity * np.exp(c.pressure_viscosity * c.pressure))
    assert of_limiting_stress(even) == pytest.approx(shear(even).stress, rel=1e-9)
    assert (of_limiting_stress(cold) > 1.1 * shear(cold).stress).all()


@pytest.mark.literature("Li and Kahraman (2011), Eyring stress of a 75W90")
def test_the_growing_eyring_stress_has_the_ratio_of_the_paper(contact):
    """26.2 MPa at 0.5 GPa and 35.6 MPa at 1 GPa: 1.36 times the stress of the data sheet."""
    c = replace(contact, pressure=np.array([[0.5e9, 1.0e9]]))
    higher = replace(c, eyring_stress=c.eyring_stress * np.array([[1.0, 35.6 / 26.2]]))
    assert grown_as_li_kahraman(c) == pytest.approx(shear(higher).stress, rel=1e-3)


def test_carreau_is_newtonian_at_first_and_a_power_at_last(contact):
    slow, fast = (replace(contact, sliding=rate * contact.sliding) for rate in (1e-9, 1e9))
    assert carreau(slow) == pytest.approx(shear(slow).stress, rel=1e-3)
    assert carreau(replace(fast, sliding=2 * fast.sliding)) / carreau(fast) == pytest.approx(2**0.4, rel=1e-6)


@pytest.mark.parametrize(
    ("law", "values"),
    [
        (barus, {}),
        (roelands, {}),
        (mcewen, {"power": 11.0}),
        (modulus, {"stiffening": 0.5}),
        (free_volume, {"occupied": 0.65}),
    ],
)
def test_laws_of_viscosity_under_pressure_share_the_coefficient_and_stay_below_barus(law, values):
    """The slope of the logarithm at rest is alpha."""
    level, alpha, celsius = np.array(6.0), np.array(18e-9), np.array(60.0)
    assert law(alpha, np.array(1e4), celsius, level, **values) / 1e4 == pytest.approx(18e-9, rel=2e-3)
    pressure = np.array([0.2e9, 0.7e9, 1.5e9])
    risen = law(alpha, pressure, celsius, level, **values)
    assert (np.diff(risen) > 0).all()
    assert (risen <= 1.0001 * alpha * pressure).all()


def test_roelands_here_is_that_of_the_base_model(pressed):
    """80.1, 70.2 and 13.1 Pa s at the reference points, by another program."""
    level = np.log(pressed.viscosity) + 9.67
    risen = roelands(pressed.pressure_viscosity, pressed.pressure, pressed.temperature, level)
    assert (pressed.viscosity * np.exp(risen))[0] == pytest.approx([80.1, 70.2, 13.1], rel=0.01)


def test_an_oil_by_another_law_keeps_the_two_viscosities_of_its_data_sheet():
    oil = Oil((40.0, 100.0), (30e-6, 6.2e-6), (18e-9, 14e-9))
    other = OilBy(**vars(oil))
    known = np.array([40.0, 100.0])
    assert other.viscosity_at(known) == pytest.approx(oil.viscosity_at(known))
    assert other.viscosity_at(np.array(70.0)) > oil.viscosity_at(np.array(70.0))


@pytest.mark.literature("ISO/TR 15144-1, a third rising to two thirds")
@pytest.mark.parametrize("law", [equal, trapezoid, by_iso_6336])
def test_pairs_of_teeth_carry_the_whole_force_together(law):
    ratio = 1.6
    place = np.linspace(0.001, 0.999, 200)
    later = place + 1
    inside = later < ratio
    total = law(place, ratio) + np.where(inside, law(later, ratio), 0.0)
    assert total == pytest.approx(1.0)
    assert law(place, ratio) == pytest.approx(law(ratio - place, ratio))


@pytest.mark.literature("ISO 6336-1, mesh stiffness c' (0.75 ratio + 0.25)")
def test_the_parabola_of_iso_6336_has_the_mesh_stiffness_of_the_standard():
    """Stiffness in units of c', averaged over one base pitch, at contact ratios from 1.2 to 1.8."""
    for ratio in (1.2, 1.5, 1.8):
        x = np.linspace(0, ratio, 20001)
        pair = 1 - 0.75 * (1 - 1 / ratio) * (2 * x / ratio - 1) ** 2
        assert np.trapezoid(pair, x) == pytest.approx(0.75 * ratio + 0.25, rel=1e-6)
        entering = pair[0] / (pair[0] + np.interp(1.0, x, pair))
        assert by_iso_6336(np.array(0.0), ratio) == pytest.approx(entering, rel=1e-6)


def test_heating_is_in_balance_whichever_law_the_oil_follows(contact):
    """The base law put in place as if it were another one is heated alike."""
    from mixedlub.validation import contact as base

    sheared = shear(touch(contact))
    other = follow(sheared, "shear", lambda c, warmer=0.0: base.sheared(c, base.thick(c, warmer)))
    assert film_heating(other, 1.0).stress == pytest.approx(film_heating(sheared, 1.0).stress, rel=1e-5)


def test_a_disc_without_laws_is_the_base_model():
    rig = discs.draw(np.random.default_rng(1))
    assert rig.nature is rig
    z = np.zeros(len(rig.names))
    assert np.array_equal(rig.records(z, ()), rig.model(z, ()))
