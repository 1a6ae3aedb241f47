"""Undercut of bevel and hypoid gears by ISO 23509, clause 8."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mixedlub.skew_gears.blank import Blank

TOOL_EDGE = 1.1
"""Source: ISO 23509, formulas 246 and 258. Factor on the tool's addendum for its rounded edge."""


@dataclass(frozen=True)
class ShiftLimit:
    """Limit of the pinion's profile shift at an end of a face: the least (pinion) or the largest (wheel)."""

    member: int
    inner: bool
    limit: float
    shift: float


def shift_limits(blank: Blank) -> tuple[ShiftLimit, ...]:
    """Limits of the profile shift at both ends of both faces."""
    if blank.trace.is_straight:
        return ()
    shift = blank.data.profile_shift
    found = []
    for inner in (True, False):
        found.append(ShiftLimit(0, inner, _least(blank, blank.cone_ends(0)[not inner]), shift))
        found.append(ShiftLimit(1, inner, _largest(blank, blank.cone_ends(1)[not inner]), shift))
    return tuple(found)


def _least(blank: Blank, distance: float) -> float:
    """Formulas 227 to 247, for the pinion."""
    cones, module = blank.cones, blank.cones.normal_module
    (mean1, mean2), (pinion, wheel) = cones.cone_distance, cones.angle
    zeta = cones.offset_angle
    reach = math.sqrt(mean2**2 + (mean1 - distance) ** 2 - 2 * mean2 * (mean1 - distance) * math.cos(zeta))
    beta2 = float(blank.trace.spiral_angle(np.array(reach - mean2)))
    beta1 = beta2 + math.asin(mean2 * math.sin(zeta) / reach)
    own, other = 2 * distance * math.sin(pinion), 2 * reach * math.sin(wheel)
    normal = other / cones.teeth[1] * math.cos(beta2)
    effective = normal * cones.teeth[0] / math.cos(beta1)
    cone = effective / (2 * math.sin(pinion))
    limit = -math.atan(
        math.tan(pinion)
        * math.tan(wheel)
        / math.cos(zeta)
        * (cone * math.sin(beta1) - reach * math.sin(beta2))
        / (cone * math.tan(pinion) + reach * math.tan(wheel))
    )
    drive, coast = blank.pressure_angle
    least = min(drive - limit, coast + limit)
    tool = blank.data.addendum + (reach - mean2) * math.tan(blank.tip_angle[1]) / module
    teeth = _virtual_teeth(blank, cones.teeth[0], beta1, pinion)
    at_end = TOOL_EDGE * tool - teeth * normal * math.sin(least) ** 2 / (2 * module)
    return at_end + (effective - own) * math.cos(pinion) / (2 * module)


def _largest(blank: Blank, distance: float) -> float:
    """Formulas 248 to 258, for the wheel, whose profile shift is the negative of the pinion's."""
    cones, module = blank.cones, blank.cones.normal_module
    mean, wheel = cones.cone_distance[1], cones.angle[1]
    beta = float(blank.trace.spiral_angle(np.array(distance - mean)))
    normal = 2 * distance * math.sin(wheel) / cones.teeth[1] * math.cos(beta)
    tool = blank.data.addendum + (distance - mean) * math.tan(blank.root_angle[1]) / module
    teeth = _virtual_teeth(blank, cones.teeth[1], beta, wheel)
    return teeth * normal * math.sin(min(blank.pressure_angle)) ** 2 / (2 * module) - TOOL_EDGE * tool


def _virtual_teeth(blank: Blank, teeth: int, spiral: float, angle: float) -> float:
    """Teeth in the normal section, formulas 239 and 254."""
    pressure = sum(blank.data.pressure_angle) / 2
    flat = 1 - (math.sin(spiral) * math.cos(pressure)) ** 2
    return teeth / (flat * math.cos(spiral) * math.cos(angle))
