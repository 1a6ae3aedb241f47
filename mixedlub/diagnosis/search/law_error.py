"""Errors of the laws of an explanation: form of its effects, and a smooth discrepancy of the base model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mixedlub.diagnosis.discrepancy.model import evidence_by_size
from mixedlub.diagnosis.discrepancy.modulated import share_of
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.diagnosis.inference.map_fit import Fit, linear_fit, log_volume, whitening
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.law_error import (
    BASE_ERROR_LENGTH,
    BASE_ERRORS,
    FORM_ERROR_FUNCTIONS,
    FORM_ERROR_LEAST,
    FORM_ERROR_LENGTH,
    FORM_ERROR_PRODUCTS,
    FORM_ERRORS,
    LARGEST_SHARE,
    LEAST_DIRECTION,
    SCREENED_BASE_ERROR,
    SCREENED_FORM_ERROR,
    SIGNED_FORM_ERROR_FUNCTIONS,
    SIGNED_FORM_ERROR_LENGTH,
)
from mixedlub.recording.conditions import PASSING, Coordinates


def n_inexact(problem: Problem, explanation: Explanation) -> int:
    """Number of effects subject to an error of form; zero if any effect is descriptive."""
    effects = problem.effects_of(explanation.effects)
    return 0 if any(e.descriptive for e in effects) else sum(not e.exact_form for e in effects)


def law_error_evidence(
    problem: Problem, stiff: Fit, fit: Fit, space: Coordinates, values: list[np.ndarray], base: np.ndarray
) -> float:
    """Evidence with errors of the laws, averaged over their sizes.

    The change by the effects from a ``stiff`` reference fit has a smooth error of form, and the base model the smooth
    error with columns ``base``. The sizes are compared at the weights of a fit with both errors.
    """
    fixed = np.hstack([fit.slopes, problem.shared])
    plain = linear_fit(fit.anchor, fixed, fit.weight).evidence
    form = np.zeros((fit.anchor.size, 0))
    sizes: Sequence[tuple[float, float]] = ((0.0, 1.0),)
    if n_inexact(problem, fit.explanation):
        net = (fit.prediction - stiff.prediction) / problem.sd
        form, sizes = form_error_columns(net, rms(net), space, values), FORM_ERRORS
    screened = np.hstack([fixed, SCREENED_BASE_ERROR * base, SCREENED_FORM_ERROR * form])
    weight = linear_fit(fit.anchor, screened, fit.weight).weight
    base_sizes, base_shares = np.array(BASE_ERRORS).T
    best, best_columns, logs = -np.inf, fixed, []
    for size, share in sizes:
        columns = np.hstack([fixed, size * form]) if size else fixed
        each = _quick_evidence(fit.anchor, columns, base, base_sizes, weight)
        if each.max() > best:
            best, best_columns = float(each.max()), np.hstack([columns, base_sizes[each.argmax()] * base])
        logs.append(each + np.log(base_shares) + np.log(share))
    exact = linear_fit(fit.anchor, best_columns, weight).evidence
    return fit.evidence - plain + exact - best + float(np.logaddexp.reduce(np.concatenate(logs)))


def _quick_evidence(
    target: np.ndarray, fixed: np.ndarray, added: np.ndarray, sizes: np.ndarray, weight: np.ndarray
) -> np.ndarray:
    """Gaussian log evidence at fixed weights with columns added at each size, up to a constant."""
    whitened = whitening(fixed, weight)
    alone = float(target @ whitened(target[None])[0]) + log_volume(fixed, weight)
    return evidence_by_size(target, whitened, added, sizes) - 0.5 * alone


@dataclass(frozen=True, eq=False)
class BaseError:
    """Smooth relative error of the base model: directions in which the recording can show it.

    ``most``: largest reading over its noise that counts.
    """

    directions: np.ndarray
    most: float

    @classmethod
    def of(cls, problem: Problem, null_fit: Fit, space: Coordinates, values: list[np.ndarray]) -> BaseError:
        """Directions that the largest size of the error makes visible, from a fit of the calibrated base model."""
        share = np.nan_to_num(share_of(problem, problem.run(NOTHING, null_fit.z)))
        most = LARGEST_SHARE * float(np.median(share[share > 0.0])) if share.any() else 0.0
        functions = _functions(space, values)
        _, size, right = np.linalg.svd(functions * np.minimum(share, most)[:, None], full_matrices=False)
        return cls(right[size * max(s for s, _ in BASE_ERRORS) > LEAST_DIRECTION].T, most)

    def columns(self, problem: Problem, null_fit: Fit, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
        """Columns of the error at the rows of a problem with variance one, in standard deviations."""
        share = np.nan_to_num(share_of(problem, problem.run(NOTHING, null_fit.z)))
        return np.asarray((_functions(space, values) @ self.directions) * np.minimum(share, self.most)[:, None])


def _functions(space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Smooth functions of the numeric conditions: a law errs neither over time nor by the name of a specimen."""
    only = tuple(axis.name for axis in space.axes if not axis.named and axis.name not in PASSING)
    if not only:
        return np.zeros((values[0].size, 0))
    return space.columns(values, BASE_ERROR_LENGTH, only, interactions=len(only) > 1)


def rms(net: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(net**2)))


def form_error_columns(net: np.ndarray, typical: float, space: Coordinates, values: list[np.ndarray]) -> np.ndarray:
    """Change by an explanation, in standard deviations, times smooth functions of the numeric conditions.

    Where the change is small, a third of its ``typical`` size replaces it: another form need not vanish there.
    """
    smooth = [
        axis.functions(v, SIGNED_FORM_ERROR_LENGTH)[:, :SIGNED_FORM_ERROR_FUNCTIONS]
        if axis.symmetric_log
        else axis.functions(v, FORM_ERROR_LENGTH)[:, :FORM_ERROR_FUNCTIONS]
        for axis, v in zip(space.axes, values, strict=True)
        if not axis.named and axis.name != "sequence"
    ]
    if not smooth:
        return np.zeros((net.size, 0))
    pairs = [
        (a[:, :FORM_ERROR_PRODUCTS, None] * b[:, None, :FORM_ERROR_PRODUCTS]).reshape(a.shape[0], -1)
        for a, b in combinations(smooth, 2)
    ]
    functions = np.hstack(smooth + pairs) / np.sqrt(len(smooth) + len(pairs))
    return np.hypot(net, FORM_ERROR_LEAST * typical)[:, None] * functions
