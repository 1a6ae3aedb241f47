"""What an unnamed mismatch may ride on: the reading, nothing, or one quantity of the chain times a free factor."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.chain import Model
from mixedlub.diagnosis.problem import Problem
from mixedlub.effect import Effect, Normal, Parameter

READING, NOTHING = "reading", "nothing"
QUANTITIES = ("film_thickness", "shear_stress", "area_ratio", "boundary_friction", "line_load")
STEP = 1e-4
LEAST = 1e-9

Carriers = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Typical:
    """Sizes over a recording by which a mismatch is counted: medians of reading over sd and of sd."""

    share: float
    sd: float

    @classmethod
    def of(cls, problem: Problem, z: np.ndarray) -> Typical:
        """Those of a recording at the calibration z."""
        share = np.abs(problem.predict((), z)) / problem.sd
        return cls(float(np.median(share)), float(np.median(problem.sd)))


def carriers(problem: Problem, z: np.ndarray, typical: Typical) -> dict[str, np.ndarray]:
    """Sigmas by which each reading moves: for a share of itself, for one typical sd, for a factor e on a quantity.

    ``z`` is the calibration.
    """
    share = np.abs(problem.predict((), z)) / problem.sd
    found = {READING: share / typical.share, NOTHING: typical.sd / problem.sd}
    for name in QUANTITIES:
        slope = log_slope(problem, z, name)
        if slope is not None:
            found[name] = slope / problem.sd
    return found


def log_slope(problem: Problem, z: np.ndarray, name: str) -> np.ndarray | None:
    """Change of the readings, as compared, with the logarithm of a quantity of the chain, all along the path.

    None where the chain lacks the quantity or the readings do not hang on it.
    """
    forward = problem.forward
    if name not in forward.inputs and name not in {step for step, _ in forward.chain}:
        return None
    inputs = calibrated_inputs(problem, z)
    model = Model(forward.chain, tuple(inputs), ("reading",), (_free_factor(name),))
    here = np.asarray(model(inputs, {"free_factor": {"log_factor": 0.0}})["reading"])
    moved = np.asarray(model(inputs, {"free_factor": {"log_factor": STEP}})["reading"])
    slope = np.broadcast_to((moved - here) / STEP * forward.scale, (problem.y.size, 1))[:, 0]
    slope = slope / problem.unit_size(problem.predict((), z))
    usable = np.isfinite(slope).all() and bool(np.max(np.abs(slope / problem.sd)) > LEAST)
    return slope if usable else None


def calibrated_inputs(problem: Problem, z: np.ndarray) -> dict[str, Any]:
    """Inputs of the chain with the calibration at coordinates z applied."""
    inputs = dict(problem.forward.inputs)
    values = problem.calibration(z)
    for c in problem.forward.calibrations:
        inputs.update(c.apply(inputs, values[c.name]))
    return inputs


def _free_factor(name: str) -> Effect:
    def factor(quantity: np.ndarray, *, log_factor: float) -> np.ndarray:
        return quantity * np.exp(log_factor)

    return Effect(
        id="free_factor",
        law=factor,
        stage="property",
        acts_on=(name,),
        reads=(),
        parameters=(Parameter("log_factor", "-", Normal(0.0, 1.0), "logarithm of the free factor", null=0.0),),
        equation="",
        source="",
        fingerprint={},
        separated_by="",
    )
