"""Film and asperities that share the load: bad input, limits, convergence, flags, and what the table then has."""

from __future__ import annotations

import csv

import numpy as np
import pytest

from mixedlub.base_model.balanced import balanced_film, sharing_exponent
from mixedlub.base_model.limits import BALANCE as ADVICE
from mixedlub.chain.slots import ASPERITY_AREA, ASPERITY_LOAD, FILM
from mixedlub.friction import BASE
from mixedlub.laws import contact, yielding
from mixedlub.laws.balance import least_film_share
from mixedlub.laws.film import dowson_toyoda, isoviscous_ratio, moes
from mixedlub.schema.findings import Severity, codes
from mixedlub.study import read_study, run_study
from mixedlub.study.batch import SHARED
from mixedlub.study.friction_comparison import compared, mesh_table
from mixedlub.study.validity import out_of_range
from profiles.errors import InputError
from roughness.mccool import plane_offset, summit_density, summit_radius, summit_sigma

BALANCE = {"balance": "johnson_greenwood_poon"}
SMOOTH = {"fine": {"m0_um2": 1e-6, "m2": 1e-6, "m4_per_um2": 3e-6}}
ROUGH = {"rough": {"m0_um2": 0.3, "m2": 0.003, "m4_per_um2": 0.004}}
LAWS = {name: {"hardness_GPa": 6.0} if yields else {} for name, yields in (
    ("greenwood_williamson", False), ("greenwood_tripp", False), ("chang_etsion_bogy", True),
    ("zhao_maietta_chang", True), ("kogut_etsion", True), ("jackson_green", True),
)}  # fmt: skip


def results(write_study, options=BALANCE, **changes):
    return run_study(read_study(write_study(options=options, **changes)))


# Bad input


@pytest.mark.parametrize("name", [name for name, more in LAWS.items() if more])
def test_yielding_asperities_need_their_hardness(name, write_study):
    with pytest.raises(InputError, match=f'options: asperities = "{name}" needs hardness_GPa'):
        read_study(write_study(options={"asperities": name}))


@pytest.mark.parametrize("name", [name for name, more in LAWS.items() if not more])
def test_hardness_that_would_be_ignored_is_refused(name, write_study):
    with pytest.raises(InputError, match='hardness_GPa acts only with asperities = "chang_etsion_bogy" or '):
        read_study(write_study(options={"asperities": name, "hardness_GPa": 6.0}))


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"asperities": "kogut_etson", "hardness_GPa": 6.0}, "kogut_etsion"),
        ({"balance": "johnson_greenwood"}, "johnson_greenwood_poon"),
        ({"asperities": "kogut_etsion", "hardness_GPa": 6e9}, "hardness_GPa"),
        ({"asperities": "kogut_etsion", "hardness_GPa": -1.0}, "hardness_GPa"),
        ({"asperities": "kogut_etsion", "hardness_MPa": 6000}, "hardness_GPa"),
    ],
)
def test_a_wrong_choice_is_told_with_the_right_one(options, told, write_study):
    with pytest.raises(InputError, match=told):
        read_study(write_study(options=options))


@pytest.mark.parametrize(
    ("effect", "options", "needed"),
    [
        ("asperity_plasticity", BALANCE, 'balance = "none"'),
        ("skewed_heights", {"mixture": "load_weighted"}, 'mixture = "tallian"'),
        (
            "asperity_plasticity",
            {"asperities": "kogut_etsion", "hardness_GPa": 6.0},
            'asperities = "greenwood_williamson"',
        ),
    ],
)
def test_an_effect_on_the_area_alone_is_refused_where_asperities_carry_load(effect, options, needed, write_study):
    with pytest.raises(InputError, match=f"effects.{effect}: changes the contact area .* it needs {needed}"):
        read_study(write_study(options=options, effects={effect: {}}))


