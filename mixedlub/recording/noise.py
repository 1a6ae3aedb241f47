"""Noise of the readings: as stated, from repeats, or from the residuals of a smooth fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.recording.conditions import PASSING, Coordinates, is_noisy_constant
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.recording.set_points import near_values
from mixedlub.schema import system_file
from mixedlub.schema.table import Table

MAD_TO_SD = 1.4826
"""Definition. Standard deviation over the median absolute deviation of a normal distribution."""
KNOWN_FROM = 30
"""Judgement. Tests from which a standard deviation counts as known, with a standard error of 13 %."""
MARKS_UNUSABLE = 5.0
"""Judgement. Ratio to similar readings from which a standard deviation marks a reading as unusable."""
LOG_SD_BIAS = 0.52
"""Definition. Bias of ln s over its variance, for the standard deviation s of two tests; from the chi distribution."""
LOG_SD_VARIANCE = 1.23
"""Definition. Variance of ln s for two tests; from the chi distribution."""
MOST_COMPARED = 2000
"""Cost limit. Most readings in a pairwise comparison of standard deviations."""
RELATIVE_FROM = 3.0
"""Judgement. Ratio of largest to smallest reading from which noise is taken as relative, if nothing else is known."""
OUTLIERS_FROM = 10
"""Judgement. Repeats from which outliers among them are left out."""
PARTS = ((1.0, 0.0), (1.0, 0.03), (1.0, 0.1), (1.0, 0.3), (1.0, 1.0), (0.3, 1.0), (0.0, 1.0))
"""Grid. Mixtures of relative and absolute noise that are tried: shares of the reading and of the typical reading."""
MIXTURE_GAIN = 2.0
"""Judgement. Gain in log probability from which noise has both parts: odds of seven."""
PARTNERS = 12
"""Cost limit. Readings of its group with which each reading is compared at most."""
CROSSINGS = 121
"""Grid. Ratios of absolute to relative noise that are tried."""
SMALLEST_LEVEL = 1e-6
"""Judgement. Smallest level of that grid over the largest reading: noise so small is relative."""


def is_stated(case: Case) -> bool:
    """Whether the recording states the noise of its readings."""
    stated = case.system.recording.noise
    return f"{case.quantity}_sd" in rows_of(case) or (stated is not None and stated.of_single)


def setups_differ(case: Case) -> bool:
    """Whether the recording states the error of a set-up."""
    stated = case.system.recording.noise
    return stated is not None and stated.of_setups


def with_noise(case: Case, relative: float, absolute: float) -> Case:
    """The case with another noise of a single reading."""
    noise = (case.system.recording.noise or system_file.Noise()).model_copy(
        update={"relative": float(relative), "absolute": float(absolute)}
    )
    recording = case.system.recording.model_copy(update={"noise": noise})
    return replace(case, system=case.system.model_copy(update={"recording": recording}))


def transformed_noise(
    case: Case, rows: Table, level: np.ndarray, expected: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """`noise` of the transformed readings: relative where these are logarithms."""
    if case.kind.logarithmic:
        sd, shared = noise(case, rows, level)
        return sd / np.abs(level), shared
    return noise(case, rows, level, expected)


def noise(
    case: Case, rows: Table, level: np.ndarray, expected: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviation of each reading and, in units of it, columns of the errors shared within a set-up.

    ``level`` is the size of the readings. Relative errors of a set-up are shares of the ``expected`` prediction: as
    shares of the readings they would fit a discrepancy of any form.
    """
    quantity = case.quantity
    stated = case.system.recording.noise
    if f"{quantity}_sd" in rows:
        sd = rows[f"{quantity}_sd"].astype(float)
        if sd.size <= MOST_COMPARED:
            sd = shrunk_sd(sd, level, _neighbours(case, rows))
    else:
        relative, absolute = (stated.relative, stated.absolute) if stated is not None else (0.0, 0.0)
        sd = np.hypot(relative * np.abs(level), absolute)
    sd = np.maximum(sd, 1e-6 * float(np.median(np.abs(level))) + 1e-300)
    shared = np.zeros((level.size, 0))
    if stated is not None and "setup" in rows and setups_differ(case):
        names = np.unique(rows["setup"])
        member = (rows["setup"][:, None] == names[None, :]).astype(float)
        columns = []
        if stated.setup_relative > 0:
            share = level if expected is None else expected
            columns.append(member * (stated.setup_relative * share / sd)[:, None])
        if stated.setup_absolute > 0:
            columns.append(member * (stated.setup_absolute / sd)[:, None])
        shared = np.hstack(columns)
    return sd, shared


