"""Blank of bevel and hypoid gears by ISO 23509: depths, cones of tips and roots, faces, spiral angles, thickness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mixedlub.skew_gears.lengthwise import Trace, crown_trace
from mixedlub.skew_gears.pitch_cones import Basic, PitchCones, crown_ratio, pitch_cones
from profiles.errors import InputError

Both = tuple[float, float]


@dataclass(frozen=True)
class ToothData:
    """Tooth data of type I, ISO 23509 table 3, in SI; ``pressure_angle``: nominal, drive and coast side.

    ``limit_share``: part of the limit pressure angle in the generated angles; ``profile_shift``: of the pinion;
    ``wheel_angles``: addendum and dedendum angle of the wheel; ``backlash``: outer transverse backlash.
    """

    pressure_angle: Both
    limit_share: float = 1.0
    profile_shift: float = 0.0
    addendum: float = 1.0
    dedendum: float = 1.25
    thickness: float = 0.0
    wheel_angles: Both = (0.0, 0.0)
    backlash: float = 0.0


@dataclass(frozen=True)
class Blank:
    """Blank of a pair; pairs are pinion, wheel.

    ``face``: face width along the pitch cone inside and outside the mean point, of each; ``apex_beyond``: pitch apex
    beyond the crossing point; ``tip_angle`` and ``root_angle``: from the pitch cone to the cones of tips and roots.
    """

    basic: Basic
    data: ToothData
    cones: PitchCones
    trace: Trace
    pressure_angle: Both
    addendum: Both
    dedendum: Both
    tip_angle: Both
    root_angle: Both
    face: tuple[Both, Both]
    apex_beyond: Both
    spiral_ends: tuple[Both, Both]
    thickness: Both

    @property
    def effective_angle(self) -> Both:
        """Effective pressure angles, drive and coast side, measured from the limit pressure angle."""
        limit = self.cones.limit_angle
        return self.pressure_angle[0] - limit, self.pressure_angle[1] + limit

    @property
    def face_width(self) -> Both:
        """Face widths along the pitch cones."""
        pinion, wheel = (inner + outer for inner, outer in self.face)
        return pinion, wheel

    @property
    def pitch_offset(self) -> float:
        """Offset in the pitch plane."""
        return self.cones.cone_distance[1] * math.sin(self.cones.offset_angle) if self.cones.offset else 0.0

    def cone_ends(self, member: int) -> Both:
        """Inner and outer cone distance of a member."""
        inner, outer = self.face[member]
        return self.cones.cone_distance[member] - inner, self.cones.cone_distance[member] + outer

    def tip_diameter(self, member: int) -> float:
        """Outside diameter."""
        outer, angle = self.face[member][1], self.cones.angle[member]
        height = self.addendum[member] + outer * math.tan(self.tip_angle[member])
        return 2 * (self.cones.radius[member] + outer * math.sin(angle) + height * math.cos(angle))


def blank(basic: Basic, data: ToothData) -> Blank:
    """Blank by ISO 23509, clause 7; formulas are numbered there."""
    cones = pitch_cones(basic)
    module, (pinion, wheel) = cones.normal_module, cones.angle
    trace = crown_trace(cones.cone_distance[1], cones.spiral[1], basic.cutter_radius, crown_ratio(basic, cones))
    drive, coast = data.pressure_angle
    share = data.limit_share * cones.limit_angle
    tip, root = data.wheel_angles
    heights = [module * (data.addendum + sign * data.profile_shift) for sign in (1, -1)]
    depths = [module * (data.dedendum - sign * data.profile_shift) for sign in (1, -1)]
    departure = basic.shaft_angle - math.pi / 2
    apex = _apex_beyond(cones, departure)
    if trace.is_straight:
        tips, roots = (0.0, tip), (0.0, root)
        turns = (0.0, 0.0)
    else:
        turns = (
            _offset_angle(basic, cones, apex[1], departure, wheel - root, root),
            _offset_angle(basic, cones, apex[1], departure, wheel + tip, tip),
        )
        tips = (_mate(departure, wheel - root, turns[0]) - pinion, tip)
        roots = (pinion - _mate(departure, wheel + tip, turns[1]), root)
    outer = cones.outer_share * basic.face_width
    wheel_face = (basic.face_width - outer, outer)
    _check_face(trace, wheel_face)
    pinion_face = _pinion_face(basic, data, cones, module, heights[0], depths[1], tips[0], turns[0], wheel_face)
    ends = _spiral_ends(cones, trace, pinion_face, wheel_face)
    return Blank(
        basic=basic,
        data=data,
        cones=cones,
        trace=trace,
        pressure_angle=(drive + share, coast - share),
        addendum=(heights[0], heights[1]),
        dedendum=(depths[0], depths[1]),
        tip_angle=tips,
        root_angle=roots,
        face=(pinion_face, wheel_face),
        apex_beyond=apex,
        spiral_ends=ends,
        thickness=_thickness(data, cones, module, (drive + coast) / 2, outer),
    )


def _check_face(trace: Trace, face: Both) -> None:
    """Raise an error for a face that reaches the apex, or where the cutter does not."""
    if trace.is_straight:
        return
    inner, outer = trace.distance - face[0], trace.distance + face[1]
    least, most = trace.ends()
    if min(face) <= 0.0 or inner <= 0.0:
        rule = f"is too wide: the mean cone distance of the wheel is {1e3 * trace.distance:.4g} mm"
        raise InputError(rule, where="gears.wheel_face_width_mm", value=1e3 * (face[0] + face[1]))
    if inner <= least or outer >= most:
        rule = f"cuts cone distances from {1e3 * least:.4g} to {1e3 * most:.4g} mm, but the wheel's face reaches from "
        rule += f"{1e3 * inner:.4g} to {1e3 * outer:.4g} mm"
        raise InputError(rule, where="gears.cutter_radius_mm", value=1e3 * trace.cutter)


def _apex_beyond(cones: PitchCones, departure: float) -> Both:
    """Formulas 113 and 129 to 131."""
    if math.isinf(cones.cone_distance[1]):
        return 0.0, 0.0
    (r1, r2), (d1, d2) = cones.radius, cones.angle
    axial = math.asin(cones.offset / (r2 + r1 * math.cos(d2) / math.cos(d1)))
    of_wheel = r1 * math.sin(d2) / math.cos(d1) - math.cos(axial) * math.tan(departure) * (
        r2 + r1 * math.cos(d2) / math.cos(d1)
    )
    of_pinion = r2 * math.cos(axial) * math.cos(departure) - of_wheel * math.sin(departure)
    first, second = (
        distance * math.cos(angle) - along
        for distance, angle, along in zip(cones.cone_distance, cones.angle, (of_pinion, of_wheel), strict=True)
    )
    return first, second


def _offset_angle(basic: Basic, cones: PitchCones, apex: float, departure: float, cone: float, angle: float) -> float:
    """Offset angle of the pinion in the plane of a cone of the wheel, formulas 142 to 145."""
    reach = cones.cone_distance[1] * math.cos(angle) - apex * math.cos(cone)
    phi = math.atan(basic.offset * math.tan(departure) * math.cos(cone) / reach)
    return math.asin(basic.offset * math.cos(phi) * math.sin(cone) / reach) - phi


def _mate(departure: float, cone: float, turn: float) -> float:
    """Angle of the pinion's cone that touches a cone of the wheel, formulas 146 and 147."""
    across = math.cos(departure) * math.cos(cone) * math.cos(turn)
    return math.asin(math.sin(departure) * math.sin(cone) + across)


