"""A law without a name: found in the model, fitted, proved on left-out levels, and handed on as a file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mixedlub.api.diagnosis import Answer
from mixedlub.case.files import case_files
from mixedlub.case.folder import conditions_for, read_case
from mixedlub.case.simulation import simulate
from mixedlub.diagnosis.assessment.answer_checks import answer_warnings
from mixedlub.diagnosis.assessment.cross_validation import HeldOut
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.discovery import laws
from mixedlub.diagnosis.discovery.laws import _is_law
from mixedlub.diagnosis.report.files import write
from mixedlub.diagnosis.search.search import Search
from mixedlub.importers import write_case
from mixedlub.own_laws import read_law
from mixedlub.schema.findings import collected


@pytest.fixture(scope="module")
def powers(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory
) -> Diagnosis:
    """A gear rig whose loss follows other powers of torque and speed: (T/100)^-0.3 (n/1500)^0.4 times the base."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base * (conditions["torque_Nm"] / 100.0) ** -0.3 * (conditions["speed_rpm"] / 1500.0) ** 0.4

    return diagnose_case(make_case(tmp_path_factory.mktemp("powers"), "gear_pair", change), exclude=excluded)


def test_the_planted_exponents_are_found(powers: Diagnosis) -> None:
    law = Answer(powers).record["law"]
    assert powers.posterior.verdict.is_discrepancy
    assert law["form"] == "factor"
    assert law["acts_on"] in ("reading", "friction")
    found = dict(zip(("speed_rpm", "torque_Nm"), (0.4, -0.3), strict=True))
    first = law["expression"].partition("*")[0]
    order = ("speed_rpm", "torque_Nm") if "speed_rpm" in first else ("torque_Nm", "speed_rpm")
    for name, p in zip(order, law["parameters"], strict=True):
        width = p["high90"] - p["low90"]
        assert p["low90"] - width < found[name] < p["high90"] + width
        assert width < 0.1
    assert law["heldout_after"] < 1.3 < 10.0 < law["heldout_before"]
    assert law["empirical"] is True


def test_laws_that_cannot_be_told_apart_are_listed(powers: Diagnosis) -> None:
    law = Answer(powers).record["law"]
    alike = {rival["acts_on"] for rival in law["rivals"] if rival["equivalent"]}
    assert {law["acts_on"], *alike} >= {"reading", "friction"}
    assert all(rival["log_evidence_behind"] < 30.0 for rival in law["rivals"])
    assert "cannot tell it from" in str(Answer(powers))


def test_the_improved_model_has_the_law_as_a_file(powers: Diagnosis, tmp_path: Path) -> None:
    assert powers.handed_on == "law"
    write(case_files(Answer(powers).improved), tmp_path / "improved")
    law = read_law(tmp_path / "improved" / "law.toml", ["torque_Nm", "speed_rpm"])
    assert law.acts_on[0] in ("reading", "friction")
    case = read_case(tmp_path / "improved")
    predicted = Answer(powers).predictions["predicted"].to_numpy()
    with collected():
        assert simulate(case)[case.quantity].to_numpy() == pytest.approx(predicted, rel=1e-9)


def test_outside_its_range_the_law_says_so(powers: Diagnosis) -> None:
    case = Answer(powers).improved
    row = {n: v[:1] for n, v in powers.search.problem.rows.columns.items() if n not in ("run", powers.case.quantity)}
    at = {n: np.repeat(v, 2) for n, v in row.items()} | {"speed_rpm": np.array([1200.0, 9000.0])}
    with collected():
        validity = simulate(case, conditions_for(case, at))["validity"].tolist()
    assert ["found_law" in words for words in validity] == [False, True]


def test_a_resonance_is_found_that_the_smooth_discrepancy_cannot_predict(unnamed: Diagnosis) -> None:
    law = Answer(unnamed).record["law"]
    assert unnamed.heldout.after > unnamed.heldout.before
    assert law["heldout_after"] < 0.3 * law["heldout_before"]
    place = next(p for p in law["parameters"] if p["name"] == "b")
    assert place["value"] == pytest.approx(1500.0, rel=0.1)  # of a bell over the logarithm
    assert Answer(unnamed).record["improved"]["model"] == "law"


