"""How much a reading scatters: as stated, as repeats show, or as a smooth fit leaves over."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.recording.conditions import PASSING, Coordinates, is_noisy_constant
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.recording.set_points import near_values
from mixedlub.schema import system_file
from mixedlub.schema.table import Table

FEW = 30
"""Tests from which an sd counts as known: its own scatter is then 13 %."""
FAR_ABOVE = 5.0
"""Times its like from which an sd marks a reading to be ignored."""
LOW, HIGHEST = 0.52, 1.23
"""Mean of ln s below that of the true sd over the variance of ln s, and that variance, both of two tests."""
SEVERAL = 2000
"""Most readings whose sds are compared with one another: beyond, the wild ones even out."""
WIDE = 3.0
"""Ratio of the largest to the smallest reading from which noise goes in proportion where nothing else tells."""
TRUSTED = 10
"""Repeats from which a wild one among them can be told."""
PARTS = ((1.0, 0.0), (1.0, 0.03), (1.0, 0.1), (1.0, 0.3), (1.0, 1.0), (0.3, 1.0), (0.0, 1.0))
"""Shares of a reading's own size and of the typical one in its noise that are tried."""
BOTH = 2.0
"""What both parts of a noise have to gain over one of them, in log probability."""
PARTNERS = 12
"""Readings of its group that each one is compared with, at most."""
CROSSINGS, SMALLEST = 121, 1e-6
"""Levels at which noise that is alike for all may be as large as that in proportion, and the smallest over the top."""


def is_stated(case: Case) -> bool:
    """Whether the recording says how much its readings scatter."""
    stated = case.system.recording.noise
    return f"{case.quantity}_sd" in rows_of(case) or (stated is not None and stated.of_single)


def setups_differ(case: Case) -> bool:
    """Whether the recording says how much a set-up is off as a whole."""
    stated = case.system.recording.noise
    return stated is not None and stated.of_setups


def with_noise(case: Case, relative: float, absolute: float) -> Case:
    """The case with other noise of a single reading than it states."""
    noise = (case.system.recording.noise or system_file.Noise()).model_copy(
        update={"relative": float(relative), "absolute": float(absolute)}
    )
    recording = case.system.recording.model_copy(update={"noise": noise})
    return replace(case, system=case.system.model_copy(update={"recording": recording}))


