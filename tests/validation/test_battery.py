"""The battery: sealed by its seed, written as the contract has it, honest about what it holds."""

import json
import tomllib
from collections import Counter

import numpy as np
import pandas as pd
import pytest

from mixedlub.validation.answers import read_truth
from mixedlub.validation.battery import generate, make, plan
from mixedlub.validation.build import QUANTITY, SURFACE_COLUMNS, chosen, read_case, rig_of
from mixedlub.validation.explain import Target, explain, sensitivity, visibility
from mixedlub.validation.planted import FORMS, NAMED, OUTSIDE
from mixedlub.validation.rig import Calibration, readings
from mixedlub.validation.sealed import toml
from profiles.errors import InputError


def _bytes(folder):
    return {file.name: file.read_bytes() for file in sorted(folder.iterdir())}


def _truth(folder):
    return json.loads((folder / "truth.json").read_text())


def test_same_seed_writes_the_same_bytes(battery, tmp_path):
    orders = plan(11, 8)
    for index in (0, 5):
        make(11, index, orders[index], tmp_path)
        assert _bytes(tmp_path / orders[index].name) == _bytes(battery[index])


def test_another_seed_deals_other_cases():
    assert [order.effects for order in plan(1, 60)] != [order.effects for order in plan(2, 60)]


def test_a_finished_case_is_left_as_it_is(battery):
    before = [(folder / "truth.json").stat().st_mtime_ns for folder in battery]
    generate(battery[0].parent, seed=11, cases=8)
    assert [(folder / "truth.json").stat().st_mtime_ns for folder in battery] == before


def test_a_folder_holds_one_battery_only(battery):
    with pytest.raises(InputError, match="another seed"):
        generate(battery[0].parent, seed=12, cases=8)


def test_too_few_cases_are_refused():
    with pytest.raises(InputError, match="at least 5"):
        plan(1, 4)


def test_a_battery_of_240_holds_every_class_and_nearly_every_effect():
    orders = plan(1, 240)
    classes = Counter(order.label for order in orders)
    assert set(classes) == {"none", "single", "pair", "measurement", "unknown"}
    assert min(classes.values()) >= 24
    hidden = {name for order in orders for name in order.effects}
    assert hidden >= set(NAMED)
    assert len(hidden & set(OUTSIDE)) >= 6
    assert any(order.outliers for order in orders if order.label == "none")
    assert any(order.small for order in orders)
    assert [order.name for order in orders] == [f"case_{i:03d}" for i in range(240)]


def test_names_and_order_tell_nothing(battery):
    classes = [_truth(folder)["class"] for folder in battery]
    assert classes != sorted(classes)


def test_columns_are_those_of_the_contract(battery):
    conditions = {
        "gear_pair": ["torque_Nm", "speed_rpm", "oil_temperature_C"],
        "disc": ["load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C"],
    }
    for folder in battery:
        kind = tomllib.loads((folder / "system.toml").read_text())["kind"]
        names = ["run", "sequence", *SURFACE_COLUMNS[kind], *conditions[kind]]
        assert list(pd.read_csv(folder / "conditions.csv").columns) == names
        assert list(pd.read_csv(folder / "recordings.csv").columns) == [*names, QUANTITY[kind]]


def test_the_answer_is_only_in_the_truth_file(battery):
    for folder in battery:
        words = {*NAMED, *OUTSIDE}
        for file in folder.iterdir():
            if file.name != "truth.json":
                assert not [word for word in words if word in file.read_text()]


def test_recordings_and_conditions_part_the_programme(battery):
    for folder in battery:
        truth = read_truth(folder)
        seen = set(pd.read_csv(folder / "recordings.csv")["run"])
        asked = set(pd.read_csv(folder / "conditions.csv")["run"])
        assert seen == set(truth.run[~truth.withheld].tolist())
        assert asked == set(truth.run[truth.withheld].tolist())
        assert len(seen) >= 20


