"""Scaling of a discrepancy: relative to the reading, additive, or a free factor on a quantity of the chain."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mixedlub.case.forward import Forward, Run
from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.priors import Normal
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.discrepancy import NO_INFLUENCE
from mixedlub.diagnosis.settings.inference import FINITE_STEP
from mixedlub.recording.conditions import clock_of

READING, ADDITIVE = "reading", "addition"
THERMAL_LAG = "late_temperature"
"""Change of the readings at the temperature of the step before: its form is a constant."""
TEMPERATURES = ("oil_temperature_C", "temperature_C")
"""Columns of a temperature that may lag."""
QUANTITIES = ("film_thickness", "shear_stress", "area_ratio", "boundary_friction", "line_load", "running_friction")

Scalings = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class TypicalSizes:
    """Units of a discrepancy over a recording: medians of reading over sd, and of sd."""

    share: float
    sd: float

    @classmethod
    def of(cls, problem: Problem, base: Run) -> TypicalSizes:
        """The units of a recording, from a run of the base model."""
        share = share_of(problem, base)
        return cls(float(np.median(share[share > 0.0])) if share.any() else 1.0, float(np.median(problem.sd)))


def scalings_of(problem: Problem, base: Run, typical: TypicalSizes) -> dict[str, np.ndarray]:
    """Change of each reading in standard deviations: for a relative unit, an additive unit, a factor e on a quantity.

    ``base`` is a run of the base model. Quantities without influence on the readings are left out.
    """
    every = {name: scaling_of(problem, base, typical, name) for name in (READING, ADDITIVE, THERMAL_LAG, *QUANTITIES)}
    return {name: each for name, each in every.items() if np.max(np.abs(each)) > NO_INFLUENCE}


def scaling_of(problem: Problem, base: Run, typical: TypicalSizes, name: str) -> np.ndarray:
    """A single scaling; zero if the reading does not depend on it or is not finite."""
    if name == ADDITIVE:
        return typical.sd / problem.sd
    if name == THERMAL_LAG:
        return np.nan_to_num(thermal_lag(problem, base) / problem.sd)
    if name == READING:
        return np.nan_to_num(share_of(problem, base) / typical.share)
    slope = log_slope(problem, base, name)
    return np.zeros(problem.y.size) if slope is None else np.nan_to_num(slope / problem.sd, posinf=0.0, neginf=0.0)


def thermal_lag(problem: Problem, base: Run) -> np.ndarray:
    """Change of the readings if the oil temperature lagged by one median time step; zero without a known order.

    The temperature before a row is taken from the recording, also for rows of other tables. After a pause the step is a
    small part of the change since.
    """
    rows, order = problem.rows, clock_of(problem.rows)
    name = next((n for n in TEMPERATURES if n in rows and np.ptp(rows[n]) > 0.0), None)
    if order is None or name is None:
        return np.zeros(problem.y.size)
    tables = [rows]
    if problem.case.recordings is not None and clock_of(problem.case.recordings) is not None:
        tables.append(problem.case.recordings)
    clock, first = np.unique(np.concatenate([clock_of(t) for t in tables]), return_index=True)
    warmth = np.concatenate([t[name] for t in tables])[first]
    before = np.maximum(np.searchsorted(clock, order) - 1, 0)
    gap = np.maximum(order - clock[before], np.median(np.diff(clock)))
    step = (warmth[before] - rows[name]) * np.median(np.diff(clock)) / gap
    table = problem.case.kind.with_condition(rows, name, rows[name] + step)
    lagged = Forward(problem.case, table, float(problem.forward.inputs["reading_scale"]))
    values = {name: move.value for name, move in base.applied.items()}
    return problem.transform(lagged.predict(values)) - base.prediction


def share_of(problem: Problem, base: Run) -> np.ndarray:
    """First-order change of the transformed reading by a factor e, in standard deviations."""
    if problem.case.kind.logarithmic:
        return 1.0 / problem.sd
    return np.abs(base.prediction) / problem.sd


def log_slope(problem: Problem, base: Run, name: str) -> np.ndarray | None:
    """Derivative of transformed readings at run ``base`` by the log of a quantity; None if the chain lacks it."""
    forward, inputs = problem.forward, base.inputs
    if name not in forward.inputs and name not in {step for step, _ in forward.chain}:
        return None
    model = forward.model(("reading",), (_free_factor(name),))
    moved = np.asarray(model(inputs, {**base.record.values, "free_factor": {"log_factor": FINITE_STEP}})["reading"])
    slope = (moved - np.asarray(base.record["reading"])) / FINITE_STEP * forward.scale
    return np.asarray(np.broadcast_to(slope, (problem.y.size, 1))[:, 0] / problem.d_inverse(base.prediction))


def _free_factor(name: str) -> Effect:
    def factor(quantity: np.ndarray, *, log_factor: float) -> np.ndarray:
        return quantity * np.exp(log_factor)

    return Effect(
        name="free_factor",
        law=factor,
        stage="property",
        acts_on=(name,),
        parameters=(Parameter("log_factor", "-", Normal(0.0, 1.0), "logarithm of the free factor", null=0.0),),
        fingerprint={},
        separated_by="",
    )
