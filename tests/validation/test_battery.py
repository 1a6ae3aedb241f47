"""The battery: fixed by its seed, in the form of the contract, true to what it says of itself."""

import tomllib
from collections import Counter

import numpy as np
import pandas as pd
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.validation import sample_case as sampling
from mixedlub.validation.answers import read_truth
from mixedlub.validation.battery import MARK, generate, make, plan, read_mark
from mixedlub.validation.case_folder import read_case as read_planted
from mixedlub.validation.case_folder import toml
from mixedlub.validation.contact import Calibration
from mixedlub.validation.planted import FORMS, MEASUREMENT, NAMED, OUTSIDE
from mixedlub.validation.rigs import CLASSES, KINDS, OTHERS, discs, family_of, gears, histories
from mixedlub.validation.rivals import Target, best, rivals, sensitivity, visibility
from mixedlub.validation.sample_case import Order, Sample, sample_case, withhold
from profiles.errors import InputError

from .conftest import SEED
from .helpers import readings, truth_of

pytestmark = pytest.mark.long

INPUTS = {"gear_pair": gears.inputs_of, "disc": discs.inputs_of}


def _bytes(folder):
    return {file.name: file.read_bytes() for file in sorted(folder.iterdir())}


def _recorded(folder):
    """Readings handed over, by run, and their quantity."""
    quantity = tomllib.loads((folder / "system.toml").read_text())["recording"]["quantity"]
    return pd.read_csv(folder / "recordings.csv").set_index("run")[quantity]


def test_same_seed_writes_the_same_bytes(battery, others, named_orders, tmp_path):
    orders = plan(11, 8)
    for index in (1, 4):
        make(11, index, orders[index], tmp_path / "battery")
        assert _bytes(tmp_path / "battery" / orders[index].name) == _bytes(battery[index])
    for place, (name, order) in enumerate(named_orders.items()):
        if place % 6 == 0:
            make(SEED, place, order, tmp_path / "others")
            assert _bytes(tmp_path / "others" / order.name) == _bytes(others[name])


def test_another_seed_deals_other_cases():
    assert [order.effects for order in plan(1, 60)] != [order.effects for order in plan(2, 60)]


def test_a_finished_case_is_left_as_it_is(battery):
    before = [(folder / "truth.json").stat().st_mtime_ns for folder in battery]
    generate(battery[0].parent, seed=11, cases=8)
    assert [(folder / "truth.json").stat().st_mtime_ns for folder in battery] == before


def test_a_folder_holds_one_battery_only(battery):
    with pytest.raises(InputError, match="other kinds, seed"):
        generate(battery[0].parent, seed=12, cases=8)
    with pytest.raises(InputError, match="other kinds, seed"):
        generate(battery[0].parent, seed=11, cases=8, kinds=("disc",))
    with pytest.raises(InputError, match="or planner"):
        generate(battery[0].parent, seed=11, cases=8, dealt=lambda seed, cases, kinds: plan(seed, cases, kinds))


@pytest.mark.parametrize("text", ["", '{"seed": 1', "[1, 2]", '{"dealt_by": ["plan"]}', '{"dealt_by": null}'])
def test_a_damaged_file_of_a_battery_is_refused(text, tmp_path):
    (tmp_path / MARK).write_text(text)
    with pytest.raises(InputError, match="damaged"):
        read_mark(tmp_path)


@pytest.mark.parametrize(("kinds", "fewest"), [(("gear_pair", "disc"), 5), (OTHERS, 25), (tuple(KINDS), 35)])
def test_too_few_cases_are_refused(kinds, fewest):
    with pytest.raises(InputError, match=f"at least {fewest}"):
        plan(1, fewest - 1, kinds)
    assert {(order.kind in INPUTS, order.label) for order in plan(1, fewest, kinds)} >= {
        (kind in INPUTS, label) for kind in kinds for label in CLASSES
    }


