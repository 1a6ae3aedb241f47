"""Slow gear rig with off-line-of-action probes: mesh friction moves a shaft on springy bearings.

The friction force is summed over the pairs in contact and passed to the shaft through the response of one mode, by
harmonics of the mesh far beyond those used in an evaluation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Columns = dict[str, list[Any]]
TEETH = 28
BASE_RADIUS = 3.175 * TEETH / 2.0 * math.cos(math.radians(20.0))


@dataclass(frozen=True)
class Errors:
    """Standard deviations of probe (um), response, zero (um) and normal force; run-out (um)."""

    displacement: float = 0.05
    response: float = 0.03
    response_noise: float = 0.02
    zero: float = 0.1
    run_out: float = 2.0
    normal_force: float = 0.02


@dataclass(frozen=True)
class Bench:
    """Torque (N m) and speed (rpm) on the pinion, stiffness (N/um), resonance (Hz), turns, samples a mesh cycle."""

    torque: float = 135.6
    speed: float = 200.0
    stiffness: float = 90.0
    resonance: float = 1100.0
    damping: float = 0.06
    turns: int = 4
    samples: int = 56
    friction: float = 0.06
    coupling: float = 0.0002
    errors: Errors = field(default_factory=Errors)

    def response(self, frequency: np.ndarray) -> np.ndarray:
        """Displacement per force (um/N)."""
        ratio = frequency / self.resonance
        return 1.0 / self.stiffness / (1.0 - ratio**2 + 2.0j * self.damping * ratio)


def path() -> tuple[float, float, float]:
    """Roll angles (deg) of start of contact, pitch point and end of contact."""
    tip = 3.175 * (TEETH / 2.0 + 1.0)
    end = math.degrees(math.sqrt(tip**2 / BASE_RADIUS**2 - 1.0))
    pitch = math.degrees(math.tan(math.radians(20.0)))
    return 2.0 * pitch - end, pitch, end


def local_friction(bench: Bench, roll: float) -> float:
    """Friction coefficient of a pair, falling from the pitch point outwards."""
    start, pitch, _ = path()
    return bench.friction * (1.0 - 0.35 * abs(roll - pitch) / (pitch - start))


def friction_force(bench: Bench, roll: float, normal_gain: float) -> float:
    """Friction force summed over the pairs in contact (N), each with an equal share; positive in recess."""
    start, pitch, end = path()
    step = 360.0 / TEETH
    touching = [roll + k * step for k in (-2, -1, 0, 1, 2) if start < roll + k * step < end]
    share = bench.torque * 1e3 / BASE_RADIUS / len(touching) * normal_gain
    return sum(math.copysign(local_friction(bench, one) * share, one - pitch) for one in touching)


def recorded(bench: Bench, seed: int) -> tuple[dict[str, Columns], np.ndarray]:
    """Tables of static test, response and running gears; harmonics of the true force (N) of a mesh cycle."""
    random, e = np.random.default_rng(seed), bench.errors
    fine = 1792
    step = 360.0 / TEETH
    start = path()[0]
    gain = 1.0 + e.normal_force * random.standard_normal()
    force = np.array([friction_force(bench, start + (n + 0.5) / fine * step, gain) for n in range(fine)])
    # Samples lie at the middles of their steps.
    order = np.arange(fine // 2 + 1)
    harmonics = np.fft.rfft(force) / fine * np.exp(-2j * math.pi * order * 0.5 / fine)
    mesh_frequency = TEETH * bench.speed / 60.0
    displaced = harmonics * bench.response(order * mesh_frequency)
    kept = 200
    leak = bench.coupling * bench.torque * 1e3 / BASE_RADIUS
    zero = e.zero * random.standard_normal()
    running: Columns = {name: [] for name in ("revolution", "shaft_angle_deg", "off_line_displacement_um")}
    per_turn = bench.samples * TEETH
    phase = random.random()
    turned = (np.arange(bench.turns * per_turn + 2 * bench.samples) + phase) * 360.0 / per_turn
    wave = np.zeros(turned.size) + displaced[0].real
    for k in range(1, kept):
        wave += 2.0 * (displaced[k] * np.exp(2j * math.pi * k * turned / step)).real
    wave += leak + zero + e.run_out * np.sin(np.radians(turned) + 1.0)
    wave += e.displacement * random.standard_normal(turned.size)
    for angle, value in zip(turned, wave, strict=True):
        running["revolution"].append(1 + int(angle // 360.0))
        running["shaft_angle_deg"].append(angle % 360.0)
        running["off_line_displacement_um"].append(value)
    scale = 1.0 + e.response * random.standard_normal()
    frequency = np.arange(129) * mesh_frequency / 8.0
    noise = random.standard_normal(frequency.size) + 1j * random.standard_normal(frequency.size)
    measured = bench.response(frequency) * scale * (1.0 + e.response_noise * noise)
    response: Columns = {
        "frequency_Hz": frequency.tolist(),
        "real_um_N": measured.real.tolist(),
        "imaginary_um_N": measured.imag.tolist(),
    }
    static: Columns = {name: [] for name in ("direction", "line_force_N", "off_line_displacement_um")}
    for direction, sign in (("driving", 1.0), ("driven", -1.0)):
        for load in np.linspace(500.0, 4500.0, 9):
            static["direction"].append(direction)
            static["line_force_N"].append(load)
            value = bench.coupling * load + sign * 0.02 * load / bench.stiffness
            static["off_line_displacement_um"].append(value + 0.02 * random.standard_normal())
    return {"static.csv": static, "response.csv": response, "recording.csv": running}, harmonics
