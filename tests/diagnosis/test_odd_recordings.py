"""Recordings that are thin, unevenly noisy or partly strange still get an answer that holds."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import check_readings
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import DISCREPANCY, Explanation
from mixedlub.importers import write_case
from mixedlub.recording.conditions import is_constant
from mixedlub.recording.noise import shrunk_sd
from mixedlub.schema.findings import codes

from .conftest import left_out

NOISE = "noise = { relative = 0.01, absolute = 0.3 }"


def edited(
    folder: Path, system: Callable[[str], str] = str, rows: Callable[[list[str]], list[str]] = list
) -> Diagnosis:
    """The answer to a case whose files were changed."""
    toml, recordings = folder / "system.toml", folder / "recordings.csv"
    toml.write_text(system(toml.read_text(encoding="utf-8")), encoding="utf-8")
    recordings.write_text("\n".join(rows(recordings.read_text(encoding="utf-8").split())) + "\n", encoding="utf-8")
    return diagnose_case(folder, exclude=left_out())


@pytest.mark.parametrize("count", [6, *(pytest.param(n, marks=pytest.mark.long) for n in (15, 30))])
def test_few_readings_without_stated_noise_are_no_mismatch(make_case, tmp_path: Path, count: int) -> None:
    folder = make_case(tmp_path, "gear_pair")
    found = edited(
        folder, lambda text: text.replace(NOISE, ""), lambda lines: [lines[0], *lines[1 :: len(lines) // count]]
    )
    assert not found.test.detected


@pytest.mark.long
def test_a_large_sd_only_marks_its_reading(make_case, tmp_path: Path) -> None:
    def marked(lines: list[str]) -> list[str]:
        sds = ["900" if i in (5, 30) else "2" for i in range(len(lines) - 1)]
        return [f"{lines[0]},power_loss_W_sd", *(f"{line},{sd}" for line, sd in zip(lines[1:], sds, strict=True))]

    folder = make_case(tmp_path, "gear_pair", lambda conditions, base: base + 9.0)
    found = edited(folder, rows=marked)
    assert found.posterior.verdict == Explanation.of("sensor_offset")
    assert found.search.problem.sd[0] == pytest.approx(2.0, rel=0.01)


def test_sds_of_few_tests_come_near_the_true_one() -> None:
    rng = np.random.default_rng(4)
    few = np.sqrt(rng.chisquare(2, size=60) / 2.0)
    assert np.sqrt(np.mean(shrunk_sd(few, np.ones(60), np.ones((60, 60))) ** 2)) == pytest.approx(1.0, rel=0.15)


@pytest.mark.long
def test_conditions_where_the_unnamed_mismatch_has_nothing_to_ride_on_are_predicted(
    unnamed: Diagnosis, tmp_path: Path
) -> None:
    wanted = tmp_path / "far.csv"
    head = "run,torque_Nm,speed_rpm,oil_temperature_C,pinion_surface,gear_surface"
    wanted.write_text(f"{head}\n901,100,9000,20,polished,polished\n902,100,1500,60,ground,ground\n", encoding="utf-8")
    found = diagnose_case(unnamed.case.folder, predict=wanted, exclude=left_out())
    assert found.wanted is not None
    assert np.isfinite([found.wanted.predicted, found.wanted.low90, found.wanted.high90]).all()


def test_a_rig_run_mostly_without_gears_is_diagnosed(make_case, tmp_path: Path) -> None:
    def bare(lines: list[str]) -> list[str]:
        head, *rows = lines
        parts = [row.rsplit(",", 1) for row in rows]
        return [
            head.replace(",power_loss_W", ",rig,power_loss_W"),
            *(f"{c},no_gears,0.2" if i % 3 else f"{c},whole,{y}" for i, (c, y) in enumerate(parts)),
        ]

    folder = make_case(tmp_path, "gear_pair")
    found = edited(folder, rows=bare)
    assert not found.test.detected


def test_set_ups_with_errors_of_their_own_are_not_outliers(make_case, tmp_path: Path) -> None:
    def grouped(lines: list[str]) -> list[str]:
        head, *rows = lines
        error = 1.0 + 0.08 * np.random.default_rng(3).standard_normal(6)
        parts = [row.rsplit(",", 1) for row in rows]
        return [
            head.replace(",power_loss_W", ",setup,power_loss_W"),
            *(f"{c},s{i % 6},{float(y) * error[i % 6]}" for i, (c, y) in enumerate(parts)),
        ]

    folder = make_case(tmp_path, "gear_pair")
    found = edited(
        folder, lambda text: text.replace("absolute = 0.3", "absolute = 0.3, setup_relative = 0.08"), grouped
    )
    assert not found.test.detected
    assert found.heldout.readings == len(found.readings)
    assert found.heldout.before < 1.5


@pytest.mark.long
def test_many_wrong_readings_are_told(make_case, tmp_path: Path) -> None:
    def turned(lines: list[str]) -> list[str]:
        head, *rows = lines
        parts = [row.rsplit(",", 1) for row in rows]
        wrong = np.random.default_rng(2).random(len(rows)) < 0.2
        return [head, *(f"{c},{'-' if bad else ''}{y}" for (c, y), bad in zip(parts, wrong, strict=True))]

    found = edited(make_case(tmp_path, "disc"), rows=turned)
    assert {"outliers_many", "outliers_opposite_sign"} <= set(codes(found.warnings))


def test_time_since_an_epoch_is_not_held() -> None:
    assert not is_constant("time_s", 1.7e9 + np.linspace(0.0, 3600.0, 20))


def test_a_load_under_another_name_is_asked_for_and_not_a_set_up(tmp_path: Path) -> None:
    """Readings at three loads, the load in a column of its own name, seemed to contradict each other."""
    speed, load = np.repeat([-100.0, -50.0, 50.0, 100.0, 150.0], 6), np.tile([1.0, 5.0, 10.0], 10)
    friction = np.sign(speed) * (2.0 + 0.3 * load) + 0.004 * speed
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
    folder = write_case(tmp_path / "case", system, {"speed_rpm": speed, "friction_torque_Nm": friction})
    path = folder / "recordings.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    cells = ["load_Nm", *map(str, load)]
    path.write_text("\n".join(f"{a},{b}" for a, b in zip(lines, cells, strict=True)) + "\n", encoding="utf-8")
    case = read_case(folder)
    assert case.recordings is not None
    (ignored,) = [note for note in case.notes if note.code == "column_near_known"]
    assert ignored.place == "recordings.csv, load_Nm"
    assert "'torque_Nm'" in ignored.text
    found = check_readings(case, case.recordings, friction, Forward(case, case.recordings))
    (said,) = [note for note in found if note.code == "repeats_contradictory"]
    assert said.text.endswith("ignored: recordings.csv, load_Nm")
    assert "setup" not in said.text


def test_readings_that_follow_no_law_of_their_conditions_are_unknown(tmp_path: Path) -> None:
    """A slide that reverses within the compliance of its mount: friction follows travel, which is not recorded."""
    phase = np.linspace(0.0, 2.0 * np.pi, 41)[:-1]
    speed, friction = 100.0 * np.cos(phase), np.zeros(40)
    for _ in range(3):
        for i, step in enumerate(np.gradient(0.4 * np.sin(phase))):
            friction[i] = np.clip(friction[i - 1] + 4.0 * step, -0.5, 0.5)
    friction += 0.001 * np.random.default_rng(5).standard_normal(40)
    drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"absolute": 0.001}}}
    write_case(tmp_path / "case", drive, {"speed_rpm": speed, "friction_torque_Nm": friction})
    found = diagnose_case(tmp_path / "case")
    assert found.posterior.verdict == DISCREPANCY


@pytest.mark.long
def test_a_tenth_of_wild_readings_hides_no_law(make_case, tmp_path: Path) -> None:
    rng = np.random.default_rng(6)

    def spoilt(conditions, base: np.ndarray) -> np.ndarray:
        wild = rng.choice(base.size, base.size // 10, replace=False)
        base = base + 9.0
        base[wild] *= 1.0 + 0.3 * rng.choice([-1.0, 1.0], wild.size)
        return base

    found = edited(make_case(tmp_path, "gear_pair", spoilt))
    assert found.posterior.verdict == Explanation.of("sensor_offset")
    assert found.posterior.weights[DISCREPANCY] < 0.1
