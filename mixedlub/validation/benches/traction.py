"""Traction machine: two crowned discs over a plan of loads, speeds, slide-to-roll ratios and temperatures.

Friction follows a law of powers and logarithms with scatter between readings. Sliding occurs in both directions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Any

import numpy as np

Columns = dict[str, list[Any]]
RADII, ACROSS = (25.4, 38.1), (76.2, 76.2)
MODULUS, POISSON = 206e9, 0.3
OIL = {40.0: 34.0, 100.0: 7.2}
"""Kinematic viscosity of the oil, mm2/s by temperature; 850 kg/m3 at 15 degrees, 0.07 % less a kelvin."""
LAW = {"": -3.3, "p": 0.6, "s": 0.12, "u": -0.25, "v": -0.10, "ss": -0.06, "ps": 0.08}
"""Coefficients by the letters of their term: pressure, sliding, speed, viscosity."""


@dataclass(frozen=True)
class Bench:
    """Levels of the plan, scatter of log friction, and the increase of log friction if the first disc is faster."""

    loads: tuple[float, ...] = (60.0, 180.0, 600.0)
    speeds: tuple[float, ...] = (1.0, 3.0, 9.0)
    ratios: tuple[float, ...] = (0.03, 0.12, 0.5)
    temperatures: tuple[float, ...] = (40.0, 70.0, 100.0)
    scatter: float = 0.03
    first_faster: float = 0.0
    law: Mapping[str, float] = field(default_factory=lambda: dict(LAW))


def hertz_pressure(load: float) -> float:
    """Maximum Hertz pressure (GPa) of the two crowned discs from the elliptical contact."""
    along, across = (1.0 / (1.0 / a + 1.0 / b) * 1e-3 for a, b in (RADII, ACROSS))
    ratio = 1.0
    low, high = 1.0, 20.0
    # The ratio of the axes follows from that of the curvatures; integrals by the arithmetic-geometric mean.
    while high - low > 1e-12 * high:
        ratio = 0.5 * (low + high)
        first, second = _integrals(ratio)
        if (second * ratio**2 - first) / (first - second) > across / along:
            high = ratio
        else:
            low = ratio
    second = _integrals(ratio)[1]
    reduced = 1.0 / (2.0 * (1.0 - POISSON**2) / MODULUS)
    size = (3.0 * ratio**2 * second * load / (math.pi * reduced * (1.0 / along + 1.0 / across))) ** (1 / 3)
    return 1.5 * load / (math.pi * size * size / ratio) * 1e-9


def _integrals(ratio: float) -> tuple[float, float]:
    """Complete elliptic integrals of the first and second kind of an ellipse with axis ratio ``ratio``."""
    eccentricity = 1.0 - ratio**-2
    a, b, c = 1.0, math.sqrt(1.0 - eccentricity), math.sqrt(eccentricity)
    total, weight = 0.5 * c * c, 0.5
    while c > 1e-16:
        a, b, c = 0.5 * (a + b), math.sqrt(a * b), 0.5 * (a - b)
        weight *= 2.0
        total += weight * c * c
    first = math.pi / (2.0 * a)
    return first, first * (1.0 - total)


def friction(bench: Bench, pressure: float, ratio: float, speed: float, viscosity: float) -> float:
    """Friction coefficient without scatter: pressure in GPa, speed in m/s, viscosity in mPa s."""
    logs = {
        "p": math.log(pressure),
        "s": math.log(abs(ratio) / 0.1),
        "u": math.log(speed / 5.0),
        "v": math.log(viscosity / 10.0),
    }
    own = sum(c * math.prod(logs[letter] for letter in term) for term, c in bench.law.items())
    return math.exp(own + (bench.first_faster if ratio > 0.0 else 0.0))


def viscosity(temperature: float) -> float:
    """Dynamic viscosity (mPa s): double log of kinematic viscosity linear in log temperature (K)."""
    (cold, thick), (warm, thin) = OIL.items()
    high, low = (math.log(math.log(nu + 0.7)) for nu in (thick, thin))
    start, end, place = (math.log(t + 273.15) for t in (cold, warm, temperature))
    kinematic = math.exp(math.exp(high + (low - high) * (place - start) / (end - start))) - 0.7
    return kinematic * 0.850 * (1.0 - 7e-4 * (temperature - 15.0))


def recorded(bench: Bench, seed: int) -> Columns:
    """Readings of the plan."""
    random = np.random.default_rng(seed)
    names = ("run", "load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C", "friction_coefficient")
    found: Columns = {name: [] for name in names}
    plan = product(bench.loads, bench.speeds, bench.ratios, (1.0, -1.0), bench.temperatures)
    for run, (load, speed, size, sign, temperature) in enumerate(plan, start=1):
        ratio = sign * size
        value = friction(bench, hertz_pressure(load), ratio, speed, viscosity(temperature))
        value *= math.exp(bench.scatter * random.standard_normal())
        for name, cell in zip(names, (run, load, speed, ratio, temperature, value), strict=True):
            found[name].append(cell)
    return found
