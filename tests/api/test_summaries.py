"""The last line of a notebook cell: results, cases and answers show a short summary and no arrays."""

import numpy as np
import pytest

import mixedlub as ml

STUDY = """
schema = "mixedlub-study/1"
title = "Two flanks"
[gears]
teeth = [17, 26]
normal_module_mm = 4.0
face_width_mm = 14.0
[surfaces.ground]
m0_um2 = 0.137
m2 = 0.0031
m4_per_um2 = 0.0021
[surfaces.polished]
m0_um2 = 4e-4
m2 = 2e-4
m4_per_um2 = 4e-4
[conditions]
torque_Nm = [50, 100]
speed_rpm = { from = 500, to = 3000, count = 60 }
oil_temperature_C = [60]
"""
SPEED = np.array([10.0, 20, 50, 100, 200, 300, 400, 500] * 4)
TORQUE = (0.5 + 2e-3 * SPEED + 0.6 * np.exp(-SPEED / 40)) * (1 + 0.01 * np.cos(7.0 * np.arange(32)))
DRIVE = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
WIDEST, MOST_LINES = 120, 8


def lines(shown: object) -> list[str]:
    """The lines of the summary, which fit a cell."""
    found = repr(shown).splitlines()
    assert len(found) <= MOST_LINES
    assert max(map(len, found)) <= WIDEST
    return found


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    path = tmp_path_factory.mktemp("study") / "own.toml"
    path.write_text(STUDY, encoding="utf-8")
    return ml.study.run(path)


@pytest.fixture(scope="module")
def case():
    return ml.case.case_of(DRIVE, {"speed_rpm": SPEED, "friction_torque_Nm": TORQUE}, {"speed_rpm": [150.0, 250.0]})


def test_a_study_shows_its_factors_and_ranges(results) -> None:
    first, conditions, outputs, outside, *_ = lines(results)
    assert first == "Results of 'Two flanks': 3 pairings x 2 torques x 60 speeds x 1 oil temperature = 360 rows"
    assert conditions.split("; ") == ["  torque_Nm 50 to 100", "speed_rpm 500 to 3000", "oil_temperature_C 60"]
    loss = results["power_loss"]
    assert f"power_loss_W {loss.min():.4g} to {loss.max():.4g}" in outputs
    assert outside.startswith(f"  {int(results.outside.sum())} rows are outside the range of the model")


def test_a_study_of_many_findings_stays_short(results, tmp_path) -> None:
    path = tmp_path / "many.toml"
    text = STUDY.replace('title = "Two flanks"', f'title = "{"long " * 60}"').replace("[50, 100]", "[90000]")
    path.write_text(text, encoding="utf-8")
    assert lines(ml.study.run(path))


def test_a_case_shows_what_was_recorded(case) -> None:
    first, recorded, wanted = lines(case)[:3]
    assert first == "Case 'case': friction_map, recorded quantity friction_torque_Nm"
    assert recorded.startswith("  recordings: 32 rows; speed_rpm 10 to 500; friction_torque_Nm ")
    assert wanted == "  conditions: 2 rows; speed_rpm 150 to 250"


def test_a_case_without_conditions_says_so() -> None:
    film = ml.case.case_of(DRIVE, {"speed_rpm": SPEED, "friction_torque_Nm": TORQUE, "setup": ["a", "b"] * 16})
    assert "setup a, b" in repr(film)
    assert "  conditions: none" in lines(film)


def test_an_answer_shows_its_verdict_and_prints_as_the_report(case) -> None:
    answer = ml.diagnose(case)
    first, verdict, *_ = lines(answer)
    assert first == "Answer for 'case': 32 readings of friction_torque_Nm"
    assert verdict.startswith("  verdict: stribeck (probability ")
    assert str(answer) == answer.summary()
    assert len(str(answer).splitlines()) > MOST_LINES
