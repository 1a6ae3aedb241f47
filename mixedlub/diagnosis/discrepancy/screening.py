"""Of many shapes of a mismatch, the one that readings show most, whichever of them may be outliers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discrepancy.smooth import Shape
from mixedlub.diagnosis.inference.map_fit import Linear, linear_fit

MIDDLE = 2
"""Which of a shape's sizes it is first tried with."""
LEADERS = 3
LOST = 1e-6
CLIPPED = 3.0
"""Sizes of the usual residual beyond which a reading counts for no more in the first look."""


def clearest(
    target: np.ndarray,
    fixed: np.ndarray,
    clipped: np.ndarray,
    columns_of: Callable[[Shape], np.ndarray],
    shapes: list[Shape],
    near: Callable[[Shape], list[Shape]],
) -> tuple[Shape, Linear]:
    """The shape with most evidence beside the ``fixed`` columns, of size one, and the fit with it.

    A smooth fit takes what is narrow or swings for outliers, so the first look, at ``clipped`` residuals, counts all
    readings. ``near`` gives the shapes about a leader that are fitted.
    """
    base = _directions(fixed, fixed)
    power = np.empty(len(shapes))
    for i, shape in enumerate(shapes):
        own = columns_of(shape)
        power[i] = np.sum((_directions(own - base @ (base.T @ own), own).T @ clipped) ** 2)
    leaders = [shapes[k] for k in np.argsort(power)[::-1][:LEADERS]]
    tried = (
        (shape, linear_fit(target, np.hstack([fixed, columns_of(replace(shape, size=shape.sizes[MIDDLE]))])))
        for leader in leaders
        for shape in near(leader)
    )
    return max(tried, key=lambda found: found[1].evidence)


def first_look(target: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """What the fixed columns leave over in sigmas, none beyond a bound."""
    left = linear_fit(target, fixed).residual
    bound = CLIPPED * max(1.4826 * float(np.median(np.abs(left))), 1.0)
    return np.clip(left, -bound, bound)


def _directions(columns: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Orthonormal directions of columns, but for those of which next to nothing is left of the ``whole``."""
    size = np.linalg.norm(whole, axis=0)
    kept = np.linalg.norm(columns, axis=0) > LOST * np.maximum(size, 1e-300)
    return np.linalg.qr(columns[:, kept])[0]
