"""Emulator against solutions, formulas in their limit, ranges, and what is refused."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.ehl.run import Rows
from mixedlub.full_base import store
from mixedlub.full_base.box import CONDITIONS, FACTORS
from mixedlub.full_base.emulator import Emulator, inputs_of, laws, trained
from mixedlub.full_base.solutions import Matter, Varied, drawn, solved
from mixedlub.solutions import kept
from profiles.errors import InputError
from tests.full_base.conftest import BOX, rows_of, varied


def errors_of(found: Emulator, matter: Matter, rows: Rows, contacts: Varied) -> tuple[np.ndarray, np.ndarray]:
    """Errors of the logarithms of film and friction."""
    state = inputs_of(matter, contacts)
    film, friction = laws(state)
    thickness = film * found.ratios(found.film, found.places(state))
    mu = friction(thickness) * found.ratios(found.stress, found.places(state))
    return np.log(thickness / rows["central_film"]), np.log(mu / np.abs(rows["friction_coefficient"]))


def moes_load(contacts: Varied, matter: Matter) -> np.ndarray:
    """Moes' M of contacts."""
    return contacts.moes(*from_lubricant(matter.oil).at_ambient(contacts.oil_temperature))[0]


def rms(error: np.ndarray) -> float:
    return float(np.sqrt(np.mean(error**2)))


def test_shipped_solutions_that_were_left_out_are_emulated(matter: Matter, table: pd.DataFrame) -> None:
    """200 solutions from M 1 to 300 and 0.1 to 50 m/s, far wider than a run needs."""
    out = np.arange(len(table)) % 7 == 3
    contacts, rows = varied(kept.contacts_of(table)), rows_of(table)
    found = trained(matter, BOX, contacts.take(np.flatnonzero(~out)), {n: v[~out] for n, v in rows.items()})
    film, friction = errors_of(found, matter, {n: v[out] for n, v in rows.items()}, contacts.take(np.flatnonzero(out)))
    assert rms(film) < 0.01
    assert rms(friction) < 0.03


def test_equal_rows_are_evaluated_as_single_ones(emulator: Emulator, matter: Matter, table: pd.DataFrame) -> None:
    state = inputs_of(matter, varied(kept.contacts_of(table.head(6))))
    twice = {name: np.tile(np.broadcast_to(value, 6).reshape(2, 3), (3, 1)) for name, value in state.items()}
    once = emulator.ratios(
        emulator.film, emulator.places({name: np.broadcast_to(value, 6) for name, value in state.items()})
    )
    assert emulator.ratios(emulator.film, emulator.places(twice)) == pytest.approx(
        np.tile(once.reshape(2, 3), (3, 1)), rel=1e-12
    )


def test_beyond_the_range_the_ratio_is_that_at_its_end(emulator: Emulator, matter: Matter, table: pd.DataFrame) -> None:
    state = inputs_of(matter, varied(kept.contacts_of(table.head(1))))
    still, slow = (
        emulator.ratios(emulator.stress, emulator.places({**state, "sliding_speed": state["sliding_speed"] * factor}))
        for factor in (0.0, 1e-12)
    )
    assert np.isfinite(still).all()
    assert still == pytest.approx(slow)


def test_a_kept_emulator_is_the_same(cache: object, emulator: Emulator, matter: Matter) -> None:
    found, built = store.emulator(matter, {name: BOX[name] for name in CONDITIONS})
    assert not built
    assert found.errors == emulator.errors
    assert {name: pytest.approx(ends) for name, ends in BOX.items()} == found.box
    assert np.array_equal(found.film.weights, emulator.film.weights)


def test_another_oil_or_body_is_another_emulator(matter: Matter) -> None:
    assert replace(matter, oil=replace(matter.oil, eyring_stress=5.1e6)).digest != matter.digest
    assert replace(matter, bodies=replace(matter.bodies, conductivity=45.0)).digest != matter.digest


def test_unsolved_contacts_are_counted_and_too_many_refused(matter: Matter, table: pd.DataFrame) -> None:
    rows, contacts = rows_of(table), varied(kept.contacts_of(table))
    few, many = ({**rows, "status": np.where(np.arange(200) < n, "no solution", rows["status"])} for n in (10, 11))
    assert trained(matter, BOX, contacts, few).errors.unsolved == 10
    with pytest.raises(InputError, match=r"5\.5 % of the contacts of its range have no full solution"):
        trained(matter, BOX, contacts, many)


def test_contacts_solved_together_share_their_oil(matter: Matter) -> None:
    found = drawn(matter, BOX, 40)
    assert [len(np.unique(found.factors[start : start + 16], axis=0)) for start in (0, 16, 32)] == [1, 1, 1]
    assert len(np.unique(found.factors, axis=0)) == 3
    box = {name: BOX[name] for name in CONDITIONS}
    assert (drawn(matter, box, 8).factors == 1.0).all()


