"""Calibration of a local friction law: planted coefficients are found again, their intervals hold; bad input."""

import tomllib
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.evaluate import evaluate
from mixedlub.validation.benches import gear_losses as bench
from mixedlub.validation.benches.calorimetric import Errors, Gear
from mixedlub.validation.benches.tables import as_csv
from profiles.errors import InputError
from tests.evaluate.helpers import assert_intervals_hold, written

PLANTED = {"c1": 0.045, "c2": -0.22, "surface_factor.superfinished": 0.85}


def found_of(folder, columns, **changed):
    return evaluate("calibration", written(folder, "calibration", {"readings.csv": as_csv(columns, 9)}, **changed))


@pytest.fixture(scope="module")
def exact():
    return bench.recorded(replace(bench.Bench(), scatter=0.0), Gear(), 0)


@pytest.fixture(scope="module")
def silent(tmp_path_factory, exact):
    return found_of(tmp_path_factory.mktemp("silent"), exact)


def coefficients(found):
    return found.tables["coefficients"].set_index("coefficient")


def scattered(columns, seed):
    gain = 1.0 + 0.03 * np.random.default_rng(seed).standard_normal(len(columns["run"]))
    return {**columns, "load_dependent_loss_W": (np.array(columns["load_dependent_loss_W"]) * gain).tolist()}


def test_planted_coefficients_are_found_where_nothing_scatters(silent):
    found = coefficients(silent)["value"]
    for name, value in PLANTED.items():
        assert found[name] == pytest.approx(value, abs=3e-3 * abs(value))
    fit = silent.tables["fit"].iloc[0]
    assert fit["r_squared_of_loss"] > 0.9999
    assert fit["rms_of_ratio"] < 3e-3


@pytest.mark.literature(
    "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s, figure 8: "
    "R2 93.37 %, all within 25 %"
)
def test_the_fit_is_judged_as_in_the_source(tmp_path, exact):
    found = found_of(tmp_path, scattered(exact, 1))
    fit, rows = found.tables["fit"].iloc[0], found.tables["readings"]
    assert fit["within_25_percent"] == 1.0
    measured, calculated = rows["mean_friction"], rows["calculated_mean_friction"]
    hand = 1.0 - ((measured - calculated) ** 2).sum() / ((measured - measured.mean()) ** 2).sum()
    assert fit["r_squared_of_mean_friction"] == pytest.approx(hand)
    assert 0.93 < hand < 0.999
    assert fit["rms_of_ratio"] == pytest.approx(0.03, rel=0.3)


def test_more_scatter_than_stated_widens_the_intervals(tmp_path, exact):
    sd = 0.003 * np.array(exact["load_dependent_loss_W"])
    told = {**scattered(exact, 1), "load_dependent_loss_W_sd": sd.tolist()}
    wide, plain = (coefficients(found_of(tmp_path, columns))["sd"]["c1"] for columns in (told, scattered(exact, 1)))
    assert wide == pytest.approx(plain, rel=0.1)


def test_known_errors_give_normal_intervals_and_scatter_those_of_student(tmp_path, exact):
    """36 readings for three coefficients: Student's 95 % quantile at 33 degrees of freedom is 1.692."""
    known = {**exact, "load_dependent_loss_W_sd": (0.03 * np.array(exact["load_dependent_loss_W"])).tolist()}
    for columns, wide in ((known, 1.645), (scattered(exact, 1), 1.692)):
        found = coefficients(found_of(tmp_path, columns)).loc[list(PLANTED)]
        half = (found["high90"] - found["low90"]) / 2.0
        assert half.to_numpy() == pytest.approx(wide * found["sd"].to_numpy(), rel=1e-3)


