"""Noise that is not as stated, or not stated: what is said of it, and that it is not taken for physics."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.search.noise_inflation import best_inflation
from mixedlub.diagnosis.settings.search import INFLATION_GAIN
from mixedlub.importers import write_case
from mixedlub.schema.findings import Finding, codes

from ..kinds.conftest import BALL

Make = Callable[..., Path]
TRUE = "noise = { relative = 0.02, absolute = 0.0002 }"


def heated(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
    """A channel that reads a half too much: a mismatch beyond any doubt."""
    return 1.5 * base


def restated(folder: Path, line: str) -> Path:
    """The case with another statement of its noise."""
    system = folder / "system.toml"
    text = system.read_text(encoding="utf-8")
    assert TRUE in text
    system.write_text(text.replace(TRUE, line), encoding="utf-8")
    return folder


def told(d: Diagnosis) -> list[Finding]:
    return [note for note in d.warnings if note.code.startswith("scatter_")]


@pytest.fixture
def half(make_case: Make, tmp_path: Path) -> Callable[..., Path]:
    """A disc rig that states half the noise it has."""

    def make(*change: object) -> Path:
        return restated(make_case(tmp_path / "case", "disc", *change), "noise = { relative = 0.01, absolute = 0.0001 }")

    return make


def test_noise_as_stated_is_believed(complete: Diagnosis) -> None:
    assert told(complete) == []
    assert complete.case.system.recording.noise is not None
    assert complete.case.system.recording.noise.relative == 0.02


def test_scatter_beyond_what_is_stated_is_no_mismatch(half: Callable[..., Path], excluded: tuple[str, ...]) -> None:
    d = diagnose_case(half(), exclude=excluded)
    (note,) = told(d)
    times = float(note.text.split("about ")[1].split(" times")[0])
    assert times == pytest.approx(2.0, rel=0.25)
    assert d.posterior.verdict == NOTHING
    assert not d.test.detected


@pytest.mark.long
def test_an_effect_stays_visible_through_it(half: Callable[..., Path], excluded: tuple[str, ...]) -> None:
    d = diagnose_case(half(heated), exclude=excluded)
    assert len(told(d)) == 1
    assert d.posterior.verdict == Explanation.of("sensor_gain")


@pytest.mark.long
def test_sds_of_the_readings_are_raised_likewise(make_case: Make, tmp_path: Path, excluded: tuple[str, ...]) -> None:
    folder = make_case(tmp_path / "case", "disc")
    path = folder / "recordings.csv"
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    rows = [[*rows[0], "friction_coefficient_sd"], *([*row, str(0.01 * float(row[-1]))] for row in rows[1:])]
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)
    d = diagnose_case(folder, exclude=excluded)
    assert len(told(d)) == 1
    assert d.posterior.verdict == NOTHING


def test_noise_that_nobody_states_is_found_under_an_effect(
    make_case: Make, tmp_path: Path, excluded: tuple[str, ...]
) -> None:
    folder = restated(make_case(tmp_path / "case", "disc", heated), "")
    d = diagnose_case(folder, exclude=excluded)
    assert np.median(d.search.problem.sd / d.readings) == pytest.approx(0.02, rel=0.25)
    assert d.posterior.verdict == Explanation.of("sensor_gain")
    assert "noise_value_estimated" in codes(d.warnings)


def humming(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
    """Beside the noise in proportion one that is alike for all, a twentieth of the median."""
    return base + 0.05 * float(np.median(base)) * np.random.default_rng(4).standard_normal(base.size)


@pytest.mark.long
def test_noise_that_nobody_states_may_have_a_part_alike_for_all(
    make_case: Make, tmp_path: Path, excluded: tuple[str, ...]
) -> None:
    folder = make_case(tmp_path / "case", "gear_pair", humming)
    path = folder / "system.toml"
    text = path.read_text(encoding="utf-8")
    path.write_text("\n".join(line for line in text.splitlines() if not line.startswith("noise")), encoding="utf-8")
    d = diagnose_case(folder, exclude=excluded)
    noise = d.case.system.recording.noise
    assert noise is not None
    assert noise.absolute == pytest.approx(0.05 * float(np.median(d.readings)), rel=0.4)
    assert noise.relative < 0.03
    assert d.posterior.verdict == NOTHING


def test_a_fit_whose_evidence_is_carried_over_raises_no_noise(offset: Diagnosis) -> None:
    """Far behind the best a fit only keeps its distance when the noise is settled anew: its residuals grew since."""
    found = offset.search
    fit = found.fits[Explanation.of("churning")]
    wild = replace(found, fits={**found.fits, Explanation.of("churning"): replace(fit, residual=20.0 * fit.residual)})
    assert best_inflation(found)[0] < INFLATION_GAIN
    assert best_inflation(wild)[0] < INFLATION_GAIN


@pytest.mark.long
def test_repeats_bound_the_noise_of_very_many_readings(
    make_case: Make, tmp_path: Path, excluded: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A spread of very many readings holds hardly a repeat of any: the bound is that of all."""
    folder = make_case(tmp_path / "case", "disc")
    path = folder / "recordings.csv"
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    rng = np.random.default_rng(7)
    wild = np.repeat(1.0 + 0.3 * rng.standard_normal(len(rows) - 1), 4)
    body = [row for row in rows[1:] for _ in range(4)]
    lines = [
        [str(i + 1), *row[1:-1], f"{float(row[-1]) * wild[i] * (1.0 + 0.02 * rng.standard_normal()):.9g}"]
        for i, row in enumerate(body)
    ]
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([rows[0], *lines])
    monkeypatch.setattr("mixedlub.diagnosis.search.noise_selection.MANY", 40)
    monkeypatch.setattr("mixedlub.diagnosis.search.search.MANY", 40)
    monkeypatch.setattr("mixedlub.diagnosis.search.search.SUBSET", 30)
    d = diagnose_case(folder, exclude=excluded)
    assert told(d) == []


