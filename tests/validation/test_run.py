"""Baselines, and the whole validation on a handful of cases."""

import json
import shutil
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from typer.testing import CliRunner

from mixedlub.cli import app, main
from mixedlub.validation import baselines
from mixedlub.validation.answers import read_answer, read_truth
from mixedlub.validation.baselines import BASELINES, recalibrate
from mixedlub.validation.battery import MARK, generate, make, plan
from mixedlub.validation.measures import held_out
from mixedlub.validation.oracle import oracle
from mixedlub.validation.outside import KINDS as UNLISTED
from mixedlub.validation.outside import OUTSIDE_FIGURES
from mixedlub.validation.poor import POOR_FIGURES
from mixedlub.validation.rigs import CONTACTS, OTHERS
from mixedlub.validation.run import BROKEN, Steady, figures_of, judge, unsealed, validate
from mixedlub.validation.score import FIGURES
from mixedlub.validation.solved.figures import SOLVED_FIGURES
from mixedlub.validation.worlds.figures import WORLD_FIGURES
from profiles.errors import InputError

from .conftest import SEED
from .helpers import says_none, truth_of

CALLS: list[str] = []
WORLDS = ("gear_pair", "disc", "film", "friction_history", "viscosity", "mesh_friction")


def counted(case: Path, out: Path) -> None:
    CALLS.append(case.name)
    assert not (case / "truth.json").exists()
    says_none(case, out)


