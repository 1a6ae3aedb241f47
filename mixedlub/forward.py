"""The forward problem of a case: calibration and effect parameters in, readings out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from mixedlub.calibration import Calibration, calibrations
from mixedlub.case import Case, noted
from mixedlub.chain import Model, available
from mixedlub.effect import Effect, catalogue
from mixedlub.kinds.kind import SCALE
from mixedlub.table import Table

Parameters = Mapping[str, Mapping[str, float]]


class Forward:
    """Predicts the rows of a table under any set of effects.

    Inputs are laid out once; ``notes`` says what had to be assumed for that.
    """

    def __init__(self, case: Case, table: Table, reading_scale: float | None = None) -> None:
        self.case = case
        self.table = table
        notes: list[str] = []
        with noted(notes):
            self.inputs: dict[str, Any] = case.kind.inputs(case.system, case.folder, table)
        self.notes = tuple(notes)
        self.scale = SCALE[case.quantity]
        self.chain = case.kind.chain(case.system)
        extra = case.kind.extra_calibration(case.system, table)
        self.calibrations: tuple[Calibration, ...] = tuple(
            c for c in (*calibrations(case.system), *extra) if all(n in self.inputs for n in c.needs)
        )
        for c in extra:
            self.inputs.update(c.apply(self.inputs, c.nominal))
        self._model = lru_cache(maxsize=1024)(self._build)
        self.inputs["reading_scale"] = 1.0
        if reading_scale is None:
            reading_scale = float(np.median(np.abs(self.predict()))) / self.scale
        self.inputs["reading_scale"] = reading_scale

    def _build(self, effects: tuple[str, ...]) -> Model:
        known = catalogue()
        return Model(self.chain, tuple(self.inputs), ("reading",), [known[e] for e in effects])

    def predict(
        self, calibration: Mapping[str, float] | None = None, parameters: Parameters | None = None
    ) -> np.ndarray:
        """Readings in the unit of the recorded column, one a row."""
        inputs = self.inputs
        if calibration:
            changes: dict[str, Any] = {}
            for c in self.calibrations:
                if c.name in calibration:
                    changes.update(c.apply(inputs, calibration[c.name]))
            inputs = {**inputs, **changes}
        ids = tuple(sorted(parameters or {}))
        reading = np.asarray(self._model(ids)(inputs, parameters)["reading"])
        return np.broadcast_to(reading, (len(self.table), 1))[:, 0] * self.scale

    def effects(self, exclude: Sequence[str] = ()) -> tuple[Effect, ...]:
        """Effects of the catalogue that these rows could show."""
        return tuple(
            e
            for e in catalogue().values()
            if e.id not in exclude and available(e, self.chain, tuple(self.inputs), "reading", self.case.kind.name)
        )