def test_noise_has_the_stated_size_away_from_outliers(battery):
    z = []
    for folder in battery:
        truth = read_truth(folder)
        table = pd.read_csv(folder / "recordings.csv").set_index("run").iloc[:, -1]
        place = {int(run): i for i, run in enumerate(truth.run)}
        good = [run for run in table.index if run not in truth.outliers]
        at = [place[run] for run in good]
        z += list((table[good].to_numpy() - truth.values[at]) / truth.sd[at])
    assert np.std(z) == pytest.approx(1.0, abs=0.08)
    assert np.max(np.abs(z)) < 5


def test_outliers_stand_out(battery):
    told = [(folder, _truth(folder)["outliers"]) for folder in battery]
    assert any(runs for _, runs in told)
    for folder, runs in told:
        truth = read_truth(folder)
        table = pd.read_csv(folder / "recordings.csv").set_index("run").iloc[:, -1]
        for run in runs:
            place = int(np.flatnonzero(truth.run == run)[0])
            assert abs(table[run] - truth.values[place]) / truth.sd[place] > 4


def test_calibration_is_always_mis_set(battery):
    for folder in battery:
        theta = _truth(folder)["theta"]
        assert theta["boundary_friction"] != 0.1
        assert all(theta[name] != 1.0 for name in theta if name.endswith("_scale"))


def test_truth_and_base_rows_follow_from_what_is_told(battery):
    for folder in battery:
        told = _truth(folder)
        case = read_case(folder)
        theta = {name.removesuffix("_scale"): value for name, value in told["theta"].items()}
        rows = dict(zip(told["rows"]["run"], zip(told["rows"]["truth"], told["rows"]["base"])))
        base = readings(rig_of(case), Calibration(**theta))
        np.testing.assert_allclose(base, [rows[run][1] for run in case.columns["run"]], rtol=1e-7)
        if not told["effects"]:
            np.testing.assert_allclose(base, [rows[run][0] for run in case.columns["run"]], rtol=1e-7)


def test_the_truth_says_whether_the_catalogue_has_the_forms_that_are_hidden(battery):
    declared = {form.law.__name__: form.within for forms in FORMS.values() for form in forms}
    for folder in battery:
        info = _truth(folder)["info"]
        assert all(one["within"] == declared.get(one["law"], False) for one in info)
        assert read_truth(folder).within == (all(one["within"] for one in info) if info else None)


def test_no_rival_beats_the_none_it_contains(battery):
    for folder in battery:
        rivals = _truth(folder)["alternatives"]
        assert max(rivals.values()) <= rivals["none"] + 1e-3


def test_settings_survive_being_written_as_toml(gear_case):
    assert tomllib.loads(toml(gear_case.settings)) == gear_case.settings


def test_a_known_effect_explains_its_own_readings(gear_case):
    part = chosen(gear_case, np.arange(0, len(gear_case.columns["run"]), 2))
    rig = rig_of(part, 32)
    effect = NAMED["churning"]
    knobs = {"strength": 1.0, "speed_power": 1.7, "viscosity_power": 0.2}
    truth = readings(rig, part.nominal, [effect.hide(knobs)])
    target = Target(rig, truth, 0.01 * truth, part.nominal, part.priors)
    assert explain(target, (effect,)).chi_square < 0.1
    assert explain(target).chi_square > 100


def test_visibility_is_the_chi_square_that_recalibration_leaves(gear_case):
    rig = rig_of(gear_case, 32)
    base = readings(rig, gear_case.nominal)
    sd = 0.01 * base
    small = 1e-3 * base * np.cos(np.arange(len(base)))
    slopes = sensitivity(rig, gear_case.nominal, gear_case.priors, np.zeros(5))
    target = Target(rig, base + small, sd, gear_case.nominal, gear_case.priors)
    assert visibility(small, sd, slopes) ** 2 == pytest.approx(explain(target).chi_square, rel=0.02)
    assert visibility(slopes[:, 1], sd, slopes) < 1.0
