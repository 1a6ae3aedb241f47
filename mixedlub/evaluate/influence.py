"""Influence of normal and friction force of each tooth on strain gauges, as polynomials in the roll angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval, chebvander

from profiles.errors import InputError

FORCES = ("normal force", "friction force")


@dataclass(frozen=True, eq=False)
class Influence:
    """Influence coefficients of G gauges and K teeth.

    ``coefficients`` (G, K, 2, D+1): Chebyshev polynomials over the calibrated roll angles ``low`` to ``high``.
    ``modes`` (G, K, P, 2, D+1): independent errors of the coefficients, one standard deviation each. ``residual`` (G,):
    scatter of the calibration.
    """

    low: float
    high: float
    coefficients: np.ndarray
    modes: np.ndarray
    residual: np.ndarray

    def _scaled(self, roll_angle: np.ndarray) -> np.ndarray:
        return (2.0 * roll_angle - self.low - self.high) / (self.high - self.low)

    def is_outside(self, roll_angle: np.ndarray) -> np.ndarray:
        """Whether roll angles lie outside the calibration."""
        slack = 1e-9 * (self.high - self.low)
        return (roll_angle < self.low - slack) | (roll_angle > self.high + slack)

    def check(self, roll_angle: np.ndarray, place: str) -> None:
        """Raise an error for roll angles outside the calibration."""
        outside = self.is_outside(roll_angle)
        if np.any(outside):
            rule = f"the gauges are calibrated from {self.low:.4g} to {self.high:.4g}°"
            raise InputError(rule, where=f"{place}: roll angle", value=round(float(roll_angle[outside][0]), 3))

    def at(self, roll_angle: np.ndarray, tooth: int) -> np.ndarray:
        """Strain per force (M, G, 2) of a tooth at its roll angles (M,)."""
        values = chebval(self._scaled(roll_angle), np.moveaxis(self.coefficients[:, tooth], -1, 0))
        return np.moveaxis(values, -1, 0)

    def slope(self, roll_angle: np.ndarray, tooth: int) -> np.ndarray:
        """Derivative of the strain per force with respect to the roll angle (M, G, 2)."""
        derived = chebder(np.moveaxis(self.coefficients[:, tooth], -1, 0))
        return np.moveaxis(chebval(self._scaled(roll_angle), derived), -1, 0) * 2.0 / (self.high - self.low)

    def errors(self, roll_angle: np.ndarray, tooth: int, gauge: int) -> np.ndarray:
        """Errors (M, P, 2) of the strain per force of a gauge, by mode."""
        basis = chebvander(self._scaled(roll_angle), self.modes.shape[-1] - 1)
        return np.einsum("md,pfd->mpf", basis, self.modes[gauge, tooth])


def fit_influence(
    roll_angle: np.ndarray,
    tooth: np.ndarray,
    forces: np.ndarray,
    strains: np.ndarray,
    *,
    teeth: int,
    degree: int,
    source: str,
) -> Influence:
    r"""Influence coefficients by least squares, :math:`S = S_0 + a_n(\theta) F_n + a_f(\theta) F_f`.

    One tooth is loaded at a time: ``tooth`` (n,) from 0, ``forces`` (n, 2) normal and friction, ``strains`` (n, G). The
    zero S_0 of each gauge is fitted too, since the smallest load need not be zero.

    Source: Rebbechi, Oswald and Townsend 1996, NASA TM-107279, equations 1 to 3.
    """
    low, high = float(roll_angle.min()), float(roll_angle.max())
    gauges, terms = strains.shape[1], degree + 1
    coefficients = np.empty((gauges, teeth, 2, terms))
    modes = np.empty((gauges, teeth, 2 * terms, 2, terms))
    variance = np.zeros(gauges)
    freedom = 0
    for number in range(teeth):
        rows = tooth == number
        _check_loads(roll_angle[rows], forces[rows], number, degree, source)
        basis = chebvander((2.0 * roll_angle[rows] - low - high) / (high - low), degree)
        design = np.hstack([basis * forces[rows, :1], basis * forces[rows, 1:], np.ones((basis.shape[0], 1))])
        scale = np.sqrt((design**2).sum(axis=0))
        found, _, rank, singular = np.linalg.lstsq(design / scale, strains[rows], rcond=1e-10)
        if rank < design.shape[1]:
            rule = "these loads and roll angles do not separate normal and friction force; singular values from"
            rule += f" {singular[0]:.2g} to {singular[-1]:.2g}"
            raise InputError(rule, where=f"{source}: tooth {number + 1}")
        misfit = strains[rows] - design / scale @ found
        variance += (misfit**2).sum(axis=0)
        freedom += max(design.shape[0] - design.shape[1], 0)
        coefficients[:, number] = (found[:-1] / scale[:-1, None]).T.reshape(gauges, 2, terms)
        covariance = np.linalg.inv((design / scale).T @ (design / scale))[:-1, :-1] / np.outer(scale[:-1], scale[:-1])
        size, direction = np.linalg.eigh(covariance)
        one = (direction * np.sqrt(np.maximum(size, 0.0))).T.reshape(2 * terms, 2, terms)
        modes[:, number] = one
    if freedom == 0:
        raise InputError("has no more readings than coefficients; lower influence.degree", where=source, value=degree)
    residual = np.sqrt(variance / freedom)
    return Influence(low, high, coefficients, modes * residual[:, None, None, None, None], residual)


def _check_loads(roll_angle: np.ndarray, forces: np.ndarray, number: int, degree: int, source: str) -> None:
    """Raise an error for a tooth without calibration loads or with too few roll angles."""
    place = f"{source}: tooth {number + 1}"
    for name, force in zip(FORCES, forces.T, strict=True):
        angles = np.unique(roll_angle[force != 0.0]).size
        if angles <= degree:
            rule = f"a polynomial of degree {degree} needs a {name} at {degree + 1} roll angles or more"
            raise InputError(rule, where=place, value=angles)
