"""Calorimetric evaluation: heat balance, load stages, friction planted by an independent rig, bad input."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.evaluate import evaluate
from mixedlub.evaluate.calorimetric import loss_factor
from mixedlub.evaluate.load_stages import LoadStages, split_loss
from mixedlub.evaluate.uncertainty import Errors
from mixedlub.gear import LdpSharing, RigidSharing, local_loss_factor, mesh
from mixedlub.gear.build import gear_pair
from mixedlub.schema.system_file import Gears
from mixedlub.validation.benches import calorimetric as bench
from mixedlub.validation.benches.tables import as_csv
from profiles.errors import InputError
from tests.evaluate.helpers import assert_intervals_hold, written

SILENT = bench.Errors(**dict.fromkeys(bench.Errors.__dataclass_fields__, 0.0))
GEAR = bench.Gear()
SLIDING = bench.sliding_of_mesh(GEAR)


def recorded(seed=0, errors=None, **changed):
    rig = replace(bench.Bench(sliding=SLIDING), errors=errors or bench.Errors(), **changed)
    return bench.recorded(rig, GEAR, seed)


def found_of(folder, columns, **changed):
    return evaluate("calorimetric", written(folder, "calorimetric", {"readings.csv": as_csv(columns)}, **changed))


def test_the_loss_factor_is_that_of_a_mesh_counted_line_by_line():
    pair = gear_pair(Gears.model_validate({"preset": "high_speed_b"}))
    assert local_loss_factor(mesh(pair, RigidSharing()), 1000.0) == pytest.approx(SLIDING, rel=1e-3)


def test_planted_friction_and_idle_loss_are_found_where_nothing_is_uncertain(tmp_path):
    columns, truth = recorded(errors=SILENT)
    found, real = found_of(tmp_path, columns), pd.DataFrame(truth)
    assert found.tables["loss"]["power_loss_W"].to_numpy() == pytest.approx(real["loss"], rel=1e-4)
    assert found.tables["loss"]["mean_friction"].to_numpy() == pytest.approx(real["friction"], rel=1e-3)
    idle = found.tables["series"].sort_values("speed_rpm")["load_independent_loss_W"]
    assert idle.to_numpy() == pytest.approx(np.sort(real["idle"].unique()).repeat(2), rel=1e-3)


@pytest.mark.literature(
    "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s, figure 6"
)
def test_planted_changes_of_the_paper_are_found_again(tmp_path):
    """Friction falls by 28 % from 20 to 95 m/s, and by 30 % with superfinished flanks."""
    series = found_of(tmp_path, recorded(7)[0]).tables["series"]
    speed, ground = series["pitch_line_velocity_m_s"], series["series"].str.contains("ground")
    slow, fast = (series["mean_friction"][ground & (speed.round() == v)].iloc[0] for v in (20, 95))
    smooth = series["mean_friction"][~ground & (speed.round() == 95)].iloc[0]
    assert fast / slow - 1.0 == pytest.approx(-0.28, abs=0.05)
    assert smooth / fast - 1.0 == pytest.approx(-0.30, abs=0.05)


def test_the_loss_factor_of_many_torques_is_that_of_each():
    pair = gear_pair(Gears.model_validate({"preset": "fzg_c"}))
    shared = LdpSharing(tip_relief=(30e-6, 30e-6), relief_length=(2e-3, 2e-3))
    torque = np.linspace(50.0, 400.0, 31)
    direct = local_loss_factor(mesh(pair, shared), torque[7:8])
    assert loss_factor(pair, shared, torque)[7] == pytest.approx(float(direct[0]), rel=2e-3)


def stages(power, factor):
    return LoadStages(power, power, factor)


def split(loss, given):
    exact = Errors(np.ones(loss.size))
    return split_loss("one", np.arange(loss.size), loss, exact, given, relative={}, load_exponent_sd=0.0)


def test_a_loss_factor_that_grows_with_the_load_bends_nothing():
    power = np.linspace(1e4, 4e4, 6)
    given = stages(power, 0.10 + 0.02 * power / 4e4)
    found = split(150.0 + 0.03 * given.product, given)
    assert found.intercept == pytest.approx(150.0, rel=1e-9)
    assert found.slope == pytest.approx(0.03, rel=1e-9)
    over_torque = np.polyfit(power, 150.0 + 0.03 * given.product, 1)[1]
    assert over_torque < 145.0


@pytest.mark.parametrize(("exponent", "percent"), [(0.9, 5.7), (0.95, 2.8), (1.05, -2.6), (1.1, -5.1), (1.17, -8.3)])
def test_friction_that_changes_with_load_moves_the_intercept_by_the_known_share(exponent, percent):
    """Shares computed beside this package for six stages over a fourfold load."""
    power = np.linspace(1.0, 4.0, 6) / 4.0
    found = split(power**exponent, stages(power, np.ones(6)))
    assert 100 * found.intercept == pytest.approx(percent, abs=0.06)


def test_the_budget_adds_up_to_the_stated_uncertainty(tmp_path):
    found = found_of(tmp_path, recorded()[0])
    series, budget = found.tables["series"], found.tables["budget"]
    for _, row in series.iterrows():
        own = budget[budget["series"] == row["series"]]
        for name in ("load_independent_loss_W_sd", "mean_friction_sd"):
            assert np.sqrt((own[name] ** 2).sum()) == pytest.approx(row[name], rel=1e-9)


def test_readings_that_scatter_more_than_stated_widen_the_intervals(tmp_path):
    columns, _ = recorded(errors=replace(SILENT, rise_noise=0.4))
    found = found_of(tmp_path, columns, meters={"rise_noise_K": 0.05})
    assert any("times as much as stated" in text for text in found.notes)


def test_a_stage_without_load_is_a_reading_of_the_idle_loss(tmp_path):
    columns, truth = recorded(errors=SILENT, torques=(0.0, 700.0), speeds=(20.0,), surfaces=(("ground", 1.0),))
    found = found_of(tmp_path, columns)
    assert found.tables["series"]["load_independent_loss_W"][0] == pytest.approx(truth[0]["idle"], rel=1e-3)
    assert np.isnan(found.tables["loss"]["mean_friction"][0])


def test_heat_of_walls_and_shafts_is_added_and_taken_off(tmp_path):
    columns, truth = recorded(errors=SILENT, shaft_share=0.0)
    rows = len(columns["run"])
    columns |= {"housing_temperature_C": [60.0] * rows, "ambient_temperature_C": [20.0] * rows}
    columns |= {"bearing_temperature_C": [t + 10.0 for t in columns["oil_outlet_temperature_C"]]}
    housing = {"shaft_heat_share": 0.0, "shaft_conductance_W_K": 3.0, "wall_conductance_W_K": 0.5}
    found = found_of(tmp_path, columns, housing=housing)
    loss = found.tables["loss"]["power_loss_W"].to_numpy()
    assert loss - [one["loss"] for one in truth] == pytest.approx(np.full(rows, 0.5 * 40.0 - 3.0 * 10.0), abs=0.05)


BAD = [
    ({"oil_flow_L_min": 0.0}, {}, "oil_flow_L_min: 0.0: oil_flow_L_min must be above 0"),
    ({"oil_outlet_temperature_C": 99.5}, {}, "run 1, oil_outlet_temperature_C: 99.5: the oil gets no warmer"),
    ({"speed_rpm": 0.0}, {}, "speed_rpm: 0.0: speed_rpm must be above 0"),
    ({"torque_Nm": 0.0}, {}, "torque_Nm: 0.0: no reading has a load"),
    ({"torque_Nm": 500.0}, {}, "torque_Nm: 500.0: load-independent loss needs load stages at two torques"),
    ({"pinion_surface": "honed"}, {}, "'honed': the file has no such surface"),
    ({}, {"housing": {"wall_conductance_W_K": 1.0}}, "a conductance needs the column 'housing_temperature_C'"),
    ({}, {"housing": {"shaft_conductance_W_K": 1.0}}, "either a share or a conductance"),
    ({}, {"readings": "reading.csv"}, "no such file in"),
]


@pytest.mark.parametrize(("column", "changed", "said"), BAD, ids=[said[:40] for *_, said in BAD])
def test_bad_input_is_refused_with_the_number_that_is_wrong(tmp_path, column, changed, said):
    columns, _ = recorded(speeds=(20.0,), surfaces=(("ground", 1.0),))
    columns |= {name: [value] * len(columns["run"]) for name, value in column.items()}
    with pytest.raises(InputError) as error:
        found_of(tmp_path, columns, **changed)
    assert said in str(error.value)


def test_nothing_is_written_of_bad_input(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    columns, _ = recorded()
    columns["oil_flow_L_min"][3] = -1.0
    path = written(tmp_path, "calorimetric", {"readings.csv": as_csv(columns)})
    assert main(["evaluate", "calorimetric", str(path), "--out", "o"]) == 2
    assert "Traceback" not in capsys.readouterr().err
    assert not (tmp_path / "o").exists()


def test_the_case_is_one_of_gear_loss(tmp_path, capsys):
    path = written(tmp_path, "calorimetric", {"readings.csv": as_csv(recorded()[0])})
    assert main(["evaluate", "calorimetric", str(path), "--no-figures", "--out", str(tmp_path / "o")]) == 0
    assert main(["check", str(tmp_path / "o" / "case")]) == 0
    said = capsys.readouterr().out
    assert "a case of kind gear_pair, recording power_loss_W" in said
    assert "recordings.csv: 60 rows" in said


@pytest.mark.long
def test_intervals_of_friction_and_idle_loss_hold_in_200_runs(tmp_path):
    truth, value, low, high = ([] for _ in range(4))
    for seed in range(200):
        columns, real = recorded(seed, speeds=(20.0, 95.0), surfaces=(("ground", 1.0),))
        found = found_of(tmp_path, columns)
        loss, series, real = found.tables["loss"], found.tables["series"], pd.DataFrame(real)
        truth.append([*real["friction"], *real.groupby("speed")["idle"].first()])
        for ends, name in ((value, ""), (low, "_low90"), (high, "_high90")):
            ends.append([*loss[f"mean_friction{name}"], *series[f"load_independent_loss_W{name}"]])
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))
