"""Baselines and the whole proof on a handful of cases."""

import json
import sys
from pathlib import Path

import pytest

from mixedlub.cli import main
from mixedlub.validation import baselines
from mixedlub.validation.answers import read_answer, read_truth
from mixedlub.validation.baselines import BASELINES, recalibrate, recalibration_only
from mixedlub.validation.measures import held_out
from mixedlub.validation.oracle import oracle
from mixedlub.validation.prove import prove, unsealed
from profiles.errors import InputError

CALLS: list[str] = []


def counted(case: Path, out: Path) -> None:
    CALLS.append(case.name)
    assert not (case / "truth.json").exists()
    recalibration_only(case, out)


@pytest.fixture
def without_learners(monkeypatch):
    for name in [name for name in sys.modules if name == "sklearn" or name.startswith("sklearn.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "sklearn", None)


@pytest.mark.parametrize("name", list(BASELINES))
def test_baselines_answer_in_the_form_of_the_diagnosis(battery, tmp_path, name):
    if name != "recalibration only":
        pytest.importorskip("sklearn")
    case = unsealed(battery[0], tmp_path)
    BASELINES[name](case, tmp_path / "answer")
    answer, truth = read_answer(tmp_path / "answer"), read_truth(battery[0])
    assert set(answer.run) == set(truth.run)
    assert all(0 < p < 1 for p in answer.probabilities.values())
    assert (answer.low < answer.high).all()
    predicted, calibrated = held_out(truth, answer)
    assert predicted < 3 * calibrated + 3


def test_the_oracle_names_what_is_clearly_hidden(battery, tmp_path):
    clear = [folder for folder in battery if read_truth(folder).visibility > 12]
    folder = next(folder for folder in clear if read_truth(folder).group == "single")
    oracle(unsealed(folder, tmp_path), tmp_path / "answer")
    answer, truth = read_answer(tmp_path / "answer"), read_truth(folder)
    assert answer.verdict == truth.label
    predicted, calibrated = held_out(truth, answer)
    assert predicted < 0.5 * calibrated


def test_recalibration_finds_the_noise_where_nothing_is_missing(battery, tmp_path):
    nulls = [folder for folder in battery if read_truth(folder).group == "none"]
    for folder in nulls:
        fitted = recalibrate(folder)
        assert fitted.squares / len(fitted.good) == pytest.approx(1.0, abs=0.5)
        flagged = {int(run) for run in fitted.run[: fitted.seen][fitted.spoiled]}
        assert flagged >= read_truth(folder).outliers


def test_missing_scikit_learn_says_what_to_install(battery, tmp_path, without_learners):
    with pytest.raises(InputError, match=r"mixedlub\[proof\]"):
        baselines.gaussian_process(battery[0], tmp_path)


def test_missing_scikit_learn_is_told_before_any_work(tmp_path, without_learners, capsys):
    CALLS.clear()
    with pytest.raises(InputError, match=r"pip install scikit-learn.*--quick"):
        prove(tmp_path / "folder", counted, cases=5, seed=21, jobs=1)
    assert CALLS == []
    assert not (tmp_path / "folder").exists()
    assert main(["prove", "--out", str(tmp_path / "out")]) == 2
    assert "scikit-learn" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_the_proof_runs_scores_and_resumes(tmp_path):
    CALLS.clear()
    first = prove(tmp_path, counted, cases=5, seed=21, jobs=1, baselines=False)
    assert sorted(CALLS) == [f"case_{i:03d}" for i in range(5)]
    (tmp_path / "answers" / "case_002" / "seconds.json").unlink()
    again = prove(tmp_path, counted, cases=5, seed=21, jobs=1, baselines=False)
    assert CALLS[5:] == ["case_002"]
    assert first[0]["log_score"].value == pytest.approx(again[0]["log_score"].value)
    assert {file.name for file in (tmp_path / "figures").iterdir()} == {
        "score_table.svg",
        "reliability.svg",
        "identification.svg",
        "confusion.svg",
    }
    told = json.loads((tmp_path / "score.json").read_text())
    assert told["tool"] == "mixedlub diagnose"
    assert "withheld" in (tmp_path / "score.txt").read_text()
