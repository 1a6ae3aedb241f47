"""Regression of traction: the planted law is found again, its intervals hold, and studies take it; bad input."""

import math
import tomllib
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.evaluate import evaluate
from mixedlub.friction.condensed import INPUTS
from mixedlub.solutions.regression import design_of
from mixedlub.solutions.stepwise import (
    FOLDS,
    ONE_BY_ONE,
    candidates,
    chosen_terms,
    errors_left_out,
    measured_regression,
)
from mixedlub.validation.benches import traction as bench
from mixedlub.validation.benches.tables import as_csv
from profiles.errors import InputError
from tests.evaluate.helpers import assert_intervals_hold, written

PLANTED = {f"c_{term or 0}": value for term, value in bench.LAW.items()}


def found_of(folder, columns, **changed):
    return evaluate("regression", written(folder, "regression", {"readings.csv": as_csv(columns, 9)}, **changed))


def terms_of(found, law="both signs"):
    table = found.tables["terms"]
    return table[table["law"] == law].set_index("coefficient")


@pytest.fixture(scope="module")
def exact(tmp_path_factory):
    return found_of(tmp_path_factory.mktemp("exact"), bench.recorded(bench.Bench(scatter=1e-4), 1))


def test_the_planted_terms_are_found_and_no_others(exact):
    for law in ("both signs", "first faster", "second faster"):
        found = terms_of(exact, law)["value"].to_dict()
        assert {name for name, value in found.items() if abs(value) > 1e-3} == set(PLANTED)
        for name, value in PLANTED.items():
            assert found[name] == pytest.approx(value, abs=1e-3)


@pytest.mark.parametrize("criterion", ["bic", "p-value"])
def test_scatter_is_told_and_the_intervals_hold_the_strong_terms(tmp_path, criterion):
    columns = bench.recorded(bench.Bench(), 3)
    found = found_of(tmp_path, columns, regression={"terms": criterion, "signs": "together"})
    terms, fit = terms_of(found), found.tables["fits"].iloc[0]
    assert set(PLANTED) <= set(terms.index)
    inside = [(terms["low90"][n] < v) & (v < terms["high90"][n]) for n, v in PLANTED.items()]
    assert sum(inside) >= 5
    assert fit["rms_of_log"] == pytest.approx(0.03, rel=0.15)
    assert fit["left_out_rms_of_log"] > fit["rms_of_log"]
    assert fit["signs_p_value"] > 0.05
    residual = found.tables["readings"]["standardised_residual"]
    assert residual.std() == pytest.approx(1.0, abs=0.05)


def test_signs_that_differ_are_told_and_have_their_own_laws(tmp_path):
    found = found_of(tmp_path, bench.recorded(bench.Bench(first_faster=0.1), 2))
    fits = found.tables["fits"].set_index("law")
    assert fits["first_less_second_of_log"]["both signs"] == pytest.approx(0.1, abs=0.01)
    assert fits["signs_p_value"]["both signs"] < 1e-6
    constants = [terms_of(found, f"{sign} faster")["value"]["c_0"] for sign in ("first", "second")]
    assert constants[0] - constants[1] == pytest.approx(0.1, abs=0.02)


def test_signs_that_slide_unlike_amounts_are_told_apart_from_their_sliding(tmp_path):
    """Sliding is 3.3 times as large where the first disc is faster, friction 0.1 larger at the same sliding."""
    columns, plan = bench.recorded(bench.Bench(), 0), bench.Bench(first_faster=0.1)
    noise = 0.02 * np.random.default_rng(1).standard_normal(len(columns["run"]))
    conditions = ("load_N", "slide_roll_ratio", "entrainment_speed_m_s", "oil_temperature_C")
    for row, (load, ratio, speed, warm) in enumerate(zip(*(columns[name] for name in conditions), strict=True)):
        slid = ratio * math.exp(math.copysign(0.6, ratio))
        friction = bench.friction(plan, bench.hertz_pressure(load), slid, speed, bench.viscosity(warm))
        columns["slide_roll_ratio"][row] = slid
        columns["friction_coefficient"][row] = friction * math.exp(noise[row])
    fit = found_of(tmp_path, columns, regression={"signs": "together"}).tables["fits"].iloc[0]
    assert fit["first_less_second_of_log"] == pytest.approx(0.1, abs=0.01)


def test_signs_with_a_level_of_sliding_each_are_not_told_apart(tmp_path):
    columns = bench.recorded(bench.Bench(ratios=(0.12,)), 0)
    ratio, friction = (np.array(columns[name]) for name in ("slide_roll_ratio", "friction_coefficient"))
    columns["slide_roll_ratio"] = np.where(ratio > 0.0, 0.5, ratio).tolist()
    columns["friction_coefficient"] = np.where(ratio > 0.0, 1.3 * friction, friction).tolist()
    found = found_of(tmp_path, columns)
    assert "c_s" in terms_of(found).index
    assert "first_less_second_of_log" not in found.tables["fits"]


