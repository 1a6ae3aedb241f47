"""Asperities and mixtures that rigs of the proof follow, against papers and independent computations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from mixedlub.effects import catalogue
from mixedlub.laws.contact import real_area_ratio, summit_separation
from mixedlub.validation.contact import touch
from mixedlub.validation.worlds import random_surface
from mixedlub.validation.worlds.asperities import (
    bush_gibson_thomas,
    greenwood_tripp,
    greenwood_williamson,
    persson,
)
from mixedlub.validation.worlds.films import (
    LINE,
)
from mixedlub.validation.worlds.gaussian import excess
from mixedlub.validation.worlds.mixed import (
    BALANCES,
    balanced,
    by_doleschel,
    by_error_function,
    growth,
    half_load,
    half_load_and_modulus,
    mean_pressure,
    meet,
)
from roughness import mccool


@pytest.mark.parametrize("power", [1.0, 1.5, 2.0, 2.5])
@pytest.mark.parametrize("t", [-2.0, 0.0, 1.0, 3.003])
def test_excess_is_the_integral_it_stands_for(power, t):
    found = quad(lambda s: (s - t) ** power * np.exp(-0.5 * s**2) / np.sqrt(2 * np.pi), t, 14, epsabs=1e-14)[0]
    assert excess(power, np.array(t)) == pytest.approx(found, rel=2e-5)


def test_area_and_pressure_of_greenwood_and_williamson_are_those_of_the_reference(contact):
    """Areas 0.16309 and 0.15449, pressures 2.04 and 1.92 GPa at the second and third reference point."""
    asperities = greenwood_williamson(contact)
    assert asperities.area(contact.film)[0] == pytest.approx([0.16309, 0.15449], rel=5e-3)
    assert 1e-9 * asperities.pressure(contact.film)[0] == pytest.approx([2.04, 1.92], rel=5e-3)
    assert asperities.area(contact.film) == pytest.approx(touch(contact).area, rel=1e-4)


@pytest.mark.literature("Greenwood and Tripp (1970)")
def test_like_surfaces_meet_as_the_paper_has_it(contact):
    """pi^2 (D R s)^2 F_2(h/s) and (16 sqrt(2) pi/15) (D R s)^2 (s/R)^1/2 E* F_5/2(h/s) with D, R of one surface."""
    m0, m2, m4 = contact.rig.moments[0]
    density, radius, height = m4 / (m2 * 6 * np.pi * np.sqrt(3)), 0.375 * np.sqrt(np.pi / (0.5 * m4)), np.sqrt(m0)
    group = (density * radius * height) ** 2
    h = contact.film / height
    modulus = 0.5 * contact.rig.solid.reduced
    found = greenwood_tripp(contact)
    assert found.area(contact.film) == pytest.approx(np.pi**2 * group * excess(2.0, h), rel=1e-6)
    pressure = 16 * np.sqrt(2) * np.pi / 15 * group * np.sqrt(height / radius) * modulus * excess(2.5, h)
    assert found.pressure(contact.film) == pytest.approx(pressure, rel=1e-6)


def test_unlike_spheres_off_their_axes_sum_to_greenwood_and_tripp(contact):
    """Pairs at all distances r, overlapping by w - r^2/(2 (R1 + R2)): area of each pi R w, force 4/3 E* R^1/2 w^3/2."""
    shares = np.array([[[0.7, 0.6, 0.2], [0.3, 0.4, 0.8]]])
    c = replace(contact, rig=replace(contact.rig, shares=shares))
    moments = shares[0] * np.array([c.m0[0, 0], c.m2[0, 0], c.m4[0, 0]])
    density = moments[:, 2] / (moments[:, 1] * 6 * np.pi * np.sqrt(3))
    radius = 0.375 * np.sqrt(np.pi / moments[:, 2])
    both, one = radius.sum(), radius.prod() / radius.sum()
    w, height, modulus = 0.3e-6, c.roughness[0, 0], 0.5 * c.rig.solid.reduced
    reach = np.sqrt(2 * both * w)

    def left(r):
        return w - r**2 / (2 * both)

    area = density.prod() * quad(lambda r: np.pi * one * left(r) * 2 * np.pi * r, 0, reach)[0]
    load = 4 / 3 * modulus * np.sqrt(one)
    force = density.prod() * quad(lambda r: load * left(r) ** 1.5 * 2 * np.pi * r, 0, reach, epsabs=0)[0]
    found = greenwood_tripp(c)
    film = np.array(0.4e-6)
    over = excess(2.0, film / height), excess(2.5, film / height)
    assert found.area(film)[0, 0] / over[0] == pytest.approx(area * (height / w) ** 2, rel=1e-6)
    assert found.pressure(film)[0, 0] / over[1] == pytest.approx(force * (height / w) ** 2.5, rel=1e-6)


@pytest.mark.literature("Nayak (1971)")
def test_summits_are_as_many_as_nayak_counts():
    """m4/(6 pi sqrt(3) m2), which is 1/(3 sqrt(3)) units of m4/(2 pi m2)."""
    assert random_surface.summits()[2].sum() == pytest.approx(1 / (3 * np.sqrt(3)), rel=1e-9)


@pytest.mark.literature("Bush, Gibson and Thomas (1975)")
def test_area_over_pressure_of_bush_gibson_and_thomas_at_light_load():
    """A E* g/p goes to sqrt(2 pi) = 2.507 with the rms slope g = sqrt(2 m2), and is near it from below."""
    area, pressure = random_surface.tables()
    nayak = np.array([2.0, 3.0, 10.0])
    light = random_surface.read(area, nayak, np.full(3, 7.5)) / random_surface.read(pressure, nayak, np.full(3, 7.5))
    ratio = np.sqrt(2) * light
    assert ratio[:2] == pytest.approx(np.sqrt(2 * np.pi), rel=0.02)
    assert 0.93 * np.sqrt(2 * np.pi) < ratio[2] < np.sqrt(2 * np.pi)


def test_summits_drawn_from_a_random_surface_have_the_area_of_the_tables():
    """Height and second derivatives at points without slope are drawn; summits count with their determinant."""
    rng, nayak, separation = np.random.default_rng(3), 6.0, 1.2
    m0, m4 = 1.0, nayak
    covariance = np.array([[m0, -1, -1, 0], [-1, m4, m4 / 3, 0], [-1, m4 / 3, m4, 0], [0, 0, 0, m4 / 3]])
    z, xx, yy, xy = rng.multivariate_normal(np.zeros(4), covariance, 3_000_000).T
    mean, half = -0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    kept = (mean > half) & (z > separation)
    product = (mean**2 - half**2)[kept]
    ratios, factors, _ = random_surface._ellipses()
    factor = np.interp(((mean - half) / (mean + half))[kept], ratios, factors)
    area = np.sum(product * np.pi * (z[kept] - separation) / np.sqrt(product) * factor) / len(z) / (2 * np.pi)
    table = random_surface.read(random_surface.tables()[0], np.array(nayak), np.array(separation))
    assert table == pytest.approx(area, rel=0.01)


@pytest.mark.literature("Persson (2001)")
def test_persson_begins_with_the_root_of_eight_over_pi(contact):
    light = replace(contact, film=contact.film + 3 * contact.roughness)
    steep = 0.5 * contact.rig.solid.reduced * np.sqrt(2 * contact.m2)
    found = persson(light)
    ratio = found.area(light.film) * steep / found.pressure(light.film)
    assert ratio == pytest.approx(np.sqrt(8 / np.pi), rel=1e-3)


@pytest.mark.parametrize(
    ("theory", "name", "within"),
    [
        (greenwood_tripp, "Greenwood and Tripp over mean planes", 0.015),
        (bush_gibson_thomas, "Bush, Gibson and Thomas", 0.015),
        (persson, "Persson", 0.025),
    ],
)
@pytest.mark.parametrize("nayak", [3.0, 10.0, 30.0])
def test_the_catalogue_can_become_a_theory_of_asperities(contact, theory, name, within, nayak):
    c = replace(contact, m4=nayak * contact.m2**2 / contact.m0)
    height = float(c.roughness.flat[0])
    film = height * np.linspace(0.0, 2.5, 11)
    moments = [float(np.ravel(m)[0]) for m in (c.m0, c.m2, c.m4)]
    density, radius = mccool.summit_density(*moments[1:]), mccool.summit_radius(moments[2])
    law = catalogue()["asperity_law"]
    state = (density, mccool.summit_sigma(*moments), mccool.plane_offset(*moments), height, 0.5, 0.5)
    density, spread, plane = law.law(*state, **law.law_values(name))
    area = real_area_ratio(summit_separation(film, plane, spread), density, radius, spread)
    expected = np.array([float(theory(c).area(np.full_like(c.film, h)).flat[0]) for h in film])
    assert area == pytest.approx(expected, rel=within, abs=0.02 * within)


def test_theories_of_one_surface_lie_within_a_factor(contact):
    area = greenwood_williamson(contact).area(contact.film)
    assert bush_gibson_thomas(contact).area(contact.film) == pytest.approx(area, rel=0.5)
    assert (persson(contact).area(contact.film) > area).all()


@pytest.mark.literature("Johnson, Greenwood and Poon (1972)")
@pytest.mark.parametrize(("lighter", "power"), [(half_load, 0.10), (half_load_and_modulus, 0.13)])
def test_the_film_grows_by_the_power_of_its_law(contact, lighter, power):
    """W^-0.10 of the base law; with the modulus too, U^0.69 G^0.56 at constant W give 0.69 - 0.56."""
    assert growth(contact, lighter) == pytest.approx(power, rel=1e-9)


def test_no_balance_is_dealt_whose_film_cannot_grow(contact):
    """Speed and material have one power in Grubin's law, so that load and modulus together leave his film as it is."""
    law = next(one for one in LINE if one.name == "Grubin")
    assert growth(law.enter(contact), half_load_and_modulus) == pytest.approx(0.0, abs=1e-9)
    fixed = next(one for one in BALANCES if one.name == "Gelinck and Schipper")
    assert fixed.fits({"load_balance"})
    assert not fixed.fits({"load_balance", "film_law"})


