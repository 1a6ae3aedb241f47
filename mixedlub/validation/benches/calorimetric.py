"""A back-to-back gear rig whose test gears lose their heat to a separate oil, with known friction and idle loss."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Columns = dict[str, list[Any]]


@dataclass(frozen=True)
class Gear:
    """A gear pair of rigid teeth, mm and degrees."""

    teeth: tuple[int, int] = (30, 42)
    module: float = 5.625
    pressure_angle: float = 20.0
    helix_angle: float = 5.0
    tip_diameter: tuple[float, float] = (187.04, 248.17)
    centre_distance: float = 203.33
    face_width: float = 14.0


def sliding_of_mesh(gear: Gear, phases: int = 400, slices: int = 60) -> float:
    """Mean of the sliding speed over the speed of the base circle, weighted with load, that one base pitch sees.

    The load is the same per length of contact line everywhere: counted line by line for each position of the mesh.
    """
    beta = math.radians(gear.helix_angle)
    alpha = math.atan(math.tan(math.radians(gear.pressure_angle)) / math.cos(beta))
    base = [gear.module / math.cos(beta) * z / 2.0 * math.cos(alpha) for z in gear.teeth]
    working = math.acos((base[0] + base[1]) / gear.centre_distance)
    length = gear.centre_distance * math.sin(working)
    tip = [d / 2.0 for d in gear.tip_diameter]
    start = length - math.sqrt(tip[1] ** 2 - base[1] ** 2)
    end = math.sqrt(tip[0] ** 2 - base[0] ** 2)
    pitch = 2.0 * math.pi * base[0] / gear.teeth[0]
    slope = math.tan(beta) * math.cos(alpha)
    ratio = gear.teeth[1] / gear.teeth[0]
    total = 0.0
    for phase in range(phases):
        touching = 0
        sliding = 0.0
        for slice_ in range(slices):
            x = start - gear.face_width * slope - pitch + (phase + 0.5) / phases * pitch
            x += (slice_ + 0.5) / slices * gear.face_width * slope
            while x < end:
                x += pitch
                if start < x < end:
                    touching += 1
                    sliding += abs(x - (length - x) / ratio) / base[0]
        total += sliding / touching / phases
    return total / math.cos(math.atan(slope))


@dataclass(frozen=True)
class Errors:
    """Standard deviations of the meters, relative but for kelvin, and of what the evaluation must assume."""

    flow: float = 0.005
    flow_noise: float = 0.002
    rise: float = 0.1
    rise_noise: float = 0.05
    density: float = 0.002
    specific_heat: float = 0.01
    torque: float = 0.002
    shaft_share: float = 0.01
    load_exponent: float = 0.03
    loss_factor: float = 0.02


@dataclass(frozen=True)
class Bench:
    """Conditions of the test programme, and the laws that its gears obey."""

    torques: tuple[float, ...] = (240.0, 480.0, 720.0, 960.0, 1160.0, 1357.0)
    speeds: tuple[float, ...] = (20.0, 40.0, 60.0, 80.0, 95.0)
    surfaces: tuple[tuple[str, float], ...] = (("ground", 1.0), ("superfinished", 0.7))
    flow: float = 12.0
    inlet: float = 100.0
    shaft_share: float = 0.065
    sliding: float = 0.2
    errors: Errors = field(default_factory=Errors)


def recorded(bench: Bench, gear: Gear, seed: int) -> tuple[Columns, list[dict[str, float]]]:
    """Readings of the programme, and for each the loss, idle loss and mean friction behind it."""
    random, e = np.random.default_rng(seed), bench.errors
    flow_gain, torque_gain = 1.0 + e.flow * random.normal(), 1.0 + e.torque * random.normal()
    density_gain, heat_gain = 1.0 + e.density * random.normal(), 1.0 + e.specific_heat * random.normal()
    rise_zero = e.rise * random.normal()
    share = bench.shaft_share + e.shaft_share * random.normal()
    sliding = bench.sliding * (1.0 + e.loss_factor * random.normal())
    radius = gear.centre_distance * gear.teeth[0] / sum(gear.teeth) * 1e-3
    names = ("run", "torque_Nm", "speed_rpm", "oil_flow_L_min", "oil_inlet_temperature_C", "oil_outlet_temperature_C")
    columns: Columns = {name: [] for name in (*names, "pinion_surface", "gear_surface")}
    truths = []
    run = 0
    for surface, factor in bench.surfaces:
        for speed in bench.speeds:
            exponent = e.load_exponent * random.normal()
            for torque in bench.torques:
                run += 1
                omega = speed / radius
                friction = 0.030 * factor * (speed / 20.0) ** -0.21 * (torque / 700.0) ** exponent
                idle = 60.0 * (speed / 20.0) ** 2.2
                loss = idle + friction * sliding * torque * omega
                flow = bench.flow * (1.0 + 0.01 * random.normal())
                # An ester at the inlet: 1000 kg/m3 at 15 degrees, less 0.07 % a kelvin.
                density = 1000.0 * (1.0 - 7e-4 * (bench.inlet - 15.0)) * density_gain
                rise = loss / (1.0 - share) / (density * 2000.0 * heat_gain * flow / 60e3)
                noisy = rise + rise_zero + e.rise_noise * random.normal()
                read = (
                    *(float(run), torque / torque_gain, omega * 30.0 / math.pi),
                    *(flow * flow_gain * (1.0 + e.flow_noise * random.normal()), bench.inlet, bench.inlet + noisy),
                )
                for name, value in zip(names, read, strict=True):
                    columns[name].append(value)
                for name in ("pinion_surface", "gear_surface"):
                    columns[name].append(surface)
                truths.append({"loss": loss, "idle": idle, "friction": friction, "speed": speed})
    return columns, truths
