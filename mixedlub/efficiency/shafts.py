"""Bearing loads from mesh forces on shafts: by bearing positions, or by shares with the sum 1.

The thrust that bearings with a contact angle induce in each other under radial load is not included.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from mixedlub.efficiency.file import Stage
from mixedlub.efficiency.part_tables import Bearing, Side
from mixedlub.gear import GearPair
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError

Load = tuple[float, float]
"""Radial and axial load of a bearing (N) at a pinion torque of 1 N m of its stage."""
TOLERANCE = 0.005
"""Tolerance on a sum of shares from 1, for thirds written with three digits."""
BALANCED = 1e-9
"""Net thrust over the largest thrust of a shaft below which thrusts cancel apart from rounding."""
INDUCING = ("angular_contact", "tapered_roller")
"""Types of single-row bearings with a contact angle; SKF's law of them is for such bearings without a named series."""
FARTHEST = 10.0
"""Judgement. Distance along a shaft over the centre distance of the gears, above which it is in another unit."""
SIGNS = {"positive": 1.0, "negative": -1.0}


@dataclass(frozen=True)
class WheelForce:
    """Force on a wheel in its plane (N) at a position (m), thrust (N), and vector to the pitch point (m).

    Vectors in the transverse plane are complex numbers.
    """

    position: float
    transverse: complex
    thrust: float
    arm: complex


def bearing_reactions(wheels: Sequence[WheelForce], first: float, second: float) -> tuple[complex, complex]:
    r"""Transverse reactions (N) of two bearings at positions (m) on a shaft with wheels.

    .. math:: R_2 = -\frac{\sum_i (z_i - z_1)F_i - r_i F_{a,i}}{z_2 - z_1},\quad R_1 = -\sum_i F_i - R_2

    F_i: force on wheel i in the transverse plane; F_a,i: thrust along z, which tilts the shaft; r_i: vector to the
    pitch point. Two bearings, rigid in position; the shaft has no weight.

    Source: static balance; R. Budynas, K. Nisbett, Shigley's Mechanical Engineering Design, example with figure 13-39.

    >>> pinion = WheelForce(13.0, complex(-17.0, 40.4), -23.3, 0.866)   # there lbf and in: y is real, z imaginary
    >>> a, b = bearing_reactions([pinion], 0.0, 10.0)
    >>> print([round(x, 1) + 0.0 for x in (a.real, a.imag, b.real, b.imag)])   # printed: 3.1, 12.1, 20.1, 52.5
    [-3.1, 12.1, 20.1, -52.5]
    """
    moment = sum((w.position - first) * w.transverse - w.arm * w.thrust for w in wheels)
    at_second = -moment / (second - first)
    return -sum(w.transverse for w in wheels) - at_second, at_second


@dataclass(frozen=True)
class Wheel:
    """Wheel of a stage on its shaft: position (m), and angle (rad) to its mate, in the sense of rotation.

    In coast the other side drives: the force along the pitch circle and the thrust change their sense.
    """

    stage: str
    section: Stage
    pair: GearPair
    side: Side
    position: float = 0.0
    angle: float = 0.0
    coast: bool = False

    @property
    def shaft(self) -> str:
        """Shaft of the wheel by the name of the stage."""
        return f"stages.{self.stage}.bearings (shaft of the {self.side})"

    @property
    def bearings(self) -> dict[str, Bearing]:
        """Bearings on the shaft in the list of the stage, by name."""
        return {name: one for name, one in self.section.bearings.items() if one.shaft == self.side}

    @property
    def torque(self) -> float:
        """Torque of the shaft over pinion torque of the stage."""
        return 1.0 if self.side == "pinion" else self.pair.gear_ratio

    @property
    def helical(self) -> bool:
        """Whether the mesh has an axial force."""
        return self.pair.helix_angle != 0.0

    def force(self) -> WheelForce:
        """Force on the wheel at a shaft torque of 1 N m, without friction of the mesh."""
        pair, towards = self.pair, cmath.exp(1j * self.angle)
        rolling, angle = pair.operating_radius[0 if self.side == "pinion" else 1], pair.working_pressure_angle
        radius = abs(rolling)
        drives = (self.side == self.section.driving) != self.coast
        tangential = -1.0 / radius if drives else 1.0 / radius
        thrust = math.tan(abs(pair.base_helix_angle)) / (radius * math.cos(angle))
        across = towards * complex(-math.tan(angle) / rolling, tangential)  # a ring is pressed outwards
        return WheelForce(self.position, across, self._direction() * thrust, radius * towards)

    def _direction(self) -> float:
        """Sign of the thrust along the shaft positions."""
        if not self.helical:
            return 0.0
        if self.section.pinion_thrust is None:
            rule = (
                'the bearings have positions, so that "positive" or "negative" must say to which side the axial force '
                "on the pinion points"
            )
            raise InputError(rule, where=f"stages.{self.stage}.pinion_thrust")
        on_pinion = -SIGNS[self.section.pinion_thrust] if self.coast else SIGNS[self.section.pinion_thrust]
        return on_pinion if self.side == "pinion" else -on_pinion