def test_a_battery_of_240_holds_every_class_and_nearly_every_effect():
    orders = plan(1, 240)
    classes = Counter(order.label for order in orders)
    assert set(classes) == set(CLASSES)
    assert min(classes.values()) >= 24
    hidden = {name for order in orders for name in order.effects}
    assert hidden >= set(NAMED)
    assert len(hidden & set(OUTSIDE)) >= 6
    assert any(order.outliers for order in orders if order.label == "none")
    assert any(order.small for order in orders)
    assert [order.name for order in orders] == [f"case_{i:03d}" for i in range(240)]


def test_a_battery_of_other_kinds_holds_each_as_often_in_every_class_under_neutral_names():
    orders = plan(1, 100, OTHERS)
    assert Counter(order.kind for order in orders) == dict.fromkeys(OTHERS, 20)
    for kind in OTHERS:
        assert {order.label for order in orders if order.kind == kind} == set(CLASSES)
    assert [order.name for order in orders] == [f"case_{i:03d}" for i in range(100)]
    assert all(set(order.effects) <= MEASUREMENT for order in orders if order.label == "measurement")


def test_only_the_chosen_kinds_are_dealt():
    assert {order.kind for order in plan(1, 20, ("disc", "viscosity"))} == {"disc", "viscosity"}


def test_names_and_order_say_nothing_of_the_class(battery):
    classes = [truth_of(folder)["class"] for folder in battery]
    assert classes != sorted(classes)


def test_columns_of_gears_and_discs_are_those_of_the_contract(battery):
    conditions = {
        "gear_pair": ["pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C"],
        "disc": [
            *("surface_1", "surface_2", "load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C")
        ],
    }
    quantity = {"gear_pair": "power_loss_W", "disc": "friction_coefficient"}
    for folder in battery:
        kind = tomllib.loads((folder / "system.toml").read_text())["kind"]
        names = ["run", "sequence", *conditions[kind]]
        assert list(pd.read_csv(folder / "conditions.csv").columns) == names
        assert list(pd.read_csv(folder / "recordings.csv").columns) == [*names, quantity[kind]]


def test_every_case_is_read_without_complaint_of_its_form(folders):
    for folder in folders:
        assert read_case(folder).kind.name == truth_of(folder)["rig"]


def test_the_answer_is_only_in_the_truth_file(battery):
    for folder in battery:
        words = {*NAMED, *OUTSIDE}
        for file in folder.iterdir():
            if file.name != "truth.json":
                assert not [word for word in words if word in file.read_text()]


def test_recordings_and_conditions_share_out_the_programme_and_withheld_readings_are_nowhere(folders):
    for folder in folders:
        truth = read_truth(folder)
        seen, wanted = (pd.read_csv(folder / name) for name in ("recordings.csv", "conditions.csv"))
        assert set(seen["run"]) == set(truth.run[~truth.withheld])
        assert set(wanted["run"]) == set(truth.run[truth.withheld])
        assert not [name for name in wanted if name.startswith(_recorded(folder).name)]


def test_noise_has_the_size_in_the_truth_and_outliers_stand_out(folders):
    z = []
    assert any(truth_of(folder)["outliers"] for folder in folders)
    for folder in folders:
        truth, table = read_truth(folder), _recorded(folder)
        place = {int(run): i for i, run in enumerate(truth.run)}
        at = [place[run] for run in table.index]
        far = (table.to_numpy() - truth.values[at]) / truth.sd[at]
        wild = np.isin(table.index, list(truth.outliers))
        assert (np.abs(far[wild]) > 4).all()
        z.append(far[~wild])
    everything = np.concatenate(z)
    assert np.std(everything) == pytest.approx(1.0, abs=0.05)
    assert np.max(np.abs(everything)) < 5


def test_effects_are_as_visible_as_ordered(others, named_orders):
    for name, order in named_orders.items():
        low, high = {"pair": (9.0, 26.0), "none": (0.0, 0.0)}.get(order.label, (15.0, 32.0))
        if order.level == "faint":
            low, high = 6.5, 11.6
        assert low <= read_truth(others[name]).visibility <= high


