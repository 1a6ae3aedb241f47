"""The generator's own solver of line contacts: published films, limits with exact answers, and the package's solver."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub import ehl
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.rig.lubricant import Lubricant
from mixedlub.validation.contact import KELVIN, ROELANDS_PRESSURE, Oil, Solid
from mixedlub.validation.solved.fluid import Fluid, carreau, eyring, fluid_of, limited, newton
from mixedlub.validation.solved.fluid import dowson_higginson as denser
from mixedlub.validation.solved.solver import Place, film_of_moes, solve

COEFFICIENT, EXPONENT, MODULUS = 20e-9, 0.65, Solid().reduced
REST = float(np.exp(COEFFICIENT * 1.96e8 / EXPONENT - 9.67))
SHEET = ((40.0, 100.0), (60e-6, 8.5e-6), (20e-9, 15e-9), 865.0, 7e-4, 5e6, 0.14, 2000.0)
OIL = Oil(*SHEET)


NEWTON = newton()


def houpert(rest, slope, celsius, fall):
    """Roelands' law in Houpert's form, from viscosity (Pa s), slope (1/Pa) and fall (1/K) at one temperature."""
    level = np.log(rest) + 9.67
    power, thinning = slope * ROELANDS_PRESSURE / level, fall * (celsius + KELVIN - 138) / level

    def law(pressure, now):
        warm = ((now + KELVIN - 138) / (celsius + KELVIN - 138)) ** -thinning
        return level * (1 + np.maximum(pressure, 0.0) / ROELANDS_PRESSURE) ** power * warm - 9.67

    return law


def known(law=NEWTON, rest=REST, slope=COEFFICIENT, celsius=40.0, fall=0.03, conductivity=0.14):
    """An oil by Roelands' law that expands with heat in the energy balance alone."""
    return Fluid(
        houpert(rest, slope, celsius, fall),
        lambda p, t: 850 * denser(p),
        law,
        conductivity,
        2000.0,
        lambda t: 6.5e-4,
    )


def by_moes(m, group, radius=10e-3):
    """Conditions by Moes' numbers, for the oil above at pure rolling."""
    twice = (group / (COEFFICIENT * MODULUS)) ** 4
    speed = 0.5 * twice * MODULUS * radius / REST
    return Place(radius, m * np.sqrt(twice) * MODULUS * radius, (speed, speed), 40.0)


def in_moes_units(film, place):
    return film / place.radius / np.sqrt(2 * REST * place.speed / (MODULUS * place.radius))


@pytest.mark.literature("Moes (1992), line contacts in all regimes")
@pytest.mark.parametrize(("m", "group"), [(3.0, 3.0), (10.0, 10.0), (30.0, 3.0), (30.0, 6.0), (100.0, 6.0)])
def test_the_flow_of_a_film_is_that_of_moes(m, group):
    """His film is that of the flow; compression adds 2 to 4 %, and his fit is up to 7 % off."""
    place = by_moes(m, group)
    found = solve(known(), place, thermal=False)
    assert in_moes_units(found.flow_film, place) / 1.03 == pytest.approx(film_of_moes(m, group), rel=0.07)


@pytest.mark.parametrize(
    ("m", "group", "central", "least"),
    [(10.0, 6.0, 3.7053, 3.0788), (30.0, 6.0, 3.0960, 2.6594), (100.0, 3.0, 1.8329, 1.5818)],
)
def test_films_of_a_compressible_oil_are_those_of_another_program(m, group, central, least):
    """Richardson extrapolates of a third solver, with the density of Dowson and Higginson, to 0.1 %."""
    place = by_moes(m, group)
    found = solve(known(), place, thermal=False, cells=288)
    assert in_moes_units(found.central_film, place) == pytest.approx(central, rel=0.01)
    assert in_moes_units(found.least_film, place) == pytest.approx(least, rel=0.01)


CASES = {
    "T1": (
        (0.01489, 14.81e-9, 60.0, 0.030, eyring(5e6)), (8.6914e-3, 0.9437e9, 1.8658, 2.6176), (0.18715, 0.01974, 8.04)
    ),
    "T2": ((0.035, 17e-9, 60.0, 0.036, eyring(6e6)), (8.4e-3, 1.3e9, 3.3, 5.5), (0.5054, 0.02322, 60.4)),
    "T4": ((0.0087, 14.2e-9, 70.0, 0.029, eyring(5e6)), (7.6e-3, 1.35e9, 7.05, 12.05), (0.28154, 0.01672, 58.8)),
    "T5": ((0.0075, 11.3e-9, 80.0, 0.0276, eyring(5e6)), (15e-3, 1.2e9, 30.0, 50.0), (0.5295, 0.00518, 99.6)),
    "T6": ((0.02, 15e-9, 60.0, 0.03, carreau(3e6, 0.5)), (10e-3, 1.0e9, 1.5, 2.5), (0.21466, 0.02127, 14.8)),
}  # fmt: skip
"""Oil, contact, and central film (um), friction and rise in the middle of the film (K) of a third program."""


def contact(name, **changes):
    (rest, slope, celsius, fall, law), (radius, pressure, one, two), _ = CASES[name]
    solid = Solid(density=7850.0)
    load = 2 * np.pi * radius * pressure**2 / solid.reduced
    fluid = known(law, rest, slope, celsius, fall, changes.pop("conductivity", 0.14))
    return fluid, replace(Place(radius, load, (one, two), celsius, solid=solid), **changes)


