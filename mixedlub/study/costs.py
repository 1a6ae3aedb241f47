"""Costs of finishes: saving of each pairing over the cheapest one, and the efficient frontier."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from profiles.errors import InputError, nearest


def check_costs(costs: Mapping[str, float], used: Collection[str]) -> None:
    """Raise an error for costs below zero, of surfaces in no pairing, or of some surfaces only."""
    for name, cost in costs.items():
        if name not in used:
            raise InputError(f"no such surface in a pairing; {nearest(name, used)}", where=f"costs.{name}")
        if cost < 0.0:
            raise InputError("a cost is 0 or above", where=f"costs.{name}", value=cost)
    lacking = [name for name in used if name not in costs]
    if costs and lacking:
        rule = f"needs the cost of every surface in a pairing; missing: {', '.join(lacking)}"
        raise InputError(rule, where="costs")


def pairing_costs(costs: Mapping[str, float], pairings: Sequence[tuple[str, str]]) -> np.ndarray:
    """Cost of each pairing: sum over both flanks.

    >>> pairing_costs({"ground": 1.0, "polished": 2.5}, [("ground", "ground"), ("ground", "polished")]).tolist()
    [2.0, 3.5]
    """
    return np.array([costs[a] + costs[b] for a, b in pairings])


def reference(cost: np.ndarray, loss: np.ndarray) -> int:
    """Index of the cheapest pairing; of several, the pairing with the smallest loss.

    >>> reference(np.array([2.0, 1.0, 1.0]), np.array([5.0, 9.0, 8.0]))
    2
    """
    return int(np.lexsort((loss, cost))[0])


def efficient(cost: np.ndarray, loss: np.ndarray) -> np.ndarray:
    """Whether no other pairing is as cheap or cheaper and loses less, or is cheaper and loses no more.

    ``loss``: pairings along the last axis. These pairings form the efficient frontier.

    >>> efficient(np.array([1.0, 2.0, 3.0, 3.0]), np.array([9.0, 9.5, 7.0, 8.0])).tolist()
    [True, False, True, False]
    >>> efficient(np.array([1.0, 1.0, 2.0]), np.array([9.0, 9.0, 9.0])).tolist()
    [True, True, False]
    """
    found = np.zeros(np.shape(loss), dtype=bool)
    cheaper = np.full(np.shape(loss)[:-1], np.inf)
    for level in np.unique(cost):
        at = cost == level
        least = loss[..., at].min(axis=-1)
        found[..., at] = (loss[..., at] <= least[..., None]) & (loss[..., at] < cheaper[..., None])
        cheaper = np.minimum(cheaper, least)
    return found
