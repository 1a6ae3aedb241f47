"""Pitch cones of bevel and hypoid gears by ISO 23509, methods 0 to 3."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, root

from mixedlub.skew_gears.lengthwise import crown_trace

STEPS = 400
"""Grid. Trial angles between which the closing condition of methods 1 and 2 is searched for a change of sign."""
MOST_ROUNDS = 200
"""Cost limit. Rounds of method 3."""
CLOSED = 1e-13
"""Judgement. Relative change of the cone distance at which method 3 has converged."""
SEED_FACTOR = 1.2
"""Source: ISO 23509, formula 11. Factor of the preliminary wheel angle of method 1."""
FARTHEST = math.radians(8.0)
"""Judgement. Largest distance of the improved wheel angle of method 2 from its first estimate."""


class NoPitchConesError(ValueError):
    """The geometry has no pair of pitch cones; the text says why."""


@dataclass(frozen=True)
class Basic:
    """Basic data of a pair, ISO 23509 table 2, in SI; ``spiral``: of the pinion by method 1, else of the wheel.

    ``wheel_diameter``: mean of method 2, else outer; ``blade_groups``: 0 for face milling.
    """

    method: int
    teeth: tuple[int, int]
    shaft_angle: float
    offset: float
    wheel_diameter: float
    face_width: float
    spiral: float
    cutter_radius: float
    blade_groups: int = 0

    @property
    def ratio(self) -> float:
        """Teeth of the wheel over teeth of the pinion."""
        return self.teeth[1] / self.teeth[0]


@dataclass(frozen=True)
class PitchCones:
    """Two pitch cones that touch at the mean point; pairs are pinion, wheel.

    ``radius``: mean pitch radii; ``angle``: pitch angles; ``spiral``: mean spiral angles; ``outer_share``: part of the
    wheel's face outside the mean point.
    """

    teeth: tuple[int, int]
    shaft_angle: float
    offset: float
    radius: tuple[float, float]
    angle: tuple[float, float]
    spiral: tuple[float, float]
    outer_share: float = 0.5

    @property
    def ratio(self) -> float:
        """Teeth of the wheel over teeth of the pinion."""
        return self.teeth[1] / self.teeth[0]

    @property
    def cone_distance(self) -> tuple[float, float]:
        """Mean cone distances; infinite for cylinders."""
        pinion, wheel = (
            radius / math.sin(angle) if angle else math.inf
            for radius, angle in zip(self.radius, self.angle, strict=True)
        )
        return pinion, wheel

    @property
    def offset_angle(self) -> float:
        """Angle between both generators of the pitch plane."""
        return self.spiral[0] - self.spiral[1]

    @property
    def normal_module(self) -> float:
        """Mean normal module."""
        return 2.0 * self.radius[1] * math.cos(self.spiral[1]) / self.teeth[1]

    @property
    def limit_angle(self) -> float:
        r"""Limit pressure angle, ISO 23509 formula 117.

        .. math:: \tan\alpha_{lim} = -\frac{\tan\delta_1\tan\delta_2}{\cos\zeta_{mp}}
                  \frac{R_1\sin\beta_1 - R_2\sin\beta_2}{R_1\tan\delta_1 + R_2\tan\delta_2}
        """
        (r1, r2), (d1, d2), (b1, b2) = self.radius, self.angle, self.spiral
        # Both sides times the sines of the pitch angles, so that cylinders have the angle 0.
        across = r1 * math.sin(b1) * math.sin(d2) - r2 * math.sin(b2) * math.sin(d1)
        along = r1 * math.cos(d2) + r2 * math.cos(d1)
        return -math.atan(across / along / math.cos(self.offset_angle))


def pitch_cones(basic: Basic) -> PitchCones:
    """Pitch cones of basic data; without offset all methods give those of method 0."""
    if basic.offset == 0.0:
        return _method_0(basic)
    return METHODS[basic.method](basic)


def largest_offset(basic: Basic) -> float:
    """Largest offset (m) with pitch cones, to a thousandth of the wheel's diameter; 0 without any."""
    from dataclasses import replace

    low, high = 0.0, basic.offset
    while high - low > 1e-3 * basic.wheel_diameter:
        middle = (low + high) / 2
        try:
            pitch_cones(replace(basic, offset=middle))
            low = middle
        except NoPitchConesError:
            high = middle
    return low


