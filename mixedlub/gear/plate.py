"""Coupling across the face: the tooth as a tapered plate on elastic root springs.

A load on one slice bends the neighbouring slices too. The plate energy

    U = 1/2 INT D [kx^2 + ky^2 + 2 nu kx ky + (1-nu) kxy^2/2] + 1/2 INT (5/6) G t [gx^2 + gy^2]

with D = E t^3 / (12 (1-nu^2)), and the energy of the foundation springs along the root, is minimised over
products of Legendre polynomials (deflection and both rotations). The ends of the face are free.

Source: the model of Yau, Busby and Houser 1994, with polynomials in place of their beam functions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from mixedlub.gear.tooth import Tooth

HEIGHT_DEGREE = 9


@dataclass(frozen=True, eq=False)
class Plate:
    """A solved plate: ``influence[m, n, j, k]`` couples height modes m, n and face slices j, k (m/N)."""

    root: float
    length: float
    influence: np.ndarray

    def compliance(self, height: np.ndarray) -> np.ndarray:
        """Influence matrices between the slices for loads at the given heights y (m), one a slice.

        ``height`` (..., slices) gives (..., slices, slices) in m/N: mean deflection of slice j, normal to the
        centreline, for one newton spread evenly over slice k. Symmetric (Maxwell) and positive.
        """
        mode = self._modes(height).reshape(-1, self.influence.shape[2], HEIGHT_DEGREE + 1)
        # First over the mode of the loaded slice k, slice by slice; then over that of the slice j that gives way.
        loaded = np.einsum("mnjk->kmjn", self.influence).reshape(mode.shape[1], -1, HEIGHT_DEGREE + 1)
        moved = (loaded @ mode.transpose(1, 2, 0)).reshape(mode.shape[1], HEIGHT_DEGREE + 1, mode.shape[1], -1)
        return np.einsum("ijm,kmji->ijk", mode, moved).reshape(*np.shape(height), mode.shape[1])

    def mean_compliance(self, height: np.ndarray) -> np.ndarray:
        """Mean deflection (m) of the face for one newton spread evenly over it at the heights y; any shape."""
        mode = self._modes(height)
        return np.einsum("...m,mn,...n->...", mode, self.influence.mean(axis=(2, 3)), mode)

    def _modes(self, height: np.ndarray) -> np.ndarray:
        scaled = np.clip(2 * (np.asarray(height) - self.root) / self.length - 1, -1, 1)
        return legendre.legvander(scaled, HEIGHT_DEGREE)


def tapered_plate(
    tooth: Tooth,
    face_width: float,
    slices: int,
    youngs_modulus: float,
    poisson_ratio: float,
    foundation: tuple[float, ...],
) -> Plate:
    """Solve the plate of one tooth; ``foundation`` are the four coefficients of a foundation law."""
    root, length = float(tooth.height[0]), float(tooth.height[-1] - tooth.height[0])
    node, gauss = legendre.leggauss(24)
    thickness = 2 * np.interp(root + length * (node + 1) / 2, tooth.height, tooth.half_thickness)
    bend = thickness**3 / (12 * (1 - poisson_ratio**2)) * gauss * length / 2
    shear = 5 / 6 * thickness / (2 * (1 + poisson_ratio)) * gauss * length / 2
    x, dx = _basis(node, HEIGHT_DEGREE, length)
    along = _Along(
        bend=x.T @ (x * bend[:, None]),
        bend_slope=dx.T @ (dx * bend[:, None]),
        bend_mixed=dx.T @ (x * bend[:, None]),
        shear=x.T @ (x * shear[:, None]),
        shear_slope=dx.T @ (dx * shear[:, None]),
        shear_mixed=dx.T @ (x * shear[:, None]),
        springs=_root_springs(foundation, tooth.root_chord),
    )
    # A load spreads over about one tooth height: wider faces need more waves to show it.
    degree = 12 + 2 * math.ceil(face_width / (2 * length))
    node, gauss = legendre.leggauss(degree + 2)
    y, dy = _basis(node, degree, face_width)
    weight = (gauss * face_width / 2)[:, None]
    modes = _slice_means(slices, degree)
    influence = np.zeros(((HEIGHT_DEGREE + 1) * slices,) * 2)
    # Symmetric and antisymmetric deflections of the face do not mix: two problems of half the size.
    for parity in (0, 1):
        same, other = slice(parity, None, 2), slice(1 - parity, None, 2)
        stiffness = _condensed(along, poisson_ratio, (y[:, same], dy[:, same]), (y[:, other], dy[:, other]), weight)
        spread = np.kron(np.eye(HEIGHT_DEGREE + 1), modes[:, same])
        influence += spread @ np.linalg.solve(stiffness, spread.T) / youngs_modulus
    shape = (HEIGHT_DEGREE + 1, slices, HEIGHT_DEGREE + 1, slices)
    return Plate(root, length, influence.reshape(shape).transpose(0, 2, 1, 3))


@dataclass(frozen=True, eq=False)
class _Along:
    """Integrals over the height of products of its polynomials, weighted with bending or shear stiffness.

    ``slope``: both polynomials differentiated; ``mixed``: only the first; ``springs``: root stiffness against lift,
    turn, both.
    """

    bend: np.ndarray
    bend_slope: np.ndarray
    bend_mixed: np.ndarray
    shear: np.ndarray
    shear_slope: np.ndarray
    shear_mixed: np.ndarray
    springs: tuple[float, float, float]


def _condensed(
    along: _Along,
    poisson_ratio: float,
    lift: tuple[np.ndarray, np.ndarray],
    roll: tuple[np.ndarray, np.ndarray],
    weight: np.ndarray,
) -> np.ndarray:
    """Stiffness of the deflection alone; the rotations carry no load and follow.

    ``lift``: face polynomials and derivatives of the deflection and of the rotation along the tooth; ``roll``: the
    same, of the other parity, for the rotation along the face.
    """
    (y, dy), (z, dz) = lift, roll
    flat, slope = y.T @ (y * weight), dy.T @ (dy * weight)
    flat_roll, slope_roll = z.T @ (z * weight), dz.T @ (dz * weight)
    twist, swell = dy.T @ (z * weight), y.T @ (dz * weight)
    sign = (-1.0) ** np.arange(HEIGHT_DEGREE + 1)
    foot = np.outer(sign, sign)
    against_lift, against_turn, both = along.springs
    half = (1 - poisson_ratio) / 2
    held = along.shear + against_turn * foot

    deflection = np.kron(along.shear_slope + against_lift * foot, flat) + np.kron(along.shear, slope)
    tilt = np.kron(along.bend_slope + held, flat) + half * np.kron(along.bend, slope)
    roll_stiffness = np.kron(along.bend, slope_roll) + np.kron(half * along.bend_slope + held, flat_roll)
    tilt_roll = poisson_ratio * np.kron(along.bend_mixed, swell) + half * np.kron(along.bend_mixed.T, twist)
    rotations = np.block([[tilt, tilt_roll], [tilt_roll.T, roll_stiffness]])
    coupling = np.hstack([np.kron(both * foot - along.shear_mixed, flat), -np.kron(along.shear, twist)])
    return deflection - coupling @ np.linalg.solve(rotations, coupling.T)


def _basis(node: np.ndarray, degree: int, length: float) -> tuple[np.ndarray, np.ndarray]:
    """Legendre polynomials and their derivatives on a piece of the given length, one column a polynomial."""
    derivative = legendre.legvander(node, degree - 1) @ legendre.legder(np.eye(degree + 1))
    return legendre.legvander(node, degree), derivative * 2 / length


def _slice_means(slices: int, degree: int) -> np.ndarray:
    """Mean of each face polynomial over each of the equal slices, shape (slices, polynomials)."""
    edges = np.linspace(-1, 1, slices + 1)
    antiderivative = legendre.legint(np.eye(degree + 1))
    integral = legendre.legvander(edges, degree + 1) @ antiderivative
    return np.diff(integral, axis=0) * slices / 2


def _root_springs(foundation: tuple[float, ...], chord: float) -> tuple[float, float, float]:
    """Stiffness of the root per unit E and width against lift, turn and their coupling.

    The foundation law is a compliance: lift = c0 V + c1/(2 s) M, turn = c1/(2 s) V + c2/s^2 M.
    """
    square, linear, shear, _ = foundation
    compliance = np.array([[shear, linear / (2 * chord)], [linear / (2 * chord), square / chord**2]])
    stiffness = np.linalg.inv(compliance)
    return stiffness[0, 0], stiffness[1, 1], stiffness[0, 1]
