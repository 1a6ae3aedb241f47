"""Steps of a condition as evidence: whether readings jump where it was changed, and relax afterwards."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mixedlub.diagnosis.labels import amount, words_of
from mixedlub.diagnosis.settings.assessment import CLEAR_JUMP, MOST_OF_STEPS, RELAXED, STEPS_LISTED
from mixedlub.kinds.acceleration import stretches
from mixedlub.kinds.steps import HELD, steps
from mixedlub.recording.conditions import PASSING
from mixedlub.schema.findings import Finding, finding, listed
from mixedlub.schema.table import Table


def mismatch_at_steps(rows: Table, names: list[str], residual: np.ndarray) -> list[Finding]:
    """One finding for each condition at whose steps the ``residual`` of the calibrated base model (sigma) jumps.

    >>> z = np.concatenate([np.zeros(20), 20.0 * np.exp(-np.arange(20.0) / 4.0)])
    >>> table = Table({"run": np.arange(40), "time_s": np.arange(40.0), "load_N": np.repeat([10.0, 20.0], 20)})
    >>> print(mismatch_at_steps(table, ["load_N"], z)[0].text)
    the mismatch begins at the step of load from 10 N to 20 N (run 20), jumps by +20 sigma and relaxes within about 3 \
readings
    """
    found = []
    for name in names:
        seen = [_answer(residual[part], row, end, place) for part, row, end, place in _steps(rows, name)]
        jumped = [one for one in seen if abs(one[1]) > CLEAR_JUMP]
        if jumped and len(jumped) >= MOST_OF_STEPS * len(seen):
            found.append(finding("mismatch_at_step", _told(rows, name, len(seen), jumped)))
    return found


def outliers_after_steps(rows: Table, names: list[str], wrong: np.ndarray, residual: np.ndarray) -> bool:
    """Whether readings on one side right after most steps of a condition, of two steps or more, count as outliers.

    >>> wrong = np.isin(np.arange(60), [20, 21, 22, 40, 41, 42])
    >>> table = Table({"run": np.arange(60), "time_s": np.arange(60.0), "load_N": np.repeat([9.0, 20.0, 9.0], 20)})
    >>> [outliers_after_steps(table, ["load_N"], one, np.ones(60)) for one in (wrong, wrong[::-1])]
    [True, False]
    """
    side = np.sign(residual) * wrong
    for name in names:
        after = [side[of_part[row : row + HELD]] for of_part, row, _, _ in _steps(rows, name)]
        taken = sum(bool(one[0]) and bool(np.all(one == one[0])) for one in after)
        if taken > 1 and taken >= MOST_OF_STEPS * len(after):
            return True
    return False


def _steps(rows: Table, name: str) -> list[tuple[np.ndarray, int, int, int]]:
    """Steps of a condition: the rows of its stretch, place of the step in it and of the next one, and its row."""
    if "time_s" not in rows or name not in rows or name in PASSING or rows[name].dtype.kind in "US":
        return []
    parts, found = stretches(rows), []
    for part in np.unique(parts):
        of_part = np.flatnonzero(parts == part)
        for row, end in pairwise([*steps(rows[name][of_part]).tolist(), of_part.size]):
            found.append((of_part, row, end, int(of_part[row])))
    return found


def _answer(residual: np.ndarray, row: int, end: int, place: int) -> tuple[int, float, int]:
    """Row of a step, jump of the residual there, and readings in which half of the jump is gone (0: it stays)."""
    before = float(np.median(residual[row - HELD : row]))
    after = residual[row:end]
    jump = float(after[0]) - before
    late = float(np.median(after[-max(after.size // 3, HELD) :]))
    if abs(jump) < CLEAR_JUMP:
        jump = float(np.median(after[:HELD])) - before
    if (after[0] - late) * np.sign(jump) < RELAXED * abs(jump):
        return place, jump, 0
    halfway = np.abs(after - late) < 0.5 * abs(float(after[0]) - late)
    return place, jump, int(np.argmax(halfway))


def _told(rows: Table, name: str, count: int, jumped: list[tuple[int, float, int]]) -> str:
    """Sentence on the steps at which a residual jumps."""
    first, jump, _ = jumped[0]
    runs = listed([int(rows["run"][place]) for place, _, _ in jumped], STEPS_LISTED)
    of = f"from {amount(float(rows[name][first - 1]), name)} to {amount(float(rows[name][first]), name)}"
    which = (
        f"the step of {words_of(name)} {of} (run {runs})"
        if count == 1
        else f"{len(jumped)} of {count} steps of {words_of(name)} (runs {runs})"
    )
    relaxed = [readings for _, _, readings in jumped if readings]
    then = (
        f" and relaxes within about {int(np.median(relaxed))} readings"
        if 2 * len(relaxed) > len(jumped)
        else " and stays there"
    )
    size = f"{jump:+.2g} sigma" + ("" if len(jumped) == 1 else " at the first")
    return f"the mismatch begins at {which}, jumps by {size}{then}"