@pytest.mark.long
def test_sds_of_one_setting_leave_out_a_share_of_the_reading(tmp_path: Path) -> None:
    """Films that scatter by 2 % between settings, with a column of sds of 1 to 2 nm: nothing is missing."""
    rng = np.random.default_rng(11)
    speed = np.geomspace(0.01, 2.0, 24)
    film = 420.0 * speed**0.67
    recorded = film * (1.0 + 0.02 * rng.standard_normal(24)) + 0.5 * rng.standard_normal(24)
    columns = {
        "entrainment_speed_m_s": speed,
        "load_N": np.full(24, 20.0),
        "slide_roll_ratio": np.zeros(24),
        "oil_temperature_C": np.full(24, 40.0),
        "film_thickness_nm": recorded,
        "film_thickness_nm_sd": rng.uniform(0.8, 2.0, 24),
    }
    sections = {"kind": "film", "contact": BALL, "recording": {"quantity": "film_thickness_nm"}}
    d = diagnose_case(write_case(tmp_path / "films", sections, columns))
    assert d.posterior.verdict == NOTHING
    assert "scatter_above_stated" in codes(d.warnings)
    assert d.search.problem.single_sd[-1] == pytest.approx(0.02 * recorded[-1], rel=0.6)


@pytest.mark.long
def test_noise_of_very_many_readings_is_estimated_though_a_share_of_them_is_looked_at(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mixedlub.diagnosis.search.noise_selection.MANY", 250)
    monkeypatch.setattr("mixedlub.diagnosis.search.search.MANY", 250)
    monkeypatch.setattr("mixedlub.diagnosis.search.search.SUBSET", 130)
    passed = np.linspace(0.0, 1.0, 300)
    friction = 0.1 * (1.0 - 0.3 * (1.0 - np.exp(-4.0 * passed)) + 0.15 * (passed > 0.6))
    friction *= 1.0 + 0.01 * np.random.default_rng(3).standard_normal(300)
    columns = {"time_s": 3600.0 * passed, "friction_coefficient": friction}
    system = {"kind": "friction_history", "recording": {"quantity": "friction_coefficient"}}
    d = diagnose_case(write_case(tmp_path / "case", system, columns))
    assert float(np.median(d.transformed_sd / d.recorded.predicted)) == pytest.approx(0.01, rel=0.15)
    assert d.test.detected


@pytest.mark.parametrize(
    ("scatter", "code", "verdict"),
    [
        pytest.param(0.01, "noise_value_estimated", "none", marks=pytest.mark.long),
        pytest.param(0.15, "noise_estimate_large", "none", marks=pytest.mark.long),
        (0.35, "scatter_unexplained", "unknown"),
    ],
)
def test_estimated_noise_that_no_rig_has_conceals_something(
    tmp_path: Path, scatter: float, code: str, verdict: str
) -> None:
    friction = 0.1 * np.exp(scatter * np.random.default_rng(4).standard_normal(40))
    columns = {"time_s": np.arange(40.0), "friction_coefficient": friction}
    system = {"kind": "friction_history", "recording": {"quantity": "friction_coefficient"}}
    d = diagnose_case(write_case(tmp_path / "case", system, columns))
    told = {"noise_value_estimated", "noise_estimate_large", "scatter_unexplained"}
    assert told & set(codes(d.warnings)) == {code}
    assert d.posterior.verdict.ids == (verdict,)