def test_a_study_takes_the_calibrated_law_and_finds_the_mean_friction_again(tmp_path, exact):
    written(tmp_path, "calibration", {"readings.csv": as_csv(exact, 9)})
    assert main(["evaluate", "calibration", str(tmp_path / "calibration.toml"), "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "figures" / "calculated_over_measured.svg").exists()
    readings = pd.read_csv(tmp_path / "out" / "readings.csv")
    row = readings[readings["pinion_surface"] == "superfinished"].iloc[4]
    given = tomllib.loads((tmp_path / "calibration.toml").read_text())
    (tmp_path / "study.toml").write_text(f"""
schema = "mixedlub-study/1"
gears = {{ preset = "high_speed_b", load_sharing = {{ model = "rigid" }} }}
lubricant = {{ temperature_C = [80, 120], kinematic_viscosity_mm2_s = [7.4, 3.7], density_15C_kg_m3 = 1000 }}
surfaces = {{ fine = {{ m0_um2 = {given["surfaces"]["superfinished"]["m0_um2"]}, m2 = 0.0008, m4_per_um2 = 0.0012 }} }}
options = {{ friction = "loepenhaus", friction_coefficients = "out/friction_superfinished.toml" }}
[conditions]
torque_Nm = [{row["torque_Nm"]}]
speed_rpm = [{row["speed_rpm"]}]
oil_temperature_C = [{row["oil_temperature_C"]}]
""")
    out = tmp_path / "study"
    assert main(["study", str(tmp_path / "study.toml"), "--no-figures", "--out", str(out)]) == 0
    found = pd.read_csv(out / "results.csv")["mean_friction"][0]
    assert found == pytest.approx(row["calculated_mean_friction"], rel=1e-3)


def test_a_coefficient_at_a_bound_has_no_interval_and_is_told(tmp_path, exact):
    found = found_of(tmp_path, exact, bounds={"c2": [-0.1, 0.5]})
    row = coefficients(found).loc["c2"]
    assert row["status"] == "at a bound"
    assert row["value"] == pytest.approx(-0.1)
    assert np.isnan(row["sd"])
    assert any("c2 is at a bound" in note for note in found.notes)


def told(columns, own=0.02, **further):
    """Exact losses with stated standard deviations."""
    loss = np.array(columns["load_dependent_loss_W"])
    return {**columns, "load_dependent_loss_W_sd_own": (own * loss).tolist(), **further}


ONE = {
    "coefficients": {"c2": PLANTED["c2"]},
    "bounds": {"c1": [1e-3, 1.0], "c2": None},
    "surface_factor_bounds": {"superfinished": None},
}


def one_coefficient(folder, columns):
    """Standard deviation of c1 alone, in which the law is linear, over c1; and the derivative of the loss by it."""
    found = found_of(folder, columns, **ONE)
    row = coefficients(found).loc["c1"]
    return row["sd"] / row["value"], found.tables["readings"]["calculated_load_dependent_loss_W"].to_numpy()


def test_an_error_common_to_all_widens_a_linear_coefficient_by_itself(tmp_path, exact):
    ground = {name: column[:18] for name, column in exact.items()}
    wide, _ = one_coefficient(tmp_path, told(ground, load_dependent_loss_relative_sd_common=[0.015] * 18))
    assert wide == pytest.approx(np.hypot(0.02 / np.sqrt(18), 0.015), rel=5e-3)
    by_key = coefficients(found_of(tmp_path, told(ground), **ONE, calculated_loss_sd=0.015)).loc["c1"]
    assert by_key["sd"] / by_key["value"] == pytest.approx(wide, rel=1e-6)


@pytest.mark.parametrize("series_sd", [None, 15.0])
def test_a_load_independent_loss_of_a_series_widens_as_a_free_or_known_intercept(tmp_path, exact, series_sd):
    ground = {name: column[:18] for name, column in exact.items()}
    series = [f"{speed:.0f} rpm {oil:.0f} C" for speed, oil in zip(ground["speed_rpm"], ground["oil_temperature_C"])]
    columns = told(ground, series=series)
    if series_sd:
        columns |= {"load_dependent_loss_W_sd_series": [series_sd] * 18}
    wide, loss = one_coefficient(tmp_path, columns)
    own = 0.02 * np.array(ground["load_dependent_loss_W"])
    design = np.stack([loss, *(np.array(series) == name for name in np.unique(series))], axis=1) / own[:, None]
    normal = design.T @ design
    normal[1:, 1:] += np.eye(6) / series_sd**2 if series_sd else 0.0
    assert wide == pytest.approx(np.linalg.inv(normal)[0, 0] ** 0.5, rel=5e-3)


@pytest.mark.parametrize("name", ["load_dependent_loss_relative_sd_common", "load_dependent_loss_W_sd_series"])
def test_errors_that_readings_share_need_their_own_beside_them(tmp_path, exact, name):
    shared = {name: [0.01] * 36, "series": ["one"] * 36}
    with pytest.raises(InputError, match=f"{name}: needs the column load_dependent_loss_W_sd_own|'{name}': needs"):
        found_of(tmp_path, {**exact, **shared})
    with pytest.raises(InputError, match="needs the column 'series'"):
        found_of(tmp_path, told(exact, load_dependent_loss_W_sd_series=[5.0] * 36))


@pytest.mark.parametrize("name", ["load_dependent_loss_relative_sd_common", "series"])
def test_an_error_that_is_shared_is_not_counted_twice(tmp_path, exact, name):
    sd = (0.02 * np.array(exact["load_dependent_loss_W"])).tolist()
    shared = ["one"] * 36 if name == "series" else [0.01] * 36
    with pytest.raises(InputError, match=f"'{name}': needs the column load_dependent_loss_W_sd_own in place of"):
        found_of(tmp_path, {**exact, "load_dependent_loss_W_sd": sd, name: shared})


BAD = [
    ({"coefficients": {"c5": 0.0, "c6": None}, "bounds": {"c6": [0.1, 3.0]}}, r"do not tell these apart.*"),
    ({"coefficients": {"c3": None}, "bounds": {"c3": [1.0, 9.0]}}, "no finite loss in the middle of the bounds"),
    ({"bounds": {"c11": [0.0, 1.0]}}, "no such coefficient; nearest known: 'c1'"),
    ({"bounds": {"c3": [0.0, 1.0]}}, "bounds.c3: is fixed in coefficients too"),
    ({"bounds": {"c1": [1.0, 0.1]}}, "the first bound, 1, must be below the second, 0.1"),
    ({"coefficients": {"c9": None}}, "loepenhaus needs|needs c9"),
    ({"surface_factor_bounds": {"polished": [0.1, 2.0]}}, "no such surface"),
    ({"coefficients": {"surface_factor": 1.0}}, "belongs in surface_factor_bounds"),
]


@pytest.mark.parametrize(("changed", "said"), BAD, ids=[said[:24] for _, said in BAD])
def test_bad_input_is_refused_with_its_place(tmp_path, exact, changed, said):
    with pytest.raises(InputError, match=said):
        found_of(tmp_path, exact, **changed)


def test_a_mixed_pair_has_no_factor(tmp_path, exact):
    with pytest.raises(InputError, match="run 19: gear_surface: 'ground': a surface with a factor must be on both"):
        found_of(tmp_path, {**exact, "gear_surface": ["ground"] * 36})


@pytest.mark.long
def test_intervals_of_coefficients_hold_in_200_runs(tmp_path, exact):
    truth, value, low, high = ([] for _ in range(4))
    for seed in range(200):
        found = coefficients(found_of(tmp_path, scattered(exact, seed))).loc[list(PLANTED)]
        truth.append(list(PLANTED.values()))
        value.append(found["value"].to_numpy())
        low.append(found["low90"].to_numpy())
        high.append(found["high90"].to_numpy())
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))


def run_of(method, file, out):
    assert main(["evaluate", method, str(file), "--no-figures", "--out", str(out)]) == 0
    return out


@pytest.mark.long
def test_intervals_hold_in_200_runs_of_a_calorimeter_whose_errors_are_common(tmp_path, exact):
    truth, value, low, high = ([] for _ in range(4))
    errors = Errors()
    both = float(np.hypot(errors.torque, errors.loss_factor))
    for seed in range(200):
        readings = bench.calorimeter(exact, errors, seed)
        heat = written(tmp_path, "calorimetric", {"readings.csv": as_csv(readings, 9)})
        out = run_of("calorimetric", heat, tmp_path / "heat")
        losses = (out / "loss.csv").read_text(encoding="utf-8")
        path = written(tmp_path, "calibration", {"losses.csv": losses}, readings="losses.csv", calculated_loss_sd=both)
        out = run_of("calibration", path, tmp_path / "fit")
        found = pd.read_csv(out / "coefficients.csv").set_index("coefficient").loc[list(PLANTED)]
        truth.append(list(PLANTED.values()))
        value.append(found["value"].to_numpy())
        low.append(found["low90"].to_numpy())
        high.append(found["high90"].to_numpy())
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))
