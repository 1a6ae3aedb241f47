"""The battery on real recordings: what is concealed, what counts as right, and that test sources stay unseen."""

import json
import tomllib

import numpy as np
import pandas as pd
import pytest

from mixedlub.validation.case_folder import read_case
from mixedlub.validation.real import figures
from mixedlub.validation.real.deal import HIDDEN, PAIRED, PLANTED, UNTOUCHED, cases_of, deal, noise_of
from mixedlub.validation.real.figures import Located, read_truth
from mixedlub.validation.real.judge import validate
from mixedlub.validation.real.source import licences, read_recording, recordings
from profiles.errors import InputError

from .helpers import says_none

FACTS = """
title = "a track"
authors = "A. Maker"
year = 2020
url = "https://example.org"
licence = "CC-BY-4.0"
obtained = "made for this test"
kind = "friction_history"
understood = true
acts = []
why = "The level is constant."
fault_runs = [7]

[[hidden]]
column = "load_N"
expected = "the step of load is left in time"
right = ["friction_event", "unknown"]
where = ["time_s"]
beside = ["weight_kg"]

[[paired]]
split_by = "setup"
values = ["first", "second"]
expected = "another specimen"
right = ["unknown"]
"""


@pytest.fixture
def folder(tmp_path):
    """Two recordings of two sources, one of them of the test."""
    rng = np.random.default_rng(4)
    for name in ("maker__track", "other__track"):
        place = tmp_path / "recordings" / name
        place.mkdir(parents=True)
        (place / "source.toml").write_text(FACTS)
        (place / "system.toml").write_text(
            'schema = "mixedlub-case/1"\nkind = "friction_history"\n\n'
            '[recording]\nquantity = "friction_coefficient"\nnoise = { relative = 0.01 }\n'
        )
        count = 60
        table = {
            "run": np.arange(1, count + 1),
            "time_s": np.tile(np.arange(30) * 10.0, 2),
            "load_N": np.repeat([10.0, 20.0], 30),
            "weight_kg": np.repeat([1.0, 2.0], 30),
            "setup": np.repeat(["first", "second"], 30),
            "friction_coefficient": 0.1 * (1.0 + 0.01 * rng.standard_normal(count)),
        }
        pd.DataFrame(table).to_csv(place / "recordings.csv", index=False)
    (tmp_path / "recordings" / "split.toml").write_text('test = ["other"]\n')
    return tmp_path / "recordings"


def of(label, dealt):
    return [one for one in dealt if one.label == label]


def test_recordings_have_their_source_and_split(folder):
    found = recordings(folder)
    assert [(one.source, one.split) for one in found] == [("maker", "development"), ("other", "test")]
    assert licences(found) == ["A. Maker (2020): a track. CC-BY-4.0"] * 2


def test_a_recording_without_readings_is_left_out(folder):
    (folder / "maker__track" / "recordings.csv").unlink()
    assert [one.source for one in recordings(folder)] == ["other"]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('licence = "CC-BY-4.0"\n', "", "licence"),
        ('licence = "CC-BY-4.0"', 'licence = " "', "none stated"),
        ("understood =", "understod =", "understood"),
        ('right = ["unknown"]', "", "right"),
    ],
)
def test_a_source_that_lacks_a_fact_is_refused_with_it(folder, old, new, told):
    file = folder / "maker__track" / "source.toml"
    file.write_text(file.read_text().replace(old, new))
    with pytest.raises(InputError, match=told):
        recordings(folder)


def test_a_hidden_channel_that_is_constant_is_refused(folder):
    place = next(one for one in recordings(folder) if one.hidden).folder
    frame = pd.read_csv(place / "recordings.csv").assign(load_N=20.0)
    frame.to_csv(place / "recordings.csv", index=False)
    with pytest.raises(InputError, match=r"hidden: 'load_N': does not change in this recording"):
        cases_of(read_recording(place), 1)


def test_a_hidden_channel_and_its_copies_are_gone(folder):
    (hidden,) = of(HIDDEN, cases_of(recordings(folder)[0], 1))
    assert not {"load_N", "weight_kg"} & set(hidden.case.columns)
    assert hidden.truth["right"] == ["friction_event"]
    assert hidden.truth["unknown_right"]
    assert hidden.truth["where"] == ["time_s"]


def test_a_required_channel_is_hidden_behind_its_median(folder):
    file = folder / "maker__track" / "source.toml"
    file.write_text(file.read_text().replace('column = "load_N"', 'column = "time_s"'))
    (hidden,) = of(HIDDEN, cases_of(recordings(folder)[0], 1))
    assert set(hidden.case.columns["time_s"]) == {145.0}


def test_paired_groups_stand_in_one_case_on_one_clock(folder):
    (paired,) = of(PAIRED, cases_of(recordings(folder)[0], 1))
    assert "setup" not in paired.case.columns
    assert np.diff(paired.case.columns["time_s"].astype(float)) == pytest.approx(10.0)


