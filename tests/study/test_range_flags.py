"""Every row of a study says whether it is within the model's range, and why not."""

import csv
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.laws.contact import line_hertz_half_width
from mixedlub.schema.findings import Severity, codes
from mixedlub.study import read_study, run_study
from mixedlub.study.validity import out_of_range

THICK = {
    "surfaces": {"a": {"m0_um2": 4e-4, "m2": 2e-4, "m4_per_um2": 4e-4}},
    "conditions__speed_rpm": [3000],
    "conditions__oil_temperature_C": [40],
}


def rows_of(study, tmp_path):
    run_study(study).write(tmp_path / "r.csv", tmp_path / "r.parquet")
    with (tmp_path / "r.csv").open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("torque", [15_000, 150_000])
def test_flanks_pressed_beyond_steel_are_told(torque, write_study):
    """12 GPa, where bearings are rated to 4.2 GPa."""
    study = read_study(write_study(**{**THICK, "conditions__torque_Nm": [torque]}))
    (told,) = (one for one in out_of_range(run_study(study)) if one.code == "pressure_above_yield")
    assert told.severity == "doubt"


def test_hertz_pressure_is_the_largest_of_the_path(write_study):
    """At one torque a hundred times another it is ten times as high."""
    found = run_study(read_study(write_study(**{**THICK, "conditions__torque_Nm": [150, 15_000]})))["hertz_pressure"]
    low, high = found.ravel()
    assert high == pytest.approx(10 * low, rel=1e-9)
    assert low == pytest.approx(1.26e9, rel=0.01)


def test_every_row_says_why_it_is_outside(write_study, tmp_path):
    study = read_study(write_study(conditions__torque_Nm=[50, 15_000]))
    for row in rows_of(study, tmp_path):
        reasons = row["validity"].split("; ")
        assert ("pressure_above_yield" in reasons) == (float(row["torque_Nm"]) > 1000)
        assert ("asperities_overloaded" in reasons) == (float(row["asperity_load_ratio"]) > 1.0)


def test_a_row_within_the_range_is_valid(write_study, tmp_path):
    rows = rows_of(read_study(write_study(**THICK)), tmp_path)
    assert {row["validity"] for row in rows} == {"valid"}


def test_labelled_result_has_the_validity(write_study):
    data = run_study(read_study(write_study())).to_xarray()
    outside = (data["asperity_load_ratio"] > 1) | (data["asperity_real_pressure_MPa"] > 8000)
    assert ((data["validity"] != "valid") == outside).all()


def overloaded(write_study, effects, **changes):
    """Largest asperity load ratio of the rough pairing, by torque and speed."""
    rough = {"rough": {"m0_um2": 0.3, "m2": 0.003, "m4_per_um2": 0.004}}
    study = read_study(write_study(surfaces=rough, effects=effects, **changes))
    return run_study(study)["asperity_load_ratio"]


def test_yielding_asperities_carry_less(write_study):
    elastic = overloaded(write_study, {})
    yielding = overloaded(write_study, {"asperity_plasticity": {"hardness": 6e9}})
    never = overloaded(write_study, {"asperity_plasticity": {"hardness": 6e13}})
    assert (yielding < 0.6 * elastic).all()
    assert never == pytest.approx(elastic, rel=1e-6)


def test_load_of_asperities_is_the_largest_of_the_path(write_study):
    """Not that at the thinnest film: where the load changes hands films are as thin at half the pressure."""
    study = read_study(write_study())
    plan = study.plan
    chain = ("separation", "summit_density", "summit_radius", "summit_sigma")
    model = plan.model()
    state = model(plan.inputs)
    carried = plan.asperities(*(state[name] for name in chain), plan.inputs["reduced_modulus"])
    ratio = carried / (0.25 * np.pi * state["hertz_pressure"])
    found = run_study(study)["asperity_load_ratio"]
    assert found == pytest.approx(ratio.max(axis=-1), rel=0.04)


def test_an_area_ratio_is_never_above_one(write_study):
    """A mean of ones over the path may round to more."""
    full = {"a": {"m0_um2": 100.0, "m2": 0.0025, "m4_per_um2": 0.9}}
    every = {"conditions__speed_rpm": {"from": 100, "to": 3000, "count": 30}}
    assert run_study(read_study(write_study(surfaces=full, **every)))["area_ratio"].max() == 1.0


@pytest.mark.parametrize(("centre_distance_mm", "doubted"), [(91.1, False), (91.5, False), (92.0, True)])
def test_a_centre_distance_that_leaves_the_flanks_far_apart_is_doubted(centre_distance_mm, doubted, write_study):
    """Backlash is 2 tan(22.5 deg) times what the centre distance exceeds 91.017 mm by: 0.40 mm at 91.5, 0.81 at 92."""
    notes = read_study(write_study(gears__centre_distance_mm=centre_distance_mm)).notes
    assert ("backlash_large" in codes(notes)) == doubted


@pytest.mark.parametrize(
    ("changes", "law", "place"),
    [
        ({"conditions__speed_rpm": [100_000]}, "dowson_toyoda", "options.film"),
        ({"lubricant__pressure_viscosity_per_GPa": [60.0, 45.0]}, "ree_eyring", "options.effective_viscosity"),
    ],
)
def test_laws_of_the_base_model_are_flagged_outside_their_range(changes, law, place, write_study):
    """A pitch line at 380 m/s, and films whose friction would be ten times that of asperities."""
    results = run_study(read_study(write_study(**changes)))
    assert results.flags[f"law_extrapolated:{law}"].any()
    assert place in {one.place for one in out_of_range(results) if one.code == "law_extrapolated"}


