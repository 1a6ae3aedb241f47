"""Predictions and outliers, averaged over the explanations that carry the answer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.prediction import Prediction, Refined, Rows, refine
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.map_fit import NINETY, outlier_chance
from mixedlub.diagnosis.search.search import Search
from mixedlub.schema.table import Table

AVERAGED = 6
"""Explanations whose predictions are averaged, at most."""
SMALL = 2e-3
"""Probability below which an explanation adds nothing to a prediction that could be seen."""


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


def leaders(found: Search, judged: Posterior) -> dict[Explanation, Refined]:
    """The explanations that carry the answer, refined; none always among them."""
    leaders = [k for k, w in judged.weights.items() if w >= SMALL and not k.discrepancy][:AVERAGED]
    if NOTHING not in leaders:
        leaders.append(NOTHING)
    return {k: refine(found, found.fits[k]) for k in leaders}


def averaged(found: Search, judged: Posterior, refined: dict[Explanation, Refined], table: Table) -> Predicted:
    """Predictions of a table, each explanation as much as it is probable."""
    problem = found.problem
    own = table is problem.rows
    rows = Rows(found, table, found.none.prediction if own else None)
    calibrated = rows.problem.predict(NOTHING, found.none.z)
    each: dict[Explanation, Prediction] = {k: rows.of_fit(r) for k, r in refined.items() if judged.weights[k] >= SMALL}
    if judged.weights[DISCREPANCY] >= SMALL:
        each[DISCREPANCY] = rows.of_unknown()
    means = np.array([p.mean for p in each.values()])
    variances = np.array([p.ends for p in each.values()])
    # An explanation with no finite answer at a row does not speak there; the verdict always does.
    speaks = np.isfinite(means + variances.sum(axis=1)) | np.array([k == judged.verdict for k in each])[:, None]
    share = np.array([judged.weights[k] for k in each])[:, None] * speaks
    share = share / share.sum(axis=0)
    means, variances = np.where(speaks, means, 0.0), np.where(speaks[:, None], variances, 0.0)
    mean = each[NOTHING].mean if judged.verdict == NOTHING else (share * means).sum(axis=0)
    between = (share * (means - mean) ** 2).sum(axis=0)
    within = (share[:, None] * variances).sum(axis=0)
    sd, shared_variance = rows.noise_at(mean)
    below, above = NINETY * np.sqrt(sd**2 + shared_variance + within + between)
    at_verdict = each[judged.verdict].base
    mismatch = np.zeros(mean.size) if judged.verdict == NOTHING else (mean - at_verdict) / sd
    nominal = rows.forward.predict()
    ends = problem.level(mean - below), problem.level(mean + above)
    size = np.abs(problem.level(mean)) if problem.case.kind.logarithmic else 1.0
    return Predicted(
        table, nominal, problem.level(calibrated), problem.level(mean), *ends, mismatch, np.asarray(sd * size)
    )


def outlier_chances(found: Search, judged: Posterior, refined: dict[Explanation, Refined]) -> np.ndarray:
    """Chance that each reading is an outlier, averaged over the explanations that carry the answer."""
    chance = np.zeros(found.problem.y.size)
    total = 0.0
    for key, weight in judged.weights.items():
        if key.discrepancy:
            residual = found.unknown.fit.residual
        elif key in refined:
            residual = refined[key].residual
        else:
            continue
        chance += weight * outlier_chance(found.problem.of_one(residual))
        total += weight
    return chance / max(total, 1e-300)
