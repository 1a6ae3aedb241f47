"""Single readings of implausible size or sign."""

from __future__ import annotations

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.data_checks.sign_checks import AS_LARGE
from mixedlub.recording.conditions import raw_coordinates
from mixedlub.recording.noise import is_stated, noise
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table

FEWEST = 5
"""Judgement. Fewest readings that suggest a size."""
TOO_LARGE, ALONE = 50.0, 10.0
"""Judgement. Ratio of a reading to its expected value, and to the largest other reading, from which it is
implausible."""
NEGATIVE_SHARE, NEGATIVE_SIGMAS = 0.02, 5.0
"""Judgement. Largest share of negative readings that counts as sign errors, and their least distance below zero in
sds."""
UNSTATED = 0.05
"""Judgement. Standard deviation assumed where none is stated, as a share of the median reading."""
NEIGHBOURS = 6
"""Judgement. Readings at the nearest conditions that a reading is compared with: their median bears two wrong ones."""
HAMPEL = 10.0
"""Source: F. R. Hampel, J. Am. Stat. Assoc. 69 (1974) 383: outliers in units of 1.4826 times the median absolute
deviation, usually from 3. Judgement: 10, as only the very far is reported."""
FAR = 8.0
"""Judgement. Deviation of a reading from the value suggested by its neighbours, over that value, from which it is
implausible: a decimal point one place off makes it 9, and less may be an outlier of the rig."""
BELOW_ZERO = 0.2
"""Judgement. Size of a negative reading over its expected value, above which it is neither offset nor scatter."""
SEVERAL = 3
"""Judgement. Negative readings that count as single ones in a small recording."""
TO_SIGMA = 1.4826
"""Definition. Standard deviation over median absolute deviation of normal numbers."""
DECADE = 10.0
"""Judgement. Ratio of largest to smallest condition from which distances are logarithmic."""


def misread(case: Case, rows: Table, y: np.ndarray, forward: Forward, reported: np.ndarray) -> list[Finding]:
    """Single readings of implausible size or sign, compared with the base model scaled to the others. Readings with a
    wrong sign already in ``reported`` are left out."""
    base = forward.base_prediction()
    used = np.abs(base) > 0
    if used.sum() < FEWEST:
        return []
    expected = np.abs(base) * float(np.median(np.abs(y[used] / base[used])))
    used &= expected > 0
    large = used & (np.abs(y) > TOO_LARGE * expected)
    large &= np.abs(y) > ALONE * np.max(np.abs(y[~large]), initial=0.0)
    suspects = [("reading_too_large", large, "check unit and decimal point")]
    if case.kind.is_unsigned(case.quantity):
        negative = used & (y < -NEGATIVE_SIGMAS * sds(case, rows, y)) & (-y > BELOW_ZERO * expected)
        as_large = (-y > AS_LARGE[0] * expected) & (-y < AS_LARGE[1] * expected)
        large |= ~negative & far_from_neighbours(forward, y, base)
        negative &= ~large & ~reported
        if negative.sum() <= max(SEVERAL, NEGATIVE_SHARE * y.size):
            suspects.append(("reading_negative", negative & as_large, "check the sign"))
            suspects.append(("reading_negative", negative & ~as_large, "it cannot be below zero"))
    return [
        finding(code, f"reads {y[i]:g} where the others suggest {expected[i]:.3g}: {advice}", f"run {rows['run'][i]}")
        for code, which, advice in suspects
        for i in np.flatnonzero(which)
    ]


def far_from_neighbours(forward: Forward, y: np.ndarray, base: np.ndarray) -> np.ndarray:
    """Readings very far from those at the nearest conditions, all divided by the base model, by Hampel's identifier."""
    from scipy.spatial import KDTree

    far = np.zeros(y.size, bool)
    known = np.flatnonzero(np.abs(base) > 0)
    if known.size <= NEIGHBOURS:
        return far
    share = y[known] / base[known]
    place = np.column_stack([_scaled(v[known]) for n, v in raw_coordinates(forward).items() if n != "sequence"])
    compared = _a_few_of_each(place)
    others = compared[KDTree(place[compared]).query(place, NEIGHBOURS + 1)[1]]
    # Readings at one place come in any order, so that the first need not be the reading itself.
    kept = np.where(others == np.arange(known.size)[:, None], np.nan, share[others])
    kept[~np.isnan(kept).any(axis=1), -1] = np.nan
    suggested = np.nanmedian(kept, axis=1)
    apart = np.abs(share - suggested)
    usual = TO_SIGMA * float(np.median(apart))
    far[known] = (apart > HAMPEL * usual) & (apart > FAR * np.abs(suggested))
    return far


def _a_few_of_each(place: np.ndarray) -> np.ndarray:
    """A few readings at each place, evenly spread, at most the number looked up: a tree cannot part equal points.

    >>> _a_few_of_each(np.zeros((70, 1))).tolist(), _a_few_of_each(np.array([[0.0], [1.0], [0.0]])).tolist()
    ([0, 10, 20, 30, 40, 50, 60], [0, 1, 2])
    """
    _, at, counts = np.unique(place, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(at.ravel(), kind="stable")
    rank = np.arange(order.size) - np.repeat(np.cumsum(counts) - counts, counts)
    kept = rank * (NEIGHBOURS + 1) % np.repeat(counts, counts) < NEIGHBOURS + 1
    return np.sort(order[kept])


def _scaled(values: np.ndarray) -> np.ndarray:
    """A condition from 0 to 1, one over decades by its logarithm; names are as far apart as its ends.

    >>> _scaled(np.array([1.0, 10.0, 100.0])).ravel().round(9).tolist(), _scaled(np.array(["a", "b"])).tolist()
    ([0.0, 0.5, 1.0], [[0.0, 1.0], [1.0, 0.0]])
    """
    if values.dtype.kind in "US":
        return (values[:, None] != np.unique(values)).astype(float)
    low, high = float(values.min()), float(values.max())
    if low > 0.0 and high > DECADE * low:
        values, low, high = np.log(values), np.log(low), np.log(high)
    return ((values - low) / ((high - low) or 1.0))[:, None]


def sds(case: Case, rows: Table, y: np.ndarray) -> np.ndarray:
    """Stated standard deviation of each reading; else a twentieth of the median reading."""
    return noise(case, rows, y)[0] if is_stated(case) else np.full(y.size, UNSTATED * float(np.median(np.abs(y))))
