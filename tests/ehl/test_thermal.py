"""Thermal, non-Newtonian contacts against reference solutions of another program, and limits with known answers."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from mixedlub.ehl.levels import solve_levels
from mixedlub.ehl.measures import measures
from mixedlub.ehl.oil import shear
from tests.ehl.contacts import EYRING, by_pressure, contacts, roelands_oil

CARREAU = partial(shear.carreau, shear_modulus=3e6, power=0.5)
CASES = {
    "T1": ((0.01489, 14.81, 333.15, 0.030, EYRING[5], 5e6), (8.6914e-3, 0.9437e9, 1.8658, 2.6176)),
    "T2": ((0.035, 17.0, 333.15, 0.036, EYRING[6], 6e6), (8.4e-3, 1.3e9, 3.3, 5.5)),
    "T3": ((0.0106, 9.68, 373.15, 0.024, EYRING[10], 10e6), (5e-3, 2.0e9, 3.75, 6.25)),
    "T4": ((0.0087, 14.2, 343.15, 0.029, EYRING[5], 5e6), (7.6e-3, 1.35e9, 7.05, 12.05)),
    "T5": ((0.0075, 11.3, 353.15, 0.0276, EYRING[5], 5e6), (15e-3, 1.2e9, 30.0, 50.0)),
    "T6": ((0.02, 15.0, 333.15, 0.03, CARREAU, 3e6), (10e-3, 1.0e9, 1.5, 2.5)),
    "T7": ((0.02, 15.0, 333.15, 0.03, shear.newton, 1e9), (10e-3, 0.8e9, 1.9, 2.1)),
}
"""Oil (Pa s, 1/GPa, K, 1/K, law, its scale of stress) and contact (m, Pa, m/s)."""
FILMS = {
    "T1": (0.18715, 0.15903, 0.01974),
    "T2": (0.5054, 0.4029, 0.02322),
    "T3": (0.12919, 0.10802, 0.01413),
    "T4": (0.28154, 0.22687, 0.01672),
    "T5": (0.5295, 0.4603, 0.00518),
    "T6": (0.21466, 0.17892, 0.02127),
    "T7": (0.23465, 0.20168, 0.01857),
}
"""Central and minimum film (um) and friction, by another program with 481 nodes and 13 across."""
RISES = {
    "T1": (8.04, 6.02, 5.49),
    "T2": (60.4, 25.2, 19.5),
    "T3": (28.2, 22.1, 19.3),
    "T4": (58.8, 27.5, 21.5),
    "T5": (99.6, 21.5, 16.8),
    "T6": (14.8,),
    "T7": (2.49,),
}
"""Largest rise in the middle of the film and of both walls (K), by the same."""
TEMPERATURES = ("largest_film_temperature", "largest_first_wall_temperature", "largest_second_wall_temperature")


def found(oil, cases, thermal=True):
    solved = solve_levels(oil, cases, thermal=thermal)
    assert not np.any(solved.stopped_at)
    return measures(oil, cases, solved.fine, thermal=thermal)


def case(name, **changes):
    (eta, alpha, known, beta, law, scale), body = CASES[name]
    oil = roelands_oil(law, scale=scale, known=known, eta=eta, alpha=alpha * 1e-9, beta=beta, **changes)
    return oil, by_pressure(*body, known)


@pytest.fixture(scope="module")
def every():
    return {name: found(*case(name)) for name in CASES}


@pytest.mark.parametrize("name", CASES)
def test_films_and_friction_of_the_reference_cases(name, every):
    own = every[name]
    values = [own["central_film"][0] * 1e6, own["minimum_film"][0] * 1e6, own["friction_coefficient"][0]]
    assert values == pytest.approx(FILMS[name], rel=0.02)


@pytest.mark.parametrize("name", CASES)
def test_temperatures_of_the_reference_cases(name, every):
    rises = [every[name][key][0] - CASES[name][0][2] for key in TEMPERATURES[: len(RISES[name])]]
    assert rises == pytest.approx(RISES[name], rel=0.05)


@pytest.mark.parametrize("name", CASES)
def test_walls_and_oil_take_the_heat_that_shear_makes(name, every):
    assert abs(every[name]["heat_imbalance"][0]) < 0.01


@pytest.mark.literature("C. A. Biboulet, L. Houpert, Proc. IMechE J 224 (2010) 777: 182 W/m of rolling in this contact")
def test_what_is_not_sliding_is_rolling(every):
    assert every["T1"]["rolling_power"][0] == pytest.approx(182.0, rel=0.02)


def test_friction_changes_sign_with_sliding_and_nothing_else_changes():
    oil, slow_first = case("T2")
    fast_first = replace(slow_first, first=slow_first.second, second=slow_first.first)
    one, other = found(oil, slow_first), found(oil, fast_first)
    assert one["friction_coefficient"][0] == pytest.approx(-other["friction_coefficient"][0], rel=1e-6)
    assert one["central_film"][0] == pytest.approx(other["central_film"][0], rel=1e-6)
    assert one["heat_to_first_wall"][0] == pytest.approx(other["heat_to_second_wall"][0], rel=1e-6)


def test_pure_rolling_has_no_sliding_friction():
    oil, sliding = case("T2")
    rolling = replace(
        sliding,
        first=replace(sliding.first, speed=sliding.speed),
        second=replace(sliding.second, speed=sliding.speed),
    )
    own = found(oil, rolling)
    assert abs(own["friction_coefficient"][0]) < 1e-9
    assert own["rolling_power"][0] > 0.0


def test_little_sliding_is_newtonian():
    """Friction over sliding speed is the integral of viscosity over film, at the temperature of the oil."""
    oil, _ = case("T1")
    cases = by_pressure(8.6914e-3, 0.5e9, 2.2417 - 1e-6, 2.2417 + 1e-6, 333.15)
    own = found(oil, cases)
    viscosity = np.exp(oil.log_viscosity(own["pressure"][0], own["film_temperature"][0])[0])
    place, inside = own["position"][0], own["pressure"][0] > 0.0
    stress = np.where(inside, viscosity * cases.sliding / own["film"][0], 0.0)
    wanted = np.trapezoid(stress, place) / cases.line_load
    assert own["friction_coefficient"][0] == pytest.approx(wanted[0], rel=5e-3)


def test_oil_that_conducts_well_is_as_warm_as_its_walls():
    own = found(*case("T2", conductivity=1e4))
    across = own["film_temperature"][0] - 0.5 * (own["first_wall_temperature"] + own["second_wall_temperature"])[0]
    assert np.max(np.abs(across)) < 0.1
    assert own["largest_first_wall_temperature"][0] > CASES["T2"][0][2] + 10.0


def test_walls_that_conduct_well_stay_at_their_bulk_temperature():
    (*_, known, _, _, _), body = CASES["T2"]
    oil, cold = case("T2")
    cases = contacts(cold.radius, cold.line_load, *body[2:], known, steel=1e9)
    own = found(oil, cases)
    assert own["largest_first_wall_temperature"][0] - known < 0.1
    assert own["largest_film_temperature"][0] > known + 20.0


def test_friction_of_an_eyring_oil_is_near_its_plateau():
    """Isothermal, at the mean pressure: mu between those of the mean and of the largest pressure."""
    oil, cases = case("T1")
    own = found(oil, cases, thermal=False)
    film = own["central_film"]
    for share, compare in ((0.5, np.greater), (1.0, np.less)):
        viscosity = np.exp(oil.log_viscosity(share * cases.pressure, cases.oil_temperature)[0])
        plateau = 5e6 * np.arcsinh(viscosity * cases.sliding / (film * 5e6)) / (0.25 * np.pi * cases.pressure)
        assert compare(own["friction_coefficient"], plateau)


def test_a_limiting_stress_limits_the_friction():
    oil, cases = case("T1")
    limited = partial(shear.limiting, limiting_stress=1e6, limiting_growth=0.04)
    oil = replace(
        oil,
        shear=limited,
        newtonian=False,
        stress_scale=lambda p: 1e6 + 0.04 * p,
        stress_limit=lambda p: 1.2e6 + 0.048 * p,
    )
    own = found(oil, cases)
    assert 0.03 < own["friction_coefficient"][0] < 0.045


def test_a_batch_gives_what_each_contact_gives_alone():
    oil, one = case("T1")
    three = one.take(np.zeros(3, dtype=int))
    three = replace(three, line_load=three.line_load * np.array([1.0, 0.5, 1.5]))
    together = found(oil, three)
    assert together["friction_coefficient"][0] == pytest.approx(found(oil, one)["friction_coefficient"][0], rel=1e-5)
    assert len(set(together["central_film"])) == 3
