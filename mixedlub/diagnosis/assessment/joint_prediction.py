"""Joint prediction of new readings: one Gaussian an explanation, with the uncertainty that the readings share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.assessment.prediction import NewRows, Prediction, Refined, refine
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.search.law_error import n_inexact, rms
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import LEAST_SHARED
from mixedlub.diagnosis.settings.law_error import FORM_ERROR_LEAST, FORM_ERROR_LENGTH
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Joint:
    """Mean of new readings, columns of their shared uncertainty (covariance one), and variance of each alone."""

    mean: np.ndarray
    shared: np.ndarray
    alone: np.ndarray

    def take(self, rows: Sequence[int]) -> Joint:
        """The prediction at some rows, which may repeat."""
        at = list(rows)
        return Joint(self.mean[at], self.shared[at], self.alone[at])


def spread_fits(search: Search, fits: Sequence[Refined]) -> list[Refined]:
    """Fits whose error of form has its root-mean-square size: its most probable size is often zero."""
    return [refine(search, one.fit, ((one.bend_rms, 1.0),)) if one.bend_rms != one.bend else one for one in fits]


def joint_predictions(
    search: Search, rivals: Sequence[Explanation], refined: Sequence[Refined | None], table: Table
) -> list[Joint]:
    """Joint predictions of rivals at the rows of a table; a rival without a fit is the discrepancy.

    Noise counts as the diagnosis will count it: autocorrelated readings for less than one.
    """
    rows = NewRows(search, table)
    distance = _distances(search, rows)
    white = rows.problem.sd**2
    each: list[tuple[Prediction, np.ndarray]] = []
    for key, fit in zip(rivals, refined, strict=True):
        prediction = rows.of_discrepancy() if fit is None else rows.of_fit(fit)
        grown = _discrepancy_size(search, rows) if fit is None else _form_error_size(search, rows, key, fit, prediction)
        each.append((prediction, grown[:, None] * distance / FORM_ERROR_LENGTH))
    _, setups = rows.noise_at(each[0][0].mean)
    found = []
    for prediction, grown in each:
        shared = np.hstack([prediction.shared(), grown])
        alone = np.maximum(prediction.variance - (prediction.shared() ** 2).sum(axis=1), 0.0)
        found.append(Joint(prediction.mean, np.hstack([shared, np.sqrt(setups)[:, None]]), alone + white))
    return [_condensed(one) for one in found]


def _condensed(one: Joint) -> Joint:
    """The prediction in the few directions of its shared uncertainty that readings can show."""
    noise = np.sqrt(one.alone)[:, None]
    with np.errstate(invalid="ignore"):
        scaled = np.nan_to_num(one.shared / noise)
    size, vectors = np.linalg.eigh(scaled.T @ scaled)
    kept = size > LEAST_SHARED**2 * len(one.mean)
    return Joint(one.mean, scaled @ vectors[:, kept] * noise, one.alone)


def _distances(search: Search, rows: NewRows) -> np.ndarray:
    """Distance of each row beyond either end of every condition, over its span; 1 for a name never recorded."""
    columns = []
    for axis, values in zip(search.space.axes, rows.values, strict=True):
        if axis.named:
            new = np.setdiff1d(values, axis.nodes)
            columns += [(values == name).astype(float) for name in new]
            continue
        at = axis.scale(values)
        columns += [np.maximum(-at, 0.0), np.maximum(at - 1.0, 0.0)]
    return np.column_stack(columns) if columns else np.zeros((len(rows.table), 0))


def _form_error_size(
    search: Search, rows: NewRows, key: Explanation, fit: Refined, prediction: Prediction
) -> np.ndarray:
    """Size of the error of form at each row: it grows beyond the recorded range, where no reading bounds it."""
    if not n_inexact(search.problem, key):
        return np.zeros(len(rows.table))
    net = prediction.mean - rows.problem.predict(NOTHING, search.null_fit.z)
    least = FORM_ERROR_LEAST * fit.typical * rows.problem.sd
    return np.asarray(fit.bend_rms * np.hypot(net, least))


def _discrepancy_size(search: Search, rows: NewRows) -> np.ndarray:
    """Typical size of the discrepancy, by which it may change beyond the recorded range."""
    found = search.discrepancy
    form = found.best.columns(search.space, search.values, found.scalings)
    return rms(form @ found.fit.coefficients[-form.shape[1] :]) * rows.problem.sd
