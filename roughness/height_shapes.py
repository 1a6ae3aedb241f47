r"""Height distributions other than the normal one, alone and of two surfaces together, and their contact integrals.

.. math:: F_n(t) = \int_t^\infty (s - t)^n f(s)\,ds

with the density f of the heights in units of their rms about the mean plane. A shape is a set of heights with weights;
two independent surfaces add their heights, so that densities are convolved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles import InputError
from roughness.probability import Plateau

STEP, REACH = 0.01, 12.0
"""Spacing and end of the grid of heights, in rms of the pair; a spacing of 0.01 moves F_n by less than 2e-4."""
LEAST_GAP, LARGEST_GAP = -4.0, 10.0
"""Gaps between which the integrals are tabulated: the gap at zero film is above -3 on any surface (Nayak's 1.5)."""
_TINY = 1e-300
_NODES = np.linspace(-9.0, 9.0, 7201)


@dataclass(frozen=True, eq=False)
class HeightShape:
    """Heights over their rms, counted from the mean plane, with weights that add up to 1."""

    heights: np.ndarray
    weights: np.ndarray

    def scaled(self, factor: float) -> np.ndarray:
        """Weights of the heights times a factor on the grid, linear between its points."""
        count = round(REACH / STEP)
        place = np.clip(self.heights * (factor / STEP) + count, 0.0, 2.0 * count - 1e-9)
        lower = place.astype(int)
        upper = place - lower
        found = np.bincount(lower, self.weights * (1.0 - upper), 2 * count + 1)
        return np.asarray(found + np.bincount(lower + 1, self.weights * upper, 2 * count + 1))


def normal_shape() -> HeightShape:
    """Normal heights.

    >>> shape = normal_shape()
    >>> round(float(shape.weights @ shape.heights**2), 9)
    1.0
    """
    weights = np.exp(-0.5 * _NODES**2)
    return HeightShape(_NODES, weights / weights.sum())


def measured_shape(heights: np.ndarray) -> HeightShape:
    """The heights of a trace or map (m), each with the same weight.

    >>> measured_shape(np.array([1e-6, 3e-6])).heights.round(12).tolist()
    [-1.0, 1.0]
    """
    return HeightShape((heights - heights.mean()) / heights.std(), np.full(heights.size, 1.0 / heights.size))


def plateau_shape(lines: Plateau, mean: float, rms: float) -> HeightShape:
    """Two normal processes, one above the knee of the probability plot and one below it; ISO 13565-3.

    ``mean`` and ``rms`` are of the heights that the lines were fitted to (m).

    >>> lines = Plateau(0.5e-6, 2e-6, 84.13, -0.5e-6, 0.0)
    >>> shape = plateau_shape(lines, 0.0, 1e-6)
    >>> [round(float(np.interp(q, _NODES, shape.heights)), 3) for q in (1.0, -1.0, -2.0)]
    [0.5, -0.5, -2.5]
    """
    if not (lines.plateau_sigma > 0.0 and lines.valley_sigma > 0.0):
        rule = "no two lines describe the probability plot; take the measured heights"
        raise InputError(rule, where="plateau")
    knee = (lines.knee_height - lines.plateau_mean) / lines.plateau_sigma
    above = lines.plateau_mean + lines.plateau_sigma * _NODES
    below = lines.knee_height + lines.valley_sigma * (_NODES - knee)
    heights = np.where(knee <= _NODES, above, below)
    return HeightShape((heights - mean) / rms, normal_shape().weights)


def log_integrals(first: HeightShape, second: HeightShape, height_share: float) -> np.ndarray:
    """Logarithms of F_1 and F_3/2 of two surfaces together, one row each, at the gaps of the table.

    ``height_share`` is the part of the first surface in the variance of the heights.

    >>> from roughness.integrals import area_integral
    >>> table = log_integrals(normal_shape(), normal_shape(), 0.3)
    >>> gaps = np.array([0.0, 1.0, 3.0])
    >>> bool(np.allclose(np.exp(at_gap(table, 0, gaps)), area_integral(gaps), rtol=2e-4))
    True
    """
    density = np.convolve(first.scaled(height_share**0.5), second.scaled((1.0 - height_share) ** 0.5), "same")
    count = round(REACH / STEP)
    start, stop = (count + round(gap / STEP) for gap in (LEAST_GAP, LARGEST_GAP))
    above = STEP * np.arange(density.size)
    padded = np.concatenate((density[start:], np.zeros(density.size)))
    tables = [np.correlate(padded, above**n, "valid")[: stop - start + 1] for n in (1.0, 1.5)]
    return np.log(np.maximum(tables, _TINY))


def at_gap(table: np.ndarray, row: np.ndarray | int, gap: np.ndarray) -> np.ndarray:
    """Values of a table with a row for each pairing, at rows and gaps that broadcast; linear between its points."""
    last = table.shape[-1] - 2
    place = np.clip((gap - LEAST_GAP) / STEP, 0.0, last + 1.0)
    lower = np.minimum(np.nan_to_num(place).astype(int), last)
    part = place - lower
    start = np.asarray(row) * table.shape[-1] + lower
    flat = table.reshape(-1)
    return np.asarray(flat[start] * (1.0 - part) + flat[start + 1] * part)