def _method_0(basic: Basic) -> PitchCones:
    """Formulas 1 to 7; by method 2 the given diameter is the mean one."""
    sine, cosine = math.sin(basic.shaft_angle), math.cos(basic.shaft_angle)
    pinion = math.atan2(sine, cosine + basic.ratio)
    wheel = basic.shaft_angle - pinion
    _check_angles(pinion, wheel)
    radius = basic.wheel_diameter / 2
    if basic.method != 2:
        radius -= basic.face_width / 2 * math.sin(wheel)
    _check_radius(radius)
    return PitchCones(
        basic.teeth, basic.shaft_angle, 0.0, (radius / basic.ratio, radius), (pinion, wheel), (basic.spiral,) * 2
    )


def _method_1(basic: Basic) -> PitchCones:
    """Formulas 8 to 41: the limit curvature of the pair is the lengthwise curvature of the wheel's teeth."""
    departure, ratio, offset = basic.shaft_angle - math.pi / 2, basic.ratio, basic.offset
    seed = math.atan2(ratio * math.cos(departure), SEED_FACTOR * (1 - ratio * math.sin(departure)))
    wheel_radius = (basic.wheel_diameter - basic.face_width * math.sin(seed)) / 2
    _check_radius(wheel_radius)
    first = math.asin(_sine(offset * math.sin(seed) / wheel_radius))
    factor = math.tan(basic.spiral) * math.sin(first) + math.cos(first)
    pinion_radius = wheel_radius * factor / ratio
    start = math.atan2(
        offset, wheel_radius * (math.tan(seed) * math.cos(departure) - math.sin(departure)) + pinion_radius
    )

    def trial(eta: float) -> PitchCones:
        sine = _sine((offset - pinion_radius * math.sin(eta)) / wheel_radius)
        spiral = _pinion_spiral(eta, sine, factor, departure)
        change = math.sin(spiral[1]) * (math.tan(basic.spiral) - math.tan(spiral[0]))
        growth = wheel_radius * change / ratio
        axial = math.asin(_sine(sine - growth / wheel_radius * math.sin(eta)))
        beta, turn, pinion = (*_pinion_spiral(eta, math.sin(axial), factor + change, departure),)
        tangent = math.sin(axial) / (math.tan(eta) * math.cos(departure)) + math.cos(axial) * math.tan(departure)
        wheel = math.atan(tangent)
        _check_angles(pinion, wheel)
        _check_radius(pinion_radius + growth)
        outer = (basic.wheel_diameter / 2 - wheel_radius) / math.sin(wheel) / basic.face_width
        return PitchCones(
            basic.teeth,
            basic.shaft_angle,
            offset,
            (pinion_radius + growth, wheel_radius),
            (pinion, wheel),
            (beta, beta - turn),
            outer,
        )

    def misfit(eta: float) -> float:
        cones = trial(eta)
        return limit_curvature(cones) - _trace_curvature(basic, cones)

    return trial(_root(misfit, start, 1e-4, math.pi / 2 - 1e-4))


def _pinion_spiral(eta: float, sine: float, factor: float, departure: float) -> tuple[float, float, float]:
    """Spiral angle of the pinion, offset angle in the pitch plane, and pitch angle of the pinion, formulas 17 to 20."""
    axial = math.asin(sine)
    if axial == 0.0:
        raise NoPitchConesError("the offset angle of the pinion vanishes")
    pinion = math.atan(math.sin(eta) / (math.tan(axial) * math.cos(departure)) + math.tan(departure) * math.cos(eta))
    turn = math.asin(_sine(sine * math.cos(departure) / math.cos(pinion)))
    return math.atan2(factor - math.cos(turn), math.sin(turn)), turn, pinion


