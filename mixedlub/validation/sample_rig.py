"""Random draws common to all rigs: oils, surfaces, levels of conditions, orders of a programme."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

UNCERTAINTY = {
    "boundary_friction": 0.012,
    "viscosity": 0.06,
    "pressure_viscosity": 0.06,
    "eyring_stress": 0.15,
    "roughness": 0.04,
}
"""Prior standard deviations: absolute for boundary friction, relative for all others."""
STEEL = {"youngs_modulus_GPa": [206.0, 206.0], "poisson_ratio": [0.3, 0.3]}
FLOOR = (0.15, 1.2)
"""Absolute over relative part of the noise of gears and discs."""
OILS: dict[str, dict[str, Any]] = {
    "mineral": {"gold": (9.904, 0.1390), "index": (1.0, 1.3), "density": 865.0, "cubic": 7e-4},
    "pao": {"gold": (7.382, 0.1335), "index": (1.3, 1.6), "density": 832.0, "cubic": 7e-4},
    "ester": {"gold": (6.605, 0.1360), "index": (1.2, 1.5), "density": 950.0, "cubic": 8e-4},
}
FINISHES = ("mirror", "polished", "superfinished", "honed", "ground_fine", "ground", "ground_coarse")


def pick(rng: np.random.Generator, options: Sequence[Any]) -> Any:
    """A random option."""
    return options[int(rng.integers(len(options)))]


def rounded(value: float, digits: int = 4) -> float:
    return float(f"{value:.{digits}g}")


def between(rng: np.random.Generator, low: float, high: float, digits: int = 4) -> float:
    """Log-uniform between two positive numbers."""
    return rounded(float(np.exp(rng.uniform(np.log(low), np.log(high)))), digits)


def progress(count: int) -> np.ndarray:
    """Position of each reading in the programme, 0 to 1."""
    return np.round(np.arange(count) / max(count - 1, 1), 6)


def repeated(columns: Mapping[str, np.ndarray], times: int) -> dict[str, np.ndarray]:
    """Conditions repeated ``times`` times in the same order, with new run numbers."""
    count = len(next(iter(columns.values()))) * times
    return {"run": np.arange(1, count + 1), **{name: np.tile(column, times) for name, column in columns.items()}}


def programme(names: Sequence[str], rows: Sequence[Sequence[Any]]) -> dict[str, np.ndarray]:
    """Columns of conditions in run order, numbered."""
    return {
        "run": np.arange(1, len(rows) + 1),
        "sequence": progress(len(rows)),
        **{
            name: np.array(column, dtype=object if "surface" in name else float)
            for name, column in zip(names, zip(*rows))
        },
    }


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
        "kinematic_viscosity_mm2_s": [rounded(nu40, 5), rounded(max(nu100, 3.5), 5)],
        "pressure_viscosity_per_GPa": [rounded(spread * scale * nu**power, 5) for nu in (nu40, max(nu100, 3.5))],
        "density_15C_kg_m3": kind["density"],
        "density_change_per_K": kind["cubic"],
        "eyring_stress_MPa": rounded(rng.uniform(3.8, 7.0), 5),
        "thermal_conductivity_W_mK": rounded(rng.uniform(0.13, 0.15), 5),
        "specific_heat_J_kgK": rounded(rng.uniform(1900, 2200), 5),
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
            "m0_um2": rounded(height**2, 5),
            "m2": rounded(slope, 5),
            "m4_per_um2": rounded(nayak * slope**2 / height**2, 5),
        }
    if coated:
        layer = {
            "name": "DLC",
            "thickness_um": rounded(rng.uniform(2.0, 4.0), 2),
            "thermal_conductivity_W_mK": 2.0,
        }
        for name in names[: max(2, count // 2)]:
            table[name]["coating"] = layer
    return table


def draw_pairings(rng: np.random.Generator, names: list[str], count: int) -> list[tuple[str, str]]:
    every = list(itertools.combinations_with_replacement(names, 2))
    order = rng.permutation(len(every))
    return [every[i] for i in order[:count]]


def draw_levels(rng: np.random.Generator, span: tuple[float, float], count: int) -> list[float]:
    """Geometric levels with the ends moved by up to 15 %."""
    first, last = span[0] * rng.uniform(1.0, 1.15), span[1] * rng.uniform(0.85, 1.0)
    return [rounded(v, 2) for v in np.geomspace(first, last, count)]


def draw_temperatures(rng: np.random.Generator, count: int) -> list[float]:
    sets = {2: [[60.0, 90.0], [50.0, 80.0], [40.0, 100.0]], 3: [[40.0, 70.0, 100.0], [50.0, 80.0, 110.0]]}
    options = sets[count]
    return options[int(rng.integers(len(options)))]
