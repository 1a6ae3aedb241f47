"""Planetary stages of the tests as dictionaries."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

from mixedlub.efficiency import Gearbox, read_gearbox
from mixedlub.efficiency.train import Coupling, PlanetaryTrain
from tests.efficiency.gearboxes import SMOOTH, written

FLANKS = {"pinion": SMOOTH, "gear": SMOOTH}


def mesh(*wheels: str, teeth: tuple[int, int], **gears: Any) -> dict[str, Any]:
    own = {"teeth": list(teeth), "normal_module_mm": 2.0, "face_width_mm": 30.0, **gears}
    return {"wheels": list(wheels), "gears": own, "surfaces": FLANKS}


NEEDLE = {
    "law": "palmgren",
    "coefficients": {"f0": 6.0, "f1": 5e-4},
    "bore_mm": 22,
    "outside_diameter_mm": 32,
}
SIMPLE: dict[str, Any] = {
    "oil_temperature_C": 70.0,
    "planet_count": 3,
    "lubricant": {"oil": "m100"},
    "meshes": {
        "inner": mesh("sun", "planet", teeth=(27, 33)),
        "outer": mesh("planet", "ring", teeth=(33, -93)),
    },
    "planets": {"planet": {"mass_kg": 0.5, "bearings": {"needle": NEEDLE}}},
    "others": {"drag": {"law": "own_torque", "shaft": "carrier", "coefficients": {"constant": 0.2}}},
}


def planetary_box(folder: Path, *stages: dict[str, Any], **tables: Any) -> Gearbox:
    """A gearbox of planetary stages that the first letters name."""
    conditions = {"torque_Nm": [0.0, 50.0, 200.0], "speed_rpm": [500.0, 3000.0]}
    named = {name: copy.deepcopy(stage) for name, stage in zip("abc", stages, strict=False)}
    file = {"schema": "mixedlub-efficiency/1", "conditions": conditions, **tables, "planetary": named}
    return read_gearbox(written(folder, file))[0]


def simple(driving: str, driven: str, fixed: str) -> PlanetaryTrain:
    """Sun 18, planet 27, ring 72."""
    couplings = Coupling("inner", ("sun", "planet"), (18, 27)), Coupling("outer", ("planet", "ring"), (27, -72))
    return PlanetaryTrain(couplings, ("planet",), driving, driven, fixed)


def two_suns(driving: str, driven: str) -> PlanetaryTrain:
    """Positive ratio of nearly 1 at rest of the carrier: suns 50 and 51 on stepped planets 49 and 50."""
    couplings = Coupling("first", ("a", "planet"), (50, 49)), Coupling("second", ("planet", "b"), (50, 51))
    return PlanetaryTrain(couplings, ("planet",), driving, driven, "b")


def wolfrom(driving: str = "sun", driven: str = "second") -> PlanetaryTrain:
    """Sun 18, stepped planets 27 and 24, rings 72 (fixed) and 69, free carrier."""
    couplings = (
        Coupling("a", ("sun", "planet"), (18, 27)),
        Coupling("b", ("planet", "first"), (27, -72)),
        Coupling("c", ("planet", "second"), (24, -69)),
    )
    return PlanetaryTrain(couplings, ("planet",), driving, driven, "first")


def meshed(driving: str, driven: str, fixed: str) -> PlanetaryTrain:
    """Two planets in mesh between sun 30 and ring 90."""
    couplings = (
        Coupling("a", ("sun", "near"), (30, 20)),
        Coupling("b", ("near", "far"), (20, 22)),
        Coupling("c", ("far", "ring"), (22, -90)),
    )
    return PlanetaryTrain(couplings, ("near", "far"), driving, driven, fixed)