def shrunk_sd(sd: np.ndarray, level: np.ndarray, near: np.ndarray) -> np.ndarray:
    r"""Standard deviations from few tests, shrunk towards the values at similar conditions.

    .. math:: \ln s_i \leftarrow (1-w) \ln s_i + w \left(\frac{\sum_j K_{ij} \ln s_j}{\sum_j K_{ij}} + 0.52 v\right)
              ,\quad w = \frac{v}{v + v_0}

    ``near`` (n, n) is the similarity of the conditions of two readings, one for equal ones; v is half the squared
    difference of ln s between similar readings, from its median. For n tests ln s has the variance 1/(2(n - 1)) and a
    bias of 0.5 to 0.8 of that; v_0 is the variance for KNOWN_FROM tests. Smoothly varying standard deviations stay as
    stated, and so do values above MARKS_UNUSABLE times the level of similar readings: they mark a reading as unusable.
    Moderated variances: G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004) 3.

    >>> near = np.ones((4, 4))
    >>> shrunk_sd(np.array([1.0, 1.0, 1.0, 1.0]), np.ones(4), near).tolist()
    [1.0, 1.0, 1.0, 1.0]
    >>> shrunk_sd(np.array([0.3, 3.0, 1.0, 1.0]), np.ones(4), near).round(1).tolist()
    [1.8, 1.9, 1.8, 1.8]
    >>> shrunk_sd(np.array([1.0, 1.0, 1.0, 900.0]), np.ones(4), near).tolist()
    [1.0, 1.0, 1.0, 900.0]
    """
    others = near - np.diag(np.diag(near))
    if others.sum() < 1.0:
        return sd
    flat = others.ravel()

    def jumps(logs: np.ndarray) -> float:
        apart = np.abs(np.subtract.outer(logs, logs)).ravel()
        rank = np.argsort(apart)
        total = np.cumsum(flat[rank])
        middle = apart[rank][np.searchsorted(total, 0.5 * total[-1])]
        return 0.5 * float(middle / 0.6745) ** 2

    size = np.log(np.maximum(np.abs(level), 1e-12 * float(np.max(np.abs(level))) + 1e-300))
    log = np.log(sd)
    share = size if jumps(log - size) < jumps(log) else np.zeros(sd.size)
    v = jumps(log - share)
    weight = v / (v + 0.5 / (KNOWN_FROM - 1))
    pooled = near @ (log - share) / near.sum(axis=1) + share + LOG_SD_BIAS * min(v, LOG_SD_VARIANCE)
    moved = (1.0 - weight) * log + weight * pooled
    return np.where(log > pooled + np.log(MARKS_UNUSABLE), sd, np.exp(moved))


def fit_noise_model(sd: np.ndarray, level: np.ndarray) -> tuple[float, float]:
    r"""Relative and absolute noise (b, a) that fit standard deviations best, by least absolute error of the logarithm.

    .. math:: s^2 = (b y)^2 + a^2

    Up to half of the standard deviations may be outliers.

    >>> level = np.array([1.0, 10.0, 20.0, 100.0, 400.0])
    >>> [[round(x, 1) for x in fit_noise_model(sd, level)] for sd in (np.hypot(0.1 * level, 2.0), np.full(5, 2.0))]
    [[0.1, 2.0], [0.0, 2.0]]
    """
    size = np.abs(level)
    top = max(float(size.max()), 1e-290)
    crossings = np.geomspace(0.1 * max(float(size.min()), SMALLEST_LEVEL * top), 10.0 * top, CROSSINGS)
    log = np.log(sd / np.hypot(size, crossings[:, None]))
    shares = np.median(log, axis=1)
    best = int(np.argmin(np.abs(log - shares[:, None]).sum(axis=1)))
    relative = float(np.exp(shares[best]))
    return relative, relative * float(crossings[best])


def _neighbours(case: Case, rows: Table) -> np.ndarray:
    """Similarity of the conditions of the readings; it falls with the number of levels between them."""
    distance = np.zeros((len(rows), len(rows)))
    for name in (*(c.name for c in case.kind.columns), "rig", "setup"):
        if name in rows:
            rank = np.unique(rows[name], return_inverse=True)[1].astype(float)
            distance += np.subtract.outer(rank, rank) ** 2
    return np.exp(-0.5 * distance)