def test_flanks_without_roughness_are_refused(write_study, tmp_path):
    (tmp_path / "flat.csv").write_text("".join(f"{0.0005 * i:.4f}, 0.0\n" for i in range(8000)), encoding="utf-8")
    traced = {"flat": {"profile": "flat.csv", "unit": "mm, um"}}
    with pytest.raises(InputError, match=r"surfaces\.flat: .* there is no roughness"):
        read_study(write_study(surfaces=traced, options=BALANCE))
    stated = {"flat": {"m0_um2": 0.0, "m2": 0.0, "m4_per_um2": 0.0}}
    with pytest.raises(InputError, match=r"surfaces\.flat.*m0_um2"):
        read_study(write_study(surfaces=stated, options=BALANCE))


def test_a_film_law_that_is_no_power_of_its_groups_is_refused():
    with pytest.raises(InputError, match="balance: needs a film law in powers"):
        sharing_exponent(lambda radius, line_load: radius * (1.0 + 1e5 / line_load))
    with pytest.raises(InputError, match="balance: needs a film law in powers"):
        sharing_exponent(moes)
    with pytest.raises(InputError, match="of the contact's groups alone"):
        sharing_exponent(lambda mesh_speed: mesh_speed)


# Limits


@pytest.mark.parametrize(("name", "more"), LAWS.items())
def test_smooth_flanks_have_the_film_alone(name, more, write_study):
    found = results(write_study, {**BALANCE, "asperities": name, **more}, surfaces=SMOOTH)
    alone = results(write_study, {"asperities": name, **more}, surfaces=SMOOTH)
    assert found["mean_asperity_load_share"].max() < 1e-12
    for column in ("power_loss", "mean_friction", "film_thickness"):
        assert found[column] == pytest.approx(alone[column], rel=1e-12)


def test_vanishing_roughness_comes_to_no_balance(write_study):
    """Heights, slopes and curvatures all scaled down."""
    differences = []
    for scale in (1.0, 0.1, 0.01, 0.001):
        fine = {"fine": {"m0_um2": 0.02 * scale, "m2": 0.0025 * scale, "m4_per_um2": 0.0036 * scale}}
        both = [results(write_study, options, surfaces=fine)["power_loss"] for options in (BALANCE, {})]
        differences.append(np.abs(both[0] / both[1] - 1.0).max())
    assert differences[0] > differences[1] > differences[2] > differences[3]
    assert differences[0] > 0.01
    assert differences[3] < 1e-9


def test_a_thick_film_leaves_no_asperities_to_carry(write_study):
    cold = {"conditions__oil_temperature_C": [-20], "conditions__speed_rpm": [20_000]}
    found = results(write_study, surfaces={"mid": {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036}}, **cold)
    assert found["film_parameter"].min() > 10.0
    assert found["mean_asperity_load_share"].max() < 1e-12
    assert found["film_over_unbalanced"] == pytest.approx(1.0, abs=1e-12)


def test_asperities_in_a_vanishing_film_carry_everything(write_study):
    """The gap is then that of dry contact, whatever the film law gives."""
    slow = {"surfaces": ROUGH, "conditions__speed_rpm": [0.01, 0.1]}
    found = results(write_study, {**BALANCE, "mixture": "load_weighted"}, **slow)
    assert found["mean_asperity_load_share"].min() > 0.999999
    assert found["mean_friction"] == pytest.approx(0.1, rel=1e-6)
    assert found["film_thickness"][..., 0] == pytest.approx(found["film_thickness"][..., 1], rel=1e-6)


# The solution


@pytest.mark.parametrize("film", [name for name in FILM.choices if name != "moes"])
@pytest.mark.parametrize(("name", "more"), LAWS.items())
def test_film_and_asperities_carry_the_load_in_every_condition(film, name, more, write_study):
    found = results(write_study, {**BALANCE, "film": film, "asperities": name, **more})
    assert found["balance_error"].max() < 1e-8
    assert (found["mean_asperity_load_share"] <= found["asperity_load_ratio"] * (1 + 1e-12)).all()


