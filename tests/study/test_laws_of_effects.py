"""An effect of a study is a published law, chosen by its name."""

import numpy as np
import pytest

from mixedlub.base_model.chains import LINE, POINT
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.effects import known_effects, known_in
from mixedlub.laws import drag
from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study
from profiles.errors import InputError


def added(write_study, **effects):
    """What effects add to the loss outside the mesh (W), and the study."""
    study = read_study(write_study(effects=effects))
    return run_study(study)["other_loss"][0], study


def wheels(study):
    """Radius, speed and teeth of both wheels at the speeds of the study."""
    inputs = study.plan.inputs
    for side in ("pinion", "gear"):
        yield inputs[f"{side}_radius"], np.ravel(inputs[f"{side}_speed"]), inputs[f"{side}_teeth"]


def test_an_uncertain_effect_is_refused_with_what_a_study_takes(write_study):
    with pytest.raises(
        InputError, match=r"only \[uncertainty\] of boundary_friction, viscosity, .*roughness; leave it"
    ):
        read_study(write_study(effects={"windage": {"strength_sd": 0.1}}))


def test_churning_is_that_of_changenet_and_velex(write_study):
    loss, study = added(write_study, churning={})
    inputs, (_, gear) = study.plan.inputs, wheels(study)
    for at, (eta, rho) in enumerate(zip(np.ravel(inputs["viscosity"]), np.ravel(inputs["oil_density"]))):
        radius, speed, teeth = gear
        law = drag.churning_changenet_velex(radius, speed, 14e-3, 4.2333333e-3, teeth, eta, rho)
        assert loss[at, 0] == pytest.approx(law, rel=1e-9)


def test_churning_at_high_speed_is_their_second_law(write_study):
    """Above 1250 m/s^2 at the wheel's rim, 4230 rpm of this pinion: whatever the viscosity, with speed as n^1.24."""
    file = write_study(effects={"churning": {}}, conditions__speed_rpm=[4300, 8600])
    study = read_study(file)
    loss = run_study(study)["other_loss"][0]
    (_, (radius, speed, teeth)) = wheels(study)
    density = np.ravel(study.plan.inputs["oil_density"])
    law = [drag.churning_at_high_speed(radius, speed, 14e-3, 4.2333333e-3, teeth, rho) for rho in density]
    assert loss[:, 0] == pytest.approx(np.array(law), rel=1e-9)
    assert loss[0, 0, 1] / loss[0, 0, 0] == pytest.approx(2.0**1.24, rel=1e-9)


def test_windage_is_that_of_diab(write_study):
    loss, study = added(write_study, windage={})
    law = sum(drag.windage_diab(radius, speed, 14e-3, teeth) for radius, speed, teeth in wheels(study))
    assert loss[0, 0] == pytest.approx(law, rel=1e-9)


def test_seals_are_those_of_the_standard(write_study):
    """ISO/TR 14179-2, P = 7.69e-6 d^2 n in W, mm and rpm, at both shafts."""
    loss, study = added(write_study, seal_drag={})
    shaft = 1e3 * study.plan.inputs["pinion_radius"]
    law = sum(7.69e-6 * shaft**2 * speed * 30 / np.pi for _, speed, _ in wheels(study))
    assert loss[0, 0] == pytest.approx(law, rel=1e-3)


def test_inlet_heating_is_guptas(write_study):
    taken = read_study(write_study(effects={"inlet_shear_heating": {}})).plan.parameters["inlet_shear_heating"]
    assert taken == {"strength": 1.0, "sliding": 1.0, "loading_power": 0.64, "pressure_power": 0.0}


def test_a_law_is_chosen_by_its_name(write_study):
    """Boness' laminar power is proportional to n^2 nu: with speed as 500, 1500, 3000 rpm."""
    loss, study = added(write_study, churning={"law": "Boness, laminar"})
    assert loss[0, 0] / loss[0, 0, 0] == pytest.approx([1.0, 9.0, 36.0], rel=1e-9)
    assert loss[0, 0, 0] / loss[1, 0, 0] == pytest.approx(
        study.oil.viscosity(np.array(333.15)) / study.oil.viscosity(np.array(363.15)), rel=1e-9
    )
    assert "effect_law_assumed" not in codes(study.notes)


def test_the_law_that_is_taken_is_told(write_study):
    (told,) = (n for n in read_study(write_study(effects={"churning": {}})).notes if n.code == "effect_law_assumed")
    assert "Changenet and Velex" in told.text
    assert "ISO/TR 14179-1" in told.text


@pytest.mark.parametrize("name", ["roughness_lay", "boundary_speed_dependence"])
def test_an_effect_that_nothing_switches_on_says_so(name, write_study):
    study = read_study(write_study(effects={name: {}}))
    assert "effect_off" in codes(study.notes)
    base = run_study(read_study(write_study("base")))
    assert np.array_equal(run_study(study)["power_loss"], base["power_loss"])


def test_an_effect_switched_off_by_hand_is_not_told(write_study):
    assert "effect_off" not in codes(read_study(write_study(effects={"roughness_lay": {"lay": 0.0}})).notes)


def test_a_number_that_neither_file_nor_law_gives_is_told(write_study):
    def told(**given):
        notes = read_study(write_study(effects=given)).notes
        return [str(n) for n in notes if n.code == "effect_number_assumed"]

    (note,) = told(asperity_plasticity={})
    assert note == "effects.asperity_plasticity: taken, as the file gives none: hardness = 6e+09 Pa"
    assert told(asperity_plasticity={"hardness": 7e9}) == []
    assert told(churning={}, windage={}, bulk_temperature={}) == []
    assert told(roughness_lay={}) == [], "which is off"


