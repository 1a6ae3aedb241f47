"""Rigs to draw from: gears, discs, oils, surfaces, test programmes, as a case folder would describe them."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from mixedlub.validation.build import Case, gears_of
from mixedlub.validation.involute import path_of_contact

UNCERTAINTY = {
    "boundary_friction": 0.012,
    "viscosity": 0.06,
    "pressure_viscosity": 0.06,
    "eyring_stress": 0.15,
    "roughness": 0.04,
}
GEARS: tuple[dict[str, Any], ...] = (
    {"teeth": [17, 26], "normal_module_mm": 4.2333333, "pressure_angle_deg": 22.5, "face_width_mm": 14.0,
     "tip_diameter_mm": [80.4, 118.5], "torques": (40.0, 160.0), "speeds": (500.0, 3500.0)},
    {"teeth": [16, 24], "normal_module_mm": 4.5, "pressure_angle_deg": 20.0, "face_width_mm": 14.0,
     "tip_diameter_mm": [82.46, 118.36], "profile_shift": [0.1817, 0.1715], "centre_distance_mm": 91.5,
     "torques": (60.0, 300.0), "speeds": (400.0, 3500.0)},
    {"teeth": [28, 28], "normal_module_mm": 3.175, "pressure_angle_deg": 20.0, "face_width_mm": 6.35,
     "tip_diameter_mm": [95.25, 95.25], "torques": (25.0, 90.0), "speeds": (600.0, 6000.0)},
    {"teeth": [23, 37], "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "face_width_mm": 20.0,
     "tip_diameter_mm": [75.0, 117.0], "torques": (40.0, 220.0), "speeds": (500.0, 4500.0)},
    {"teeth": [35, 40], "normal_module_mm": 2.5, "pressure_angle_deg": 20.0, "face_width_mm": 18.0,
     "tip_diameter_mm": [92.5, 105.0], "torques": (50.0, 200.0), "speeds": (500.0, 5000.0)},
)  # fmt: skip
OILS: dict[str, dict[str, Any]] = {
    "mineral": {"gold": (9.904, 0.1390), "index": (1.0, 1.3), "density": 865.0, "cubic": 7e-4},
    "pao": {"gold": (7.382, 0.1335), "index": (1.3, 1.6), "density": 832.0, "cubic": 7e-4},
    "ester": {"gold": (6.605, 0.1360), "index": (1.2, 1.5), "density": 950.0, "cubic": 8e-4},
}
FINISHES = ("mirror", "polished", "superfinished", "honed", "ground_fine", "ground", "ground_coarse")


def _round(value: float, digits: int = 5) -> float:
    return float(f"{value:.{digits}g}")


def draw_oil(rng: np.random.Generator) -> dict[str, Any]:
    """An oil of one of three base stocks: Gold's pressure coefficient, VG-like viscosities."""
    base = str(rng.choice(list(OILS)))
    kind = OILS[base]
    nu40 = float(np.exp(rng.uniform(np.log(28.0), np.log(110.0))))
    nu100 = 0.264 * nu40**0.764 * rng.uniform(*kind["index"])
    scale, power = kind["gold"]
    spread = rng.normal(1.15, 0.06)
    return {
        "name": f"{base} oil",
        "temperature_C": [40.0, 100.0],
        "kinematic_viscosity_mm2_s": [_round(nu40), _round(max(nu100, 3.5))],
        "pressure_viscosity_per_GPa": [_round(spread * scale * nu**power) for nu in (nu40, max(nu100, 3.5))],
        "density_15C_kg_m3": kind["density"],
        "density_change_per_K": kind["cubic"],
        "eyring_stress_MPa": _round(rng.uniform(3.8, 7.0)),
        "thermal_conductivity_W_mK": _round(rng.uniform(0.13, 0.15)),
        "specific_heat_J_kgK": _round(rng.uniform(1900, 2200)),
    }