def test_the_film_is_that_of_its_law_under_the_load_it_carries(write_study):
    """By the film law itself at the film's share of load and modulus, point by point."""
    study = read_study(write_study(options=BALANCE))
    plan, model = study.plan, study.plan.model()
    model = type(model)(
        model_chain(plan), tuple(plan.inputs), ("film_thickness", "line_load", "asperity_pressure", "hertz_pressure")
    )
    state, inputs = model(plan.inputs), plan.inputs
    share = state["asperity_pressure"] / (0.25 * np.pi * state["hertz_pressure"])
    thin = share < 0.999  # beyond, 1 - share has lost its digits
    film = dowson_toyoda(
        inputs["radius"],
        inputs["entrainment_speed"],
        state["line_load"] * (1.0 - share),
        inputs["viscosity"],
        inputs["pressure_viscosity"],
        inputs["reduced_modulus"] * (1.0 - share),
    )
    assert thin.sum() > 1000
    assert state["film_thickness"][thin] == pytest.approx(film[thin], rel=1e-8)


def model_chain(plan):
    from mixedlub.study.options import study_chain

    return study_chain(plan.options)


@pytest.mark.parametrize("name", [name for name in LAWS if name != "greenwood_tripp"])
def test_every_contact_converges_however_far_from_a_gear(name):
    """Films of 1 nm to 3 um, flanks of 1 nm to 3 um, 1 MPa to 2 GPa, and bandwidths of 2 to 100."""
    rng = np.random.default_rng(11)
    m0, m2 = 10.0 ** rng.uniform(-18, -11, (40, 1)), 0.0025
    m4 = m2**2 * 10.0 ** rng.uniform(0.3, 2.0, (40, 1)) / m0
    summits = (summit_density(m2, m4), summit_radius(m4), summit_sigma(m0, m2, m4))
    offset, sigma = plane_offset(m0, m2, m4), summits[2]
    pressure = {"greenwood_williamson": contact.asperity_pressure}.get(name) or getattr(yielding, f"{name}_pressure")
    more = (6e9,) if LAWS[name] else ()
    film, mean = 10.0 ** rng.uniform(-9, -5.5, 500), 10.0 ** rng.uniform(6, 9.3, 500)
    calls = []

    def carried(trial):
        calls.append(trial.shape)
        return pressure((trial - offset) / sigma, *summits, 226e9, *more)

    for exponent in (0.13, 0.16, 0.5):
        found = balanced_film(film, mean, exponent, carried)
        missed = carried(found) / mean + (found / film) ** (-1.0 / exponent) - 1.0
        assert np.abs(missed).max() < 1e-10
        assert (found >= film).all()
    assert len(calls) < 3 * 25


def test_a_pressure_with_a_step_is_bracketed():
    """No Newton step meets the root of a law that jumps; bisection closes in on the jump."""
    found = balanced_film(np.array([1e-7]), np.array([1e9]), 0.13, lambda h: np.where(h < 1.5e-7, 2e9, 1e6))
    assert found == pytest.approx(1.5e-7, rel=1e-6)


def test_elastic_asperities_are_refused_by_no_hardness_and_offered_in_both_steps():
    assert list(ASPERITY_AREA.choices) == list(ASPERITY_LOAD.choices)
    assert set(LAWS) == set(ASPERITY_AREA.choices)


# Flags and table


def test_a_film_below_its_share_is_told(write_study):
    """Moes: with M 19 and L 8 a film that carries less than 7 % is isoviscous."""
    study = read_study(write_study(options=BALANCE, surfaces=ROUGH))
    found = run_study(study)
    told = out_of_range(found)
    assert "film_carries_too_little" in codes(told)
    assert not {"asperities_overloaded", "balance_not_found"} & set(codes(told))
    assert found.flags["film_carries_too_little"].any()
    thick = results(write_study, surfaces=SMOOTH)
    assert not thick.flags


