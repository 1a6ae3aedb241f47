"""The parts of a stage that lose power outside the mesh: their laws with what each of them reads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.chain.part_law import GIVEN, Kind, PartLaw
from mixedlub.efficiency.file import Bearing, Churning, Part, Stage
from mixedlub.gear import GearPair
from mixedlub.parts import find, series_coefficients
from mixedlub.rig.lubricant import Lubricant
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
"""Tables of a stage and the kind of their parts."""
OF_ANY_LAW = {"law", "coefficients", "factor", "count", "shaft", "wheel", "series"}
OF_LOAD = {"radial_share", "axial_share", "radial_load_N", "axial_load_N"}
"""Keys from which the loads of a bearing follow."""


@dataclass(frozen=True, eq=False)
class StagePart:
    """A part: its table and name, its law with the numbers of the user, and its wheel or shaft (0 pinion, 1 gear)."""

    table: str
    name: str
    law: PartLaw
    section: Part
    coefficients: Mapping[str, float]
    side: int

    def loss(self, pair: GearPair, oil: Mapping[str, float], torque: np.ndarray, speed: np.ndarray) -> np.ndarray:
        """Its power loss (W) at torques (N m) and speeds (rad/s) of the pinion."""
        own = speed if self.side == 0 else speed / pair.gear_ratio
        state = {**_wheel(pair, self.side), **oil, "shaft_speed": own, **self._loads(pair, torque), **self._given()}
        found = np.asarray(self.law.law(*(state[name] for name in self.law.reads), **self.coefficients))
        power = found * own if self.law.kind in ("bearing", "seal", "other") else found
        return np.broadcast_to(self.section.factor * self.section.count * power, torque.shape)

    def _given(self) -> dict[str, float]:
        values = self.section.model_dump()
        return {n: values[k] * unit for n, (k, unit) in GIVEN.items() if n in self.law.reads}

    def _loads(self, pair: GearPair, torque: np.ndarray) -> dict[str, np.ndarray]:
        if not isinstance(self.section, Bearing):
            return {}
        force = torque / pair.base_radius[0]
        thrust = force * np.tan(abs(pair.base_helix_angle))
        return {
            "radial_load": self.section.radial_share * force + self.section.radial_load_N,
            "axial_load": self.section.axial_share * thrust + self.section.axial_load_N,
        }


def parts_of(stage: Stage, pair: GearPair, where: str) -> Iterator[StagePart]:
    """The parts of a stage, each checked against its law; ``where`` is the place of the stage."""
    for table in KINDS:
        for name, section in getattr(stage, table).items():
            place = f"{where}.{table}.{name}"
            part = _part(table, name, section, place)
            if isinstance(section, Churning):
                _check_immersion(section, pair.operating_radius[part.side], place)
            yield part


def _part(table: str, name: str, section: Part, where: str) -> StagePart:
    law = find(KINDS[table], section.law, f"{where}.law")
    _check_keys(law, section, where)
    given: dict[str, float] = dict(section.coefficients)
    series = getattr(section, "series", None)
    if series is not None:
        given = {**series_coefficients(law, series, f"{where}.series"), **given}
    law.check_given(given, f"{where}.coefficients", f"mixedlub parts {law.name}")
    check_name(name, where)
    side = getattr(section, "shaft", getattr(section, "wheel", "pinion"))
    return StagePart(table, name, law, section, law.values(given), 0 if side == "pinion" else 1)


def _check_keys(law: PartLaw, section: Part, where: str) -> None:
    """Refuse keys that the law lacks, and those that it would ignore."""
    for key in law.keys:
        if getattr(section, key) is None:
            raise InputError(f"{law.name} needs {key}", where=where)
    loads = OF_LOAD if {"radial_load", "axial_load"} & set(law.reads) else set()
    for key in sorted(section.model_fields_set - OF_ANY_LAW - loads - set(law.keys)):
        raise InputError(
            f"{law.name} does not read it; leave it out", where=f"{where}.{key}", value=getattr(section, key)
        )


def _check_immersion(section: Churning, radius: float, where: str) -> None:
    """Refuse a wheel that is deeper in the oil than it is high."""
    if section.immersion_mm is not None and section.immersion_mm > 2e3 * radius:
        rule = f"is above the pitch diameter of the {section.wheel}, {2e3 * radius:.4g} mm"
        raise InputError(rule, where=f"{where}.immersion_mm", value=section.immersion_mm)


def check_name(name: str, where: str) -> None:
    """Refuse a name that a column of a table cannot have."""
    if not name or name != name.strip() or any(mark in name for mark in ',"\n'):
        raise InputError("must be a name of one line without commas or quotes", where=where, value=name)


def _wheel(pair: GearPair, side: int) -> dict[str, Any]:
    """Sizes of a wheel by the quantities of part laws."""
    root = pair.reference_radius[side] + pair.normal_module * (pair.profile_shift[side] - 1.25)
    return {
        "wheel_radius": pair.operating_radius[side],
        "face_width": pair.face_width,
        "gear_module": pair.normal_module,
        "wheel_teeth": float(pair.teeth[side]),
        "helix_angle": abs(pair.helix_angle),
        "root_diameter": 2.0 * root,
        "tip_diameter": 2.0 * pair.tip_radii[side],
    }


def oil_state(oil: Lubricant, temperature: float) -> dict[str, float]:
    """What part laws read of an oil at a temperature (K)."""
    at = np.array(temperature)
    return {"viscosity": float(oil.viscosity(at)), "oil_density": float(oil.density(at))}
