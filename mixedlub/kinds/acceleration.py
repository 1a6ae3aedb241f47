"""Angular acceleration of a drive, from its logged speed."""

from __future__ import annotations

import numpy as np

from mixedlub.schema.table import Table

COLUMN = "acceleration_rad_s2"
"""Column that holds the derived acceleration of the rows."""
FEWEST = 30
"""Judgement. Readings from which a table of times and speeds may be a log of a moving machine."""
LONGEST_STEP = 5.0
"""Judgement. Time (s) between readings above which a machine is rather read at steady speeds, one after the other."""
WINDOWS = (5, 9, 17, 33)
"""Grid. Readings of the local parabola, the fewest that give a clear acceleration."""
CLEAR = 0.1
"""Judgement. Noise of a clear acceleration over its largest size; a random order of speeds is never clear."""
MOVES = 0.05
"""Judgement. Acceleration over the largest from which a machine changes speed; less is noise of a steady one."""
CORNER = 5.0
"""Judgement. Misfit of a parabola over the typical one from which it lies across a sudden change of acceleration."""


def stretches(table: Table) -> np.ndarray:
    """Number of the stretch of each row: rows of one set-up in a row with a clock that does not fall back.

    >>> rows = Table({"time_s": np.array([0.0, 1.0, 2.0, 0.0, 1.0]), "setup": np.array(["a", "a", "b", "b", "b"])})
    >>> stretches(rows).tolist()
    [0, 0, 1, 2, 2]
    """
    begins = np.zeros(len(table), bool)
    if "time_s" in table:
        begins[1:] |= np.diff(table["time_s"]) < 0.0
    if "setup" in table:
        begins[1:] |= table["setup"][1:] != table["setup"][:-1]
    return np.cumsum(begins)


def accelerated(table: Table, recorded: Table) -> Table:
    """The table with the angular acceleration of its rows, if the recording is a log of a machine that changes speed.

    Rows outside the recorded times, or without a time, are taken at steady speed.
    """
    if COLUMN in table or not {"time_s", "speed_rpm"} <= set(recorded.columns):
        return table
    found = np.zeros(len(table))
    clear = False
    parts = stretches(recorded)
    for part in np.unique(parts):
        rows = np.flatnonzero(parts == part)
        time, speed = recorded["time_s"][rows], recorded["speed_rpm"][rows] * np.pi / 30.0
        slope = _slope(time, speed)
        if slope is None:
            continue
        clear = True
        if "time_s" not in table:
            continue
        own = (table["time_s"] >= time[0]) & (table["time_s"] <= time[-1])
        if "setup" in table and "setup" in recorded:
            own &= table["setup"] == recorded["setup"][rows[0]]
        found[own] = np.interp(table["time_s"][own], time, slope)
    return Table({**table.columns, COLUMN: found}, table.source) if clear else table


def _slope(time: np.ndarray, speed: np.ndarray) -> np.ndarray | None:
    """Slope of local parabolas through logged speeds; None if the speed is steady, scattered or seldom read.

    >>> t = np.linspace(0.0, 10.0, 41)
    >>> bool(np.allclose(_slope(t, 3.0 * t**2), 6.0 * t)), _slope(t, np.full(41, 2.0)), _slope(100.0 * t, t)
    (True, None, None)
    """
    if time.size < FEWEST or np.any(np.diff(time) <= 0.0) or np.median(np.diff(time)) > LONGEST_STEP:
        return None
    for count in WINDOWS:
        if count > time.size:
            return None
        slope, noise = _local(time, speed, count)
        largest = float(np.quantile(np.abs(slope), 0.95))
        if largest * float(np.ptp(time)) > 0.02 * float(np.max(np.abs(speed))) and noise <= CLEAR * largest:
            return slope
    return None


def _local(time: np.ndarray, speed: np.ndarray, count: int) -> tuple[np.ndarray, float]:
    """Slopes of the parabola through the ``count`` nearest readings, and their typical noise.

    Across a corner of the speed, as where a motor is switched off, the parabola to one side replaces it.

    >>> _local(np.arange(12.0), np.abs(np.arange(12.0) - 5.5), 5)[0].round(6).tolist()
    [-1.0, -1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    """
    centred = np.arange(time.size) - count // 2
    slope, misfit, noise = _parabolas(time, speed, centred, count)
    # A speed that stands still is logged without any scatter.
    moves = np.abs(slope) > MOVES * np.max(np.abs(slope))
    corner = misfit > CORNER * np.median(misfit[moves])
    least = np.where(corner, misfit, 0.0)
    for first in (centred - count // 2, centred + count // 2):
        aside, left, _ = _parabolas(time, speed, first, count)
        better = left < least
        slope, least = np.where(better, aside, slope), np.where(better, left, least)
    return slope, float(np.median(noise[moves]))


def _parabolas(
    time: np.ndarray, speed: np.ndarray, first: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Slope at each reading, misfit and noise of the slope of parabolas through ``count`` readings from the first."""
    rows = np.clip(first, 0, time.size - count)[:, None] + np.arange(count)
    off = time[rows] - time[:, None]
    scale = np.max(np.abs(off), axis=1)[:, None]
    powers = np.stack([np.ones_like(off), off / scale, (off / scale) ** 2], axis=2)
    solve = np.linalg.pinv(powers)
    fitted = np.einsum("nij,nj->ni", solve, speed[rows])
    left = speed[rows] - np.einsum("nji,ni->nj", powers, fitted)
    sd = np.sqrt(np.sum(left**2, axis=1) / (count - 3))
    return fitted[:, 1] / scale[:, 0], sd, sd * np.linalg.norm(solve[:, 1, :], axis=1) / scale[:, 0]