def test_planted_effects_are_added_to_the_readings_as_they_are(folder):
    recording = recordings(folder)[0]
    planted = of(PLANTED, cases_of(recording, 1))
    given = read_case(recording.folder)
    readings = given.columns["friction_coefficient"].astype(float)
    assert len(planted) == 3
    for one in planted:
        more = one.case.columns["friction_coefficient"] - readings
        assert more == pytest.approx(one.truth["planted"], abs=1e-9)
        sd = noise_of(given, readings)
        assert 0.6 * 10.0 < one.truth["visibility"] < np.sqrt(np.sum((more / sd) ** 2)) * 1.01
    assert [one.truth["named"] for one in planted] == [True, True, False]
    assert planted[2].truth["unknown_right"]


def test_noise_that_nobody_states_is_the_scatter_of_neighbours(folder):
    case = read_case(folder / "maker__track")
    del case.settings["recording"]["noise"]
    readings = case.columns["friction_coefficient"].astype(float)
    assert noise_of(case, readings)[0] == pytest.approx(0.001, rel=0.3)


def test_the_same_seed_deals_the_same_cases(folder, tmp_path):
    found = recordings(folder)
    first, second = (deal(found, tmp_path / name, 3) for name in ("a", "b"))
    assert [p.name for p in first] == [p.name for p in second]
    for one, other in zip(first, second):
        assert (one / "truth.json").read_bytes() == (other / "truth.json").read_bytes()
        assert (one / "recordings.csv").read_bytes() == (other / "recordings.csv").read_bytes()


def test_withheld_readings_are_asked_and_not_given(folder, tmp_path):
    for place in deal(recordings(folder)[:1], tmp_path / "sealed", 3):
        truth = read_truth(place)
        asked, given = (pd.read_csv(place / name) for name in ("conditions.csv", "recordings.csv"))
        assert set(asked["run"]) == set(truth.run[truth.withheld])
        assert "friction_coefficient" not in asked
        assert not set(given["run"]) & set(asked["run"])


def test_misses_of_the_test_are_not_listed(folder, tmp_path):
    for split in ("development", "test"):
        score = validate(folder, tmp_path / split, says_none, split, 3, jobs=1)
        text = (tmp_path / split / "score.txt").read_text()
        assert ("answers that are not right" in text) == (split == "development")
        figure = {row.key: row.value for row in score.rows}
        assert figure["untouched"] == 1.0
        assert not figure["planted"] > 0.0
        record = json.loads((tmp_path / split / "score.json").read_text())
        assert record["split"] == split
        assert record["cases"] == 6
    with pytest.raises(InputError, match="development, test"):
        validate(folder, tmp_path / "no", says_none, "tests", 3)


def answered(verdict, tied=(), probabilities=None, places=()):
    from types import SimpleNamespace

    sets = [frozenset(one) for one in (verdict, *tied)]
    answer = SimpleNamespace(
        verdict=sets[0], tied=tuple(sets), probabilities=probabilities or {}, outliers=frozenset({7})
    )
    return Located(answer, tuple(places))


@pytest.mark.parametrize(
    ("verdict", "tied", "is_right", "claimed"),
    [
        (["friction_event"], [], True, False),
        (["friction_event", "stribeck"], [], False, True),
        (["unknown"], [], True, False),
        (["none"], [], False, False),
        (["stribeck"], [["friction_event"]], True, True),
    ],
)
def test_an_answer_is_right_if_it_names_a_cause_and_invents_none(folder, tmp_path, verdict, tied, is_right, claimed):
    places = deal(recordings(folder)[:1], tmp_path / "sealed", 3)
    truth = next(t for t in map(read_truth, places) if t.label == HIDDEN)
    found = answered(verdict, tied, dict.fromkeys(verdict, 0.95), ["time_s"])
    assert figures.right(truth, found) is is_right
    assert figures.falsely_claimed(truth, found) is claimed
    assert figures.located(truth, found)
    assert not figures.located(truth, answered(verdict, places=["run", "setup", "time_s"]))


def test_nothing_missing_is_none_or_a_tie_with_it(folder, tmp_path):
    places = deal(recordings(folder)[:1], tmp_path / "sealed", 3)
    truth = next(t for t in map(read_truth, places) if t.label == UNTOUCHED)
    assert figures.right(truth, answered(["none"]))
    assert figures.right(truth, answered(["stribeck"], [["none"]]))
    assert not figures.right(truth, answered(["unknown"]))
    assert figures.faults_found(truth, answered(["none"]))


def test_every_licence_and_split_of_the_shipped_recordings_reads():
    from pathlib import Path

    place = Path(__file__).parents[2] / "benchmarks" / "recordings"
    test = tomllib.loads((place / "split.toml").read_text())["test"]
    for source in place.glob("*/source.toml"):
        read_recording(source.parent, frozenset(test))
