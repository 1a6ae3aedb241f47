"""Split of gear loss over load stages into load-independent loss and friction of the mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from mixedlub.evaluate.uncertainty import Errors, combined, interval
from profiles.errors import InputError

FIT_LEVEL = 0.05
"""Probability of the misfit below which the stated errors are widened to the scatter about the line."""

OWN, COMMON = "load_dependent_loss_W_sd_own", "load_dependent_loss_relative_sd_common"
"""Columns of the errors of the load-dependent loss: per reading, and common to all readings."""


@dataclass(frozen=True, eq=False)
class LoadStages:
    """Torque on the pinion (N m), input power (W) and loss factor of the local load, by reading."""

    torque: np.ndarray
    power: np.ndarray
    factor: np.ndarray

    @property
    def product(self) -> np.ndarray:
        """Input power times loss factor (W); times the mean friction mu: load-dependent loss."""
        return self.power * self.factor

    def take(self, rows: np.ndarray) -> LoadStages:
        """Subset of the readings."""
        return LoadStages(self.torque[rows], self.power[rows], self.factor[rows])


@dataclass(frozen=True, eq=False)
class Split:
    """Split of a series: line, columns of readings, load-independent loss and friction with error budgets."""

    name: str
    rows: np.ndarray
    intercept: float
    slope: float
    readings: Mapping[str, np.ndarray]
    found: Mapping[str, tuple[np.ndarray, dict[str, np.ndarray]]]
    chi_square: float
    notes: tuple[str, ...]


def split_loss(
    name: str,
    rows: np.ndarray,
    loss: np.ndarray,
    errors: Errors,
    stages: LoadStages,
    *,
    relative: Mapping[str, float],
    load_exponent_sd: float,
) -> Split:
    r"""Load-independent loss and mean friction of a series at one speed, P_VZ = P_VZ0 + mu P_a H_VL.

    Generalised least squares over input power times loss factor; over torque the line would be bent, since the loss
    factor grows with load. ``relative``: relative errors of that product, by source. ``load_exponent_sd``: standard
    deviation of the exponent of friction over load, which bends the line too; weights and interval allow for it.

    Source: "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s",
    equations 1 and 3, figure 4.
    """
    x = stages.product
    if np.unique(stages.torque).size < 2:
        rule = "load-independent loss needs load stages at two torques or more, at one speed"
        raise InputError(rule, where=f"series {name}: torque_Nm", value=float(stages.torque[0]))
    design = np.stack([np.ones_like(x), x], axis=1)
    bend = np.zeros_like(x)
    for _ in range(3):
        covariance = np.diag(errors.independent**2) + np.outer(bend, bend) * load_exponent_sd**2
        inverse = np.linalg.inv(covariance)
        fit = np.linalg.solve(design.T @ inverse @ design, design.T @ inverse)
        intercept, slope = (float(one) for one in fit @ loss)
        loaded = np.maximum(x, 1e-6 * x.max())
        bend = slope * x * np.log(loaded / np.exp(np.log(loaded[x > 0]).mean()))
    misfit = loss - design @ (fit @ loss)
    chi_square, freedom = float(misfit @ inverse @ misfit), x.size - 2
    notes: tuple[str, ...] = ()
    if freedom > 0 and chi_square > chi2.isf(FIT_LEVEL, freedom):
        wider = (chi_square / freedom) ** 0.5
        errors = Errors(errors.independent * wider, errors.common)
        notes = (f"series {name}: readings scatter {wider:.2g} times as much as stated; the intervals allow for it",)
    gains = {source: slope * x * sd for source, sd in relative.items()}
    everything = Errors(errors.independent, {**errors.common, **gains})
    to_intercept, one = fit[0], np.eye(x.size)

    def budget(weights: np.ndarray, of_intercept: np.ndarray) -> dict[str, np.ndarray]:
        """Error budget of ``weights @ loss``; ``of_intercept``: contribution of the intercept, moved by the bend."""
        moved = np.abs(of_intercept * (to_intercept @ bend)) * load_exponent_sd
        return {**everything.budget(weights), "friction over load": moved}

    per_load = np.divide(1.0, x, out=np.full_like(x, np.nan), where=x > 0)
    dependent = one - to_intercept
    readings = interval(
        "load_dependent_loss_W", dependent @ loss, _own(errors, dependent, to_intercept @ bend, load_exponent_sd)
    )
    readings[OWN] = errors.independent
    readings[COMMON] = _relative(errors, dependent, dependent @ loss)
    friction = dependent * per_load[:, None]
    readings |= interval("mean_friction", friction @ loss, combined(budget(friction, per_load)))
    mean = dependent.sum(axis=0) / x.sum()
    found = {
        "load_independent_loss_W": (to_intercept @ loss, budget(to_intercept, np.array(1.0))),
        "mean_friction": (mean @ loss, budget(mean, np.array(x.size / x.sum()))),
    }
    return Split(name, rows, intercept, slope, readings, found, chi_square, notes)


def _relative(errors: Errors, dependent: np.ndarray, loss: np.ndarray) -> np.ndarray:
    """Relative standard deviation of the load-dependent loss (W) by errors common to all readings; zero at zero loss.

    The sources are combined into one fully correlated error, as in a fit of the losses.
    """
    moved = combined({name: dependent @ one for name, one in errors.common.items()})
    return np.divide(np.abs(moved), np.abs(loss), out=np.zeros_like(loss), where=np.abs(loss) > 0.0)


def _own(errors: Errors, weights: np.ndarray, bend: float, exponent_sd: float) -> np.ndarray:
    """Standard deviation of the load-dependent loss without the errors of torque and loss factor."""
    return np.hypot(errors.sd(weights), abs(bend) * exponent_sd)
