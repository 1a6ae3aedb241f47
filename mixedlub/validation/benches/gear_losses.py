"""Load-dependent losses of helical gears under a local friction law, summed over contact lines and mesh positions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from mixedlub.validation.benches.calorimetric import READ, Calorimeter, Columns, Errors, Gear, lines_of

LAW = {"c1": 0.045, "c2": -0.22, "c3": 1e-4, "c4": 0.0, "c5": 0.003, "c6": 1.0, "c7": 0.25, "c8": 0.1, "c9": 0.02}
VISCOSITY = {80.0: 7.4, 120.0: 3.7}
"""mm2/s by temperature."""
ROUGHNESS = {"ground": 0.4 * math.sqrt(2.0 / math.pi), "superfinished": 0.1 * math.sqrt(2.0 / math.pi)}
"""Ra (um) of normal heights with an Rq of 0.4 and 0.1 um."""
MODULUS = 206e9 / 0.91


@dataclass(frozen=True)
class Bench:
    """Conditions, law, factor of superfinished flanks, relative scatter; ``steps`` of the mesh cycle and the face."""

    torques: tuple[float, ...] = (300.0, 700.0, 1350.0)
    speeds: tuple[float, ...] = (20.0, 45.0, 95.0)
    scatter: float = 0.03
    steps: tuple[int, int] = (40, 30)
    finished: float = 0.85
    law: Mapping[str, float] = field(default_factory=lambda: dict(LAW))


def local_friction(
    law: Mapping[str, float], speed_sum: float, pressure: float, nu: float, ra: float, ratio: float, radius: float
) -> float:
    """Local friction coefficient: m/s, N/mm2, mm2/s, um, -, mm."""
    film = law["c4"] * nu * nu + law["c5"] * nu + law["c6"]
    slip = ratio / ((ratio + law["c8"]) ** 2 + law["c9"])
    load = math.exp(law["c3"] * pressure)
    return law["c1"] * speed_sum ** law["c2"] * load * film * ra ** law["c7"] * slip * radius**0.2


def mesh_loss(
    gear: Gear, law: Mapping[str, float], torque: float, omega: float, nu: float, ra: float, steps: tuple[int, int]
) -> float:
    """Mean friction power (W) over a mesh cycle, load per contact length constant; ``steps``: of cycle and face."""
    mesh, ratio = lines_of(gear, *steps), gear.teeth[1] / gear.teeth[0]
    length, lean, width = mesh.length * 1e-3, mesh.lean, gear.face_width * 1e-3
    total = 0.0
    for places in mesh.places:
        force = torque / (mesh.base * 1e-3) / lean / len(places)
        line = force * lean / (width / steps[1])
        for x in (place * 1e-3 for place in places):
            other = length - x
            radius = x * other / length / lean
            pressure = math.sqrt(line * MODULUS / (2.0 * math.pi * radius)) * 1e-6
            both = (x + other / ratio) * omega
            slip = abs(x - other / ratio) * omega
            friction = local_friction(law, both, pressure, nu, ra, 2.0 * slip / both, radius * 1e3)
            total += friction * slip * force / steps[0]
    return total


def recorded(bench: Bench, gear: Gear, seed: int) -> Columns:
    """Losses of the programme with their scatter."""
    random = np.random.default_rng(seed)
    names = ("run", "torque_Nm", "speed_rpm", "oil_temperature_C", "load_dependent_loss_W")
    found: Columns = {name: [] for name in (*names, "pinion_surface", "gear_surface")}
    radius = gear.centre_distance * gear.teeth[0] / sum(gear.teeth) * 1e-3
    for surface, factor in (("ground", 1.0), ("superfinished", bench.finished)):
        for temperature, nu in VISCOSITY.items():
            for speed in bench.speeds:
                for torque in bench.torques:
                    omega = speed / radius
                    loss = factor * mesh_loss(gear, bench.law, torque, omega, nu, ROUGHNESS[surface], bench.steps)
                    loss *= 1.0 + bench.scatter * random.standard_normal()
                    row = (len(found["run"]) + 1, torque, omega * 30.0 / math.pi, temperature, loss)
                    for name, cell in zip(found, (*row, surface, surface), strict=True):
                        found[name].append(cell)
    return found


def calorimeter(exact: Columns, errors: Errors, seed: int, *, flow: float = 12.0, share: float = 0.065) -> Columns:
    """Calorimeter readings of exact losses plus the idle loss of each speed, with the errors of the meters."""
    random = np.random.default_rng(seed)
    meters = Calorimeter.drawn(errors, share, random)
    sliding = 1.0 + errors.loss_factor * random.normal()
    found: Columns = {name: [] for name in READ}
    rows = zip(
        *(exact[n] for n in ("torque_Nm", "speed_rpm", "oil_temperature_C", "load_dependent_loss_W")), strict=True
    )
    for run, (torque, speed, inlet, loss) in enumerate(rows, start=1):
        idle = 60.0 * (speed / 2000.0) ** 2.2
        heat = meters.heat(idle + sliding * loss, flow, inlet, errors, random)
        for name, value in zip(READ, (run, torque / meters.torque_gain, speed, *heat), strict=True):
            found[name].append(value)
    return {**found, **{name: exact[name] for name in ("pinion_surface", "gear_surface")}}
