"""The last line of a notebook cell: results, cases and answers show a short summary and no arrays."""

import pytest

import mixedlub as ml

SPEEDS = "{ from = 500, to = 3000, count = 60 }"
WIDEST, MOST_LINES = 120, 8


def lines(shown: object) -> list[str]:
    """The lines of the summary, which fit a cell."""
    found = repr(shown).splitlines()
    assert len(found) <= MOST_LINES
    assert max(map(len, found)) <= WIDEST
    return found


@pytest.fixture(scope="module")
def results(two_flanks):
    return ml.study.run(two_flanks(torque_Nm="[50, 100]", speed_rpm=SPEEDS, oil_temperature_C="[60]"))


def test_a_study_shows_its_factors_and_ranges(results) -> None:
    first, conditions, outputs, outside, *_ = lines(results)
    assert first == "Results of 'Two flanks': 3 pairings x 2 torques x 60 speeds x 1 oil temperature = 360 rows"
    assert conditions.split("; ") == ["  torque_Nm 50 to 100", "speed_rpm 500 to 3000", "oil_temperature_C 60"]
    loss = results["power_loss"]
    assert f"power_loss_W {loss.min():.4g} to {loss.max():.4g}" in outputs
    assert outside.startswith(f"  {int(results.outside.sum())} rows are outside the range of the model")


def test_a_study_with_a_long_title_and_a_doubt_stays_short(two_flanks) -> None:
    assert lines(
        ml.study.run(two_flanks("long " * 60, torque_Nm="[90000]", speed_rpm=SPEEDS, oil_temperature_C="[60]"))
    )


def test_a_case_shows_what_was_recorded(drive) -> None:
    first, recorded, wanted = lines(drive)[:3]
    assert first == "Case 'drive': friction_map, recorded quantity friction_torque_Nm"
    assert recorded.startswith("  recordings: 32 rows; speed_rpm 10 to 500; friction_torque_Nm ")
    assert wanted == "  conditions: 2 rows; speed_rpm 150 to 250"


def test_a_case_without_conditions_says_so() -> None:
    system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    rows = {"speed_rpm": [100.0, 200.0], "friction_torque_Nm": [0.5, 0.6], "setup": ["a", "b"]}
    case = ml.case.case_of(system, rows)
    assert "setup a, b" in repr(case)
    assert "  conditions: none" in lines(case)


def test_an_answer_shows_its_verdict_and_prints_as_the_report(answer) -> None:
    first, verdict, *_ = lines(answer)
    assert first == "Answer for 'drive': 32 readings of friction_torque_Nm"
    assert verdict.startswith("  verdict: stribeck (probability ")
    assert str(answer) == answer.summary()
    assert len(str(answer).splitlines()) > MOST_LINES
