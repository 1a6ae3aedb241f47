"""Contact lines of a pair over one pitch of the mesh: points, their share of the load, and what a turn of it moves."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np

from mixedlub.skew_gears.blank import Blank
from mixedlub.skew_gears.flank import Contact, contact_at
from mixedlub.skew_gears.placing import Axes, axes
from profiles.errors import InputError

Search = Callable[[np.ndarray, np.ndarray], tuple[Contact, np.ndarray]]
"""Contact on a grid of places along the face and heights, and where it is inside both flanks."""
CROWNING: Mapping[str, float] = {"none": math.inf, "low": 3.0, "high": 1.5}
"""Source: ISO 10300-2, table 5. Exponent by which the peak load of a line falls off the middle of the mesh."""
MARGIN = 1.5
"""Judgement. Depth of the searched flank over the addendum, so that its edges lie inside."""
ZOOMS, ZOOMED = 5, 15
"""Grid. Grids, and their points each way, by which the ends of contact are found."""
HEIGHTS = 48
"""Grid. Heights between which the turn of the wheel is interpolated; the contact is then computed again, exactly."""


@dataclass(frozen=True, eq=False)
class ContactLines:
    """Points of all contact lines at some positions of one pitch.

    ``contact``: of every point; ``position``: number of its position of the mesh; ``length``: length of the line that a
    point stands for (m); ``shape``: line load of a point over the largest possible one; ``along`` and ``height``: of
    the crown gear's flank (m); ``tooth``: pitches between the tooth pair and the pair at the mean point.
    """

    blank: Blank
    axes: Axes
    drive: bool
    positions: int
    contact: Contact
    position: np.ndarray
    tooth: np.ndarray
    along: np.ndarray
    height: np.ndarray
    length: np.ndarray
    shape: np.ndarray
    contact_ratio: float

    @property
    def weight(self) -> np.ndarray:
        """Length of each point times its shape of the load (m)."""
        return self.length * self.shape

    @cached_property
    def drive_speed(self) -> np.ndarray:
        """Speed along the normal, of both flanks, in the sense in which the pinion drives (m)."""
        return np.abs(np.einsum("...i,...i->...", self.contact.normal, self.contact.velocity[0]))

    @cached_property
    def pinion_slip(self) -> np.ndarray:
        """Pinion's velocity along the sliding direction (m)."""
        sliding = self.contact.sliding
        size = np.maximum(np.linalg.norm(sliding, axis=-1), np.finfo(float).tiny)
        return np.asarray(np.einsum("...i,...i->...", sliding, self.contact.velocity[0])) / size

    @cached_property
    def lengthwise_sliding(self) -> np.ndarray:
        """Sliding velocity along the teeth, pinion less wheel (m)."""
        return np.asarray(np.einsum("...i,...i->...", self.contact.sliding, self.contact.lengthwise))

    @cached_property
    def profile_sliding(self) -> np.ndarray:
        """Sliding speed in the direction of the profile (m)."""
        return np.sqrt(np.maximum(self.contact.sliding_speed**2 - self.lengthwise_sliding**2, 0.0))

    def over_positions(self, values: np.ndarray) -> np.ndarray:
        """Sum of values by position, over the last axis."""
        found = np.zeros((*values.shape[:-1], self.positions))
        for position in range(self.positions):
            found[..., position] = values[..., self.position == position].sum(axis=-1)
        return found

    def at_position(self, sums: np.ndarray) -> np.ndarray:
        """Value of each point's position."""
        return np.asarray(sums[..., self.position])


def mean_contact(blank: Blank, *, drive: bool = True) -> Contact:
    """Contact at the mean point."""
    return contact_at(blank, axes(blank.cones), np.array([0.0]), np.array([0.0]), drive=drive)


def contact_lines(
    blank: Blank,
    *,
    drive: bool = True,
    crowning: str = "low",
    face_share: float = 0.85,
    positions: int = 16,
    points: int = 41,
) -> ContactLines:
    """Contact lines at positions of one pitch; raise an error for flanks that cut each other.

    ``face_share``: part of both faces that bears load; ``points``: points along the face.
    """
    placed = axes(blank.cones)
    (inner, outer), depth = blank.face[1], MARGIN * max(*blank.addendum, *blank.dedendum)
    # The trace reaches beyond the face, since contact moves along it with the height.
    beyond = 0.5 * depth
    low, high = -face_share * inner - beyond, face_share * outer + beyond
    if not blank.trace.is_straight:
        least, most = (end - blank.trace.distance for end in blank.trace.ends())
        low, high = max(low, 0.999 * least), min(high, 0.999 * most)
    along = np.linspace(low, high, points)
    heights = np.linspace(-depth, depth, HEIGHTS)

    def searched(along: np.ndarray, heights: np.ndarray) -> tuple[Contact, np.ndarray]:
        with np.errstate(invalid="ignore"):
            grid = contact_at(blank, placed, along[:, None], heights, drive=drive)
            return grid, _margin(blank, placed, grid, face_share) >= 0.0

    grid, inside = searched(along, heights)
    if not inside.any():
        raise InputError("no part of the flanks comes into contact", where="gears")
    _refuse_cut(blank, grid, inside)
    turns, pitch = grid.wheel_angle, 2 * math.pi / blank.basic.teeth[1]
    first, last = (_end_of_mesh(searched, along, heights, sign) for sign in (-1.0, 1.0))
    chosen = []
    for position in range(positions):
        shift = (position + 0.5) / positions * pitch
        for tooth in range(math.ceil((first - shift) / pitch), math.floor((last - shift) / pitch) + 1):
            chosen.append((position, tooth, shift + tooth * pitch))
    height = np.stack([[_height_at(row, heights, turn) for row in turns] for _, _, turn in chosen])
    lines = contact_at(blank, placed, np.broadcast_to(along, height.shape), height, drive=drive)
    length = _lengths(lines.place, _margin(blank, placed, lines, face_share))
    middle, half = (first + last) / 2, (last - first) / 2
    turn = np.array([turn for _, _, turn in chosen])[:, None]
    shape = _load_shape(length, (turn - middle) / half, CROWNING[crowning])
    kept = length > 0.0
    index = np.array([(position, tooth) for position, tooth, _ in chosen])
    return ContactLines(
        blank=blank,
        axes=placed,
        drive=drive,
        positions=positions,
        contact=_taken(lines, kept),
        position=np.broadcast_to(index[:, :1], kept.shape)[kept],
        tooth=np.broadcast_to(index[:, 1:], kept.shape)[kept],
        along=np.broadcast_to(along, kept.shape)[kept],
        height=height[kept],
        length=length[kept],
        shape=shape[kept],
        contact_ratio=(last - first) / pitch,
    )