def test_calibration_is_always_mis_set(battery):
    for folder in battery:
        theta = truth_of(folder)["theta"]
        assert theta["boundary_friction"] != 0.1
        assert all(theta[name] != 1.0 for name in theta if name.endswith("_scale"))


def test_truth_and_base_rows_follow_from_the_truth_file(battery):
    for folder in battery:
        truth = truth_of(folder)
        case = read_planted(folder)
        theta = {name.removesuffix("_scale"): value for name, value in truth["theta"].items()}
        rows = dict(zip(truth["rows"]["run"], zip(truth["rows"]["truth"], truth["rows"]["base"])))
        base = readings(INPUTS[case.kind](case), Calibration(**theta))
        np.testing.assert_allclose(base, [rows[run][1] for run in case.columns["run"]], rtol=1e-7)
        if not truth["effects"]:
            np.testing.assert_allclose(base, [rows[run][0] for run in case.columns["run"]], rtol=1e-7)


def test_base_model_is_that_of_the_contract_where_the_case_describes_everything(others):
    """Independent formulas: what `simulate` gives, wherever the case leaves nothing to broad priors."""
    compared = set()
    for folder in others.values():
        lubricant = tomllib.loads((folder / "system.toml").read_text()).get("lubricant", {})
        if "pressure_viscosity_per_GPa" not in lubricant:
            continue
        case = read_case(folder)
        simulated = Forward(case, case.recordings).predict()
        nominal = dict(zip(truth_of(folder)["rows"]["run"], truth_of(folder)["rows"]["nominal"]))
        expected = np.array([nominal[int(run)] for run in case.recordings["run"]])
        assert simulated == pytest.approx(expected, rel=1e-4)
        compared.add(case.kind.name)
    assert {"film", "mesh_friction", "friction_history"} <= compared


def test_the_truth_says_whether_the_catalogue_has_the_planted_forms(battery):
    declared = {form.law.__name__: form.within for forms in FORMS.values() for form in forms}
    for folder in battery:
        info = truth_of(folder)["info"]
        assert all(one["within"] == declared.get(one["law"], False) for one in info)
        assert read_truth(folder).within == (all(one["within"] for one in info) if info else None)


def test_planted_effects_are_known_by_the_names_of_the_catalogue(folders):
    for folder in folders:
        truth, case = read_truth(folder), read_case(folder)
        known = {effect.id for effect in Forward(case, case.recordings).effects()}
        assert truth.label <= known | {"none", "unknown"}


def test_no_rival_beats_the_none_it_contains(folders):
    for folder in folders:
        found = truth_of(folder)["alternatives"]
        assert max(found.values()) <= found["none"] + 1e-3


def test_the_truth_explains_its_case_and_none_does_not(folders):
    for folder in folders:
        found = truth_of(folder)
        if found["class"] in ("single", "measurement", "pair"):
            assert found["own"] < found["alternatives"]["none"] - (0 if found["unnamed_oil"] else 30)
            assert found["effects"][0] not in found["alternatives"] or found["class"] == "pair"


def test_pairs_have_rivals_with_one_of_the_two_exchanged(others):
    swapped = [name for name in truth_of(others["map, two flanks"])["alternatives"] if "+" in name]
    assert swapped
    assert all(("stribeck" in name) != ("direction_dependence" in name) for name in swapped)


def test_settings_survive_being_written_as_toml(gear_case):
    assert tomllib.loads(toml(gear_case.settings)) == gear_case.settings


@pytest.mark.parametrize("kind", KINDS)
def test_every_form_is_absent_at_zero_and_finite_at_its_usual_size(kind):
    rng = np.random.default_rng(8)
    seen = set()
    for _ in range(4 if kind in INPUTS else 40):
        rig = KINDS[kind].draw(rng)
        z = np.zeros(len(rig.names))
        base = rig.model(z, ())
        for form in (*rig.forms, *rig.outside):
            usual = {knob.name: float(np.mean(knob.typical)) for knob in form.knobs}
            off = rig.model(z, [form.hide({**usual, "strength": 0.0})])
            assert off == pytest.approx(base, rel=1e-6), form.law.__name__
            assert np.isfinite(rig.model(z, [form.hide(usual)])).all(), form.law.__name__
            seen.add(form.id)
    first = {name for name, *_ in KINDS[kind].pairs}
    assert first | {name for _, partners, _ in KINDS[kind].pairs for name in partners} <= seen | {"coating_insulation"}