def limit_curvature(cones: PitchCones) -> float:
    """Curvature of the pitch line (1/m) at which the pair has the limit normal along it, formulas 32 and 33."""
    (r1, r2), (d1, d2), (b1, b2) = cones.cone_distance, cones.angle, cones.spiral
    limit = cones.limit_angle
    bent = math.tan(b1) / (r1 * math.tan(d1)) + math.tan(b2) / (r2 * math.tan(d2))
    change = -math.tan(limit) * bent + 1 / (r1 * math.cos(b1)) - 1 / (r2 * math.cos(b2))
    return change * math.cos(limit) / (math.tan(b1) - math.tan(b2))


def _trace_curvature(basic: Basic, cones: PitchCones) -> float:
    trace = crown_trace(cones.cone_distance[1], cones.spiral[1], basic.cutter_radius, crown_ratio(basic, cones))
    return float(trace.curvature(np.array(0.0)))


def crown_ratio(basic: Basic, cones: PitchCones) -> float:
    """Blade groups of the cutter over teeth of the crown gear, 0 for face milling."""
    return basic.blade_groups / basic.teeth[1] * math.sin(cones.angle[1])


def _method_2(basic: Basic) -> PitchCones:
    """Formulas 42 to 83: the pinion's cone distance meets the centre of the cutter's rolling circle."""
    shaft, ratio, offset, beta = basic.shaft_angle, basic.ratio, basic.offset, basic.spiral
    diameter, cutter = basic.wheel_diameter, basic.cutter_radius
    lead = math.asin(_sine(basic.blade_groups * diameter * math.cos(beta) / (2 * basic.teeth[1] * cutter)))
    turned = math.pi / 2 - beta + lead
    pinion = math.atan2(math.sin(shaft), ratio + math.cos(shaft))
    wheel = shaft - pinion
    axial = math.asin(_sine(2 * offset / diameter / (1 + math.cos(wheel) / (ratio * math.cos(pinion)))))
    factor = math.cos(beta) / math.cos(beta + axial)
    small = factor * diameter / ratio
    phi2 = math.atan(ratio * math.cos(axial) / (ratio / math.tan(wheel) + (factor - 1) * math.sin(shaft)))
    crown = diameter / 2 / math.sin(phi2)
    eta1 = math.atan(
        (cutter * math.cos(lead) - crown * math.sin(beta)) / (cutter * math.sin(lead) + crown * math.cos(beta))
    )
    phi3 = math.atan(math.tan(beta + eta1) / math.sin(phi2))
    first = math.atan(
        small
        * math.sin(shaft)
        / (diameter * math.cos(axial) + small * math.cos(shaft) - 2 * offset / math.tan(phi3 + axial))
    )
    start = math.atan(math.tan(shaft - first) * math.cos(axial))

    def trial(wheel: float) -> PitchCones:
        other = math.cos(shaft - wheel)
        eta_p = math.atan(math.sin(axial) * math.cos(wheel) / other)
        eta = math.atan(
            2 * offset / (diameter * math.tan(wheel) + small * math.cos(eta_p) * math.sin(beta + eta1) / other)
        )
        bent = factor * math.tan(eta) * math.sin(wheel) * math.cos(eta_p) / (ratio * other)
        improved = math.asin(_sine(2 * offset / diameter - bent))
        turn = math.atan(math.tan(improved) * math.sin(shaft) / other)
        own = math.cos(beta) / math.cos(beta + turn) * diameter / ratio
        phi4 = math.atan(
            math.sin(turned) * math.sin(shaft) / (diameter / (2 * cutter) - math.cos(turned) * math.sin(wheel))
        )
        projected = math.atan(
            own
            * math.sin(shaft)
            / (
                diameter * math.cos(improved)
                + own * math.cos(shaft) * math.cos(eta_p)
                - 2 * offset / math.tan(phi4 + improved)
            )
        )
        wheel = math.atan(math.tan(shaft - projected) * math.cos(turn))
        phi5 = math.atan(math.tan(wheel) / math.cos(improved))
        eta_p = math.atan(math.tan(eta) * math.sin(phi5) / math.cos(shaft - phi5))
        eta = math.atan(
            2 * offset / (diameter * math.tan(wheel) + own * math.cos(eta_p) * math.sin(phi5) / math.cos(shaft - phi5))
        )
        zeta = math.asin(_sine(math.tan(wheel) * math.tan(eta)))
        turn = math.atan(math.tan(zeta) * math.sin(shaft) / math.cos(shaft - wheel))
        own = diameter * math.cos(beta) / (ratio * math.cos(beta + turn))
        xi = math.atan2(math.sin(shaft) * math.cos(zeta), math.cos(shaft)) - wheel
        pinion = math.atan(math.tan(xi) * math.cos(turn))
        _check_angles(pinion, wheel)
        return PitchCones(basic.teeth, shaft, offset, (own / 2, diameter / 2), (pinion, wheel), (beta + turn, beta))

    def misfit(wheel: float) -> float:
        cones = trial(wheel)
        distance = cones.cone_distance[1]
        centre = math.sqrt(cutter**2 + distance**2 - 2 * cutter * distance * math.cos(turned))
        seen = math.asin(_sine(cutter * math.sin(turned) / centre))
        return cones.cone_distance[0] / distance - math.sin(seen) / math.sin(cones.offset_angle + seen)

    found = trial(_root(misfit, start, max(start - FARTHEST, 1e-3), min(start + FARTHEST, math.pi / 2 - 1e-3)))

    def open_ends(angles: np.ndarray) -> list[float]:
        pinion, wheel, turn = angles
        own = diameter * math.cos(beta) / (ratio * math.cos(beta + turn))
        distance = diameter / 2 / math.sin(wheel)
        centre = math.sqrt(cutter**2 + distance**2 - 2 * cutter * distance * math.cos(turned))
        seen = math.asin(_sine(cutter * math.sin(turned) / centre))
        meets = math.cos(pinion) * math.cos(wheel) * math.cos(turn) - math.sin(pinion) * math.sin(wheel)
        apart = (diameter * math.cos(pinion) + own * math.cos(wheel)) / 2 * math.sin(turn) / math.sin(shaft)
        cone = own / 2 / math.sin(pinion) / distance * math.sin(turn + seen) / math.sin(seen)
        return [meets - math.cos(shaft), apart / offset - 1, cone - 1]

    # The formulas alone leave the axes some hundredths of a millimetre off the given offset.
    closed = root(open_ends, [*found.angle, found.offset_angle], tol=CLOSED)
    pinion, wheel, turn = (float(angle) for angle in closed.x)
    if np.abs(closed.fun).max() > 1e-9:
        raise NoPitchConesError("method 2 does not close")
    _check_angles(pinion, wheel)
    own = diameter * math.cos(beta) / (ratio * math.cos(beta + turn))
    return PitchCones(basic.teeth, shaft, offset, (own / 2, diameter / 2), (pinion, wheel), (beta + turn, beta))


