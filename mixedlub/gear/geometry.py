"""The gear pair of the data sheet: involute geometry in the transverse plane.

A ring gear has a negative number of teeth; its radii, the centre distance and the length of the line of action are then
negative too, and every equation keeps its form (ISO 21771).

Positions ``x`` run along the line of action from the pinion's base tangent point T1; the pinion drives.
Letters follow the usual picture: A start, B and D single-contact limits, C pitch point, E end of contact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mixedlub.gear.checks import number, two
from mixedlub.gear.ring import longest_ring_tip, refuse_interference
from mixedlub.laws.contact import reduced_modulus
from mixedlub.schema.findings import finding, report
from profiles.errors import InputError

Pair = tuple[float, float]
COUNTED = "a number of teeth is a whole number from 4 to 9999, for a ring gear (the second) the same below zero"
PRESSURE_ANGLE = "the pressure angle lies between 5 and 45 degrees"
HELIX_ANGLE = "the helix angle lies between -60 and 60 degrees"


def involute(angle: float) -> float:
    """Involute function inv(a) = tan(a) - a of a pressure angle in radians.

    >>> round(involute(math.radians(20)), 6)
    0.014904
    """
    return math.tan(angle) - angle


def inverse_involute(value: float) -> float:
    """Pressure angle (rad) with the involute function ``value`` (>= 0), to machine accuracy.

    Newton's method from the small-angle root (3 inv)^(1/3), which lies above the answer, so that the convex function is
    descended without overshoot.

    >>> round(math.degrees(inverse_involute(0.0149043838)), 6)
    20.0
    """
    angle = min((3.0 * value) ** (1 / 3), 1.55)
    for _ in range(100):
        step = (involute(angle) - value) / max(math.tan(angle) ** 2, 1e-300)
        angle -= step
        if abs(step) <= 1e-15 * max(angle, 1e-6):
            break
    return angle


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float))


def _of_one_sign(given: dict[str, Any]) -> dict[str, Any]:
    """Tips and centre distance of a ring gear without the signs that they may have."""
    tips, centres = given["tip_radius"], given["centre_distance"]
    if isinstance(tips, (tuple, list)) and len(tips) == 2 and _is_number(tips[1]):
        tips = tips[0], abs(tips[1])
    return {**given, "tip_radius": tips, "centre_distance": abs(centres) if _is_number(centres) else centres}


@dataclass(frozen=True)
class GearPair:
    """A pair of involute cylindrical gears; first entry of every pair is the driving pinion.

    Lengths in m, angles in rad, moduli in Pa. The second wheel is a ring gear where its number of teeth is negative;
    tips and centre distance may then have either sign. A positive profile shift makes a tooth thicker and moves its
    tip out of the body, on a ring towards the axis. ``tip_radius=None`` takes the standard addendum
    ``r + m_n (1 + x)``, of a ring no more than meets the involute of the pinion; ``dedendum``: dedendum of the basic
    rack over the module, for elastic teeth and rings. ``centre_distance=None`` takes the backlash-free distance of the
    profile shifts. Data of no working gear pair raise an error with the key in the ``[gears]`` table.

    Source: ISO 21771, geometry of cylindrical involute gears.

    The back-to-back test gear FZG C (16/24, module 4.5, tips 82.46 and 118.36, centres 91.5 mm):

    >>> fzg = GearPair(teeth=(16, 24), normal_module=4.5e-3, pressure_angle=math.radians(20),
    ...                profile_shift=(0.1817, 0.1715), tip_radius=(41.23e-3, 59.18e-3),
    ...                centre_distance=91.5e-3, face_width=14e-3)
    >>> round(fzg.contact_ratio, 4), round(fzg.loss_factor, 4)
    (1.4375, 0.195)

    A planet in its ring, with a third of the sliding that an external pair of these teeth would have:

    >>> ring = GearPair(teeth=(27, -72), normal_module=2e-3, pressure_angle=math.radians(20), face_width=20e-3)
    >>> round(-1e3 * ring.working_centre_distance, 6), round(ring.loss_factor, 4)
    (45.0, 0.0611)
    """

    teeth: tuple[int, int]
    normal_module: float
    pressure_angle: float
    face_width: float
    helix_angle: float = 0.0
    profile_shift: Pair = (0.0, 0.0)
    tip_radius: Pair | None = None
    centre_distance: float | None = None
    youngs_modulus: Pair = (206e9, 206e9)
    poisson_ratio: Pair = (0.3, 0.3)
    dedendum: float = 1.25

    def __post_init__(self) -> None:
        teeth = two("teeth", self.teeth)
        for count, low, high in ((teeth[0], 3.0, 1e4), (teeth[1], -1e4, 1e4)):
            whole = number("teeth", count, low, high, COUNTED)
            if whole != int(whole):
                raise InputError("a number of teeth is a whole number", where="teeth", value=count)
        if teeth[1] <= 3 and teeth[1] >= -teeth[0]:
            rule = COUNTED if teeth[1] > -4 else "a ring gear has more teeth than the wheel inside it"
            raise InputError(rule, where="teeth", value=teeth[1])
        degrees = math.degrees(1.0)
        checked: dict[str, Any] = {"teeth": (int(teeth[0]), int(teeth[1]))}
        steep, slanted = math.radians(45), math.radians(60)
        single: dict[str, tuple[str, float, float, str, float]] = {
            "normal_module": ("normal_module_mm", 1e-6, 1, "the module is above 0.001 and below 1000 mm", 1e3),
            "pressure_angle": ("pressure_angle_deg", math.radians(5), steep, PRESSURE_ANGLE, degrees),
            "helix_angle": ("helix_angle_deg", -slanted, slanted, HELIX_ANGLE, degrees),
            "face_width": ("face_width_mm", 0, 10, "the face width is above zero and below 10 m", 1e3),
            "dedendum": ("dedendum", 0.5, 3, "the dedendum of a rack lies between 0.5 and 3 modules", 1),
        }
        for name, (key, low, high, rule, scale) in single.items():
            checked[name] = number(key, getattr(self, name), low, high, rule, scale)
        rules: dict[str, tuple[str, float, float, str, float]] = {
            "profile_shift": ("profile_shift", -5, 5, "a profile shift is a number of modules from -5 to 5", 1),
            "youngs_modulus": ("youngs_modulus_GPa", 0, 1e13, "Young's modulus is above zero", 1e-9),
            "poisson_ratio": ("poisson_ratio", -1, 0.5, "Poisson's ratio lies between -1 and 0.5", 1),
        }
        sense, given = self.sense, {name: getattr(self, name) for name in (*rules, "tip_radius", "centre_distance")}
        if self.ring:
            given = _of_one_sign(given)
        if self.tip_radius is not None:
            rules["tip_radius"] = ("tip_diameter_mm", 0, 100, "a tip diameter is above zero", 2e3)
        for name, (key, low, high, rule, scale) in rules.items():
            checked[name] = tuple(number(key, entry, low, high, rule, scale) for entry in two(key, given[name]))
        if self.centre_distance is not None:
            checked["centre_distance"] = sense * number(
                "centre_distance_mm", given["centre_distance"], 0, 200, "the centre distance is above zero", 1e3
            )
        if self.tip_radius is not None:
            checked["tip_radius"] = (checked["tip_radius"][0], sense * checked["tip_radius"][1])
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        self._must_mesh()

    def _must_mesh(self) -> None:
        """Raise an error for data that make no working pair of gears."""
        sense = self.sense
        nominal = sum(self.reference_radius) * math.cos(self.transverse_pressure_angle)
        if self.centre_distance is None:
            if self._working_involute <= 0:
                raise InputError(
                    f"the two profile shifts are too {'positive' if self.ring else 'negative'}: no centre distance "
                    "exists",
                    where="profile_shift",
                    value=self.profile_shift,
                )
        elif sense * self.centre_distance <= sense * nominal:
            of_both = "difference of the base radii" if self.ring else "sum of the base radii"
            hint = "" if self.ring else "; a ring gear has a negative number of teeth"
            raise InputError(
                f"the centre distance must exceed the {of_both}, {sense * nominal * 1e3:.6g} mm{hint}",
                where="centre_distance_mm",
                value=sense * self.centre_distance * 1e3,
            )
        elif self.backlash < -0.1 * self.normal_module:
            raise InputError(
                f"flanks would overlap by {-self.backlash * 1e3:.4g} mm: too close for these profile shifts",
                where="centre_distance_mm",
                value=sense * self.centre_distance * 1e3,
            )
        if any(abs(tip) <= abs(base) for tip, base in zip(self.tip_radii, self.base_radius)):
            raise InputError(
                "a tip circle must lie outside its base circle",
                where="tip_diameter_mm",
                value=tuple(round(2e3 * abs(radius), 6) for radius in self.tip_radii),
            )
        standard = "" if self.tip_radius is not None else " (tips of the standard addendum, as none are given)"
        shown = tuple(round(2e3 * abs(radius), 6) for radius in self.tip_radii)
        start, length, end = self.path_start, self.line_of_action_length, self.path_end
        total = self.contact_ratio + self.overlap_ratio
        for broken, rule in (
            (min(self.tip_thickness) <= 0, "pointed teeth: the flanks cross below the tip circle"),
            (
                start < -1e-9 * abs(length),
                "interference: the gear's tips pass the pinion's base tangent point (x_A < 0)",
            ),
            (
                not self.ring and end > length * (1 + 1e-9),
                "interference: the pinion's tips pass the gear's base tangent point (x_E > T1T2)",
            ),
            (not total >= 1, f"the contact ratio is {total:.4g}; it must be at least 1"),
            (not start < self.pitch_point < end, "the pitch point must lie inside the path of contact"),
        ):
            if broken:
                raise InputError(rule + standard, where="tip_diameter_mm", value=shown)
        if self.ring:
            refuse_interference(self, shown, standard)

    @property
    def ring(self) -> bool:
        """Whether the gear is a ring gear, with teeth inside."""
        return bool(self.teeth[1] < 0)

    @property
    def sense(self) -> float:
        """-1 for a ring gear, else 1: the sign of the gear's radii and of the centre distance."""
        return -1.0 if self.ring else 1.0

    @property
    def gear_ratio(self) -> float:
        """Speed of the pinion over the speed of the gear, the ratio of the numbers of teeth."""
        return abs(self.teeth[1]) / self.teeth[0]

    @property
    def teeth_ratio(self) -> float:
        """u = z2/z1 of the equations, negative for a ring gear."""
        return self.teeth[1] / self.teeth[0]

    @cached_property
    def transverse_module(self) -> float:
        """m_t = m_n / cos(beta)."""
        return self.normal_module / math.cos(self.helix_angle)

    @cached_property
    def transverse_pressure_angle(self) -> float:
        """tan(alpha_t) = tan(alpha_n) / cos(beta)."""
        return math.atan(math.tan(self.pressure_angle) / math.cos(self.helix_angle))

    @cached_property
    def base_helix_angle(self) -> float:
        """tan(beta_b) = tan(beta) cos(alpha_t)."""
        return math.atan(math.tan(self.helix_angle) * math.cos(self.transverse_pressure_angle))

    @cached_property
    def reference_radius(self) -> Pair:
        """Radii of the reference circles, r = m_t z / 2."""
        return self.transverse_module * self.teeth[0] / 2, self.transverse_module * self.teeth[1] / 2

    @cached_property
    def base_radius(self) -> Pair:
        """r_b = r cos(alpha_t)."""
        cosine = math.cos(self.transverse_pressure_angle)
        return self.reference_radius[0] * cosine, self.reference_radius[1] * cosine

    @cached_property
    def tip_radii(self) -> Pair:
        """Tip radii as given, or of the standard addendum r + m_n (1 + x), on a ring within the pinion's involute."""
        if self.tip_radius is not None:
            return self.tip_radius
        first, second = (
            radius + self.normal_module * (1 + shift)
            for radius, shift in zip(self.reference_radius, self.profile_shift)
        )
        return first, min(second, -longest_ring_tip(self)) if self.ring else second

    @cached_property
    def _working_involute(self) -> float:
        shift = 2 * math.tan(self.pressure_angle) * sum(self.profile_shift) / sum(self.teeth)
        return involute(self.transverse_pressure_angle) + shift

    @cached_property
    def working_pressure_angle(self) -> float:
        """alpha_wt of the given centre distance, or of the backlash-free distance.

        cos(alpha_wt) = (r_b1 + r_b2)/a_w, or inv(alpha_wt) = inv(alpha_t) + 2 tan(alpha_n) (x1+x2)/(z1+z2).
        """
        if self.centre_distance is None:
            return inverse_involute(self._working_involute)
        return math.acos(sum(self.base_radius) / self.centre_distance)

    @cached_property
    def working_centre_distance(self) -> float:
        """a_w = (r_b1 + r_b2) / cos(alpha_wt)."""
        if self.centre_distance is not None:
            return self.centre_distance
        return sum(self.base_radius) / math.cos(self.working_pressure_angle)

    @cached_property
    def operating_radius(self) -> Pair:
        """Radii of the rolling pitch circles, r_w1 = a_w z1 / (z1 + z2)."""
        share = self.teeth[0] / sum(self.teeth)
        return self.working_centre_distance * share, self.working_centre_distance * (1 - share)

    @cached_property
    def backlash(self) -> float:
        """Circumferential backlash at the pitch circles; negative where the flanks would overlap."""
        excess = involute(self.working_pressure_angle) - self._working_involute
        return 2 * self.working_centre_distance * excess

    @cached_property
    def tip_thickness(self) -> Pair:
        """Transverse tooth thickness on the tip circles; at or below zero the tooth is pointed."""
        first, second = (
            2 * tip * (self.half_tooth_angle(i) - involute(math.acos(self.base_radius[i] / tip)))
            for i, tip in enumerate(self.tip_radii)
        )
        return first, second

    def half_tooth_angle(self, wheel: int) -> float:
        """Half the angle of a tooth at its base circle, pi/(2z) + 2 x tan(alpha_n)/z + inv(alpha_t)."""
        shift = 2 * self.profile_shift[wheel] * math.tan(self.pressure_angle)
        return (math.pi / 2 + shift) / self.teeth[wheel] + involute(self.transverse_pressure_angle)

    @cached_property
    def line_of_action_length(self) -> float:
        """T1T2 = a_w sin(alpha_wt); negative for a ring gear, with T2 behind T1."""
        return self.working_centre_distance * math.sin(self.working_pressure_angle)

    @cached_property
    def path_start(self) -> float:
        """x_A: the gear's tip enters; T1T2 - sqrt(r_a2^2 - r_b2^2), of a ring gear with a positive root."""
        return self.line_of_action_length - self.sense * math.sqrt(self.tip_radii[1] ** 2 - self.base_radius[1] ** 2)

    @cached_property
    def path_end(self) -> float:
        """x_E: the pinion's tip leaves; sqrt(r_a1^2 - r_b1^2)."""
        return math.sqrt(self.tip_radii[0] ** 2 - self.base_radius[0] ** 2)

    @cached_property
    def pitch_point(self) -> float:
        """x_C = r_b1 tan(alpha_wt), the point without sliding."""
        return self.base_radius[0] * math.tan(self.working_pressure_angle)

    @cached_property
    def base_pitch(self) -> float:
        """p_bt = pi m_t cos(alpha_t), the distance of neighbouring contacts along the path."""
        return math.pi * self.transverse_module * math.cos(self.transverse_pressure_angle)

    @property
    def lowest_single_contact(self) -> float:
        """x_B = x_E - p_bt (for contact ratios from 1 to 2)."""
        return self.path_end - self.base_pitch

    @property
    def highest_single_contact(self) -> float:
        """x_D = x_A + p_bt (for contact ratios from 1 to 2)."""
        return self.path_start + self.base_pitch

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio, (x_E - x_A) / p_bt."""
        return (self.path_end - self.path_start) / self.base_pitch

    @property
    def approach_ratio(self) -> float:
        """(x_C - x_A) / p_bt, the gear's addendum part of the contact ratio."""
        return (self.pitch_point - self.path_start) / self.base_pitch

    @property
    def recess_ratio(self) -> float:
        """(x_E - x_C) / p_bt, the pinion's addendum part of the contact ratio."""
        return (self.path_end - self.pitch_point) / self.base_pitch

    @property
    def overlap_ratio(self) -> float:
        """b sin(beta) / (pi m_n) of a helical pair; 0 for spur gears."""
        return self.face_width * abs(math.sin(self.helix_angle)) / (math.pi * self.normal_module)

    @cached_property
    def reduced_modulus(self) -> float:
        """E' = 2 / [(1 - nu1^2)/E1 + (1 - nu2^2)/E2] of the film formulas, twice the contact modulus."""
        return reduced_modulus(self.youngs_modulus, self.poisson_ratio)

    @cached_property
    def loss_factor(self) -> float:
        """Tooth loss factor of rigid teeth with equal sharing.

        H_V = pi (u+1)/(z1 u cos(beta_b)) (1 - eps_alpha + eps_1^2 + eps_2^2), u = z2/z1 negative for a ring gear.
        Valid for contact ratios from 1 to 2.

        Source: Ohlendorf 1958, in the form of Niemann and Winter, Maschinenelemente II.
        """
        if not 1.0 <= self.contact_ratio <= 2.0:
            text = f"the loss factor holds for contact ratios from 1 to 2, not {self.contact_ratio:.4g}"
            report(finding("law_extrapolated", text, "contact ratio"))
        ratio = self.teeth_ratio
        scale = math.pi * (ratio + 1) / (self.teeth[0] * ratio * math.cos(self.base_helix_angle))
        return scale * (1 - self.contact_ratio + self.approach_ratio**2 + self.recess_ratio**2)

    @cached_property
    def end_mean_sliding(self) -> float:
        """A quarter of the sum of the sliding speeds at both ends of the path, over omega1 r_b1.

        Equal to 0.5 eps_alpha pi (1/z1 + 1/z2): the mean sliding speed of a path with equal approach and
        recess, unweighted by load. Source: Hong, Aneshansley and Talbot, eq. 3 and 4.
        """
        speeds = (1 + 1 / self.teeth_ratio) * (self.path_end - self.path_start)
        return speeds / (4 * self.base_radius[0])
