"""Hypotheses of a case: the true law is found among false ones, and the answer says so in every file."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.api.diagnosis import Answer
from mixedlub.effects import catalogue
from profiles.errors import InputError
from tests.own_laws.planted import IDENTIFIABLE, Made, make

RIVALS = ("inlet_shear_heating", "film_heating", "film_law", "boundary_speed_dependence", "sensor_gain")
"""Effects left in the catalogue, to keep the tests short."""
OTHERS = tuple(name for name in catalogue() if name not in RIVALS)
CASES, GEARS, BAR = 24, (1, 3, 5), 0.95
"""Cases of the battery, seeds of gears, and least share of identifiable cases in which the true law is the answer."""

Diagnosed = tuple[Made, Answer]


@pytest.fixture(scope="module")
def discs(tmp_path_factory: pytest.TempPathFactory) -> Diagnosed:
    made = make(tmp_path_factory.mktemp("own") / "discs", "disc", 0)
    return made, ml.diagnose(made.folder, exclude=OTHERS)


@pytest.fixture(scope="module")
def gears(tmp_path_factory: pytest.TempPathFactory) -> Diagnosed:
    made = make(tmp_path_factory.mktemp("own") / "gears", "gear_pair", 1)
    return made, ml.diagnose(made.folder, exclude=OTHERS)


@pytest.mark.parametrize("which", ["discs", pytest.param("gears", marks=pytest.mark.long)])
def test_the_true_law_is_found_among_false_ones(which: str, request: pytest.FixtureRequest) -> None:
    made, answer = request.getfixturevalue(which)
    assert answer.verdict == [made.truth]
    (fitted,) = answer.parameters.query("of == @made.truth").to_dict("records")
    assert fitted["low90"] - 0.1 < made.size < fitted["high90"] + 0.1


def test_every_hypothesis_has_its_line(discs: Diagnosed) -> None:
    made, answer = discs
    rows = answer.record["hypotheses"]
    assert {row["id"] for row in rows} == {path.stem for path in (made.folder / "hypotheses").iterdir()}
    assert rows[0]["id"] == made.truth
    assert rows[0]["log_odds"] == 0.0
    assert all(row["log_odds"] < -np.log(10.0) for row in rows[1:])
    assert all(rows[0]["heldout"] < row["heldout"] for row in rows[1:])
    assert rows[0]["heldout"] < 1.3 < answer.record["fit"]["heldout_before"]
    assert all(answer.record["probabilities"][row["id"]] == row["probability"] for row in rows)
    assert f"Your {made.truth.replace('_', ' ')} is in the answer" in answer.summary()


def test_the_files_have_the_law_and_run(discs: Diagnosed, tmp_path: Path) -> None:
    made, answer = discs
    answer.write(tmp_path)
    assert json.loads((tmp_path / "diagnosis.json").read_text(encoding="utf-8"))["verdict"] == [made.truth]
    assert "Your hypotheses" in (tmp_path / "report.html").read_text(encoding="utf-8")
    law = (tmp_path / "improved" / "laws" / f"{made.truth}.toml").read_bytes()
    assert law == (made.folder / "hypotheses" / f"{made.truth}.toml").read_bytes()
    again = ml.simulate(tmp_path / "improved").set_index("run")["friction_coefficient"]
    pd.testing.assert_series_equal(again, ml.simulate(answer.improved).set_index("run")["friction_coefficient"])
    recorded = pd.read_csv(made.folder / "recordings.csv").set_index("run")["friction_coefficient"]
    sd = answer.predictions.set_index("run")["predicted"].loc[recorded.index] * 0.05
    assert float(np.sqrt(np.mean(((recorded - again.loc[recorded.index]) / sd) ** 2))) < 2.0


def test_hypotheses_are_given_from_python_and_left_out_by_id(discs: Diagnosed) -> None:
    made, _ = discs
    case = ml.case.read_case(made.folder)
    assert len(case.hypotheses) == 4
    with pytest.raises(InputError, match=r"is the id of .* too"):
        ml.diagnose(case, hypotheses=[made.folder / "hypotheses" / f"{made.truth}.toml"])
    with pytest.raises(InputError, match=r"hypotheses.*: needs a path"):
        ml.diagnose(case, hypotheses=[3])


@pytest.mark.long
def test_the_true_one_of_four_wins(tmp_path: Path) -> None:
    right = []
    for seed in range(CASES):
        made = make(tmp_path / str(seed), "gear_pair" if seed in GEARS else "disc", seed)
        named = ml.diagnose(made.folder).verdict == [made.truth]
        if named or made.lead() > IDENTIFIABLE:
            right.append(named)
    assert len(right) >= 0.8 * CASES
    assert np.mean(right) >= BAR
