"""One standard rig of every kind of recording, on which the catalogue compares effects."""

from __future__ import annotations

from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.kinds import kind
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.table import Table

OIL = {
    "name": "automatic transmission fluid",
    "temperature_C": (40.0, 100.0),
    "kinematic_viscosity_mm2_s": (34.0, 7.2),
    "pressure_viscosity_per_GPa": (16.2, 13.0),
    "density_15C_kg_m3": 850.0,
    "density_change_per_K": 6.5e-4,
    "eyring_stress_MPa": 5.0,
    "thermal_conductivity_W_mK": 0.14,
    "specific_heat_J_kgK": 2000.0,
}
UNCERTAINTY = {
    "boundary_friction": 0.012,
    "viscosity": 0.06,
    "pressure_viscosity": 0.06,
    "eyring_stress": 0.15,
    "roughness": 0.04,
}
GEARS = {
    "teeth": (17, 26),
    "normal_module_mm": 25.4 / 6.0,
    "pressure_angle_deg": 22.5,
    "tip_diameter_mm": (80.5, 118.4),
    "face_width_mm": 14.0,
}
DISCS = {"radius_mm": (40.0, 40.0), "width_mm": 6.0}
BALL_ON_GLASS = {
    "geometry": "point",
    "radius_mm": (9.525, float("inf")),
    "youngs_modulus_GPa": (206.0, 75.0),
    "poisson_ratio": (0.3, 0.22),
}
ROUGHNESS_UM = {"superfinished": 0.15, "ground": 0.37, "coarse": 0.58, "coated": 0.37}
"""Rq of one surface; slopes and curvatures are the same for all, as rougher flanks are of longer waves."""

ORDER_NM = 196.0
"""One interference order of the film rig: green light in oil."""

SECTIONS: dict[str, dict[str, Any]] = {
    "gear_pair": {"gears": GEARS, "lubricant": OIL},
    "disc": {"contact": DISCS, "lubricant": OIL},
    "film": {"contact": BALL_ON_GLASS, "lubricant": OIL},
    "friction_history": {"contact": DISCS, "lubricant": OIL},
    "friction_map": {},
    "viscosity": {"lubricant": OIL},
    "mesh_friction": {"gears": GEARS, "lubricant": OIL},
}
"""Of each kind, the parts of the rig: 17/26 teeth at 91 mm centres, two 80 mm discs, a ball on glass, a drive."""

READING = {
    "gear_pair": ("power_loss_W", 0.3),
    "disc": ("friction_coefficient", 2e-4),
    "film": ("film_thickness_nm", 1.0),
    "friction_history": ("friction_coefficient", 2e-4),
    "friction_map": ("friction_torque_Nm", 0.01),
    "viscosity": ("viscosity_mPa_s", 0.02),
    "mesh_friction": ("friction_coefficient", 2e-4),
}
"""Of each kind, what is read and the absolute part of its noise; the relative part is 1 % for all."""

