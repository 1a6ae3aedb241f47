"""Synchronous average of signals over turns of a shaft."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.interpolate import Akima1DInterpolator
from scipy.stats import t as student

from mixedlub.evaluate.uncertainty import NORMAL_90
from profiles.errors import InputError

LEAST_SAMPLES = 4
"""Fewest samples of a turn for a local cubic."""


@dataclass(frozen=True, eq=False)
class Average:
    """Mean signals (M, S) at angles (M,) over N turns.

    ``errors`` (N, M, S): independent errors of the mean, one per turn (`errors_of_mean`), which keep the correlation of
    neighbouring angles and of signals. ``spacing``: angle between samples, the blur of steps by linear interpolation.
    Intervals are widened by `few_turns`.
    """

    angle: np.ndarray
    mean: np.ndarray
    errors: np.ndarray
    spacing: float

    @property
    def turns(self) -> int:
        """Number of turns."""
        return len(self.errors)

    @property
    def sd(self) -> np.ndarray:
        """Standard deviation of the mean of each signal (S,), as median over the angles."""
        return np.asarray(np.median(np.sqrt((self.errors**2).sum(axis=0)), axis=0))


def few_turns(turns: int) -> float:
    """Factor on the 90 % interval of a mean with a scatter estimated from few turns.

    Student's t with N - 1 degrees of freedom over the normal distribution.

    >>> [round(few_turns(turns), 2) for turns in (2, 3, 10, 50)]
    [3.84, 1.78, 1.11, 1.02]
    """
    return float(student.isf(0.05, turns - 1)) / NORMAL_90


def errors_of_mean(each: np.ndarray) -> np.ndarray:
    """Independent errors of the mean over turns, from signals by turn (N, ...).

    Deviations of the turns over sqrt(N (N - 1)); the root of their sum of squares is the standard deviation of the
    mean. Deviations repeated in every turn are no error of the mean.
    """
    turns = len(each)
    return (each - each.mean(axis=0)) / np.sqrt(turns * (turns - 1))


def synchronous_average(
    turn: np.ndarray, angle: np.ndarray, signals: np.ndarray, step: float, *, source: str
) -> Average:
    r"""Mean over the turns, after interpolation at multiples of ``step`` (unit of ``angle``) within each turn.

    N turns reduce asynchronous parts by sqrt(N) and keep synchronous parts. Interpolation by Akima's local cubics:
    linear interpolation, as in the source, has a gain of sinc^2(f/f_s) at frequency f and sampling rate f_s, which
    lowers rapidly changing friction. Only angles covered by every turn are kept. ``signals``: (n, S).

    Source: Rebbechi, Oswald and Townsend 1996, NASA TM-107279, dynamic load measurement.

    >>> turn, angle = np.repeat([1, 2], 5), np.tile([0.0, 90.0, 180.0, 270.0, 350.0], 2)
    >>> found = synchronous_average(turn, angle, (turn + angle / 90.0)[:, None], 45.0, source="x.csv")
    >>> found.mean[:3, 0].tolist(), found.sd.round(3).tolist()
    ([1.5, 2.0, 2.5], [0.5])
    """
    order = np.lexsort((angle, turn))
    turn, angle, signals = turn[order], angle[order], signals[order]
    names, first = np.unique(turn, return_index=True)
    if names.size < 2:
        raise InputError("needs two revolutions or more to average", where=f"{source}: revolution", value=int(names[0]))
    bounds = np.append(first, turn.size)
    if np.diff(bounds).min() < LEAST_SAMPLES:
        few = int(np.argmin(np.diff(bounds)))
        rule = f"a revolution needs {LEAST_SAMPLES} samples or more"
        raise InputError(rule, where=f"{source}: revolution {names[few]}", value=int(np.diff(bounds)[few]))
    ends = [(angle[a], angle[b - 1]) for a, b in pairwise(bounds)]
    low, high = max(a for a, _ in ends), min(b for _, b in ends)
    grid = step * np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1)
    if grid.size == 0:
        raise InputError("no shaft angle is covered by every revolution", where=f"{source}: shaft_angle_deg")
    each = np.stack([Akima1DInterpolator(angle[a:b], signals[a:b], method="makima")(grid) for a, b in pairwise(bounds)])
    return Average(grid, each.mean(axis=0), errors_of_mean(each), _spacing(turn, angle))


def _spacing(turn: np.ndarray, angle: np.ndarray) -> float:
    """Median angle between neighbouring samples of a turn."""
    return float(np.median(np.diff(angle)[np.diff(turn) == 0]))


def cycle_average(
    turn: np.ndarray, angle: np.ndarray, signal: np.ndarray, teeth: int, count: int, *, source: str
) -> Average:
    """Mean of a signal over a mesh cycle at ``count`` angles from 0; ``angle`` in degrees since the pulse of a turn.

    The mean is over whole turns and all teeth, so that run-out cancels. Errors are by turn, since noise of neighbouring
    teeth may be correlated.
    """
    along = 360.0 * (turn - turn.min()) + angle
    order = np.argsort(along, kind="stable")
    along, signal = along[order], signal[order]
    if np.any(np.diff(along) <= 0.0):
        again = float(along[:-1][np.diff(along) <= 0.0][0] % 360.0)
        raise InputError("the same shaft angle twice in a revolution", where=f"{source}: shaft_angle_deg", value=again)
    step = 360.0 / (teeth * count)
    spacing = float(np.median(np.diff(along)))
    widest = float(np.diff(along).max())
    if widest > 90.0 / teeth:
        rule = "a gap wider than a quarter of a tooth pitch"
        raise InputError(rule, where=f"{source}: shaft_angle_deg", value=round(widest, 4))
    first, last = np.ceil((along[0] - spacing) / 360.0), np.floor((along[-1] + spacing) / 360.0)
    turns = int(last - first)
    if turns < 2:
        rule = "needs two whole revolutions or more, whose scatter is the error"
        raise InputError(rule, where=f"{source}: revolution", value=turns)
    places = 360.0 * first + step * np.arange(turns * teeth * count)
    inside = np.clip(places, along[0], along[-1])
    samples = Akima1DInterpolator(along, signal, method="makima")(inside)
    each = samples.reshape(turns, teeth, count).mean(axis=1)[:, :, None]
    return Average(step * np.arange(count), each.mean(axis=0), errors_of_mean(each), spacing)
