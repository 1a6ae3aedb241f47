"""Intervals beyond the recorded range: a smooth function loses what it knew, and laws that agreed differ."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import conditions_for
from mixedlub.diagnosis.assessment.model_averaging import averaged, ends_of_mixture, with_noise_about
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.discrepancy.smooth import DiscrepancyForm
from mixedlub.diagnosis.explanation import DISCREPANCY
from mixedlub.recording.conditions import Coordinate, Coordinates

NODES = np.linspace(0.0, 1.0, 12)
SPACE = Coordinates(tuple(Coordinate(name, NODES) for name in ("load_N", "speed_rpm")))
RECORDED = [np.tile(NODES, 12), np.repeat(NODES, 12)]


def test_a_smooth_function_is_as_uncertain_as_an_exact_gaussian_process() -> None:
    form = DiscrepancyForm((), 0.08, 3.0, "reading", False)
    at = [np.array([NODES[3], 1.04, 1.08, 9.0, 9.0]), np.array([0.0, 0.0, 0.0, 0.0, -9.0])]
    faded = form.faded(SPACE, RECORDED, at, {"reading": np.full(5, 2.0)})
    within = np.exp(-0.5 * ((NODES[:, None] - NODES) / 0.08) ** 2)
    there = np.exp(-0.5 * ((at[0][1:3, None] - NODES) / 0.08) ** 2)
    # The function of the load is half of the variance of 36; the other half is known at a recorded speed.
    exact = 18.0 * (1.0 - np.einsum("ij,ji->i", there, np.linalg.solve(within, there.T)))
    assert faded == pytest.approx([0.0, *exact, 18.0, 36.0], rel=2e-3, abs=1e-3)


def test_products_of_two_conditions_have_their_prior_variance_far_from_the_readings() -> None:
    form = DiscrepancyForm((), 0.7, 3.0, "reading", True)
    at, scalings = [np.array([0.4, 9.0]), np.array([0.7, -9.0])], {"reading": np.full(2, 2.0)}
    faded = form.faded(SPACE, RECORDED, at, scalings)
    held = (form.columns(SPACE, at, scalings) ** 2).sum(axis=1)
    assert faded[0] == 0.0
    assert held[1] + faded[1] == pytest.approx(36.0, rel=0.01)


def test_peaks_and_steps_do_not_fade() -> None:
    step = DiscrepancyForm(("load_N",), 0.0, 3.0, "reading", False, at=0.5)
    assert step.faded(SPACE, RECORDED, [np.full(1, 9.0)] * 2, {"reading": np.ones(1)}).tolist() == [0.0]


def test_the_interval_of_an_average_leaves_five_percent_on_either_side() -> None:
    share, means = np.array([[0.5], [0.5]]), np.array([[0.0], [10.0]])
    low, high = ends_of_mixture(share, means, np.ones((2, 2, 1)))
    assert [low[0], high[0]] == pytest.approx([-1.2816, 11.2816], abs=1e-3)
    # A part of one percent, however wide, moves the ends no farther than to 4.5 %.
    share, sds = np.array([[0.99], [0.01]]), np.array([[[1.0], [1.0]], [[1e6], [1e6]]])
    low, high = ends_of_mixture(share, np.zeros((2, 1)), sds)
    assert [low[0], high[0]] == pytest.approx([-1.691, 1.691], abs=2e-3)


def test_a_prediction_outside_the_quantiles_has_the_noise_on_both_sides() -> None:
    share, means = np.array([[0.96], [0.04]]), np.array([[0.0], [100.0]])
    low, high = ends_of_mixture(share, means, np.ones((2, 2, 1)))
    assert high[0] < 4.0  # the mean
    low, high = with_noise_about((share * means).sum(axis=0), np.ones(1), low, high)
    assert [low[0], high[0]] == pytest.approx([-1.6250, 5.6449], abs=1e-3)  # quantile of 0.05/0.96


def test_a_verdict_of_little_weight_is_averaged_too(offset: Diagnosis) -> None:
    d, named = offset, offset.posterior.verdict
    weights = {**dict.fromkeys(d.refined, 0.0), named: 1e-3, DISCREPANCY: 0.999}
    found = averaged(d.search, Posterior(weights, named, (named,)), d.refined, d.search.problem.rows)
    assert np.isfinite(found.predicted).all()


@pytest.fixture(scope="module")
def steep(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory
) -> Diagnosis:
    """A gear rig whose loss grows as exp(0.2 (n/2500)^3)."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base * np.exp(0.2 * (conditions["speed_rpm"] / 2500.0) ** 3)

    return diagnose_case(make_case(tmp_path_factory.mktemp("steep"), "gear_pair", change), exclude=excluded)


@pytest.mark.long
def test_beyond_its_range_a_law_is_one_of_several(steep: Diagnosis) -> None:
    law = steep.law
    assert law is not None
    assert steep.handed_on == "law"
    assert sum(law.weights.values()) == pytest.approx(1.0)
    alike = sum(rival.equivalent and rival.heldout is not None for rival in law.rivals)
    assert 2 <= len(law.weights) <= 2 + alike
    assert (
        0.0
        < law.weights[DISCREPANCY]
        < 0.5
        < law.weights[DISCREPANCY] + sum(share for key, share in law.weights.items() if key != DISCREPANCY)
    )
    rows = steep.search.problem.rows
    row = {n: v[:1] for n, v in rows.columns.items() if n not in ("run", steep.case.quantity)}
    at = {n: np.repeat(v, 2) for n, v in row.items()} | {"speed_rpm": np.array([2500.0, 3200.0])}
    p = averaged(steep.search, steep.posterior, steep.refined, conditions_for(steep.given, at))
    handed = steep.handed(p)
    planted = p.base * np.exp(0.2 * (at["speed_rpm"] / 2500.0) ** 3)
    assert law.holds(p.table).tolist() == [True, False]
    assert np.all(handed.low90 <= planted)
    assert np.all(planted <= handed.high90)
    assert np.diff(handed.high90 - handed.low90)[0] > 0.0
