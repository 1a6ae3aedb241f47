"""Margins against scuffing and micropitting: limits, and computations by hand."""

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.study import read_study, run_study
from profiles.errors import InputError

LIMITS = {
    "scuffing_temperature_C": 250.0,
    "integral_scuffing_temperature_C": 200.0,
    "flash_weight": 1.5,
    "permissible_film_ratio": 0.3,
}
WARM = {"bulk_temperature": {}}


@pytest.fixture
def rated(write_study):
    def run(effects=WARM, **limits):
        return run_study(read_study(write_study(effects=effects, safety=LIMITS | limits)))

    return run


def test_safeties_are_those_of_their_temperatures_by_hand(rated):
    table = rated().to_pandas()
    oil, flash, bulk = (table[c] for c in ("oil_temperature_C", "flash_temperature_K", "bulk_temperature_C"))
    assert table["contact_temperature_C"].to_numpy() == pytest.approx((bulk + flash).to_numpy(), rel=1e-12)
    by_flash = (250.0 - oil) / (bulk + flash - oil)
    assert table["scuffing_safety_flash"].to_numpy() == pytest.approx(by_flash.to_numpy(), rel=1e-9)
    integral = 200.0 / table["integral_temperature_C"]
    assert table["scuffing_safety_integral"].to_numpy() == pytest.approx(integral.to_numpy(), rel=1e-9)
    mean_flash = (table["integral_temperature_C"] - bulk) / 1.5
    assert ((mean_flash > 0.0) & (mean_flash < flash)).all()
    ratio = table["micropitting_film_ratio"] / 0.3
    assert table["micropitting_safety"].to_numpy() == pytest.approx(ratio.to_numpy(), rel=1e-12)


def test_a_stated_rise_of_the_bulk_counts_from_the_oil(write_study):
    """S_B by hand with the oil as it enters the gears."""
    file = write_study(safety=LIMITS, options={"bulk_temperature_rise_K": 30.0})
    table = run_study(read_study(file)).to_pandas()
    oil, contact = (table[c].to_numpy() for c in ("oil_temperature_C", "contact_temperature_C"))
    assert table["scuffing_safety_flash"].to_numpy() == pytest.approx((250.0 - oil) / (contact - oil), rel=1e-9)


def test_teeth_colder_than_their_oil_are_refused(write_study):
    """Losses warm them; below the oil the safety against scuffing would have no sign."""
    with pytest.raises(InputError, match=r"options.bulk_temperature_rise_K: -5.0: must be from 0 to 200 K"):
        read_study(write_study(safety=LIMITS, options={"bulk_temperature_rise_K": -5.0}))


def test_oil_warmed_to_its_limit_is_refused(write_study):
    file = write_study(safety={"scuffing_temperature_C": 110.0}, options={"bulk_temperature_rise_K": 30.0})
    with pytest.raises(InputError, match="oil of 120"):
        read_study(file)


def test_cold_contacts_have_the_film_of_dowson_and_higginson_over_the_mean_roughness(write_study):
    """Hardly any friction means no flash temperature: 1600 rho G^0.6 U^0.7 W^-0.13 of mm in um at each point."""
    file = write_study(
        safety={"permissible_film_ratio": 0.3}, boundary_friction=1e-4, lubricant__eyring_stress_MPa=0.02
    )
    study = read_study(file)
    plan = study.plan
    state = {
        **plan.inputs,
        **plan.model(("line_load", "radius", "entrainment_speed", "pressure_viscosity"))(plan.inputs),
    }
    modulus = float(plan.inputs["reduced_modulus"])
    radius = np.asarray(state["radius"])
    film = (
        1600.0
        * (1e3 * radius)
        * (np.asarray(plan.inputs["pressure_viscosity"]) * modulus) ** 0.6
        * (np.asarray(plan.inputs["viscosity"]) * state["entrainment_speed"] / (modulus * radius)) ** 0.7
        * (2.0 * np.pi * (state["hertz_pressure"] / modulus) ** 2) ** -0.13
    )
    roughness = {"fine": 0.02, "mid": 0.1, "coarse": 0.3}
    ra = [np.sqrt(2 / np.pi) * 0.5 * (roughness[a] ** 0.5 + roughness[b] ** 0.5) for a, b in study.pairings]
    least = film.min(axis=-1) / np.reshape(ra, (-1, 1, 1, 1))
    assert run_study(study)["least_specific_film"] == pytest.approx(np.broadcast_to(least, plan.shape), rel=3e-3)


def test_hotter_teeth_and_rougher_flanks_are_less_safe(rated):
    warm, cold = rated(), rated({})
    for name in ("flash_safety", "integral_safety", "micropitting_safety"):
        assert (warm[name] < cold[name]).all(), name
    fine, coarse = (cold.study.pairings.index((name, name)) for name in ("fine", "coarse"))
    for name in ("flash_safety", "integral_safety", "micropitting_safety"):
        assert (cold[name][coarse] < cold[name][fine]).all(), name


def test_columns_come_with_their_limits(write_study):
    bare = run_study(read_study(write_study("bare"))).to_pandas()
    assert not [c for c in bare if "safety" in c or "integral" in c or "micropitting" in c]
    one = run_study(read_study(write_study(safety={"scuffing_temperature_C": 250.0}))).to_pandas()
    assert [c for c in one if "safety" in c] == ["scuffing_safety_flash"]
    assert (one.drop(columns="scuffing_safety_flash") == bare).all(axis=None)


@pytest.mark.parametrize(
    ("limits", "told"),
    [
        ({}, "holds no limit"),
        ({"integral_scuffing_temperature_C": 200.0}, "go together"),
        ({"flash_weight": 1.5}, "go together"),
        ({"permissible_film_ratio": 0.0}, "permissible_film_ratio"),
        ({"scuffing_temperature": 250.0}, "scuffing_temperature_C"),
        ({"scuffing_temperature_C": 40.0}, "oil of 90"),
    ],
)
def test_wrong_limits_are_refused(limits, told, write_study, tmp_path, capsys):
    path = write_study(safety=limits)
    assert main(["study", str(path), "--out", str(tmp_path / "o")]) == 2
    assert told in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "o").exists()