CONDITIONS: dict[str, dict[str, tuple[str, tuple[Any, ...]]]] = {
    "gear_pair": {
        "load": ("torque_Nm", (50.0, 100.0, 150.0)),
        "speed": ("speed_rpm", (500.0, 1000.0, 1500.0, 2000.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (50.0, 70.0, 90.0)),
        "surfaces": ("pinion_surface", tuple(ROUGHNESS_UM)),
    },
    "disc": {
        "load": ("load_N", (400.0, 1000.0, 2200.0)),
        "speed": ("entrainment_speed_m_s", (1.0, 2.5, 6.0, 12.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.05, 0.2, 0.6)),
        "oil_temperature": ("oil_temperature_C", (50.0, 70.0, 90.0)),
        "surfaces": ("surface_1", tuple(ROUGHNESS_UM)),
    },
    "film": {
        "load": ("load_N", (10.0, 20.0, 40.0)),
        "speed": ("entrainment_speed_m_s", (0.01, 0.03, 0.1, 0.3, 1.0, 3.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.0, 0.1, 0.5)),
        "oil_temperature": ("oil_temperature_C", (40.0, 70.0, 100.0)),
    },
    "friction_history": {
        "sequence": ("time_s", tuple(np.linspace(0.0, 7200.0, 13))),
        "load": ("load_N", (400.0, 2200.0)),
        "speed": ("entrainment_speed_m_s", (1.0, 6.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.005, 0.6)),
        "oil_temperature": ("oil_temperature_C", (50.0, 90.0)),
        "surfaces": ("surface_1", ("superfinished", "coarse", "coated")),
    },
    "friction_map": {
        "load": ("torque_Nm", (0.0, 2.0, 4.0)),
        "speed": ("speed_rpm", (-3000.0, -300.0, -30.0, 30.0, 300.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (20.0, 60.0)),
        "additive_fraction": ("additive_percent", (0.0, 2.0)),
        "drive_angle": ("position_deg", tuple(np.linspace(0.0, 3600.0, 60))),
    },
    "viscosity": {
        "oil_temperature": ("temperature_C", (20.0, 40.0, 70.0, 100.0)),
        "pressure": ("pressure_MPa", (0.1, 100.0, 300.0, 600.0, 1000.0)),
    },
    "mesh_friction": {
        "load": ("torque_Nm", (50.0, 150.0)),
        "speed": ("speed_rpm", (500.0, 1500.0, 3000.0)),
        "oil_temperature": ("oil_temperature_C", (50.0, 90.0)),
        "surfaces": ("pinion_surface", tuple(ROUGHNESS_UM)),
        "roll_angle": ("roll_angle_deg", (16.0, 19.0, 22.0, 25.0, 28.0, 31.0)),
    },
}
"""Of each kind, what is varied: its column and the levels, all combined."""

_PARTNER = {"pinion_surface": "gear_surface", "surface_1": "surface_2"}


def table(name: str, **fixed: Any) -> Table:
    """Every combination of the levels, in an order that hides them; ``fixed`` narrows a condition to given levels."""
    conditions = CONDITIONS[name]
    levels = [fixed.get(c, values) for c, (_, values) in conditions.items()]
    rows = list(product(*levels))
    columns = {column: np.array(cells) for (column, _), cells in zip(conditions.values(), zip(*rows), strict=True)}
    for first, second in _PARTNER.items():
        if first in columns:
            columns[second] = columns[first]
    columns["run"] = np.arange(1, len(rows) + 1)
    if "time_s" not in columns:
        columns["sequence"] = np.random.default_rng(0).permutation(len(rows)) / max(len(rows) - 1, 1)
    return Table(columns | _channels(name, columns), f"standard {name}")


def _channels(name: str, columns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """What the instrument tells beside the reading: the motor's torque, the interference order of the film."""
    if name == "friction_map":
        return {"motor_torque_Nm": np.sign(columns["speed_rpm"]) * (1.0 + columns["torque_Nm"])}
    if name == "film":
        film = Forward(case(name), Table(columns, f"standard {name}")).predict()
        return {"fringe_order": np.floor(film / ORDER_NM)}
    return {}


@cache
def case(name: str) -> Case:
    """The standard rig of a kind."""
    quantity, absolute = READING[name]
    surfaces = {
        s: {"m0_um2": rq**2, "m2": 0.0025, "m4_per_um2": 0.0036}
        | ({"coating": {"thickness_um": 3.0, "thermal_conductivity_W_mK": 2.0}} if s == "coated" else {})
        for s, rq in ROUGHNESS_UM.items()
    }
    system = {
        "schema": "mixedlub-case/1",
        "kind": name,
        **SECTIONS[name],
        "surfaces": surfaces if "surfaces" in CONDITIONS[name] else {},
        "uncertainty": UNCERTAINTY,
        "recording": {"quantity": quantity, "noise": {"relative": 0.01, "absolute": absolute}},
    }
    parsed = toml_file.parse(system_file.System, system, f"standard {name}")
    here = Path(".")
    return Case(f"standard_{name}", here, parsed, kind(name), Rig(parsed, here), None, None, ())


@cache
def forward(name: str) -> Forward:
    """The forward problem of the standard rig over all its conditions."""
    return Forward(case(name), table(name))