def test_isothermal_films_are_those_of_the_formula(matter: Matter, table: pd.DataFrame) -> None:
    """Dowson and Toyoda state 9 to 29 % above compressible solutions at gear conditions."""
    found = trained(matter, BOX, varied(kept.contacts_of(table)), rows_of(table, "isothermal"))
    contacts = gear_like(matter)
    over = 1.0 / found.ratios(found.film, found.places(inputs_of(matter, contacts)))
    assert over.min() > 1.09
    assert over.max() < 1.29


def gear_like(matter: Matter) -> Varied:
    """Contacts of a gear pair in the middle of its range."""
    box = {
        "radius": (7e-3, 10e-3),
        "hertz_pressure": (0.6e9, 1.2e9),
        "entrainment_speed": (1.0, 5.0),
        "slide_roll_ratio": (0.05, 0.2),
        "oil_temperature": (333.15, 353.15),
    }
    return drawn(matter, box, 64)


@pytest.mark.long
def test_newtonian_films_without_heat_are_those_of_the_formula(matter: Matter) -> None:
    """The limit itself: Dowson and Toyoda state 9 to 29 % above compressible solutions."""
    newton = replace(matter, thermal=False, oil=replace(matter.oil, eyring_stress=1e12))
    box = {
        "radius": (8e-3, 10e-3),
        "hertz_pressure": (0.5e9, 0.7e9),
        "entrainment_speed": (1.0, 2.0),
        "slide_roll_ratio": (0.02, 0.05),
        "oil_temperature": (343.15, 353.15),
    }
    contacts = drawn(newton, box, 160)
    found = trained(newton, box, contacts, solved(newton, contacts))
    assert found.errors.film_95 < 1e-3
    over = 1.0 / found.ratios(found.film, found.places(inputs_of(newton, drawn(newton, box, 64, seed=9))))
    assert over.min() > 1.09
    assert over.max() < 1.29


@pytest.mark.long
def test_a_gear_study_is_emulated_within_its_goals(matter: Matter) -> None:
    """Film within 0.3 % rms and friction within 0.7 % of fresh solutions, 95 % within 0.8 and 2 %."""
    box = {
        "radius": (3e-3, 16e-3),
        "hertz_pressure": (0.4e9, 1.4e9),
        "entrainment_speed": (1.0, 15.0),
        "slide_roll_ratio": (0.02, 1.2),
        "oil_temperature": (313.15, 373.15),
    }
    contacts = drawn(matter, box, store.SOLUTIONS)
    found = trained(matter, box, contacts, solved(matter, contacts))
    fresh = drawn(matter, box, 128, seed=77)
    film, friction = errors_of(found, matter, solved(matter, fresh), fresh)
    assert rms(film) < 0.003
    assert rms(friction) < 0.007
    assert np.quantile(np.abs(film), 0.95) < 0.008
    assert np.quantile(np.abs(friction), 0.95) < 0.02


@pytest.mark.long
def test_slopes_of_the_oil_are_differences_of_the_solver(matter: Matter) -> None:
    """Change of film and friction with each property of the oil, in a range of a gear pair."""
    box = {
        "radius": (4e-3, 10e-3),
        "hertz_pressure": (0.4e9, 1.26e9),
        "entrainment_speed": (0.63, 5.0),
        "slide_roll_ratio": (0.02, 1.26),
        "oil_temperature": (323.15, 363.15),
        "viscosity": (0.8, 1.25),
        "pressure_viscosity": (0.8, 1.25),
        "eyring_stress": (0.63, 1.6),
    }
    contacts = drawn(matter, box, store.WITH_FACTORS)
    found = trained(matter, box, contacts, solved(matter, contacts))
    step = 0.05
    few = drawn(matter, {name: box[name] for name in CONDITIONS}, 32, seed=5)
    few = few.take(np.flatnonzero(moes_load(few, matter) > 2.0))
    for place, name in enumerate(FACTORS):
        ends = [replace(few, factors=few.factors * np.exp(sign * step * np.eye(3)[place])) for sign in (1.0, -1.0)]
        states = [inputs_of(matter, end) for end in ends]
        rows = [solved(matter, end) for end in ends]
        solver = np.log(rows[0]["friction_coefficient"] / rows[1]["friction_coefficient"]) / (2.0 * step)
        emulated = []
        for state in states:
            film, friction = laws(state)
            emulated.append(
                friction(film * found.ratios(found.film, found.places(state)))
                * found.ratios(found.stress, found.places(state))
            )
        own = np.log(emulated[0] / emulated[1]) / (2.0 * step)
        assert rms(own - solver) < 0.02 * rms(solver), name
