"""Screening of many forms of a discrepancy, robust against outliers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discrepancy.smooth import DiscrepancyForm
from mixedlub.diagnosis.inference.map_fit import Linear, linear_fit
from mixedlub.diagnosis.settings.discrepancy import DEPENDENT, SCREENED_FORMS, SCREENED_SIZE
from mixedlub.diagnosis.settings.inference import CLIPPED_AT
from mixedlub.recording.noise import MAD_TO_SD


def clearest(
    target: np.ndarray,
    fixed: np.ndarray,
    clipped: np.ndarray,
    columns_of: Callable[[DiscrepancyForm], np.ndarray],
    shapes: list[DiscrepancyForm],
    near: Callable[[DiscrepancyForm], list[DiscrepancyForm]],
) -> tuple[DiscrepancyForm, Linear]:
    """The form with most evidence in addition to the ``fixed`` columns, of size one, and its fit.

    A smooth fit takes narrow or oscillating forms for outliers, so the first screening uses all readings, with
    ``clipped`` residuals. ``near`` gives the forms around a candidate that are fitted.
    """
    base = _directions(fixed, fixed)
    power = np.empty(len(shapes))
    for i, shape in enumerate(shapes):
        own = columns_of(shape)
        power[i] = np.sum((_directions(own - base @ (base.T @ own), own).T @ clipped) ** 2)
    leaders = [shapes[k] for k in np.argsort(power)[::-1][:SCREENED_FORMS]]
    tried = (
        (shape, linear_fit(target, np.hstack([fixed, columns_of(replace(shape, size=shape.sizes[SCREENED_SIZE]))])))
        for leader in leaders
        for shape in near(leader)
    )
    return max(tried, key=lambda found: found[1].evidence)


def first_look(target: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """Clipped standardised residuals of a fit of the fixed columns."""
    left = linear_fit(target, fixed).residual
    bound = CLIPPED_AT * max(MAD_TO_SD * float(np.median(np.abs(left))), 1.0)
    return np.clip(left, -bound, bound)


def _directions(columns: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Orthonormal basis of columns, without columns that are dependent relative to the ``whole``."""
    size = np.linalg.norm(whole, axis=0)
    kept = np.linalg.norm(columns, axis=0) > DEPENDENT * np.maximum(size, 1e-300)
    return np.linalg.qr(columns[:, kept])[0]
