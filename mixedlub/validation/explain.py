"""How well rival explanations can do: noise-free chi-square with the calibration refitted under its prior."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mixedlub.validation.build import PRIORS
from mixedlub.validation.planted import Concealed, Knob
from mixedlub.validation.rig import Calibration, Rig, readings

STEP = 1e-4


@dataclass(frozen=True)
class Target:
    """What is to be explained: noise-free values and their sd on a rig, and what calibration is believed."""

    rig: Rig
    values: np.ndarray
    sd: np.ndarray
    nominal: Calibration
    priors: dict[str, float]


@dataclass(frozen=True)
class Explained:
    """Best chi-square, the calibration in prior sds and the knobs that reach it."""

    chi_square: float
    calibration: np.ndarray
    knobs: tuple[dict[str, float], ...] = ()


def calibrated(nominal: Calibration, priors: dict[str, float], z: np.ndarray) -> Calibration:
    """The calibration z prior sds off: boundary friction by addition, the others lognormal."""
    moved = {name: priors[name] * shift for name, shift in zip(PRIORS, z)}
    factors = {name: float(np.exp(moved[name])) for name in PRIORS[1:]}
    return Calibration(max(nominal.boundary_friction + moved["boundary_friction"], 1e-4), **factors)


def descend(
    residual: Callable[[np.ndarray], np.ndarray],
    start: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    rounds: int = 25,
) -> tuple[np.ndarray, float]:
    """Levenberg-Marquardt inside a box, forward differences; returns the point and the sum of squares."""
    x = np.clip(start, low, high)
    r = residual(x)
    cost, damping = float(r @ r), 1e-3
    for _ in range(rounds):
        signs = np.where(x + STEP > high, -1.0, 1.0)
        jacobian = np.array([(residual(x + STEP * s * e) - r) / (STEP * s) for s, e in zip(signs, np.eye(len(x)))]).T
        slope = jacobian.T @ r
        free = ~(((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0)))
        normal = jacobian[:, free].T @ jacobian[:, free]
        better = False
        while damping < 1e8 and not better:
            damped = normal + damping * np.diag(np.diag(normal) + 1e-9)
            trial = x.copy()
            trial[free] = np.clip((x[free] - np.linalg.solve(damped, slope[free])), low[free], high[free])
            r_trial = residual(trial)
            cost_trial = float(r_trial @ r_trial)
            better = np.isfinite(cost_trial) and cost_trial < cost
            damping = damping / 5 if better else damping * 5
        if not better:
            break
        gain, x, r, cost = cost - cost_trial, trial, r_trial, cost_trial
        if gain < 2e-3 + 2e-4 * cost:
            break
    return x, cost


class Knobbed(Protocol):
    """What has knobs to be fitted."""

    @property
    def knobs(self) -> tuple[Knob, ...]: ...


def guesses(effects: Sequence[Knobbed]) -> list[np.ndarray]:
    """Knob values to begin from: strengths over a factor of 30, of both signs, shapes at usual ends."""
    choices: list[list[float]] = []
    for effect in effects:
        for knob in effect.knobs:
            low, high = knob.typical
            middle = 0.5 * (low + high)
            sizes = [middle * factor for factor in (0.1, 0.2, 0.35, 0.6, 1.0, 1.8, 3.0)]
            signed = [*sizes, *(-size for size in sizes)] if knob.low < 0 else sizes
            strengths = [float(np.clip(value, knob.low, knob.high)) for value in signed]
            shapes = [low, high] if high > low else [low]
            choices.append(strengths if knob.name == "strength" else shapes)
    return [np.array(values) for values in itertools.product(*choices)]


def promising(
    guesses: Sequence[np.ndarray],
    residual: Callable[[np.ndarray], np.ndarray],
    origin: np.ndarray,
    slopes: np.ndarray,
    count: int = 3,
) -> list[np.ndarray]:
    """The guesses that leave least when the calibration may move linearly (``slopes``) about ``origin``."""
    if len(guesses) <= 1:
        return list(guesses)
    basis, _ = np.linalg.qr(slopes)
    left = []
    for guess in guesses:
        r = residual(np.concatenate([origin, guess]))
        left.append(float(r @ r - np.sum((basis.T @ r) ** 2)))
    return [guesses[i] for i in np.argsort(left)[:count]]


def explain(
    target: Target,
    effects: Sequence[Concealed] = (),
    begin: np.ndarray | None = None,
    starts: Sequence[np.ndarray] | None = None,
) -> Explained:
    """Best chi-square of a set of effects: knobs free in their ranges, priors on the calibration only."""
    count = len(PRIORS)
    knobs = [knob for effect in effects for knob in effect.knobs]
    unit = np.array([max(abs(k.typical[1]), 1e-9) if k.name == "strength" else k.high - k.low for k in knobs])
    low = np.concatenate([np.full(count, -6.0), np.array([k.low for k in knobs]) / unit])
    high = np.concatenate([np.full(count, 6.0), np.array([k.high for k in knobs]) / unit])
    known = np.array([target.priors[name] > 0 for name in PRIORS])
    low[:count][~known] = high[:count][~known] = 0.0

    def split(x: np.ndarray) -> list[dict[str, float]]:
        values = iter(x[count:] * unit)
        return [{knob.name: float(next(values)) for knob in effect.knobs} for effect in effects]

    def residual(x: np.ndarray) -> np.ndarray:
        hidden = [effect.hide(values) for effect, values in zip(effects, split(x))]
        model = readings(target.rig, calibrated(target.nominal, target.priors, x[:count]), hidden)
        return np.concatenate([(model - target.values) / target.sd, x[:count]])

    origin = np.zeros(count) if begin is None else begin
    best: tuple[np.ndarray, float] | None = None
    begins = [guess / unit for guess in (guesses(effects) if starts is None else starts)]
    moves = sensitivity(target.rig, target.nominal, target.priors, origin) / target.sd[:, None]
    slopes = np.concatenate([moves, np.eye(count)])
    for guess in promising(begins, residual, origin, slopes):
        found = descend(residual, np.concatenate([origin, guess]), low, high)
        if best is None or found[1] < best[1]:
            best = found
    assert best is not None
    return Explained(best[1], best[0][:count], tuple(split(best[0])))


def sensitivity(rig: Rig, nominal: Calibration, priors: dict[str, float], z: np.ndarray) -> np.ndarray:
    """Change of the base readings (readings by 5) with one prior sd of each calibration, around ``z``."""
    at = readings(rig, calibrated(nominal, priors, z))
    moved = [readings(rig, calibrated(nominal, priors, z + STEP * e)) for e in np.eye(len(z))]
    return np.array([(value - at) / STEP for value in moved]).T


def visibility(extra: np.ndarray, sd: np.ndarray, slopes: np.ndarray) -> float:
    """Root of the chi-square that recalibration leaves of an extra, linear about the true calibration."""
    scaled = slopes / sd[:, None]
    whole = extra / sd
    taken = np.linalg.solve(scaled.T @ scaled + np.eye(slopes.shape[1]), scaled.T @ whole)
    left = whole - scaled @ taken
    return float(np.sqrt(left @ left + taken @ taken))
