"""Experiment design: the batch of readings that together best separates the remaining explanations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.candidates import conditions_at, inside, outside
from mixedlub.diagnosis.assessment.joint_prediction import Joint, joint_predictions, spread_fits
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import Refined, refine
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    BATCH,
    BEYOND_TESTS,
    CHANCE_OF_SETTLED,
    CHOICE_DRAWS,
    MOST_READINGS,
    MOST_RIVALS,
    OUTSIDE,
    RIVAL_WEIGHT,
    STATED_DRAWS,
    TESTS_APART,
    TIE,
    WORTH_TESTING,
)
from mixedlub.diagnosis.settings.inference import SEED
from mixedlub.recording.readings import rows_of
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Column, Table


@dataclass(frozen=True)
class NextTest:
    """Conditions to run, explanations they separate, and expected information of the batch up to this test.

    ``needs``: what a test beyond the recording asks of the rig.
    """

    conditions: dict[str, float | str]
    separates: tuple[str, ...]
    expected_bits: float
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Batch:
    """Tests to run together, the competing explanations, and what the readings are expected to decide.

    ``readings``: number for a chance of CHANCE_OF_SETTLED that one explanation is left, by repeating the tests if they
    are fewer; None if more than MOST_READINGS. ``chance``: chance after the batch. ``settled``: whether only one is
    left before any test, which the single test of the batch could refute. ``beyond``: single tests beyond the
    recording.
    """

    tests: tuple[NextTest, ...] = ()
    rivals: tuple[tuple[Explanation, float], ...] = ()
    readings: int | None = None
    chance: float = 0.0
    settled: bool = False
    beyond: tuple[NextTest, ...] = ()

    @property
    def expected_bits(self) -> float:
        """Expected joint information of the batch about the explanation, in bits."""
        return self.tests[-1].expected_bits if self.tests else 0.0


@dataclass(frozen=True, eq=False)
class Rivals:
    """Competing explanations with their probabilities, and their fits (None for the discrepancy)."""

    search: Search
    judged: Posterior
    keys: tuple[Explanation, ...]
    fits: tuple[Refined | None, ...]

    @property
    def weights(self) -> np.ndarray:
        """Probabilities of the rivals, which add up to one."""
        share = np.array([max(_inside(self.judged, k), 1e-12) for k in self.keys])
        return np.asarray(share / share.sum())

    def at(self, table: Table) -> list[Joint]:
        """Joint predictions of the rivals at the rows of a table."""
        with collected():
            return joint_predictions(self.search, self.keys, self.fits, table)


def _inside(judged: Posterior, key: Explanation) -> float:
    """Probability of an explanation without the share of causes outside the model space, which predicts no reading."""
    return judged.weights[key] - OUTSIDE * key.is_discrepancy


def rivals_of(search: Search, judged: Posterior, refined: dict[Explanation, Refined]) -> Rivals:
    """Explanations above WORTH_TESTING, unknown among them; with one left, the runner-up too."""
    able = [k for k in judged.weights if k.is_discrepancy or k in search.fits]
    keys = [k for k in able if _inside(judged, k) >= WORTH_TESTING][:MOST_RIVALS]
    keys = keys if len(keys) > 1 else able[:2]
    named = [k for k in keys if not k.is_discrepancy]
    fits = spread_fits(search, [refined[k] if k in refined else refine(search, search.fits[k]) for k in named])
    known = dict(zip(named, fits, strict=True))
    return Rivals(search, judged, tuple(keys), tuple(known.get(k) for k in keys))


def next_batch(
    search: Search, judged: Posterior, refined: dict[Explanation, Refined], columns: list[Column], varied: list[str]
) -> Batch:
    """The batch of tests with the most expected joint information, and single tests beyond the recording."""
    rivals = rivals_of(search, judged, refined)
    settled = len(judged.tied) == 1
    if len(rivals.keys) < 2:
        return Batch(settled=settled)
    case, rows = search.problem.case, rows_of(search.problem.case)
    table = inside(case, rows, columns, varied)
    predictions, usable = _finite(rivals.at(table))
    chosen = chosen_batch(rivals.weights, predictions, usable, 1 if settled else BATCH)
    stated = [rivals.at(table.take(np.array(chosen)))] if chosen else []
    names = tuple("+".join(k.ids) for k in rivals.keys)
    further = outside(case, rows, columns, varied)
    beyond = _beyond(rivals, further, columns, names) if len(further[0]) else ()
    if not stated:
        return Batch(settled=settled, beyond=beyond)
    outcome = played(rivals.weights, _repeated(stated[0], 1 if settled else MOST_READINGS))
    tests = tuple(
        NextTest(conditions_at(table, columns, i), names, float(outcome.bits[place])) for place, i in enumerate(chosen)
    )
    weights = zip(rivals.keys, (judged.weights[k] for k in rivals.keys), strict=True)
    enough = np.flatnonzero(outcome.settled >= CHANCE_OF_SETTLED)
    readings = 0 if settled else int(enough[0]) + 1 if enough.size else None
    return Batch(tests, tuple(weights), readings, float(outcome.settled[len(chosen) - 1]), settled, beyond)


def expected_information(search: Search, judged: Posterior, refined: dict[Explanation, Refined], table: Table) -> float:
    """Expected joint information of readings at the rows of a table about the explanation, in bits."""
    rivals = rivals_of(search, judged, refined)
    if len(rivals.keys) < 2:
        return 0.0
    predictions, usable = _finite(rivals.at(table))
    return float(played(rivals.weights, [p.take(np.flatnonzero(usable).tolist()) for p in predictions]).bits[-1])


def _finite(predictions: Sequence[Joint]) -> tuple[list[Joint], np.ndarray]:
    """Predictions without infinities, and the rows at which all of them were finite."""
    usable = np.all([np.isfinite(p.mean + p.alone + p.shared.sum(axis=1)) for p in predictions], axis=0)
    return [Joint(*(np.nan_to_num(a) for a in (p.mean, p.shared, p.alone))) for p in predictions], usable


def _repeated(predictions: Sequence[Joint], count: int) -> list[Joint]:
    """The batch, repeated up to a number of readings."""
    order = np.resize(np.arange(len(predictions[0].mean)), max(count, len(predictions[0].mean)))
    return [p.take(order.tolist()) for p in predictions]


class _Draws:
    """Readings drawn from each explanation, and their log density under every one, reading after reading.

    Shared uncertainty is conditioned on the readings so far, so that densities multiply up to the joint one.
    """

    def __init__(self, predictions: Sequence[Joint], draws: int) -> None:
        self.predictions, self.draws = predictions, draws
        count = len(predictions)
        self.log = np.zeros((count, count, draws))
        self.spread = [np.eye(p.shared.shape[1]) for p in predictions]
        self.at = [[np.zeros((p.shared.shape[1], draws)) for p in predictions] for _ in predictions]
        self.random = np.random.default_rng(SEED)

    def normal(self) -> np.ndarray:
        """Standard-normal numbers, two of opposite sign each, one row an explanation."""
        half = self.random.standard_normal((len(self.predictions), self.draws // 2))
        return np.hstack([half, -half])

    def variance(self, m: int, rows: np.ndarray) -> np.ndarray:
        """Variance of readings under an explanation, given the readings so far."""
        shared = self.predictions[m].shared[rows]
        return np.asarray(np.einsum("ij,jk,ik->i", shared, self.spread[m], shared) + self.predictions[m].alone[rows])

    def mean(self, drawn_from: int, m: int, rows: np.ndarray) -> np.ndarray:
        """Mean of readings (rows, draws) under an explanation, given the readings drawn so far."""
        one = self.predictions[m]
        return np.asarray(one.mean[rows, None] + one.shared[rows] @ self.at[drawn_from][m])

    def densities(self, drawn_from: int, rows: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Next readings (rows, draws) drawn from one explanation, and their log density under each."""
        y = self.mean(drawn_from, drawn_from, rows)
        y = y + np.sqrt(self.variance(drawn_from, rows))[:, None] * noise[drawn_from]
        logs = []
        for m in range(len(self.predictions)):
            variance = self.variance(m, rows)[:, None]
            logs.append(-0.5 * (y - self.mean(drawn_from, m, rows)) ** 2 / variance - 0.5 * np.log(variance))
        return y, np.array(logs)

    def information(self, weights: np.ndarray, rows: np.ndarray, noise: np.ndarray) -> np.ndarray:
        """Joint information of the readings so far and one more, in bits, for each row as the next reading."""
        gain = np.zeros(len(rows))
        for j, weight in enumerate(weights):
            log = self.log[j][:, None] + self.densities(j, rows, noise)[1]
            gain += weight * (log[j] - _mixture(log, weights)).mean(axis=-1)
        return np.maximum(gain, 0.0) / np.log(2.0)

    def add(self, row: int, noise: np.ndarray) -> None:
        """Condition on a reading at a row."""
        rows = np.array([row])
        for j in range(len(self.predictions)):
            y, log = self.densities(j, rows, noise)
            self.log[j] += log[:, 0]
            for m, one in enumerate(self.predictions):
                gain = self.spread[m] @ one.shared[row] / self.variance(m, rows)[0]
                self.at[j][m] = self.at[j][m] + gain[:, None] * (y[0] - self.mean(j, m, rows)[0])
        for m, one in enumerate(self.predictions):
            pulled = self.spread[m] @ one.shared[row]
            self.spread[m] = self.spread[m] - np.outer(pulled, pulled) / self.variance(m, rows)[0]


