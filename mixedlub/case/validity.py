"""Range of a case: rows of a table outside the valid range of the laws of its model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from inspect import signature
from typing import Any

import numpy as np

from mixedlub.base_model.limits import contact_limits, law_limits, of_bearing_asperities
from mixedlub.case.forward import Forward
from mixedlub.chain.model import Chain, Parameters
from mixedlub.chain.ranges import Reached, farthest_beyond, findings, flags, validity
from mixedlub.laws.contact import asperity_load_ratio, asperity_real_pressure
from mixedlub.laws.film import film_over_contact_width
from mixedlub.laws.load import carries_load
from mixedlub.laws.oil import kinematic
from mixedlub.schema.findings import Finding, Severity

CHECKS: Chain = (
    ("kinematic_viscosity", kinematic),
    ("film_over_contact_width", film_over_contact_width),
    ("asperity_load_ratio", asperity_load_ratio),
    ("asperity_real_pressure", asperity_real_pressure),
)
"""Judged quantities without influence on any reading."""
OF_BASE_MODEL = ("asperities_overloaded", "asperities_above_hardness")
"""Codes that are notes here: the base model of a recording has no balance of load, so most rough surfaces have them."""


@dataclass(frozen=True, eq=False)
class Judged:
    """Limits of a model with the values of the rows of a table, NaN within the range."""

    reached: Reached
    count: int
    source: str

    @property
    def words(self) -> np.ndarray:
        """The column validity: `valid`, or the worst grade and the codes behind it."""
        return validity(flags(self.reached, (self.count,)), (self.count,))

    @property
    def findings(self) -> tuple[Finding, ...]:
        """A finding on each code, the gravest first."""
        said = findings(self.reached, (self.count,), "rows", self.source)
        return tuple(replace(one, severity=Severity.NOTE) if one.code in OF_BASE_MODEL else one for one in said)


def judge_rows(
    forward: Forward, parameters: Parameters | None = None, calibration: Mapping[str, float] | None = None
) -> Judged:
    """Judge the rows of a model, with effects at these parameters beside the effects that the case names."""
    calibration = {**forward.case.system.calibration, **(calibration or {})}
    values = {**forward.known_values(calibration), **(parameters or {})}
    added = [forward.catalogue[name] for name in parameters or {}]
    inputs = forward.run(calibration, parameters).inputs
    steps = forward.model(("reading",), added).steps
    made = {*inputs, *(name for name, _ in forward.chain)}
    checks = tuple((name, law) for name, law in CHECKS if made.issuperset(signature(law).parameters))
    made |= {name for name, _ in checks}
    effects = (*forward.known.effects, *added)
    limits = (*contact_limits(inputs, [one.id for one in effects]), *law_limits(steps, effects, values))
    limits = tuple(limit for limit in limits if limit.quantity in made)
    wanted = {limit.quantity for limit in limits} | ({"line_load"} & made)
    with np.errstate(all="ignore"):
        state = dict(forward.model(tuple(wanted), added, checks)(inputs, values))
    if (real := "asperity_real_pressure") in wanted:
        state[real] = of_bearing_asperities(state[real], state["asperity_load_ratio"])
    where = _judged(inputs, state)
    count = len(forward.table)
    found = [(one, _points(state[one.quantity]), where) for one in limits]
    if forward.case.missing is not None:
        found += [(one, values, np.ones(1, bool)) for one, values in forward.case.missing.reached(forward.table)]
    reached = [(one, _of_rows(farthest_beyond(values, one.ends, at), count)) for one, values, at in found]
    return Judged(reached, count, forward.table.source)


def _judged(inputs: Mapping[str, Any], state: Mapping[str, Any]) -> np.ndarray:
    """Points that decide about a range: with gears in, and loaded."""
    load = state.get("line_load", inputs.get("load", 1.0))
    return carries_load(np.abs(_points(load))) & (_points(inputs.get("gears_fitted", 1.0)) > 0.0)


def _points(values: Any) -> np.ndarray:
    """Values of the shape (rows or 1, points or 1)."""
    return np.atleast_2d(np.asarray(values, dtype=float))


def _of_rows(values: np.ndarray, count: int) -> np.ndarray:
    return np.broadcast_to(values, (count, 1))[:, 0]