def _method_3(basic: Basic) -> PitchCones:
    """Formulas 84 to 109, repeated until the cone distance of the pinion stands."""
    shaft, ratio, offset, beta = basic.shaft_angle, basic.ratio, basic.offset, basic.spiral
    cutter, factor = basic.cutter_radius, 1.0
    wheel = math.atan2(math.sin(shaft), 1 / ratio + math.cos(shaft))
    pinion = shaft - wheel
    for _ in range(MOST_ROUNDS):
        diameter = basic.wheel_diameter - basic.face_width * math.sin(wheel)
        zeta = math.asin(_sine(2 * offset / (diameter * (1 + factor * math.cos(wheel) / (ratio * math.cos(pinion))))))
        pinion = math.asin(
            _sine(math.cos(zeta) * math.sin(shaft) * math.cos(wheel) - math.cos(shaft) * math.sin(wheel))
        )
        turn = math.asin(_sine(math.sin(zeta) * math.sin(shaft) / math.cos(pinion)))
        _check_angles(pinion, wheel)
        factor = math.cos(beta) / math.cos(beta + turn)
        own = diameter / ratio * factor
        distance, other = own / 2 / math.sin(pinion), diameter / 2 / math.sin(wheel)
        lead = math.asin(_sine(basic.blade_groups * math.cos(beta) * diameter / basic.teeth[1] / (2 * cutter)))
        theta = math.atan(math.sin(wheel) * math.tan(zeta))
        a3 = cutter * math.cos(beta - lead) ** 2
        a4 = other * math.cos(beta + theta) * math.cos(beta)
        a5 = math.sin(turn) * math.cos(theta) * math.cos(lead)
        a6 = other * math.cos(beta) + cutter * math.sin(lead)
        a7 = math.cos(beta + turn) * math.cos(beta + theta) - math.sin(beta + theta - lead) * math.sin(turn) / math.cos(
            beta - lead
        )
        wanted = a3 * a4 / (a5 * a6 + a3 * a7)
        if abs(wanted / distance - 1) <= CLOSED:
            return PitchCones(basic.teeth, shaft, offset, (own / 2, diameter / 2), (pinion, wheel), (beta + turn, beta))
        pinion = math.asin(_sine(own / (2 * wanted)))
        across = math.sin(shaft) * math.sin(zeta)
        wheel = math.acos(
            _sine(
                (
                    math.sin(pinion) * math.cos(zeta) * math.sin(shaft)
                    + math.cos(pinion) * math.cos(turn) * math.cos(shaft)
                )
                / (1 - across**2)
            )
        )
    raise NoPitchConesError("method 3 does not settle")