def test_a_film_that_carries_nearly_all_is_not_told_to_carry_too_little(write_study):
    """Moes' M falls below 2 at small torque, which is out of the range of the film law whatever asperities carry."""
    light = results(write_study, surfaces=SMOOTH, conditions__torque_Nm=[0.5, 2.0, 150.0], conditions__speed_rpm=[3000])
    assert light["asperity_load_ratio"].max() < 0.01
    assert light.flags["law_extrapolated:dowson_toyoda"].any()
    assert "film_carries_too_little" not in light.flags
    every = results(write_study, surfaces=ROUGH, conditions__torque_Nm=[0.5, 2.0, 150.0])
    flagged = every.flags["film_carries_too_little"] > 0
    assert flagged.any()
    assert every["asperity_load_ratio"][flagged].min() >= 0.05


HERE = {
    "radius": 8.3262e-3,
    "entrainment_speed": 2.163,
    "viscosity": 0.01489,
    "pressure_viscosity": 14.81e-9,
    "reduced_modulus": 226.374e9,
}


def test_least_share_is_where_both_elastic_films_are_equal():
    """2.05 M^(-1/5) and 1.65 M^(-1/8) L^(3/4) of the contact that the film carries."""
    line_load = 214.86e3
    size = HERE["reduced_modulus"] * HERE["radius"]
    whole = line_load / size / np.sqrt(2.0 * HERE["viscosity"] * HERE["entrainment_speed"] / size)
    share = least_film_share(whole, isoviscous_ratio(line_load=line_load, **HERE))
    modulus = HERE["reduced_modulus"] * share
    speed = 2.0 * HERE["viscosity"] * HERE["entrainment_speed"] / (modulus * HERE["radius"])
    load = line_load * share / (modulus * HERE["radius"]) / np.sqrt(speed)
    material = HERE["pressure_viscosity"] * modulus * speed**0.25
    assert load > 2.0
    assert 2.05 * load**-0.2 == pytest.approx(1.65 * load**-0.125 * material**0.75, rel=1e-12)


def test_least_share_of_a_light_load_is_where_the_film_flattens_nothing():
    """M of the film's own contact falls with the root of its share, to 2."""
    assert 5.0 * np.sqrt(least_film_share(np.array(5.0), 0.2)) == pytest.approx(2.0)


def test_a_balance_with_another_law_of_friction_is_refused(write_study):
    with pytest.raises(InputError, match=r"options\.balance: .*goes with the base model's friction"):
        read_study(write_study(options={**BALANCE, "friction": "benedict_kelley"}))


def test_a_balance_that_is_not_found_is_told(write_study, monkeypatch):
    """One iteration is too few."""
    monkeypatch.setattr("mixedlub.base_model.balanced._MOST_STEPS", 1)
    told = out_of_range(results(write_study, surfaces=ROUGH))
    assert "balance_not_found" in codes(told)
    assert next(one for one in told if one.code == "balance_not_found").severity == "doubt"