def test_an_effect_that_predicts_worse_than_calibration_is_not_handed_on(offset: Diagnosis) -> None:
    assert offset.handed_on == "effects"
    worse = replace(offset, heldout=replace(offset.heldout, after=1.2 * offset.heldout.before))
    assert worse.handed_on == "calibration"
    found = Answer(worse).predictions
    assert found["predicted"].to_numpy() == pytest.approx(found["calibrated"].to_numpy(), rel=1e-12)
    assert not Answer(worse).improved.system.effects
    rows, y = offset.search.problem.rows, offset.readings
    named, wrong = offset.posterior.verdict, np.zeros(y.size, bool)
    said = answer_warnings(named, worse.heldout, rows, y, y, wrong)
    assert said[0].code == "answer_not_handed_on"
    assert not answer_warnings(named, offset.heldout, rows, y, y, wrong)


def test_where_nothing_is_missing_or_an_effect_has_a_name_no_law_is_sought(
    complete: Diagnosis, offset: Diagnosis
) -> None:
    assert Answer(complete).record["law"] is None
    assert Answer(offset).record["law"] is None


def test_without_a_law_the_answer_says_so(unnamed: Diagnosis) -> None:
    bare = replace(unnamed, law=None)
    assert Answer(bare).record["law"] is None
    assert "No law acting in the model was found" in " ".join(str(Answer(bare)).split())


@pytest.mark.parametrize(
    ("after", "score", "law"), [(1.1, -60.0, True), (1.1, -72.0, True), (1.1, -73.5, False), (3.0, -60.0, False)]
)
def test_a_law_that_follows_a_part_of_the_mismatch_is_none(after: float, score: float, law: bool) -> None:
    """Left-out levels have the log probability -65 under the discrepancy: odds of 3000 against the law are too many."""
    kept = HeldOut(3.5, after, "leave one level of load_N out", 8, 60, score, -300.0)
    assert _is_law(kept, -65.0) is law


@pytest.mark.parametrize(
    ("before", "after", "holds"), [(8.8, 1.02, True), (4.4, 2.2, True), (8.8, 6.6, False), (1.05, 1.04, True)]
)
def test_a_law_must_explain_most_along_each_condition_that_it_reads(
    powers: Diagnosis, monkeypatch: pytest.MonkeyPatch, before: float, after: float, holds: bool
) -> None:
    """A peak at one of five baths explains every reading, but leaves 6.6 of 8.8 sd if its bath is left out."""
    held: list[str] = []

    def left_out(search: Search, name: str) -> SimpleNamespace:
        held.append(name)
        kept = HeldOut(before, after, f"leave one level of {name} out", 5, 60, -60.0, -300.0)
        return SimpleNamespace(name=name, held=lambda *given: kept)

    monkeypatch.setattr(laws.LevelsOut, "of", left_out)
    monkeypatch.setattr(laws, "_levels_with", lambda levels, *given: levels)
    fit = SimpleNamespace(explanation=None, residual=np.zeros(3))
    one = SimpleNamespace(fit=fit, candidate=powers.law.candidate)
    assert laws._holds_along_its_conditions(one, powers.search, "torque_Nm", powers.search.problem, {}) is holds
    assert held == ["speed_rpm"]


def test_a_law_of_a_drive_reads_the_size_of_its_signed_speed(tmp_path: Path) -> None:
    """A fifth of the friction vanishes above 500 rpm, in both directions."""
    half = np.geomspace(60.0, 1500.0, 18).round(0)
    speed = np.tile(np.concatenate([half, -half]), 2)
    friction = np.sign(speed) * (0.2 + 0.0001 * np.abs(speed) - 0.04 * (np.abs(speed) > 500.0))
    noise = {"absolute": 0.002, "relative": 0.0}
    settings = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": noise}}
    read = friction + np.random.default_rng(2).normal(0.0, 0.002, speed.size)
    write_case(tmp_path / "drive", settings, {"speed_rpm": speed, "friction_torque_Nm": read})
    d = diagnose_case(tmp_path / "drive")
    assert d.posterior.verdict.is_discrepancy
    law = Answer(d).record["law"]
    assert "abs(speed_rpm)" in law["expression"]
    assert law["range"] == {"speed_rpm": [-1500.0, 1500.0]}
    assert law["heldout_after"] < 0.5 * law["heldout_before"]
    at = {"speed_rpm": np.array([800.0, 3000.0])}
    with collected():
        validity = simulate(Answer(d).improved, conditions_for(Answer(d).improved, at))["validity"].tolist()
    assert [words == "valid" for words in validity] == [True, False]