def draw_surfaces(rng: np.random.Generator, coated: bool) -> dict[str, dict[str, Any]]:
    """Finishes from mirror to coarse: rms slope and bandwidth grow with height, each with scatter."""
    count = int(rng.integers(4, 7))
    names = [FINISHES[i] for i in sorted(rng.choice(len(FINISHES), count, replace=False))]
    heights = np.exp(np.linspace(np.log(rng.uniform(0.03, 0.06)), np.log(rng.uniform(0.35, 0.65)), count))
    table: dict[str, dict[str, Any]] = {}
    for name, height in zip(names, heights):
        slope = 0.0045 * height**0.6 * np.exp(rng.normal(0, 0.2))
        nayak = max(55 * height**0.7 * np.exp(rng.normal(0, 0.25)), 4.0)
        table[name] = {
            "m0_um2": _round(height**2),
            "m2": _round(slope),
            "m4_per_um2": _round(nayak * slope**2 / height**2),
        }
    if coated:
        layer = {
            "name": "DLC",
            "thickness_um": _round(rng.uniform(2.0, 4.0), 2),
            "thermal_conductivity_W_mK": 2.0,
        }
        for name in names[: max(2, count // 2)]:
            table[name]["coating"] = layer
    return table


def _pairs(rng: np.random.Generator, names: list[str], count: int) -> list[tuple[str, str]]:
    every = list(itertools.combinations_with_replacement(names, 2))
    order = rng.permutation(len(every))
    return [every[i] for i in order[:count]]


def _levels(rng: np.random.Generator, span: tuple[float, float], count: int) -> list[float]:
    """Geometric levels with the ends moved by up to 15 %."""
    first, last = span[0] * rng.uniform(1.0, 1.15), span[1] * rng.uniform(0.85, 1.0)
    return [_round(v, 2) for v in np.geomspace(first, last, count)]


def _temperatures(rng: np.random.Generator, count: int) -> list[float]:
    sets = {2: [[60.0, 90.0], [50.0, 80.0], [40.0, 100.0]], 3: [[40.0, 70.0, 100.0], [50.0, 80.0, 110.0]]}
    options = sets[count]
    return options[int(rng.integers(len(options)))]


def draw_share(rng: np.random.Generator, settings: dict[str, Any], torques: list[float]) -> np.ndarray | None:
    """Load-share rows: ISO-like ramps, or elastic-like ones that depend on torque; None is equal sharing."""
    style = rng.choice(["rigid", "ramp", "elastic"], p=[0.2, 0.3, 0.5])
    if style == "rigid":
        return None
    path = path_of_contact(gears_of(settings))
    ratio = path.contact_ratio
    place = np.linspace(0.0, ratio, int(rng.integers(61, 92)))
    tip, reach = rng.uniform(0.2, 0.45), rng.uniform(0.0, 0.9)
    rows = []
    for torque in torques:
        end = tip * (torque / max(torques)) ** reach if style == "elastic" else 1 / 3
        bend = rng.uniform(0.8, 1.3) if style == "elastic" else 1.0
        ramp = np.clip(place / (ratio - 1), 0, 1) ** bend
        entering = end + (1 - 2 * end) * ramp
        leaving = end + (1 - 2 * end) * np.clip((ratio - place) / (ratio - 1), 0, 1) ** bend
        share = np.where(place < ratio - 1, entering, np.where(place > 1, leaving, 1.0))
        angle = np.degrees((path.start + place * path.base_pitch) / path.base_radius[0])
        rows.append(np.column_stack([np.full(len(place), torque), np.round(angle, 6), np.round(share, 6)]))
    return np.concatenate(rows)


def draw_gear(rng: np.random.Generator, coated: bool) -> Case:
    """A gear rig and its programme: every pairing, torque, speed and temperature once, in random order."""
    chosen = dict(GEARS[int(rng.integers(len(GEARS)))])
    torque_range, speed_range = chosen.pop("torques"), chosen.pop("speeds")
    chosen["tip_diameter_mm"] = [_round(d * (1 - rng.uniform(0, 0.004))) for d in chosen["tip_diameter_mm"]]
    surfaces = draw_surfaces(rng, coated)
    sizes = [(4, 3, 6, 2), (3, 3, 6, 3), (3, 4, 5, 3), (4, 3, 4, 3), (5, 3, 5, 2), (4, 4, 5, 2)]
    pairs, torques, speeds, temperatures = sizes[int(rng.integers(len(sizes)))]
    levels = (
        _pairs(rng, list(surfaces), pairs),
        _levels(rng, torque_range, torques),
        _levels(rng, speed_range, speeds),
        _temperatures(rng, temperatures),
    )
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "gear_pair",
        "boundary_friction": 0.1,
        "gears": {
            **chosen,
            "helix_angle_deg": 0.0,
            "youngs_modulus_GPa": [206.0, 206.0],
            "poisson_ratio": [0.3, 0.3],
        },
        "lubricant": draw_oil(rng),
        "surfaces": surfaces,
        "uncertainty": UNCERTAINTY,
        "recording": {"quantity": "power_loss_W", "includes": "the whole gearbox as the rig measures it"},
    }
    share = draw_share(rng, settings, levels[1])
    settings["gears"]["load_sharing"] = {"model": "rigid"} if share is None else {"table": "load_share.csv"}
    grid = list(itertools.product(*levels))
    order = rng.permutation(len(grid))
    rows = [grid[i] for i in order]
    columns = {
        **_numbered(len(rows)),
        "pinion_surface": np.array([row[0][0] for row in rows], dtype=object),
        "gear_surface": np.array([row[0][1] for row in rows], dtype=object),
        "torque_Nm": np.array([row[1] for row in rows]),
        "speed_rpm": np.array([row[2] for row in rows]),
        "oil_temperature_C": np.array([row[3] for row in rows]),
    }
    return Case(settings, columns, share)


def _numbered(count: int) -> dict[str, np.ndarray]:
    return {"run": np.arange(1, count + 1), "sequence": np.round(np.arange(count) / max(count - 1, 1), 6)}


def draw_disc(rng: np.random.Generator, coated: bool) -> Case:
    """A two-disc rig and 150 to 220 random points of its grid of loads, speeds, slips, temperatures."""
    surfaces = draw_surfaces(rng, coated)
    radii = [float(rng.choice([20.0, 25.4, 30.0, 38.1])), float(rng.choice([25.4, 40.0, 50.0]))]
    width = float(rng.choice([4.0, 6.0, 10.0]))
    modulus = 206e9 / (1 - 0.3**2)
    radius = 1e-3 * radii[0] * radii[1] / sum(radii)
    pressures = np.linspace(rng.uniform(0.55, 0.75), rng.uniform(1.15, 1.5), 3) * 1e9
    loads = [_round(2 * np.pi * p**2 * radius / modulus * 1e-3 * width, 5) for p in pressures]
    slips = [0.005, 0.02, 0.05, 0.1, 0.3, 0.6, 1.0]
    chosen = sorted(rng.choice(len(slips), int(rng.integers(4, 6)), replace=False))
    levels = (
        _pairs(rng, list(surfaces), int(rng.integers(3, 6))),
        loads,
        _levels(rng, (0.4, 12.0), int(rng.integers(4, 6))),
        [slips[i] for i in chosen],
        _temperatures(rng, 3),
    )
    grid = list(itertools.product(*levels))
    order = rng.permutation(len(grid))[: int(rng.integers(150, 221))]
    rows = [grid[i] for i in order]
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "disc",
        "boundary_friction": 0.1,
        "contact": {
            "geometry": "line",
            "radius_mm": radii,
            "width_mm": width,
            "youngs_modulus_GPa": [206.0, 206.0],
            "poisson_ratio": [0.3, 0.3],
        },
        "lubricant": draw_oil(rng),
        "surfaces": surfaces,
        "uncertainty": UNCERTAINTY,
        "recording": {"quantity": "friction_coefficient"},
    }
    columns = {
        **_numbered(len(rows)),
        "surface_1": np.array([row[0][0] for row in rows], dtype=object),
        "surface_2": np.array([row[0][1] for row in rows], dtype=object),
        "load_N": np.array([row[1] for row in rows]),
        "entrainment_speed_m_s": np.array([row[2] for row in rows]),
        "slide_roll_ratio": np.array([row[3] for row in rows]),
        "oil_temperature_C": np.array([row[4] for row in rows]),
    }
    return Case(settings, columns)


def withhold(rng: np.random.Generator, case: Case, small: bool) -> np.ndarray:
    """Readings to keep back: a whole level of one condition and a tenth at random; most in small cases."""
    count = len(case.columns["run"])
    if small:
        visible = rng.choice(count, int(rng.integers(20, 41)), replace=False)
        hidden = np.ones(count, dtype=bool)
        hidden[visible] = False
        return hidden
    hidden = rng.random(count) < rng.uniform(0.06, 0.14)
    names = [n for n in case.columns if n not in ("run", "sequence") and not n.startswith(("pinion", "gear"))]
    wide = [n for n in names if "surface" not in n and len(np.unique(case.columns[n])) >= 3]
    if wide and rng.random() < 0.8:
        name = wide[int(rng.integers(len(wide)))]
        levels = np.unique(case.columns[name])
        level = levels[int(rng.integers(len(levels)))]
        hidden |= case.columns[name] == level
    return hidden