@pytest.mark.parametrize(("oil_temperature_C", "doubted"), [(-20, False), (-60, True)])
def test_a_film_thicker_than_its_contact_is_wide_is_doubted(oil_temperature_C, doubted, write_study):
    """The width of the Hertz contact from load and radius, at every point of the path."""
    study = read_study(write_study(conditions__oil_temperature_C=[oil_temperature_C]))
    results = run_study(study)
    told = [one for one in out_of_range(results) if one.code == "film_above_contact_width"]
    assert [one.severity for one in told] == [Severity.DOUBT] * doubted
    state = {**study.plan.inputs, **study.plan.model(("line_load",))(study.plan.inputs)}
    width = 2.0 * line_hertz_half_width(state["line_load"], state["radius"], state["reduced_modulus"])
    assert (np.max(state["film_thickness"] / width) > 1.0) == doubted


def test_a_case_says_of_its_rows_what_a_study_says_of_the_same_conditions():
    case = read_case(Path(__file__).parents[2] / "examples" / "case")
    rows = case.recordings.take(np.arange(0, 72, 5))
    judged = judge_rows(Forward(case, rows))
    system, flagged = case.system, Counter()
    asperities = ("asperities_overloaded", "asperities_above_hardness")
    conditions = ("torque_Nm", "speed_rpm", "oil_temperature_C")
    for i in range(len(rows)):
        both = [system.surfaces[str(rows[name][i])] for name in ("pinion_surface", "gear_surface")]
        at = {name: float(rows[name][i]) for name in conditions}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ml.CautionWarning)
            found = ml.power_loss(system.gears, system.lubricant, both, **at)
        flagged.update(code for code in asperities if code in str(found["validity"].values))
    for code in asperities:
        assert 0 < flagged[code] < len(rows)
        assert sum(code in words for words in judged.words) == flagged[code]
    assert codes(judged.findings) == [*asperities, "law_extrapolated"]


def test_a_foundation_outside_its_range_is_flagged_in_every_row(write_study):
    """Sainsot's ring holds for half root angles up to 0.12 rad; those of 17 teeth have 0.13."""
    sharing = {"model": "ldp", "foundation": "sainsot", "bore_diameter_mm": [30.0, 40.0]}
    study = read_study(write_study(gears__load_sharing=sharing))
    results = run_study(study)
    assert results.flags["law_extrapolated:load_sharing"].all()
    assert codes(results.findings).count("law_extrapolated") == 1, "that on the pinion, no second one for the rows"


def test_a_loss_factor_beyond_its_contact_ratio_is_left_out_and_said(write_study):
    long = {"teeth": [60, 70], "normal_module_mm": 2.0, "pressure_angle_deg": 15.0, "tip_diameter_mm": None}
    study = read_study(write_study(**{f"gears__{key}": value for key, value in long.items()}))
    assert study.pair.contact_ratio > 2.0
    assert "loss_factor_left_out" in codes(study.notes)
    assert "loss_factor" not in run_study(study).values


RELIEVED = {"model": "ldp", "tip_relief_um": [30.0, 30.0], "relief_length_mm": [2.0, 2.0]}


@pytest.mark.parametrize("balance", ["none", "johnson_greenwood_poon"])
def test_ends_of_the_path_that_relief_unloads_raise_no_flag(balance, write_study):
    """They carry nothing, or a few hundredths of the load, where no film is flattened and asperities carry more."""
    options = {"balance": balance, "mixture": "tallian" if balance == "none" else "load_weighted"}
    changes = {"surfaces": THICK["surfaces"], "options": options, "conditions__oil_temperature_C": [60]}
    relieved = run_study(read_study(write_study(gears__load_sharing=RELIEVED, **changes)))
    assert not relieved.flags, relieved.flags


def test_a_law_out_of_range_where_the_load_is_stays_flagged(write_study):
    """At 2 N m the whole path is below the least load of the film law."""
    light = read_study(write_study(gears__load_sharing=RELIEVED, conditions__torque_Nm=[2, 150]))
    flagged = run_study(light).flags["law_extrapolated:dowson_toyoda"]
    assert flagged[:, :, 0].all()
    assert not flagged[:, :, 1].any()


@pytest.mark.parametrize(
    ("churning", "flagged"),
    [
        ({"law": "Changenet and Velex"}, False),
        ({"viscous": 0.21, "surplus": 0.38, "second_law": 0.0}, True),
        ({"viscous": 0.21, "surplus": 0.38, "second_law": -0.5}, True),
        ({"viscous": 0.21, "surplus": 0.38, "second_law": 0.5}, True),
        ({"law": "ISO/TR 14179-1"}, False),
        ({"law": "Boness, turbulent"}, False),
    ],
)
def test_the_first_law_of_churning_is_flagged_at_high_speed(churning, flagged, write_study):
    """Oil on the rim of the wheel has 645 m/s^2 at 3000 rpm of the pinion; the limit that its authors give is 750."""
    speeds = {"conditions__speed_rpm": [500, 3000, 3500]}
    results = run_study(read_study(write_study(effects={"churning": churning}, **speeds)))
    where = results.flags.get("law_extrapolated:churning", np.zeros((1, 1, 1, 3), bool))
    assert where.any(axis=(0, 1, 2)).tolist() == [False, False, flagged]
    told = [one.text for one in results.findings if one.place == "effects.churning"]
    assert any("750 m/s^2" in text for text in told) == flagged