def _pinion_face(
    basic: Basic,
    data: ToothData,
    cones: PitchCones,
    module: float,
    height: float,
    wheel_depth: float,
    tip: float,
    turn: float,
    wheel_face: Both,
) -> Both:
    """Face of the pinion inside and outside the mean point, formulas 154 to 173."""
    inner, outer = wheel_face
    zeta = cones.offset_angle
    if basic.offset == 0.0:
        return inner, outer
    if basic.method == 2:
        wide = 1 + math.tan(zeta) ** 2
        return inner * wide, outer * wide
    (pinion, wheel), ratio = cones.angle, cones.ratio
    if basic.method == 3:
        away = cones.cone_distance[1] * math.sin(zeta)
        inside, middle, outside = (
            math.sqrt((cones.cone_distance[1] + along) ** 2 - away**2) for along in (-inner, 0.0, outer)
        )
        # Formula 170 rounds down to whole millimetres.
        width = math.floor(1e3 * (outside - inside + 3 * module * abs(math.tan(zeta))) + 1) * 1e-3
        own = middle - inside + (width - (outside - inside)) / 2
        return own, width - own
    lead = math.atan(math.sin(zeta) * math.cos(wheel) / (ratio * math.cos(pinion) + math.cos(wheel) * math.cos(zeta)))
    width = basic.face_width * math.cos(lead) / math.cos(zeta - lead)
    further = 2 * module * data.addendum * math.sin(turn) * (1 - 1 / ratio)
    working = (wheel_depth - module * (data.dedendum - data.addendum)) * math.sin(pinion)
    share, cone = cones.outer_share, pinion + tip
    out = share * width / math.cos(tip) * math.cos(cone) + further - working
    into = (1 - share) * width / math.cos(tip) * math.cos(cone) + further + working
    return (
        (into - height * math.sin(pinion)) / (math.cos(pinion) - math.tan(tip) * math.sin(pinion)),
        (out + height * math.sin(pinion)) / math.cos(cone) * math.cos(tip),
    )


def _spiral_ends(cones: PitchCones, trace: Trace, pinion: Both, wheel: Both) -> tuple[Both, Both]:
    """Inner and outer spiral angles, formulas 174 to 194."""
    if trace.is_straight:
        return (cones.spiral[0],) * 2, (cones.spiral[1],) * 2
    distance, zeta = trace.distance, cones.offset_angle
    of_wheel = trace.spiral_angle(np.array([-wheel[0], wheel[1]]))
    reached = [
        math.sqrt(distance**2 + along**2 + 2 * distance * along * math.cos(zeta)) for along in (-pinion[0], pinion[1])
    ]
    turns = [math.asin(distance * math.sin(zeta) / reach) for reach in reached]
    of_pinion = trace.spiral_angle(np.array(reached) - distance) + np.array(turns)
    return (float(of_pinion[0]), float(of_pinion[1])), (float(of_wheel[0]), float(of_wheel[1]))


def _thickness(data: ToothData, cones: PitchCones, module: float, pressure_angle: float, outer: float) -> Both:
    """Mean normal circular tooth thickness, formulas 203 to 211."""
    share = 1 / (1 + outer / cones.cone_distance[1])
    less = data.backlash * share * math.cos(cones.spiral[1]) / (4 * module)
    pinion, wheel = (
        module
        * (math.pi / 2 + 2 * (sign * data.thickness - less + sign * data.profile_shift * math.tan(pressure_angle)))
        for sign in (1, -1)
    )
    return pinion, wheel
