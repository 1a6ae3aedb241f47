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
        """Influence matrices between the slices for loads at the given heights y (m).

        Shape ``(len(height), slices, slices)`` in m/N: mean deflection of slice j, normal to the centreline,
        for one newton spread evenly over slice k. Symmetric (Maxwell) and positive.
        """
        scaled = np.clip(2 * (np.asarray(height) - self.root) / self.length - 1, -1, 1)
        mode = legendre.legvander(scaled, HEIGHT_DEGREE)
        return np.einsum("im,in,mnjk->ijk", mode, mode, self.influence, optimize=True)


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
    place = root + length * (node + 1) / 2
    thickness = 2 * np.interp(place, tooth.height, tooth.half_thickness)
    bend = thickness**3 / (12 * (1 - poisson_ratio**2))
    shear = 5 / 6 * thickness / (2 * (1 + poisson_ratio))
    x, dx = _basis(node, HEIGHT_DEGREE, length)
    # A load spreads over about one tooth height: wider faces need more waves to show it.
    degree = 12 + 2 * math.ceil(face_width / (2 * length))
    y_node, y_gauss = legendre.leggauss(degree + 2)
    y, dy = _basis(y_node, degree, face_width)

    def along(left: np.ndarray, right: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
        return left.T @ (right * (stiffness * gauss * length / 2)[:, None])

    def across(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        return left.T @ (right * (y_gauss * face_width / 2)[:, None])

    lift, turn, both = _root_springs(foundation, tooth.root_chord)
    foot = np.outer((-1.0) ** np.arange(HEIGHT_DEGREE + 1), (-1.0) ** np.arange(HEIGHT_DEGREE + 1))
    flat, slope, twist = across(y, y), across(dy, dy), across(dy, y)
    half = (1 - poisson_ratio) / 2
    held = along(x, x, shear) + turn * foot
    deflection = np.kron(along(dx, dx, shear) + lift * foot, flat) + np.kron(along(x, x, shear), slope)
    tilt = np.kron(along(dx, dx, bend) + held, flat) + half * np.kron(along(x, x, bend), slope)
    roll = np.kron(along(x, x, bend), slope) + np.kron(half * along(dx, dx, bend) + held, flat)
    deflection_tilt = np.kron(both * foot - along(dx, x, shear), flat)
    deflection_roll = -np.kron(along(x, x, shear), twist)
    tilt_roll = poisson_ratio * np.kron(along(dx, x, bend), twist.T)
    tilt_roll += half * np.kron(along(x, dx, bend), twist)
    # Rotations are free of load: condense them out, then invert for the deflection alone.
    rotations = np.block([[tilt, tilt_roll], [tilt_roll.T, roll]])
    coupling = np.hstack([deflection_tilt, deflection_roll])
    stiffness = deflection - coupling @ np.linalg.solve(rotations, coupling.T)
    modes = _slice_means(slices, degree)
    spread = np.kron(np.eye(HEIGHT_DEGREE + 1), modes)
    influence = spread @ np.linalg.solve(stiffness, spread.T) / youngs_modulus
    shape = (HEIGHT_DEGREE + 1, slices, HEIGHT_DEGREE + 1, slices)
    return Plate(root, length, influence.reshape(shape).transpose(0, 2, 1, 3))


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
