"""Blind cases of the five other kinds: sealed by their seed, fair to the base model, honest about what they hold."""

import json
import tomllib
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.cli import app
from mixedlub.validation.answers import read_truth
from mixedlub.validation.build import oil_of
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.rigs import battery, film, mesh, viscosity
from mixedlub.validation.rigs.battery import ROOMS, Order, deal, make, plan
from mixedlub.validation.rigs.drive import Drive, gaussian
from mixedlub.validation.rigs.fit import Aim, best, rivals
from mixedlub.validation.rigs.prove import BROKEN, Steady, judge
from profiles.errors import InputError

ORDERS = (
    Order("case_000", "film", "none", (), "clear", outliers=True),
    Order("case_001", "film", "measurement", ("fringe_step",), "clear"),
    Order("case_002", "friction_history", "single", ("contact_creep",), "faint"),
    Order("case_003", "friction_history", "unknown", ("humming",), "clear"),
    Order("case_004", "friction_map", "single", ("stribeck",), "clear"),
    Order("case_005", "friction_map", "pair", ("stribeck", "direction_dependence"), "clear"),
    Order("case_006", "viscosity", "single", ("viscosity_drift",), "clear"),
    Order("case_007", "viscosity", "none", (), "clear"),
    Order("case_008", "mesh_friction", "single", ("film_heating",), "clear"),
    Order("case_009", "friction_history", "measurement", ("sensor_gain",), "clear"),
)
SEED = 10


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    folder = tmp_path_factory.mktemp("benches")
    return [folder / make(SEED, place, order, folder) for place, order in enumerate(ORDERS)]


def told(folder):
    return json.loads((folder / "truth.json").read_text())


def test_same_seed_writes_the_same_bytes(cases, tmp_path):
    for place in (1, 4):
        make(SEED, place, ORDERS[place], tmp_path)
        for file in cases[place].iterdir():
            assert (tmp_path / ORDERS[place].name / file.name).read_bytes() == file.read_bytes()


def test_every_case_is_read_without_complaint_of_its_form(cases):
    for folder in cases:
        assert read_case(folder).kind.name == told(folder)["rig"]


def test_base_model_is_that_of_the_contract_where_the_case_tells_everything(cases):
    """Independent formulas: what `simulate` gives, wherever the case leaves nothing to broad priors."""
    compared = set()
    for folder in cases:
        system = tomllib.loads((folder / "system.toml").read_text())
        if "lubricant" not in system:
            continue
        case = read_case(folder)
        simulated = Forward(case, case.recordings).predict()
        nominal = dict(zip(told(folder)["rows"]["run"], told(folder)["rows"]["nominal"]))
        expected = np.array([nominal[int(run)] for run in case.recordings["run"]])
        assert simulated == pytest.approx(expected, rel=1e-4)
        compared.add(case.kind.name)
    assert {"film", "mesh_friction", "friction_history"} <= compared


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
        hand = deal(np.random.default_rng(seed), order)
        assert hand.bench.model(hand.z, hand.acts).min() > 0


def test_a_fault_that_always_makes_a_quantity_negative_is_refused(monkeypatch):
    monkeypatch.setattr(battery, "_readable", lambda hand: False)
    monkeypatch.setattr(battery, "DRAWS", 3)
    with pytest.raises(InputError, match="can be read"):
        deal(np.random.default_rng(1), Order("", "film", "measurement", ("sensor_offset",), "clear"))


def test_truth_and_withheld_readings_are_not_handed_over(cases):
    for folder in cases:
        truth = read_truth(folder)
        recorded, wanted = (pd.read_csv(folder / name) for name in ("recordings.csv", "conditions.csv"))
        assert sorted([*recorded["run"], *wanted["run"]]) == sorted(truth.run)
        assert set(wanted["run"]) == set(truth.run[truth.withheld])
        quantity = tomllib.loads((folder / "system.toml").read_text())["recording"]["quantity"]
        assert not [name for name in wanted if name.startswith(quantity)]


def test_noise_is_as_told_and_wild_readings_are_far_off(cases):
    spread = []
    for folder in cases:
        truth, recorded = read_truth(folder), pd.read_csv(folder / "recordings.csv")
        quantity = tomllib.loads((folder / "system.toml").read_text())["recording"]["quantity"]
        at = {int(run): i for i, run in enumerate(truth.run)}
        rows = [at[int(run)] for run in recorded["run"]]
        z = (recorded[quantity].to_numpy() - truth.values[rows]) / truth.sd[rows]
        wild = np.isin(recorded["run"], list(truth.outliers))
        assert (np.abs(z[wild]) > 4).all()
        spread.append(z[~wild])
    assert np.std(np.concatenate(spread)) == pytest.approx(1.0, abs=0.1)