@pytest.mark.parametrize("theory", [greenwood_williamson, greenwood_tripp, bush_gibson_thomas])
@pytest.mark.parametrize("lighter", [half_load, half_load_and_modulus])
def test_film_and_asperities_carry_the_load_together(contact, ball, theory, lighter):
    for c in (contact, ball):
        asperities = theory(c)
        film, carried = balanced(c, asperities, lighter)
        assert asperities.pressure(film) == pytest.approx(carried * mean_pressure(c), rel=1e-5, abs=1.0)
        assert film == pytest.approx(c.film * (1 - carried) ** -growth(c, lighter), rel=1e-6)
        assert ((carried >= 0) & (carried < 1) & (film >= c.film)).all()


def test_a_thick_film_carries_all(contact):
    thick = replace(contact, film=20 * contact.roughness + 0 * contact.film)
    film, carried = balanced(thick, greenwood_williamson(thick), half_load)
    assert film == pytest.approx(thick.film, rel=1e-6)
    assert carried == pytest.approx(0.0, abs=1e-5)


def test_friction_by_load_is_coulombs_on_the_asperities_part(contact):
    laws = {"balance": half_load, "weight": lambda c, carried: carried}
    shared = meet(replace(contact, rig=replace(contact.rig, laws=laws)))
    _, carried = balanced(contact, greenwood_williamson(contact), half_load)
    assert shared.area == pytest.approx(carried)


@pytest.mark.literature("Arana, Larranaga and Ulacia (2018); Doleschel (2003)")
def test_weights_by_the_film_parameter(contact):
    """1 - erf at 0.5, 1 and 1.5: 0.4795, 0.1573, 0.0339; (1 - x/2)^2 at the film over Ra of 0.5, 1 and 2."""
    share = np.array([[0.5, 1.0]])
    c = replace(contact, film=share * contact.roughness)
    assert by_error_function(c, share) == pytest.approx(np.array([[0.4795, 0.1573]]), abs=1e-4)
    mean = np.sqrt(2 / np.pi) * contact.roughness / np.sqrt(2)
    for x, weight in ((0.5, 0.5625), (1.0, 0.25), (2.0, 0.0)):
        assert by_doleschel(replace(c, film=x * mean + 0 * share), share) == pytest.approx(weight)
