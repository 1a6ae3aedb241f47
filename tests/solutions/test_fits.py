"""Factors and exponents of rigs: planted ones are found, and what a ratio does not depend on changes nothing."""

import numpy as np
import pandas as pd
import pytest

from mixedlub.ehl.oil.file import read_oil
from mixedlub.solutions import fits, laws, ratios, rigs


@pytest.fixture(scope="module")
def grid() -> pd.DataFrame:
    """Two rigs whose contacts are those of a gear, under a film and a stress that are planted."""
    speed, load, rig = (
        v.ravel() for v in np.meshgrid(np.geomspace(1e-12, 8e-12, 4), np.geomspace(3e-5, 2e-4, 4), [1, 2])
    )
    pressure = 0.9 * np.sqrt(load / 1e-4)
    table = pd.DataFrame({"oil": "any", "rig": rig.astype(int), "speed_parameter": speed, "load_parameter": load})
    table["hertz_pressure_GPa"], table["moes_load"] = pressure, load / np.sqrt(2.0 * speed)
    exponent = np.where(rig == 1, -0.04, -0.08)
    for name in (*ratios.FILM_RATIOS, *ratios.TRACTION_RATIOS):
        table[name] = 0.8 * speed**0.01 * load**exponent
    table["slide_roll_ratio"] = np.resize([0.05, 0.3, 0.1, 0.9, 0.02], len(table))
    table["eyring_stress_Pa"] = 5e6
    rate = 2e8 * table["slide_roll_ratio"] ** 0.2
    own = 4e6 * pressure**0.3
    table["isothermal_stress_Pa"] = own * np.arcsinh(rate / own)
    return table.assign(**dict.fromkeys(ratios.STRESSES.values(), rate))


def test_planted_exponents_and_their_spread_between_rigs_are_found(grid: pd.DataFrame) -> None:
    found = fits.summary(fits.of_rigs(grid), grid).set_index(["ratio", "oil"]).loc[("film_over_law", "any")]
    assert found["load_exponent"] == pytest.approx(-0.06)
    assert found["load_exponent_sd"] == pytest.approx(0.02 * np.sqrt(2.0))
    assert found["speed_exponent"] == pytest.approx(0.01)
    assert found["left_rms_of_log"] == pytest.approx(0.0, abs=1e-9)
    assert found["overall_rms_of_log"] > 0.01


def test_an_eyring_stress_that_grows_with_pressure_is_found(grid: pd.DataFrame) -> None:
    found = fits.of_rigs(grid).set_index(["ratio", "rig"]).loc[("eyring_stress", 1)]
    middle = np.exp(np.log(grid.loc[grid["rig"] == 1, "hertz_pressure_GPa"]).mean())
    assert found["pressure_exponent"] == pytest.approx(0.3, rel=1e-4)
    assert found["factor"] == pytest.approx(0.8 * middle**0.3, rel=1e-4)


def test_contacts_that_are_not_flattened_are_left_out(grid: pd.DataFrame) -> None:
    light = grid.assign(moes_load=1.9)
    assert fits.of_rigs(light).empty
    assert fits.summary(fits.of_rigs(light), light).empty
    assert fits.summary(fits.of_rigs(grid), light).loc[0, "rigs"] == 2


@pytest.mark.filterwarnings("ignore:lubricant")
def test_rigs_of_an_oil_are_the_same_for_one_seed_and_differ_for_another() -> None:
    oil = read_oil("m100")
    first, again, other = (rigs.draw(oil, 2, seed).contacts.speed for seed in (3, 3, 4))
    assert first.tolist() == again.tolist()
    assert first.tolist() != other.tolist()


def test_an_oil_without_contacts_in_the_range_is_refused() -> None:
    from dataclasses import replace

    from mixedlub.ehl import example_oil
    from profiles.errors import InputError

    cold = replace(example_oil(), largest_pressure=0.1e9)
    with pytest.raises(InputError, match="0 of 2 rigs"):
        rigs.draw(cold, 2, 1)


def test_laws_beyond_their_range_give_nothing() -> None:
    from mixedlub.ehl import example_oil
    from mixedlub.solutions.rigs import draw

    found = draw(example_oil(), 3, 1).contacts
    state = laws.state_of(example_oil(), found)
    by_name = {one.name: one for one in laws.compared()}
    film = by_name["dowson_toyoda_central"].value(state, {})
    assert (np.isnan(film) == (state["moes_load"] < 2.0)).all()
    assert np.isnan(by_name["misharin"].value(state, {})).any()
