"""The inference problem of a case: readings, their noise, and predictions in standard-normal coordinates."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward, Run
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Parameters
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.settings.inference import FINITE_STEP, MOST_COORDINATE, NOISE_BY_READING_BELOW, SMALLEST_READING
from mixedlub.effects import catalogue
from mixedlub.recording.correlated_error import UNCORRELATED, CorrelatedError
from mixedlub.recording.noise import transformed_noise
from mixedlub.recording.readings import readings_of, rows_of
from mixedlub.schema.table import Table


@dataclass(frozen=True, eq=False)
class Problem:
    """Readings y with standard deviation sd, and the forward model of their rows.

    Kinds that span decades are transformed: ``y``, ``sd`` and every prediction then refer to ln(reading), and
    ``inverse`` returns readings.

    Every unknown has a standard-normal prior: calibration and effect parameters through their priors' ``value``, errors
    shared within a set-up as columns of ``setups`` (in units of sd), and the ``correlated_error``. ``fixed`` are values
    of effect parameters that are not free. ``n_per_effective`` autocorrelated readings count as one, and ``sd`` is the
    noise of a reading times the root of this number.
    """

    case: Case
    rows: Table
    forward: Forward
    y: np.ndarray
    sd: np.ndarray
    setups: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    fixed: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    n_per_effective: float = 1.0
    correlated_error: CorrelatedError = UNCORRELATED

    @classmethod
    def of(
        cls,
        case: Case,
        forward: Forward | None = None,
        n_per_effective: float = 1.0,
        correlated_error: CorrelatedError = UNCORRELATED,
    ) -> Problem:
        """Problem of a recording with known noise; ``forward`` is its model if built before."""
        rows, y = rows_of(case), readings_of(case)
        forward = Forward(case, rows) if forward is None else forward
        sd, setups = transformed_noise(case, rows, y, forward.predict())
        one = cls(
            case,
            rows,
            forward,
            np.log(y) if case.kind.logarithmic else y,
            sd,
            setups,
            correlated_error=correlated_error,
        )
        return one.with_n_per_effective(n_per_effective)

    @cached_property
    def shared(self) -> np.ndarray:
        """Columns, in units of sd, of all errors shared by readings."""
        return np.hstack([self.setups, self.correlated_error.columns(self.rows) / np.sqrt(self.n_per_effective)])

    @property
    def single_sd(self) -> np.ndarray:
        """Standard deviation of a single reading."""
        return self.sd / np.sqrt(self.n_per_effective)

    def single_reading_units(self, residual: np.ndarray) -> np.ndarray:
        """A residual in standard deviations of a single reading."""
        return np.sqrt(self.n_per_effective) * residual

    def with_n_per_effective(self, n_per_effective: float) -> Problem:
        """The same problem with another number of readings per effective reading."""
        times = np.sqrt(n_per_effective / self.n_per_effective)
        return replace(self, sd=times * self.sd, setups=self.setups / times, n_per_effective=n_per_effective)

    def transform(self, reading: np.ndarray) -> np.ndarray:
        """Readings in the transformed scale of the comparison."""
        return np.log(np.maximum(reading, SMALLEST_READING)) if self.case.kind.logarithmic else reading

    def inverse(self, transformed: np.ndarray) -> np.ndarray:
        """Readings in the unit of their column, from transformed ones."""
        return np.exp(transformed) if self.case.kind.logarithmic else transformed

    def d_inverse(self, seen: np.ndarray) -> np.ndarray:
        """Derivative of a reading with respect to its transform."""
        return np.abs(self.inverse(seen)) if self.case.kind.logarithmic else np.ones(seen.size)

    @property
    def calibration_size(self) -> int:
        """Number of calibrated inputs."""
        return len(self.forward.calibrations)

    def effects(self, explanation: Explanation) -> list[Effect]:
        """Effects of an explanation, with their free parameters."""
        if explanation not in self._effects:
            every = self.effects_of(explanation.effects)
            self._effects[explanation] = [e.fixing(self.fixed[e.id]) if e.id in self.fixed else e for e in every]
        return self._effects[explanation]

    @cached_property
    def _effects(self) -> dict[Explanation, list[Effect]]:
        return {}

    def effects_of(self, ids: Iterable[str]) -> list[Effect]:
        """Effects of the catalogue and laws of the user by id."""
        return [self.forward.catalogue[name] for name in ids]

    def size(self, explanation: Explanation) -> int:
        """Length of the coordinate vector of an explanation."""
        return self.calibration_size + sum(len(e.parameters) for e in self.effects(explanation))

    def calibration(self, z: np.ndarray, without: Collection[str] = ()) -> dict[str, float]:
        """Calibration values at coordinates z, except corrections to base laws replaced by the effects ``without``."""
        free = zip(self.forward.calibrations, z[: self.calibration_size], strict=True)
        return {c.name: c.parameter.prior.value(float(x)) for c, x in free if c.base_law not in without}

    def own_coordinates(self, explanation: Explanation, z: np.ndarray) -> dict[str, np.ndarray]:
        """Coordinates of each effect of an explanation."""
        values, start = {}, self.calibration_size
        for e in self.effects(explanation):
            stop = start + len(e.parameters)
            values[e.id] = z[start:stop]
            start = stop
        return values

    def parameters(self, explanation: Explanation, z: np.ndarray) -> dict[str, dict[str, float]]:
        """Effect parameters at coordinates z."""
        own = self.own_coordinates(explanation, z)
        return {e.id: e.values(own[e.id]) for e in self.effects(explanation)}

    def run(self, explanation: Explanation, z: np.ndarray, near: Run | None = None) -> Run:
        """Predicted readings at coordinates z, with the steps of the chain."""
        return self._run(self.calibration(z), self.parameters(explanation, z), near)

    def _run(self, calibration: Mapping[str, float], parameters: Parameters, near: Run | None) -> Run:
        run = self.forward.run(calibration, parameters, near)
        return replace(run, prediction=self.transform(run.prediction)) if self.case.kind.logarithmic else run

    def predict(self, explanation: Explanation, z: np.ndarray, near: Run | None = None) -> np.ndarray:
        """Predicted readings at coordinates z."""
        return self.run(explanation, z, near).prediction

    def base(self, z: np.ndarray) -> np.ndarray:
        """Predicted readings of the base model at the calibration in coordinates z."""
        return self.transform(self.forward.predict(self.calibration(z)))

    def jacobian(
        self, explanation: Explanation, z: np.ndarray, at: Run | None = None, near: np.ndarray | None = None
    ) -> np.ndarray:
        """Derivative of predictions over sd with respect to z, by one-sided differences within the range of the laws.

        With a derivative ``near`` by, its columns of small corrections to base laws are reused, as they hardly change.
        """
        here = self.run(explanation, z) if at is None else at
        calibration, parameters = self.calibration(z), self.parameters(explanation, z)
        priors = [(calibration, c.parameter) for c in self.forward.calibrations]
        priors += [(parameters[e.id], p) for e in self.effects(explanation) for p in e.parameters]
        slopes = np.empty((self.y.size, z.size))
        small = {i for i, c in enumerate(self.forward.calibrations) if c.base_law}
        for i, (values, parameter) in enumerate(priors):
            if near is not None and i in small:
                slopes[:, i] = near[:, i]
                continue
            kept = values[parameter.name]
            for step in (FINITE_STEP, -FINITE_STEP) if z[i] < MOST_COORDINATE else (-FINITE_STEP, FINITE_STEP):
                values[parameter.name] = parameter.prior.value(float(z[i] + step))
                change = self._run(calibration, parameters, here).prediction - here.prediction
                slopes[:, i] = change / (self.sd * step)
                if np.isfinite(change).all():
                    break
            values[parameter.name] = kept
        slopes[~np.isfinite(slopes)] = 0.0
        return slopes

    def noise_size(self, prediction: np.ndarray) -> np.ndarray:
        """Size to which relative noise applies, in the unit of the column: a prediction, or a reading far above it."""
        size, reading = np.abs(self.inverse(prediction)), np.abs(self.inverse(self.y))
        return np.where(size < NOISE_BY_READING_BELOW * reading, reading, size)

    def with_sd(self, prediction: np.ndarray, base: np.ndarray) -> Problem:
        """The same problem with relative noise taken from a prediction instead of the readings.

        A prediction far below its reading, as of a part rig that the model lacks, is not used. Relative errors of
        set-ups apply to the calibrated ``base``: applied to a better fit they would add its form as a free error.
        """
        size = self.noise_size(prediction)
        sd, setups = transformed_noise(self.case, self.rows, size, self.inverse(base))
        return replace(self, sd=sd, setups=setups, n_per_effective=1.0).with_n_per_effective(self.n_per_effective)

    def take(self, rows: np.ndarray) -> Problem:
        """The problem on some of its rows."""
        table = self.rows.take(rows)
        forward = Forward(self.case, table, float(self.forward.inputs["reading_scale"]))
        setups = self.setups[rows]
        setups = setups[:, np.any(setups != 0, axis=0)]
        return replace(self, rows=table, forward=forward, y=self.y[rows], sd=self.sd[rows], setups=setups)

    def subset(self, rows: np.ndarray) -> Problem:
        """The problem on a subset of the whole recording: distant readings are less autocorrelated."""
        return self.take(rows).with_n_per_effective(1.0 + (self.n_per_effective - 1.0) * len(rows) / self.y.size)


def effects_of(ids: Iterable[str]) -> list[Effect]:
    """Effects of the catalogue by id, with all their parameters; laws of the user are left out."""
    known = catalogue()
    return [known[name] for name in ids if name in known]
