"""Deflection of the flanks by loads on the slices of all tooth pairs: teeth, roots, bodies and local flattening. Forces
and deflections are along the line of action in the transverse plane, per slice. A helical tooth bends like the tooth of
its normal section: per length along the tooth, b/cos(beta), and normal to the flank, so that the compliance per face
width in the transverse plane is cos(beta)/cos^2(beta_b) times the compliance of the normal section. The factor
cos(beta) of ISO 6336-1 is the same."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from mixedlub.gear.compliance import (
    bending_compliance,
    foundation_compliance,
    hertz_approach,
    sainsot_foundation,
    weber_foundation,
)
from mixedlub.gear.geometry import GearPair, Pair
from mixedlub.gear.plate import Plate, tapered_plate
from mixedlub.gear.tooth import tooth

Flattening = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@lru_cache(maxsize=32)
def _bodies(pair: GearPair, bore: Pair | None, slices: int) -> tuple[tuple[tuple[float, ...], Plate], ...]:
    """Foundation coefficients and solved plate of both wheels, independent of load."""
    bodies = []
    for wheel in (0, 1):
        body = tooth(pair, wheel)
        poisson = pair.poisson_ratio[wheel]
        if bore is None:
            coefficients = weber_foundation(poisson)
        else:
            coefficients = sainsot_foundation(body.root_radius / bore[wheel], body.half_root_angle)
        young, length = pair.youngs_modulus[wheel], pair.face_width / math.cos(pair.helix_angle)
        bodies.append((coefficients, tapered_plate(body, length, slices, young, poisson, coefficients)))
    return tuple(bodies)


def _roll_distances(pair: GearPair, position: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distances from the base tangent points of pinion and gear to the contact, in the normal section."""
    cosine = math.cos(pair.base_helix_angle)
    return position / cosine, (pair.line_of_action_length - position) / cosine


def tooth_influence(pair: GearPair, bore: Pair | None, position: np.ndarray) -> np.ndarray:
    """Influence matrices of teeth and roots (m/N), shape (H, P N, P N): block diagonal over the pairs.

    ``position`` (H, P, N): where on the path each slice touches. The plate gives the coupling across the face; its
    scale is set so that a uniform load deflects by the beam and foundation laws. ``bore``: radii for the ring
    foundation, None for the half plane.
    """
    phases, pairs, slices = position.shape
    matrix = np.zeros((phases, pairs, slices, pairs, slices))
    turned = math.cos(pair.helix_angle) / math.cos(pair.base_helix_angle) ** 2
    bodies = zip(_bodies(pair, bore, slices), _roll_distances(pair, position), strict=True)
    for wheel, ((coefficients, plate), distance) in enumerate(bodies):
        body = tooth(pair, wheel)
        young, poisson = pair.youngs_modulus[wheel], pair.poisson_ratio[wheel]
        uniform = bending_compliance(body, distance, young, poisson)
        uniform = uniform + foundation_compliance(body, distance, young, coefficients)
        height = body.load_height(distance)
        # Deflections at different heights are scaled by the root of both factors, which keeps the matrix symmetric.
        scale = np.sqrt(turned * uniform / (plate.mean_compliance(height) * pair.face_width))
        block = plate.compliance(height) * scale[..., :, None] * scale[..., None, :]
        for index in range(pairs):
            matrix[:, index, :, index] += block[:, index]
    return matrix.reshape(phases, pairs * slices, pairs * slices)


def body_torsion(
    pair: GearPair, torque_end: tuple[str, str], body_radius: Pair, face: np.ndarray, pairs: int
) -> np.ndarray:
    r"""Influence matrix of the twist of both wheels' bodies (m/N), shape (P N, P N); the same at every phase.

    A force at the distance y_k from the end where the torque enters turns the body by r_b min(y_j, y_k)/(G I) at the
    distance y_j, I = pi r^4/2 of a solid cylinder, and moves the flank there by r_b times this angle. ``torque_end``:
    "front" (y = 0), "back", or "none" for a body that does not twist.

    Source: Saint-Venant's torsion of a cylinder.
    """
    matrix = np.zeros((face.size, face.size))
    for wheel, end in enumerate(torque_end):
        if end == "none":
            continue
        distance = face if end == "front" else pair.face_width - face
        shear = pair.youngs_modulus[wheel] / (2 * (1 + pair.poisson_ratio[wheel]))
        stiffness = shear * math.pi * body_radius[wheel] ** 4 / 2
        matrix += pair.base_radius[wheel] ** 2 / stiffness * np.minimum.outer(distance, distance)
    return np.tile(matrix, (pairs, pairs))


def flattening(pair: GearPair, position: np.ndarray, width: float) -> Flattening:
    """Hertzian approach (m) and its slope (m/N) as a function of the slice forces (T, H, P N).

    The load per length of contact line is the transverse force per face width; the approach is along the normal.
    """
    cosine = math.cos(pair.base_helix_angle)
    pinion, gear = _roll_distances(pair, position)
    radius = pinion * gear / (pinion + gear)
    depths = tooth(pair, 0).depth(pinion), tooth(pair, 1).depth(gear)

    def contact(force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        approach, slope = hertz_approach(
            force / width, radius, pair.reduced_modulus, depths, pair.youngs_modulus, pair.poisson_ratio
        )
        return approach / cosine, slope / (width * cosine)

    return contact
