"""Gear rig with strain gauges in the root fillets of two successive teeth, calibrated with known forces.

Each tooth is a beam of constant section: bending and compression strain its two fillets and, in part, the fillets of
its neighbour. Lengths in mm, forces in N, strains in millionths, angles in degrees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Columns = dict[str, list[Any]]
GAUGES = ("compressive_1_um_m", "tensile_1_um_m", "compressive_2_um_m", "tensile_2_um_m")


@dataclass(frozen=True)
class Tooth:
    """Unit-ratio gears of the NASA gear noise rig, with each tooth as a beam."""

    teeth: int = 28
    module: float = 3.175
    face_width: float = 6.35
    root_thickness: float = 6.2
    root_radius: float = 41.0
    modulus: float = 206e3
    neighbour: float = -0.07

    @property
    def base_radius(self) -> float:
        return self.module * self.teeth / 2.0 * math.cos(math.radians(20.0))

    @property
    def path(self) -> tuple[float, float, float]:
        """Roll angles of start of contact, pitch point and end of contact."""
        tip = self.module * (self.teeth / 2.0 + 1.0)
        end = math.degrees(math.sqrt(tip**2 / self.base_radius**2 - 1.0))
        pitch = math.degrees(math.tan(math.radians(20.0)))
        return 2.0 * pitch - end, pitch, end

    @property
    def pitch_angle(self) -> float:
        return 360.0 / self.teeth

    def strains(self, roll: float, normal: float, friction: float) -> tuple[float, float]:
        """Strains of the compressive and the tensile fillet of the loaded tooth; friction positive towards the tip."""
        theta = math.radians(roll)
        radius = self.base_radius * math.hypot(1.0, theta)
        flank = math.atan(theta)
        half = math.pi / (2.0 * self.teeth) + math.tan(math.radians(20.0)) - math.radians(20.0) - (theta - flank)
        lean = flank - half
        arm, offset = radius * math.cos(half) - self.root_radius, radius * math.sin(half)
        along = normal * math.cos(lean) + friction * math.sin(lean)
        down = normal * math.sin(lean) - friction * math.cos(lean)
        moment = along * arm - down * offset
        bending = 6.0 * moment / (self.face_width * self.root_thickness**2 * self.modulus)
        compression = down / (self.face_width * self.root_thickness * self.modulus)
        return 1e6 * (-bending - compression), 1e6 * (bending - compression)

    def gauges(self, loads: list[tuple[int, float, float, float]]) -> np.ndarray:
        """Strains of the four gauges under loads (tooth, roll angle, normal force, friction force)."""
        found = np.zeros(4)
        for tooth, roll, normal, friction in loads:
            own = np.array(self.strains(roll, normal, friction))
            for gauged in (1, 2):
                away = abs(gauged - tooth)
                found[2 * gauged - 2 : 2 * gauged] += own * self.neighbour**away if away < 3 else 0.0
        return found


@dataclass(frozen=True)
class Errors:
    """Standard deviations of the meters, of an asynchronous vibration, and of friction between two sides."""

    calibration_strain: float = 0.5
    calibration_force: float = 0.005
    strain: float = 5.0
    zero: float = 3.0
    roll_angle: float = 0.05
    asymmetry: float = 0.002
    vibration: float = 2.0


@dataclass(frozen=True)
class Bench:
    """Torque (N m), turns recorded, samples a turn, and the friction of the mesh.

    ``step``: friction of constant magnitude up to the pitch point, where its direction changes.
    """

    torque: float = 71.7
    turns: int = 40
    samples: int = 500
    friction: float = 0.045
    step: bool = False
    errors: Errors = field(default_factory=Errors)


def calibration(bench: Bench, tooth: Tooth, random: np.random.Generator) -> Columns:
    """Calibration table: each tooth loaded alone every 2 degrees and at the pitch point, without and with friction."""
    columns: Columns = {n: [] for n in ("tooth", "roll_angle_deg", "normal_force_N", "friction_force_N", *GAUGES)}
    full = 71.7e3 / tooth.base_radius
    normal_gain, friction_gain = 1.0 + bench.errors.calibration_force * random.standard_normal(2)
    loads = [(share * full, 0.0) for share in (0.0, 0.57, 0.85, 1.13)]
    loads += [(1.13 * full, 100.0), (1.13 * full, 190.0)]
    for number in (1, 2):
        for roll in sorted([*range(10, 33, 2), 21]):
            for normal, friction in loads:
                read = tooth.gauges([(number, float(roll), normal, friction)])
                read = read + bench.errors.calibration_strain * random.standard_normal(4)
                row = (number, float(roll), normal / normal_gain, friction / friction_gain, *read)
                for name, value in zip(columns, row, strict=True):
                    columns[name].append(value)
    return columns


def forces(bench: Bench, tooth: Tooth, roll: float, asymmetry: float) -> tuple[float, float, float]:
    """Normal force, friction force towards the tip and friction coefficient of a tooth of the driven gear.

    The driven gear rolls from its tip to its root: it slides towards the root until the pitch point.
    """
    start, pitch, end = tooth.path
    if not start < roll < end:
        return 0.0, 0.0, 0.0
    double = tooth.pitch_angle * ((end - start) / tooth.pitch_angle - 1.0)
    near = min(roll - start, end - roll)
    share = min(1.0, (1.0 + near / double) / 3.0) if near < double else 1.0
    normal = share * bench.torque * 1e3 / tooth.base_radius
    slide = (pitch - roll) / (end - pitch)
    rise = 1.0 if bench.step else math.tanh(4.0 * abs(slide))
    local = bench.friction * rise * (1.0 - 0.25 * abs(slide))
    sense = 1.0 if slide >= 0.0 else -1.0
    local += sense * asymmetry
    return normal, sense * local * normal, local


def recorded(bench: Bench, tooth: Tooth, seed: int) -> tuple[Columns, Columns, dict[float, tuple[float, float]]]:
    """Calibration, recording, and by roll angle the true normal force and friction coefficient."""
    random, e = np.random.default_rng(seed), bench.errors
    calibrated = calibration(bench, tooth, random)
    zero = e.zero * random.standard_normal(4)
    shift = e.roll_angle * random.standard_normal()
    asymmetry = e.asymmetry * random.standard_normal()
    start, _, end = tooth.path
    first = end + 0.5
    columns: Columns = {name: [] for name in ("revolution", "shaft_angle_deg", *GAUGES)}
    for turn in range(1, bench.turns + 1):
        phase, beat = random.random(), 2.0 * math.pi * random.random()
        for number in range(int(bench.samples * (first + tooth.pitch_angle - start + 2.0) / 360.0)):
            angle = (number + phase) * 360.0 / bench.samples
            roll = first - angle + shift
            loads = []
            for other in (-1, 0, 1, 2, 3, 4):
                own = roll + (other - 1) * tooth.pitch_angle
                normal, friction, _ = forces(bench, tooth, own, asymmetry)
                loads.append((other, own, normal, friction))
            read = tooth.gauges([one for one in loads if one[2]]) + zero + e.strain * random.standard_normal(4)
            read += e.vibration * math.sqrt(2.0) * math.sin(beat + 7.3 * math.radians(angle))
            for name, value in zip(columns, (turn, angle, *read), strict=True):
                columns[name].append(value)
    truth = {}
    for step in range(200, 3300):
        normal, _, local = forces(bench, tooth, step / 100.0, asymmetry)
        truth[step / 100.0] = normal, local
    return calibrated, columns, truth