def test_histories_withhold_a_level_or_else_a_stretch_of_time():
    """Six in ten a whole slip, six in ten of the others a twelfth of the programme at a stretch."""
    rng = np.random.default_rng(4)
    rig = histories.draw_traction(rng)
    slip, count = rig.columns["slide_roll_ratio"], len(rig.columns["run"])
    whole, stretch = 0, 0
    for _ in range(300):
        hidden = withhold(rng, rig, family_of("friction_history"))
        level = any(hidden[slip == one].all() for one in np.unique(slip))
        whole += level
        stretch += not level and "1" * (count // 12) in "".join("01"[flag] for flag in hidden.astype(int))
    assert whole / 300 == pytest.approx(0.6, abs=0.09)
    assert stretch / 300 == pytest.approx(0.24, abs=0.08)


@pytest.mark.parametrize(
    ("kind", "effects"),
    [
        ("viscosity", ("sensor_offset",)),
        ("viscosity", ("pressure_viscosity_law", "sensor_offset")),
        ("film", ("sensor_offset",)),
        ("film", ("inlet_shear_heating", "fringe_order")),
    ],
)
def test_no_fault_of_an_instrument_makes_a_quantity_negative(kind, effects):
    """A viscosity has to be above zero; films are but for their noise."""
    order = Order("", kind, "pair" if len(effects) == 2 else "measurement", effects, "clear")
    for seed in range(30):
        sample = sample_case(np.random.default_rng(seed), order)
        assert sample.rig.model(sample.z, sample.acts).min() > 0


def test_a_fault_that_always_makes_a_quantity_negative_is_refused(monkeypatch):
    monkeypatch.setattr(Sample, "possible", False)
    monkeypatch.setattr(sampling, "MOST_RIGS", 3)
    with pytest.raises(InputError, match="can be read"):
        sample_case(np.random.default_rng(1), Order("", "film", "measurement", ("sensor_offset",), "clear"))


def test_a_known_effect_explains_its_own_readings(gear_case):
    rig = gears.rig_of(gear_case)
    z, rows = np.zeros(5), np.arange(0, len(gear_case.columns["run"]), 2)
    effect = NAMED["churning"]
    truth = rig.model(z, [effect.hide({"strength": 1.0, "speed_power": 1.7, "viscosity_power": 0.2})])[rows]
    target = Target(rig, rows, truth, 0.01 * truth)
    assert best(target, (effect,), z).chi_square < 0.1
    assert best(target, (), z).chi_square > 100


def test_visibility_is_the_chi_square_that_recalibration_leaves(gear_case):
    rig, z = gears.rig_of(gear_case), np.zeros(5)
    base = rig.model(z, ())
    sd = 0.01 * base
    small = 1e-3 * base * np.cos(np.arange(len(base)))
    slopes = sensitivity(rig, z)
    target = Target(rig, np.arange(len(base)), base + small, sd)
    assert visibility(small, sd, slopes) ** 2 == pytest.approx(best(target, (), z).chi_square, rel=0.02)
    assert visibility(slopes[:, 1], sd, slopes) < 1.0


def test_a_more_general_form_is_no_rival_of_its_special_case():
    sample = sample_case(
        np.random.default_rng(2), Order("", "friction_history", "single", ("friction_run_in",), "clear")
    )
    truth = sample.rig.model(sample.z, sample.acts)
    target = Target(sample.rig, np.arange(len(truth)), truth, sample.sd(truth))
    simple = rivals(target, sample.forms, sample.knobs, sample.z, 0)
    every = rivals(target, sample.forms, sample.knobs, sample.z, 2)
    assert "two_time_scales" not in simple
    assert "two_time_scales" in every
    assert best(target, sample.forms, sample.z, sample.knobs).chi_square <= sample.z @ sample.z + 1e-6
