"""Bounded least-squares fit of a local friction law to the load-dependent loss of gears."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.optimize import least_squares
from scipy.stats import t as student

from mixedlub.evaluate.uncertainty import NORMAL_90
from mixedlub.friction.loepenhaus import loepenhaus
from mixedlub.gear import Mesh
from mixedlub.laws.contact import line_hertz_pressure
from profiles.errors import InputError, RunError

LARGEST_CONDITION = 1e6
"""Judgement. Largest condition number of the scaled derivatives at which coefficients are distinguishable."""
NAMED = 0.3
"""Judgement. Smallest component of an undetermined combination at which a message names the coefficient."""


@dataclass(frozen=True, eq=False)
class Contacts:
    """Inputs of the law at M points of n readings (n, M), and sliding power of the points (W)."""

    entrainment_speed: np.ndarray
    hertz_pressure: np.ndarray
    kinematic_viscosity: np.ndarray
    mean_roughness: np.ndarray
    slide_roll_ratio: np.ndarray
    radius: np.ndarray
    sliding_power: np.ndarray

    def friction(self, coefficients: Mapping[str, float], surface_factor: np.ndarray) -> np.ndarray:
        """Friction coefficient at each point; ``surface_factor`` is given by reading."""
        return np.asarray(
            loepenhaus(
                self.entrainment_speed,
                self.hertz_pressure,
                self.kinematic_viscosity,
                self.mean_roughness,
                self.slide_roll_ratio,
                self.radius,
                **{**coefficients, "surface_factor": 1.0},
            )
            * surface_factor[:, None]
        )

    def loss(self, coefficients: Mapping[str, float], surface_factor: np.ndarray) -> np.ndarray:
        """Load-dependent loss of each reading (W)."""
        return np.asarray((self.friction(coefficients, surface_factor) * self.sliding_power).sum(axis=1))


def contacts_of(
    mesh: Mesh, torque: np.ndarray, speed: np.ndarray, viscosity: np.ndarray, roughness: np.ndarray
) -> Contacts:
    """Contact points of a mesh at torques (N m) and angular pinion speeds (rad/s), with oil and Ra of each reading."""
    pair, omega = mesh.pair, speed[:, None]
    entrainment, sliding = mesh.entrainment_per_speed * omega, np.abs(mesh.sliding_per_speed) * omega
    force = mesh.load_share(torque) * torque[:, None] / pair.base_radius[0]
    pressure = line_hertz_pressure(mesh.line_load(torque), mesh.radius, np.array(pair.reduced_modulus))
    power = force * sliding * mesh.weight
    radius = np.broadcast_to(mesh.radius, power.shape)
    return Contacts(entrainment, pressure, viscosity[:, None], roughness[:, None], sliding / entrainment, radius, power)


@dataclass(frozen=True, eq=False)
class Scatter:
    """Errors of n measured losses.

    ``own`` (W): standard deviations per reading, only proportional to them unless ``known``. ``common``: relative
    standard deviation of one error that scales all losses. ``series``: readings with a common load-independent loss;
    its error shifts their losses alike, with standard deviation ``series_sd`` (W) or without bound.
    """

    own: np.ndarray
    common: np.ndarray
    known: bool = True
    series: np.ndarray | None = None
    series_sd: np.ndarray | None = None

    def nuisance(self) -> tuple[list[str], np.ndarray, np.ndarray]:
        """Names of the shared errors, their effect on the readings (n, k) and prior sd (inf: no prior).

        The first error scales the losses, the others are shifts in units of the mean ``own``.
        """
        names, moved, prior = ["the error common to all"], [self.common], [1.0]
        kinds = np.unique([] if self.series is None else self.series)
        unit = float(self.own.mean())
        for name in kinds:
            here = self.series == name
            names.append(f"the load-independent loss of {name}")
            moved.append(np.where(here, unit, 0.0))
            prior.append(np.inf if self.series_sd is None else float(self.series_sd[here].mean()) / unit)
        return names, np.stack(moved, axis=1), np.array(prior)


@dataclass(frozen=True, eq=False)
class Fit:
    """Free coefficients with covariance; ``at_bound``: names of coefficients at a bound.

    ``shared`` (p,): part of each variance from errors of stated size common to readings. ``own_90``: half width of the
    90 % interval over the standard deviation of the remainder.
    """

    values: Mapping[str, float]
    covariance: np.ndarray
    shared: np.ndarray
    own_90: float
    at_bound: tuple[str, ...]
    freedom: int
    chi_square: float
    loss: np.ndarray

    @property
    def sd(self) -> np.ndarray:
        """Standard deviations; nan for a coefficient at a bound."""
        held = [name in self.at_bound for name in self.values]
        return np.where(held, np.nan, np.sqrt(np.diag(self.covariance)))

    @property
    def half_width(self) -> np.ndarray:
        """Half widths of the 90 % intervals: Student's t for errors from scatter, normal for stated errors."""
        return np.sqrt(self.own_90**2 * (self.sd**2 - self.shared) + NORMAL_90**2 * self.shared)

    @property
    def correlations(self) -> pd.DataFrame:
        """Correlation matrix of the free coefficients."""
        sd = self.sd
        table = pd.DataFrame(self.covariance / np.outer(sd, sd), columns=list(self.values))
        table.insert(0, "coefficient", list(self.values))
        return table


