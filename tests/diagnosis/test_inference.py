"""The engine: reruns, evidence, outliers, noise, many readings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.case.forward import Run
from mixedlub.case.reference_rigs import case, forward
from mixedlub.diagnosis.assessment.mismatch_test import mismatch_test
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.inference.map_fit import linear_fit, map_fit
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search import search as searching
from mixedlub.diagnosis.search.law_error import BaseError, law_error_evidence
from mixedlub.diagnosis.settings.law_error import BASE_ERRORS
from mixedlub.effects import catalogue
from mixedlub.recording.conditions import coordinates
from mixedlub.recording.noise import noise_from_repeats, noise_from_smoothness
from tests.reference_evidence import importance_evidence

KEPT = ("inlet_shear_heating", "churning", "sensor_offset", "sensor_gain")
OTHERS = [name for name in catalogue() if name not in KEPT]


def problem(kind: str = "gear_pair", seed: int = 1, extra: float = 0.0, relative: float = 0.01) -> Problem:
    """The standard rig with readings of its base model at another calibration, noise, and a loss by hand."""
    model = forward(kind)
    rng = np.random.default_rng(seed)
    base = model.predict({"viscosity": 1.05, "boundary_friction": 0.105})
    speed = model.table["speed_rpm"] if "speed_rpm" in model.table else model.table["entrainment_speed_m_s"]
    added = extra * np.median(base) * (speed / speed.max()) ** 1.7
    sd = relative * base
    y = base + added + sd * rng.standard_normal(base.size)
    return Problem(case(kind), model.table, model, y, sd, np.zeros((base.size, 0)))


@pytest.mark.parametrize("kind", ["gear_pair", "disc"])
def test_a_rerun_near_another_run_is_the_full_run_to_the_last_bit(kind: str) -> None:
    p = problem(kind)
    explanation = Explanation.of("inlet_shear_heating", "sensor_gain")
    z = np.linspace(-0.5, 0.5, p.size(explanation))
    here = p.run(explanation, z)
    for i in range(z.size):
        moved = z.copy()
        moved[i] += 0.3
        assert np.array_equal(p.run(explanation, moved, here).prediction, p.run(explanation, moved).prediction)


def test_evidence_of_a_linear_model_is_the_closed_form() -> None:
    rng = np.random.default_rng(3)
    columns = rng.standard_normal((40, 5)) * 2.0
    target = columns @ rng.standard_normal(5) + rng.standard_normal(40)
    covariance = np.eye(40) + columns @ columns.T
    sign, log_det = np.linalg.slogdet(covariance)
    exact = -0.5 * target @ np.linalg.solve(covariance, target) - 0.5 * log_det
    fit = linear_fit(target, columns)
    chance = 40 * np.log1p(-0.01)
    assert sign > 0
    assert fit.evidence - chance == pytest.approx(exact, abs=0.6)


@pytest.mark.parametrize(
    "explanation", [NOTHING, pytest.param(Explanation.of("churning"), marks=pytest.mark.long)], ids=str
)
def test_fast_evidence_agrees_with_importance_sampling(explanation: Explanation) -> None:
    p = problem(extra=0.05)
    fit = map_fit(p, explanation, np.zeros(p.size(explanation)))
    slow = importance_evidence(p, fit, draws=6000)
    assert slow.effective_share > 0.005
    assert fit.evidence == pytest.approx(slow.value, abs=0.3 + 3.0 * slow.error)


def test_planted_outliers_are_found_and_no_others() -> None:
    p = problem()
    y = p.y.copy()
    y[[4, 17]] += 9.0 * p.sd[[4, 17]]
    fit = map_fit(Problem(p.case, p.rows, p.forward, y, p.sd, p.shared), NOTHING, np.zeros(p.size(NOTHING)))
    assert np.flatnonzero(outlier_chance(fit.residual) > 0.5).tolist() == [4, 17]


def found_in(p: Problem) -> searching.Search:
    """The search with a few effects left in."""
    space = coordinates(p.forward)
    return searching.search(p, space, space.values(p.forward), OTHERS)


def test_nothing_missing_is_not_detected_and_a_loss_is() -> None:
    assert not mismatch_test(found_in(problem(seed=5)), 0.01).detected
    assert mismatch_test(found_in(problem(seed=5, extra=0.05)), 0.01).detected


@pytest.mark.long
def test_very_many_readings_give_the_answer_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    p = problem(extra=0.05)
    all_rows = found_in(p)
    monkeypatch.setattr(searching, "MANY", p.y.size - 1)
    monkeypatch.setattr(searching, "SUBSET", p.y.size // 2)
    thinned = found_in(p)
    assert thinned.screen is not None
    assert thinned.screen.problem.y.size < p.y.size
    best = max(all_rows.scores, key=lambda m: all_rows.scores[m])
    assert max(thinned.scores, key=lambda m: thinned.scores[m]) == best
    assert thinned.fits[best].evidence == pytest.approx(all_rows.fits[best].evidence, abs=0.5)


@pytest.mark.parametrize("count", [450, 601, 1201, 2899, 20500])
def test_a_spread_of_very_many_readings_has_each_once_and_every_level(count: int) -> None:
    levels = np.arange(count) % 4
    rows = searching.spread_rows([np.linspace(0.0, 1.0, count), levels.astype(float)], count, 600)
    assert np.unique(rows).size == min(count, 600)
    assert np.unique(levels[rows]).size == 4


def test_rows_without_a_coating_know_the_effect_of_one() -> None:
    """A level left out may hold all readings on coated flanks, or none."""
    p = problem("disc")
    bare = (p.rows["surface_1"] != "coated") & (p.rows["surface_2"] != "coated")
    explanation = Explanation.of("coating_insulation")
    z = np.zeros(p.size(explanation))
    np.testing.assert_allclose(p.take(bare).predict(explanation, z), p.predict(explanation, z)[bare], rtol=1e-12)
    assert (p.take(~bare).predict(explanation, z) < p.predict(NOTHING, z[:-1])[~bare]).all()


def test_errors_of_laws_are_averaged_as_by_quadrature() -> None:
    """A direction of each size in turn beside the same noise: the sum over sizes, each evidence in full."""
    p = problem("disc")
    space, count = coordinates(p.forward), p.y.size
    fit = map_fit(p, NOTHING, np.zeros(p.size(NOTHING)))
    base = 30.0 * np.ones((count, 1)) / np.sqrt(count)
    found = law_error_evidence(p, fit, fit, space, space.values(p.forward), base)
    fixed = np.hstack([fit.slopes, p.shared])
    plain = linear_fit(fit.anchor, fixed, fit.weight)
    each = [
        linear_fit(fit.anchor, np.hstack([fixed, size * base]), plain.weight).evidence + np.log(share)
        for size, share in BASE_ERRORS
    ]
    assert found - fit.evidence == pytest.approx(np.logaddexp.reduce(each) - plain.evidence, abs=0.02)


def test_a_zero_has_no_form_to_bend() -> None:
    p = problem("disc", extra=0.3)
    space = coordinates(p.forward)
    values = space.values(p.forward)
    zero = Explanation.of("sensor_offset")
    nothing, offset = (map_fit(p, m, np.zeros(p.size(m))) for m in (NOTHING, zero))
    exact = np.zeros((p.y.size, 0))
    assert law_error_evidence(p, nothing, offset, space, values, exact) == pytest.approx(offset.evidence, abs=0.01)


@pytest.mark.parametrize(("error", "low", "high"), [(0.0, -2.0, 0.1), (0.03, 10.0, np.inf)])
def test_a_base_model_wrong_by_a_few_per_cent_is_recognised_and_no_other(error: float, low: float, high: float) -> None:
    p = problem("disc")
    space = coordinates(p.forward)
    values = space.values(p.forward)
    place = [axis.scale(v) for axis, v in zip(space.axes, values, strict=True) if not axis.named][:2]
    wrong = replace(p, y=p.y * (1.0 + error * np.sin(4.0 * place[0] + 1.0) * np.cos(3.0 * place[1])))
    nothing = map_fit(wrong, NOTHING, np.zeros(p.size(NOTHING)))
    base = BaseError.of(wrong, nothing, space, values).columns(wrong, nothing, space, values)
    assert low < law_error_evidence(wrong, nothing, nothing, space, values, base) - nothing.evidence < high


def test_unstated_noise_is_what_repeats_or_smoothness_show() -> None:
    p = problem(relative=0.02)
    space = coordinates(p.forward)
    values = space.values(p.forward)
    level = float(np.sqrt(np.mean(p.sd**2)))
    assert noise_from_smoothness(p.y, p.forward.predict(), space, values) == pytest.approx(level, rel=0.5)
    doubled = p.rows.take(np.repeat(np.arange(len(p.rows)), 2))
    rng = np.random.default_rng(2)
    y = np.repeat(p.y, 2) + 0.5 * rng.standard_normal(2 * p.y.size)
    assert noise_from_repeats(replace(p.case, recordings=doubled), y) == pytest.approx(0.5, rel=0.25)


def test_an_effect_without_any_finite_answer_is_not_considered(monkeypatch: pytest.MonkeyPatch) -> None:
    p = problem()
    run = Problem.run

    def broken(self: Problem, explanation: Explanation, z: np.ndarray, near: Run | None = None) -> Run:
        found = run(self, explanation, z, near)
        return replace(found, prediction=found.prediction * np.nan) if "churning" in explanation.effects else found

    monkeypatch.setattr(Problem, "run", broken)
    found = found_in(p)
    assert "churning" not in [s.id for s in found.draws]
    assert Explanation.of("sensor_gain") in found.fits