@contextmanager
def without_rivals():
    """Cases are called identifiable, and no rival is fitted to them, which takes nearly all of their time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mixedlub.validation.battery.weighed", lambda sample, label: ({"none": 100.0}, 0.0))
        yield


@pytest.fixture(scope="module")
def dealt(tmp_path_factory):
    """Eight cases of gears and discs, every class among them."""
    with without_rivals():
        return generate(tmp_path_factory.mktemp("dealt"), seed=11, cases=8)


@pytest.fixture
def without_learners(monkeypatch):
    for name in [name for name in sys.modules if name == "sklearn" or name.startswith("sklearn.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "sklearn", None)


@pytest.mark.parametrize("name", list(BASELINES))
def test_baselines_answer_in_the_form_of_the_diagnosis(dealt, tmp_path, name):
    if name != "recalibration only":
        pytest.importorskip("sklearn")
    case = unsealed(dealt[0], tmp_path)
    BASELINES[name](case, tmp_path / "answer")
    answer, truth = read_answer(tmp_path / "answer"), read_truth(dealt[0])
    assert set(answer.run) == set(truth.run)
    assert all(0 < p < 1 for p in answer.probabilities.values())
    assert (answer.low < answer.high).all()
    predicted, calibrated = held_out(truth, answer)
    assert predicted < 3 * calibrated + 3


@pytest.mark.long
def test_the_oracle_names_what_is_clearly_hidden(dealt, tmp_path):
    clear = [folder for folder in dealt if read_truth(folder).visibility > 12]
    folder = next(folder for folder in clear if read_truth(folder).group == "single")
    oracle(unsealed(folder, tmp_path), tmp_path / "answer")
    answer, truth = read_answer(tmp_path / "answer"), read_truth(folder)
    assert answer.verdict == truth.label
    predicted, calibrated = held_out(truth, answer)
    assert predicted < 0.5 * calibrated


def test_recalibration_finds_the_noise_where_nothing_is_missing(dealt, tmp_path):
    nulls = [folder for folder in dealt if read_truth(folder).group == "none"]
    for folder in nulls:
        fitted = recalibrate(folder)
        assert fitted.squares / len(fitted.good) == pytest.approx(1.0, abs=0.5)
        flagged = {int(run) for run in fitted.run[: fitted.n_recorded][fitted.spoiled]}
        assert flagged >= read_truth(folder).outliers


def test_missing_scikit_learn_says_what_to_install(dealt, tmp_path, without_learners):
    with pytest.raises(InputError, match=r"pip install scikit-learn"):
        baselines.gaussian_process(dealt[0], tmp_path)


def test_missing_scikit_learn_is_told_before_any_work(tmp_path, without_learners, capsys):
    CALLS.clear()
    with pytest.raises(InputError, match=r"pip install scikit-learn.*--quick"):
        validate(tmp_path / "folder", counted, cases=5, seed=21, jobs=1, baselines=True)
    assert CALLS == []
    assert not (tmp_path / "folder").exists()
    assert main(["prove", "--out", str(tmp_path / "out")]) == 2
    assert "scikit-learn" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_run_is_scored_and_resumed(tmp_path):
    CALLS.clear()
    first = validate(tmp_path, counted, cases=5, seed=21, kinds=("viscosity",), jobs=1)
    assert sorted(CALLS) == [f"case_{i:03d}" for i in range(5)]
    (tmp_path / "answers" / "case_002" / "seconds.json").unlink()
    again = validate(tmp_path, counted, cases=5, seed=21, kinds=("viscosity",), jobs=1)
    assert CALLS[5:] == ["case_002"]
    assert first["all"]["log_score"].value == pytest.approx(again["all"]["log_score"].value)
    assert {file.name for file in (tmp_path / "figures").iterdir()} == {
        "score_table.svg",
        "reliability.svg",
        "identification.svg",
        "confusion.svg",
    }
    told = json.loads((tmp_path / "score.json").read_text())
    assert told["tool"] == "mixedlub diagnose"
    assert "withheld" in (tmp_path / "score.txt").read_text()


def test_the_truth_of_a_disc_explains_its_readings_and_no_rival_does(tmp_path):
    order = plan(11, 8)[2]
    assert (order.kind, order.effects) == ("disc", ("film_heating",))
    found = truth_of(tmp_path / make(11, 2, order, tmp_path))
    assert found["own"] < min(found["alternatives"].values()) - 30
    assert max(found["alternatives"].values()) <= found["alternatives"]["none"] + 1e-3
    assert "film_heating" not in found["alternatives"]
    assert found["identifiable"]


def _answered(dealt, tmp_path, mark):
    """Copies of dealt cases beside another file of the battery, answered."""
    for case in dealt:
        shutil.copytree(case, tmp_path / "sealed" / case.name)
        (tmp_path / "answers" / case.name).mkdir(parents=True)
        says_none(case, tmp_path / "answers" / case.name)
    if mark is not None:
        (tmp_path / "sealed" / MARK).write_text(json.dumps(mark))
    return [tmp_path / "sealed" / case.name for case in dealt]


NAMED = {
    "": FIGURES,
    "plan": FIGURES,
    "plan_forms": FIGURES,
    "plan_worlds": WORLD_FIGURES,
    "plan_poor": POOR_FIGURES,
    "plan_outside": OUTSIDE_FIGURES,
    "plan_solved": SOLVED_FIGURES,
}


@pytest.mark.parametrize("name", list(NAMED))
def test_the_file_of_a_battery_decides_its_figures(tmp_path, name):
    (tmp_path / MARK).write_text(json.dumps({"dealt_by": name} if name else {"seed": 3}))
    assert figures_of(tmp_path) is NAMED[name]


def test_truths_alone_do_not_decide_the_figures(dealt, tmp_path):
    """No case follows a law, and the figures of laws are scored, since the file says so."""
    assert json.loads((dealt[0].parent / MARK).read_text())["dealt_by"] == "plan"
    rows = judge(tmp_path, _answered(dealt, tmp_path, {"dealt_by": "plan_worlds"}))["all"].rows
    assert [row.key for row in rows[: len(WORLD_FIGURES)]] == [figure.key for figure in WORLD_FIGURES]


@pytest.mark.parametrize(("mark", "said"), [(None, "battery.json"), ({"dealt_by": "plan_any"}, "plan_solved")])
def test_a_battery_without_a_known_name_is_refused(dealt, tmp_path, mark, said):
    with pytest.raises(InputError, match=said):
        judge(tmp_path, _answered(dealt[:2], tmp_path, mark))


def test_cases_of_no_folder_or_of_two_are_refused(tmp_path):
    for folders in ([], [tmp_path / "a" / "case_000", tmp_path / "b" / "case_000"]):
        with pytest.raises(InputError, match="cases of one battery"):
            judge(tmp_path, folders)


@pytest.mark.long
def test_counts_by_kind_wrong_answers_and_break_downs(named_orders, tmp_path):
    with without_rivals():
        dealt = [tmp_path / make(SEED, place, order, tmp_path) for place, order in enumerate(named_orders.values())]
    (tmp_path / MARK).write_text('{"dealt_by": "plan"}')
    for folder in dealt:
        place = tmp_path / "answers" / folder.name
        place.mkdir(parents=True)
        Steady(says_none)(folder, place)
    scores = judge(tmp_path, dealt)
    assert set(scores) == {"all", "film", "friction_history", "friction_map", "viscosity", "mesh_friction"}
    assert scores["all"]["none"].value == 1.0
    assert scores["all"]["right"].value == 0.0
    assert scores["mesh_friction"]["right"].value == 0.0
    assert scores["mesh_friction"]["outliers_false"].value == 1.0
    assert scores["friction_history"]["tied"].value == pytest.approx(1 / 3)
    text = (tmp_path / "score.txt").read_text()
    lines = {line[:36].strip(): line[36:].split() for line in text.splitlines()}
    assert lines["none where nothing is missing"] == ["2/2", "-", "-", "1/1", "-", "1/1"]
    assert lines["right or tied, one effect, all"] == ["0/6", "1/3", "0/4", "0/2", "0/1", "0/3"]
    assert "case_008 friction_map     single     *" in text
    assert "stribeck -> none  tied: sensor_gain" in text
    assert "film_heating -> RuntimeError: no gears here" in text
    assert (tmp_path / "answers" / "case_017" / BROKEN).exists()


@pytest.mark.parametrize(
    ("words", "asked"),
    [
        ([], {"cases": 240, "kinds": CONTACTS, "baselines": True}),
        (["--quick"], {"cases": 10, "kinds": CONTACTS, "baselines": False}),
        (["--rigs"], {"cases": 200, "kinds": OTHERS, "baselines": False}),
        (["--rigs", "--quick"], {"cases": 25, "kinds": OTHERS, "baselines": False}),
        (["--kinds", "film,disc", "--quick"], {"cases": 25, "kinds": ("disc", "film"), "baselines": False}),
        (["--kinds", "gear_pair", "--cases", "7"], {"cases": 7, "kinds": ("gear_pair",), "baselines": True}),
        (["--outside"], {"cases": 100, "kinds": UNLISTED, "baselines": False, "dealt": "plan_outside"}),
        (["--outside", "--quick"], {"cases": 10, "kinds": UNLISTED, "baselines": False, "dealt": "plan_outside"}),
        (["--solved", "--quick"], {"cases": 12, "kinds": CONTACTS, "baselines": False, "dealt": "plan_solved"}),
        (["--worlds"], {"cases": 240, "kinds": WORLDS, "baselines": False, "dealt": "plan_worlds"}),
        (["--worlds", "--quick"], {"cases": 25, "kinds": WORLDS, "baselines": False, "dealt": "plan_worlds"}),
        (
            ["--worlds", "--kinds", "disc"],
            {"cases": 240, "kinds": ("disc",), "baselines": False, "dealt": "plan_worlds"},
        ),
        (
            ["--worlds", "--rigs", "--cases", "40"],
            {"cases": 40, "kinds": WORLDS[2:], "baselines": False, "dealt": "plan_worlds"},
        ),
    ],
    ids=" ".join,
)
def test_the_command_deals_the_chosen_kinds(tmp_path, monkeypatch, words, asked):
    said = {}

    def noted(folder, diagnose, cases, seed, kinds, *, jobs, baselines, progress, dealt):
        said.update(cases=cases, seed=seed, kinds=kinds, baselines=baselines, dealt=dealt.__name__)
        (folder / "score.txt").write_text("scored")

    monkeypatch.setattr("mixedlub.validation.run.validate", noted)
    done = CliRunner().invoke(app, ["prove", *words, "--seed", "3", "--out", str(tmp_path / "out")])
    assert done.exit_code == 0
    assert said == {"dealt": "plan", **asked, "seed": 3}
    assert "scored" in done.stdout


def test_a_kind_without_other_laws_is_refused(tmp_path, capsys):
    assert main(["prove", "--worlds", "--kinds", "friction_map", "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert "friction_map" in said
    assert "are dealt for gear_pair" in said


def test_full_physics_is_a_battery_of_gears_and_discs(tmp_path, capsys):
    assert main(["prove", "--solved", "--kinds", "film", "--out", str(tmp_path / "out")]) == 2
    assert "gear_pair and disc alone" in capsys.readouterr().err
    assert main(["prove", "--solved", "--poor", "--out", str(tmp_path / "out")]) == 2
    assert "--solved: is a battery of its own" in capsys.readouterr().err


def test_a_kind_that_no_battery_has_is_named_with_those_that_there_are(tmp_path, capsys):
    assert main(["prove", "--kinds", "disc,gears", "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert "gears" in said
    assert "gear_pair, disc, film" in said


def test_baselines_of_rigs_that_a_case_does_not_describe_are_refused(tmp_path):
    with pytest.raises(InputError, match="gear_pair and disc alone"):
        validate(tmp_path, counted, cases=25, seed=1, kinds=OTHERS, baselines=True)