def estimated(case: Case, base: np.ndarray, space: Coordinates, values: list[np.ndarray]) -> Case:
    """The case with noise estimated from repeats, else from the residuals of a smooth fit.

    For repeats the most probable mixture of relative and absolute noise is taken. Without them the noise is relative
    where positive readings span a factor of RELATIVE_FROM or more.
    """
    y, group = readings_of(case), repeated(case)
    if group is not None:
        size = np.maximum(np.abs(medians(y, group))[group], 1e-9 * float(np.max(np.abs(y))) + 1e-300)
        if case.kind.logarithmic:
            return with_noise(case, pooled_sd(y / size, group), 0.0)
        return with_noise(case, *_by_size(y, size, group))
    wide = bool(
        np.all(y > 0) and np.all(base > 0) and (case.kind.logarithmic or np.ptp(np.log(y)) > np.log(RELATIVE_FROM))
    )
    if wide:
        return with_noise(case, noise_from_smoothness(np.log(y), np.log(base), space, values), 0.0)
    return with_noise(case, 0.0, noise_from_smoothness(y, base, space, values))


def _by_size(y: np.ndarray, size: np.ndarray, group: np.ndarray) -> tuple[float, float]:
    """Relative and absolute noise that make the repeats most probable."""
    count = np.bincount(group)[group]
    several = count > 1
    left = ((y - medians(y, group)[group]) / np.sqrt(1.0 - 1.0 / np.maximum(count, 2)))[several]
    typical = float(np.median(size[several]))
    best, found = np.inf, (0.0, 0.0)
    spare = float(several.sum() - np.unique(group[several]).size)
    for own, common in PARTS:
        scale = np.hypot(own * size, common * typical)
        share = max(pooled_sd(y / scale, group), 1e-300)
        sd = share * scale[several]
        # Student's t with four degrees of freedom, so that outliers count against a noise that is too small.
        score = spare * float(np.mean(np.log(sd) + 2.5 * np.log1p((left / sd) ** 2 / 4.0))) + MIXTURE_GAIN * (
            own * common > 0
        )
        if score < best:
            best, found = score, (share * own, share * common * typical)
    return found


def noise_from_repeats(case: Case, y: np.ndarray) -> float:
    """Standard deviation from readings at equal conditions; zero when there are fewer than five repeats."""
    group = repeated(case)
    return 0.0 if group is None else pooled_sd(y, group)


def repeated(case: Case) -> np.ndarray | None:
    """Group of each reading by equal conditions, numbered from 0; None for fewer than five repeats."""
    return _groups(case, rows_of(case))


def _groups(case: Case, rows: Table) -> np.ndarray | None:
    names = [*(c.name for c in (*case.kind.columns, *case.kind.instrument_channels)), "rig", "setup"]
    keys = [np.unique(rows[name], return_inverse=True)[1] for name in names if name in rows]
    if not keys:
        return None
    _, group = np.unique(np.stack(keys, axis=1), axis=0, return_inverse=True)
    group = group.reshape(-1)
    return group if group.size - int(group.max()) - 1 >= 5 else None


def nearly_repeated(case: Case) -> np.ndarray | None:
    """Group of each reading by nearly equal conditions: noisy constants are left out, set points are rounded. None if
    all conditions are noisy constants, because readings at one set point are not repeats."""
    rows = rows_of(case)
    columns, varied = {}, False
    conditions = {c.name for c in case.kind.columns}
    for name in rows.columns:
        values = rows[name]
        if values.dtype.kind in "US" or name in PASSING:
            columns[name] = values
            varied |= name in conditions and np.unique(values).size > 1
        elif is_noisy_constant(name, values):
            columns[name] = np.zeros(len(rows))
        else:
            columns[name] = near_values(values)
            varied |= name in conditions and bool(columns[name].any())
    return _groups(case, Table(columns, rows.source)) if varied else None


