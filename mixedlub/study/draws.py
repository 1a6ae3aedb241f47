"""Draws of the mean loss of every pairing from the bands of a study, with common errors drawn once.

The loss at both ends of every axis is a result of the study. Between the ends the logarithm of the loss is linear in
the drawn change on each side of the middle, so that no condition is computed again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.special import stdtrit

from mixedlub.rig.measured import LEVEL
from mixedlub.study.bands import HIGH, LOW, REACH, Cause, loss_name
from mixedlub.study.results import Results

DRAWS = 8192
"""Judgement. Number of draws: a probability of one half has a standard deviation of 0.006."""
MOST_DRAWN = 16_000_000
"""Cost limit. Number of draws times pairings: 128 MB an array."""
FEWEST_DRAWS = 500
"""Judgement. Number of draws of a study with very many pairings: 25 of them are beyond each end of an interval."""
SEED = 1


def loss_draws(results: Results) -> np.ndarray | None:
    """Power loss (W), mean over all conditions, of shape (draws, pairings); None for a study without bands.

    A surface has one draw in all its pairings, on either wheel. Oil, friction and the short cut-off have one draw for
    all pairings; the cut-off lies anywhere between half and twice, uniform in its logarithm.
    """
    study = results.study
    bands = study.plan.bands
    if not bands:
        return None
    pairings = study.pairings
    count = int(np.clip(MOST_DRAWN // len(pairings), FEWEST_DRAWS, DRAWS))
    random = np.random.default_rng(SEED)
    scattered = any(isinstance(axis.cause, tuple) for group in bands for axis in group.axes)
    of_surface = {
        name: surface_draws(study.rig.freedom(name), count, random)
        for name in (study.surfaces if scattered else ())
        if study.file.surfaces[name].is_measured or study.file.surfaces[name].one_number is not None
    }
    common = {name: random.standard_normal((count, 1)) / REACH for name in study.file.uncertainty.stated}
    logs = []
    for place, group in enumerate(bands):
        middle = _log_mean(results, loss_name(place))
        total = np.tile(middle, (count, 1))
        for number, axis in enumerate(group.axes):
            low, high = (_log_mean(results, loss_name(place, number, end)) - middle for end in (LOW, HIGH))
            change = _changes(axis.cause, pairings, of_surface, common, count)
            # Draws of an input below 0 stay at 0.
            below, end = np.clip(-change, 0.0, axis.reach), min(axis.reach, 1.0)
            below = np.divide(below, end, out=np.zeros_like(below), where=end > 0.0)
            total += np.maximum(change, 0.0) * high + below * low
        logs.append(total)
    return np.exp(_between([group.factor for group in bands], logs, random))


def surface_draws(freedom: Sequence[tuple[int, int]], count: int, random: np.random.Generator) -> np.ndarray:
    """Changes along the axes of a surface over those at the ends of its 90 % band, of shape (count, axes).

    Axes of the same traces share Student's t: a normal draw each, over one estimate of the scatter. Axes with zero
    degrees of freedom are normal.

    >>> draws = surface_draws([(3, 2)], 100_000, np.random.default_rng(1))
    >>> (np.abs(draws) < 1.0).mean(axis=0).round(2).tolist()
    [0.9, 0.9, 0.9]
    """
    parts = []
    for axes, degrees in freedom:
        normal = random.standard_normal((count, axes))
        if degrees:
            scale = np.sqrt(random.chisquare(degrees, (count, 1)) / degrees)
            normal /= scale * stdtrit(degrees, (1.0 + LEVEL) / 2.0)
        else:
            normal /= REACH
        parts.append(normal)
    return np.concatenate(parts, axis=1)


def _changes(
    cause: Cause,
    pairings: Sequence[tuple[str, str]],
    of_surface: Mapping[str, np.ndarray],
    common: Mapping[str, np.ndarray],
    count: int,
) -> np.ndarray:
    """Drawn changes along an axis, a column a pairing; one column if all pairings share it."""
    if isinstance(cause, str):
        return common[cause]
    side, row = cause
    still = np.zeros((count, row + 1))
    drawn = (of_surface.get(both[side], still) for both in pairings)
    return np.stack([one[:, row] if row < one.shape[1] else still[:, 0] for one in drawn], axis=1)


def _log_mean(results: Results, name: str) -> np.ndarray:
    """Logarithm of the mean over all conditions, by pairing."""
    return np.log(np.maximum(results[name].mean(axis=(1, 2, 3)), np.finfo(float).tiny))


def _between(factors: Sequence[float], logs: Sequence[np.ndarray], random: np.random.Generator) -> np.ndarray:
    """Values at drawn short cut-offs, linear in the logarithm between the groups."""
    if len(logs) == 1:
        return logs[0]
    order = np.argsort(factors)
    places = np.log(np.array(factors)[order])
    at = random.uniform(places[0], places[-1], len(logs[0]))
    weights = np.array([np.interp(at, places, row) for row in np.eye(len(places))])
    return np.asarray(sum(w[:, None] * logs[i] for w, i in zip(weights, order, strict=True)))
