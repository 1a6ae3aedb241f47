"""The scorer on answers made by hand."""

import json
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.answers import Answer, Truth, read_answer, read_truth
from mixedlub.validation.measures import auroc, coverage, held_out, location_auroc, log_score
from mixedlub.validation.score import Row, Score, score
from profiles.errors import InputError

RUNS = np.arange(1, 21)


def truth_of(label="starvation", group="single", **changes) -> Truth:
    off = np.where(RUNS % 2 == 0, 5.0, 0.0)
    base = np.full(20, 100.0)
    plain = Truth(
        case="case_000",
        kind="disc",
        group=group,
        effects=tuple(label.split("+")),
        label=frozenset(label.split("+")),
        visibility=20.0,
        identifiable=True,
        mimic=False,
        small=False,
        outliers=frozenset(),
        theta={"boundary_friction": 0.104, "viscosity_scale": 1.05},
        run=RUNS,
        withheld=RUNS > 15,
        values=base + off,
        base=base,
        sd=np.ones(20),
    )
    return replace(plain, **changes)


def answer_of(verdict="starvation", truth=None, **changes) -> Answer:
    truth = truth or truth_of()
    plain = Answer(
        case=truth.case,
        verdict=frozenset(verdict.split("+")),
        tied=(frozenset(verdict.split("+")),),
        probabilities=dict.fromkeys(verdict.split("+"), 0.95) | {"churning": 0.02},
        detected=verdict != "none",
        outliers=frozenset(),
        location={int(run): float(z) for run, z in zip(truth.run, truth.off)},
        calibration={"boundary_friction": (0.1, 0.11), "viscosity": (0.9, 1.0)},
        run=truth.run,
        calibrated=truth.base,
        predicted=truth.values,
        low=truth.values - 1.6449,
        high=truth.values + 1.6449,
        seconds=2.0,
    )
    return replace(plain, **changes)


def value(key, *pairs):
    return score(list(pairs))[key].value


def test_right_counts_identifiable_single_effects_only():
    good = (truth_of(), answer_of())
    wrong = (truth_of(), answer_of("windage"))
    hidden = (truth_of(identifiable=False), answer_of("windage"))
    assert value("right", good, wrong, hidden) == 0.5
    assert score([good, wrong, hidden])["right"].count == 2


def test_forms_of_the_catalogue_and_others_are_told_apart_where_there_are_both():
    own, other = truth_of(within=True), truth_of(within=False, identifiable=False)
    good, wrong = (own, answer_of()), (own, answer_of("windage"))
    tie = (other, answer_of("windage", tied=(frozenset({"starvation"}),)))
    both = score([good, wrong, tie])
    assert [both[key].value for key in ("tied_within", "tied_beyond")] == [0.5, 1.0]
    keys = {row.key for row in both.rows}
    assert not keys & {"right_within", "right_beyond"}
    assert not {"tied_within", "tied_beyond"} & {row.key for row in score([good, wrong]).rows}
    seen = score([good, wrong, (replace(other, identifiable=True), answer_of())])
    assert [seen[key].value for key in ("right_within", "right_beyond")] == [0.5, 1.0]


def test_more_than_the_truth_is_not_right():
    assert value("right", (truth_of(), answer_of("starvation+windage"))) == 0.0


def test_tied_counts_the_truth_among_the_explanations():
    tie = answer_of("windage", tied=(frozenset({"windage"}), frozenset({"starvation"})))
    assert value("tied", (truth_of(), tie)) == 1.0
    assert value("tied", (truth_of(), answer_of("windage"))) == 0.0


def test_both_of_a_pair_must_be_named():
    pair = truth_of("starvation+windage", group="pair")
    assert value("pair_both", (pair, answer_of("starvation+windage"))) == 1.0
    assert value("pair_both", (pair, answer_of("starvation"))) == 0.0


def test_false_alarms_are_counted_on_cases_with_nothing_missing():
    none = truth_of("none", group="none")
    pairs = [(none, answer_of("none")), (none, answer_of("windage"))]
    assert value("none", *pairs) == 0.5
    assert value("false_alarm", *pairs) == 0.5


