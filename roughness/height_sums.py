r"""Sums of one asperity's area and load over summits of Gaussian heights.

.. math:: S_A = \int_0^\infty a\!\left(\frac{x}{w_c}\right) x\,\varphi(t + x)\,dx,\quad
          S_P = \int_0^\infty p\!\left(\frac{x}{w_c}\right) x^{3/2}\,\varphi(t + x)\,dx

with the overlap x and the onset of yield :math:`w_c` in the standard deviation of the summits, and an asperity's
factors a and p. Both are :math:`F_1(t)` and :math:`F_{3/2}(t)` where nothing yields.
"""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np

from roughness.single_asperity import Asperity

AREA, LOAD = 0, 1
"""Indices of the sums of area and of load."""
FIRST, LAST, PER_UNIT = -4.0, 12.0, 32
"""Range of the table in t, and its nodes a unit: cubic pieces between them are within 1e-7 of the sums."""
MOST_ONSETS, PER_UNIT_OF_LOG = 256, 64
"""Different onsets in one call up to which each has a table; nodes a unit of their logarithm for more onsets."""
_NEGLECTED = 80.0
"""Twice the exponent by which the density has fallen where the integrals end."""


@cache
def _gauss(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights of Gauss and Legendre on 0 to 1."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    return 0.5 * (x + 1.0), 0.5 * w


def integrated(asperity: Asperity, separation: np.ndarray, onset: np.ndarray) -> np.ndarray:
    """The sums S_A and S_P (first axis) at a gap and an onset of yield, both over summit sigma: within 1e-10.

    Gauss-Legendre in pieces: up to onset in the root of the overlap, beyond it from edge to edge and by factors of two.

    >>> from roughness.single_asperity import kogut_etsion
    >>> area, load = integrated(kogut_etsion(), np.array(1.0), np.array(1e3))   # nothing yields
    >>> round(float(area), 5), round(float(load), 7)
    (0.08332, 0.0756682)
    """
    t, w = np.broadcast_arrays(np.asarray(separation, float), np.asarray(onset, float))
    farthest = np.sqrt(np.maximum(t, 0.0) ** 2 + _NEGLECTED) - t
    sums = np.zeros((2, *t.shape))
    root = np.sqrt(np.minimum(w * asperity.edges[0], farthest))
    for node, weight in zip(*_gauss(32), strict=True):
        y = node * root
        part = 2.0 * weight * root * np.exp(-0.5 * (t + y * y) ** 2)
        sums[AREA] += part * y**3
        sums[LOAD] += part * y**4
    if w.size and w.min() > 0.0:
        for low, high in _pieces(asperity.edges, float(farthest.max() / w.min())):
            for node, weight in zip(*_gauss(16), strict=True):
                xi = np.asarray(low + (high - low) * node)
                x = w * xi
                part = (high - low) * weight * w * x * np.exp(-0.5 * (t + x) ** 2)
                sums[AREA] += asperity.area(xi) * part
                sums[LOAD] += asperity.load(xi) * np.sqrt(x) * part
    return sums / np.sqrt(2.0 * np.pi)


def _pieces(edges: tuple[float, ...], end: float) -> list[tuple[float, float]]:
    """Ranges from the first edge to the end, none longer than its beginning."""
    found, low, ahead = [], edges[0], [*edges[1:], np.inf]
    while low < end:
        while ahead[0] <= low:
            del ahead[0]
        high = min(2.0 * low, ahead[0])
        found.append((low, high))
        low = high
    return found


def height_sum(asperity: Asperity, which: int, separation: np.ndarray, onset: np.ndarray) -> np.ndarray:
    """Sum of area or load, fast: within 1e-7 relative of `integrated`; 0 beyond a gap of 12 sigma (sum below 1e-33).

    A few different onsets have a table each; many are interpolated between the onsets of a grid, within 1e-6.

    >>> from roughness.single_asperity import zhao_maietta_chang
    >>> gap, onset = np.array([0.0, 1.0, 3.0]), np.array(0.02)
    >>> fast = height_sum(zhao_maietta_chang(), LOAD, gap, onset)
    >>> bool(np.all(abs(fast / integrated(zhao_maietta_chang(), gap, onset)[LOAD] - 1) < 1e-7))
    True
    """
    t, w = np.asarray(separation, dtype=float), np.asarray(onset, dtype=float)
    onsets, row = np.unique(w, return_inverse=True)
    if onsets.size <= MOST_ONSETS:
        found = np.exp(_logarithm(_table(asperity, onsets.tobytes())[which], t, row.reshape(w.shape)))
    else:
        found = np.exp(_between(asperity, which, t, w))
    below = t < FIRST
    if below.any():
        t, w, below = np.broadcast_arrays(t, w, below)
        found[below] = integrated(asperity, t[below], w[below])[which]
    return np.where(t > LAST, 0.0, found)


def _logarithm(table: np.ndarray, t: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Logarithm of a sum at gaps in rows of a table."""
    place = (t - FIRST) * PER_UNIT
    cell = np.fmin(np.fmax(place, 0.0), _CELLS - 1.0).astype(np.int32)  # of a gap that is not a number too
    cubic = table.take(cell + row.astype(np.int32) * _CELLS, axis=0)
    u = place - cell
    found: np.ndarray = ((cubic[..., 0] * u + cubic[..., 1]) * u + cubic[..., 2]) * u + cubic[..., 3]
    return found


def _between(asperity: Asperity, which: int, t: np.ndarray, onset: np.ndarray) -> np.ndarray:
    """Logarithm of a sum, by cubics through four onsets of a geometric grid."""
    place = np.log(onset) * PER_UNIT_OF_LOG
    first, last = (PER_UNIT_OF_LOG * round(place[()].min() // PER_UNIT_OF_LOG), round(place[()].max() + 3.0))
    last += -last % PER_UNIT_OF_LOG  # whole units of the logarithm, so that calls share their tables
    grid = np.exp(np.arange(first - 1, last + 1) / PER_UNIT_OF_LOG)
    table = _table(asperity, grid.tobytes())[which]
    below = np.floor(place)
    u, row = place - below, (below - first).astype(np.int32)
    a, b, c = u + 1.0, u - 1.0, u - 2.0
    weights = (-u * b * c / 6.0, a * b * c / 2.0, -a * u * c / 2.0, a * u * b / 6.0)
    return sum((weight * _logarithm(table, t, row + k) for k, weight in enumerate(weights)), start=np.zeros(()))


@lru_cache(maxsize=64)
def _table(asperity: Asperity, onsets: bytes) -> np.ndarray:
    """Cubic pieces of the logarithms of both sums over the gap: sum, piece of each onset in turn, power."""
    gaps = FIRST + np.arange(-1.0, _CELLS + 2.0) / PER_UNIT
    sums = np.log(integrated(asperity, gaps, np.frombuffer(onsets)[:, None]))
    before, low, high, behind = (sums[..., k : k + _CELLS] for k in range(4))
    # The cubic through four nodes: that of SciPy's splines is smoother, but their import takes longer than all else.
    cubic = (behind - before) / 6.0 + (low - high) / 2.0
    pieces = (cubic, (before + high) / 2.0 - low, high - low / 2.0 - before / 3.0 - behind / 6.0, low)
    table = np.stack(pieces, axis=-1).reshape(2, -1, 4)
    table.flags.writeable = False
    return table


_CELLS = round((LAST - FIRST) * PER_UNIT)
