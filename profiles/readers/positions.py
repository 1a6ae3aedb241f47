"""Positions of a trace: equal steps kept, falling positions reversed, unequal steps resampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError
from profiles.readers.base import MAX_POINTS, bridged

GAP = 4.0
"""Median steps beyond which a step is a gap: heights across it would be invented."""
DENSER = 10
"""Most resampled points per measured point; beyond it the positions are not from a trace."""


RESAMPLED = "resampled to equal steps"
"""First words of the note on a trace with unequal positions."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """Heights at equal steps, the mask of measured points, the step, and notes on the changes."""

    heights: np.ndarray
    present: np.ndarray
    step: float
    notes: tuple[str, ...] = ()


def sampled(positions: np.ndarray, heights: np.ndarray, present: np.ndarray, quantum: float, where: str) -> Sampled:
    """Trace at equal steps, in the unit of its positions; ``quantum``: rounding of the position column.

    >>> x = np.array([0.0, 1.0, 2.5, 3.0, 4.0])
    >>> found = sampled(x[::-1], 2.0 * x[::-1], np.ones(5, bool), 0.1, "trace")
    >>> found.heights.round(12).tolist(), found.step
    ([0.0, 2.0, 4.0, 6.0, 8.0], 1.0)
    """
    steps = np.diff(positions) * (-1.0 if positions[-1] < positions[0] else 1.0)
    if not (steps >= 0.0).all() or positions[-1] == positions[0]:
        row = int(np.argmin(steps > 0.0)) + 1
        rule = "positions must increase throughout; if only their column is bad, give the step as spacing '0.5 um'"
        raise InputError(rule, where=f"{where}: point {row + 1}", value=float(positions[row]))
    notes: tuple[str, ...] = ()
    if positions[-1] < positions[0]:
        positions, heights, present = positions[::-1], heights[::-1], present[::-1]
        notes = ("turned, as its positions fall",)
    step = equal_step(positions, quantum)
    if step is not None:
        return Sampled(heights, present, step, notes)
    return _resampled(positions, bridged(heights, present, where), present, where, notes)


def equal_step(positions: np.ndarray, quantum: float) -> float | None:
    """Step of rising positions equally spaced within their rounding, else None. A column rounded to 0.1 um still has
    the step of the measurement: first to last over the count."""
    step = float((positions[-1] - positions[0]) / (positions.size - 1))
    off = float(np.abs(positions - (positions[0] + step * np.arange(positions.size))).max())
    return step if off <= 1e-3 * step or (off <= 1.01 * quantum and quantum <= 0.75 * step) else None


def _resampled(
    positions: np.ndarray, heights: np.ndarray, present: np.ndarray, where: str, notes: tuple[str, ...]
) -> Sampled:
    """Heights at the median step by a spline without overshoot; gaps bridged by straight lines and masked."""
    from scipy.interpolate import PchipInterpolator

    steps = np.diff(positions)
    step = float(np.median(steps))
    if steps.min() <= 0.0:
        repeated = float(positions[int(steps.argmin())])
        rule = "positions must be equally spaced, or none may repeat: save them with more digits"
        raise InputError(rule, where=where, value=repeated)
    count = int((positions[-1] - positions[0]) / step + 1e-9) + 1
    if not 3 <= count <= min(DENSER * positions.size, MAX_POINTS):
        rule = f"positions are too unequal for a trace: the largest step is {steps.max() / step:.3g} times the median"
        raise InputError(rule, where=where)
    places = positions[0] + step * np.arange(count)
    before = np.clip(np.searchsorted(positions, places, side="right") - 1, 0, steps.size - 1)
    inside = present[before] & present[before + 1] & (steps[before] <= GAP * step)
    measured = np.where(places - positions[before] <= 1e-6 * step, present[before], inside)
    least, most = steps.min() / step, steps.max() / step
    said = f"{RESAMPLED} by a cubic spline, as its steps are {least:.4g} to {most:.4g} times their median"
    z = PchipInterpolator(positions, heights)(places)
    return Sampled(bridged(z, measured, where), measured, step, (*notes, said))