def _margin(blank: Blank, placed: Axes, contact: Contact, face_share: float) -> np.ndarray:
    """Distance (m) of contact points from the nearest edge of both flanks, negative outside."""
    margins = []
    for member in (0, 1):
        height, along = placed.in_axial_plane(member, contact.place)
        inner, outer = blank.face[member]
        tip = blank.addendum[member] + along * math.tan(blank.tip_angle[member])
        margins += [tip - height, along + face_share * inner, face_share * outer - along]
    found = np.min(margins, axis=0)
    return np.asarray(np.where(np.isfinite(contact.curvature), found, -np.inf))


def _refuse_cut(blank: Blank, grid: Contact, inside: np.ndarray) -> None:
    """Raise an error where the working flanks are undercut: their relative curvature changes its sign."""
    cut = inside & (grid.curvature <= 0.0)
    if cut.any():
        from mixedlub.skew_gears.undercut import shift_limits

        worst = max(shift_limits(blank), key=lambda one: (one.limit - one.shift) * (1 if one.member == 0 else -1))
        member, end = ("pinion", "wheel")[worst.member], "inner" if worst.inner else "outer"
        bound = "at least" if worst.member == 0 else "at most"
        rule = (
            f"the {member} is undercut at the {end} end: ISO 23509 asks for a profile shift of {bound} "
            f"{worst.limit:.3g} there"
        )
        raise InputError(rule, where="gears.profile_shift", value=round(worst.shift, 6))


def _end_of_mesh(searched: Search, along: np.ndarray, heights: np.ndarray, sign: float) -> float:
    """Turn of the wheel at which contact begins (``sign`` -1) or ends, by grids drawn closer and closer."""
    end = 0.0
    for _ in range(ZOOMS):
        grid, inside = searched(along, heights)
        turn = np.where(inside, sign * grid.wheel_angle, -np.inf)
        row, column = divmod(int(np.argmax(turn)), turn.shape[1])
        end = float(grid.wheel_angle[row, column])
        along, heights = _closer(along, row), _closer(heights, column)
    return end


def _closer(values: np.ndarray, index: int) -> np.ndarray:
    """Values between both neighbours of one of them."""
    return np.linspace(values[max(index - 1, 0)], values[min(index + 1, values.size - 1)], ZOOMED)


def _height_at(turns: np.ndarray, heights: np.ndarray, turn: float) -> float:
    """Height at which the flank at one place of the face is in contact; beyond the flank, its end."""
    known = np.isfinite(turns)
    if np.count_nonzero(known) < 2:
        return 0.0
    order = np.argsort(turns[known])
    return float(np.interp(turn, turns[known][order], heights[known][order]))


def _lengths(place: np.ndarray, margin: np.ndarray) -> np.ndarray:
    """Length of line that each point stands for: half of both stretches to its neighbours, as far as inside."""
    steps = np.linalg.norm(np.diff(place, axis=1), axis=-1)
    one, other = margin[:, :-1], margin[:, 1:]
    most, least = np.maximum(one, other), np.minimum(one, other)
    with np.errstate(invalid="ignore", divide="ignore"):
        crossing = most / (most - least)
    share = np.where(least >= 0.0, 1.0, np.where(most > 0.0, np.nan_to_num(crossing), 0.0))
    half = np.nan_to_num(steps) * share / 2
    return np.asarray(np.pad(half, ((0, 0), (1, 0))) + np.pad(half, ((0, 0), (0, 1))))


def _load_shape(length: np.ndarray, turn: np.ndarray, exponent: float) -> np.ndarray:
    """Line load over its largest value: parabola of the peak over the mesh, half ellipse along each line.

    Source: ISO 10300-2, formulas 7 to 9.
    """
    if math.isinf(exponent):
        return np.ones(length.shape)
    run = np.cumsum(length, axis=1) - length / 2
    whole = np.maximum(length.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    out = np.clip(2 * run / whole - 1, -1, 1)
    peak = np.maximum(1 - np.abs(turn) ** exponent, 0.0)
    return np.asarray(peak * np.sqrt(1 - out**2))


def _taken(contact: Contact, kept: np.ndarray) -> Contact:
    own: dict[str, Any] = {one.name: getattr(contact, one.name) for one in fields(contact)}
    for name, value in own.items():
        own[name] = tuple(part[kept] for part in value) if isinstance(value, tuple) else value[kept]
    return Contact(**own)