Loads = dict[tuple[str, str], Load]


def bearing_loads(
    stages: Mapping[str, Stage], pairs: Mapping[str, GearPair], *, coast: bool = False
) -> tuple[Loads, list[Finding]]:
    """Loads of all bearings by stage and name; findings on shafts without bearings, on induced thrust left out, and on
    distances unlike a gearbox."""
    loads: Loads = {}
    bare: list[str] = []
    for wheels in _shafts(stages, pairs, coast):
        listed = [one for wheel in wheels for one in wheel.bearings.values()]
        if not listed:
            bare.append(" and ".join(f"{wheel.stage}.{wheel.side}" for wheel in wheels))
        elif any(one.position_mm is not None for one in listed):
            loads |= _by_positions(wheels)
        elif len(wheels) > 1:
            raise InputError("every bearing of a shared shaft needs position_mm", where=wheels[0].shaft)
        else:
            loads |= _by_shares(wheels[0])
    notes = list(_far(stages, pairs))
    if bare:
        text = f"no bearings on the shafts of {', '.join(bare)}: their losses are left out"
        notes.append(finding("shaft_without_bearings", text, "stages"))
    induced = [
        f"{name}.{key}" for name, stage in stages.items() for key, one in stage.bearings.items() if _induces(one)
    ]
    if induced:
        text = (
            f"the thrust that bearings with a contact angle induce in each other is left out of {', '.join(induced)}: "
            "give it as axial_load_N, by the catalogue"
        )
        notes.append(finding("induced_thrust_left_out", text, "stages"))
    return loads, notes


def _far(stages: Mapping[str, Stage], pairs: Mapping[str, GearPair]) -> Iterator[Finding]:
    """Findings on positions and distances along shafts that are far larger than the gears."""
    for name, stage in stages.items():
        centres = 1e3 * abs(pairs[name].working_centre_distance)
        placed = {f"bearings.{key}.position_mm": one.position_mm for key, one in stage.bearings.items()}
        if stage.shared_shaft is not None:
            placed["shared_shaft.distance_mm"] = stage.shared_shaft.distance_mm
        for place, value in placed.items():
            if value is not None and abs(value) > FARTHEST * centres:
                text = f"{value:g} mm, {abs(value) / centres:.0f} times the centre distance of {centres:.4g} mm: "
                yield finding("value_unusual", f"{text}check the number and its unit", f"stages.{name}.{place}")


def _induces(bearing: Bearing) -> bool:
    """Whether a bearing has a contact angle, and no axial load of its own."""
    angled = bearing.series in INDUCING or (bearing.law == "skf_angular_contact" and bearing.series is None)
    return angled and bearing.axial_load_N == 0.0


def _shafts(stages: Mapping[str, Stage], pairs: Mapping[str, GearPair], coast: bool) -> Iterator[list[Wheel]]:
    """Shafts in the order of the power, each with one wheel or with two wheels of successive stages."""
    driving = [Wheel(name, one, pairs[name], one.driving, coast=coast) for name, one in stages.items()]
    driven = [replace(one, side="gear" if one.side == "pinion" else "pinion") for one in driving]
    if driving[0].section.shared_shaft is not None:
        raise InputError("the first stage has no stage before it", where=f"stages.{driving[0].stage}.shared_shaft")
    yield [driving[0]]
    for before, after in zip(driven, driving[1:], strict=False):
        shared = after.section.shared_shaft
        if shared is not None:
            angle = math.radians(shared.angle_deg)
            yield [before, replace(after, position=shared.distance_mm * 1e-3, angle=angle)]
            continue
        if bool(before.bearings) != bool(after.bearings):
            has, lacks = (before, after) if before.bearings else (after, before)
            rule = (
                f"no bearing carries the force on the {lacks.side} of stage {lacks.stage!r}, on the shaft of the "
                f"{has.side} of {has.stage!r}: give position_mm to the bearings of that shaft and the table "
                f"stages.{after.stage}.shared_shaft, or list bearings in both stages if two shafts are coupled there"
            )
            raise InputError(rule, where=lacks.shaft)
        yield [before]
        yield [after]
    yield [driven[-1]]