def medians(y: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Median of the readings of each group."""
    count = np.bincount(group)
    ranked = y[np.lexsort((y, group))]
    first = np.cumsum(count) - count
    return np.asarray(0.5 * (ranked[first + (count - 1) // 2] + ranked[first + count // 2]))


def pooled_sd(y: np.ndarray, group: np.ndarray) -> float:
    r"""Standard deviation within groups (numbered from 0), outliers left out.

    Two readings of a group differ by N(0, 2 sd^2) whatever the group's size, so the median absolute difference is
    sqrt(2) Phi^-1(3/4) sd = 0.9539 sd. Readings further than four times this sd off the median of their group are left
    out (6e-5 of good readings), and the rest is pooled. Below OUTLIERS_FROM repeats the median difference is too
    uncertain to leave anything out.

    >>> y = np.array([1.0, 3.0, 2.0, 3.0, 11.0, 13.0, 12.0, 13.0, 21.0, 23.0, 22.0, 21.0, 31.0, 33.0, 32.0, 90.0])
    >>> round(pooled_sd(y, np.repeat([0, 1, 2, 3], 4)), 3)
    0.965
    """
    count, middle = np.bincount(group), medians(y, group)
    limit = 4.0 * _typical_difference(y, group, count) / 0.9539 * np.sqrt(1.0 - 1.0 / count)
    keep = np.abs(y - middle[group]) <= limit[group]
    if not keep.any() or not limit.any() or group.size - count.size < OUTLIERS_FROM:
        keep = np.ones(y.size, bool)
    _, kept = np.unique(group[keep], return_inverse=True)
    size = np.bincount(kept)
    left = y[keep] - (np.bincount(kept, weights=y[keep]) / size)[kept]
    return float(np.sqrt((left**2).sum() / max(int((size - 1).sum()), 1)))


def _typical_difference(y: np.ndarray, group: np.ndarray, count: np.ndarray) -> float:
    """Median absolute difference of two readings of a group, with groups weighted by their number of repeats."""
    order = np.argsort(group, kind="stable")
    size = count[group[order]]
    start = (np.cumsum(count) - count)[group[order]]
    place = np.arange(y.size) - start
    shifts = np.minimum(size - 1, PARTNERS)
    differences, weights = [], []
    for k in range(int(shifts.max())):
        has = k < shifts
        shift = 1 + k * (size[has] - 1) // shifts[has]
        partner = start[has] + (place[has] + shift) % size[has]
        differences.append(np.abs(y[order][has] - y[order][partner]))
        weights.append((size[has] - 1) / (size[has] * shifts[has]))
    value, weight = np.concatenate(differences), np.concatenate(weights)
    rank = np.argsort(value)
    total = np.cumsum(weight[rank])
    return float(value[rank][np.searchsorted(total, 0.5 * total[-1])])


def successive_difference_sd(series: np.ndarray) -> float:
    """Standard deviation of the white part of a series, from its successive differences.

    >>> noise = np.random.default_rng(1).standard_normal(1000)
    >>> bool(0.9 < successive_difference_sd(noise + np.linspace(0.0, 50.0, 1000)) < 1.1)
    True
    >>> round(successive_difference_sd(np.array([1.0, 1.2, 1.0, 1.2, 1.0, 9.0, 1.0])), 2)
    0.21
    """
    return float(float(np.median(np.abs(np.diff(series)))) * MAD_TO_SD / np.sqrt(2.0))


def noise_from_smoothness(y: np.ndarray, base: np.ndarray, space: Coordinates, values: list[np.ndarray]) -> float:
    """Standard deviation of the residuals of a smooth function of the conditions, without outliers. The function may
    scale and shift the base model. It is the most flexible function with at most half of the degrees of freedom, which
    are subtracted."""
    flat = np.column_stack([np.ones(y.size), base])
    rich = ((0.25, True), (0.25, False), (0.7, False))
    for columns in (
        *(np.hstack([flat, space.columns(values, length, interactions=pairs)]) for length, pairs in rich),
        flat,
    ):
        size = np.linalg.norm(columns, axis=0)
        columns = columns[:, size > 0] / size[size > 0]
        different = len(np.unique(columns.round(12), axis=0))
        sd, spent = _left_over(y, columns)
        if spent <= 0.5 * different:
            break
    return sd


def _left_over(y: np.ndarray, columns: np.ndarray) -> tuple[float, float]:
    """Residual standard deviation of a ridge fit, and its effective number of coefficients."""
    keep = np.ones(y.size, bool)
    sd, spent = float(np.std(y)), 0.0
    ridge = 1e-4 * np.eye(columns.shape[1])
    for _ in range(4):
        used = columns[keep]
        curvature = used.T @ used
        found = np.linalg.solve(curvature + ridge, used.T @ y[keep])
        spent = float(np.trace(np.linalg.solve(curvature + ridge, curvature)))
        left = y - columns @ found
        spare = max(float(keep.sum()) - spent, 0.2 * float(keep.sum()), 1.0)
        sd = float(np.sqrt(np.sum(left[keep] ** 2) / spare))
        keep = np.abs(left) < 4.0 * sd
        if not keep.any():
            break
    return sd, spent
