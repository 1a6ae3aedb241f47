"""The forward model of a case: from calibration and effect parameters to readings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import lru_cache
from operator import is_
from types import MappingProxyType
from typing import Any

import numpy as np

from mixedlub.case.base import Base
from mixedlub.case.flattened import flattened
from mixedlub.case.folder import Case
from mixedlub.case.missing_part import MissingPart, as_effect
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Chain, Model, Parameters, Record, available
from mixedlub.chain.ranges import beyond
from mixedlub.effects import known_effects, known_in
from mixedlub.kinds.calibration import Calibration, calibrations, of_base_law, of_parameter
from mixedlub.kinds.history import assumed, histories
from mixedlub.kinds.kind import ageing, varies
from mixedlub.own_laws import check_usable, columns_read, pasts_read
from mixedlub.schema.findings import Finding, collected, report
from mixedlub.schema.past import Past
from mixedlub.schema.table import Table
from profiles.errors import InputError, nearest


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

    Inputs are built once; ``notes`` lists the assumptions made; ``catalogue``: effects, and laws of the user by id.
    Effects that the case names are part of the base model, and the calibration that it names applies wherever no other
    value is given.
    """

    def __init__(self, case: Case, table: Table, reading_scale: float | None = None) -> None:
        self.case = case
        recorded = table if case.recordings is None else case.recordings
        laws = case.laws if reading_scale is None else {}
        if reading_scale is None and case.system.effects and table is not recorded:
            reading_scale = float(Forward(case, recorded).inputs["reading_scale"])
        with collected() as notes:
            self.table = table = case.kind.fill_channels(table, recorded)
            self._histories: dict[str, np.ndarray] = {}
            self.inputs: dict[str, Any] = case.kind.inputs(case.system, case.rig, table, recorded)
            if "sequence" in self.inputs:
                self.inputs["ageing"] = ageing(recorded, self.inputs["sequence"])
            extra = case.kind.extra_calibration(case.system, recorded)
            self.inputs |= self.columns_of(case.laws.values())
            formulas = case.kind.chain(case.system, table)
            self.base = self._based(formulas)
        self.notes = tuple(notes)
        self.scale = case.kind.scale
        self.chain = self.base.chain
        self.inputs |= self.base.inputs
        self._model = lru_cache(maxsize=1024)(self._build)
        self._shape = (len(table), 1)
        plain = Model(self.chain, tuple(self.inputs), ("reading", *case.kind.base_inputs))(self.inputs)
        if reading_scale is None:
            reading_scale = float(np.median(np.abs(self._rows(plain["reading"])))) / self.scale
        self.inputs["reading_scale"] = reading_scale
        self.inputs |= {name: plain[quantity] for quantity, name in case.kind.base_inputs.items()}
        self.catalogue = MappingProxyType({**known_in(case.kind.effect_kind), **case.laws})
        for law in laws.values():
            check_usable(law, self.chain, self.inputs, "reading", case.kind.name.replace("_", " "))
        self.known = known_effects(
            case.system.effects, case.kind.effect_kind, formulas, tuple(self.inputs), "reading", case.laws
        )
        if case.missing is not None:
            self._add(case.missing)
        self.uncertain_laws = tuple(
            e for e in self.catalogue.values() if any(p.base_sd for p in e.parameters) and self._offers(e)
        )
        self.calibrations: tuple[Calibration, ...] = (
            *(
                self.base.moved(c)
                for c in (*calibrations(case.system), *extra)
                if all(n in self.inputs for n in c.needs)
            ),
            *self.base.calibrations,
            *map(self._of_effect, self.known.sds),
            *(of_base_law(e, p) for e in self.uncertain_laws for p in e.parameters if p.base_sd),
        )
        self._check_calibration()

    def _based(self, formulas: Chain) -> Base:
        """The base that the case names; full solutions cover its recordings and conditions."""
        case = self.case
        base = flattened(case.kind, case.system, case.rig, self.table, formulas)
        if case.system.base == "formulas":
            return base
        from mixedlub.case.full_base import full_base

        tables = [t for t in (case.recordings, case.conditions) if t is not None] or [self.table]
        full = full_base(case.kind, case.system, case.rig, tables, base.chain, self.inputs)
        inputs, contained = {**base.inputs, **full.inputs}, (*base.contained, *full.contained)
        return replace(full, inputs=inputs, contained=contained)

    def with_laws(self, case: Case) -> Forward:
        """The same rows of a case that has further laws."""
        found = copy(self)
        found.case = case
        found.inputs = {**self.inputs, **self.columns_of(case.laws.values())}
        found.catalogue = MappingProxyType({**self.catalogue, **case.laws})
        found._model = lru_cache(maxsize=1024)(found._build)
        return found

    def columns_of(self, laws: Iterable[Effect]) -> dict[str, Any]:
        """Columns of the rows that laws read, and the history of conditions, as inputs."""
        laws = tuple(laws)
        pasts = pasts_read(laws, self.case.kind.numbers)
        note = self.assumed_history(pasts)
        if note is not None:
            report(note)
        return columns_read(laws, {**self.table.columns, **self.histories(pasts)})

    def histories(self, pasts: Iterable[Past]) -> dict[str, np.ndarray]:
        """History coordinates of the rows by name, within the recording of the case."""
        pasts = tuple(pasts)
        new = [past for past in pasts if past.name not in self._histories]
        self._histories |= histories(new, self.table, self._recorded, self.case.kind.is_history)
        return {past.name: self._histories[past.name] for past in pasts if past.name in self._histories}

    def assumed_history(self, pasts: Iterable[Past]) -> Finding | None:
        """Report the history that rows beside the recording are given."""
        return assumed(pasts, self.table, self._recorded, self.case.kind.is_history)

    @property
    def _recorded(self) -> Table:
        return self.table if self.case.recordings is None else self.case.recordings

    def _add(self, missing: MissingPart) -> None:
        """Make a table of the missing part an effect of the base model."""
        effect = as_effect(missing.is_share)
        unit = 1.0 if missing.is_share else self.scale
        self.inputs[effect.reads[0]] = missing.at(self.table)[:, None] / unit
        self.known = replace(self.known, effects=(*self.known.effects, effect))

    def _of_effect(self, place: tuple[str, str]) -> Calibration:
        """Calibration of a parameter with a standard deviation stated in the case."""
        effect, name = place
        e = next(e for e in self.known.effects if e.id == effect)
        return of_parameter(e, name, self.known.values[effect][name], self.known.sds[place])

    def _check_calibration(self) -> None:
        """Raise an error for a calibration in the case file that does not exist in the case."""
        names = [c.name for c in self.calibrations]
        for name in self.case.system.calibration:
            if name not in names:
                hint = nearest(name, names) if names else "all its inputs count as known"
                raise InputError(f"is not calibrated in this case; {hint}", where="calibration", value=name)

    def _build(self, effects: tuple[str, ...]) -> Model:
        return self.model(("reading",), [self.catalogue[e] for e in effects])

    def model(self, want: Sequence[str], effects: Sequence[Effect] = (), further: Chain = ()) -> Model:
        """Base model of the case with more effects, and ``further`` laws after its laws."""
        added = {e.id: e for e in (*self.known.effects, *self.uncertain_laws, *effects)}
        return Model((*self.chain, *further), tuple(self.inputs), want, tuple(added.values()))

    def _rows(self, reading: np.ndarray) -> np.ndarray:
        """Readings in the unit of the recorded column, one per row."""
        reading = np.asarray(reading)
        column = reading[:, 0] if reading.shape == self._shape else np.broadcast_to(reading, self._shape)[:, 0]
        return np.asarray(column * self.scale)

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
        """Predict and keep the steps; with a run ``near`` of the same effects, only changed steps are recomputed."""
        calibration = {**self.case.system.calibration, **(calibration or {})}
        inputs, applied = self._calibrated(calibration, near)
        model = self._model(tuple(sorted(parameters or {})))
        every = {**self.known_values(calibration), **(parameters or {})}
        # A law of the user may overflow far out in its prior, where a search only needs to see that it is not finite.
        with np.errstate(all="ignore" if self.case.laws else None):
            record = model.record(inputs, every, None if near is None else near.record)
        return Run(self._rows(record["reading"]), record, applied, inputs)

    def _calibrated(
        self, calibration: Mapping[str, float], near: Run | None
    ) -> tuple[Mapping[str, Any], Mapping[str, Move]]:
        """Inputs at a calibration, and the moves applied; taken from the run ``near`` if equal there."""
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

    def known_values(self, calibration: Mapping[str, float]) -> dict[str, dict[str, float]]:
        """Parameters of the effects that the case names, and of uncertain base laws, at a calibration."""
        values = {effect: dict(own) for effect, own in self.known.values.items()}
        for e, name in self.known.sds:
            values[e][name] = calibration.get(f"{e}.{name}", values[e][name])
        for law in self.uncertain_laws:
            moved = {p.name: calibration.get(f"{law.id}.{p.name}", p.null_value) for p in law.parameters if p.base_sd}
            values[law.id] = {**law.nulls, **moved}
        return values

    def effects(self, exclude: Sequence[str] = ()) -> tuple[Effect, ...]:
        """Effects of the catalogue that apply to these rows, with the parameters that are free in this kind."""
        return tuple(e for e in self.catalogue.values() if e.id not in exclude and self._offers(e))

    def _offers(self, e: Effect) -> bool:
        """Whether an effect applies to these rows beside those that the case names."""
        return (
            e.id not in self.known.values
            and e.id not in self.base.contained
            and available(e, self.chain, tuple(self.inputs), "reading", self.case.kind.effect_kind)
            and (not e.needs_variation_in or varies(self.inputs[e.needs_variation_in]))
            and self._within(e)
        )

    def _within(self, e: Effect) -> bool:
        """Whether most rows are within the range in which an effect is offered."""
        values = {name: self.base_quantity(name) for name in e.offered_within}
        return bool(np.mean(~beyond(values, e.offered_within)) > 0.5)
