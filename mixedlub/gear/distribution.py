"""Elastic load distribution of spur and helical gears over tooth pairs and face width, in the manner of LDP.

Every slice of every pair in contact is a point of one contact problem: teeth bend and shear as plates on elastic roots,
flanks flatten, modifications leave gaps, bodies twist if requested, and one rigid approach closes all gaps. A slice of
a helical pair at face position y touches at x + y tan(beta_b), x the position of the pair on the front face. Teeth
couple through the approach and the twist of the bodies only.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.gear.checks import number, torques_above_zero, two, whole
from mixedlub.gear.compliance import SAINSOT_ANGLES
from mixedlub.gear.contact_lines import contact_limits, rise
from mixedlub.gear.contact_solver import share_out, stiffness_of
from mixedlub.gear.corner_contact import REACH, corner_gap
from mixedlub.gear.geometry import GearPair, Pair
from mixedlub.gear.influence import body_torsion, flattening, tooth_influence
from mixedlub.gear.modifications import Modifications
from mixedlub.gear.tooth import tooth
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError, nearest, refuse_other

if TYPE_CHECKING:
    from mixedlub.gear.mesh import Mesh

FOUNDATIONS = ("weber", "sainsot")
ENDS = ("none", "front", "back")
WHEELS = ("pinion", "gear")


@dataclass(frozen=True)
class LdpSharing(Modifications):
    """Elastic sharing of modified teeth, lengths in m.

    ``foundation``: "weber" (half plane) or "sainsot" (ring, needs ``bore_radius``, m, pinion first; about a fifth
    softer). ``torque_end``: the end of the face at which torque enters each body and twists it, "front" (y = 0) or
    "back"; "none": no twist. ``body_radius`` of the twist: by default the middle of the reference circle and the root,
    r - 0.625 m_n.
    """

    foundation: str = "weber"
    bore_radius: Pair | None = None
    torque_end: tuple[str, str] = ("none", "none")
    body_radius: Pair | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.foundation not in FOUNDATIONS:
            raise InputError(nearest(str(self.foundation), FOUNDATIONS), where="foundation", value=self.foundation)
        if self.foundation == "sainsot" and self.bore_radius is None:
            raise InputError("the ring foundation needs the bores", where="bore_diameter_mm")
        ends = two("torque_end", self.torque_end)
        for end in ends:
            if end not in ENDS:
                raise InputError(nearest(str(end), ENDS), where="torque_end", value=end)
        object.__setattr__(self, "torque_end", ends)
        for name, key in (("bore_radius", "bore_diameter_mm"), ("body_radius", "body_diameter_mm")):
            if getattr(self, name) is not None:
                rule = f"a {key.partition('_')[0]} diameter is above zero"
                entries = tuple(number(key, value, 0, 100, rule, 2e3) for value in two(key, getattr(self, name)))
                object.__setattr__(self, name, entries)
        if self.foundation != "sainsot" and self.bore_radius is not None:
            raise InputError('acts only with foundation = "sainsot"', where="bore_diameter_mm")
        if self.body_radius is not None and ends == ("none", "none"):
            raise InputError("acts only with torque_end", where="body_diameter_mm")

    def default_slices(self, pair: GearPair) -> int:
        """Eleven resolve crown and misalignment of usual size; oblique contact lines need some more."""
        return 11 if pair.helix_angle == 0 else 17

    def check(self, pair: GearPair) -> tuple[Finding, ...]:
        """Raise an error for undercut flanks, reliefs longer than the path, bores outside the range of the ring law."""
        self._refuse_long(pair)
        _refuse_undercut(pair)
        if pair.ring:
            self._refuse_on_ring()
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
                found.append(finding("law_extrapolated", text, WHEELS[wheel]))
        return tuple(found)

    def _refuse_on_ring(self) -> None:
        """Raise an error for bodies that a ring gear does not have."""
        for key, wrong in (("foundation", self.foundation != "weber"), ("torque_end", self.torque_end[1] != "none")):
            if wrong:
                rule = "a ring gear has neither bore nor solid body: its teeth stand on a half plane without twist"
                raise InputError(rule, where=key, value=getattr(self, key))

    def body_radii(self, pair: GearPair) -> Pair:
        """Radii (m) of the twisting cylinders."""
        if self.body_radius is not None:
            return self.body_radius
        first, second = pair.reference_radius
        return first - 0.625 * pair.normal_module, second - 0.625 * pair.normal_module

    def breakpoints(self, pair: GearPair) -> np.ndarray:
        """Ends of contact and starts of relief of this pair and, whole base pitches away, of its neighbours."""
        marks = np.concatenate([self.starts(pair), [pair.pitch_point]])
        shifts = pair.base_pitch * np.arange(-int(pair.contact_ratio) - 1, int(pair.contact_ratio) + 2)
        marks = (marks[:, None] + shifts).ravel()
        inside = (marks > pair.path_start) & (marks < pair.path_end)
        return np.concatenate([contact_limits(pair), marks[inside]])

    def load_share(self, mesh: Mesh, torque: np.ndarray) -> np.ndarray:
        """Share of each slice at each position.

        Spur: from one contact problem a mesh phase and torque. Helical: linear between the phases of `_nodes`; over a
        whole path the quadrature misses the steps where slices enter by some 0.3 %, and is scaled to the load.
        """
        pair = mesh.pair
        torques, which = np.unique(torque, return_inverse=True)
        if pair.helix_angle == 0:
            position = mesh.position[:: mesh.slices]
            past = np.floor((position - pair.path_start) / pair.base_pitch + 1e-9)
            past = np.minimum(past, _pairs(pair) - 1)
            phase, problem = np.unique(
                np.round((position - past * pair.base_pitch) / pair.base_pitch, 9), return_inverse=True
            )
            force = distribute(pair, self, torques, phase * pair.base_pitch, mesh.slices).force
            force = force[:, problem, past.astype(int)].reshape(torques.size, -1)
        else:
            phase = _nodes(pair, mesh.slices)
            front = mesh.position - mesh.face_position * math.tan(abs(pair.base_helix_angle))
            force = _between(pair, phase, distribute(pair, self, torques, phase, mesh.slices).force, front)
        share = force * (pair.base_radius[0] / torques)[:, None]
        if pair.helix_angle != 0 and mesh.weight.any():
            share /= (share @ mesh.weight)[:, None] * math.cos(pair.base_helix_angle)
        return share[which].reshape((*np.shape(torque), -1))


def _refuse_undercut(pair: GearPair) -> None:
    """Raise an error if contact starts below the involute that a standard rack leaves."""
    cosine = math.cos(pair.base_helix_angle)
    first = pair.path_start, pair.line_of_action_length - pair.path_end
    if pair.ring:
        begins, touched = tooth(pair, 1).involute_start * cosine, -first[1]
        if touched > begins + 1e-9:
            raise InputError(
                f"interference: the pinion's tips touch the ring {(touched - begins) * 1e3:.4g} mm along the path "
                "beyond its involute, in the fillet",
                where="tip_diameter_mm",
                value=round(2e3 * pair.tip_radii[0], 6),
            )
    for wheel, name in enumerate(WHEELS):
        body = tooth(pair, wheel)
        begins = body.involute_start * cosine
        if body.undercut and begins > first[wheel] + 1e-9:
            raise InputError(
                f"undercut: the involute of the {name} begins {begins * 1e3:.4g} mm from the base tangent point, and "
                f"contact already at {first[wheel] * 1e3:.4g} mm",
                where="profile_shift",
                value=pair.profile_shift[wheel],
            )


@dataclass(frozen=True, eq=False)
class LoadDistribution:
    """Solved contact problems of T torques at H mesh phases, for P tooth pairs of N slices.

    - ``phase`` (H,): position x (m) on the front face of the rearmost pair; pair p is ``p`` base pitches further on
    - ``position`` (H, P, N): where on the path each slice touches, m; ``face`` (N,): its middle, m from the front
    - ``force`` (T, H, P, N): N, zero where a slice does not touch; sums to T1/r_b1 over pairs and slices
    - ``separation`` (T, H, P, N): remaining gap, m; infinite for a slice off the path
    - ``approach`` (T, H): along the line of action, m; it is the static transmission error
    - ``stiffness`` (T, H): slope of the total force over the approach, N/m
    """

    phase: np.ndarray
    position: np.ndarray
    face: np.ndarray
    force: np.ndarray
    separation: np.ndarray
    approach: np.ndarray
    stiffness: np.ndarray

    @property
    def peak_to_peak(self) -> np.ndarray:
        """Largest minus smallest transmission error over the phases, m, one a torque."""
        return np.ptp(self.approach, axis=1)


def transmission_error(
    pair: GearPair,
    sharing: LdpSharing,
    torque: Any,
    *,
    phases: int = 40,
    slices: int | None = None,
    edge_contact: bool = False,
    pitch_deviation: Sequence[float] = (0.0,),
) -> LoadDistribution:
    """Static transmission error over one base pitch, and its load distribution.

    ``torque`` in N m, one or many; ``phases`` equidistant positions a base pitch, half a step off its start.
    ``edge_contact`` lets tips touch beyond the path, with the compliance and curvature of its end. ``pitch_deviation``
    (m): set-back of successive tooth pairs; their number is the period of the error in base pitches.

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
    deviation = np.atleast_1d(np.asarray(pitch_deviation, dtype=float))
    if deviation.ndim != 1 or not np.all(np.isfinite(deviation)):
        raise InputError("finite lengths, one a tooth pair", where="pitch_deviation_um", value=pitch_deviation)
    start = _first_front(pair, edge_contact) + pair.base_pitch * (np.arange(phases) + 0.5) / phases
    # In each further base pitch every tooth pair is one place further on.
    number_of = np.arange(deviation.size)[:, None] - np.arange(_pairs(pair, edge_contact))
    stand_back = np.repeat(deviation[number_of % deviation.size], phases, axis=0)
    phase = np.tile(start, deviation.size)
    return distribute(pair, sharing, torques, phase, slices, edge_contact=edge_contact, stand_back=stand_back)


