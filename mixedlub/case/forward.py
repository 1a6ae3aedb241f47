"""The forward model of a case: from calibration and effect parameters to readings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from operator import is_
from typing import Any

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Model, Parameters, Record, available
from mixedlub.effects import known_in
from mixedlub.kinds.calibration import Calibration, calibrations
from mixedlub.kinds.kind import ageing, varies
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Table
from profiles.errors import InputError


@dataclass(frozen=True, eq=False)
class Move:
    """One applied calibration: its value, the inputs it was applied to, and the inputs it changed."""

    value: float
    on: tuple[Any, ...]
    changes: Mapping[str, Any]

    def is_of(self, value: float, on: tuple[Any, ...]) -> bool:
        """Whether this value was applied to the same input objects."""
        return self.value == value and all(map(is_, self.on, on))


@dataclass(frozen=True, eq=False)
class Run:
    """A prediction with the quantities that lead to it, and the calibration applied to the inputs."""

    prediction: np.ndarray
    record: Record
    applied: Mapping[str, Move]
    inputs: Mapping[str, Any]


class Forward:
    """Predicts the rows of a table under any set of effects.

    Inputs are built once; ``notes`` lists the assumptions made.
    """

    def __init__(self, case: Case, table: Table, reading_scale: float | None = None) -> None:
        self.case = case
        recorded = table if case.recordings is None else case.recordings
        with collected() as notes:
            self.table = table = case.kind.fill_channels(table, recorded)
            self.inputs: dict[str, Any] = case.kind.inputs(case.system, case.rig, table, recorded)
            if "sequence" in self.inputs:
                self.inputs["ageing"] = ageing(recorded, self.inputs["sequence"])
            extra = case.kind.extra_calibration(case.system, recorded)
        self.notes = tuple(notes)
        self.scale = case.kind.scale
        self.chain = case.kind.chain(case.system, table)
        self.calibrations: tuple[Calibration, ...] = tuple(
            c for c in (*calibrations(case.system), *extra) if all(n in self.inputs for n in c.needs)
        )
        self._model = lru_cache(maxsize=1024)(self._build)
        self._shape = (len(table), 1)
        self.inputs["reading_scale"] = 1.0
        if reading_scale is None:
            reading_scale = float(np.median(np.abs(self.predict()))) / self.scale
        self.inputs["reading_scale"] = reading_scale
        if case.kind.base_inputs:
            base = Model(self.chain, tuple(self.inputs), tuple(case.kind.base_inputs))(self.inputs)
            self.inputs |= {name: base[quantity] for quantity, name in case.kind.base_inputs.items()}

    def _build(self, effects: tuple[str, ...]) -> Model:
        known = known_in(self.case.kind.name)
        return Model(self.chain, tuple(self.inputs), ("reading",), [known[e] for e in effects])

    def predict(
        self, calibration: Mapping[str, float] | None = None, parameters: Parameters | None = None
    ) -> np.ndarray:
        """Readings in the unit of the recorded column, one per row."""
        return self.run(calibration, parameters).prediction

    def base_quantity(self, name: str) -> np.ndarray:
        """A quantity of the base model before calibration, by its glossary name."""
        if name in self.inputs:
            return np.asarray(self.inputs[name])
        return np.asarray(Model(self.chain, tuple(self.inputs), (name,))(self.inputs)[name])

    def base_prediction(self) -> np.ndarray:
        """Readings of the base model at nominal calibration, one per row; a result that is not finite is an error."""
        base = self.predict()
        if not np.isfinite(base).all():
            run = int(self.table["run"][~np.isfinite(base)][0])
            raise InputError(
                "the base model has no finite answer for this run's conditions; look for a number far out of range",
                where=f"{self.case.folder / self.table.source}: {self.case.quantity}, run",
                value=run,
            )
        return base

    def run(
        self,
        calibration: Mapping[str, float] | None = None,
        parameters: Parameters | None = None,
        near: Run | None = None,
    ) -> Run:
        """Predict and keep the steps; given a run ``near`` with the same effects, only changed steps are recomputed."""
        inputs, applied = self._calibrated(calibration or {}, near)
        model = self._model(tuple(sorted(parameters or {})))
        record = model.record(inputs, parameters, None if near is None else near.record)
        reading = np.asarray(record["reading"])
        column = reading[:, 0] if reading.shape == self._shape else np.broadcast_to(reading, self._shape)[:, 0]
        return Run(column * self.scale, record, applied, inputs)

    def _calibrated(
        self, calibration: Mapping[str, float], near: Run | None
    ) -> tuple[Mapping[str, Any], Mapping[str, Move]]:
        """The inputs at a calibration, and how it was applied; both of the run ``near`` by if that has the same."""
        if near is not None and {name: move.value for name, move in near.applied.items()} == calibration:
            return near.inputs, near.applied
        inputs, applied = dict(self.inputs), {}
        for c in self.calibrations:
            if c.name in calibration:
                value, on = calibration[c.name], tuple(inputs[name] for name in c.needs)
                move = None if near is None else near.applied.get(c.name)
                if move is None or not move.is_of(value, on):
                    move = Move(value, on, c.apply(inputs, value))
                applied[c.name] = move
                inputs.update(move.changes)
        return inputs, applied

    def effects(self, exclude: Sequence[str] = ()) -> tuple[Effect, ...]:
        """Effects of the catalogue that apply to these rows, with the parameters that are free in this kind."""
        return tuple(
            e
            for e in known_in(self.case.kind.name).values()
            if e.id not in exclude
            and available(e, self.chain, tuple(self.inputs), "reading", self.case.kind.name)
            and (not e.needs_variation_in or varies(self.inputs[e.needs_variation_in]))
        )