def test_unknown_is_scored_where_identifiable():
    outside = truth_of("unknown", group="unknown")
    mimic = replace(outside, mimic=True)
    hit, miss = answer_of("unknown"), answer_of("windage")
    assert value("unknown", (outside, hit), (mimic, miss)) == 0.5
    assert value("unknown_distinct", (outside, hit), (mimic, miss)) == 1.0
    assert np.isnan(value("unknown", (replace(outside, identifiable=False), hit)))


@pytest.mark.parametrize(
    ("label", "group", "verdict", "crossed"),
    [
        ("starvation", "single", "sensor_gain", 1.0),
        ("starvation", "single", "windage", 0.0),
        ("sensor_gain", "measurement", "windage", 1.0),
        ("sensor_gain", "measurement", "sensor_offset", 0.0),
        ("sensor_gain", "measurement", "unknown", 0.0),
        ("sensor_gain", "measurement", "none", 0.0),
    ],
)
def test_confusing_instrument_and_physics(label, group, verdict, crossed):
    assert value("crossed", (truth_of(label, group=group), answer_of(verdict))) == crossed


def test_outliers_are_counted_reading_by_reading():
    some = truth_of(outliers=frozenset({3, 4, 5}))
    one = truth_of(outliers=frozenset({7}))
    pairs = [(some, answer_of(outliers=frozenset({3, 4, 5, 6}))), (one, answer_of())]
    assert value("outliers_found", *pairs) == pytest.approx(3 / 4)
    assert value("outliers_false", *pairs) == pytest.approx(1 / (12 + 14))


Z90 = 1.6448536
"""Normal quantile that 5 % lie beyond."""


def test_a_proportion_without_a_miss_has_an_interval():
    row = score([(truth_of(), answer_of())] * 20)["right"]
    assert row.value == 1.0
    assert row.low == pytest.approx(1.0 / (1.0 + Z90**2 / 20))
    assert row.high == 1.0


def test_a_proportion_without_a_hit_has_an_interval():
    row = score([(truth_of(), answer_of("windage"))] * 20)["right"]
    assert row.value == row.low == 0.0
    assert row.high == pytest.approx(Z90**2 / 20 / (1.0 + Z90**2 / 20))


def test_the_interval_of_one_half_is_even_about_it():
    row = score([(truth_of(), answer_of()), (truth_of(), answer_of("windage"))] * 5)["right"]
    assert row.high - 0.5 == pytest.approx(0.5 - row.low)
    assert row.high - 0.5 == pytest.approx(0.5 * Z90 / np.sqrt(10 + Z90**2))


def test_claims_have_the_interval_of_a_proportion():
    row = score([(truth_of(), answer_of())] * 10)["claims"]
    assert (row.value, row.count) == (1.0, 10)
    assert row.low == pytest.approx(1.0 / (1.0 + Z90**2 / 10))


def test_readings_that_go_wrong_together_widen_the_interval():
    some = truth_of(outliers=frozenset({3, 4, 5, 6, 7}))
    found, missed = (some, answer_of(outliers=some.outliers)), (some, answer_of())
    together = score([found, missed] * 4)["outliers_found"]
    assert together.count == 40
    assert together.high - together.low > 2.0 * Z90 * 0.5 / np.sqrt(40)
    assert score([found] * 8)["outliers_found"].low == pytest.approx(1.0 / (1.0 + Z90**2 / 40))


def test_means_keep_their_bootstrap():
    pairs = [(truth_of(), answer_of(seconds=float(s))) for s in range(1, 10)] + [(truth_of(), answer_of())]
    assert score(pairs)["seconds"].low < score(pairs)["seconds"].value
    assert score([(truth_of(), answer_of())] * 5)["coverage"].low == pytest.approx(0.9, abs=1e-3)


def test_held_out_error_is_taken_at_withheld_conditions():
    truth = truth_of()
    answer = answer_of(predicted=truth.values + np.where(truth.withheld, 1.0, 50.0))
    predicted, calibrated = held_out(truth, answer)
    assert predicted == pytest.approx(1.0)
    assert calibrated == pytest.approx(np.sqrt(np.mean(truth.off[truth.withheld] ** 2)))


