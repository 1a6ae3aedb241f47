"""Influence of factors on a response: main effects, interactions, Sobol' indices."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

BOOTSTRAP = 200
"""Resamples of a random design: enough for the first digit of an interval."""
LEVEL = 0.95
BINS = 8
"""Number of ranges of a numeric factor in the main effects of a random design."""


@dataclass(frozen=True, eq=False)
class Indices:
    """Sobol' indices by factor, and their intervals if they are estimated.

    ``first``: share of the variance caused by a factor alone. ``total``: share including its interactions.
    ``first_ends`` and ``total_ends`` are of shape (2, factors).
    """

    first: np.ndarray
    total: np.ndarray
    first_ends: np.ndarray | None = None
    total_ends: np.ndarray | None = None


def of_grid(response: np.ndarray) -> Indices:
    r"""Indices of a full factorial, an axis per factor, all levels of equal weight; exact.

    .. math:: S_i = \frac{V[E(y|x_i)]}{V(y)},\quad S_{Ti} = 1 - \frac{V[E(y|x_{\sim i})]}{V(y)}

    Source: I. M. Sobol', Math. Comput. Simul. 55 (2001) 271; here for discrete levels.

    >>> x, y = np.array([-1.0, 1.0])[:, None], np.array([-1.0, 0.0, 1.0])[None, :]
    >>> found = of_grid(x + x * y)     # variances 1 and 2/3
    >>> found.first.round(3).tolist(), found.total.round(3).tolist()
    ([0.6, 0.0], [1.0, 0.4])
    """
    axes = range(response.ndim)
    first = [_share(response, (axis,)) for axis in axes]
    total = [1.0 - _share(response, tuple(other for other in axes if other != axis)) for axis in axes]
    flat = response.var() == 0.0
    return Indices(np.array(first), np.zeros(response.ndim) if flat else np.array(total))


def interactions(response: np.ndarray) -> dict[tuple[int, int], float]:
    """Share of the variance caused by the interaction of two factors, by their axes.

    >>> x, y = np.array([-1.0, 1.0])[:, None], np.array([-1.0, 0.0, 1.0])[None, :]
    >>> {axes: round(share, 3) for axes, share in interactions(x + x * y).items()}
    {(0, 1): 0.4}
    """
    pairs = itertools.combinations(range(response.ndim), 2)
    alone = [_share(response, (axis,)) for axis in range(response.ndim)]
    return {(a, b): _share(response, (a, b)) - alone[a] - alone[b] for a, b in pairs}


def _share(response: np.ndarray, kept: tuple[int, ...]) -> float:
    """Variance of the mean over all axes except ``kept``, relative to the total; 0 if the total is zero."""
    others = tuple(axis for axis in range(response.ndim) if axis not in kept)
    whole = float(response.var())
    return float(response.mean(axis=others).var()) / whole if whole > 0.0 else 0.0


def base_samples(kind: str, runs: int, factors: int, seed: int) -> np.ndarray:
    """Points in the unit cube: matrices A and B of Saltelli, of shape (2, runs, factors).

    >>> base_samples("sobol", 4, 3, seed=1).shape
    (2, 4, 3)
    """
    from scipy.stats import qmc

    sampler = {"sobol": qmc.Sobol, "latin_hypercube": qmc.LatinHypercube}[kind]
    points = sampler(2 * factors, seed=seed).random(runs)
    return np.stack([points[:, :factors], points[:, factors:]])


def all_samples(base: np.ndarray) -> np.ndarray:
    """All points of a random design: A, B, and A with each column of B in turn, stacked.

    >>> all_samples(base_samples("sobol", 4, 3, seed=1)).shape
    (20, 3)
    """
    first, second = base
    mixed = []
    for place in range(first.shape[1]):
        one = first.copy()
        one[:, place] = second[:, place]
        mixed.append(one)
    return np.concatenate([first, second, *mixed])


def of_samples(response: np.ndarray, runs: int, seed: int) -> Indices:
    """Indices from the responses at `all_samples`, with intervals from resampled runs.

    Source: A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, as in SciPy.
    """
    parts = response.reshape(-1, runs)
    first, total = _saltelli(parts)
    picks = np.random.default_rng(seed).integers(0, runs, (BOOTSTRAP, runs))
    drawn = np.array([_saltelli(parts[:, pick]) for pick in picks])
    ends = np.quantile(drawn, [0.5 - LEVEL / 2, 0.5 + LEVEL / 2], axis=0)
    return Indices(first, total, ends[:, 0], ends[:, 1])


def _saltelli(parts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    from scipy.stats import sobol_indices

    given = {"f_A": parts[:1], "f_B": parts[1:2], "f_AB": parts[2:, None, :]}
    found = sobol_indices(func=given, n=parts.shape[1])
    return np.atleast_1d(found.first_order), np.atleast_1d(found.total_order)


@dataclass(frozen=True, eq=False)
class MainEffect:
    """Mean response and number of runs at each level of a factor."""

    levels: tuple[object, ...]
    mean: np.ndarray
    count: np.ndarray


def main_effect_of_grid(response: np.ndarray, axis: int, levels: Sequence[object]) -> MainEffect:
    """Mean response at each level of an axis of a full factorial."""
    others = tuple(other for other in range(response.ndim) if other != axis)
    return MainEffect(tuple(levels), response.mean(axis=others), np.full(len(levels), response.size // len(levels)))


def main_effect_of_samples(response: np.ndarray, values: Sequence[object]) -> MainEffect:
    """Mean response by name, or by ranges of a number with equal numbers of runs; the level is the middle.

    >>> effect = main_effect_of_samples(np.array([1.0, 2.0, 5.0]), ["a", "a", "b"])
    >>> effect.levels, effect.mean.tolist(), effect.count.tolist()
    (('a', 'b'), [1.5, 5.0], [2, 1])
    """
    given = np.asarray(values)
    names = np.unique(given)
    if given.dtype.kind in "fi" and names.size > BINS:
        order = np.array_split(np.argsort(given, kind="stable"), BINS)
        groups = [(float(np.median(given[at])), at) for at in order]
    else:
        groups = [(name.item(), np.flatnonzero(given == name)) for name in names]
    means = np.array([response[at].mean() for _, at in groups])
    return MainEffect(tuple(level for level, _ in groups), means, np.array([at.size for _, at in groups]))
