"""Summits of a Gaussian surface by Bush, Gibson and Thomas: elliptic paraboloids of individual height.

The density of summits by height, mean curvature and difference of the principal curvatures follows from the moments of
an isotropic Gaussian surface (Longuet-Higgins, Nayak 1971). Each summit is in elliptic Hertz contact with the plane.
Area over nominal area and pressure over E* sqrt(m2) depend on Nayak's parameter and h/Rq alone; both are tabulated.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from mixedlub.validation.worlds.gaussian import excess

SPREADS = np.log(np.geomspace(1.6, 2000.0, 24))
"""Logarithms of Nayak's parameter in the tables; 1.5 is its least value."""
SEPARATIONS = np.linspace(-1.0, 8.0, 91)
NODES = 48


@cache
def _ellipses() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Curvature ratios of summits (small over large); factors on area and force of a round summit of equal product.

    Hertz (Johnson, Contact mechanics 1985, section 4.2): with eccentricity e and K, E of e^2, the curvatures are as (K
    - E) to E/(1 - e^2) - K, the depth is b K p0/E*, and the smaller curvature 2 b (K - E) p0/(E* e^2 a^2).
    """
    from scipy.special import ellipe, ellipk

    squared = 1 - np.geomspace(1e-5, 1 - 1e-4, 300) ** 2
    first, second = ellipk(squared), ellipe(squared)
    ratio = (first - second) / (second / (1 - squared) - first)
    axis = 2 * (first - second) / (first * squared)
    area = axis * np.sqrt(1 - squared) / np.sqrt(ratio)
    force = np.pi / (2 * first) * np.sqrt(axis) / ratio**0.25
    order = np.argsort(ratio)
    return ratio[order], area[order], force[order]


def summits() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean curvatures and half differences over sqrt(m4) of summits, and their number a unit of m4/(2 pi m2).

    A point is a summit if both curvatures are positive; its weight is their product.
    """
    x, weight = np.polynomial.legendre.leggauss(NODES)
    mean = 3.5 * (1 + x)[:, None]
    half = mean * 0.5 * (1 + x)[None, :]
    measure = 3.5 * weight[:, None] * mean * 0.5 * weight[None, :]
    likely = np.exp(-0.75 * mean**2) / np.sqrt(4 * np.pi / 3) * 3 * half * np.exp(-1.5 * half**2)
    return mean + 0 * half, half, (mean**2 - half**2) * likely * measure


@cache
def tables() -> tuple[np.ndarray, np.ndarray]:
    """Logarithms of area over nominal area and of pressure over E* sqrt(m2), by Nayak's parameter and separation.

    At a mean curvature H the heights of summits are normal about 1.5 H m2/m4 with the variance m0 (1 - 1.5/alpha).
    """
    mean, half, count = (values.ravel() for values in summits())
    ratios, areas, forces = _ellipses()
    ratio = (mean - half) / (mean + half)
    product = mean**2 - half**2
    area = count / np.sqrt(product) * np.interp(ratio, ratios, areas)
    force = count / product**0.25 * np.interp(ratio, ratios, forces)
    found = np.empty((2, len(SPREADS), len(SEPARATIONS)))
    for place, nayak in enumerate(np.exp(SPREADS)):
        spread = np.sqrt(1 - 1.5 / nayak)
        t = (SEPARATIONS[:, None] - 1.5 * mean / np.sqrt(nayak)) / spread
        found[0, place] = 0.5 * np.sqrt(nayak) * spread * (excess(1.0, t) @ area)
        found[1, place] = 2 / (3 * np.pi) * nayak**0.75 * spread**1.5 * (excess(1.5, t) @ force)
    with np.errstate(divide="ignore"):
        logs = np.maximum(np.log(found), -700.0)
    return logs[0], logs[1]


def read(table: np.ndarray, nayak: np.ndarray, separation: np.ndarray) -> np.ndarray:
    """Table at values of Nayak's parameter and of separation over rms height, by linear interpolation."""
    row = (np.log(nayak) - SPREADS[0]) / (SPREADS[1] - SPREADS[0])
    column = (separation - SEPARATIONS[0]) / (SEPARATIONS[1] - SEPARATIONS[0])
    row, column = np.clip(row, 0.0, len(SPREADS) - 1.001), np.clip(column, 0.0, len(SEPARATIONS) - 1.001)
    i, j = row.astype(int), column.astype(int)
    a, b = row - i, column - j
    low = (1 - b) * table[i, j] + b * table[i, j + 1]
    high = (1 - b) * table[i + 1, j] + b * table[i + 1, j + 1]
    return np.asarray(np.exp((1 - a) * low + a * high))
