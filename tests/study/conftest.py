"""Study files for the tests: a small valid one, and a way to change it."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

BASE: dict[str, Any] = {
    "schema": "mixedlub-study/1",
    "gears": {
        "teeth": [17, 26],
        "normal_module_mm": 4.2333333,
        "pressure_angle_deg": 22.5,
        "face_width_mm": 14.0,
        "load_sharing": {"model": "rigid"},
    },
    "lubricant": {
        "temperature_C": [60.0, 100.0],
        "kinematic_viscosity_mm2_s": [18.05, 7.2],
        "pressure_viscosity_per_GPa": [14.8, 13.0],
        "density_15C_kg_m3": 850.0,
        "density_change_per_K": 6.5e-4,
        "eyring_stress_MPa": 5.0,
        "thermal_conductivity_W_mK": 0.14,
        "specific_heat_J_kgK": 2000.0,
    },
    "surfaces": {
        "fine": {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036},
        "mid": {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036},
        "coarse": {"m0_um2": 0.3, "m2": 0.003, "m4_per_um2": 0.004},
    },
    "conditions": {"torque_Nm": [50, 150], "speed_rpm": [500, 1500, 3000], "oil_temperature_C": [60, 90]},
}


def toml(value: Any) -> str:
    """A value as inline TOML."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, float) and value != value:
        return "nan"
    return json.dumps(value)


StudyWriter = Callable[..., Path]


def study_file(folder: Path, name: str = "trial", **changes: Any) -> Path:
    """Write a study file; keywords `a__b=value` set a key of table a, None removes it."""
    data = copy.deepcopy(BASE)
    for place, value in changes.items():
        *tables, key = place.split("__")
        target = data
        for table in tables:
            target = target.setdefault(table, {})
        if value is None:
            target.pop(key, None)
        else:
            target[key] = value
    path = folder / f"{name}.toml"
    path.write_text("\n".join(f"{key} = {toml(value)}" for key, value in data.items()) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def write_study(tmp_path: Path) -> StudyWriter:
    """Writes a study file in the folder of the test."""
    return partial(study_file, tmp_path)
