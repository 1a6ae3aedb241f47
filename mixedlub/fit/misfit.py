"""Misfit of a fitted law: its trend over a condition, and its error at levels that were left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.stats import f as fisher

from mixedlub.fit.inference import TINY, Fit, fit, predicted_from
from mixedlub.fit.readings import Readings
from mixedlub.schema.units import split

FALSE_TREND = 0.01
"""Judgement. Chance of a false trend of a law that fits, over all its conditions together."""
MOST_LEVELS = 6
"""Cost limit. Levels of a condition that are left out; more are joined to neighbours."""
FARTHEST = 50.0
"""Judgement. Largest logarithm of fitted over measured."""
DEGREE = 3
"""Judgement. Degree of the polynomial of a condition that tells a trend."""
LOG_FROM = 10.0
"""Judgement. Ratio of largest to smallest value from which a condition is taken by its logarithm."""


@dataclass(frozen=True)
class Trend:
    """Trend of the residuals over a condition: ``p_value``, and the mean misfit at low, middle and high values.

    Misfits are logarithms of fitted over measured, or shares of the median reading where readings have either sign.
    """

    condition: str
    p_value: float
    low: float
    middle: float
    high: float
    ends: tuple[float, float]

    def words(self, quantity: str) -> str:
        """The trend in one sentence."""
        name, unit = split(self.condition)
        end = "low" if abs(self.low) > abs(self.high) else "high"
        bowed = abs(self.middle) > abs(getattr(self, end))
        places = ("middle", end) if bowed else ("low", "high")
        parts = {place: getattr(self, place) for place in places}
        said = " and ".join(f"{_size(value)} at {place} {name}" for place, value in parts.items())
        low, high = (f"{end:.4g}" for end in self.ends)
        return f"{quantity} is {said} ({low} to {high} {unit or ''}".rstrip() + ")"


def _size(share: float) -> str:
    """A misfit in words; beyond a factor of two as a factor.

    >>> _size(0.05), _size(-np.log(3.0))
    ('5 % too high', '3 times too low')
    """
    size = abs(share)
    amount = f"{100.0 * size:.2g} %" if size < np.log(2.0) else f"{np.exp(min(size, 50.0)):.2g} times"
    return f"{amount} too {'high' if share > 0.0 else 'low'}"


def coordinate(values: np.ndarray) -> np.ndarray:
    """A condition scaled to -1 to 1, by its logarithm if it spans a decade."""
    if values.min() > 0.0 and values.max() > LOG_FROM * values.min():
        values = np.log(values)
    low, high = values.min(), values.max()
    return np.asarray(2.0 * (values - low) / ((high - low) or 1.0) - 1.0)


def shares(fitted: np.ndarray, readings: Readings) -> np.ndarray:
    """Errors of a law: logarithm of fitted over measured; for readings of either sign, shares of their median."""
    if readings.is_logarithmic:
        with np.errstate(all="ignore"):
            return np.asarray(np.clip(np.log(np.maximum(fitted, TINY) / readings.values), -FARTHEST, FARTHEST))
    return np.asarray((fitted - readings.values) / sizes(readings))


def sizes(readings: Readings) -> np.ndarray:
    """Sizes to which errors relate: each reading, or the median where readings have either sign."""
    size = np.abs(readings.values)
    return size if readings.is_logarithmic else np.full(size.shape, readings.median_size)


def trend(found: Fit, readings: Readings) -> Trend | None:
    """The clearest trend of the residuals over one condition; None if chance explains all."""
    trends = [one for one in _trends(found, readings) if one is not None]
    if not trends:
        return None
    clearest = min(trends, key=lambda one: one.p_value)
    return clearest if clearest.p_value * len(trends) < FALSE_TREND else None


def _trends(found: Fit, readings: Readings) -> Iterator[Trend | None]:
    share = shares(found.fitted, readings)
    for name, values in readings.varied().items():
        place = coordinate(values)
        degree = min(DEGREE, np.unique(place).size - 1)
        columns = np.vander(place, degree + 1, increasing=True)
        n = len(readings)
        free = n - degree - 1
        if free < 1:
            continue
        # Against zero, not the mean: a law without free level may be off everywhere alike.
        line = np.linalg.lstsq(columns, found.residuals, rcond=None)[0]
        rest = found.residuals - columns @ line
        square = float(rest @ rest) / free
        level = np.mean(found.residuals)
        gain = float(np.sum((columns @ line - level) ** 2)) / degree
        p_value = float(fisher.sf(gain / max(square, 1e-12), degree, free))
        shape = np.linalg.lstsq(columns, share, rcond=None)[0]
        at = np.vander(np.array([-1.0, 0.0, 1.0]), degree + 1, increasing=True) @ shape
        low, middle, high = map(float, at)
        yield Trend(name, p_value, low, middle, high, (float(values.min()), float(values.max())))


def folds(readings: Readings) -> dict[str, list[np.ndarray]]:
    """Masks of the readings that are left out together: one level of one condition at a time."""
    found = {}
    for name, values in readings.varied().items():
        levels = _levels(values)
        if levels.max() >= 2:
            found[name] = [levels == level for level in range(levels.max() + 1)]
    return found


def _levels(values: np.ndarray) -> np.ndarray:
    """Number of the level of each value; neighbours are joined to at most `MOST_LEVELS`."""
    rounded = np.round(coordinate(values), 2)
    levels, index = np.unique(rounded, return_inverse=True)
    if levels.size <= MOST_LEVELS:
        return np.asarray(index)
    return np.asarray(np.minimum(index * MOST_LEVELS // levels.size, MOST_LEVELS - 1))


def left_out_error(found: Fit, readings: Readings) -> float:
    """Root mean square error at left-out levels, as a share of the reading; NaN without three levels of a condition."""
    squares: list[np.ndarray] = []
    for masks in folds(readings).values():
        for mask in masks:
            if (~mask).sum() <= len(found.parameters) + 1:
                continue
            again = fit(found.law, readings.take(~mask), found.coordinates)
            left = readings.take(mask)
            squares.append(shares(predicted_from(again, left), left) ** 2)
    every = np.concatenate(squares) if squares else np.array([np.nan])
    return float(np.sqrt(np.mean(every)))
