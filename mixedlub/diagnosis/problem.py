"""The inference problem of a case: readings, their noise, and predictions in standard-normal coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mixedlub.case import Case
from mixedlub.effect import Effect, catalogue
from mixedlub.forward import Forward
from mixedlub.table import Table

Explanation = tuple[str, ...]
"""Effect ids in order; empty for "none"."""

STEP = 1e-4
REACH = 4.5


@dataclass(frozen=True, eq=False)
class Problem:
    """Readings y with standard deviation sd, and the forward model of the rows they were taken at.

    Every unknown has a standard-normal prior: calibration and effect parameters through their priors'
    ``value``, errors shared within a set-up as columns of ``shared`` (in sigmas).
    """

    case: Case
    rows: Table
    forward: Forward
    y: np.ndarray
    sd: np.ndarray
    shared: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def calibration_size(self) -> int:
        """How many inputs calibration may move."""
        return len(self.forward.calibrations)

    def size(self, explanation: Explanation) -> int:
        """Length of the coordinate vector of an explanation."""
        return self.calibration_size + sum(len(e.parameters) for e in effects_of(explanation))

    def calibration(self, z: np.ndarray) -> dict[str, float]:
        """Calibration values at coordinates z."""
        names = self.forward.calibrations
        return {c.name: c.parameter.prior.value(float(x)) for c, x in zip(names, z[: len(names)], strict=True)}

    def parameters(self, explanation: Explanation, z: np.ndarray) -> dict[str, dict[str, float]]:
        """Effect parameters at coordinates z."""
        values, start = {}, self.calibration_size
        for e in effects_of(explanation):
            stop = start + len(e.parameters)
            values[e.id] = e.values(z[start:stop])
            start = stop
        return values

    def predict(self, explanation: Explanation, z: np.ndarray) -> np.ndarray:
        """Predicted readings at coordinates z."""
        return self.forward.predict(self.calibration(z), self.parameters(explanation, z))

    def base(self, z: np.ndarray) -> np.ndarray:
        """Predicted readings at the same calibration with nothing added."""
        return self.forward.predict(self.calibration(z))

    def jacobian(
        self, explanation: Explanation, z: np.ndarray, at: np.ndarray, columns: Sequence[int] | None = None
    ) -> np.ndarray:
        """Derivative of predictions over sd with respect to z, by forward differences."""
        columns = range(z.size) if columns is None else columns
        slopes = np.empty((self.y.size, len(columns)))
        for place, i in enumerate(columns):
            moved = z.copy()
            moved[i] += STEP if z[i] < REACH else -STEP
            slopes[:, place] = (self.predict(explanation, moved) - at) / (self.sd * (moved[i] - z[i]))
        return slopes

    def with_sd(self, prediction: np.ndarray) -> Problem:
        """The same problem with the noise taken at the size of a prediction instead of the readings."""
        sd, shared = noise(self.case, self.rows, self.y, prediction)
        return Problem(self.case, self.rows, self.forward, self.y, sd, shared)

    def take(self, rows: np.ndarray) -> Problem:
        """The problem on some of its rows."""
        table = self.rows.take(rows)
        forward = Forward(self.case, table, float(self.forward.inputs["reading_scale"]))
        used = self.shared[rows]
        return Problem(self.case, table, forward, self.y[rows], self.sd[rows], used[:, np.any(used != 0, axis=0)])


def effects_of(explanation: Explanation) -> list[Effect]:
    """The effects an explanation names."""
    known = catalogue()
    return [known[name] for name in explanation]


def noise(case: Case, rows: Table, y: np.ndarray, level: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviation of each reading and, in sigmas, the columns of errors shared within a set-up."""
    quantity = case.quantity
    stated = case.system.recording.noise
    if f"{quantity}_sd" in rows:
        sd = rows[f"{quantity}_sd"].astype(float)
    elif stated is not None and (stated.relative > 0 or stated.absolute > 0):
        sd = np.hypot(stated.relative * np.abs(level), stated.absolute)
    else:
        sd = np.full(y.size, max(noise_from_repeats(rows, y), 1e-12 * float(np.max(np.abs(y)) or 1.0)))
    floor = 1e-6 * float(np.median(np.abs(y))) + 1e-300
    sd = np.maximum(sd, floor)
    shared = np.zeros((y.size, 0))
    if stated is not None and "setup" in rows and (stated.setup_relative > 0 or stated.setup_absolute > 0):
        names = np.unique(rows["setup"])
        member = (rows["setup"][:, None] == names[None, :]).astype(float)
        columns = []
        if stated.setup_relative > 0:
            columns.append(member * (stated.setup_relative * level / sd)[:, None])
        if stated.setup_absolute > 0:
            columns.append(member * (stated.setup_absolute / sd)[:, None])
        shared = np.hstack(columns)
    return sd, shared


def noise_from_repeats(rows: Table, y: np.ndarray) -> float:
    """Standard deviation from readings at equal conditions; zero when there are fewer than five repeats."""
    skip = {"run", "sequence"}
    keys = [
        np.unique(column, return_inverse=True)[1]
        for name, column in rows.columns.items()
        if name not in skip and not np.array_equal(column, y)
    ]
    if not keys:
        return 0.0
    _, group = np.unique(np.stack(keys, axis=1), axis=0, return_inverse=True)
    group = group.reshape(-1)
    count = np.bincount(group)
    mean = np.bincount(group, weights=y) / count
    left = y - mean[group]
    spare = int((count - 1).sum())
    return float(np.sqrt((left**2).sum() / spare)) if spare >= 5 else 0.0
