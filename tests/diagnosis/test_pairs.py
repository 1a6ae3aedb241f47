"""Which pairs of effects are fitted, and from where; and what a sudden change's place costs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.additions import promising_additions
from mixedlub.diagnosis.inference.change_points import integrate_change_points
from mixedlub.diagnosis.inference.initial_guesses import fit_singles, sample
from mixedlub.diagnosis.inference.map_fit import map_fit
from mixedlub.diagnosis.inference.nested_laws import (
    _linearised,
    _nested,
    linearised_gain,
    published_gain,
    published_odds,
)
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.several import one_in_time

from ..kinds.conftest import BALL, make, system
from .test_inference import problem

__all__ = ["make"]


@pytest.mark.long
def test_two_effects_that_made_the_readings_are_a_promising_pair() -> None:
    """The standard rig with readings of one draw of churning and one of a boundary film."""
    p = problem()
    null_fit = map_fit(p, NOTHING, np.zeros(p.size(NOTHING)))
    draws = tuple(sample(p, name, null_fit) for name in ("churning", "boundary_film_temperature", "tip_relief"))
    change = sum(max(s.change, key=np.linalg.norm) for s in draws[:2])
    made = replace(p, y=null_fit.prediction + p.sd * change)
    singles = fit_singles(made, map_fit(made, NOTHING, null_fit.z), draws)
    pair, start = promising_additions(made, list(singles.values()), draws, 30)[0]
    assert pair == Explanation.of("boundary_film_temperature", "churning")
    assert map_fit(made, pair, start).evidence > max(f.evidence for f in singles.values()) + 20.0


@pytest.mark.parametrize(("viscous", "gained"), [(0.0, (3.0, 8.0)), (0.55, (-np.log(2.0), -0.6))])
def test_half_of_what_is_believed_of_an_effect_is_its_published_law(viscous: float, gained: tuple) -> None:
    """Seal drag after ISO/TR 14179-2 has no power of viscosity to be paid for; another one costs log 2."""
    p = problem(relative=0.002)
    held = replace(p, fixed={"seal_drag": {"viscous": viscous}})
    z = np.append(np.zeros(p.calibration_size), 2.0)
    made = replace(p, y=held.predict(Explanation.of("seal_drag"), z))
    low, high = gained
    free = map_fit(made, Explanation.of("seal_drag"), np.append(z, 0.0))
    assert low <= published_gain(made, free) < high
    assert linearised_gain(made, free) == pytest.approx(published_gain(made, free), abs=0.1)


@pytest.mark.parametrize("relative", [0.002, 0.02])
def test_a_linearised_law_is_no_better_than_its_fit(relative: float) -> None:
    """Drag of bearings by a constant coefficient, laid to another law: far from where the slopes were taken."""
    p = problem(relative=relative)
    name = Explanation.of("bearing_drag")
    z = np.append(np.zeros(p.calibration_size), np.full(p.size(name) - p.calibration_size, 0.8))
    made = replace(p, y=p.predict(name, z))
    free = map_fit(made, name, z)
    for _, law, odds in published_odds(made, free):
        nested, kept = next((one[2], one[3]) for one in _nested(made, free) if one[1] == law)
        assert _linearised(nested, free, kept)[1] - free.evidence < odds + 0.5, law


def test_slopes_of_a_fit_are_the_derivative_within_its_last_step() -> None:
    p = problem(extra=0.1)
    name = Explanation.of("churning")
    fit = map_fit(p, name, np.zeros(p.size(name)))
    exact = p.jacobian(name, fit.z)
    assert np.linalg.norm(fit.slopes - exact) < 0.02 * np.linalg.norm(exact)


@pytest.mark.long
@pytest.mark.parametrize("seed", [5, 6, 9])
def test_the_place_of_a_sudden_change_is_found_and_paid_for(make, seed: int) -> None:
    """A miscounted order above the fifth of 20 films may begin in one gap of 20: a share of what it could be."""
    speed = np.geomspace(0.01, 2.0, 20)
    film = 300.0 * speed**0.67 * (1.0 + 0.01 * np.random.default_rng(seed).standard_normal(speed.size))
    film[15:] += 190.0
    sections = system("film", "film_thickness_nm", contact=BALL)
    held = {"load_N": 20.0, "oil_temperature_C": 40.0, "slide_roll_ratio": 0.0}
    columns = {"entrainment_speed_m_s": speed, **{name: np.full(20, value) for name, value in held.items()}}
    found = diagnose_case(make(sections, {**columns, "film_thickness_nm": film}).folder)
    fit = found.search.fits[Explanation.of("fringe_order")]
    onset = found.search.problem.parameters(Explanation.of("fringe_order"), fit.z)["fringe_order"]["onset"]
    assert film[14] < 1e9 * onset < film[15] - 190.0
    gap = np.log(film[15] - 190.0) - np.log(film[14])
    density = 1.0 / np.log(2e-6 / 1e-8)
    place = found.search.problem.calibration_size + 1
    curvature = 1.0 + fit.weight @ fit.slopes[:, place] ** 2
    laplace = -0.5 * fit.z[place] ** 2 - 0.5 * np.log(curvature)
    paid = integrate_change_points(found.search.problem, fit).evidence - fit.evidence + laplace
    assert paid == pytest.approx(np.log(gap * density), abs=0.7)


@pytest.mark.long
def test_a_law_beside_a_sudden_change_has_the_odds_that_it_has_alone(make) -> None:
    """Whichever law thins a film, the place of a miscounted order beside it is as uncertain as before."""
    speed = np.geomspace(0.01, 4.0, 24)
    film = 300.0 * speed**0.67 * (1.0 + 0.01 * np.random.default_rng(7).standard_normal(speed.size))
    film /= 1.0 + 0.05 * speed**1.28
    sections = system("film", "film_thickness_nm", contact=BALL)
    columns = {"load_N": 20.0, "oil_temperature_C": 40.0, "slide_roll_ratio": 0.0}
    odds = []
    for jump, names in ((0.0, ("inlet_shear_heating",)), (190.0, ("fringe_order", "inlet_shear_heating"))):
        readings = {"film_thickness_nm": np.where(np.arange(24) > 19, film + jump, film)}
        held = {name: np.full(24, value) for name, value in columns.items()}
        found = diagnose_case(make(sections, {"entrainment_speed_m_s": speed, **held, **readings}).folder).search
        (law,) = published_odds(found.problem, found.fits[Explanation.of(*names)])
        odds.append(law[2])
    assert odds[1] == pytest.approx(odds[0], abs=0.3)


@pytest.mark.long
@pytest.mark.parametrize("count", [60, 400])
def test_a_change_whose_place_is_known_costs_no_more_than_laplace_says(make, count: int) -> None:
    """An event spread over many readings has its place from their slope."""
    time = np.linspace(60.0, 7200.0, count)
    friction = 0.1 + 0.03 / (1.0 + np.exp(-(time - 4000.0) / 250.0))
    friction = friction * (1.0 + 0.01 * np.random.default_rng(2).standard_normal(count))
    columns = {"time_s": time, "friction_coefficient": friction}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder).search
    event = Explanation.of("friction_event")
    fit = map_fit(found.problem, event, found.fits[event].z, warm=True)
    assert integrate_change_points(found.problem, fit).evidence == pytest.approx(fit.evidence, abs=0.5)


def test_a_fault_of_the_channel_is_no_second_effect_where_nothing_but_time_moves_either(make) -> None:
    """A temperature that wanders by the way tells a fault from a film no better; a base model that moves does."""
    time = np.linspace(0.0, 7200.0, 60)
    warmth = 118.0 + 2.0 * np.sin(time / 500.0)
    columns = {"time_s": time, "oil_temperature_C": warmth, "friction_coefficient": np.linspace(0.1, 0.11, 60)}
    case = make(system("friction_history", "friction_coefficient"), columns)
    p = Problem.of(case)
    null_fit = map_fit(p, NOTHING, np.zeros(p.size(NOTHING)))
    pair = Explanation.of("sensor_drift", "tribofilm_growth")
    assert one_in_time(pair, p, null_fit)
    assert not one_in_time(pair, p, replace(null_fit, prediction=null_fit.prediction * np.linspace(1.0, 1.5, 60)))
    assert not one_in_time(Explanation.of("boundary_film_temperature", "sensor_drift"), p, null_fit)
    assert not one_in_time(Explanation.of("friction_event", "tribofilm_growth"), p, null_fit)
