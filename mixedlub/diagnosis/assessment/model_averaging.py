"""Bayesian model averaging of predictions and outlier probabilities."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import NewRows, Prediction, Refined, refine
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.likelihood import outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import HALVINGS, MOST_AVERAGED, NEGLIGIBLE
from mixedlub.diagnosis.settings.inference import NINETY
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Predicted:
    """Predictions of one table: nominal base, calibrated base, the answer, its 90 % interval, mismatch in sigmas."""

    table: Table
    base: np.ndarray
    calibrated: np.ndarray
    predicted: np.ndarray
    low90: np.ndarray
    high90: np.ndarray
    mismatch_z: np.ndarray
    sd: np.ndarray


def by_calibration(search: Search, p: Predicted, error: float) -> Predicted:
    """The predictions by calibration alone, with the intervals of its ``error`` on left-out levels (in sd).

    The mismatch remains that of the answer.
    """
    problem = search.problem
    mean = problem.transform(p.calibrated)
    sd = p.sd / np.abs(p.predicted) if problem.case.kind.logarithmic else p.sd
    half = NINETY * max(error, 1.0) * sd
    return replace(p, predicted=p.calibrated, low90=problem.inverse(mean - half), high90=problem.inverse(mean + half))


def leaders(search: Search, judged: Posterior) -> dict[Explanation, Refined]:
    """Refined fits of the most probable explanations, always including nothing missing."""
    leaders = [k for k, w in judged.weights.items() if w >= NEGLIGIBLE and not k.is_discrepancy][:MOST_AVERAGED]
    if NOTHING not in leaders:
        leaders.append(NOTHING)
    return {k: refine(search, search.fits[k]) for k in leaders}


def averaged(search: Search, judged: Posterior, refined: dict[Explanation, Refined], table: Table) -> Predicted:
    """Model average of the predictions of a table, weighted by posterior probability."""
    problem = search.problem
    own = table is problem.rows
    rows = NewRows(search, table, search.null_fit.prediction if own else None)
    calibrated = rows.problem.predict(NOTHING, search.null_fit.z)
    each: dict[Explanation, Prediction] = {
        k: rows.of_fit(r) for k, r in refined.items() if judged.weights[k] >= NEGLIGIBLE or k == judged.verdict
    }
    if judged.weights[DISCREPANCY] >= NEGLIGIBLE:
        each[DISCREPANCY] = rows.of_discrepancy()
    means = np.array([p.mean for p in each.values()])
    variances = np.array([p.ends for p in each.values()])
    # An explanation that is not finite at a row is left out there, except the verdict.
    is_finite = np.isfinite(means + variances.sum(axis=1)) | np.array([k == judged.verdict for k in each])[:, None]
    share = np.array([judged.weights[k] for k in each])[:, None] * is_finite
    share = share / share.sum(axis=0)
    means, variances = np.where(is_finite, means, 0.0), np.where(is_finite[:, None], variances, 0.0)
    mean = each[NOTHING].mean if judged.verdict == NOTHING else (share * means).sum(axis=0)
    sd, shared_variance = rows.noise_at(mean)
    noise = sd**2 + shared_variance
    low, high = ends_of_mixture(share, means, np.sqrt(variances + noise))
    at_verdict = each[judged.verdict].base
    mismatch = np.zeros(mean.size) if judged.verdict == NOTHING else (mean - at_verdict) / sd
    nominal = rows.forward.predict()
    low, high = with_noise_about(mean, np.sqrt(noise), low, high)
    ends = problem.inverse(low), problem.inverse(high)
    size = np.abs(problem.inverse(mean)) if problem.case.kind.logarithmic else 1.0
    return Predicted(
        table, nominal, problem.inverse(calibrated), problem.inverse(mean), *ends, mismatch, np.asarray(sd * size)
    )


def ends_of_mixture(share: np.ndarray, means: np.ndarray, sds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the 90 % interval of a mixture of normal distributions in each row.

    ``share`` and ``means`` are (parts, rows), ``sds`` (parts, 2, rows) for the lower and the upper end.

    >>> one, low_high = np.ones((1, 1)), np.ones((1, 2, 1))
    >>> [end.round(3).tolist() for end in ends_of_mixture(one, one, low_high)]
    [[-0.645], [2.645]]
    """
    from scipy.special import ndtr

    found = []
    for sign, sd in ((-1.0, sds[:, 0]), (1.0, sds[:, 1])):
        # The end of a mixture lies between the ends of its parts.
        off = sign * means + NINETY * sd
        inner, outer = off.min(axis=0), off.max(axis=0)
        for _ in range(HALVINGS):
            middle = 0.5 * (inner + outer)
            beyond = (share * ndtr((sign * means - middle) / sd)).sum(axis=0) > ndtr(-NINETY)
            inner, outer = np.where(beyond, middle, inner), np.where(beyond, outer, middle)
        found.append(sign * 0.5 * (inner + outer))
    return found[0], found[1]


def with_noise_about(
    mean: np.ndarray, noise: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Ends of an interval that has the noise on both sides of its mean: the mean may lie outside a mixture's quantiles.

    >>> [end.round(3).tolist() for end in with_noise_about(np.full(1, 4.0), np.ones(1), np.zeros(1), np.ones(1))]
    [[0.0], [5.645]]
    """
    return np.minimum(low, mean - NINETY * noise), np.maximum(high, mean + NINETY * noise)


def outlier_chances(search: Search, judged: Posterior, refined: dict[Explanation, Refined]) -> np.ndarray:
    """Probability that each reading is an outlier, averaged over explanations."""
    chance = np.zeros(search.problem.y.size)
    total = 0.0
    for key, weight in judged.weights.items():
        if key.is_discrepancy:
            residual = search.discrepancy.fit.residual
        elif key in refined:
            residual = refined[key].residual
        else:
            continue
        chance += weight * outlier_chance(search.problem.single_reading_units(residual))
        total += weight
    return chance / max(total, 1e-300)
