"""Measures of an answered case: pure functions of its truth and its answer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.rig import NAMES, steps
from profiles.errors import InputError

Pair = tuple[Truth, Answer]
FLOOR = 1e-4
ANSWERS_WITHOUT_EFFECT = frozenset({"none", "unknown"})


def log_score(truth: Truth, answer: Answer, ids: Sequence[str]) -> float:
    """Sum over ids of the log probability of the true state (in the label or not), floored at 1e-4."""
    total = 0.0
    for name in ids:
        p = float(np.clip(answer.probabilities.get(name, FLOOR), FLOOR, 1 - FLOOR))
        total += np.log(p if name in truth.label else 1 - p)
    return total


def auroc(score: np.ndarray, positive: np.ndarray) -> float:
    """Chance that a positive has a higher score than a negative, ties counting half.

    >>> auroc(np.array([0.1, 0.9, 0.5, 0.5]), np.array([False, True, True, False]))
    0.875
    """
    from scipy.stats import rankdata

    n = int(positive.sum())
    rank = rankdata(score)[positive].sum() - n * (n + 1) / 2
    return float(rank / (n * (len(score) - n)))


def location_auroc(truth: Truth, answer: Answer) -> float:
    """AUROC of |mismatch_z| against readings off by more than one sd; nan if a class has under a tenth."""
    scored = ~truth.withheld & ~np.isin(truth.run, list(truth.outliers))
    displaced = np.abs(truth.off[scored]) > 1
    if not 0.1 <= displaced.mean() <= 0.9:
        return float("nan")
    located = np.array([abs(answer.location.get(int(run), 0.0)) for run in truth.run[scored]])
    return auroc(located, displaced)


def _withheld(truth: Truth, answer: Answer, column: np.ndarray) -> np.ndarray:
    """A column of the predictions at the withheld runs, in the order of the truth; an error if runs are missing."""
    index = {int(run): i for i, run in enumerate(answer.run)}
    wanted = truth.run[truth.withheld]
    missing = [int(run) for run in wanted if int(run) not in index]
    if missing:
        raise InputError("withheld runs have no prediction", where=truth.case, value=missing[:5])
    return np.asarray(column[[index[int(run)] for run in wanted]])


def held_out(truth: Truth, answer: Answer) -> tuple[float, float]:
    """Rms errors (sd) of predicted and calibrated values at withheld conditions against the noise-free truth."""
    target, sd = truth.values[truth.withheld], truth.sd[truth.withheld]
    errors = [(_withheld(truth, answer, column) - target) / sd for column in (answer.predicted, answer.calibrated)]
    return float(np.sqrt(np.mean(errors[0] ** 2))), float(np.sqrt(np.mean(errors[1] ** 2)))


def coverage(truth: Truth, answer: Answer) -> float:
    """Probability that a new reading at the withheld conditions lies in the 90 % predictive intervals."""
    from scipy.special import ndtr

    target, sd = truth.values[truth.withheld], truth.sd[truth.withheld]
    low, high = (_withheld(truth, answer, column) for column in (answer.low, answer.high))
    return float(np.mean(ndtr((high - target) / sd) - ndtr((low - target) / sd)))


def physics(label: frozenset[str], truth: Truth) -> frozenset[str]:
    """Missing physics named by an explanation: without laws if the rig follows other laws, and their companions."""
    if not truth.laws:
        return label
    return label - NAMES - truth.beside if label & truth.label else label - NAMES or frozenset({"none"})


def right(truth: Truth, answer: Answer) -> bool:
    """Whether the verdict is the truth, laws aside."""
    return physics(answer.verdict, truth) == truth.label


def tied(truth: Truth, answer: Answer) -> bool:
    """Whether the verdict, or an explanation tied with it, is the truth, laws aside."""
    return right(truth, answer) or truth.label in [physics(one, truth) for one in answer.tied]


def together(truth: Truth, answer: Answer) -> bool:
    """Whether the verdict, or an explanation tied with it, names every planted effect."""
    return any(truth.label <= one for one in (answer.verdict, *answer.tied))


def laws_named(laws: frozenset[str], truth: Truth, answer: Answer) -> float:
    """Share of the laws named by the verdict or a tied explanation; explanations with a wrong law do not count."""
    honest = [steps(one) for one in (answer.verdict, *answer.tied) if steps(one) <= truth.laws]
    return len(laws & frozenset().union(*honest)) / len(laws)


def false_law(truth: Truth, answer: Answer) -> bool:
    """Whether the verdict has a law that the rig does not follow."""
    return bool(steps(answer.verdict) - truth.laws)


def false_physics(truth: Truth, answer: Answer) -> bool:
    """Whether an effect that is not planted has a probability of 0.9 or more."""
    so = truth.label | truth.beside | NAMES | ANSWERS_WITHOUT_EFFECT
    return any(p >= 0.9 for name, p in answer.probabilities.items() if name not in so)


def unknown_suspected(truth: Truth, answer: Answer) -> bool:
    """Whether an unknown effect is more probable than not."""
    return answer.probabilities.get("unknown", 0.0) > 0.5


def crossed(truth: Truth, answer: Answer) -> bool:
    """Whether an instrument fault is called physics, or physics an instrument fault."""
    named = physics(answer.verdict, truth) - ANSWERS_WITHOUT_EFFECT
    if truth.label <= MEASUREMENT:
        return bool(named - MEASUREMENT)
    return bool(named & MEASUREMENT)


def spoiled(truth: Truth) -> int:
    """Number of spoiled readings."""
    return len(truth.outliers)


def clean(truth: Truth) -> int:
    """Number of good readings in the recording."""
    return int((~truth.withheld).sum()) - len(truth.outliers)


def outliers_found(truth: Truth, answer: Answer) -> float:
    """Share of the spoiled readings that were flagged."""
    return len(truth.outliers & answer.outliers) / spoiled(truth)


def outliers_false(truth: Truth, answer: Answer) -> float:
    """Share of the good readings that were flagged."""
    return len(answer.outliers - truth.outliers) / clean(truth)


def held_ratio(truth: Truth, answer: Answer) -> float:
    """Error of predicted over error of calibrated at withheld conditions."""
    predicted, calibrated = held_out(truth, answer)
    return predicted / calibrated if calibrated > 0 else float("nan")


def calibration_covers(truth: Truth, answer: Answer) -> float:
    """Share of the calibration's 90 % intervals that hold the true value."""
    true_values = {name.removesuffix("_scale"): value for name, value in truth.theta.items()}
    hits = [low <= true_values[name] <= high for name, (low, high) in answer.calibration.items() if name in true_values]
    return float(np.mean(hits)) if hits else float("nan")
