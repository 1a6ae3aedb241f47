"""Parts of a stage with losses outside the mesh: their laws and inputs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.chain.documented import few
from mixedlub.chain.part_law import GIVEN, Kind, PartLaw
from mixedlub.chain.ranges import UNBOUNDED, Limit, Reached, declared
from mixedlub.efficiency.file import Stage
from mixedlub.efficiency.part_tables import Bearing, Churning, Part, RollingBearing
from mixedlub.efficiency.shafts import Load
from mixedlub.gear import GearPair
from mixedlub.laws.drag import FAST_BATH, bath_acceleration
from mixedlub.parts import find, series, series_coefficients
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError

KINDS: Mapping[str, Kind] = {
    "bearings": "bearing",
    "seals": "seal",
    "windage": "windage",
    "churning": "churning",
    "pocketing": "pocketing",
    "jets": "jet",
    "others": "other",
}
"""Tables of a stage and kinds of their parts."""
BATH = "bath_acceleration"
"""Quantity that decides on the law of churning."""
OF_ANY_LAW = {"law", "coefficients", "factor", "count", "shaft", "wheel", "series"}
OF_LOAD = {"position_mm", "axial", "radial_share", "axial_share", "radial_load_N", "axial_load_N"}
"""Keys that determine the loads of a bearing."""
NO_LOAD = (0.0, 0.0)
LEAST_RATING, LARGEST_RATING = 0.3, 200.0
"""Static rating over the square of the mean diameter (N/mm2): thin ball bearings 1, spherical thrust bearings 100."""


@dataclass(frozen=True, eq=False)
class StagePart:
    """Part with table, name, law, numbers from the user, and wheel or shaft (0 pinion, 1 gear)."""

    table: str
    name: str
    law: PartLaw
    section: Part
    coefficients: Mapping[str, float]
    side: int
    load: Load = NO_LOAD

    def loss(self, pair: GearPair, oil: Mapping[str, Any], torque: np.ndarray, speed: np.ndarray) -> np.ndarray:
        """Power loss (W) at torques (N m) and speeds (rad/s) of the pinion."""
        own = speed if self.side == 0 else speed / pair.gear_ratio
        radial, axial = self.load
        return self._power(own, {**_wheel(pair, self.side), **oil}, radial * torque, axial * torque)

    def at(self, speed: np.ndarray, oil: Mapping[str, Any], radial: np.ndarray | float) -> np.ndarray:
        """Power loss (W) of a part without wheel at speeds (rad/s) and radial loads (N) of its shaft."""
        return self._power(speed, oil, radial, 0.0)

    @property
    def shaft(self) -> str:
        """Shaft or member of the part as named in the file."""
        return str(getattr(self.section, "shaft", ""))

    def _power(
        self, own: np.ndarray, known: Mapping[str, Any], radial: np.ndarray | float, axial: np.ndarray | float
    ) -> np.ndarray:
        """Power loss (W) at shaft speeds (rad/s) with forces (N) of the meshes."""
        loads = {}
        if isinstance(self.section, RollingBearing):
            loads["radial_load"] = radial + self.section.radial_load_N
            loads["axial_load"] = axial + self.section.axial_load_N
        state = {**known, "shaft_speed": own, **loads, **self._given()}
        found = np.asarray(self.law.law(*(state[name] for name in self.law.reads), **self.coefficients))
        power = found * own if self.law.kind in ("bearing", "seal", "other") else found
        return np.broadcast_to(self.section.factor * self.section.count * power, own.shape)

    def reached(self, pair: GearPair, speed: np.ndarray) -> Reached:
        """Limits of the law with values at speeds (rad/s) of the pinion."""
        if BATH not in declared(self.law.law):
            return []
        own = speed if self.side == 0 else speed / pair.gear_ratio
        size = (abs(pair.operating_radius[self.side]), pair.face_width, pair.normal_module)
        bath = bath_acceleration(own, *map(np.asarray, size))
        advice = (
            f"churning of {self.name} by {self.law.title} goes over to the law of high speed, which viscosity does not "
            f"enter, between the ends of this range and {FAST_BATH:g} m/s^2: the loss may change by a factor there"
        )
        return [(Limit("churning_law_changes", BATH, declared(self.law.law)[BATH], advice, UNBOUNDED), bath)]

    def _given(self) -> dict[str, float]:
        values = self.section.model_dump()
        return {n: values[k] * unit for n, (k, unit) in GIVEN.items() if n in self.law.reads}


def parts_of(stage: Stage, pair: GearPair, loads: Mapping[str, Load], where: str) -> Iterator[StagePart]:
    """Parts of a stage, checked against their laws.

    ``loads``: by bearing name; ``where``: place of the stage in messages.
    """
    for table in KINDS:
        for name, section in getattr(stage, table).items():
            place = f"{where}.{table}.{name}"
            part = part_of(table, name, section, place)
            if isinstance(section, Churning):
                _check_immersion(section, abs(pair.operating_radius[part.side]), place)
            yield replace(part, load=loads.get(name, NO_LOAD)) if isinstance(section, Bearing) else part


def part_of(table: str, name: str, section: Part, where: str) -> StagePart:
    """Part of a table of the file, checked against its law."""
    law = find(KINDS[table], section.law, f"{where}.law")
    _check_keys(law, section, where)
    given: dict[str, float] = dict(section.coefficients)
    name_of_series = getattr(section, "series", None)
    if name_of_series is not None:
        given = {**series_coefficients(law, name_of_series, f"{where}.series"), **given}
    elif law.series and (missing := [c.name for c in law.coefficients if c.default is None and c.name not in given]):
        names = few(list(series()[law.series]))
        rule = f"needs {few(missing)}: give `series` ({names}), or these by `coefficients`, from the catalogue"
        raise InputError(rule, where=where)
    law.check_given(given, f"{where}.coefficients", f"mixedlub parts {law.name}")
    check_name(name, where)
    side = getattr(section, "shaft", getattr(section, "wheel", "pinion"))
    return StagePart(table, name, law, section, law.values(given), 0 if side == "pinion" else 1)


def bearing_findings(
    part: StagePart, pair: GearPair, oil: Mapping[str, Any], where: str, *, idles: bool
) -> Iterator[Finding]:
    """Doubt about a static rating untypical of the bearing size; note on a freely turning bearing.

    ``idles``: conditions without torque are computed.
    """
    if not isinstance(part.section, Bearing):
        return
    place = f"{where}.bearings.{part.name}"
    yield from rating_findings(part, place)
    if idles and not part.loss(pair, oil, np.zeros(1), np.array([100.0])).any():
        text = (
            f"loses nothing at zero torque: {part.law.name} has no torque without load; drag of the oil and the least "
            "load of the bearing are not in it: give radial_load_N or axial_load_N (weight, preload)"
        )
        yield finding("bearing_free_without_load", text, place)


def rating_findings(part: StagePart, place: str) -> Iterator[Finding]:
    """Doubt about a static rating untypical of the bearing size."""
    section = part.section
    if not isinstance(section, RollingBearing):
        return
    rating, mean = section.static_rating_N, 0.5 * (section.bore_mm + section.outside_diameter_mm)
    if rating is not None and not LEAST_RATING <= rating / mean**2 <= LARGEST_RATING:
        low, high = (f"{limit * mean**2:.2g}" for limit in (LEAST_RATING, LARGEST_RATING))
        unit = "kN where N is asked for?" if rating < LEAST_RATING * mean**2 else "is its unit N?"
        text = f"{rating:g} N is outside {low} to {high} N, which bearings of this size have ({unit})"
        yield finding("static_rating_implausible", text, f"{place}.static_rating_N")


def _check_keys(law: PartLaw, section: Part, where: str) -> None:
    """Raise an error for keys missing for the law or ignored by it."""
    for key in law.keys:
        if getattr(section, key) is None:
            raise InputError(f"{law.name} needs {key}", where=where)
    loads = OF_LOAD if {"radial_load", "axial_load"} & set(law.reads) else set()
    for key in sorted(section.model_fields_set - OF_ANY_LAW - loads - set(law.keys)):
        raise InputError(
            f"{law.name} does not read it; leave it out", where=f"{where}.{key}", value=getattr(section, key)
        )


def _check_immersion(section: Churning, radius: float, where: str) -> None:
    """Raise an error for an immersion above the pitch diameter of the wheel."""
    if section.immersion_mm is not None and section.immersion_mm > 2e3 * radius:
        rule = f"is above the pitch diameter of the {section.wheel}, {2e3 * radius:.4g} mm"
        raise InputError(rule, where=f"{where}.immersion_mm", value=section.immersion_mm)


def check_name(name: str, where: str) -> None:
    """Raise an error for a name unsuitable for a table column."""
    if not name or name != name.strip() or any(mark in name for mark in ',"\n'):
        raise InputError("must be a name of one line without commas or quotes", where=where, value=name)


def _wheel(pair: GearPair, side: int) -> dict[str, Any]:
    """Sizes of a wheel by quantity of the part laws."""
    root = pair.reference_radius[side] + pair.normal_module * (pair.profile_shift[side] - pair.dedendum)
    return {
        "wheel_radius": abs(pair.operating_radius[side]),
        "face_width": pair.face_width,
        "gear_module": pair.normal_module,
        "wheel_teeth": float(abs(pair.teeth[side])),
        "helix_angle": abs(pair.helix_angle),
        "root_diameter": 2.0 * abs(root),
        "tip_diameter": 2.0 * abs(pair.tip_radii[side]),
    }


def oil_state(oil: Lubricant, temperature: np.ndarray | float) -> dict[str, np.ndarray]:
    """Oil inputs of part laws at temperatures (K)."""
    at = np.asarray(temperature, dtype=float)
    return {"viscosity": np.asarray(oil.viscosity(at)), "oil_density": np.asarray(oil.density(at))}
