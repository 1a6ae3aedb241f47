"""Traces that reach the end of the instrument's range: flats of equal heights at the highest or lowest level."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles import Profile
from profiles.profile import of_profile
from roughness.noise import height_quantum

CHANCE = 1e-5
"""Chance of so many separate summits within one height step of the highest, below which the trace is clipped."""
FLAT = 4
"""Points of a flat, and height steps down to its neighbours, beyond any rounded summit: two such flats, or a single
flat twice as long and as steep, are not summits."""
COARSE = 0.02
"""Height step over the range of the heights from which one level may hold a plateau."""
MOST = 0.25
"""Share of the heights in one level beyond which a coarse height step holds them, not the end of the range."""
TWO_LEVELS = 0.9
"""Share of the heights at both ends from which the trace is a step or a square wave."""
RUN, LONGER = 16, 8.0
"""Points of a stretch of equal heights, and their number over that of the tenth longest, beyond any Gaussian surface:
digitised ones of 8000 points reach 4.2 in 400 draws."""
SAME = 1e-9
"""Difference of equal heights over the range of the heights: rounding."""


@dataclass(frozen=True)
class Clipping:
    """Shares of the heights at the lower and at the upper end of the range, 0 for an end that is free, and the ends
    (m along the trace) of stretches of constant heights.

    >>> print(Clipping(0.0, 0.0123))
    clipped at the end of its range: 1.2 % of the heights are equal to the highest
    >>> print(Clipping(constant=((3.7e-3, 4e-3),)))
    heights constant from 3.7 to 4 mm
    """

    low: float = 0.0
    high: float = 0.0
    constant: tuple[tuple[float, float], ...] = ()

    def __bool__(self) -> bool:
        return self.low > 0.0 or self.high > 0.0 or bool(self.constant)

    def __str__(self) -> str:
        ends = (("highest", self.high), ("lowest", self.low))
        shares = [f"{100.0 * share:.2g} % of the heights are equal to the {end}" for end, share in ends if share]
        flats = [f"{1e3 * first:.4g} to {1e3 * last:.4g} mm" for first, last in self.constant]
        clipped = [f"clipped at the end of its range: {', '.join(shares)}"] if shares else []
        return "; ".join(clipped + ([f"heights constant from {', '.join(flats)}"] if flats else []))


@of_profile
def clipping(profile: Profile) -> Clipping:
    r"""Clipping of a trace as read, since filters bend the flats; evaluated profiles keep the result.

    Above a high level the excess of summits is exponential with a mean m, so that no summit of n in the highest height
    step q reaches the next with probability :math:`(1 - e^{-q/m})^{n-1}`; rounded summits also have fewer heights in
    each lower level. A few long flats are recognised by the drops beside them, and stretches of constant heights at any
    level by the tenth longest.
    Source: H. Cramer, M. R. Leadbetter, Stationary and Related Stochastic Processes, 1967, section 11.

    >>> z = np.sin(np.arange(3000) ** 1.1)
    >>> bool(clipping(Profile(z, 1e-6))), round(clipping(Profile(np.minimum(z, 0.9), 1e-6)).high, 2)
    (False, 0.14)
    >>> print(clipping(Profile(np.where(np.arange(3000) < 2800, z, 0.0), 1e-6)))
    heights constant from 2.8 to 2.999 mm
    """
    known = profile.origin.get("clipped")
    if isinstance(known, Clipping):
        return known
    z = profile.heights[profile.valid]
    span = float(np.ptp(z)) if z.size else 0.0
    if z.size < 50 or span == 0.0:
        return Clipping()
    quantum = height_quantum(profile) or 1e-6 * span
    low, high = (_share_at_top(heights, quantum, span) for heights in (-z, z))
    constant = _constant(profile, span, quantum)
    return Clipping(low, high, constant) if low + high < TWO_LEVELS else Clipping()


def _constant(profile: Profile, span: float, quantum: float) -> tuple[tuple[float, float], ...]:
    """Ends of the stretches of constant heights that are far longer than the others."""
    z = profile.heights
    known = profile.valid[1:] & profile.valid[:-1]
    equal = known & (np.abs(np.diff(z)) <= SAME * span)
    first, end = np.flatnonzero(np.diff(equal, prepend=False, append=False)).reshape(-1, 2).T
    counts = np.append(end - first + 1, np.ones(10, int))
    long = np.flatnonzero(counts >= max(RUN, LONGER * float(np.sort(counts)[-10])))
    if quantum > COARSE * span:
        long = long[[np.mean(np.abs(z - z[first[k]]) <= SAME * span) <= MOST for k in long]] if long.size else long
    return tuple((float(first[k] * profile.spacing), float(end[k] * profile.spacing)) for k in long)


def _share_at_top(z: np.ndarray, quantum: float, span: float) -> float:
    """Share of the heights in the highest level if that level is the end of the range, else 0."""
    down = z.max() - z
    level = np.floor(down / quantum + 0.5)
    counts = [int(np.count_nonzero(level == k)) for k in range(5)]
    share = counts[0] / z.size
    if share > MOST and quantum > COARSE * span:
        return 0.0
    edges = np.diff(level == 0, prepend=False, append=False)
    first, end = np.flatnonzero(edges).reshape(-1, 2).T
    below = np.sort(down[level > 0])
    excess = float(below[: max(below.size // 10, 10)].mean())
    chance = (1.0 - np.exp(-quantum / excess)) ** (first.size - 1)
    thinning = counts[1] + counts[2] >= counts[3] + counts[4]
    ties = chance < CHANCE and counts[0] > (3 if thinning else 1) * counts[1]
    inner = (first > 0) & (end < z.size)
    first, end = first[inner], end[inner]
    drop = np.minimum(down[first - 1], down[np.minimum(end, z.size - 1)])
    flats = [np.count_nonzero((drop >= n * quantum) & (end - first >= n)) for n in (FLAT, 2 * FLAT)]
    steep = (flats[0] >= 2 or flats[1] >= 1) and counts[0] > 3 * max(counts[1:])
    return share if ties or steep else 0.0
