"""How long the elastic load distribution takes, and how far the mesh is from its limit.

One line a figure: name, figure, unit, ratio to its reference. Run: python benchmarks/gear.py
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np

from mixedlub.gear import GearPair, LdpSharing, RigidSharing, mesh, transmission_error
from mixedlub.gear.distribution import distribute

HONG = GearPair((17, 26), 25.4e-3 / 6, math.radians(22.5), 14e-3)
SHARING = LdpSharing(tip_relief=(15e-6, 15e-6), relief_length=(2e-3, 2e-3), lead_crown=3e-6, misalignment=10e-6)
TORQUES = np.array([50.0, 100.0, 150.0])
TARGET_S = 0.2


def best_of(action: Callable[[], object], repeats: int = 5) -> float:
    """Shortest wall time of several runs, s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


def one_at_a_time() -> None:
    """The same 120 contact problems in a plain loop over torques and phases."""
    phases = HONG.path_start + HONG.base_pitch * (np.arange(40) + 0.5) / 40
    for torque in TORQUES:
        for phase in phases:
            distribute(HONG, SHARING, np.array([torque]), np.array([phase]), 11)


def loss_factor(points: int, slices: int) -> float:
    """Load-weighted mean sliding of the benchmark gear at 100 Nm."""
    contact = mesh(HONG, SHARING, points=points, slices=slices)
    carried = contact.weight * contact.load_share(100.0) * np.abs(contact.sliding_per_speed)
    return float(carried.sum()) / HONG.base_radius[0]


def lines() -> list[str]:
    """All figures, one line each."""
    cold = best_of(lambda: transmission_error(HONG, SHARING, TORQUES), 1)
    warm = best_of(lambda: transmission_error(HONG, SHARING, TORQUES))
    loop = best_of(one_at_a_time, 1)
    rigid = best_of(lambda: mesh(HONG, RigidSharing()).load_share(TORQUES))
    default, fine = loss_factor(48, 11), loss_factor(480, 33)
    return [
        f"load distribution, 3 torques x 40 phases x 11 slices, first call: {cold * 1e3:.1f} ms"
        f" ({cold / TARGET_S:.2f} of the 200 ms allowed)",
        f"the same, again: {warm * 1e3:.1f} ms ({loop / warm:.1f} times faster than one problem at a time)",
        f"rigid mesh: {rigid * 1e3:.2f} ms ({rigid / warm:.3f} of the elastic one)",
        f"loss factor, default mesh: {default:.6f} - ({default / fine - 1:+.1e} of a 10x finer one)",
    ]


if __name__ == "__main__":
    print("\n".join(lines()))