def test_a_missing_prediction_is_an_error():
    short = answer_of(run=RUNS[:18], predicted=np.zeros(18), calibrated=np.zeros(18))
    with pytest.raises(InputError, match="no prediction"):
        held_out(truth_of(), short)


def test_coverage_of_exact_intervals_is_ninety_per_cent():
    assert coverage(truth_of(), answer_of()) == pytest.approx(0.90, abs=1e-4)


def test_location_of_a_perfect_map_and_of_a_blind_one():
    assert location_auroc(truth_of(), answer_of()) == 1.0
    assert location_auroc(truth_of(), answer_of(location={})) == 0.5


def test_location_needs_both_classes():
    truth = truth_of()
    assert np.isnan(location_auroc(replace(truth, values=truth.base + 9.0), answer_of()))


def test_auroc_of_reversed_scores_is_zero():
    assert auroc(np.array([3.0, 2.0, 1.0, 0.0]), np.array([False, False, True, True])) == 0.0


def test_log_score_of_known_probabilities():
    answer = answer_of(probabilities={"starvation": 0.8, "windage": 0.5})
    expected = np.log(0.8) + np.log(0.5) + np.log(1 - 1e-4)
    assert log_score(truth_of(), answer, ["starvation", "windage", "none"]) == pytest.approx(expected)


def test_log_score_is_floored():
    answer = answer_of(probabilities={"starvation": 0.0})
    assert log_score(truth_of(), answer, ["starvation"]) == pytest.approx(np.log(1e-4))


def test_claims_and_reliability_count_every_probability():
    table = score([(truth_of(), answer_of()), (truth_of(), answer_of("windage"))])
    assert table["claims"].value == 0.5
    assert sum(row[3] for row in table.reliability) == 4


def test_calibration_intervals_are_checked_by_name():
    assert value("calibration", (truth_of(), answer_of())) == 0.5


def test_identification_by_visibility():
    faint = truth_of(visibility=6.0)
    table = score([(truth_of(), answer_of()), (faint, answer_of("windage"))]).identification
    assert [(row[1], row[2], row[3]) for row in table] == [(6.0, 0.0, 1), (20.0, 1.0, 1)]


def test_confusion_counts_verdicts_by_truth():
    table = score([(truth_of(), answer_of("windage")), (truth_of(), answer_of())]).confusion
    assert table == {"starvation": {"windage": 1, "starvation": 1}}


def test_goals_are_marked_in_the_text():
    text = score([(truth_of(), answer_of())]).text()
    assert "right verdict, one effect, identifiable" in text
    assert "NOT met" not in text.splitlines()[2]


def test_the_best_rival_sets_the_goal_of_the_log_score():
    weak, strong = score([(truth_of(), answer_of("windage"))]), score([(truth_of(), answer_of())])
    assert strong.above([weak])["log_score"].met is True
    assert weak.above([strong])["log_score"].met is False


def test_nothing_to_score_is_an_error():
    with pytest.raises(InputError, match="no answered case"):
        score([])


def test_saved_score_is_plain_json(tmp_path):
    score([(truth_of(), answer_of())]).save(tmp_path / "score.json")
    told = json.loads((tmp_path / "score.json").read_text())
    assert {row["key"] for row in told["rows"]} >= {"right", "claims", "log_score"}


def test_an_unanswered_case_is_named(tmp_path):
    with pytest.raises(InputError, match=r"diagnosis\.json is missing"):
        read_answer(tmp_path)


def test_practice_cases_are_read_as_the_battery_is(shared):
    truths = [read_truth(shared / "cases" / f"case_{i:03d}") for i in range(8)]
    assert [truth.group for truth in truths] == ["none", "none", *["single"] * 4, "measurement", "none"]
    assert all(truth.identifiable for truth in truths)


def test_a_figure_of_no_case_is_a_dash():
    row = Row("right", "right verdicts", float("nan"), 0, float("nan"), float("nan"), None)
    line = Score("a tool", (row,), (), (), {}).text().splitlines()[-1]
    assert line.split() == ["right", "verdicts", "-", "0"]