def calibrated(
    contacts: Contacts,
    loss: np.ndarray,
    scatter: Scatter,
    fixed: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]],
    surfaces: np.ndarray,
) -> Fit:
    r"""Fit the free coefficients to the measured losses.

    .. math:: \min_{c,\,e,\,\delta} \sum_i
        \left(\frac{P_i(c)\,(1 + s_i e) + \delta_{k(i)} - P_{VZP,i}}{\sigma_i}\right)^2
        + e^2 + \sum_k \left(\frac{\delta_k}{\sigma_k}\right)^2,\quad c_{low} \le c \le c_{high}

    ``bounds``: by coefficient or ``surface_factor.NAME``; ``surfaces`` (n,): surface of each reading. Known errors per
    reading are widened if the scatter is larger; unknown errors follow from the misfit. The covariance is of the
    linearised model.

    Source: "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s",
    equation 9 and figure 8.
    """
    names = list(bounds)
    low, high = (np.array([bounds[name][end] for name in names]) for end in (0, 1))
    shared, moved, prior = scatter.nuisance()
    freedom = loss.size - len(names) - int(np.isinf(prior).sum())
    if freedom < 1:
        rule = f"{len(names)} free coefficients need more readings than that"
        if np.isinf(prior).any():
            rule = (
                f"{len(names)} free coefficients and {int(np.isinf(prior).sum())} series need more readings than that"
            )
        raise InputError(rule, where="readings", value=loss.size)

    def of(x: np.ndarray) -> np.ndarray:
        given = dict(zip(names, x, strict=True))
        own = {name: value for name, value in given.items() if "." not in name}
        factor = np.array([given.get(f"surface_factor.{name}", 1.0) for name in surfaces])
        return contacts.loss({**fixed, **own}, factor)

    def misfit(x: np.ndarray) -> np.ndarray:
        calculated, errors = of(x[: len(names)]), x[len(names) :]
        found = calculated * (1.0 + moved[:, 0] * errors[0]) + moved[:, 1:] @ errors[1:]
        return np.concatenate([(found - loss) / scatter.own, errors / prior])

    start = np.where(low > 0.0, np.sqrt(np.abs(low * high)), 0.5 * (low + high))
    with np.errstate(all="ignore"):
        if not np.isfinite(of(start)).all():
            middle = dict(zip(names, start.round(6).tolist(), strict=True))
            raise InputError("the law has no finite loss in the middle of the bounds", where="bounds", value=middle)
    open_, rest = np.full(prior.size, np.inf), np.ones(prior.size)
    found = least_squares(
        misfit,
        np.concatenate([start, 0.0 * rest]),
        bounds=(np.concatenate([low, -open_]), np.concatenate([high, open_])),
        x_scale=np.concatenate([high - low, rest]),
        xtol=1e-12,
    )
    if not found.success:
        raise RunError(f"the fit of {', '.join(names)} has not converged: narrow the bounds")
    free = found.active_mask == 0
    chi_square = float(2.0 * found.cost)
    known = scatter.known and chi_square <= freedom
    spread = 1.0 if known else chi_square / freedom
    own_90 = NORMAL_90 if known else float(student.isf(0.05, freedom))
    jacobian = found.jac[:, free]
    jacobian[: loss.size] /= np.sqrt(spread)
    gain = np.full((free.size, jacobian.shape[0]), np.nan)
    gain[free] = _inverse(jacobian, [n for n, f in zip(names + shared, free, strict=True) if f]) @ jacobian.T
    gain = gain[: len(names)]
    held = tuple(name for name, own in zip(names, free[: len(names)], strict=True) if not own)
    values = dict(zip(names, map(float, found.x), strict=False))
    part = (gain[:, loss.size :] ** 2).sum(axis=1)
    return Fit(values, gain @ gain.T, part, own_90, held, freedom, chi_square, of(found.x[: len(names)]))


def _inverse(jacobian: np.ndarray, names: list[str]) -> np.ndarray:
    """Inverse of the normal matrix; raise an error that names indistinguishable coefficients."""
    size = np.linalg.norm(jacobian, axis=0)
    if size.size and not size.all():
        raise InputError("the loss does not depend on it", where="bounds", value=names[int(np.argmin(size))])
    _, singular, turned = np.linalg.svd(jacobian / size, full_matrices=False)
    if size.size and singular[0] > LARGEST_CONDITION * singular[-1]:
        together = [name for name, part in zip(names, turned[-1], strict=True) if abs(part) > NAMED]
        raise InputError("the readings do not tell these apart; fix one of them", where="bounds", value=together)
    return np.asarray((turned.T / singular**2) @ turned / np.outer(size, size))
