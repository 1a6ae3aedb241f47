"""Where the fits of one effect start: draws of its prior, and a scan where there are many maxima."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import Fit, linear_fit, map_fit, map_fits
from mixedlub.diagnosis.problem import STEP, Problem

SAMPLES = (12, 24, 40, 56)
"""Draws of the prior by the number of parameters: a space of more takes more to be covered."""
NEAR, APART, STARTS = 25.0, 1.2, 3
"""A single effect is fitted from this many draws: not far behind the best one, and that far apart."""
MOVES = 1.0
"""Squared sigmas by which a draw moves the readings in all, from which they tell of it."""
WILD = 0.5
"""Weight below which a reading counts for little."""
SCANNED_TO = 3.0
"""Farthest that a scan takes the parameters it fits linearly."""
STRAINED = 25.0
"""Squared length of calibration coordinates that is beyond what five or so of them would show by chance."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """Places in an effect's prior: coordinates, and the change of the readings in sigmas that each makes.

    The first ``blind`` of them were drawn without a look at the readings, the others found by a scan.
    """

    id: str
    z: np.ndarray
    change: np.ndarray
    blind: int

    @property
    def moves(self) -> np.ndarray:
        """Which draws move the readings, by a sigma in all."""
        return np.asarray(np.einsum("ij,ij->i", self.change, self.change) > MOVES)

    @property
    def testable(self) -> bool:
        """Whether any draw moves the readings: an effect that does not explains none."""
        return bool(self.moves.any())


def sample(problem: Problem, name: str, none: Fit) -> Sampled:
    """Spread draws over the effect's prior, denser where its strength is middling, and the best of a scan."""
    alone = Explanation.of(name)
    effect = problem.effects(alone)[0]
    size = len(effect.parameters)
    z = spread(size, SAMPLES[min(size, len(SAMPLES)) - 1])
    blind = len(z)
    for place, parameter in enumerate(effect.parameters):
        if parameter.scan:
            z = np.vstack([z, scan(problem, name, none, place, parameter.scan)])
    change = np.empty((len(z), problem.y.size))
    run = None
    for i, own in enumerate(z):
        run = problem.run(alone, np.concatenate([none.z, own]), run)
        change[i] = (run.prediction - none.prediction) / problem.sd
    usable = np.asarray(np.isfinite(change).all(axis=1))
    return Sampled(name, z[usable], change[usable], int(usable[:blind].sum()))


def scan(problem: Problem, name: str, none: Fit, place: int, count: int) -> np.ndarray:
    """Own coordinates at the best few of evenly spread values of one parameter, the others fitted linearly at each."""
    from scipy.special import ndtri

    alone = Explanation.of(name)
    size = len(problem.effects(alone)[0].parameters)
    others = [k for k in range(size) if k != place]
    fixed = np.hstack([none.slopes, problem.shared])
    tried = []
    for z in ndtri((np.arange(count) + 0.5) / count):
        own = np.zeros(size)
        own[place] = z
        here = problem.run(alone, np.concatenate([none.z, own]))
        slopes = np.empty((problem.y.size, len(others)))
        for i, k in enumerate(others):
            moved = own.copy()
            moved[k] += STEP
            there = problem.run(alone, np.concatenate([none.z, moved]), here)
            slopes[:, i] = (there.prediction - here.prediction) / (STEP * problem.sd)
        if not np.isfinite(slopes).all():
            continue
        change = (here.prediction - none.prediction) / problem.sd
        linear = linear_fit(none.anchor - change, np.hstack([fixed, slopes]), rounds=4)
        own[others] = np.clip(linear.coefficients[fixed.shape[1] :], -SCANNED_TO, SCANNED_TO)
        tried.append((linear.evidence - 0.5 * z * z, own))
    best = sorted(tried, key=lambda t: -t[0])[:STARTS]
    return np.array([own for _, own in best]).reshape(-1, size)


def spread(size: int, count: int) -> np.ndarray:
    """Low-discrepancy standard-normal points, the same every time; shape (count, size).

    >>> spread(2, 4).shape
    (4, 2)
    """
    from scipy.special import ndtri

    golden = 1.0
    for _ in range(30):
        golden = (1.0 + golden) ** (1.0 / (size + 1))
    steps = np.array([golden ** -(i + 1) for i in range(size)])
    uniform = (0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0
    return ndtri(0.02 + 0.96 * uniform)


def fit_single(problem: Problem, none: Fit, sampled: Sampled) -> Fit:
    """Fit from the most promising draws that lie apart, keep the best.

    A base model strained far from its prior is a bad place to start from: the calibration's prior is tried too.
    """
    columns = np.hstack([none.slopes, problem.shared])
    scores, starts = [], []
    for z, change in zip(sampled.z, sampled.change, strict=True):
        linear = linear_fit(none.anchor - change, columns, rounds=4)
        scores.append(linear.evidence - 0.5 * z @ z)
        starts.append(np.concatenate([linear.coefficients[: none.z.size], z]))
    order = np.argsort(scores)[::-1]
    # Where an effect moves nothing it has no slope to climb.
    order = order[sampled.moves[order]] if sampled.testable else order
    chosen = [order[0]]
    for i in order[1:]:
        if scores[i] < scores[order[0]] - NEAR or len(chosen) == STARTS:
            break
        if all(np.max(np.abs(sampled.z[i] - sampled.z[k])) > APART for k in chosen):
            chosen.append(i)
    tries = [starts[i] for i in chosen]
    if none.z @ none.z > STRAINED:
        tries.append(np.concatenate([np.zeros(none.z.size), sampled.z[order[0]]]))
    alone = Explanation.of(sampled.id)
    found = map_fits(problem, alone, tries)
    if none.weight.min() < WILD:
        # Wild readings may pull a fit away from where it starts well.
        found.append(map_fit(problem, alone, tries[0], warm=True))
    return max(found, key=lambda fit: fit.evidence if np.isfinite(fit.evidence) else -np.inf)
