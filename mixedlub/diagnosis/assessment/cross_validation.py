"""Cross-validation by level: refit the verdict without each level and predict it.

Verdict, outliers, noise and form of a discrepancy are taken from all readings; only parameters are refitted. Laws are
used as published, without the error of form of predictions.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.inference.change_points import average_over_change_points, change_point_posterior, drop_columns
from mixedlub.diagnosis.inference.map_fit import covariance, linear_fit, map_fit, square_root
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import (
    LEAST_FOLDS,
    MOST_FOLDS,
    UNORDERED_FOLDS,
    WIDE_SPAN,
)
from mixedlub.recording.conditions import is_constant
from mixedlub.recording.set_points import set_points


@dataclass(frozen=True)
class HeldOut:
    """Rms of (recorded - predicted)/sd on left-out levels, with calibration alone and with the verdict.

    ``score`` is the log probability of the readings of each level together, with the uncertainty that they share,
    ``score_before`` the same with calibration alone.
    """

    before: float
    after: float
    split: str
    folds: int
    readings: int
    score: float
    score_before: float

    def single_reading_units(self, n_per_effective: float) -> HeldOut:
        """The same errors in standard deviations of a single reading."""
        times = float(np.sqrt(n_per_effective))
        return replace(self, before=times * self.before, after=times * self.after)


@dataclass(frozen=True, eq=False)
class _Fold:
    """A fold: left-out rows, the problems of the other and of the left-out rows, and the noise of the left-out rows."""

    out: np.ndarray
    train: Problem
    test: Problem
    wide: np.ndarray


@dataclass(frozen=True, eq=False)
class LevelsOut:
    """Folds of a condition."""

    search: Search
    used: np.ndarray
    name: str
    folds: tuple[_Fold, ...]
    refitted: dict[Explanation, tuple[np.ndarray, float]] = field(default_factory=dict)
    """Residuals and log probability of the readings under the explanations tried so far."""

    @classmethod
    def of(cls, search: Search, only: str = "") -> LevelsOut:
        """Folds over the levels of the condition with most levels (up to 8), or of the ``only`` condition."""
        screened = search.full_screen
        name, label = _folds(screened, only)
        folds = []
        for k in range(int(label.max()) + 1):
            out = label == k
            train, test = screened.problem.take(~out), screened.problem.take(out)
            # The error of its set-up is part of the noise of a left-out reading.
            wide = test.sd * np.sqrt(1.0 + np.sum(test.shared**2, axis=1))
            folds.append(_Fold(out, train, test, wide))
        used = np.isin(search.problem.rows["run"], screened.problem.rows["run"])
        return cls(screened, used, name, tuple(folds))

    def held(self, verdict: Explanation, outliers: np.ndarray) -> HeldOut:
        """Cross-validation of an explanation over all levels."""
        outliers = outliers[self.used]
        (before, score_before), (after, score) = self._refitted(NOTHING), self._refitted(verdict)
        used = ~outliers if not outliers.all() else np.ones(outliers.size, bool)
        return HeldOut(
            float(np.sqrt(np.mean(before[used] ** 2))),
            float(np.sqrt(np.mean(after[used] ** 2))),
            f"leave one level of {self.name} out" if self.name else "leave every fifth reading out",
            len(self.folds),
            int(used.sum()),
            score,
            score_before,
        )

    def _refitted(self, verdict: Explanation) -> tuple[np.ndarray, float]:
        if verdict not in self.refitted:
            self.refitted[verdict] = self._refit(verdict)
        return self.refitted[verdict]

    def _refit(self, verdict: Explanation) -> tuple[np.ndarray, float]:
        """Residuals of all readings, parameters refitted without their level, and the log probability of the levels."""
        after, score = np.zeros(self.search.problem.y.size), 0.0
        forms = _discrepancy_columns(self.search) if verdict == DISCREPANCY else []
        for f in self.folds:
            scale = f.test.sd / f.wide
            if verdict == DISCREPANCY:
                after[f.out], found = _discrepancy_residuals(self.search, forms, f.out, scale)
                score += found
                continue
            fit = map_fit(f.train, verdict, self.search.fits[verdict].z, warm=verdict != NOTHING)
            run = f.test.run(fit.explanation, fit.z)
            # The level left out may be the one that determines a change point.
            posteriors = change_point_posterior(f.train, fit)
            gain, (variance, _, _) = average_over_change_points(
                posteriors, fit.z, partial(f.test.predict, fit.explanation), run.prediction
            )
            after[f.out] = (f.test.y - run.prediction - gain) / f.wide
            jumps = [p.index for p in posteriors]
            slopes = drop_columns(f.test.jacobian(fit.explanation, fit.z, run), jumps) * scale[:, None]
            columns = np.hstack([drop_columns(fit.slopes, jumps), f.train.shared])
            alone = np.sqrt(1.0 + variance / f.wide**2) + np.zeros(f.wide.size)
            score += _log_probability(after[f.out], _open_columns(columns, fit.weight, slopes), alone)
        return after, score


def _open_columns(columns: np.ndarray, weight: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Columns with a covariance of one through which predictions share their uncertainty, in units of the noise.

    ``columns`` are the slopes of a fit to other readings, ``slopes`` the slopes of the predictions for its first
    coordinates.
    """
    return np.asarray(slopes @ square_root(covariance(columns, weight)[: slopes.shape[1], : slopes.shape[1]]))


