"""A battery for other programs: no truth in its blind part, and a scorer that agrees with the package's own."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mixedlub.validation.answers import read_answer, read_truth
from mixedlub.validation.benchmark_scorer import Wrong, scored, wilson
from mixedlub.validation.benchmark_scorer import read_answer as read_entry
from mixedlub.validation.export import export
from mixedlub.validation.intervals import wilson as scipy_wilson
from mixedlub.validation.planted import FORMS, MEASUREMENT, OUTSIDE
from mixedlub.validation.score import score
from profiles.errors import InputError

CASES, SEED = 9, 42


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    out = tmp_path_factory.mktemp("benchmark")
    export(out, CASES, SEED, ("viscosity",), jobs=1, baselines=False)
    return out


def contents(folder):
    return {file.relative_to(folder): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.long
def test_the_parts_hold_all_cases_once(exported):
    parts = [sorted(p.name for p in (exported / "benchmark" / part).iterdir()) for part in ("open", "blind")]
    assert [len(part) for part in parts] == [3, 6]
    assert len(set(parts[0]) | set(parts[1])) == CASES


def test_the_blind_part_holds_no_truth(exported):
    """No file of the truth, none of its keys, no id of an effect, and no seed in what is given away."""
    truth = json.loads(next((exported / "sealed").glob("case_*/truth.json")).read_text(encoding="utf-8"))
    keys = {*truth, *truth["rows"]} - {"case", "noise", "run", "rows", "sd", "base"}
    words = {*FORMS, *OUTSIDE, *MEASUREMENT, *keys}
    for name, text in contents(exported / "benchmark" / "blind").items():
        assert name.name in ("system.toml", "recordings.csv", "conditions.csv")
        assert not set(re.findall(r"\w+", text.decode())) & words, name
    given = b"".join(contents(exported / "benchmark").values())
    assert b"battery.json" not in given
    assert b'"seed"' not in given


def test_the_readings_of_the_blind_part_are_those_that_were_dealt(exported):
    for folder in (exported / "benchmark" / "blind").iterdir():
        for file in folder.iterdir():
            assert file.read_bytes() == (exported / "sealed" / folder.name / file.name).read_bytes()


def test_the_same_seed_writes_the_same_files(exported, tmp_path):
    export(tmp_path, CASES, SEED, ("viscosity",), jobs=1, baselines=False)
    assert contents(tmp_path / "benchmark") == contents(exported / "benchmark")


ENTRANT = """
import csv, json, sys
from pathlib import Path
cases, answers = map(Path, sys.argv[1:])
for place, folder in enumerate(sorted(cases.iterdir())):
    out = answers / folder.name
    out.mkdir(parents=True)
    runs = [row["run"] for row in csv.DictReader((folder / "conditions.csv").open())]
    named = [["none"], ["unknown"], ["sensor_gain"], ["pressure_viscosity_law"]][place % 4]
    answer = {
        "verdict": named, "tied": [named, ["viscosity_drift"]], "outlier_runs": [3, 5],
        "probabilities": {"none": 0.1, named[0]: 0.95}, "mismatch": {"detected": named != ["none"]},
        "location": {"rows": {str(run): (7 * run) % 5 for run in range(1, 90)}},
    }
    (out / "diagnosis.json").write_text(json.dumps(answer))
    rows = [f"{run},{20 + i},{21 + i},{5 + i},{60 + i}" for i, run in enumerate(runs)]
    head = "run,calibrated,predicted,low90,high90"
    (out / "predictions.csv").write_text("\\n".join([head, *rows]))
"""


@pytest.fixture(scope="module")
def entered(exported, tmp_path_factory):
    """Answers of a made-up program to the blind part."""
    place = tmp_path_factory.mktemp("entry")
    (place / "program.py").write_text(ENTRANT)
    blind = exported / "benchmark" / "blind"
    subprocess.run([sys.executable, place / "program.py", blind, place / "answers"], check=True)
    return place / "answers"


def scorer(exported, *arguments):
    """The scorer as a peer runs it: without the package."""
    command = [sys.executable, "-I", exported / "benchmark" / "score.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True)


def test_an_entry_is_scored_as_the_package_scores_it(exported, entered):
    """All figures of the standalone scorer against the package's, of other code."""
    run = scorer(exported, entered, "--truth", exported / "sealed" / "blind_truth")
    assert run.returncode == 0, run.stderr
    found = {row["key"]: row for row in json.loads((entered / "score.json").read_text())}
    about = json.loads((exported / "benchmark" / "benchmark.json").read_text())
    folders = sorted((exported / "benchmark" / "blind").iterdir())
    pairs = [(read_truth(exported / "sealed" / f.name), read_answer(entered / f.name)) for f in folders]
    expected = {row.key: row for row in score(pairs, "entry", about["ids"]).rows}
    assert len(found) == 17
    assert run.stdout.count("\n") == 18
    for key, row in found.items():
        own = expected[key]
        if key == "held_out":  # The package divides by the calibrated model of the answer, which is its own.
            assert row["value"] != pytest.approx(own.value)
            continue
        assert row["count"] == own.count or key == "location", key
        assert np.isclose(np.nan if row["value"] is None else row["value"], own.value, rtol=1e-9, equal_nan=True), key


ABOUT = {"ids": ["sensor_gain"], "measurement": [], "laws": [], "follows_other_laws": False}
PLAIN = {"verdict": ["sensor_gain"], "probabilities": {"sensor_gain": 0.9}}
HEAD = "run,calibrated,predicted,low90,high90\n"


