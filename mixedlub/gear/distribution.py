"""Elastic load distribution of spur gears over tooth pairs and face width, in the manner of LDP.

Every slice of every pair in contact is a point of one contact problem: teeth bend and shear as plates on
elastic roots, flanks flatten, modifications stand back, and one rigid approach closes all gaps. Contact is kept
to the theoretical path (no corner contact beyond A and E) and teeth couple through the approach only.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.gear.checks import torques_above_zero
from mixedlub.gear.compliance import (
    SAINSOT_ANGLES,
    bending_compliance,
    foundation_compliance,
    hertz_approach,
    sainsot_foundation,
    weber_foundation,
)
from mixedlub.gear.contact_lines import contact_limits
from mixedlub.gear.contact_solver import share_out
from mixedlub.gear.geometry import GearPair, Pair, number, two, whole
from mixedlub.gear.modifications import Modifications
from mixedlub.gear.plate import Plate, tapered_plate
from mixedlub.gear.tooth import tooth
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError, nearest, refuse_other

if TYPE_CHECKING:
    from mixedlub.gear.mesh import Mesh

FOUNDATIONS = ("weber", "sainsot")


@dataclass(frozen=True)
class LdpSharing:
    """Elastic sharing of spur gears; modifications as in ``Modifications``, lengths in m.

    ``foundation``: "weber" (half plane) or "sainsot" (ring, needs ``bore_radius``, m, pinion first; about a
    fifth softer).
    """

    tip_relief: Pair = (0.0, 0.0)
    relief_length: Pair = (0.0, 0.0)
    root_relief: Pair = (0.0, 0.0)
    root_relief_length: Pair = (0.0, 0.0)
    relief_form: str = "linear"
    lead_crown: float = 0.0
    misalignment: float = 0.0
    foundation: str = "weber"
    bore_radius: Pair | None = None

    def __post_init__(self) -> None:
        checked = self.modifications
        for field in fields(checked):
            object.__setattr__(self, field.name, getattr(checked, field.name))
        if self.foundation not in FOUNDATIONS:
            raise InputError(nearest(str(self.foundation), FOUNDATIONS), where="foundation", value=self.foundation)
        if self.foundation == "sainsot" and self.bore_radius is None:
            raise InputError("the ring foundation needs the bores", where="bore_diameter_mm")
        if self.bore_radius is not None:
            bores = two("bore_diameter_mm", self.bore_radius)
            rule = "a bore is above zero"
            first, second = (number("bore_diameter_mm", bore, 0, 100, rule, 2e3) for bore in bores)
            object.__setattr__(self, "bore_radius", (first, second))

    @property
    def modifications(self) -> Modifications:
        """The micro-geometry alone."""
        return Modifications(
            self.tip_relief,
            self.relief_length,
            self.root_relief,
            self.root_relief_length,
            self.relief_form,
            self.lead_crown,
            self.misalignment,
        )

    def default_slices(self, pair: GearPair) -> int:
        """Eleven resolve crown and misalignment of usual size."""
        return 11

    def check(self, pair: GearPair) -> tuple[Finding, ...]:
        """Refuse helical pairs, reliefs longer than the path, bores outside the range of the ring law."""
        if pair.helix_angle != 0:
            raise InputError(
                'the elastic load distribution serves spur gears only; use { model = "rigid" }',
                where="load_sharing",
            )
        self.modifications.check(pair)
        if self.foundation != "sainsot" or self.bore_radius is None:
            return ()
        found = []
        for wheel, bore in enumerate(self.bore_radius):
            body = tooth(pair, wheel)
            ratio, angle = body.root_radius / bore, body.half_root_angle
            if not 1.4 <= ratio <= 7:
                raise InputError(
                    f"the ring foundation needs a root circle 1.4 to 7 times the bore, here {ratio:.3g}",
                    where="bore_diameter_mm",
                    value=2e3 * bore,
                )
            if not SAINSOT_ANGLES[0] <= angle <= SAINSOT_ANGLES[1]:
                low, high = SAINSOT_ANGLES
                text = f"the ring foundation holds for half root angles of {low:g} to {high:g} rad, here {angle:.3g}"
                found.append(finding("law_extrapolated", text, ("pinion", "gear")[wheel]))
        return tuple(found)

    def breakpoints(self, pair: GearPair) -> np.ndarray:
        """Ends of contact and starts of relief of this pair and, whole base pitches away, of its neighbours."""
        marks = np.concatenate([self.modifications.starts(pair), [pair.pitch_point]])
        shifts = pair.base_pitch * np.arange(-int(pair.contact_ratio) - 1, int(pair.contact_ratio) + 2)
        marks = (marks[:, None] + shifts).ravel()
        inside = (marks > pair.path_start) & (marks < pair.path_end)
        return np.concatenate([contact_limits(pair), marks[inside]])

    def load_share(self, mesh: Mesh, torque: np.ndarray) -> np.ndarray:
        """Share of each slice at each position, from one contact problem a mesh phase and torque."""
        pair = mesh.pair
        position = mesh.position[:: mesh.slices]
        past = np.floor((position - pair.path_start) / pair.base_pitch + 1e-9)
        past = np.minimum(past, _pairs(pair) - 1)
        phase, problem = np.unique(
            np.round((position - past * pair.base_pitch) / pair.base_pitch, 9), return_inverse=True
        )
        torques, which = np.unique(torque, return_inverse=True)
        # Blocks of torques keep the influence matrices of one call within about 100 MB.
        block = max(1, int(4e6 / (phase.size * (_pairs(pair) * mesh.slices) ** 2)))
        solved = [
            distribute(pair, self, torques[i : i + block], phase * pair.base_pitch, mesh.slices).force
            for i in range(0, torques.size, block)
        ]
        force = np.concatenate(solved)[:, problem, past.astype(int)]
        share = force * (pair.base_radius[0] / torques)[:, None, None]
        return share.reshape(torques.size, -1)[which].reshape((*np.shape(torque), -1))


@dataclass(frozen=True, eq=False)
class LoadDistribution:
    """Solved contact problems of T torques at H mesh phases, for P tooth pairs of N slices.

    - ``phase`` (H,): position x (m) of the rearmost pair; pair p is ``p`` base pitches further on
    - ``force`` (T, H, P, N): N, zero where a slice does not touch; sums to T1/r_b1 over pairs and slices
    - ``separation`` (T, H, P, N): what remains of the gap, m; infinite where a pair has left the path
    - ``approach`` (T, H): along the line of action, m; it is the static transmission error
    """

    phase: np.ndarray
    force: np.ndarray
    separation: np.ndarray
    approach: np.ndarray

    @property
    def peak_to_peak(self) -> np.ndarray:
        """Largest minus smallest transmission error over the phases, m, one a torque."""
        return np.ptp(self.approach, axis=1)


def transmission_error(
    pair: GearPair, sharing: LdpSharing, torque: Any, *, phases: int = 40, slices: int | None = None
) -> LoadDistribution:
    """Static transmission error over one base pitch, with the load distribution it comes from.

    ``torque`` in N m, one or many; ``phases`` equidistant positions, half a step off A.

    >>> hong = GearPair((17, 26), 25.4e-3 / 6, math.radians(22.5), 14e-3)
    >>> print(transmission_error(hong, LdpSharing(), [50, 150]).peak_to_peak.round(7))
    [2.9e-06 8.3e-06]
    """
    refuse_other(pair, GearPair, "ml.gear.GearPair(...)", "gear.transmission_error: pair")
    refuse_other(sharing, LdpSharing, "ml.gear.LdpSharing(...)", "gear.transmission_error: sharing")
    sharing.check(pair)
    torques = np.atleast_1d(torques_above_zero(torque)).ravel()
    phases = whole("phases", phases, 1, 100_000)
    slices = sharing.default_slices(pair) if slices is None else whole("slices", slices, 1, 1000)
    start = pair.path_start + pair.base_pitch * (np.arange(phases) + 0.5) / phases
    return distribute(pair, sharing, torques, start, slices)


def distribute(
    pair: GearPair, sharing: LdpSharing, torque: np.ndarray, phase: np.ndarray, slices: int
) -> LoadDistribution:
    """Solve the contact problems of all torques (N m) at all phases (m, within a base pitch from A)."""
    pairs = _pairs(pair)
    position = phase[:, None] + pair.base_pitch * np.arange(pairs)
    possible = np.repeat(position <= pair.path_end + 1e-8 * pair.base_pitch, slices, axis=1)
    width = pair.face_width / slices
    face = (np.arange(slices) + 0.5) * width
    gap = sharing.modifications.gap(pair, position[..., None], face).reshape(phase.size, -1)
    inside = np.minimum(position, pair.path_end)
    bending = _bending(pair, sharing, inside, slices)
    contact = _flattening(pair, np.repeat(inside, slices, axis=1), width)

    shape = (torque.size, phase.size, pairs * slices)
    problems = (torque.size * phase.size, pairs * slices)
    total = np.repeat(torque / pair.base_radius[0], phase.size)
    allowed = np.broadcast_to(possible, shape).reshape(problems)
    stand_back = np.broadcast_to(gap, shape).reshape(problems)
    coupled = np.broadcast_to(bending, shape + shape[2:]).reshape(problems + problems[1:])
    diagonal = np.arange(problems[1])
    force = np.where(allowed, (total / allowed.sum(axis=1))[:, None], 0)
    touching = allowed
    for _ in range(30):
        # Flattening is nearly linear: tangent at the last force, kept off zero where the slope is infinite.
        last = np.maximum(force, 1e-9 * total[:, None])
        flattening, slope = (array.reshape(problems) for array in contact(last.reshape(shape)))
        tangent = coupled.copy()
        tangent[:, diagonal, diagonal] += slope
        before = force
        linear = stand_back + flattening - slope * last
        force, approach, touching = share_out(tangent, linear, total, allowed, touching)
        if np.abs((force - before) / total[:, None]).max() <= 1e-12:
            break
    flattening = contact(np.maximum(force, 1e-9 * total[:, None]).reshape(shape))[0].reshape(problems)
    separation = np.einsum("sij,sj->si", coupled, force) + stand_back - approach[:, None]
    separation = np.where(allowed, separation + flattening * (force > 0), np.inf)
    points = (torque.size, phase.size, pairs, slices)
    return LoadDistribution(
        phase=phase,
        force=force.reshape(points),
        separation=separation.reshape(points),
        approach=approach.reshape(points[:2]),
    )


def _pairs(pair: GearPair) -> int:
    """The largest number of tooth pairs in contact at once."""
    return math.ceil(pair.contact_ratio - 1e-9)


@lru_cache(maxsize=32)
def _bodies(pair: GearPair, foundation: str, bore: Pair | None, slices: int) -> tuple[tuple[Any, Plate], ...]:
    """Foundation coefficients and solved plate of both wheels; they depend on no load."""
    bodies = []
    for wheel in (0, 1):
        body = tooth(pair, wheel)
        poisson = pair.poisson_ratio[wheel]
        if foundation == "sainsot" and bore is not None:
            ratio = body.root_radius / bore[wheel]
            coefficients = sainsot_foundation(ratio, body.half_root_angle)
        else:
            coefficients = weber_foundation(poisson)
        young = pair.youngs_modulus[wheel]
        bodies.append((coefficients, tapered_plate(body, pair.face_width, slices, young, poisson, coefficients)))
    return tuple(bodies)


def _bending(pair: GearPair, sharing: LdpSharing, position: np.ndarray, slices: int) -> np.ndarray:
    """Influence matrices of teeth and roots, shape (H, P N, P N): block diagonal over the pairs.

    The plate gives the coupling across the face; its scale is set so that a uniform load deflects by the
    beam and foundation laws.
    """
    phases, pairs = position.shape
    matrix = np.zeros((phases, pairs, slices, pairs, slices))
    for wheel, (coefficients, plate) in enumerate(_bodies(pair, sharing.foundation, sharing.bore_radius, slices)):
        body = tooth(pair, wheel)
        distance = position if wheel == 0 else pair.line_of_action_length - position
        young, poisson = pair.youngs_modulus[wheel], pair.poisson_ratio[wheel]
        uniform = bending_compliance(body, distance, young, poisson)
        uniform = uniform + foundation_compliance(body, distance, young, coefficients)
        for index in range(pairs):
            block = plate.compliance(body.load_height(distance[:, index]))
            mean = block.sum(axis=(1, 2)) * pair.face_width / slices**2
            matrix[:, index, :, index] += block * (uniform[:, index] / mean)[:, None, None]
    return matrix.reshape(phases, pairs * slices, pairs * slices)


def _flattening(pair: GearPair, position: np.ndarray, width: float) -> Any:
    """Hertzian approach (m) and its slope (m/N) as a function of the slice forces (T, H, P N)."""
    other = pair.line_of_action_length - position
    radius = position * other / pair.line_of_action_length
    depths = tooth(pair, 0).depth(position), tooth(pair, 1).depth(other)

    def contact(force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        approach, slope = hertz_approach(
            force / width, radius, pair.reduced_modulus, depths, pair.youngs_modulus, pair.poisson_ratio
        )
        return approach, slope / width

    return contact
