"""The shape of a tooth as an elastic body: half thickness over height, from its root section to its tip.

Above the fillet the flank is the involute of the gear pair; below, it is the trochoid of the rounded corner of a
generating rack. Coordinates: y along the tooth centreline from the wheel's axis. Helical teeth are treated in their
normal section, as the virtual spur gear.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mixedlub.gear.geometry import GearPair, involute
from profiles.errors import InputError

CORNER = 0.38  # radius of the tip of the standard rack of ISO 53 A, in modules
ROOT_TANGENT = math.radians(30)  # root section where the fillet's tangent is this far from the centreline
RING_FILLET = 0.15  # radius of the root fillet of a ring gear where none is known, in modules (ISO 6336-3)
RING_TANGENT = math.radians(60)  # the same angle of a ring, whose flanks open towards the root (ISO 6336-3)
LEAST_CLEARANCE = 0.2  # of the mate's tip in the root of a deeper cut tooth, in modules


@dataclass(frozen=True)
class NormalSection:
    """Virtual spur gear of a wheel in its normal section; radii in m. A spur wheel is unchanged.

    z_n = z/(cos^2 beta_b cos beta) teeth of the normal module and pressure angle. A distance ``x`` from the base
    tangent point in the transverse plane is x/cos(beta_b) here, like the radius of curvature.

    Source: ISO 21771 (virtual number of teeth); ISO 6336-3, virtual gears.

    >>> print(round(normal_section(GearPair((17, 103), 8e-3, math.radians(20), 0.1, math.radians(15.8)), 0).teeth, 3))
    18.905
    """

    teeth: float
    module: float
    pressure_angle: float
    profile_shift: float
    reference_radius: float
    base_radius: float
    tip_radius: float
    root_radius: float

    @property
    def half_angle(self) -> float:
        """Half the angle of a tooth at its base circle."""
        shift = 2 * self.profile_shift * math.tan(self.pressure_angle)
        return (math.pi / 2 + shift) / self.teeth + involute(self.pressure_angle)


def normal_section(pair: GearPair, wheel: int) -> NormalSection:
    """Virtual spur gear of wheel 0 or 1."""
    square = math.cos(pair.base_helix_angle) ** 2
    reference = pair.reference_radius[wheel] / square
    if pair.helix_angle == 0:
        base, tip = pair.base_radius[wheel], pair.tip_radii[wheel]
    else:
        base = reference * math.cos(pair.pressure_angle)
        roll_distance = math.sqrt(pair.tip_radii[wheel] ** 2 - pair.base_radius[wheel] ** 2)
        tip = math.copysign(math.hypot(base, roll_distance / math.sqrt(square)), base)
    return NormalSection(
        teeth=pair.teeth[wheel] / (square * math.cos(pair.helix_angle)),
        module=pair.normal_module,
        pressure_angle=pair.pressure_angle,
        profile_shift=pair.profile_shift[wheel],
        reference_radius=reference,
        base_radius=base,
        tip_radius=tip,
        root_radius=reference - (pair.reference_radius[wheel] - root_circle(pair, wheel)),
    )


@dataclass(frozen=True, eq=False)
class Tooth:
    """Half thickness of a tooth over its height, root section first, and data of the root.

    ``height``: y (m) from the wheel's axis; ``half_thickness`` (m); ``root_radius`` of the root circle; the involute
    begins ``involute_start`` (m) from the base tangent point. All per wheel, in the normal section, with roll distances
    of the transverse plane over cos(beta_b).
    """

    base_radius: float
    half_angle: float
    root_radius: float
    height: np.ndarray
    half_thickness: np.ndarray
    involute_start: float = 0.0
    undercut: bool = False

    @property
    def root_chord(self) -> float:
        """Thickness s_f of the root section, m."""
        return 2 * float(self.half_thickness[0])

    @property
    def half_root_angle(self) -> float:
        """Half the angle (rad) of the root section, seen from the wheel's axis."""
        return math.atan(float(self.half_thickness[0] / self.height[0]))

    def load_angle(self, roll_distance: np.ndarray) -> np.ndarray:
        """Angle (rad) between the load line and the normal of the centreline, alpha' = x/r_b - half_angle."""
        return np.asarray(roll_distance) / self.base_radius - self.half_angle

    def load_height(self, roll_distance: np.ndarray) -> np.ndarray:
        """Crossing of the load line and the centreline, y_p = r_b / cos(alpha'), m from the axis."""
        return self.base_radius / np.cos(self.load_angle(roll_distance))

    def depth(self, roll_distance: np.ndarray) -> np.ndarray:
        """Distance (m) along the load line from the flank to the centreline."""
        angle = np.arctan(np.asarray(roll_distance) / self.base_radius)
        half = self.half_angle - (np.tan(angle) - angle)
        return self.base_radius / np.cos(angle) * np.sin(half) / np.cos(self.load_angle(roll_distance))


def root_circle(pair: GearPair, wheel: int) -> float:
    """Root radius (m) by the dedendum of the rack, or smaller for clearance to the mate's tip.

    r - m_n (h_fP - x), at most a_w - r_a,mate - 0.2 m_n (deep profiles of high contact ratio need it).
    """
    module = pair.normal_module
    standard = pair.reference_radius[wheel] - module * (pair.dedendum - pair.profile_shift[wheel])
    return min(standard, pair.working_centre_distance - pair.tip_radii[1 - wheel] - LEAST_CLEARANCE * module)