def test_skewness_alone_leaves_the_spread_of_the_summits(write_study):
    taken = read_study(write_study(effects={"skewed_heights": {"skewness": -0.6}})).plan.parameters
    assert taken["skewed_heights"]["narrowing"] == 0.0


def test_every_named_law_of_a_study_runs(write_study):
    """Each changes the loss, or says that it needs a number."""
    known = known_in("gear_pair")
    for name in ("churning", "windage", "bearing_drag", "seal_drag", "rolling_resistance", "inlet_shear_heating"):
        for law in known[name].laws_within_reach:
            found = run_study(read_study(write_study(effects={name: {"law": law}})))
            assert np.isfinite(found["power_loss"]).all(), (name, law)


@pytest.mark.literature("ISO/TR 15144-1, 7400 (P/(a b))^0.72 X_S/(1.2 X_Ca) with P in kW, a and b in mm")
def test_teeth_are_warmer_than_the_oil_by_the_loss_of_each_condition(write_study):
    base = run_study(read_study(write_study("cold")))
    study = read_study(write_study(effects={"bulk_temperature": {}}))
    warm = run_study(study)
    centre = 1e3 * 0.5 * (17 + 26) * 4.2333333e-3
    rise = 7400.0 * (1e-3 * base["power_loss"] / (centre * 14.0)) ** 0.72 / 1.95
    oil = np.array([333.15, 363.15]).reshape(1, -1, 1, 1)
    assert warm["bulk_temperature"] == pytest.approx(oil + rise, abs=1e-3)
    assert warm["contact_temperature"] == pytest.approx(warm["bulk_temperature"] + warm["flash_temperature"], abs=1e-9)
    thinner = study.oil.viscosity(warm["bulk_temperature"]) / study.oil.viscosity(oil)
    assert (warm["film_thickness"] / base["film_thickness"] > thinner**0.85).all()
    assert (warm["film_thickness"] < base["film_thickness"]).all()


def test_the_rise_of_a_condition_does_not_depend_on_the_others(write_study):
    alone = {"conditions__torque_Nm": [150.0], "conditions__speed_rpm": [3000.0]}
    many = {"conditions__torque_Nm": [50.0, 150.0], "conditions__speed_rpm": [500.0, 3000.0]}
    one, grid = (run_study(read_study(write_study(effects={"bulk_temperature": {}}, **at))) for at in (alone, many))
    assert grid["bulk_temperature"][..., 1, 1] == pytest.approx(one["bulk_temperature"][..., 0, 0], rel=1e-12)
    with pytest.raises(InputError, match=r"effects\.bulk_temperature\.exponent.*must be 0\.72"):
        read_study(write_study(effects={"bulk_temperature": {"exponent": 1.0}}, **many))


def test_warm_teeth_are_alike_in_blocks(write_study, monkeypatch):
    file = write_study(effects={"bulk_temperature": {}})
    whole = run_study(read_study(file))
    monkeypatch.setattr("mixedlub.study.batch.BLOCK_POINTS", 300)
    parts = run_study(read_study(file), threads=1)
    assert parts["power_loss"] == pytest.approx(whole["power_loss"], rel=1e-12)


def test_every_physical_effect_on_gears_without_an_order_of_readings_runs(write_study):
    """Left out are faults of instruments and what follows the sequence of the readings."""
    coated = {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036, "coating": {"name": "DLC", "thickness_um": 3.0}}
    coated["coating"]["thermal_conductivity_W_mK"] = 2.0
    for e in known_in("gear_pair").values():
        if e.stage != "measurement" and "sequence" not in e.reads and (not e.kinds or "gear_pair" in e.kinds):
            found = run_study(read_study(write_study(surfaces={"a": coated}, effects={e.id: {}})))
            assert np.isfinite(found["power_loss"]).all(), e.id


def test_load_that_moves_along_the_path_is_refused_by_averages_that_do_not_see_it(write_study):
    with pytest.raises(InputError, match=r'effects\.tip_relief.*averaging = "mesh_integral"'):
        read_study(write_study(effects={"tip_relief": {"relief": 1e-5}}, options={"averaging": "paper"}))


@pytest.mark.parametrize(
    ("law", "exponent"),
    [(None, 0.69 - 0.56), ("Dowson and Higginson", 0.70 - 0.54), ("Pan and Hamrock", 0.692 - 0.470)],
)
def test_a_balance_of_load_takes_the_exponent_of_the_film_law_in_use(write_study, law, exponent):
    """Exponents of U and G as the laws print them."""
    film = {} if law is None else {"film_law": {"law": law}}
    known = read_study(write_study(effects={"load_balance": {}, **film})).plan.parameters
    assert known["load_balance"]["exponent"] == pytest.approx(exponent, abs=1e-9)
    stated = read_study(write_study(effects={"load_balance": {"exponent": 0.2}, **film})).plan.parameters
    assert stated["load_balance"]["exponent"] == 0.2


@pytest.mark.parametrize("law", ["Moes", "Grubin"])
def test_a_balance_of_load_is_refused_under_a_film_law_without_an_exponent(write_study, law):
    with pytest.raises(InputError, match=r"effects\.load_balance\.exponent: .*effects\.film_law"):
        read_study(write_study(effects={"load_balance": {}, "film_law": {"law": law}}))
    read_study(write_study(effects={"load_balance": {"exponent": 0.1}, "film_law": {"law": law}}))


@pytest.mark.parametrize(("chain", "exponent"), [(LINE, 0.69 - 0.56), (POINT, 0.67 - 0.53)])
def test_a_balance_of_load_takes_the_exponent_of_line_or_point_contacts(chain, exponent):
    known = known_effects({"load_balance": {}}, "disc", chain, tuple(GLOSSARY), "friction")
    assert known.values["load_balance"] == {"stiffness": 1.0, "exponent": pytest.approx(exponent, abs=1e-9)}