def distribute(
    pair: GearPair,
    sharing: LdpSharing,
    torque: np.ndarray,
    phase: np.ndarray,
    slices: int,
    *,
    edge_contact: bool = False,
    stand_back: np.ndarray | float = 0.0,
) -> LoadDistribution:
    """Solve the contact problems of all torques (N m) at all phases (m, from the front position of the first contact).

    ``stand_back`` (m), shape (phases, pairs): set-back of whole tooth pairs by pitch deviations.
    """
    pairs = _pairs(pair, edge_contact)
    stand_back = np.broadcast_to(stand_back, (phase.size, pairs))
    # Blocks keep the influence matrices of one call within about 100 MB.
    most = max(1, int(MOST_ENTRIES / (pairs * slices) ** 2))
    torques = max(1, most // phase.size)
    rows = []
    for first in range(0, torque.size, torques):
        some = torque[first : first + torques]
        parts = [slice(start, start + most) for start in range(0, phase.size, most)]
        rows.append([_solved(pair, sharing, some, phase[p], slices, edge_contact, stand_back[p]) for p in parts])
    joined = {
        name: np.concatenate([np.concatenate([getattr(one, name) for one in row], axis=1) for row in rows])
        for name in ("force", "separation", "approach", "stiffness")
    }
    position = np.concatenate([one.position for one in rows[0]])
    return LoadDistribution(phase=phase, position=position, face=rows[0][0].face, **joined)


MOST_ENTRIES = 4e6
"""Most entries of the matrices of a block of contact problems."""


def _solved(
    pair: GearPair,
    sharing: LdpSharing,
    torque: np.ndarray,
    phase: np.ndarray,
    slices: int,
    edge_contact: bool,
    stand_back: np.ndarray,
) -> LoadDistribution:
    """The contact problems of all these torques at all these phases."""
    pairs = _pairs(pair, edge_contact)
    width = pair.face_width / slices
    face = (np.arange(slices) + 0.5) * width
    front = phase[:, None] + pair.base_pitch * np.arange(pairs)
    position = front[..., None] + face * math.tan(abs(pair.base_helix_angle))
    beyond = pair.base_pitch * (REACH if edge_contact else 1e-8)
    possible = (position >= pair.path_start - beyond) & (position <= pair.path_end + beyond)
    inside = np.clip(position, pair.path_start, pair.path_end)
    gap = sharing.gap(pair, inside, face) + stand_back[..., None]
    if edge_contact:
        gap = gap + corner_gap(pair, position)
    bore = sharing.bore_radius if sharing.foundation == "sainsot" else None
    influence = tooth_influence(pair, bore, inside)
    influence += body_torsion(pair, sharing.torque_end, sharing.body_radii(pair), face, pairs)
    size = pairs * slices
    contact = flattening(pair, inside.reshape(phase.size, size), width)

    shape = (torque.size, phase.size, size)
    problems = (torque.size * phase.size, size)
    total = np.repeat(torque / pair.base_radius[0], phase.size)
    allowed = np.broadcast_to(possible.reshape(phase.size, size), shape).reshape(problems)
    initial = np.broadcast_to(gap.reshape(phase.size, size), shape).reshape(problems)
    coupled = np.broadcast_to(influence, shape + shape[2:]).reshape(problems + problems[1:])
    diagonal = np.arange(size)
    force = np.where(allowed, (total / allowed.sum(axis=1))[:, None], 0)
    touching = allowed
    for _ in range(30):
        # Flattening is nearly linear: tangent at the last force, kept off zero where the slope is infinite.
        last = np.maximum(force, 1e-9 * total[:, None])
        flattened, slope = (array.reshape(problems) for array in contact(last.reshape(shape)))
        tangent = coupled.copy()
        tangent[:, diagonal, diagonal] += slope
        before = force
        linear = initial + flattened - slope * last
        force, approach, touching = share_out(tangent, linear, total, allowed, touching)
        if np.abs((force - before) / total[:, None]).max() <= 1e-12:
            break
    flattened = contact(np.maximum(force, 1e-9 * total[:, None]).reshape(shape))[0].reshape(problems)
    separation = np.einsum("sij,sj->si", coupled, force) + initial - approach[:, None]
    separation = np.where(allowed, separation + flattened * (force > 0), np.inf)
    points = (torque.size, phase.size, pairs, slices)
    return LoadDistribution(
        phase=phase,
        position=position,
        face=face,
        force=force.reshape(points),
        separation=separation.reshape(points),
        approach=approach.reshape(points[:2]),
        stiffness=stiffness_of(tangent, touching).reshape(points[:2]),
    )


def _first_front(pair: GearPair, edge_contact: bool = False) -> float:
    """Position on the front face of a pair with its back end coming into contact, m."""
    return pair.path_start - rise(pair) - (REACH * pair.base_pitch if edge_contact else 0.0)


def _pairs(pair: GearPair, edge_contact: bool = False) -> int:
    """The largest number of tooth pairs in contact at once."""
    beyond = 2 * REACH if edge_contact else 0.0
    return math.ceil(pair.contact_ratio + rise(pair) / pair.base_pitch + beyond - 1e-9)


REGULAR_NODES = 32
"""Equidistant phases between which the share of helical slices is interpolated, beside those where slices enter."""


def _nodes(pair: GearPair, slices: int) -> np.ndarray:
    """Phases (m) over one base pitch: equidistant, and on both sides of the start and end of each slice's contact."""
    first, pitch = _first_front(pair), pair.base_pitch
    lag = (np.arange(slices) + 0.5) / slices * rise(pair)
    enters, leaves = pair.path_start - lag, pair.path_end - lag
    aside = 1e-6 * pitch
    marks = np.concatenate([enters, enters - aside, leaves, leaves + aside])
    regular = np.arange(REGULAR_NODES) / REGULAR_NODES
    return first + pitch * np.unique(np.round(np.concatenate([regular, (marks - first) / pitch % 1.0]), 9) % 1.0)


def _between(pair: GearPair, phase: np.ndarray, force: np.ndarray, front: np.ndarray) -> np.ndarray:
    """Slice forces (T, M) at given front positions (M, slices fastest), linear between the solved phases."""
    torques, _, pairs, slices = force.shape
    known = (phase + pair.base_pitch * np.arange(pairs)[:, None]).ravel()
    wanted = front.reshape(-1, slices)
    found = np.empty((torques, *wanted.shape))
    for one in range(torques):
        for index in range(slices):
            found[one, :, index] = np.interp(wanted[:, index], known, force[one, :, :, index].T.ravel())
    return found.reshape(torques, -1)