def test_pairs_of_surfaces_have_laws_of_their_own(tmp_path):
    columns = bench.recorded(bench.Bench(), 2)
    count = len(columns["run"])
    columns["surface_1"] = ["ground", "fine"] * (count // 2)
    columns["surface_2"] = ["ground"] * count
    found = found_of(tmp_path, columns, regression={"signs": "together"})
    assert set(found.files) == {"fine_ground_both_signs.toml", "ground_ground_both_signs.toml"}


def test_a_study_takes_the_law_of_the_file(tmp_path, capsys):
    written(tmp_path, "regression", {"readings.csv": as_csv(bench.recorded(bench.Bench(), 3), 9)})
    assert main(["evaluate", "regression", str(tmp_path / "regression.toml"), "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "figures" / "residuals.svg").exists()
    study = """
schema = "mixedlub-study/1"
gears = { preset = "fzg_c" }
lubricant = { oil = "atf" }
surfaces = { ground = { m0_um2 = 0.1, m2 = 0.003, m4_per_um2 = 0.003 } }
conditions = { torque_Nm = [183.4], speed_rpm = [1000, 2000], oil_temperature_C = [60] }
options = { friction = "NAME", friction_coefficients = "out/both_signs.toml" }
"""
    (tmp_path / "study.toml").write_text(study.replace("NAME", "condensed"))
    out = ["--no-figures", "--out", str(tmp_path / "study")]
    assert main(["study", str(tmp_path / "study.toml"), *out]) == 0
    results = np.genfromtxt(tmp_path / "study" / "results.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert np.all((results["mean_friction"] > 0.01) & (results["mean_friction"] < 0.1))
    (tmp_path / "study.toml").write_text(study.replace("NAME", "loepenhaus"))
    capsys.readouterr()
    assert main(["study", str(tmp_path / "study.toml"), *out]) == 2
    assert "has coefficients of friction = 'condensed', not of 'loepenhaus'" in capsys.readouterr().err


def test_the_law_file_says_its_range_and_leaves_no_coefficient_out(exact):
    file = tomllib.loads(exact.files["both_signs.toml"])
    assert file["coefficients"]["c_pp"] == 0.0
    assert file["coefficients"]["largest_slide_roll_ratio"] == 0.5
    assert file["fit"]["readings"] == 162


BAD = [
    ({"friction_coefficient": -0.01}, "friction_coefficient must be above 0"),
    ({"slide_roll_ratio": 0.0}, "slide_roll_ratio: 0.0: no reading has sliding"),
]


@pytest.mark.parametrize(("value", "said"), BAD, ids=["negative", "rest"])
def test_bad_readings_are_refused(tmp_path, value, said):
    columns = bench.recorded(bench.Bench(), 0)
    columns |= {name: [cell] * len(columns["run"]) for name, cell in value.items()}
    with pytest.raises(InputError, match=said):
        found_of(tmp_path, columns)


def test_too_few_readings_are_refused(tmp_path):
    columns = {name: cells[:8] for name, cells in bench.recorded(bench.Bench(), 0).items()}
    with pytest.raises(InputError, match=r"readings\.csv: 8: a regression needs 10 readings or more"):
        found_of(tmp_path, columns)


@pytest.mark.long
def test_intervals_of_coefficients_hold_in_200_runs():
    """Of the planted terms, in a plan where they are strong; weak ones may be left out."""
    plan = replace(bench.Bench(), scatter=0.03)
    truth, value, low, high = ([] for _ in range(4))
    extra = []
    for seed in range(200):
        columns = bench.recorded(plan, seed)
        values = {
            "hertz_pressure": np.array([bench.hertz_pressure(load) for load in columns["load_N"]]),
            "slide_roll_ratio": np.abs(columns["slide_roll_ratio"]),
            "entrainment_speed": np.array(columns["entrainment_speed_m_s"]),
            "viscosity": np.array([bench.viscosity(t) for t in columns["oil_temperature_C"]]),
            "radius": np.full(len(columns["run"]), 15.24),
        }
        found = measured_regression(values, np.array(columns["friction_coefficient"]), 2, "bic").terms
        found = found.set_index("coefficient")
        assert set(PLANTED) <= set(found.index)
        extra.append(len(found) - len(PLANTED))
        rows = found.loc[list(PLANTED)]
        truth.append(list(PLANTED.values()))
        value.append(rows["value"].to_numpy())
        low.append((rows["value"] - 1.655 * rows["standard_error"]).to_numpy())
        high.append((rows["value"] + 1.655 * rows["standard_error"]).to_numpy())
    assert np.mean(extra) < 1.0
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))


def test_a_term_that_others_make_up_is_not_chosen():
    x = np.linspace(0.1, 1.0, 40)
    same = {"hertz_pressure": x, "slide_roll_ratio": x, "entrainment_speed": x, "viscosity": x, "radius": x}
    design = design_of(same)
    kept = chosen_terms(design[["c_0", "c_p", "c_s", "c_u"]], np.log(x) + 1e-6 * np.sin(40 * x), "p-value")
    assert len(kept) == 2
    assert kept[0] == "c_0"


def scattered_design(random, count):
    inputs = {one.name: one.middle * np.exp(random.uniform(-1.0, 1.0, count)) for one in INPUTS}
    return design_of(inputs)[candidates("psuv", 2)]


def test_the_error_of_readings_left_out_is_that_of_fresh_readings():
    """24 readings that depend on nothing: with the terms chosen once, the square of it is two thirds as large."""
    left_out, fresh = [], []
    for seed in range(20):
        random = np.random.default_rng(seed)
        design, wanted = scattered_design(random, 24), random.standard_normal(24)
        error, parts = errors_left_out(design, wanted, "bic")
        left_out.append(np.mean(error**2))
        assert parts == 24
        kept = chosen_terms(design, wanted, "bic")
        found = np.linalg.lstsq(design[kept].to_numpy(), wanted, rcond=None)[0]
        fresh.append(1.0 + np.mean((scattered_design(random, 500)[kept].to_numpy() @ found) ** 2))
    assert np.mean(left_out) == pytest.approx(np.mean(fresh), rel=0.15)


def test_many_readings_are_left_out_in_ten_parts():
    random = np.random.default_rng(0)
    design = scattered_design(random, ONE_BY_ONE + 1)
    error, parts = errors_left_out(design, design["c_p"].to_numpy() + 0.1 * random.standard_normal(len(design)), "bic")
    assert parts == FOLDS
    assert error.std() == pytest.approx(0.1, rel=0.15)
