"""The fast evidence against nested sampling, and the mismatch test's false alarms, on the proof's own rigs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mixedlub.case import read_case
from mixedlub.diagnosis.fitting.fit import map_fit
from mixedlub.diagnosis.fitting.problem import Problem
from mixedlub.diagnosis.fitting.reference import nested_evidence
from mixedlub.diagnosis.fitting.search import search
from mixedlub.diagnosis.judging.mismatch import mismatch_test
from mixedlub.diagnosis.recording.features import coordinates
from mixedlub.effect import catalogue
from mixedlub.forward import Forward
from mixedlub.proof.battery import generate

KEPT = ("inlet_shear_heating", "churning", "starvation", "sensor_offset", "sensor_gain", "surface_defects")


def problem_of(folder: Path) -> Problem:
    case = read_case(folder)
    rows = case.recordings
    assert rows is not None
    y = np.asarray(rows[case.quantity], dtype=float)
    return Problem.of(case, rows, Forward(case, rows), y)


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> list[Problem]:
    """A few rigs of the independent generator."""
    return [problem_of(folder) for folder in generate(tmp_path_factory.mktemp("rigs"), seed=31, cases=5, jobs=1)]


@pytest.mark.parametrize("explanation", [(), ("sensor_gain",), ("inlet_shear_heating",)])
def test_fast_evidence_agrees_with_nested_sampling(problems: list[Problem], explanation: tuple[str, ...]) -> None:
    pytest.importorskip("dynesty")
    p = problems[0]
    fit = map_fit(p, explanation, np.zeros(p.size(explanation)))
    slow = nested_evidence(p, explanation, points=100)
    assert fit.evidence == pytest.approx(slow.value, abs=3.0 * slow.error + 0.5)


def test_false_alarms_stay_at_the_stated_level(problems: list[Problem]) -> None:
    others = [name for name in catalogue() if name not in KEPT]
    alarms, trials = 0, 0
    for p in problems:
        space = coordinates(p.case, p.rows, p.forward)
        values = space.values(p.case, p.rows, p.forward)
        truth = p.predict((), np.linspace(-1.0, 1.0, p.calibration_size))
        for seed in range(5):
            y = truth + p.with_sd(truth, truth).sd * np.random.default_rng(seed).standard_normal(truth.size)
            drawn = Problem(p.case, p.rows, p.forward, y, p.with_sd(truth, truth).sd, p.shared)
            alarms += mismatch_test(search(drawn, space, values, others), 0.05).detected
            trials += 1
    assert alarms <= 4, f"{alarms} of {trials} at level 0.05"
