"""Published laws that effects contain at certain parameters: half of what is believed beforehand lies on them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.inference.change_points import placed
from mixedlub.diagnosis.inference.map_fit import Fit, map_fit
from mixedlub.diagnosis.problem import Problem

SHARE = 0.5
"""Of an effect's prior, the part of its published law exactly; the rest is for laws about it."""
WRONG = 0.5
"""Precision weight below which a reading counts as a wrong one."""
HOPELESS = 15.0
"""Log odds against a law from which it adds nothing, whatever they are."""


def published_odds(problem: Problem, free: Fit, worst: float = np.inf) -> Iterator[tuple[str, str, float]]:
    """Effect, law and log odds of each law that an explanation's effects contain against all parameters free.

    The rest of the explanation is fitted again; the evidences are those of all places of its sudden changes. Odds
    ``worst`` against it and beyond need not be told apart.
    """
    place = problem.calibration_size
    for e in problem.effects(free.explanation):
        names = [p.name for p in e.parameters]
        for law, values in e.laws_within_reach.items():
            drop = [place + names.index(name) for name in values]
            held = replace(problem, held={**problem.held, e.id: {**problem.held.get(e.id, {}), **values}})
            fit = _held_fit(held, free, np.delete(free.z, drop), free.evidence - worst)
            yield e.id, law, placed(held, fit).evidence - free.evidence
        place += len(names)


def _held_fit(held: Problem, free: Fit, start: np.ndarray, least: float) -> Fit:
    """The rest of an explanation fitted again; from afar too where near by it takes more readings for wrong ones."""
    fit = map_fit(held, free.explanation, start, warm=True, least=least)
    if fit.evidence < least or np.count_nonzero(fit.weight < WRONG) <= np.count_nonzero(free.weight < WRONG):
        return fit
    return max(fit, map_fit(held, free.explanation, start), key=lambda one: one.evidence)


def published_gain(problem: Problem, free: Fit) -> float:
    """What an explanation's log evidence gains by its effects' published laws; minus log 2 at least for each effect.

    A law that many share must not be lost for parameters by which others differ from it.
    """
    odds: dict[str, list[float]] = {}
    for name, _, log_odds in published_odds(problem, free, HOPELESS):
        odds.setdefault(name, []).append(log_odds)
    return sum(
        float(np.logaddexp(np.log1p(-SHARE), np.log(SHARE / len(logs)) + np.logaddexp.reduce(logs)))
        for logs in odds.values()
    )
