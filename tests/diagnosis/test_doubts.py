"""What stands above the headline: readings that err together, and an answer that holds nowhere else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.case.folder import Case
from mixedlub.diagnosis.assessment.answer_checks import answer_warnings, outlier_levels, outlier_streak
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.recording.conditions import is_noisy_constant
from mixedlub.recording.noise import nearly_repeated
from mixedlub.schema.findings import Finding, Severity, codes
from mixedlub.schema.table import Table

from ..kinds.conftest import make, system
from .test_inference import problem

__all__ = ["make"]


def told(offset: Diagnosis, wrong: np.ndarray) -> list[Finding]:
    rows, predicted = offset.recorded.table, offset.recorded.predicted
    clock = Table({**rows.columns, "sequence": np.linspace(0.0, 1.0, len(rows))}, rows.source)
    y = predicted * np.where(wrong, 1.5, 1.0)
    return answer_warnings(offset.posterior.verdict, offset.heldout, clock, y, predicted, wrong)


def test_wrong_readings_that_follow_one_another_are_told_of(offset: Diagnosis) -> None:
    wrong = np.isin(np.arange(len(offset.recorded.table)), [3, 4, 5, 6])
    runs = offset.recorded.table["run"][wrong]
    (note,) = [note for note in told(offset, wrong) if note.code == "outliers_consecutive"]
    assert note.place == f"run {runs[0]} to run {runs[-1]}"
    assert "the 4 readings" in note.text


def test_wrong_readings_apart_are_not(offset: Diagnosis) -> None:
    wrong = np.isin(np.arange(len(offset.recorded.table)), [3, 14, 25, 36])
    assert "outliers_consecutive" not in codes(told(offset, wrong))


@pytest.mark.parametrize(
    ("celsius", "about"), [([0.0, 5.0, 10.0, 20.0, 25.0], False), ([99.0, 100.4, 100.1, 101.2], True)]
)
def test_temperatures_some_kelvin_apart_were_meant(celsius: list[float], about: bool) -> None:
    assert is_noisy_constant("temperature_C", np.array(celsius)) is about


def test_a_single_condition_that_jitters_makes_no_repeats() -> None:
    p = problem()
    case: Case = p.case
    names = [c.name for c in case.kind.columns if c.dtype != "name" and c.name in p.rows]
    one = Table({"run": np.arange(1, 9), names[0]: 100.0 + 0.3 * np.arange(8.0)}, "recordings.csv")
    assert nearly_repeated(replace(case, recordings=one)) is None


def test_a_level_run_in_one_go_is_no_matter_of_time() -> None:
    rows = {"run": np.arange(1, 41), "sequence": np.linspace(0.0, 1.0, 40), "speed_rpm": np.repeat(np.arange(8.0), 5)}
    wrong = rows["speed_rpm"] == 3.0
    assert outlier_streak(Table(rows), wrong, np.ones(40)) == []
    assert outlier_streak(Table({**rows, "speed_rpm": np.tile(np.arange(8.0), 5)}), wrong, np.ones(40)) == [
        16,
        17,
        18,
        19,
        20,
    ]


def test_clocks_that_start_anew_make_no_streak() -> None:
    rows = Table({"run": np.arange(1, 31), "time_s": np.tile(np.arange(10.0), 3)})
    assert outlier_streak(rows, rows["time_s"] == 0.0, np.ones(30)) == []


def test_a_level_written_off_on_one_side_is_told_of_by_name() -> None:
    """Five of six readings at one of twelve speeds: a few in a hundred, and no streak in time."""
    speed = np.tile(500.0 * np.arange(1, 13), 6)
    rows = Table({"run": np.arange(1, 73), "torque_Nm": np.repeat([50.0, 100.0, 150.0], 24), "speed_rpm": speed})
    left = np.where(speed == 4000.0, -12.0, 0.3)
    wrong = (speed == 4000.0) & (np.arange(72) != 7)
    assert outlier_levels(rows, wrong, left) == [("speed 4000 rpm", "5 of the 6")]
    assert outlier_levels(rows, wrong, left * (-1.0) ** np.repeat(np.arange(6), 12)) == []
    assert outlier_levels(rows, wrong & (np.arange(72) < 36), left) == []
    assert outlier_levels(rows, np.isin(np.arange(72), [7, 20, 41]), left) == []


def test_a_level_about_its_set_point_is_one() -> None:
    celsius = np.repeat([40.0, 60.0, 80.0, 100.0], 6) + np.tile([0.1, -0.1, 0.0, 0.2, -0.2, 0.05], 4)
    rows = Table({"run": np.arange(1, 25), "oil_temperature_C": celsius})
    wrong = np.repeat([False, True, False, False], 6)
    assert outlier_levels(rows, wrong, np.ones(24)) == [("oil temperature 60 °C", "all 6")]


def test_the_level_is_a_doubt_of_the_answer(offset: Diagnosis) -> None:
    wrong = offset.recorded.table["speed_rpm"] == 1500.0
    (note,) = [note for note in told(offset, wrong) if note.code == "outliers_at_level"]
    assert (note.place, note.severity) == ("speed 1500 rpm", Severity.DOUBT)


def test_a_channel_that_was_kept_back_is_no_condition(make) -> None:
    """Readings are wrong where the track is covered: the channel is compared with the answer, and nothing else."""
    time = np.arange(1.0, 61.0) * 100.0
    wrong = np.isin(np.arange(60), [3, 14, 25, 36, 47, 58])
    friction = 0.1 * (1.0 + 0.01 * np.random.default_rng(1).standard_normal(60)) * np.where(wrong, 1.3, 1.0)
    about = system("friction_history", "friction_coefficient")
    about["recording"]["check"] = "coverage_percent"
    columns = {"time_s": time, "friction_coefficient": friction, "coverage_percent": np.where(wrong, 100.0, 50.0)}
    d = diagnose_case(make(about, columns).folder)
    assert (d.outlier_chance[wrong] > 0.5).all()
    assert "outliers_at_level" not in codes(d.warnings)


@pytest.mark.parametrize(("after", "told"), [(2.9, False), (12.93, True)])
def test_levels_that_the_answer_does_not_foretell_are_told_of(offset: Diagnosis, after: float, told: bool) -> None:
    rows, predicted = offset.recorded.table, offset.recorded.predicted
    kept = replace(offset.heldout, before=20.0, after=after)
    right = np.zeros(len(rows), bool)
    said = answer_warnings(offset.posterior.verdict, kept, rows, offset.readings, predicted, right)
    assert ("answer_predicts_poorly" in codes(said)) == told
    assert not answer_warnings(NOTHING, kept, rows, offset.readings, predicted, right)
