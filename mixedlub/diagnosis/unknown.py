"""The competing explanation that no effect of the catalogue is: a smooth function of the conditions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.diagnosis.features import Coordinates
from mixedlub.diagnosis.fit import Fit, Linear, linear_fit
from mixedlub.diagnosis.problem import Problem

LENGTHS = (0.25, 0.7)
SIZES = (0.7, 2.0, 6.0, 20.0, 60.0)
FULL = 6


@dataclass(frozen=True)
class Shape:
    """One form an unnamed mismatch may have: along which axes, how smooth, how large (sigmas), relative or not."""

    axis: str | None
    length: float
    size: float
    relative: bool
    interactions: bool

    @property
    def words(self) -> str:
        """The shape in words."""
        along = "all conditions" if self.axis is None else self.axis
        form = "a share of the reading" if self.relative else "a constant number of sigmas"
        return f"smooth in {along}, as {form}"


@dataclass(frozen=True, eq=False)
class Unknown:
    """Evidence of the unnamed mismatch, averaged over its shapes, and its best shape's fit."""

    evidence: float
    best: Shape
    fit: Linear
    values: np.ndarray
    variance: np.ndarray
    covariance: np.ndarray
    z: np.ndarray


def shapes(space: Coordinates) -> list[Shape]:
    """All shapes that are tried, of size one."""
    found = []
    for length in LENGTHS:
        for relative in (True, False):
            found.append(Shape(None, length, 1.0, relative, False))
            if len(space.axes) > 1:
                found.append(Shape(None, length, 1.0, relative, True))
                found.extend(Shape(axis.name, length, 1.0, relative, False) for axis in space.axes)
    return found


def shape_columns(
    shape: Shape, space: Coordinates, values: list[np.ndarray], share: np.ndarray, typical: float
) -> np.ndarray:
    """The shape's columns in sigmas; ``share`` is reading over sd, ``typical`` its rms over the recording."""
    columns = space.columns(values, shape.length, shape.axis, shape.interactions)
    if shape.relative:
        columns = columns * (share / typical)[:, None]
    return shape.size * columns


def share_of(prediction: np.ndarray, sd: np.ndarray) -> tuple[np.ndarray, float]:
    """Reading over sd, and its rms."""
    share = np.abs(prediction) / sd
    return share, float(np.sqrt(np.mean(share**2)))


def unknown_fit(problem: Problem, none: Fit, space: Coordinates, values: list[np.ndarray]) -> Unknown:
    """Marginal likelihood of the base model plus an unnamed smooth mismatch, averaged over its shapes.

    Which readings are outliers is settled first, under the richest shape; shapes and sizes are then weighed
    with those weights, and the best few again in full.
    """
    target = none.anchor
    fixed = np.hstack([none.slopes, problem.shared])

    share, typical = share_of(none.prediction, problem.sd)

    def columns_of(shape: Shape) -> np.ndarray:
        return shape_columns(shape, space, values, share, typical)

    rich = Shape(None, LENGTHS[0], 6.0, True, len(space.axes) > 1)
    reference = linear_fit(target, np.hstack([fixed, columns_of(rich)]))
    tried: list[Shape] = []
    weighed: list[float] = []
    for shape in shapes(space):
        for size, value in zip(
            SIZES, _evidence_by_size(target, fixed, columns_of(shape), reference.weight), strict=True
        ):
            tried.append(replace(shape, size=size))
            weighed.append(value)
    order = np.argsort(weighed)[::-1]
    full = {
        int(i): linear_fit(target, np.hstack([fixed, columns_of(tried[i])]), reference.weight) for i in order[:FULL]
    }
    first = int(order[0])
    offset = full[first].evidence - weighed[first]
    evidence = np.array([full[i].evidence if i in full else weighed[i] + offset for i in range(len(tried))])
    best = max(full, key=lambda i: full[i].evidence)
    own = columns_of(tried[best])
    every = np.hstack([fixed, own])
    fit = full[best]
    covariance = np.linalg.inv(np.eye(every.shape[1]) + every.T @ (every * fit.weight[:, None]))
    return Unknown(
        evidence=float(np.logaddexp.reduce(evidence) - np.log(evidence.size)),
        best=tried[best],
        fit=fit,
        values=own @ fit.coefficients[fixed.shape[1] :],
        variance=np.einsum("ij,jk,ik->i", every, covariance, every),
        covariance=covariance,
        z=fit.coefficients[: none.z.size],
    )


def _evidence_by_size(target: np.ndarray, fixed: np.ndarray, own: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Gaussian log evidence for each of SIZES, relative to size zero, at fixed weights."""
    scaled = fixed * weight[:, None]
    inner = np.linalg.inv(np.eye(fixed.shape[1]) + fixed.T @ scaled)
    across = scaled.T @ own
    overlap = (own * weight[:, None]).T @ own - across.T @ inner @ across
    pull = (own * weight[:, None]).T @ target - across.T @ (inner @ (scaled.T @ target))
    power, turn = np.linalg.eigh(overlap)
    power = np.maximum(power, 0.0)
    along = (turn.T @ pull) ** 2
    square = np.array(SIZES)[:, None] ** 2
    grown = 1.0 + square * power
    return 0.5 * (square * along / grown - np.log(grown)).sum(axis=1)