METHODS: dict[int, Callable[[Basic], PitchCones]] = {0: _method_0, 1: _method_1, 2: _method_2, 3: _method_3}


def _root(misfit: Callable[[float], float], start: float, low: float, high: float) -> float:
    """Zero of a misfit nearest to a start, between trial angles that have pitch cones."""

    def value(angle: float) -> float:
        try:
            return misfit(float(angle)) if math.isfinite(angle) else math.nan
        except (NoPitchConesError, ZeroDivisionError):
            return math.nan

    # Small offsets have their zero near the lower end.
    angles = np.geomspace(low, high, STEPS)
    values = np.array([value(angle) for angle in angles])
    with np.errstate(invalid="ignore"):
        found = np.flatnonzero(values[:-1] * values[1:] <= 0)
    roots = [_between(value, angles[i], angles[i + 1]) for i in found]
    # A pole changes sign too, without a zero.
    roots = [root for root in roots if abs(value(root)) <= 1e-6 * np.nanmax(np.abs(values))]
    if not roots:
        raise NoPitchConesError("no pitch cones fit the cutter")
    return float(min(roots, key=lambda root: abs(root - start)))


def _between(value: Callable[[float], float], low: float, high: float) -> float:
    """Zero between two angles; not a number where some angle between them has no pitch cones."""
    try:
        return float(brentq(value, low, high, xtol=1e-14))
    except ValueError:
        return math.nan


def _sine(value: float) -> float:
    """A sine or cosine; raise an error for values beyond 1, which no angle has."""
    if not -1.0 <= value <= 1.0:
        raise NoPitchConesError("no angle closes the triangle of both axes and the mean point")
    return value


def _check_angles(pinion: float, wheel: float) -> None:
    if not (0.0 <= pinion < math.pi / 2 and 0.0 <= wheel < math.pi / 2):
        raise NoPitchConesError("a pitch angle would leave the range from 0 to 90 degrees")


def _check_radius(radius: float) -> None:
    if radius <= 0.0:
        raise NoPitchConesError("a mean radius would not be above zero")
