"""Strain gauges: influence, synchronous average, forces planted by an independent tooth, recentring, bad input."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.evaluate import evaluate
from mixedlub.evaluate.influence import fit_influence
from mixedlub.evaluate.synchronous import synchronous_average
from mixedlub.validation.benches import strain_gauges as bench
from mixedlub.validation.benches.tables import as_csv
from profiles.errors import InputError
from tests.evaluate.helpers import assert_intervals_hold, written

SILENT = bench.Errors(**dict.fromkeys(bench.Errors.__dataclass_fields__, 0.0))
TOOTH = bench.Tooth()
PITCH = TOOTH.path[1]


def found_of(folder, calibration, recording, **changed):
    tables = {"calibration.csv": as_csv(calibration, 9), "recording.csv": as_csv(recording, 9)}
    return evaluate("strain-gauge", written(folder, "strain-gauge", tables, **changed))


def real(truth, rows):
    return np.array([truth[round(angle, 2)] for angle in rows["roll_angle_deg"]]).T


@pytest.fixture(scope="module")
def silent(tmp_path_factory):
    calibration, recording, truth = bench.recorded(replace(bench.Bench(turns=20), errors=SILENT), TOOTH, 0)
    changed = {"friction": {"recentre": "none"}}
    return found_of(tmp_path_factory.mktemp("silent"), calibration, recording, **changed), truth


def test_planted_forces_are_found_where_nothing_is_uncertain(silent):
    found, truth = silent
    rows = found.tables["forces"]
    single = rows[rows["single_contact"]]
    normal, friction = real(truth, single)
    assert single["normal_force_N"].to_numpy() == pytest.approx(normal, rel=5e-3)
    assert single["friction_coefficient"].to_numpy() == pytest.approx(friction, abs=2e-3)
    double = rows[~rows["single_contact"] & (rows["roll_angle_deg"] > 12) & (rows["roll_angle_deg"] < 17)]
    assert double["normal_force_N"].to_numpy() == pytest.approx(real(truth, double)[0], rel=5e-3)


@pytest.mark.literature("Rebbechi, Oswald and Townsend 1996, NASA TM-107279, static meshing")
def test_the_normal_force_agrees_with_the_torque_within_3_percent(tmp_path):
    calibration, recording, _ = bench.recorded(bench.Bench(), TOOTH, 3)
    ratio = found_of(tmp_path, calibration, recording).tables["recordings"]["normal_force_over_nominal"][0]
    assert ratio == pytest.approx(1.0, abs=0.03)


def test_recentring_removes_zeros_of_the_gauges_and_says_what_it_removes(tmp_path):
    zeros = replace(SILENT, zero=30.0)
    calibration, recording, truth = bench.recorded(replace(bench.Bench(turns=4), errors=zeros), TOOTH, 1)
    found = {
        how: found_of(tmp_path, calibration, recording, friction={"recentre": how}).tables["forces"]
        for how in ("none", "mean")
    }
    errors = {}
    for how, rows in found.items():
        single = rows[rows["single_contact"]]
        errors[how] = np.abs(single["friction_coefficient"] - real(truth, single)[1]).max()
    assert errors["none"] > 0.03
    assert errors["mean"] < 0.006


def test_the_note_says_how_far_friction_was_moved(tmp_path):
    calibration, recording, _ = bench.recorded(bench.Bench(turns=4), TOOTH, 1)
    assert "moved by" in found_of(tmp_path, calibration, recording).notes[-1]


def test_a_normal_force_beside_that_of_the_torque_is_doubted(tmp_path):
    calibration, recording, _ = bench.recorded(bench.Bench(turns=4, torque=50.0), TOOTH, 1)
    assert any("normal force 0.6" in text for text in found_of(tmp_path, calibration, recording).notes)


def test_the_average_reduces_what_is_not_synchronous_by_the_root_of_the_turns():
    random = np.random.default_rng(0)
    turn, angle = np.repeat(np.arange(64), 200), np.tile(np.arange(200) * 1.8, 64)
    wave = np.sin(np.radians(3 * angle))
    found = synchronous_average(turn, angle, (wave + random.standard_normal(turn.size))[:, None], 1.8, source="x")
    error = found.mean[:, 0] - np.sin(np.radians(3 * found.angle))
    assert error.std() == pytest.approx(1 / 8, rel=0.15)
    assert found.sd[0] == pytest.approx(1 / 8, rel=0.1)


def test_planted_polynomials_are_found_with_the_scatter_of_the_gauges():
    random = np.random.default_rng(2)
    angle = np.repeat(np.linspace(10.0, 32.0, 23), 6)
    forces = np.tile(
        [[0.0, 0.0], [500.0, 0.0], [1000.0, 0.0], [1500.0, 0.0], [1500.0, 100.0], [1500.0, 200.0]], (23, 1)
    )
    influence = np.stack([0.4 + 0.01 * angle, 0.1 - 0.002 * angle**1.5], axis=1)
    strain = (influence * forces).sum(axis=1) + 7.0 + 0.5 * random.standard_normal(angle.size)
    tooth = np.zeros(angle.size, dtype=int)
    found = fit_influence(angle, tooth, forces, strain[:, None], teeth=1, degree=4, source="x")
    assert found.at(angle, 0)[:, 0, 0] == pytest.approx(influence[:, 0], abs=2e-3)
    assert found.at(angle, 0)[:, 0, 1] == pytest.approx(influence[:, 1], abs=2e-2)
    assert found.residual[0] == pytest.approx(0.5, rel=0.2)


def changed_calibration(columns, keep):
    rows = [
        n for n, row in enumerate(zip(*columns.values(), strict=True)) if keep(dict(zip(columns, row, strict=True)))
    ]
    return {name: [values[n] for n in rows] for name, values in columns.items()}


BAD = [
    (lambda row: row["tooth"] == 1, {}, "tooth: 2: no calibration of tooth 2 of 2"),
    (lambda row: row["friction_force_N"] == 0, {}, "tooth 1: 0: a polynomial of degree 6 needs a friction force at 7"),
    (lambda row: row["roll_angle_deg"] < 20, {}, "a polynomial of degree 6 needs a normal force at 7"),
    (
        lambda row: row["roll_angle_deg"] > 14,
        {},
        "recordings.full_torque: roll angle: 15.68: the gauges are calibrated from 16 to 32°",
    ),
    (lambda row: True, {"gauges": {"largest_condition": 5.0}}, "condition number of the influence matrix"),
    (lambda row: True, {"gauges": {"columns": ["compressive_1_um_m"]}}, "gauges.columns"),
    (lambda row: True, {"gauges": {"wheel": "pinion"}}, "normal force of single contact over that of the torque"),
    (lambda row: True, {"gears": {"helix_angle_deg": 5.0}}, "gears.helix_angle_deg = 5"),
    (
        lambda row: True,
        {"recordings": {"full_torque": {"file": "recording.csv", "torque_Nm": 0.0}}},
        "torque_Nm: 0.0: must be above 0",
    ),
]


@pytest.mark.parametrize(("keep", "changed", "said"), BAD, ids=[said[:30] for *_, said in BAD])
def test_bad_input_is_refused_with_the_number_that_is_wrong(tmp_path, keep, changed, said):
    calibration, recording, _ = bench.recorded(bench.Bench(turns=3), TOOTH, 0)
    with pytest.raises(InputError) as error:
        found_of(tmp_path, changed_calibration(calibration, keep), recording, **changed)
    assert said in str(error.value)


def test_gauges_that_see_both_forces_alike_are_refused(tmp_path):
    calibration, recording, _ = bench.recorded(replace(bench.Bench(turns=3), errors=SILENT), TOOTH, 0)
    for columns in (calibration, recording):
        columns["tensile_1_um_m"] = [-one for one in columns["compressive_1_um_m"]]
        columns["tensile_2_um_m"] = [-one for one in columns["compressive_2_um_m"]]
    with pytest.raises(InputError, match="condition number of the influence matrix") as error:
        found_of(tmp_path, calibration, recording)
    assert "the gauges do not separate the two forces" in str(error.value)


def planted_mean(truth, rows):
    """Friction of single contact outside the step, weighted with sliding."""
    used = rows[rows["single_contact"] & ~rows["at_pitch_point"]]
    slide = np.abs(used["roll_angle_deg"] - PITCH)
    return (slide * real(truth, used)[1]).sum() / slide.sum()


def test_the_step_of_friction_at_the_pitch_point_is_not_in_the_mean(tmp_path):
    """Averaged over turns the step is smeared, which takes 2 % from a mean with it."""
    bench_of = replace(bench.Bench(turns=20, step=True), errors=replace(SILENT, strain=2.0))
    calibration, recording, truth = bench.recorded(bench_of, TOOTH, 0)
    found = found_of(tmp_path, calibration, recording, friction={"recentre": "none"})
    rows, whole = found.tables["forces"], found.tables["recordings"]
    mean, planted = whole["mean_friction"][0], planted_mean(truth, rows)
    assert mean == pytest.approx(planted, rel=8e-3)
    single = rows[rows["single_contact"]]
    slide = np.abs(single["roll_angle_deg"] - PITCH)
    assert (slide * single["friction_coefficient"]).sum() / slide.sum() < 0.985 * planted
    assert whole["left_out_deg"][0] == pytest.approx(360.0 / 500 + 2 * 0.05)
    assert np.abs(found.case.columns["roll_angle_deg"] - PITCH).min() > 0.8


def test_friction_that_drives_the_teeth_is_refused_with_the_sign_to_turn(tmp_path):
    calibration, recording, _ = bench.recorded(bench.Bench(turns=4), TOOTH, 1)
    calibration["friction_force_N"] = [-one for one in calibration["friction_force_N"]]
    with pytest.raises(InputError, match=r"below zero.*friction_force_N of the calibration") as refused:
        found_of(tmp_path, calibration, recording)
    assert refused.value.where.endswith("recordings.full_torque")


@pytest.mark.long
@pytest.mark.parametrize("step", [False, True])
@pytest.mark.parametrize("recentre", ["none", "mean"])
def test_intervals_of_forces_and_friction_hold_in_200_runs(tmp_path, recentre, step):
    truth, value, low, high = ([] for _ in range(4))
    for seed in range(1000, 1200):
        calibration, recording, real_ = bench.recorded(bench.Bench(step=step), TOOTH, seed)
        found = found_of(tmp_path, calibration, recording, friction={"recentre": recentre})
        rows, whole = found.tables["forces"], found.tables["recordings"]
        single = rows[rows["single_contact"] & ~rows["at_pitch_point"]].iloc[::4]
        normal, friction = real(real_, single)
        truth.append([*normal, *friction, planted_mean(real_, rows)])
        for ends, end in ((value, ""), (low, "_low90"), (high, "_high90")):
            ends.append(
                [
                    *single[f"normal_force_N{end}"],
                    *single[f"friction_coefficient{end}"],
                    whole[f"mean_friction{end}"][0],
                ]
            )
    assert_intervals_hold(*map(np.array, (truth, value, low, high)))
