"""Readings with the wrong sign: friction at equal conditions has one sign."""

from __future__ import annotations

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.recording.conditions import is_noisy_constant
from mixedlub.recording.set_points import near_values
from mixedlub.schema.findings import Finding, finding, listed
from mixedlub.schema.table import Table

CLOCKS = ("sequence", "time_s")
AS_LARGE = (0.67, 1.5)
"""Judgement. Range of the size ratio of two readings that differ in sign only."""
SMALL_READING = 0.5
"""Judgement. Part of the median size below which a reading is small."""
FEW_SMALL = 0.1
"""Judgement. Share of small readings above which readings scatter about zero."""
RUNS_LISTED = 5
"""Judgement. Runs that a message lists at most: more are not read."""


def of_other_sign(case: Case, rows: Table, y: np.ndarray, sd: np.ndarray) -> np.ndarray:
    """Readings with a sign opposite to equally large readings at the same conditions; up to ``sd`` they count as
    zero."""
    group, moves = _points(case, rows), _moves(case, rows)
    wrong = _against_others(y, group, moves & (np.abs(y) > sd))
    size = np.abs(y[moves & np.isin(group, np.unique(group[wrong]))])
    about_zero = size.size > 0 and np.mean(size < SMALL_READING * np.median(size)) > FEW_SMALL
    return np.zeros(y.size, bool) if about_zero else wrong


def both_signs(case: Case, rows: Table, y: np.ndarray, wrong: np.ndarray) -> list[Finding]:
    """Finding on the readings of ``wrong`` sign."""
    count = int(wrong.sum())
    if not count:
        return []
    sign = "negative" if np.all(y[wrong] < 0.0) else "positive" if np.all(y[wrong] > 0.0) else "of the other sign"
    statement = (
        f"{count} reading{' is' if count == 1 else 's are'} {sign} where others at the same conditions are as large"
    )
    channels = f"the signs of {case.quantity} and of the speed" if case.kind.direction is not None else "the sign"
    runs = f"run{'' if count == 1 else 's'} {listed(rows['run'][wrong].tolist(), RUNS_LISTED)}"
    text = f"{case.quantity} has both signs: {statement} with the opposite one: check {channels} ({runs})"
    return [finding("sign_contradictory", text)]


def _against_others(y: np.ndarray, group: np.ndarray, large: np.ndarray) -> np.ndarray:
    """Readings of the rarer sign in their group (negative in a tie), as large as the readings of the other sign.

    >>> y = np.array([0.1, -0.1, 0.11, 0.1, -0.01, -0.2])
    >>> np.flatnonzero(_against_others(y, np.array([0, 0, 0, 1, 1, 2]), np.ones(6, bool))).tolist()
    [1]
    """
    wrong = np.zeros(y.size, bool)
    for one in np.unique(group[large & (y < 0.0)]):
        inside = np.flatnonzero(large & (group == one))
        up, down = inside[y[inside] > 0.0], inside[y[inside] < 0.0]
        rarer, others = (up, down) if 0 < up.size < down.size else (down, up)
        if others.size:
            share = np.abs(y[rarer]) / np.median(np.abs(y[others]))
            wrong[rarer[(share > AS_LARGE[0]) & (share < AS_LARGE[1])]] = True
    return wrong


def _points(case: Case, rows: Table) -> np.ndarray:
    """Number of the operating point of each reading; jitter and time are ignored."""
    keys = [np.zeros(len(rows), dtype=int)]
    for name in (*(column.name for column in case.kind.columns), "rig", "setup"):
        if name not in rows or name in CLOCKS:
            continue
        values = rows[name]
        if values.dtype.kind in "US":
            keys.append(np.unique(values, return_inverse=True)[1].reshape(-1))
        elif not is_noisy_constant(name, values):
            keys.append(near_values(values))
    return np.unique(np.column_stack(keys), axis=0, return_inverse=True)[1].reshape(-1)


def _moves(case: Case, rows: Table) -> np.ndarray:
    """Readings with a direction of friction: a drive at rest may be held either way."""
    return np.ones(len(rows), bool) if case.kind.direction is None else case.kind.direction(rows) != 0.0
