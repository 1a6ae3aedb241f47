"""The inference problem of a case: readings, their noise, and predictions in standard-normal coordinates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward, Run
from mixedlub.chain.effect import Effect
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.effects import catalogue, known_in
from mixedlub.recording.correlated_error import STILL, Wander
from mixedlub.recording.noise import seen_noise
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.table import Table

STEP = 1e-4
"""Step of the differences, in prior standard deviations: far above rounding, far below what laws curve by."""
REACH = 4.5
"""Largest coordinate, in prior standard deviations: beyond it a prior says never."""
LEAST = 1e-30
"""Smallest prediction whose logarithm is taken."""
TRIFLE = 0.1
"""Share of its reading below which a prediction is no size to take noise by."""


@dataclass(frozen=True, eq=False)
class Problem:
    """Readings y with standard deviation sd, and the forward model of the rows they were taken at.

    Kinds that span decades are seen by the logarithm: ``y``, ``sd`` and every prediction are then those of
    ln(reading); ``level`` gives readings back.

    Every unknown has a standard-normal prior: calibration and effect parameters through their priors'
    ``value``, errors shared within a set-up as columns of ``setups`` (in sigmas), and those that ``wander`` in time.
    ``held`` are parameters of effects that are not unknown. Where noise lasts, so that ``together`` readings tell as
    much as one, ``sd`` is that of a reading times the root of it.
    """

    case: Case
    rows: Table
    forward: Forward
    y: np.ndarray
    sd: np.ndarray
    setups: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    held: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    together: float = 1.0
    wander: Wander = STILL

    @classmethod
    def of(cls, case: Case, forward: Forward | None = None, together: float = 1.0, wander: Wander = STILL) -> Problem:
        """The problem of a recording whose noise is known; with its ``forward`` model if that was built before."""
        rows, y = rows_of(case), readings_of(case)
        forward = Forward(case, rows) if forward is None else forward
        sd, setups = seen_noise(case, rows, y, forward.predict())
        one = cls(case, rows, forward, np.log(y) if case.kind.logarithmic else y, sd, setups, wander=wander)
        return one.with_together(together)

    @cached_property
    def shared(self) -> np.ndarray:
        """Columns, in sigmas, of all errors that several readings share."""
        return np.hstack([self.setups, self.wander.columns(self.rows) / np.sqrt(self.together)])

    @property
    def one_sd(self) -> np.ndarray:
        """Standard deviation of a single reading."""
        return self.sd / np.sqrt(self.together)

    def of_one(self, residual: np.ndarray) -> np.ndarray:
        """A residual in standard deviations of a single reading."""
        return np.sqrt(self.together) * residual

    def with_together(self, together: float) -> Problem:
        """The same problem where so many readings tell as much as one."""
        times = np.sqrt(together / self.together)
        return replace(self, sd=times * self.sd, setups=self.setups / times, together=together)

    def seen(self, level: np.ndarray) -> np.ndarray:
        """Readings as they are compared."""
        return np.log(np.maximum(level, LEAST)) if self.case.kind.logarithmic else level

    def level(self, seen: np.ndarray) -> np.ndarray:
        """Readings in the unit of their column."""
        return np.exp(seen) if self.case.kind.logarithmic else seen

    def unit_size(self, seen: np.ndarray) -> np.ndarray:
        """Change of a reading, in its unit, for a change of one in what is compared."""
        return np.abs(self.level(seen)) if self.case.kind.logarithmic else np.ones(seen.size)

    @property
    def calibration_size(self) -> int:
        """How many inputs calibration may move."""
        return len(self.forward.calibrations)

    def effects(self, explanation: Explanation) -> list[Effect]:
        """The effects an explanation names, with the parameters that are unknown here."""
        known = known_in(self.case.kind.name)
        every = (known[name] for name in explanation.effects)
        return [e.holding(self.held[e.id]) if e.id in self.held else e for e in every]

    def size(self, explanation: Explanation) -> int:
        """Length of the coordinate vector of an explanation."""
        return self.calibration_size + sum(len(e.parameters) for e in self.effects(explanation))

    def calibration(self, z: np.ndarray) -> dict[str, float]:
        """Calibration values at coordinates z."""
        names = self.forward.calibrations
        return {c.name: c.parameter.prior.value(float(x)) for c, x in zip(names, z[: len(names)], strict=True)}

    def parameters(self, explanation: Explanation, z: np.ndarray) -> dict[str, dict[str, float]]:
        """Effect parameters at coordinates z."""
        values, start = {}, self.calibration_size
        for e in self.effects(explanation):
            stop = start + len(e.parameters)
            values[e.id] = e.values(z[start:stop])
            start = stop
        return values

    def run(self, explanation: Explanation, z: np.ndarray, near: Run | None = None) -> Run:
        """Predicted readings at coordinates z, with the steps that lead there."""
        run = self.forward.run(self.calibration(z), self.parameters(explanation, z), near)
        return replace(run, prediction=self.seen(run.prediction)) if self.case.kind.logarithmic else run

    def predict(self, explanation: Explanation, z: np.ndarray) -> np.ndarray:
        """Predicted readings at coordinates z."""
        return self.run(explanation, z).prediction

    def base(self, z: np.ndarray) -> np.ndarray:
        """Predicted readings at the same calibration with nothing added."""
        return self.seen(self.forward.predict(self.calibration(z)))

    def jacobian(self, explanation: Explanation, z: np.ndarray, at: Run | None = None) -> np.ndarray:
        """Derivative of predictions over sd with respect to z, by differences to the side where laws do not end."""
        here = self.run(explanation, z) if at is None else at
        slopes = np.empty((self.y.size, z.size))
        for i in range(z.size):
            for step in (STEP, -STEP) if z[i] < REACH else (-STEP, STEP):
                moved = z.copy()
                moved[i] += step
                change = self.run(explanation, moved, here).prediction - here.prediction
                slopes[:, i] = change / (self.sd * step)
                if np.isfinite(change).all():
                    break
        slopes[~np.isfinite(slopes)] = 0.0
        return slopes

    def noise_size(self, prediction: np.ndarray) -> np.ndarray:
        """The size that noise goes by, in the unit of the column: a prediction, or a reading far above it."""
        size, reading = np.abs(self.level(prediction)), np.abs(self.level(self.y))
        return np.where(size < TRIFLE * reading, reading, size)

    def with_sd(self, prediction: np.ndarray, base: np.ndarray) -> Problem:
        """The same problem with the noise taken at the size of a prediction instead of the readings.

        A prediction far below its reading, as of a part rig that the model has nothing for, is no size to go by. The
        errors of set-ups are shares of the calibrated ``base``: of what fits better they would be its shape for free.
        """
        size = self.noise_size(prediction)
        sd, setups = seen_noise(self.case, self.rows, size, self.level(base))
        return replace(self, sd=sd, setups=setups, together=1.0).with_together(self.together)

    def take(self, rows: np.ndarray) -> Problem:
        """The problem on some of its rows."""
        table = self.rows.take(rows)
        forward = Forward(self.case, table, float(self.forward.inputs["reading_scale"]))
        setups = self.setups[rows]
        setups = setups[:, np.any(setups != 0, axis=0)]
        return replace(self, rows=table, forward=forward, y=self.y[rows], sd=self.sd[rows], setups=setups)

    def spread(self, rows: np.ndarray) -> Problem:
        """The problem on a share of its rows from all over: the farther apart they are, the less noise lasts."""
        return self.take(rows).with_together(1.0 + (self.together - 1.0) * len(rows) / self.y.size)


def effects_of(ids: Iterable[str]) -> list[Effect]:
    """Effects of the catalogue by id, with all their parameters."""
    known = catalogue()
    return [known[name] for name in ids]