def test_table_has_the_shares_behind_its_other_columns(write_study, tmp_path):
    found = results(write_study)
    found.write(tmp_path / "r.csv", tmp_path / "r.parquet")
    with (tmp_path / "r.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    names = list(rows[0])
    behind = names[: names.index("validity")]
    assert behind[-3:] == ["asperity_real_pressure_MPa", "mean_asperity_load_share", "film_over_unbalanced_film"]
    for row in rows:
        assert 0.0 <= float(row["mean_asperity_load_share"]) <= float(row["asperity_load_ratio"]) + 1e-12
    assert not set(SHARED) & {column.output for column in results(write_study, {}).columns}


def test_real_pressure_is_the_hardness_where_all_asperities_yield(write_study):
    soft = results(write_study, {"asperities": "zhao_maietta_chang", "hardness_GPa": 0.05}, surfaces=ROUGH)
    assert soft["asperity_real_pressure"] == pytest.approx(0.05e9, rel=0.02)
    assert results(write_study, {}, surfaces=ROUGH)["asperity_real_pressure"].min() > 5e9


def test_blocks_and_threads_change_nothing(write_study):
    from mixedlub.study import batch

    study = read_study(write_study(options={**BALANCE, "asperities": "jackson_green", "hardness_GPa": 6.0}))
    whole = run_study(study)
    shape = study.plan.shape
    for block in batch.split(shape, (2, 1, 1, shape[3])):
        for name, part in batch.compute(study.plan, block).items():
            assert part == pytest.approx(whole[name][block], rel=1e-9, abs=1e-11, nan_ok=True), name


def test_effects_on_film_and_roughness_are_balanced_too(write_study):
    """Micro-EHL lets the onset of yield vary along the path; inlet heating thins the film that would carry all."""
    options = {**BALANCE, "asperities": "kogut_etsion", "hardness_GPa": 6.0}
    effects = {"micro_ehl": {"relative_wavelength": 1.0}, "inlet_shear_heating": {}}
    found = results(write_study, options, effects=effects, conditions__oil_temperature_C=[60])
    assert found["balance_error"].max() < 1e-8
    plain = results(write_study, options, conditions__oil_temperature_C=[60])
    assert (found["mean_asperity_load_share"] != plain["mean_asperity_load_share"]).all()


def test_page_tells_the_shares_and_draws_them(write_study):
    from mixedlub.report.figures import figures
    from mixedlub.report.page import content

    shown = results(write_study, conditions__oil_temperature_C=[60])
    page = content(shown)
    assert any("asperities carry between" in sentence for sentence in page["findings"])
    assert any("Johnson" in law.source and law.gives == "film thickness" for law in page["laws"])
    assert all(law.says for law in page["laws"])
    assert "mean_asperity_load_share_equal" in [drawn.name for drawn in figures(shown)]
    plain = results(write_study, {}, conditions__oil_temperature_C=[60])
    assert not any("asperities carry between" in sentence for sentence in content(plain)["findings"])


def test_laws_of_friction_are_compared_at_the_film_that_they_are_fitted_to(write_study):
    """Only the base model's friction is that of the balanced film, with asperities that yield."""
    options = {**BALANCE, "asperities": "kogut_etsion", "hardness_GPa": 6.0, "mixture": "load_weighted"}
    one = {"surfaces": ROUGH, "conditions__oil_temperature_C": [60]}
    shared, alone = (
        compared(read_study(write_study(options=given, **one)), {})
        for given in (options, {"asperities": "kogut_etsion", "hardness_GPa": 6.0})
    )
    tables = [(c.along_path(), c.over_ratio(), mesh_table(c.every, {})) for c in (shared, alone)]
    for with_balance, without in zip(*tables):
        base = with_balance["law"] == BASE
        column = "friction" if "friction" in with_balance else "mean_friction"
        same = with_balance[column] == without[column]
        assert (same | with_balance[column].isna())[~base].all()
        assert (with_balance[column] > 1.5 * without[column])[base].any()


def test_friction_by_area_under_a_balance_is_doubted_before_all_else(write_study):
    found = results(write_study, surfaces=ROUGH)
    (first, *others) = found.findings
    assert (first.code, first.severity) == ("balance_by_area", Severity.DOUBT)
    assert "balance_by_area" not in codes(others)
    by_load = results(write_study, {**BALANCE, "mixture": "load_weighted"}, surfaces=ROUGH)
    for quiet in (by_load, results(write_study, {}, surfaces=ROUGH)):
        assert "balance_by_area" not in codes(quiet.findings)


def test_the_balance_is_recommended_with_the_friction_that_goes_with_it(write_study):
    """Another law of friction goes with no balance."""
    found = out_of_range(results(write_study, {}, surfaces=ROUGH))
    (told,) = [one.text for one in found if one.code == "asperities_overloaded"]
    assert ADVICE in told
    other = out_of_range(results(write_study, {"friction": "iso_tc60"}, surfaces=ROUGH))
    assert not any("balance" in one.text for one in other)