def test_effects_stand_out_as_far_as_ordered(cases):
    for folder, order in zip(cases, ORDERS):
        low, high = {"pair": (9.0, 26.0), "none": (0.0, 0.0)}.get(order.label, (15.0, 32.0))
        if order.level == "faint":
            low, high = 6.5, 11.6
        assert low <= read_truth(folder).visibility <= high


def test_the_truth_explains_its_case_and_none_does_not(cases):
    for folder in cases:
        found = told(folder)
        if found["class"] in ("single", "measurement", "pair"):
            assert found["own"] < found["alternatives"]["none"] - 30
            assert found["effects"][0] not in found["alternatives"] or found["class"] == "pair"


def test_pairs_have_rivals_with_one_of_the_two_exchanged(cases):
    swapped = [name for name in told(cases[5])["alternatives"] if "+" in name]
    assert swapped
    assert all(("stribeck" in name) != ("direction_dependence" in name) for name in swapped)


@pytest.mark.parametrize("kind", ROOMS)
def test_every_form_is_absent_at_zero_and_finite_at_its_usual_size(kind):
    rng = np.random.default_rng(8)
    seen = set()
    for _ in range(40):
        bench = ROOMS[kind].draw(rng)
        z = np.zeros(len(bench.names))
        base = bench.model(z, ())
        for form in (*bench.forms, *bench.outside):
            usual = {knob.name: float(np.mean(knob.typical)) for knob in form.knobs}
            off = bench.model(z, [form.hide({**usual, "strength": 0.0})])
            assert off == pytest.approx(base, rel=1e-6), form.law.__name__
            assert np.isfinite(bench.model(z, [form.hide(usual)])).all(), form.law.__name__
            seen.add(form.id)
    assert {name for pair in ROOMS[kind].PAIRS for name in pair} <= seen


def test_a_battery_holds_every_kind_and_class_under_neutral_names():
    orders = plan(1, 100)
    assert Counter(order.kind for order in orders) == dict.fromkeys(ROOMS, 20)
    for kind in ROOMS:
        labels = Counter(order.label for order in orders if order.kind == kind)
        assert set(labels) == {"none", "single", "pair", "measurement", "unknown"}
    assert [order.name for order in orders] == [f"case_{i:03d}" for i in range(100)]
    assert all(set(order.effects) <= MEASUREMENT for order in orders if order.label == "measurement")


def test_too_few_cases_are_refused():
    with pytest.raises(InputError, match="at least 25"):
        plan(1, 24)


def test_a_more_general_form_is_no_rival_of_its_special_case():
    rng = np.random.default_rng(2)
    hand = deal(rng, Order("", "friction_history", "single", ("friction_run_in",), "clear"))
    truth = hand.bench.model(hand.z, hand.acts)
    aim = Aim(hand.bench, np.arange(len(truth)), truth, hand.sd(truth))
    simple = rivals(aim, hand.forms, hand.knobs, hand.z, 0)
    every = rivals(aim, hand.forms, hand.knobs, hand.z, 2)
    assert "two_time_scales" not in simple
    assert "two_time_scales" in every
    own, _ = best(aim, hand.forms, hand.z, hand.knobs)
    assert own <= hand.z @ hand.z + 1e-6


def test_film_of_a_steel_ball_on_glass_is_hamrock_and_dowson():
    """2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)) by hand, at the first reading."""
    bench = film.draw(np.random.default_rng(4))
    table, columns = bench.settings, bench.columns
    oil, celsius = oil_of(table), columns["oil_temperature_C"][0]
    bodies = zip(table["contact"]["poisson_ratio"], table["contact"]["youngs_modulus_GPa"])
    modulus = 2e9 / sum((1 - v**2) / e for v, e in bodies)
    radius = 1e-3 * table["contact"]["radius_mm"][0]
    speed = oil.viscosity_at(celsius) * columns["entrainment_speed_m_s"][0] / (modulus * radius)
    load = columns["load_N"][0] / (modulus * radius**2)
    film_m = 2.69 * radius * speed**0.67 * (oil.pressure_viscosity_at(celsius) * modulus) ** 0.53 * load**-0.067
    expected = 1e9 * film_m * (1 - 0.61 * np.exp(-0.73 * 1.03))
    assert bench.model(np.zeros(len(bench.names)), ())[0] == pytest.approx(expected)


