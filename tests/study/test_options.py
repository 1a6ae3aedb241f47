"""Each option does what it says, against values worked out beside the chain."""

import numpy as np
import pytest

from mixedlub.base_model.chains import GEAR_LOSS
from mixedlub.chain.slots import FILM, SLOTS
from mixedlub.study import read_study, run_study
from mixedlub.study.options import study_chain
from mixedlub.study.schema import Options
from profiles.errors import InputError


def results(write_study, **options):
    return run_study(read_study(write_study(options=options)))


def test_mean_contact_pressure_raises_film_friction_by_four_over_pi(write_study):
    smooth = {"fine": {"m0_um2": 1e-5, "m2": 1e-5, "m4_per_um2": 3e-5}}
    base = run_study(read_study(write_study(surfaces=smooth)))
    mean = run_study(read_study(write_study(surfaces=smooth, options={"contact_pressure": "mean"})))
    assert base["area_ratio"].max() < 1e-12
    assert mean["power_loss"] == pytest.approx(base["power_loss"] * 4 / np.pi, rel=1e-12)


def test_secant_viscosity_caps_film_friction(write_study):
    smooth = {"fine": {"m0_um2": 1e-5, "m2": 1e-5, "m4_per_um2": 3e-5}}
    capped = run_study(read_study(write_study(surfaces=smooth, options={"effective_viscosity": "secant"})))
    assert capped["mean_friction"].max() < 5e6 / 0.3e9


def test_barus_exceeds_roelands_and_mean_pressure_is_less(write_study):
    base = results(write_study)["power_loss"]
    assert (results(write_study, viscosity_law="barus")["power_loss"] > base).all()
    assert (results(write_study, viscosity_pressure="mean")["power_loss"] < base).all()


def test_minimum_film_is_three_quarters_of_the_central(write_study):
    central = results(write_study)["film_thickness"]
    minimum = results(write_study, film="dowson_higginson_minimum")["film_thickness"]
    assert np.all((minimum / central > 0.7) & (minimum / central < 0.82))


def test_averages_of_the_paper_exceed_the_integral(write_study):
    """The paper's sliding speed is unweighted by load: 17 % more loss in an outside prototype."""
    ratio = results(write_study, averaging="paper")["power_loss"] / results(write_study)["power_loss"]
    assert np.all((ratio > 1.05) & (ratio < 1.3))


def test_averages_of_the_paper_are_its_equation(write_study):
    study = read_study(write_study(options={"averaging": "paper"}))
    found = run_study(study)
    pair, torque, speed = study.pair, 150.0, 3000.0 * np.pi / 30.0
    mean = 0.25 * (pair.path_end - pair.path_start) * speed * (1 + 1 / pair.gear_ratio)
    friction = found["power_loss"][0, 0, 1, 2] / (mean * torque / pair.base_radius[0])
    assert friction == pytest.approx(found["plain_mean_friction"][0, 0, 1, 2], rel=1e-12)
    half = run_study(read_study(write_study(options={"averaging": "paper"}, boundary_friction=0.05)))
    less = half["power_loss"][0, 0, 1, 2] / (mean * torque / pair.base_radius[0])
    assert friction - less == pytest.approx(0.05 * found["area_ratio"][0, 0, 1, 2], rel=1e-9)


def test_conditions_of_the_gear_are_the_pinions_divided_by_the_ratio(write_study):
    ratio = 26 / 17
    gear = run_study(
        read_study(
            write_study(
                options={"conditions_of": "gear"},
                conditions__torque_Nm=[100.0 * ratio],
                conditions__speed_rpm=[1000.0 / ratio],
            )
        )
    )
    pinion = run_study(read_study(write_study(conditions__torque_Nm=[100.0], conditions__speed_rpm=[1000.0])))
    assert gear["power_loss"] == pytest.approx(pinion["power_loss"], rel=1e-12)


def test_bulk_temperature_rise_is_hotter_oil(write_study):
    warmer = results(write_study, bulk_temperature_rise_K=30.0)
    base = results(write_study)
    assert warmer["power_loss"][:, 0] == pytest.approx(base["power_loss"][:, 1], rel=1e-12)


def test_an_option_and_an_effect_never_warm_the_teeth_twice(write_study):
    options, effects = {"bulk_temperature_rise_K": 30.0}, {"bulk_temperature": {}}
    with pytest.raises(InputError, match=r"effects\.bulk_temperature: and options\.bulk_temperature_rise_K "):
        read_study(write_study(options=options, effects=effects))
    read_study(write_study(options={"bulk_temperature_rise_K": 0.0}, effects=effects))


def test_the_default_laws_are_those_of_the_base_model():
    base = dict(GEAR_LOSS)
    for slot in SLOTS:
        assert next(iter(slot.choices)) == slot.default
        assert slot.choices[slot.default].law is base[slot.quantity]
    assert study_chain(Options()) == GEAR_LOSS


def test_a_law_is_offered_once_and_names_its_source():
    def film(viscosity):
        """A film (m). Source: none."""
        return viscosity

    with pytest.raises(TypeError, match=r"film = 'dowson_toyoda_central' is already defined in mixedlub\.laws\.film"):
        FILM.offers("dowson_toyoda_central", "another")(film)
    film.__doc__ = "A film (m)."
    with pytest.raises(TypeError, match="names no 'Source: '"):
        FILM.offers("unsourced", "another")(film)
    assert "unsourced" not in FILM.choices
