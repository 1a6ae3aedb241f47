"""Simulation-based calibration: rigs drawn from the prior of the diagnosis have its probabilities and intervals.

Explanation, calibration, parameters, errors of the laws and noise are drawn from their priors, and the search weighs
the readings. Probabilities are then shares of right answers, and true values have uniform ranks.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import kstest, norm

from mixedlub.case.folder import read_case
from mixedlub.diagnosis.assessment.prediction import refine
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.law_error import BaseError, form_error_columns, n_inexact, rms
from mixedlub.diagnosis.search.prior_odds import PriorOdds
from mixedlub.diagnosis.search.search import search
from mixedlub.diagnosis.settings.inference import MOST_COORDINATE, OUTLIER_SHARE, OUTLIER_WIDTH
from mixedlub.diagnosis.settings.law_error import BASE_ERRORS, FORM_ERRORS
from mixedlub.effects import catalogue
from mixedlub.recording.conditions import coordinates
from mixedlub.validation.battery import make, plan

DRAWS, SEED = 200, 77
OFFERED = {
    "inlet_shear_heating",
    "churning",
    "starvation",
    "sensor_offset",
    "sensor_gain",
    "surface_defects",
    "limiting_shear_stress",
    "windage",
}
OTHERS = [name for name in catalogue() if name not in OFFERED]
BINS = (0.0, 0.02, 0.1, 0.3, 0.7, 0.95, 1.0)
WITHIN = 2.6
"""Standard deviations of the number of right answers in a bin: exceeded by chance once in a hundred."""


@dataclass(frozen=True)
class Drawn:
    """A drawn rig as weighed: probabilities of ids, the true ids, and ranks of the true coordinates."""

    chances: dict[str, float]
    true: frozenset[str]
    ranks: np.ndarray
    log_chance: float
    expected: float


def chosen(rng: np.random.Generator, table: tuple[tuple[float, float], ...]) -> float:
    """A size by its prior probability."""
    return table[rng.choice(len(table), p=[share for _, share in table])][0]


def standard_noise(rng: np.random.Generator, count: int) -> np.ndarray:
    """Normal noise with rare wide errors, as the likelihood has it."""
    wide = rng.random(count) < OUTLIER_SHARE
    return np.where(wide, OUTLIER_WIDTH * rng.standard_cauchy(count), rng.standard_normal(count))


def explanation(rng: np.random.Generator, odds: PriorOdds) -> Explanation:
    """Nothing missing, one effect or two, by their prior odds."""
    every = [NOTHING, *(Explanation.of(name) for name in odds.ids)]
    every += [Explanation.of(*two) for two in combinations(odds.ids, 2)]
    weights = np.exp([odds.log(one) for one in every])
    return every[rng.choice(len(every), p=weights / weights.sum())]


def weighed(problem: Problem, seed: int) -> Drawn:
    """A rig drawn on the rows of a problem, and its probabilities without the discrepancy."""
    rng = np.random.default_rng([SEED, seed])
    truth = explanation(rng, PriorOdds.of([e.id for e in problem.forward.effects(OTHERS)]))
    z = np.clip(rng.standard_normal(problem.size(truth)), -MOST_COORDINATE, MOST_COORDINATE)
    calibration = z[: problem.calibration_size]
    base, exact = problem.predict(NOTHING, calibration), problem.predict(truth, z)
    problem = problem.with_sd(exact, base)
    space = coordinates(problem.forward)
    values = space.values(problem.forward)
    at = SimpleNamespace(z=calibration)
    columns = BaseError.of(problem, at, space, values).columns(problem, at, space, values)  # type: ignore[arg-type]
    sigmas = chosen(rng, BASE_ERRORS) * columns @ rng.standard_normal(columns.shape[1])
    if n_inexact(problem, truth):
        net = (exact - base) / problem.sd
        bent = form_error_columns(net, rms(net), space, values)
        sigmas += chosen(rng, FORM_ERRORS) * bent @ rng.standard_normal(bent.shape[1])
    sigmas += problem.shared @ rng.standard_normal(problem.shared.shape[1]) + standard_noise(rng, exact.size)
    found = search(replace(problem, y=exact + problem.sd * sigmas), space, values, OTHERS)
    logs = {key: log for key, log in found.log_weights.items() if not key.is_discrepancy}
    total = float(np.logaddexp.reduce(list(logs.values())))
    share = {key: float(np.exp(log - total)) for key, log in logs.items()}
    chances = dict.fromkeys([*(s.id for s in found.draws), "none"], 0.0)
    for key, own in share.items():
        for name in key.ids:
            chances[name] += own
    fitted = refine(found, found.fits[truth])
    return Drawn(
        chances,
        frozenset(truth.ids),
        norm.cdf((z - fitted.z) / fitted.spread),
        float(np.log(share[truth])),
        float(sum(own * np.log(max(own, 1e-300)) for own in share.values())),
    )


@pytest.fixture(scope="module")
def draws(tmp_path_factory: pytest.TempPathFactory) -> list[Drawn]:
    """Rigs on the programmes of three gear pairs of the independent generator."""
    folder, orders = tmp_path_factory.mktemp("rigs"), plan(31, 5)[:3]
    problems = [Problem.of(read_case(folder / make(31, i, order, folder))) for i, order in enumerate(orders)]
    problems = [p.take(np.arange(p.y.size) % 2 == 0) for p in problems]
    return [weighed(problems[i % len(problems)], i) for i in range(DRAWS)]


@pytest.mark.long
@pytest.mark.parametrize(("low", "high"), list(pairwise(BINS)))
def test_probabilities_are_shares_of_right_answers(draws: list[Drawn], low: float, high: float) -> None:
    every = [(p, name in one.true) for one in draws for name, p in one.chances.items()]
    chance, true = np.array([pair for pair in every if low <= pair[0] < high or pair[0] == high == 1.0]).T
    spread = np.sqrt(np.sum(chance * (1.0 - chance)))
    assert abs(true.sum() - chance.sum()) <= WITHIN * spread + 1.0


@pytest.mark.long
def test_true_coordinates_have_uniform_ranks_and_lie_in_their_intervals(draws: list[Drawn]) -> None:
    ranks = np.concatenate([one.ranks for one in draws])
    assert kstest(ranks, "uniform").pvalue > 0.01
    assert 0.85 < float(np.mean((ranks > 0.05) & (ranks < 0.95))) < 0.95


@pytest.mark.long
def test_the_truth_is_as_probable_as_the_probabilities_say(draws: list[Drawn]) -> None:
    surplus = np.array([one.log_chance - one.expected for one in draws])
    assert abs(surplus.mean()) < WITHIN * surplus.std() / np.sqrt(surplus.size)
