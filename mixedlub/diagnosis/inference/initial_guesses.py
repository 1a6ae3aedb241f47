"""Starting values for the fits of one effect: draws of its prior, and a scan if there are many maxima."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.map_fit import Fit, fit_best_first, linear_fit, map_fit, map_fits
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.inference import (
    FINITE_STEP,
    OUTLIER_WEIGHT,
    PRIOR_DRAWS,
    PRIOR_TAIL,
    QUICK_REWEIGHTINGS,
    SCANNED_TO,
    START_WITHIN,
    STARTS,
    STARTS_APART,
    STARTS_UP_TO,
    STRAINED_CALIBRATION,
    VISIBLE_FROM,
)
from mixedlub.running.parallel import shared_out


@dataclass(frozen=True, eq=False)
class PriorDraws:
    """Draws of an effect's prior: coordinates, and the change of the readings in standard deviations by each.

    The first ``n_prior`` are independent of the readings, the others were found by a scan.
    """

    id: str
    z: np.ndarray
    change: np.ndarray
    n_prior: int

    @property
    def visible(self) -> np.ndarray:
        """Which draws change the readings by more than VISIBLE_FROM."""
        return np.asarray(np.einsum("ij,ij->i", self.change, self.change) > VISIBLE_FROM)

    @property
    def testable(self) -> bool:
        """Whether any draw is visible: an effect that changes no reading explains none."""
        return bool(self.visible.any())


def sample(problem: Problem, name: str, null_fit: Fit) -> PriorDraws:
    """Low-discrepancy draws of the effect's prior, and the best of a scan."""
    alone = Explanation.of(name)
    effect = problem.effects(alone)[0]
    size = len(effect.parameters)
    z = spread(size, PRIOR_DRAWS * size)
    n_prior = len(z)
    for index, parameter in enumerate(effect.parameters):
        if parameter.n_scan:
            z = np.vstack([z, scan(problem, name, null_fit, index, parameter.n_scan)])
    change = np.empty((len(z), problem.y.size))
    run = None
    for i, effect_z in enumerate(z):
        run = problem.run(alone, np.concatenate([null_fit.z, effect_z]), run)
        change[i] = (run.prediction - null_fit.prediction) / problem.sd
    usable = np.asarray(np.isfinite(change).all(axis=1))
    return PriorDraws(name, z[usable], change[usable], int(usable[:n_prior].sum()))


def scan(problem: Problem, name: str, null_fit: Fit, index: int, count: int) -> np.ndarray:
    """Own coordinates at the best few of evenly spread values of one parameter, the others fitted linearly at each."""
    from scipy.special import ndtri

    alone = Explanation.of(name)
    size = len(problem.effects(alone)[0].parameters)
    others = [k for k in range(size) if k != index]
    fixed = np.hstack([null_fit.slopes, problem.shared])
    tried = []
    for z in ndtri((np.arange(count) + 0.5) / count):
        effect_z = np.zeros(size)
        effect_z[index] = z
        at_value = problem.run(alone, np.concatenate([null_fit.z, effect_z]))
        slopes = np.empty((problem.y.size, len(others)))
        for i, k in enumerate(others):
            moved = effect_z.copy()
            moved[k] += FINITE_STEP
            stepped = problem.run(alone, np.concatenate([null_fit.z, moved]), at_value)
            slopes[:, i] = (stepped.prediction - at_value.prediction) / (FINITE_STEP * problem.sd)
        if not np.isfinite(slopes).all():
            continue
        change = (at_value.prediction - null_fit.prediction) / problem.sd
        linear = linear_fit(null_fit.anchor - change, np.hstack([fixed, slopes]), rounds=QUICK_REWEIGHTINGS)
        effect_z[others] = np.clip(linear.coefficients[fixed.shape[1] :], -SCANNED_TO, SCANNED_TO)
        tried.append((linear.evidence - 0.5 * z * z, effect_z))
    best = sorted(tried, key=lambda t: -t[0])[:STARTS]
    return np.array([effect_z for _, effect_z in best]).reshape(-1, size)


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
    return ndtri(PRIOR_TAIL + (1.0 - 2.0 * PRIOR_TAIL) * uniform)


def fit_singles(problem: Problem, null_fit: Fit, draws: Sequence[PriorDraws]) -> dict[Explanation, Fit]:
    """The fit of each effect alone, the most promising first."""
    guesses = dict(zip(draws, shared_out(partial(initial_guesses, problem, null_fit), draws), strict=True))
    order = sorted(draws, key=lambda s: -guesses[s][0])

    def fit(s: PriorDraws, rival: float) -> Fit:
        return fit_single(problem, null_fit, s.id, guesses[s][1], rival)

    fits = dict(zip(order, fit_best_first(fit, order, null_fit.evidence), strict=True))
    return {Explanation.of(s.id): fits[s] for s in draws}


def initial_guesses(problem: Problem, null_fit: Fit, draws: PriorDraws) -> tuple[float, list[np.ndarray]]:
    """The linearised log evidence of the best draw, and the most promising draws that lie apart, calibration fitted.

    Where the base model's calibration is far from its prior, the prior mean is tried too.
    """
    columns = np.hstack([null_fit.slopes, problem.shared])
    scores, starts = [], []
    for z, change in zip(draws.z, draws.change, strict=True):
        linear = linear_fit(null_fit.anchor - change, columns, rounds=QUICK_REWEIGHTINGS)
        scores.append(linear.evidence - 0.5 * z @ z)
        starts.append(np.concatenate([linear.coefficients[: null_fit.z.size], z]))
    order = np.argsort(scores)[::-1]
    # Where an effect changes nothing its slope is zero.
    order = order[draws.visible[order]] if draws.testable else order
    chosen, most = [order[0]], STARTS + max(draws.z.shape[1] - STARTS_UP_TO, 0)
    for i in order[1:]:
        if scores[i] < scores[order[0]] - START_WITHIN or len(chosen) == most:
            break
        if all(np.max(np.abs(draws.z[i] - draws.z[k])) > STARTS_APART for k in chosen):
            chosen.append(i)
    tries = [starts[i] for i in chosen]
    if null_fit.z @ null_fit.z > STRAINED_CALIBRATION:
        tries.append(np.concatenate([np.zeros(null_fit.z.size), draws.z[order[0]]]))
    return float(scores[order[0]]), tries


def fit_single(problem: Problem, null_fit: Fit, name: str, tries: Sequence[np.ndarray], rival: float = -np.inf) -> Fit:
    """The best of the fits of one effect from its initial guesses."""
    alone = Explanation.of(name)
    fits = map_fits(problem, alone, tries, rival)
    if null_fit.weight.min() < OUTLIER_WEIGHT:
        # Outliers may pull a fit away from a good start.
        fits.append(map_fit(problem, alone, tries[0], warm=True, rival=rival))
    return max(fits, key=lambda fit: fit.evidence if np.isfinite(fit.evidence) else -np.inf)
