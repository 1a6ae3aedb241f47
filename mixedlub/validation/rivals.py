"""Rival explanations of noise-free readings: least chi-square with the calibration free under its prior."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.rig import Form, Rig

STEP = 1e-4
"""Step of forward differences, in prior standard deviations: truncation and rounding errors are about equal."""
FARTHEST = 6.0
"""Bound of the calibration in prior standard deviations, which no fit reaches."""


@dataclass(frozen=True)
class Target:
    """Target of a fit: values of some ``rows`` of a rig's readings, and their standard deviation."""

    rig: Rig
    rows: np.ndarray
    values: np.ndarray
    sd: np.ndarray


@dataclass(frozen=True)
class Fit:
    """Least chi-square, the calibration in prior standard deviations and the knobs of each form at the minimum."""

    chi_square: float
    z: np.ndarray
    knobs: tuple[dict[str, float], ...] = ()


Residual = Callable[[np.ndarray], np.ndarray]


def descend(
    residual: Residual, start: np.ndarray, low: np.ndarray, high: np.ndarray, rounds: int = 25
) -> tuple[np.ndarray, float]:
    """Levenberg-Marquardt inside a box, forward differences; returns the point and the sum of squares.

    A start without a finite residual stays with an infinite sum.
    """
    x = np.clip(start, low, high)
    r = residual(x)
    cost, damping = float(r @ r), 1e-3
    if not np.isfinite(cost):
        return x, np.inf
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


def guesses(forms: Sequence[Form]) -> list[np.ndarray]:
    """Starting values of the knobs: strengths over a factor of 30, of both signs, shapes at the ends of their range."""
    choices: list[list[float]] = []
    for knob in (knob for form in forms for knob in form.knobs):
        low, high = knob.typical
        middle = 0.5 * (low + high)
        sizes = [middle * factor for factor in (0.1, 0.2, 0.35, 0.6, 1.0, 1.8, 3.0)]
        signed = [*sizes, *(-size for size in sizes)] if knob.low < 0 else sizes
        strengths = [float(np.clip(value, knob.low, knob.high)) for value in signed]
        shapes = [low, high] if high > low else [low]
        choices.append(strengths if knob.name == "strength" else shapes)
    return [np.array(values) for values in itertools.product(*choices)]


def promising(
    starts: Sequence[np.ndarray], residual: Residual, origin: np.ndarray, slopes: np.ndarray, count: int = 3
) -> list[np.ndarray]:
    """Starts of least chi-square after a linear change of the calibration (``slopes``) about ``origin``."""
    basis, _ = np.linalg.qr(slopes)
    chi_squares = []
    for start in starts:
        r = residual(np.concatenate([origin, start]))
        chi_squares.append(float(r @ r - np.sum((basis.T @ r) ** 2)))
    return [starts[i] for i in np.argsort(chi_squares)[:count]]


def sensitivity(rig: Rig, z: np.ndarray) -> np.ndarray:
    """Derivative of the base readings by the calibrations, in prior standard deviations (readings by calibrations)."""
    at = rig.model(z, ())
    return np.array([(rig.model(z + STEP * e, ()) - at) / STEP for e in np.eye(len(z))]).T


def visibility(extra: np.ndarray, sd: np.ndarray, slopes: np.ndarray) -> float:
    """Root of the chi-square of an extra after recalibration, linear about the true calibration."""
    scaled = slopes / sd[:, None]
    whole = extra / sd
    taken = np.linalg.solve(scaled.T @ scaled + np.eye(slopes.shape[1]), scaled.T @ whole)
    remainder = whole - scaled @ taken
    return float(np.sqrt(remainder @ remainder + taken @ taken))


def best(target: Target, forms: Sequence[Form], z: np.ndarray, knobs: Sequence[dict[str, float]] = ()) -> Fit:
    """Best fit of some forms, knobs free in their ranges: first forms from ``knobs``, others from several guesses."""
    rig, count = target.rig, len(target.rig.names)
    every = [knob for form in forms for knob in form.knobs]
    unit = np.array([max(abs(k.typical[1]), 1e-9) if k.name == "strength" else k.high - k.low for k in every])
    low = np.concatenate([np.full(count, -FARTHEST), np.array([k.low for k in every]) / unit])
    high = np.concatenate([np.full(count, FARTHEST), np.array([k.high for k in every]) / unit])

    def split(x: np.ndarray) -> tuple[dict[str, float], ...]:
        values = iter(x[count:] * unit)
        return tuple({knob.name: float(next(values)) for knob in form.knobs} for form in forms)

    def residual(x: np.ndarray) -> np.ndarray:
        acts = [form.hide(values) for form, values in zip(forms, split(x))]
        model = rig.model(x[:count], acts)[target.rows]
        return np.concatenate([(model - target.values) / target.sd, x[:count]])

    known_values = [value for one in knobs for value in one.values()]
    starts = [np.concatenate([known_values, guess]) / unit for guess in guesses(forms[len(knobs) :])]
    if len(starts) > 1:
        tangents = np.concatenate([sensitivity(rig, z)[target.rows] / target.sd[:, None], np.eye(count)])
        starts = promising(starts, residual, z, tangents)
    x, cost = min((descend(residual, np.concatenate([z, start]), low, high) for start in starts), key=lambda f: f[1])
    return Fit(cost, x[:count], split(x))


def nearest(rig: Rig) -> np.ndarray:
    """Calibration of the model closest to the rig's readings without effects."""
    start = np.zeros(len(rig.names))
    values = rig.records(start, ())
    return best(Target(rig, np.arange(len(values)), values, 0.01 * values), (), start).z


def rivals(
    target: Target,
    hidden: Sequence[Form],
    knobs: Sequence[dict[str, float]],
    z: np.ndarray,
    rank: int,
    exchanged: bool = True,
) -> dict[str, float]:
    """Least chi-square without effects, of other single effects, and of a pair with one of its two effects exchanged.

    Each effect is tried in all its forms. Forms more general than the truth, beyond ``rank``, contain it as a special
    case and are no rivals. Unless ``exchanged``, a pair has single effects alone as rivals.
    """
    none = best(target, (), z)
    chi_squares = {"none": none.chi_square}
    truth = {form.id for form in hidden}
    special = [form for form in target.rig.forms if form.rank <= rank]

    def tried(name: str, value: float) -> None:
        chi_squares[name] = min(value, none.chi_square, chi_squares.get(name, np.inf))

    for form in special:
        if truth != {form.id}:
            tried(form.id, best(target, (form,), none.z).chi_square)
    for kept, values in zip(hidden, knobs) if len(hidden) == 2 and exchanged else ():
        for form in special:
            if form.id not in truth:
                tried("+".join(sorted((kept.id, form.id))), best(target, (kept, form), z, (values,)).chi_square)
    return {name: round(value, 4) for name, value in chi_squares.items()}
