"""Gearboxes of the tests as dictionaries, and how they are read."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

from mixedlub.efficiency import Gearbox, read_gearbox
from mixedlub.schema.toml_file import to_toml

SMOOTH = {"m0_um2": 0.01, "m2": 0.0005, "m4_per_um2": 0.0004}
STAGE: dict[str, Any] = {
    "oil_temperature_C": 80.0,
    "gears": {"preset": "fzg_c"},
    "lubricant": {"oil": "m100"},
    "surfaces": {"pinion": SMOOTH, "gear": SMOOTH},
    "effects": {"rolling_resistance": {"law": "Biboulet and Houpert"}},
}
PARTS: dict[str, Any] = {
    "bearings": {
        "front": {
            "law": "skf_deep_groove",
            "series": "62",
            "shaft": "pinion",
            "bore_mm": 35,
            "outside_diameter_mm": 72,
            "static_rating_N": 15300,
            "count": 2,
        },
        "back": {
            "law": "palmgren",
            "coefficients": {"f0": 2.0, "f1": 3e-4},
            "shaft": "gear",
            "bore_mm": 35,
            "outside_diameter_mm": 72,
            "count": 2,
        },
    },
    "seals": {"front": {"law": "iso_tr_14179_2", "shaft": "pinion", "diameter_mm": 35}},
    "windage": {"wheel": {"law": "dawson", "wheel": "gear"}},
    "churning": {"wheel": {"law": "changenet_velex", "wheel": "gear", "immersion_mm": 20, "oil_volume_l": 1.5}},
    "pocketing": {
        "mesh": {
            "law": "incompressible",
            "exit_area_mm2": 40,
            "coefficients": {"pocket_volume": 0.5, "mixture_density": 50.0},
        }
    },
    "jets": {"in": {"law": "ariura", "wheel": "pinion", "oil_flow_l_min": 2.5}},
    "others": {"pump": {"law": "own_torque", "shaft": "gear", "coefficients": {"constant": 0.2}}},
}


AFTER: dict[str, Any] = {"bearings": {"after": PARTS["bearings"]["back"] | {"shaft": "pinion", "axial_share": 0.5}}}
"""Bearings of the driving wheel of a stage behind another one with bearings."""


def gearbox_file(*stages: dict[str, Any], **tables: Any) -> dict[str, Any]:
    """A file of stages that the first letters name."""
    conditions = {"torque_Nm": [0.0, 50.0, 200.0], "speed_rpm": [500.0, 3000.0]}
    named = {name: copy.deepcopy(stage) for name, stage in zip("abc", stages, strict=False)}
    return {"schema": "mixedlub-efficiency/1", "conditions": conditions, **tables, "stages": named}


def written(folder: Path, file: dict[str, Any]) -> Path:
    path = folder / "efficiency.toml"
    path.write_text(to_toml(file), encoding="utf-8")
    return path


def gearbox(folder: Path, *stages: dict[str, Any], **tables: Any) -> Gearbox:
    return read_gearbox(written(folder, gearbox_file(*stages, **tables)))[0]