@pytest.mark.parametrize("name", CASES)
def test_hot_contacts_are_those_of_another_program(name):
    """Rises to 100 K and slide-to-roll ratios to 0.5: film within 1.5 %, friction 1 %, temperature 2 %."""
    fluid, place = contact(name)
    found = solve(fluid, place)
    film, friction, rise = CASES[name][2]
    assert found.central_film * 1e6 == pytest.approx(film, rel=0.015)
    assert found.friction == pytest.approx(friction, rel=0.01)
    assert np.max(found.warmth.middle) - place.celsius == pytest.approx(rise, rel=0.02)


def by_package(radius, load, speed, slide, celsius):
    """Film, friction and temperature rise by the package for the oil of a case."""
    given = {"radius": radius, "line_load": load, "speed": speed, "sliding_speed": slide * speed}
    kelvin = from_lubricant(Lubricant("oil", (313.15, 373.15), *SHEET[1:]))
    found = ehl.solve(kelvin, **given, oil_temperature=celsius + 273.15)
    rise = found.largest_film_temperature.values - 273.15 - celsius
    return found.central_film.values, np.abs(found.friction_coefficient.values), rise


def by_generator(radius, load, speed, slide, celsius):
    place = Place(radius, load, (speed * (1 - slide / 2), speed * (1 + slide / 2)), celsius)
    found = solve(fluid_of(OIL, eyring(5e6)), place)
    return found.central_film, found.friction, np.max(found.warmth.middle) - celsius


def test_contacts_agree_with_the_solver_of_the_package():
    """Other code and another method on the oil of a case: film within 2 %, friction 1 %, temperature rise 2 %."""
    radius, pressure = np.array([7.1e-3, 12e-3, 7.4e-3]), np.array([1.36e9, 0.92e9, 1.0e9])
    speed, slide, celsius = np.array([1.5, 1.7, 10.1]), np.array([0.78, 0.59, 0.30]), np.array([46.0, 92.0, 89.0])
    load = 2 * np.pi * radius * pressure**2 / MODULUS
    for one, other in zip(
        np.transpose(by_package(radius, load, speed, slide, celsius)),
        map(by_generator, radius, load, speed, slide, celsius),
        strict=True,
    ):
        assert other == pytest.approx(one, rel=0.02)
        assert other[1] == pytest.approx(one[1], rel=0.01)


@pytest.mark.parametrize(("slide", "near"), [(1.0, 0.015), (1.5, 0.03)])
def test_fast_sliding_heats_the_inlet_on_one_side(slide, near):
    """Stresses of slip and backflow add near the faster surface: else films are 3 to 7 % thicker."""
    given = (16.8e-3, 4.3e5, 11.0, slide, 65.0)
    (film,), (friction,), _ = by_package(*map(np.atleast_1d, given))
    other = by_generator(*given)
    assert other[:2] == pytest.approx((film, friction), rel=near)


def test_heat_of_shear_goes_into_walls_and_oil():
    """A slow thin film carries almost nothing away."""
    found = solve(*contact("T1"))
    assert found.heat_taken == pytest.approx(found.heat_made, rel=0.01)
    assert found.heat_made == pytest.approx(found.friction * contact("T1")[1].load * 0.7518 + 185.0, rel=0.02)


def test_friction_does_not_know_which_surface_is_the_faster():
    fluid, place = contact("T2")
    other = solve(fluid, replace(place, speeds=place.speeds[::-1]))
    assert other.friction == pytest.approx(solve(fluid, place).friction, rel=0.01)


def test_a_newtonian_film_shears_by_its_viscosity():
    """Friction is the integral of eta v/h over the load at a small slip."""
    fluid = known(newton(), 0.02, 12e-9, 60.0)
    place = Place(10e-3, 5e4, (1.9999, 2.0001), 60.0)
    found = solve(fluid, place, thermal=False)
    widths = np.gradient(found.place)
    full = found.stress > 0
    whole = np.sum((widths * np.exp(fluid.log_viscosity(found.pressure, 60.0)) * place.slip / found.film)[full])
    assert found.friction == pytest.approx(whole / place.load, rel=0.01)


def test_friction_of_a_limited_film_is_at_most_the_limit():
    free, place = contact("T2")
    found = solve(replace(free, law=limited(free.law, 0.02)), place)
    assert found.friction < 0.02
    assert found.friction < 0.9 * solve(free, place).friction
    nearly_free = solve(replace(free, law=limited(free.law, 5.0)), place)
    assert nearly_free.friction == pytest.approx(solve(free, place).friction, rel=1e-3)


def test_a_near_meniscus_starves_the_film():
    fluid, place = contact("T1")
    films = [solve(fluid, replace(place, inlet=inlet), thermal=False).central_film for inlet in (1.1, 1.3, np.inf)]
    assert films[0] < 0.9 * films[1] < 0.9 * films[2] * 1.02


def test_solids_that_conduct_perfectly_stay_cold():
    fluid, place = contact("T2", solid=Solid(conductivity=1e7, density=7850.0))
    found = solve(fluid, place)
    assert np.max(found.warmth.first) - place.celsius < 0.2
    assert np.max(found.warmth.middle) - place.celsius > 20.0


def test_cells_twice_as_many_change_little():
    fluid, place = contact("T1")
    coarse, fine = (solve(fluid, place, cells=cells) for cells in (144, 288))
    assert coarse.central_film == pytest.approx(fine.central_film, rel=0.006)
    assert coarse.friction == pytest.approx(fine.friction, rel=0.003)