def _by_shares(wheel: Wheel) -> Loads:
    """Loads by shares of the bearings of one wheel, with a check that each force is carried once."""
    for name, one in wheel.bearings.items():
        if one.axial is not None:
            rule = "acts only with position_mm; without positions give axial_share"
            raise InputError(rule, where=f"stages.{wheel.stage}.bearings.{name}.axial", value=one.axial)
    for key, meaning in (("radial_share", "mesh force"), ("axial_share", "axial force of the helical mesh")):
        total = sum(one.count * getattr(one, key) for one in wheel.bearings.values())
        unloaded = key == "axial_share" and not wheel.helical
        if abs(total - 1.0) > TOLERANCE and not (unloaded and total == 0.0):
            carried = "no bearing carries" if total == 0.0 else f"{key} adds up to {total:.4g}, not to 1, of"
            rule = (
                f"{carried} the {meaning}: give {key} so that it adds up to 1 over the bearings of the shaft, times "
                "their count, as 1 on the fixed bearing and 0 on others; or position_mm of each"
            )
            raise InputError(rule, where=wheel.shaft)
    force = 1.0 / wheel.pair.base_radius[0]
    thrust = force * math.tan(abs(wheel.pair.base_helix_angle))
    return {
        (wheel.stage, name): (one.radial_share * force, one.axial_share * thrust)
        for name, one in wheel.bearings.items()
    }


def _by_positions(wheels: Sequence[Wheel]) -> Loads:
    """Loads of the two bearings of a shaft and of pure thrust bearings, by static balance."""
    loads: Loads = {}
    seats: list[tuple[Wheel, str, Bearing]] = [(w, name, one) for w in wheels for name, one in w.bearings.items()]
    for wheel, name, one in seats:
        _check_seat(one, f"stages.{wheel.stage}.bearings.{name}")
    radial = [(w, name, w.position + one.position_mm * 1e-3) for w, name, one in seats if one.position_mm is not None]
    if len(radial) != 2 or radial[0][2] == radial[1][2]:
        rule = (
            f"a balance needs two bearings at different positions, not {len(radial)} at "
            f"{', '.join(f'{1e3 * at:g} mm' for *_, at in radial)}; for others give radial_share and axial_share"
        )
        raise InputError(rule, where=wheels[0].shaft)
    forces = [wheel.force() for wheel in wheels]
    reactions = bearing_reactions(forces, radial[0][2], radial[1][2])
    found = {(w.stage, name): abs(force) for (w, name, _), force in zip(radial, reactions, strict=True)}
    thrust = sum(one.thrust for one in forces)
    carrier = _carrier(wheels, seats, thrust, max(abs(one.thrust) for one in forces))
    for wheel, name, one in seats:
        axial = abs(thrust) if one is carrier else 0.0
        loads[wheel.stage, name] = found.get((wheel.stage, name), 0.0) * wheel.torque, axial * wheel.torque
    return loads


def _check_seat(one: Bearing, where: str) -> None:
    """Raise an error for shares beside positions, several bearings at one position, and bearings without load."""
    for key in ("radial_share", "axial_share"):
        if key in one.model_fields_set:
            raise InputError("follows from the positions of its shaft; leave it out", where=f"{where}.{key}")
    if one.count > 1:
        raise InputError("each bearing has a position of its own: list them one by one", where=f"{where}.count")
    if one.position_mm is None and one.axial in (None, "loose"):
        raise InputError("needs position_mm as others of its shaft, or `axial` if it carries thrust alone", where=where)


def _carrier(
    wheels: Sequence[Wheel], seats: Sequence[tuple[Wheel, str, Bearing]], thrust: float, largest: float
) -> Bearing | None:
    """Bearing that takes the thrust of a shaft; None without thrust."""
    if abs(thrust) <= BALANCED * largest:
        return None
    side = "positive" if thrust > 0.0 else "negative"
    takers = [one for _, _, one in seats if one.axial in ("fixed", side)]
    if len(takers) != 1:
        in_coast = " in coast" if wheels[0].coast else ""
        has = "no bearing takes" if not takers else f"{len(takers)} bearings take"
        rule = (
            f'{has} the axial force, which points to the {side} side{in_coast}: give axial = "fixed" (or "{side}") to '
            "one bearing of the shaft"
        )
        raise InputError(rule, where=wheels[0].shaft)
    return takers[0]