def test_unnamed_sample_keeps_to_astm_d341_and_barus():
    """log10 log10(nu + 0.7) is straight in log10 T but for the bow, and ln eta straight in pressure."""
    rng = np.random.default_rng(1)
    benches = [viscosity.draw(rng) for _ in range(30)]
    bench = next(b for b in benches if len(b.names) == 5 and len(np.unique(b.columns["temperature_C"])) > 2)
    eta = bench.model(np.array([1.0, -1.5, 0.0, 1.0, 2.0]), ())
    celsius, pressure = bench.columns["temperature_C"], bench.columns["pressure_MPa"]
    doubled, slopes = [], []
    for level in np.unique(celsius):
        slope, start = np.polyfit(pressure[celsius == level], np.log(eta[celsius == level]), 1)
        left = np.log(eta[celsius == level]) - start - slope * pressure[celsius == level]
        assert np.abs(left).max() < 1e-9
        slopes.append(slope)
        doubled.append(np.exp(start))
    levels = np.unique(celsius)
    assert np.abs(np.diff(np.diff(slopes) / np.diff(levels))).max() < 1e-9
    fitted = []
    for density in (832.0, 865.0, 950.0):
        fall = 8e-4 if density == 950.0 else 7e-4
        nu = 1e3 * np.array(doubled) / (density * (1 - fall * (levels - 15)))
        line = np.log10(np.log10(nu + 0.7))
        fitted.append(np.abs(np.diff(np.diff(line) / np.diff(np.log10(levels + 273.15)))).max())
    assert min(fitted) < 1e-9


def test_tooth_contacts_are_those_of_the_path_of_contact():
    """At the pitch point nothing slides, and the speeds part on either side of it."""
    bench = mesh.draw(np.random.default_rng(6))
    case = mesh.Case({**bench.settings, "kind": "gear_pair"}, bench.columns, bench.share)
    path = mesh.path_of_contact(mesh.gears_of(bench.settings))
    pitch = np.full(len(bench.columns["run"]), np.degrees(path.pitch / path.base_radius[0]))
    at_pitch, later = mesh.at_angles(case, pitch), mesh.at_angles(case, pitch + 2.0)
    assert at_pitch.speed_1 == pytest.approx(at_pitch.speed_2)
    assert (later.speed_1 > later.speed_2).all()


def test_stribeck_rise_is_the_static_excess_at_rest_and_gone_at_speed():
    speed = np.array([-1.0, -1e-6, 1e-6, 1.0])
    flat = np.ones(4)
    state = Drive(flat, flat, flat, np.sign(speed), speed, 2.0, 0.0 * flat, flat)
    assert gaussian(state, 1.0, 0.1).running == pytest.approx([0.0, -0.6, 0.6, 0.0], abs=1e-9)


def says_none(case: Path, out: Path) -> None:
    """Answers that nothing is missing, and breaks down on tooth contacts."""
    if "mesh_friction" in (case / "system.toml").read_text():
        raise RuntimeError("no gears here")
    runs = np.concatenate([pd.read_csv(case / name)["run"] for name in ("recordings.csv", "conditions.csv")])
    zeros = np.zeros(len(runs))
    columns = {"run": runs, "calibrated": zeros, "predicted": zeros, "low90": zeros - 1, "high90": zeros + 1}
    pd.DataFrame(columns).to_csv(out / "predictions.csv", index=False)
    said = {
        "verdict": ["none"],
        "tied": [["none"], ["sensor_gain"]],
        "probabilities": {"none": 0.8, "sensor_gain": 0.2},
        "mismatch": {"detected": False},
    }
    (out / "diagnosis.json").write_text(json.dumps(said))


def test_counts_by_kind_wrong_answers_and_break_downs(cases, tmp_path):
    for folder in cases:
        place = tmp_path / "answers" / folder.name
        place.mkdir(parents=True)
        Steady(says_none)(folder, place)
    scores = judge(tmp_path, cases)
    assert set(scores) == {"all", "film", "friction_history", "friction_map", "viscosity", "mesh_friction"}
    assert scores["all"]["none"].value == 1.0
    assert scores["all"]["right"].value == 0.0
    assert scores["mesh_friction"]["right"].value == 0.0
    assert scores["mesh_friction"]["outliers_false"].value == 1.0
    assert scores["friction_history"]["tied"].value == 0.5
    text = (tmp_path / "score.txt").read_text()
    lines = {line[:36].strip(): line[36:].split() for line in text.splitlines()}
    assert lines["none where nothing is missing"] == ["1/1", "-", "-", "1/1", "-"]
    assert lines["right or tied, one effect, all"] == ["0/1", "1/2", "0/1", "0/1", "0/1"]
    assert "case_004 friction_map     single     *" in text
    assert "stribeck -> none  tied: sensor_gain" in text
    assert "film_heating -> RuntimeError: no gears here" in text
    assert (tmp_path / "answers" / "case_008" / BROKEN).exists()


def test_the_command_deals_the_other_kinds(tmp_path, monkeypatch):
    asked = {}

    def counted(folder, diagnose, cases, seed, jobs, progress):
        asked.update(cases=cases, seed=seed)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "score.txt").write_text("scored")

    monkeypatch.setattr("mixedlub.validation.rigs.prove.prove_rigs", counted)
    done = CliRunner().invoke(app, ["prove", "--rigs", "--seed", "3", "--out", str(tmp_path / "out")])
    assert done.exit_code == 0
    assert asked == {"cases": 200, "seed": 3}
    assert "scored" in done.stdout
