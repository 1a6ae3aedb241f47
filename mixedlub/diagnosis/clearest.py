"""Of many shapes of a mismatch, the one that readings show most, whichever of them may be outliers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.fit import Linear, linear_fit
from mixedlub.diagnosis.shapes import Shape

SIZE = 6.0
LEADERS = 3
CLIPPED = 3.0
"""Sizes of the usual residual beyond which a reading counts for no more in the first look."""


def clearest(
    target: np.ndarray, fixed: np.ndarray, columns_of: Callable[[Shape], np.ndarray], shapes: list[Shape]
) -> tuple[Shape, Linear]:
    """The shape with most evidence beside the ``fixed`` columns, of size one, and the fit with it.

    A smooth fit takes what is narrow or swings for outliers, so the first look counts all readings, none beyond a
    bound.
    """
    left = linear_fit(target, fixed).residual
    bound = CLIPPED * max(1.4826 * float(np.median(np.abs(left))), 1.0)
    clipped = np.clip(left, -bound, bound)
    base, _ = np.linalg.qr(fixed) if fixed.size else (fixed, None)
    power = np.empty(len(shapes))
    for i, shape in enumerate(shapes):
        own = columns_of(shape)
        turn, _ = np.linalg.qr(own - base @ (base.T @ own))
        power[i] = np.sum((turn.T @ clipped) ** 2)
    leaders = [shapes[k] for k in np.argsort(power)[::-1][:LEADERS]]
    tried = (
        (shape, linear_fit(target, np.hstack([fixed, columns_of(replace(shape, size=SIZE))])))
        for leader in leaders
        for shape in leader.near()
    )
    return max(tried, key=lambda found: found[1].evidence)