@lru_cache(maxsize=64)
def tooth(pair: GearPair, wheel: int, points: int = 400) -> Tooth:
    """The tooth of wheel 0 or 1 as generated by a standard rack, its root section at the 30 degree tangent.

    A ring's tooth has a circular fillet, and its root section at the 60 degree tangent; heights count from the axis
    inwards, below zero, so that they rise to the tip like those of other teeth.

    >>> pinion = tooth(GearPair((17, 43), 1e-3, math.radians(20), 10e-3), 0)
    >>> round(pinion.root_chord * 1e3, 2)
    1.89
    """
    section = normal_section(pair, wheel)
    fillet_height, fillet_half, form = _ring_fillet(section) if section.teeth < 0 else _fillet(section)
    base, tip = section.base_radius, section.tip_radius
    radius = form + (tip - form) * np.linspace(0, 1, points) ** 2
    angle = np.arccos(np.minimum(base / radius, 1))
    half = section.half_angle - (np.tan(angle) - angle)
    flank_height, flank_half = radius * np.cos(half), radius * np.sin(half)
    height = np.linspace(fillet_height[0], flank_height[-1], points)
    on_flank = np.interp(height, flank_height, flank_half, left=np.inf)
    on_fillet = np.interp(height, fillet_height, fillet_half, right=np.inf)
    # An undercut fillet crosses the involute above the base circle; else they meet where the flank begins.
    undercut = abs(form) <= abs(base)
    thickness = np.minimum(on_flank, on_fillet) if undercut else np.where(height < flank_height[0], on_fillet, on_flank)
    if not np.all(np.isfinite(thickness)) or thickness.min() <= 0:
        raise InputError("undercut leaves no tooth to carry load", where="profile_shift", value=pair.profile_shift)
    cut = int(np.flatnonzero(on_fillet <= on_flank).max(initial=0))
    begin = math.hypot(height[cut], thickness[cut]) if undercut else form
    for array in (height, thickness):
        array.flags.writeable = False
    start = math.sqrt(max(begin**2 - base**2, 0.0))
    return Tooth(base, section.half_angle, section.root_radius, height, thickness, start, undercut)


def _fillet(section: NormalSection) -> tuple[np.ndarray, np.ndarray, float]:
    """Trochoid of the rack's corner from the root section outwards: heights, half thicknesses; form radius (m)."""
    module, alpha = section.module, section.pressure_angle
    pitch, root = section.reference_radius, section.root_radius
    shift = section.profile_shift * module
    depth = pitch - root + shift
    below = pitch - root
    flat = math.pi / 4 * module - depth * math.tan(alpha)
    corner = min(CORNER * module, flat * math.cos(alpha) / (1 - math.sin(alpha)), 0.9 * below)
    if flat <= 0 or corner <= 0.02 * module:
        raise InputError(
            "no standard rack cuts this tooth: root too near or too far for the elastic load distribution",
            where="profile_shift",
            value=section.profile_shift,
        )
    centre = below - corner
    side = flat - corner * (1 - math.sin(alpha)) / math.cos(alpha)
    # The normal of the fillet passes through the pitch point, a distance ``slide`` from the corner's centre.
    slide = centre / math.tan(alpha) * np.linspace(0, 1.5, 600) ** 2
    stretch = 1 + corner / np.hypot(slide, centre)
    across, up = slide * stretch, pitch - centre * stretch
    half = math.pi / section.teeth - (np.arctan2(across, up) - (slide - side) / pitch)
    radius = np.hypot(across, up)
    height, thickness = radius * np.cos(half), radius * np.sin(half)
    steep = -np.diff(thickness) > math.tan(ROOT_TANGENT) * np.diff(height)
    first = int(np.argmin(steep))
    reach = pitch * math.sin(alpha) - (centre + corner * math.sin(alpha)) / math.sin(alpha)
    form = math.hypot(section.base_radius, max(reach, 0.0))
    return height[first:], thickness[first:], form


def _ring_fillet(section: NormalSection) -> tuple[np.ndarray, np.ndarray, float]:
    """Circular fillet of a ring's tooth from the root section to the flank, as `_fillet`; radii below zero.

    The fillet touches flank and root circle: its centre lies on the flank's normal, rho nearer to the base circle.
    """
    base, root = abs(section.base_radius), abs(section.root_radius)
    fillet = RING_FILLET * section.module
    to_centre = math.sqrt((root - fillet) ** 2 - base**2)
    form = math.hypot(base, to_centre + fillet)
    tangent = (to_centre + fillet) / base - section.half_angle
    centre = tangent - math.atan(to_centre / base)
    if centre > math.pi / abs(section.teeth):
        raise InputError(
            "the tooth spaces of the ring are too narrow for their root fillet",
            where="profile_shift",
            value=section.profile_shift,
        )
    flank = tangent - math.atan((to_centre + fillet) / base)
    across, up = (root - fillet) * math.sin(centre), (root - fillet) * math.cos(centre)
    begins = math.atan2(form * math.sin(flank) - across, form * math.cos(flank) - up)
    turn = np.linspace(centre, begins, 600)
    thickness, height = across + fillet * np.sin(turn), -(up + fillet * np.cos(turn))
    steep = -np.diff(thickness) > math.tan(RING_TANGENT) * np.diff(height)
    first = int(np.argmin(steep))
    return height[first:], thickness[first:], -form