def seen_noise(
    case: Case, rows: Table, level: np.ndarray, expected: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """`noise` of readings as they are compared: relative where that is by the logarithm."""
    if case.kind.logarithmic:
        sd, shared = noise(case, rows, level)
        return sd / np.abs(level), shared
    return noise(case, rows, level, expected)


def noise(
    case: Case, rows: Table, level: np.ndarray, expected: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviation of each reading and, in sigmas, the columns of errors shared within a set-up.

    ``level`` is the size of the readings. Relative errors of a set-up are shares of what the model ``expected``,
    calibrated or not: as shares of the readings they would stand in for a model of any form.
    """
    quantity = case.quantity
    stated = case.system.recording.noise
    if f"{quantity}_sd" in rows:
        sd = rows[f"{quantity}_sd"].astype(float)
        if sd.size <= SEVERAL:
            sd = steadied(sd, level, _neighbours(case, rows))
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


def steadied(sd: np.ndarray, level: np.ndarray, near: np.ndarray) -> np.ndarray:
    r"""Standard deviations that jump between like readings were estimated from few tests: each takes in the others'.

    .. math:: \ln s_i \leftarrow (1-w) \ln s_i + w \left(\frac{\sum_j K_{ij} \ln s_j}{\sum_j K_{ij}} + 0.52 v\right)
              ,\quad w = \frac{v}{v + v_0}

    ``near`` (n, n) weighs how alike the conditions of two readings are, one for the same; v is half the squared
    jump of ln s between like readings, from its median. Of n tests the logarithm of an sd scatters by a variance
    1/(2(n - 1)), and lies 0.5 to 0.8 of that below the true one's; v_0 is that of FEW tests. What goes smoothly
    stays as stated, and so does an sd more than FAR_ABOVE its like: few tests do not give that, it marks a reading
    to be ignored.
    Moderation of variances by their like: G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004) 3.

    >>> near = np.ones((4, 4))
    >>> steadied(np.array([1.0, 1.0, 1.0, 1.0]), np.ones(4), near).tolist()
    [1.0, 1.0, 1.0, 1.0]
    >>> steadied(np.array([0.3, 3.0, 1.0, 1.0]), np.ones(4), near).round(1).tolist()
    [1.8, 1.9, 1.8, 1.8]
    >>> steadied(np.array([1.0, 1.0, 1.0, 900.0]), np.ones(4), near).tolist()
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
    weight = v / (v + 0.5 / (FEW - 1))
    pooled = near @ (log - share) / near.sum(axis=1) + share + LOW * min(v, HIGHEST)
    moved = (1.0 - weight) * log + weight * pooled
    return np.where(log > pooled + np.log(FAR_ABOVE), sd, np.exp(moved))


def by_level(sd: np.ndarray, level: np.ndarray) -> tuple[float, float]:
    r"""Noise in proportion to the level and noise that is alike for all, as standard deviations show.

    .. math:: s^2 = (b y)^2 + a^2

    The form whose logarithm lies the least off, so that up to a half of them may be of another kind.

    >>> level = np.array([1.0, 10.0, 20.0, 100.0, 400.0])
    >>> [[round(x, 1) for x in by_level(sd, level)] for sd in (np.hypot(0.1 * level, 2.0), np.full(5, 2.0))]
    [[0.1, 2.0], [0.0, 2.0]]
    """
    size = np.abs(level)
    top = max(float(size.max()), 1e-290)
    crossings = np.geomspace(0.1 * max(float(size.min()), SMALLEST * top), 10.0 * top, CROSSINGS)
    log = np.log(sd / np.hypot(size, crossings[:, None]))
    shares = np.median(log, axis=1)
    best = int(np.argmin(np.abs(log - shares[:, None]).sum(axis=1)))
    relative = float(np.exp(shares[best]))
    return relative, relative * float(crossings[best])


def _neighbours(case: Case, rows: Table) -> np.ndarray:
    """How alike the conditions of the readings are: falls with the number of levels between them."""
    distance = np.zeros((len(rows), len(rows)))
    for name in (*(c.name for c in case.kind.columns), "rig", "setup"):
        if name in rows:
            rank = np.unique(rows[name], return_inverse=True)[1].astype(float)
            distance += np.subtract.outer(rank, rank) ** 2
    return np.exp(-0.5 * distance)


def estimated(case: Case, base: np.ndarray, space: Coordinates, values: list[np.ndarray]) -> Case:
    """The case with the noise its readings show: from repeats, else from what a smooth fit leaves over.

    Repeats scatter alike, in proportion to their size, or by both, whichever makes them most probable. Without them
    positive readings that span WIDE or more are taken to scatter in proportion.
    """
    y, group = readings_of(case), repeated(case)
    if group is not None:
        size = np.maximum(np.abs(medians(y, group))[group], 1e-9 * float(np.max(np.abs(y))) + 1e-300)
        if case.kind.logarithmic:
            return with_noise(case, pooled_sd(y / size, group), 0.0)
        return with_noise(case, *_by_size(y, size, group))
    wide = bool(np.all(y > 0) and np.all(base > 0) and (case.kind.logarithmic or np.ptp(np.log(y)) > np.log(WIDE)))
    if wide:
        return with_noise(case, noise_from_smoothness(np.log(y), np.log(base), space, values), 0.0)
    return with_noise(case, 0.0, noise_from_smoothness(y, base, space, values))


def _by_size(y: np.ndarray, size: np.ndarray, group: np.ndarray) -> tuple[float, float]:
    """Noise in proportion to size and noise that is alike for all, as makes the repeats most probable."""
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
        # Student's t with four degrees of freedom: readings that a noise leaves far off count against it.
        score = spare * float(np.mean(np.log(sd) + 2.5 * np.log1p((left / sd) ** 2 / 4.0))) + BOTH * (own * common > 0)
        if score < best:
            best, found = score, (share * own, share * common * typical)
    return found


def noise_from_repeats(case: Case, y: np.ndarray) -> float:
    """Standard deviation from readings at equal conditions; zero when there are fewer than five repeats."""
    group = repeated(case)
    return 0.0 if group is None else pooled_sd(y, group)


def repeated(case: Case) -> np.ndarray | None:
    """Group of each reading by equal conditions, numbered from 0; None where fewer than five are repeats."""
    return _groups(case, rows_of(case))


def _groups(case: Case, rows: Table) -> np.ndarray | None:
    names = [*(c.name for c in (*case.kind.columns, *case.kind.channels)), "rig", "setup"]
    keys = [np.unique(rows[name], return_inverse=True)[1] for name in names if name in rows]
    if not keys:
        return None
    _, group = np.unique(np.stack(keys, axis=1), axis=0, return_inverse=True)
    group = group.reshape(-1)
    return group if group.size - int(group.max()) - 1 >= 5 else None


def nearly_repeated(case: Case) -> np.ndarray | None:
    """The same by conditions that are equal but for what they jitter about their set-points.

    None where all of them jitter: readings at one set-point are no repeats of what was to be told.
    """
    rows = rows_of(case)
    columns, told = {}, False
    conditions = {c.name for c in case.kind.columns}
    for name in rows.columns:
        values = rows[name]
        if values.dtype.kind in "US" or name in PASSING:
            columns[name] = values
            told |= name in conditions and np.unique(values).size > 1
        elif is_noisy_constant(name, values):
            columns[name] = np.zeros(len(rows))
        else:
            columns[name] = near_values(values)
            told |= name in conditions and bool(columns[name].any())
    return _groups(case, Table(columns, rows.source)) if told else None


def medians(y: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Median of the readings of each group."""
    count = np.bincount(group)
    ranked = y[np.lexsort((y, group))]
    first = np.cumsum(count) - count
    return np.asarray(0.5 * (ranked[first + (count - 1) // 2] + ranked[first + count // 2]))


def pooled_sd(y: np.ndarray, group: np.ndarray) -> float:
    r"""Standard deviation within groups (numbered from 0), outliers left out.

    Two readings of a group differ by N(0, 2 sd^2) whatever the group's size, so the median absolute difference is
    sqrt(2) Phi^-1(3/4) sd = 0.9539 sd. Readings beyond four times what that gives, off the median of their group,
    are left out (6e-5 of good ones), and the rest pooled. Below TRUSTED repeats that median is too uncertain to
    leave anything out by.

    >>> y = np.array([1.0, 3.0, 2.0, 3.0, 11.0, 13.0, 12.0, 13.0, 21.0, 23.0, 22.0, 21.0, 31.0, 33.0, 32.0, 90.0])
    >>> round(pooled_sd(y, np.repeat([0, 1, 2, 3], 4)), 3)
    0.965
    """
    count, middle = np.bincount(group), medians(y, group)
    limit = 4.0 * _typical_difference(y, group, count) / 0.9539 * np.sqrt(1.0 - 1.0 / count)
    keep = np.abs(y - middle[group]) <= limit[group]
    if not keep.any() or not limit.any() or group.size - count.size < TRUSTED:
        keep = np.ones(y.size, bool)
    _, kept = np.unique(group[keep], return_inverse=True)
    size = np.bincount(kept)
    left = y[keep] - (np.bincount(kept, weights=y[keep]) / size)[kept]
    return float(np.sqrt((left**2).sum() / max(int((size - 1).sum()), 1)))


def _typical_difference(y: np.ndarray, group: np.ndarray, count: np.ndarray) -> float:
    """Median absolute difference of two readings of a group, each group weighing as much as it has repeats."""
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


def noise_from_smoothness(y: np.ndarray, base: np.ndarray, space: Coordinates, values: list[np.ndarray]) -> float:
    """Standard deviation of what a smooth function of the conditions leaves over, outliers set aside.

    The function may scale and shift the base model. It is the richest that uses up no more than half of what
    the different conditions can tell; the count of what it used up is taken off.
    """
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
    """Standard deviation that a ridge fit leaves over, and how many coefficients it used up."""
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