def entry(place, record, predictions=None):
    """Folder with an answer."""
    place.mkdir(parents=True)
    (place / "diagnosis.json").write_text(json.dumps(record))
    if predictions is not None:
        (place / "predictions.csv").write_text(HEAD + predictions)
    return place


def made_up(root, cases):
    """Truths of cases whose base model misses each withheld reading by 2."""
    for name in cases:
        rows = {"run": [1, 2, 3], "withheld": [False, True, True], "truth": [1, 5, 6], "base": [1, 7, 8], "sd": [1] * 3}
        truth = {"case": name, "class": "single", "identifiable": True, "label": "sensor_gain", "outliers": []}
        (root / name).mkdir(parents=True)
        (root / name / "truth.json").write_text(json.dumps({**truth, "rows": rows}))
    return root


def figures_of(root, answers):
    return {row["key"]: row for row in scored(answers, root, ABOUT)}


@pytest.mark.parametrize("calibrated", [7, 500])
def test_predictions_are_judged_by_the_base_model_of_the_truth(tmp_path, calibrated):
    """Errors of 1 where the base model errs by 2, whatever the entrant calls calibrated; two cases lack predictions."""
    truths = made_up(tmp_path / "truths", "abc")
    answers = tmp_path / "answers"
    entry(answers / "a", PLAIN, f"2,{calibrated},6,0,9\n3,{calibrated},7,0,9\n")
    for name in "bc":
        entry(answers / name, {**PLAIN, "tied": [["sensor_gain"], ["none"], "unknown"]})
    found = figures_of(truths, answers)
    assert (found["held_out"]["value"], found["held_out"]["count"]) == (1.0, 3)
    assert found["ties"]["value"] == pytest.approx((1 + 3 + 3) / 3)
    alone = figures_of(made_up(tmp_path / "one", "a"), answers)
    assert alone["held_out"]["value"] == pytest.approx(0.5)


def test_more_outliers_than_readings_are_a_share_of_one(tmp_path):
    answers = tmp_path / "answers"
    entry(answers / "a", {**PLAIN, "outlier_runs": [1, 2, 8, 9]})
    found = figures_of(made_up(tmp_path / "truths", "a"), answers)
    assert (found["outliers_false"]["value"], found["outliers_false"]["count"]) == (1.0, 1)


@pytest.mark.parametrize("row", ["2,7,nan,0,9", "2,7,6,0,inf", "2,7,6,9,0", "2,7,12,0,9", "2,7,,0,9"])
def test_a_prediction_is_finite_and_in_its_interval(tmp_path, row):
    with pytest.raises(Wrong, match=r"predictions\.csv: .*low90"):
        read_entry(entry(tmp_path / "a", PLAIN, row))


@pytest.mark.parametrize(
    ("record", "rule"),
    [
        (3, "the file must be an object"),
        ({**PLAIN, "verdict": None}, "in verdict must be an id"),
        ({**PLAIN, "verdict": []}, "in verdict must be an id"),
        ({**PLAIN, "tied": None}, "tied must be a list"),
        ({**PLAIN, "tied": [3]}, "in tied must be an id"),
        ({**PLAIN, "probabilities": [1]}, "probabilities must be an object"),
        ({**PLAIN, "probabilities": {"none": "1"}}, "numbers from 0 to 1"),
        ({**PLAIN, "mismatch": True}, "mismatch must be an object"),
        ({**PLAIN, "mismatch": {"detected": "no"}}, "mismatch.detected must be true or false"),
        ({**PLAIN, "outlier_runs": None}, "outlier_runs must be a list of runs"),
        ({**PLAIN, "outlier_runs": "35"}, "outlier_runs must be a list of runs"),
        ({**PLAIN, "location": {"rows": {"first": 1.0}}}, "location.rows must be numbers by run"),
        ({**PLAIN, "location": {"rows": [1.0]}}, "location.rows must be an object"),
    ],
)
def test_a_malformed_answer_is_one_sentence_with_the_file(tmp_path, record, rule):
    with pytest.raises(Wrong, match=rf"diagnosis\.json: .*{rule}"):
        read_entry(entry(tmp_path / "a", record))


def test_the_form_of_answers_is_checked_without_the_truth(exported, entered, tmp_path):
    assert "6 cases answered" in scorer(exported, entered, "--check", exported / "benchmark" / "blind").stdout
    bare = scorer(exported, tmp_path, "--check", exported / "benchmark" / "blind")
    assert (bare.returncode, "diagnosis.json: is missing" in bare.stderr) == (2, True)
    lacking = scorer(exported, entered)
    assert "3 of 3 cases are not answered" in lacking.stderr


def test_the_example_entry_runs_alone(exported, tmp_path):
    folder = exported / "benchmark"
    subprocess.run([sys.executable, "-I", folder / "entrant.py", folder / "open", tmp_path / "a"], check=True)
    figures = {
        row["key"]: row
        for row in scored(tmp_path / "a", folder / "open", json.loads((folder / "benchmark.json").read_text()))
    }
    assert figures["power"]["value"] in (0.0, None)
    assert "nothing is missing" in (folder / "README.md").read_text()


@pytest.mark.parametrize(("hits", "of"), [(0, 4), (3, 7), (20, 20)])
def test_intervals_are_those_of_scipy(hits, of):
    assert np.allclose(wilson(hits / of, of), scipy_wilson(hits, of), atol=1e-9)


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="holds other files"):
        export(Path(tmp_path), CASES, SEED, ("viscosity",), jobs=1)