def _log_probability(residual: np.ndarray, shared: np.ndarray, alone: np.ndarray) -> float:
    """Log probability of residuals together: noise ``alone`` and errors through the ``shared`` columns."""
    together = linear_fit(residual / alone, shared / alone[:, None])
    return together.evidence - float(np.log(alone).sum())


def _discrepancy_columns(search: Search) -> list[np.ndarray]:
    """Columns of the discrepancy; for a peak or a step, at all candidate places."""
    shapes = search.discrepancy.best.at_other_places(search.space, search.values)
    return [shape.columns(search.space, search.values, search.discrepancy.scalings) for shape in shapes]


def _discrepancy_residuals(
    search: Search, forms: list[np.ndarray], out: np.ndarray, scale: np.ndarray
) -> tuple[np.ndarray, float]:
    """Residuals of left-out readings, times ``scale``, and their log probability; the other readings fit the forms."""
    problem, base = search.problem, search.discrepancy.base
    log, residuals, scores = [], [], []
    for form in forms:
        columns = np.hstack([base.slopes, problem.shared, form])
        fit = linear_fit(base.anchor[~out], columns[~out])
        new_columns = np.hstack([base.slopes, np.zeros_like(problem.shared), form])[out]
        residual = (base.anchor[out] - new_columns @ fit.coefficients) * scale
        shared = _open_columns(columns[~out], fit.weight, new_columns * scale[:, None])
        log.append(fit.evidence)
        residuals.append(residual)
        scores.append(_log_probability(residual, shared, np.ones(residual.size)))
    weights = np.array(log) - np.logaddexp.reduce(log)
    return np.exp(weights) @ np.array(residuals), float(np.logaddexp.reduce(weights + scores))


def _folds(search: Search, only: str = "") -> tuple[str, np.ndarray]:
    """The condition with most levels, or the ``only`` one, and the level of every reading.

    Conditions of a narrow span come last, because a noisy constant has levels too; ties go to the widest.
    """
    best: tuple[bool, int, float, str, np.ndarray] | None = None
    for axis, values in zip(search.space.axes, search.values, strict=True):
        if axis.name in ("sequence", "composite_roughness_um") or (only and axis.name != only):
            continue
        values = set_points(values)
        levels, label = np.unique(values, return_inverse=True)
        if levels.size > MOST_FOLDS and not axis.named:
            edges = np.unique(np.quantile(values, np.linspace(0, 1, MOST_FOLDS + 1)[1:-1]))
            label = np.searchsorted(edges, values, side="right")
        if levels.size > MOST_FOLDS and axis.named:
            label = label % MOST_FOLDS
        count = int(np.unique(label).size)
        span = 1.0 if axis.named else float(np.ptp(values) / np.max(np.abs(values)))
        warm = axis.name.endswith("temperature_C")
        wide = not is_constant(axis.name, values) if warm else span > WIDE_SPAN
        rank = bool(wide), count, span
        if count >= LEAST_FOLDS and (best is None or rank > best[:3]):
            best = (*rank, axis.name, np.unique(label, return_inverse=True)[1])
    if best is None:
        return "", np.arange(search.problem.y.size) % min(UNORDERED_FOLDS, search.problem.y.size)
    return best[3], best[4]
