"""Campaigns of the proof: rigs are read anew under their own laws, and every way is scored against the truth."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mixedlub.validation import loop
from mixedlub.validation.case_folder import read_columns
from mixedlub.validation.loop import CORNERS, PROPOSED, RANDOM, chosen, conditions, orders, play, read, standing
from mixedlub.validation.sample_case import Order, sample_case
from profiles.errors import InputError

DISC = Order("case_000", "disc", "single", ("limiting_shear_stress",), "clear", small=True)
GEARS = Order("case_001", "gear_pair", "single", ("rolling_resistance",), "clear", small=True)


@pytest.mark.parametrize("order", [DISC, GEARS])
def test_a_rig_is_read_anew_under_its_own_laws(order: Order) -> None:
    """At the conditions of its programme it gives the readings of its programme, with its noise."""
    sample = sample_case(np.random.default_rng(3), order)
    rig = sample.rig.refined
    truth = rig.records(sample.z, sample.acts)
    new = {name: rig.columns[name] for name in conditions(rig.columns)}
    scaled = (read(sample, new, np.random.default_rng(4)) - truth) / sample.sd(truth)
    assert 0.75 < float(np.mean(scaled**2)) < 1.3
    assert abs(float(scaled.mean())) < 4.0 / np.sqrt(scaled.size)


def test_rivals_of_the_proposal_stay_on_recorded_levels_and_pairs() -> None:
    recorded = {
        "run": np.arange(4),
        "surface_1": np.array(["a", "a", "b", "b"], dtype=object),
        "surface_2": np.array(["b", "b", "b", "b"], dtype=object),
        "load_N": np.array([1.0, 2.0, 3.0, 1.0]),
    }
    rng = np.random.default_rng(1)
    corners = chosen(CORNERS, recorded, 50, rng)
    assert set(corners["load_N"]) == {1.0, 3.0}
    assert set(zip(corners["surface_1"], corners["surface_2"], strict=True)) == {("a", "b"), ("b", "b")}
    assert set(chosen(RANDOM, recorded, 50, rng)["load_N"]) == {1.0, 2.0, 3.0}


def test_standing_of_the_truth() -> None:
    record = {"probabilities": {"a": 0.9, "b": 0.2}, "verdict": ["a"], "tied": [["a"], ["a", "b"]]}
    both = standing(record, ["a", "b"])
    assert both.log_odds == pytest.approx(np.log(0.25))
    assert (both.settled, both.right, both.tied) == (False, False, True)
    assert standing(record, ["a"]).right


def test_campaigns_start_from_small_recordings_with_something_missing() -> None:
    dealt = orders(5, 3)
    assert all(one.small and not one.outliers and one.label != "none" for one in dealt)


def _answer(out: Path, case: Path, chance: float) -> None:
    """An answer with this probability of the truth, and a batch of one test at a recorded condition."""
    tied = [["limiting_shear_stress"], ["film_heating"]]
    record = {
        "probabilities": {"limiting_shear_stress": chance},
        "verdict": ["limiting_shear_stress"],
        "tied": tied[: 1 if chance > 0.9 else 2],
        "next_batch": {"expected_bits": 0.5, "readings": 7},
    }
    (out / "diagnosis.json").write_text(json.dumps(record), encoding="utf-8")
    rows = pd.read_csv(case / "recordings.csv").head(1).drop(columns=["sequence"])
    rows.assign(run=1000, friction_coefficient="").to_csv(out / "next_tests.csv", index=False)


def test_each_way_is_answered_once_and_scored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loop, "orders", lambda seed, campaigns, kinds: [DISC])
    seen: list[str] = []

    def diagnose(case: Path, out: Path) -> None:
        rows = len(read_columns(case / "recordings.csv")["run"])
        seen.append(f"{case.parent.name} {rows}")
        _answer(out, case, 0.5)

    def add(case: Path, file: Path, answered: Path, out: Path) -> None:
        assert np.isfinite(pd.read_csv(file)["friction_coefficient"]).all()
        seen.append("added")
        _answer(out, case, 0.95)
        (out / "campaign.json").write_text(json.dumps({"expected_bits": 0.5, "realised_bits": 0.8}), encoding="utf-8")

    text = play(tmp_path, diagnose, add, 1, 3)
    rows = int(seen[0].split()[1])
    assert seen == [f"cases {rows}", "added", f"random_cases {rows + 1}", f"corners_cases {rows + 1}"]
    assert play(tmp_path, diagnose, add, 1, 3) == text
    assert len(seen) == 4
    (told,) = json.loads((tmp_path / "score.json").read_text(encoding="utf-8"))
    change = told[PROPOSED]["log_odds"] - told["before"]["log_odds"]
    assert change == pytest.approx(np.log(19.0))
    assert f"{change:.2f}" in text
    assert (told[PROPOSED]["settled"], told[RANDOM]["settled"]) == (True, False)


def test_campaigns_are_played_on_rigs_that_can_be_read_anew(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="campaigns are played on gear_pair and disc"):
        play(tmp_path, lambda case, out: None, lambda *given: None, 1, 1, ("film",))