def _mixture(log: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Log density under all explanations together; the first axis of ``log`` is the explanation."""
    shaped = np.log(weights).reshape(-1, *(1,) * (log.ndim - 1))
    return np.asarray(np.logaddexp.reduce(log + shaped, axis=0))


def chosen_batch(weights: np.ndarray, predictions: Sequence[Joint], usable: np.ndarray, size: int) -> list[int]:
    """Rows of a batch, each adding the most to the joint information of the rows before; repeated if there are few."""
    # Improbable rivals count in the choice of a test, not in its stated information.
    weights = np.maximum(weights, RIVAL_WEIGHT)
    weights = weights / weights.sum()
    draws, free = _Draws(predictions, CHOICE_DRAWS), np.flatnonzero(usable)
    chosen: list[int] = []
    while free.size and len(chosen) < size:
        noise = draws.normal()
        best = int(free[np.argmax(draws.information(weights, free, noise))])
        draws.add(best, noise)
        chosen.append(best)
        free = free[free != best] if free.size > 1 else np.flatnonzero(usable)
    return chosen


@dataclass(frozen=True, eq=False)
class Played:
    """Joint information (bit) and chance of a settled answer after each reading of a sequence."""

    bits: np.ndarray
    settled: np.ndarray


def played(weights: np.ndarray, predictions: Sequence[Joint]) -> Played:
    """Readings of all rows in turn, drawn from each explanation by its probability.

    >>> far = [Joint(np.full(1, mean), np.zeros((1, 1)), np.ones(1)) for mean in (0.0, 50.0)]
    >>> outcome = played(np.array([0.5, 0.5]), far)
    >>> outcome.bits.round(3).tolist(), outcome.settled.tolist()
    ([1.0], [1.0])
    """
    draws, bits, settled = _Draws(predictions, STATED_DRAWS), [], []
    for row in range(len(predictions[0].mean)):
        draws.add(row, draws.normal())
        gain, alone = 0.0, 0.0
        for log, weight, own in zip(draws.log, weights, range(len(weights)), strict=True):
            gain += weight * float((log[own] - _mixture(log, weights)).mean())
            ranked = np.sort(log + np.log(weights)[:, None], axis=0)
            alone += weight * float(np.mean(ranked[-1] - ranked[-2] > -np.log(TIE)))
        bits.append(max(gain, 0.0) / np.log(2.0))
        settled.append(alone)
    return Played(np.array(bits), np.array(settled))


def _beyond(
    rivals: Rivals, further: tuple[Table, list[list[str]]], columns: list[Column], names: tuple[str, ...]
) -> tuple[NextTest, ...]:
    """The best single tests beyond the recording, in decreasing order of information."""
    table, needs = further
    predictions, usable = _finite(rivals.at(table))
    draws, rows = _Draws(predictions, STATED_DRAWS), np.flatnonzero(usable)
    bits = draws.information(rivals.weights, rows, draws.normal())
    found: list[NextTest] = []
    for i in np.argsort(bits)[::-1]:
        conditions = conditions_at(table, columns, int(rows[i]))
        if all(sum(conditions[n] != one.conditions[n] for n in conditions) >= TESTS_APART for one in found):
            found.append(NextTest(conditions, names, float(bits[i]), tuple(needs[rows[i]])))
        if len(found) == BEYOND_TESTS:
            break
    return tuple(found)
