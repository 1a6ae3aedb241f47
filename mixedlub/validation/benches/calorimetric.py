"""Back-to-back gear rig with a separate oil for the test gears, known friction and known idle loss."""

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


@dataclass(frozen=True)
class Lines:
    """Contact lines of a mesh, mm: base radius of the pinion, line of action, places by phase of a base pitch.

    ``lean``: cosine of the base helix angle.
    """

    base: float
    length: float
    lean: float
    places: list[list[float]]


def lines_of(gear: Gear, phases: int, slices: int) -> Lines:
    """Contact lines at even phases of a base pitch, each as the places of slices of the face."""
    beta = math.radians(gear.helix_angle)
    alpha = math.atan(math.tan(math.radians(gear.pressure_angle)) / math.cos(beta))
    base = [gear.module / math.cos(beta) * z / 2.0 * math.cos(alpha) for z in gear.teeth]
    length = math.sqrt(gear.centre_distance**2 - (base[0] + base[1]) ** 2)
    tip = [d / 2.0 for d in gear.tip_diameter]
    start = length - math.sqrt(tip[1] ** 2 - base[1] ** 2)
    end = math.sqrt(tip[0] ** 2 - base[0] ** 2)
    pitch = 2.0 * math.pi * base[0] / gear.teeth[0]
    slope = math.tan(beta) * math.cos(alpha)
    found: list[list[float]] = []
    for phase in range(phases):
        found.append([])
        for slice_ in range(slices):
            x = start - gear.face_width * slope - pitch + (phase + 0.5) / phases * pitch
            x += (slice_ + 0.5) / slices * gear.face_width * slope
            while x < end:
                x += pitch
                if start < x < end:
                    found[-1].append(x)
    return Lines(base[0], length, math.cos(math.atan(slope)), found)


def sliding_of_mesh(gear: Gear, phases: int = 400, slices: int = 60) -> float:
    """Mean sliding speed over base-circle speed in one base pitch, at constant load per length of contact line."""
    mesh, ratio = lines_of(gear, phases, slices), gear.teeth[1] / gear.teeth[0]
    slid = (sum(abs(x - (mesh.length - x) / ratio) for x in places) / len(places) for places in mesh.places)
    return sum(slid) / mesh.base / phases / mesh.lean


@dataclass(frozen=True)
class Errors:
    """Standard deviations of the meters and of the assumptions of the evaluation; relative except for kelvin."""

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
    """Conditions of the test programme, and the laws of its gears."""

    torques: tuple[float, ...] = (240.0, 480.0, 720.0, 960.0, 1160.0, 1357.0)
    speeds: tuple[float, ...] = (20.0, 40.0, 60.0, 80.0, 95.0)
    surfaces: tuple[tuple[str, float], ...] = (("ground", 1.0), ("superfinished", 0.7))
    flow: float = 12.0
    inlet: float = 100.0
    shaft_share: float = 0.065
    sliding: float = 0.2
    errors: Errors = field(default_factory=Errors)


@dataclass(frozen=True)
class Calorimeter:
    """Meters of a rig with errors that are constant over all readings."""

    flow_gain: float
    torque_gain: float
    density_gain: float
    heat_gain: float
    rise_zero: float
    share: float

    @classmethod
    def drawn(cls, errors: Errors, share: float, random: np.random.Generator) -> Calorimeter:
        """Meters with errors drawn at random."""
        flow, torque = 1.0 + errors.flow * random.normal(), 1.0 + errors.torque * random.normal()
        density, heat = 1.0 + errors.density * random.normal(), 1.0 + errors.specific_heat * random.normal()
        zero = errors.rise * random.normal()
        return cls(flow, torque, density, heat, zero, share + errors.shaft_share * random.normal())

    def heat(
        self, loss: float, flow: float, inlet: float, errors: Errors, random: np.random.Generator
    ) -> tuple[float, float, float]:
        """Flow (L/min), inlet and outlet temperature as read at a gear loss ``loss`` (W)."""
        flow *= 1.0 + 0.01 * random.normal()
        # An ester at the inlet: 1000 kg/m3 at 15 degrees, less 0.07 % a kelvin.
        density = 1000.0 * (1.0 - 7e-4 * (inlet - 15.0)) * self.density_gain
        rise = loss / (1.0 - self.share) / (density * 2000.0 * self.heat_gain * flow / 60e3)
        noisy = rise + self.rise_zero + errors.rise_noise * random.normal()
        return flow * self.flow_gain * (1.0 + errors.flow_noise * random.normal()), inlet, inlet + noisy


READ = ("run", "torque_Nm", "speed_rpm", "oil_flow_L_min", "oil_inlet_temperature_C", "oil_outlet_temperature_C")


def recorded(bench: Bench, gear: Gear, seed: int) -> tuple[Columns, list[dict[str, float]]]:
    """Readings of the programme, with the true loss, idle loss and mean friction of each."""
    random, e = np.random.default_rng(seed), bench.errors
    meters = Calorimeter.drawn(e, bench.shaft_share, random)
    sliding = bench.sliding * (1.0 + e.loss_factor * random.normal())
    radius = gear.centre_distance * gear.teeth[0] / sum(gear.teeth) * 1e-3
    columns: Columns = {name: [] for name in (*READ, "pinion_surface", "gear_surface")}
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
                heat = meters.heat(loss, bench.flow, bench.inlet, e, random)
                read = (float(run), torque / meters.torque_gain, omega * 30.0 / math.pi, *heat)
                for name, value in zip(columns, (*read, surface, surface), strict=True):
                    columns[name].append(value)
                truths.append({"loss": loss, "idle": idle, "friction": friction, "speed": speed})
    return columns, truths
