"""Two crowned discs driven separately, with a torque meter on the first: sweeps of single conditions."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Columns = dict[str, list[Any]]
RADII = (25.4, 38.1)
BASE = {"load": 298.0, "speed": 2.48, "ratio": 1.08, "temperature": 33.0}
"""Reference condition of the sweeps; N, m/s, -, degrees."""
SWEPT: dict[str, tuple[float, ...]] = {
    "load": (49.0, 120.0, 200.0, 298.0, 450.0, 600.0),
    "speed": (0.3, 0.8, 1.6, 2.48, 3.2, 3.8),
    "ratio": (0.02, 0.05, 0.1, 0.3, 0.6, 1.08, 1.2),
    "temperature": (33.0, 43.0, 53.0, 63.0, 73.0),
}


@dataclass(frozen=True)
class Errors:
    """Standard deviations: torque relative, zero and noise (N m), load relative and zero (N)."""

    torque: float = 0.005
    torque_zero: float = 0.01
    torque_noise: float = 0.02
    load: float = 0.005
    load_zero: float = 0.5


@dataclass(frozen=True)
class Bench:
    """Oils by their friction factor, bearing torque (N m), one or both directions of sliding."""

    oils: tuple[tuple[str, float], ...] = (("ground", 1.0),)
    bearings: float = 0.0
    both_signs: bool = False
    speed_exponent: float = -0.15
    load_exponent: float = 0.10
    errors: Errors = field(default_factory=Errors)

    def friction(self, load: float, speed: float, ratio: float, temperature: float) -> float:
        """Friction coefficient against the sliding."""
        rise = math.tanh(abs(ratio) / 0.04) * (1.0 - 0.12 * abs(ratio))
        own = (speed / 2.48) ** self.speed_exponent * (load / 298.0) ** self.load_exponent
        return 0.06 * rise * own * (1.0 + 0.001 * (temperature - 33.0))


def recorded(bench: Bench, seed: int) -> tuple[Columns, list[float]]:
    """Readings, and the true friction coefficient of each."""
    random, e = np.random.default_rng(seed), bench.errors
    torque_gain, load_gain = 1.0 + e.torque * random.standard_normal(), 1.0 + e.load * random.standard_normal()
    torque_zero, load_zero = e.torque_zero * random.standard_normal(), e.load_zero * random.standard_normal()
    names = ("run", "load_N", "speed_1_rpm", "speed_2_rpm", "oil_temperature_C", "friction_torque_Nm")
    columns: Columns = {name: [] for name in (*names, "surface_1", "surface_2")}
    truth: list[float] = []
    for surface, factor in bench.oils:
        for name, values in SWEPT.items():
            for value in values:
                for sign in (1.0, -1.0) if bench.both_signs else (1.0,):
                    at = {**BASE, name: value}
                    friction = factor * bench.friction(**at)
                    first = at["speed"] * (1.0 + sign * at["ratio"] / 2.0)
                    second = at["speed"] * (1.0 - sign * at["ratio"] / 2.0)
                    torque = sign * friction * at["load"] * RADII[0] * 1e-3 + bench.bearings * (1.0 + at["speed"] / 5.0)
                    read = (
                        *(float(len(truth) + 1), at["load"] * load_gain + load_zero),
                        *(s / r * 1e3 * 30.0 / math.pi for s, r in zip((first, second), RADII, strict=True)),
                        *(
                            at["temperature"],
                            torque * torque_gain + torque_zero + e.torque_noise * random.standard_normal(),
                        ),
                    )
                    for column, cell in zip(names, read, strict=True):
                        columns[column].append(cell)
                    columns["surface_1"].append(surface)
                    columns["surface_2"].append(surface)
                    truth.append(friction)
    return columns, truth
