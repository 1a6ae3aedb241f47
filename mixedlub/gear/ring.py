"""Checks of a ring gear with the wheel inside it: tips that foul each other, and undercut flanks."""

from __future__ import annotations

import math
from typing import Any

from profiles.errors import InputError

Internal = Any
"""Gear pair of which the second wheel is a ring; its class, in `mixedlub.gear.geometry`, calls these functions."""

CORNER = 0.38
"""Source: ISO 53, rack A. Radius of the tip of the rack that cuts the inner wheel, in modules."""


def tip_clearance(pair: Internal) -> float:
    r"""Clearance (m) along the ring's tip circle where the tips of both wheels pass each other; inf if they never do.

    .. math:: c = r_{a2}\left[\frac{z_1}{z_2}(\theta_1 + \mathrm{inv}\,\alpha_{a1} - \mathrm{inv}\,\alpha_w)
              + \mathrm{inv}\,\alpha_w - \mathrm{inv}\,\alpha_{a2} - \theta_2\right]

    with all sizes positive, theta_1 and theta_2 the angles from the line of centres to the crossing of the tip circles:
    cos(theta_1) = (r_a2^2 - r_a1^2 - a^2)/(2 a r_a1), cos(theta_2) = (r_a2^2 + a^2 - r_a1^2)/(2 a r_a2). Without
    backlash. Below zero the tips foul each other away from the path of contact (trochoid interference).

    Source: the condition of trochoid interference in SDP/SI, Elements of Metric Gear Technology, section 5.2.
    """
    centre = abs(pair.working_centre_distance)
    inner, outer = (abs(tip) for tip in pair.tip_radii)
    if inner - centre > outer:
        # The tip circle of the wheel lies around the one of the ring: the teeth foul each other all round.
        return outer + centre - inner
    first = (outer**2 - inner**2 - centre**2) / (2 * centre * inner)
    second = (outer**2 + centre**2 - inner**2) / (2 * centre * outer)
    if abs(first) >= 1 or abs(second) >= 1:
        return math.inf
    angles = (math.acos(abs(base) / tip) for base, tip in zip(pair.base_radius, (inner, outer)))
    of_inner, of_outer, working = (math.tan(a) - a for a in (*angles, pair.working_pressure_angle))
    turned = (math.acos(first) + of_inner - working) / pair.gear_ratio + working - of_outer
    return outer * (turned - math.acos(second))


def involute_start(pair: Internal) -> float:
    """Position (m) on the path from which the inner wheel has an involute, as a rack with rounded tips cuts it.

    The straight flank of the rack reaches h_fP - x - rho (1 - sin alpha_n) below the reference circle: the involute
    begins r sin(alpha_t) less this depth over sin(alpha_t) from the base tangent point, at the earliest at that point.
    A ring of the addendum 1 reaches further down than the rack.
    """
    alpha = pair.transverse_pressure_angle
    straight = pair.dedendum - pair.profile_shift[0] - CORNER * (1 - math.sin(pair.pressure_angle))
    return max(pair.reference_radius[0] * math.sin(alpha) - straight * pair.normal_module / math.sin(alpha), 0.0)


def longest_ring_tip(pair: Internal) -> float:
    """Smallest tip radius (m, positive) of a ring that meets the involute of the inner wheel."""
    return math.hypot(pair.base_radius[1], involute_start(pair) - pair.line_of_action_length)


def refuse_interference(pair: Internal, tips: tuple[float, ...], standard: str) -> None:
    """Raise an error for a ring with tips that foul the tips or the root of the wheel inside it.

    ``tips``, ``standard``: tip diameters (mm) and a remark on them for the message.
    """
    clearance, depth = tip_clearance(pair), involute_start(pair) - pair.path_start
    if clearance < 0:
        rule = (
            f"interference: the tips of the ring and of the wheel inside it overlap by {-clearance * 1e3:.4g} mm away "
            "from the path of contact; shorter tips, or teeth that differ more in number, pass each other"
        )
        raise InputError(rule + standard, where="tip_diameter_mm", value=tips)
    if depth > 1e-6 * pair.normal_module:
        rule = (
            f"undercut: contact starts {depth * 1e3:.4g} mm along the path before the involute that the rack leaves on "
            f"the pinion; the ring's tip diameter must be at least {2e3 * longest_ring_tip(pair):.6g} mm for this "
            "profile_shift and dedendum"
        )
        raise InputError(rule + standard, where="tip_diameter_mm", value=tips)
