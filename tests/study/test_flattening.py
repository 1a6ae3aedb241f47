"""Roughness that yields in the film: each wave of each surface, both lays, in studies and cases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.case import reference_rigs
from mixedlub.case.forward import Forward
from mixedlub.chain.model import Model
from mixedlub.effects.micro_ehl import micro_ehl
from mixedlub.laws.flattening import flattening_rate, kept_moments
from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study
from mixedlub.study.checkpoint import input_fingerprint
from profiles import shipped
from profiles.errors import InputError
from roughness import evaluation_profile
from roughness.waves import lognormal_waves, waves_of

FLAT = {"flattening": "waves"}
SHARED = {"balance": "johnson_greenwood_poon", "mixture": "load_weighted"}
GROUND = {"ground": {"profile": "shipped:0302", "cutoff_mm": 0.8, "short_cutoff_um": 2.5}}
RIDGED = {"m0_um2": 0.1, "m2": 0.003, "m4_per_um2": 0.004, "m2_along": 3e-5, "m4_along_per_um2": 4e-6}
MOMENTS = ("m0", "m2", "m4")


def results(write_study, options=FLAT, **changes):
    return run_study(read_study(write_study(options=options, **changes)))


def in_film(plan):
    """Kept shares of the three moments at every point, and the quantities that they follow from."""
    names = tuple(f"film_{name}" for name in MOMENTS)
    found = Model(plan.chain(plan.options), tuple(plan.inputs), (*names, "flattening_rate", "hertz_half_width"))(
        plan.inputs
    )
    return {name: found[f"film_{name}"] / plan.inputs[name] for name in MOMENTS} | found


def test_moments_in_the_film_are_sums_over_the_waves_of_the_trace(write_study):
    """Against a periodogram of the trace, wave by wave, without classes and tables."""
    plan = read_study(write_study(surfaces=GROUND, options=FLAT)).plan
    found = in_film(plan)
    trace = evaluation_profile(shipped("shipped:0302"), cutoff=0.8e-3, short_cutoff=2.5e-6)
    heights = (trace.heights - trace.heights.mean()) * np.hanning(trace.heights.size)
    power = np.abs(np.fft.rfft(heights))[1:] ** 2
    q = 2.0 * np.pi * np.fft.rfftfreq(heights.size, trace.spacing)[1:]
    rates = np.broadcast_to(found["flattening_rate"], found["m0"].shape)
    for place in ((0, 0, 0, 0, 5), (0, 1, 1, 2, 24)):
        nabla = 2.0 * np.pi / q * rates[place]
        left = (1.0 + 0.17 * nabla + 0.03 * nabla**2) ** -2
        for order, name in enumerate(MOMENTS):
            expected = np.sum(power * q ** (2 * order) * left) / np.sum(power * q ** (2 * order))
            assert found[name][place] == pytest.approx(expected, rel=0.01)
        assert found["m0"][place] < found["m2"][place] < found["m4"][place]


def test_rate_is_that_of_moes_groups():
    from mixedlub.laws.contact import line_hertz_half_width
    from mixedlub.laws.film import moes_load

    radius, speed, load, viscosity, alpha, modulus = 8e-3, 3.0, 3e5, 0.012, 15e-9, 226e9
    material = alpha * modulus * (2.0 * viscosity * speed / (modulus * radius)) ** 0.25
    expected = moes_load(radius, speed, load, viscosity, modulus) ** 0.75 / material**0.5
    expected /= line_hertz_half_width(load, radius, modulus)
    assert flattening_rate(radius, speed, load, viscosity, alpha, modulus) == pytest.approx(expected, rel=1e-12)


def test_tables_are_within_a_thousandth_of_the_sums():
    from mixedlub.base_model.flattened import flattening

    waves = lognormal_waves(1e-13, 3e-3, 4e9)
    rates, widths = np.exp(np.linspace(5.03, 15.77, 40)), np.exp(np.linspace(-10.4, -7.2, 40))
    tables = flattening([(waves, 1.0)], True, 0.1)
    for order in range(3):
        direct = [
            kept_moments(waves.lengths, waves.shares, np.array([g]), np.array([0.1 * b]))[order, 0, 0]
            for g, b in zip(rates, widths, strict=True)
        ]
        assert tables.kept(order, np.zeros(40), rates, widths) == pytest.approx(np.array(direct), rel=3e-3)


def test_stated_moments_flatten_as_the_effect_with_their_spectrum(write_study):
    """The effect sums three nodes of the same lognormal spectrum from the Hertz pressure."""
    plan = read_study(write_study(options=FLAT, pairings={"every": ["mid"]})).plan
    found = in_film(plan)
    names = ("hertz_half_width", "hertz_pressure")
    given = {**plan.inputs, **Model(plan.chain(plan.options), tuple(plan.inputs), names)(plan.inputs)}
    oil = ("viscosity", "entrainment_speed", "pressure_viscosity", "radius", "reduced_modulus")
    shares = ("height_share", "slope_share", "curvature_share")
    form = {"relative_wavelength": 1.0, "viscous": 1.0, "spread": 1.0}
    other = micro_ehl(*(given[n] for n in MOMENTS), **{n: given[n] for n in (*names, *oil, *shares)}, **form)
    for name, value in zip(MOMENTS, other, strict=True):
        loaded = np.broadcast_to(plan.inputs["load_share"] > 1e-3, found[name].shape)
        assert found[name][loaded] == pytest.approx((value / plan.inputs[name])[loaded], abs=0.02)


def test_each_surface_keeps_its_own_waves():
    """Long waves go, short ones stay: of the sum, the share of the short ones."""
    from mixedlub.base_model.flattened import _InFilm, flattening
    from roughness.waves import Waves

    both = [(Waves(np.array([length]), np.ones((3, 1))), 1.0) for length in (1e-3, 1e-7)]
    tables, rows = flattening(both, True, None), (np.zeros(1), np.ones(1), np.array([3e4]), np.ones(1))
    assert _InFilm(tables, 0, False)(np.array([1e-14]), np.array([0.7]), *rows) == pytest.approx(0.3e-14, rel=5e-3)
    assert _InFilm(tables, 0, True)(np.array([0.7]), *rows) == pytest.approx(0.0, abs=5e-3)


def test_ridges_along_the_motion_flatten_more(write_study):
    kept = {}
    for lay in ("transverse", "longitudinal"):
        kept[lay] = in_film(read_study(write_study(surfaces={"a": RIDGED | {"lay": lay}}, options=FLAT)).plan)["m0"]
    assert (kept["longitudinal"] < 0.8 * kept["transverse"]).all()


def test_flattened_asperities_carry_less_and_the_balance_holds(write_study):
    plain, flat = (results(write_study, options) for options in (SHARED, SHARED | FLAT))
    assert flat["balance_error"].max() < 1e-8
    assert (flat["mean_asperity_load_share"] < plain["mean_asperity_load_share"]).all()
    assert flat["composite_roughness"] == pytest.approx(plain["composite_roughness"], rel=1e-12)


def test_only_the_asperities_change(write_study):
    plain, flat = (results(write_study, options) for options in ({}, FLAT))
    for name in ("film_thickness", "film_parameter", "hertz_pressure"):
        assert flat[name] == pytest.approx(plain[name], rel=1e-12)
    assert (flat["area_ratio"] <= plain["area_ratio"]).all()


@pytest.mark.parametrize("asperities", ["greenwood_tripp", "kogut_etsion"])
def test_every_law_of_asperities_reads_the_flattened_roughness(asperities, write_study):
    options = {"asperities": asperities, **({"hardness_GPa": 6.0} if asperities == "kogut_etsion" else {})}
    plain, flat = (results(write_study, options | more) for more in ({}, FLAT))
    assert (flat["asperity_load_ratio"] < plain["asperity_load_ratio"]).all()


def test_a_cutoff_tied_to_the_contact_smooths_and_goes_without_flattening(write_study):
    """A cut-off below that of the trace changes next to nothing; one of the width of the contact nearly all."""
    found = {
        share: results(write_study, {"short_cutoff_over_half_width": share}, surfaces=GROUND)["area_ratio"]
        for share in (1e-3, 0.1, 2.0)
    }
    plain = results(write_study, {}, surfaces=GROUND)["area_ratio"]
    assert found[1e-3] == pytest.approx(plain, rel=0.02)
    assert (found[2.0] < 0.7 * plain).all()
    assert (found[0.1] < plain).all()


def test_bands_have_the_waves_of_their_own_cutoff(write_study):
    found = results(write_study, FLAT | {"bands": "short_cutoff"}, surfaces=GROUND)
    low, high = found["lowest_area_ratio"], found["highest_area_ratio"]
    assert (low < found["area_ratio"] * (1.0 + 1e-9)).all()
    assert (high > low).all()


def test_assumed_waves_are_noted_and_measured_ones_not(write_study):
    assert "waves_assumed" in codes(read_study(write_study(options=FLAT)).notes)
    assert "waves_assumed" not in codes(read_study(write_study(options=FLAT, surfaces=GROUND)).notes)


def test_checkpoints_tell_the_waves_apart(write_study):
    plain, flat = (read_study(write_study(options=options, surfaces=GROUND)).plan for options in ({}, FLAT))
    other = replace(flat, flattening=replace(flat.flattening, logs=flat.flattening.logs * 0.5))
    assert len({input_fingerprint(one) for one in (plain, flat, other)}) == 3


def test_a_lay_and_heights_go_with_it(write_study):
    options = FLAT | {"heights": "measured"}
    assert np.isfinite(results(write_study, options, surfaces=GROUND)["power_loss"]).all()
    options = FLAT | SHARED | {"film_roughness": "patir_cheng"}
    surfaces = {"a": RIDGED | {"lay": "transverse"}}
    assert results(write_study, options, surfaces=surfaces)["balance_error"].max() < 1e-8


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"options": FLAT, "effects": {"micro_ehl": {}}}, r"effects.micro_ehl: and options.flattening = .waves."),
        ({"options": FLAT, "effects": {"asperity_law": {}}}, "effects.asperity_law: reads the roughness outside"),
        ({"options": {"flattening": "wave"}}, "waves"),
        ({"options": {"short_cutoff_over_half_width": 0.0}}, "short_cutoff_over_half_width"),
        ({"options": {"short_cutoff_over_half_width": 50}}, "must be from 0.001 to 10"),
    ],
)
def test_bad_input_is_refused_with_its_place(changes, named, write_study):
    with pytest.raises(InputError, match=named):
        read_study(write_study(**changes))


def flattened(name, **changes):
    case = reference_rigs.case(name)
    return replace(case, system=case.system.model_copy(update=FLAT | changes))


def test_a_case_has_the_friction_of_a_study_with_flattened_waves(write_study):
    """Losses of the reference gears, the same points of the path in both."""
    case, table = flattened("gear_pair"), reference_rigs.table("gear_pair")
    plain = Forward(reference_rigs.case("gear_pair"), table).predict()
    forward = Forward(case, table)
    assert (forward.predict() < plain).all()
    assert not {"micro_ehl", "asperity_law"} & {e.id for e in forward.effects()}
    assert "micro_ehl" in {e.id for e in Forward(reference_rigs.case("gear_pair"), table).effects()}
    sections = case.system.model_dump(include={"gears", "lubricant", "surfaces"}, exclude_unset=True)
    one = {c: table[c][0] for c in ("torque_Nm", "speed_rpm", "oil_temperature_C")}
    path = write_study(
        **sections,
        boundary_friction=case.system.boundary_friction,
        conditions={name: [float(value)] for name, value in one.items()},
        options=FLAT | {"path_points": 24},
        pairings={"pinion": [str(table["pinion_surface"][0])], "gear": [str(table["gear_surface"][0])]},
    )
    assert run_study(read_study(path))["power_loss"].item() == pytest.approx(forward.predict()[0], rel=1e-9)


@pytest.mark.parametrize("name", ["disc", "mesh_friction"])
def test_other_line_contacts_take_it(name):
    table = reference_rigs.table(name)
    plain, flat = (Forward(one, table).predict() for one in (reference_rigs.case(name), flattened(name)))
    assert (np.abs(flat) <= np.abs(plain) * (1.0 + 1e-12)).all()
    assert (flat < plain).any()


@pytest.mark.parametrize("name", ["film", "viscosity"])
def test_other_kinds_refuse_it(name):
    with pytest.raises(InputError, match=r"flattening: .waves.: is of rough contacts along a line"):
        Forward(flattened(name), reference_rigs.table(name))


def test_waves_of_traces_of_several_lengths_average():
    ripple = np.sin(2.0 * np.pi * np.arange(6000) / 50)
    from profiles import Profile

    short, long = Profile(ripple[:3000] * 1e-7, 1e-6), Profile(np.sin(2.0 * np.pi * np.arange(6000) / 500) * 1e-7, 1e-6)
    waves = waves_of([short, long])
    near = np.abs(np.log(waves.lengths / 50e-6)) < 0.2
    assert waves.shares[0][near].sum() == pytest.approx(0.5, abs=0.01)
    assert waves.shares.sum(axis=1) == pytest.approx(1.0)
