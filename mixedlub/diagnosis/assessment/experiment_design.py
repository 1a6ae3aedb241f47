"""Experiment design: conditions of the reading that best separates the remaining explanations."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import NewRows, Prediction, Refined, refine
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    BEYOND_LOWEST,
    BEYOND_SPAN,
    HERMITE_NODES,
    INNER_QUANTILES,
    MOST_CONDITIONS,
    MOST_RIVALS,
    RIVAL_WEIGHT,
    SMALLEST_WEIGHT,
    TEST_LEVELS,
    TESTS,
    TESTS_APART,
    WORTH_TESTING,
)
from mixedlub.diagnosis.settings.inference import SEED
from mixedlub.recording.conditions import noisy_set_point
from mixedlub.recording.set_points import roundest, set_points
from mixedlub.schema.table import Column, Table


@dataclass(frozen=True)
class NextTest:
    """Conditions to run, explanations they separate, and expected information."""

    conditions: dict[str, float | str]
    separates: tuple[str, ...]
    expected_bits: float


def next_tests(
    search: Search, judged: Posterior, refined: dict[Explanation, Refined], columns: list[Column], varied: list[str]
) -> tuple[NextTest, ...]:
    """Tests with the most expected information; with one explanation left, against the runner-up."""
    keys = [k for k in refined if judged.weights[k] > WORTH_TESTING]
    if len(keys) < 2:
        runner = next((k for k in judged.weights if k not in keys and k in search.fits), None)
        if runner is None:
            return ()
        refined = {**refined, runner: refine(search, search.fits[runner])}
        keys = [*keys, runner]
    keys = keys[:MOST_RIVALS]
    case = search.problem.case
    table = candidates(search.problem.rows, columns, case.kind.column_limits(case.system), varied)
    rows = NewRows(search, table)
    predictions = [rows.of_fit(refined[k]) for k in keys]
    weights = np.array([judged.weights[k] for k in keys])
    finite = np.isfinite(np.array([p.mean + p.variance for p in predictions])).all(axis=0)
    # Improbable rivals count in the choice of a test, not in its stated information.
    worth = np.where(finite, expected_bits(np.maximum(weights, RIVAL_WEIGHT), predictions, rows.sd), 0.0)
    bits = np.where(finite, expected_bits(weights, predictions, rows.sd), 0.0)
    chosen: list[NextTest] = []
    for i in np.argsort(worth)[::-1]:
        values = {c.name: table[c.name][i] for c in columns}
        conditions: dict[str, float | str] = {
            name: str(x) if isinstance(x, str) else float(f"{x:.6g}") for name, x in values.items()
        }
        if all(_apart(conditions, t.conditions) for t in chosen):
            names = tuple("+".join(k.ids) for k in keys)
            chosen.append(NextTest(conditions, names, float(bits[i])))
        if len(chosen) == TESTS:
            break
    return tuple(chosen)


def _apart(a: dict[str, Any], b: dict[str, Any]) -> bool:
    """Whether two tests differ in at least two conditions."""
    return sum(a[name] != b[name] for name in a) >= TESTS_APART


def candidates(
    table: Table,
    conditions: list[Column],
    limits: Mapping[str, tuple[float, float]] | None = None,
    varied: Collection[str] | None = None,
) -> Table:
    """Grid over the recorded levels and a little beyond, thinned to a few hundred conditions.

    It stays within the bounds of the columns and the ``limits`` of the rig. Conditions that jitter at a set point, or
    are not among ``varied`` (if given), keep their value.

    >>> share = Column("slide_roll_ratio", at_least=0.0, at_most=2.0)
    >>> candidates(Table({"slide_roll_ratio": np.array([0.5, 1.9])}, ""), [share])["slide_roll_ratio"].round(9).tolist()
    [0.3, 0.5, 1.9]
    """
    axes: list[np.ndarray] = []
    for condition in conditions:
        levels = np.unique(set_points(table[condition.name]))
        at = noisy_set_point(condition.name, table[condition.name])
        if at is not None:
            levels = np.array([at])
        elif varied is not None and condition.name not in varied and levels.dtype.kind not in "US":
            levels = np.array([roundest(float(levels[0]), float(levels[-1]))])
        if levels.dtype.kind not in "US" and levels.size > 1:
            low, high = float(levels[0]), float(levels[-1])
            wide = BEYOND_SPAN * (high - low)
            lowest, highest = (limits or {}).get(condition.name, (-np.inf, np.inf))
            beyond = [low - wide if low < 0 else max(low - wide, BEYOND_LOWEST * low), high + wide]
            inner = levels if levels.size <= len(INNER_QUANTILES) else np.quantile(levels, INNER_QUANTILES)
            levels = np.unique(
                np.concatenate([inner, [x for x in beyond if condition.allows(x) and lowest <= x <= highest]])
            )
        if levels.size > TEST_LEVELS:
            levels = levels[np.linspace(0, levels.size - 1, TEST_LEVELS).astype(int)]
        axes.append(levels)
    grid = list(product(*axes))
    if len(grid) > MOST_CONDITIONS:
        # At random: every so many would go round with the levels of a condition, and miss some of them.
        kept = np.random.default_rng(SEED).choice(len(grid), MOST_CONDITIONS, replace=False)
        grid = [grid[i] for i in np.sort(kept)]
    columns = {condition.name: np.array([row[i] for row in grid]) for i, condition in enumerate(conditions)}
    columns["run"] = np.arange(1, len(grid) + 1)
    if "sequence" in table:
        columns["sequence"] = np.ones(len(grid))
    return Table(columns, "next tests")


def expected_bits(weights: np.ndarray, predictions: list[Prediction], sd: np.ndarray) -> np.ndarray:
    """Mutual information of one reading with the explanation, in bits, for every candidate.

    >>> near = Prediction(np.zeros(1), np.zeros(1), np.zeros(1))
    >>> far = Prediction(np.full(1, 50.0), np.zeros(1), np.zeros(1))
    >>> expected_bits(np.array([0.5, 0.5]), [near, far], np.ones(1)).round(3).tolist()
    [1.0]
    """
    share = np.maximum(weights, SMALLEST_WEIGHT)
    share = share / share.sum()
    mean = np.array([p.mean for p in predictions])
    spread = np.sqrt(np.array([p.variance for p in predictions]) + sd**2)
    node, mass = np.polynomial.hermite_e.hermegauss(HERMITE_NODES)
    mass = mass / mass.sum()
    gain = np.zeros(mean.shape[1])
    for m in range(len(share)):
        y = mean[m] + spread[m] * node[:, None]
        log = -0.5 * ((y[None] - mean[:, None]) / spread[:, None]) ** 2 - np.log(spread)[:, None]
        mixed = np.logaddexp.reduce(log + np.log(share)[:, None, None], axis=0)
        gain += share[m] * (mass[:, None] * (log[m] - mixed)).sum(axis=0)
    return np.maximum(gain, 0.0) / np.log(2.0)
