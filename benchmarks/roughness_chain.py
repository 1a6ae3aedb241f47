"""How long a profile takes to become roughness parameters, spectrum, moments and asperities.

One line a figure: name, figure, unit, ratio to its reference. Run: python benchmarks/roughness_chain.py
"""

from __future__ import annotations

import importlib.util
import resource
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

from profiles import Profile
from roughness import (
    height_parameters,
    mccool_asperities,
    moments,
    normal_probability,
    power_density,
    roughness_profile,
)

SPACING = 0.5e-6
CUTOFF = 0.8e-3
GOAL = 30.0
MEMORY_LIMIT_MB = 2048.0


def trace(points: int) -> Profile:
    """Brownian-like heights with noise: neither filter nor parameters care what they are."""
    rng = np.random.default_rng(0)
    walk = np.cumsum(rng.normal(size=points)) * 1e-9
    return Profile(walk - np.linspace(walk[0], walk[-1], points) + 1e-9 * rng.normal(size=points), SPACING)


def whole_chain(profile: Profile) -> object:
    """Filter, all height parameters, spectrum, moments, McCool."""
    rough = roughness_profile(profile, cutoff=CUTOFF)
    return height_parameters(rough), power_density(rough), mccool_asperities(moments(rough))


def surfalize_chain(profile: Profile) -> Callable[[], object] | None:
    """surfalize's Gaussian filter and Ra, Rq, Rz; None where it is not installed."""
    if importlib.util.find_spec("surfalize") is None:
        return None
    from surfalize import Profile as Peer
    from surfalize.filter import GaussianFilter

    heights, step = np.array(profile.heights) * 1e6, SPACING * 1e6

    def run() -> object:
        peer = Peer(heights, step)
        rough = GaussianFilter(CUTOFF * 1e6, "highpass").apply(peer, inplace=False)
        return rough.Ra(), rough.Rq(), rough.Rz()

    return run


def scipy_chain(profile: Profile) -> object:
    """The same quantities written out with NumPy and SciPy, by the fastest calls there are for each."""
    from scipy.fft import rfft
    from scipy.signal import oaconvolve
    from scipy.signal.windows import hann

    z, dx = profile.heights, profile.spacing
    half = int(CUTOFF / dx)
    weights = np.exp(-np.pi * (np.arange(-half, half + 1) * dx / (0.4697186 * CUTOFF)) ** 2)
    rough = z - oaconvolve(z, weights / weights.sum(), "same")
    square = rough * rough
    heights = [
        (np.abs(part).mean(), s.mean(), part.max(), part.min(), (s * part).mean(), (s * s).mean())
        for part, s in zip(np.array_split(rough, 62), np.array_split(square, 62))
    ]
    slope = np.gradient(rough, dx)
    spectrum = np.abs(rfft((rough - rough.mean()) * hann(rough.size, sym=False))) ** 2
    m0, m2, m4 = square.mean(), np.diff(rough).var(), np.diff(rough, 2).var()
    return heights, slope.std(), spectrum, m4 / m2, np.sqrt(np.pi / m4), m0 * m4 / m2**2


def side_by_side(actions: dict[str, Callable[[], object]], rounds: int = 40) -> dict[str, float]:
    """Shortest wall time of each (ms), their runs interleaved so that a busy moment hits all alike.

    One large array freed beforehand lets the allocator keep its memory, as in any process that has worked for
    a while; else every figure but surfalize's is half page faults.
    """
    np.ones(4_000_000).sum()
    times: dict[str, list[float]] = {name: [] for name in actions}
    for _ in range(rounds):
        for name, action in actions.items():
            start = time.perf_counter()
            action()
            times[name].append(1e3 * (time.perf_counter() - start))
    return {name: min(values) for name, values in times.items()}


def long_trace() -> None:
    """Ten million points, in a process of its own so that the peak is its own."""
    profile = trace(10_000_000)
    start = time.perf_counter()
    whole_chain(profile)
    took = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    report("1e7 points, whole chain", took, "s", 1.0 / took, "million points per 100 ms")
    report("1e7 points, peak memory", peak, "MB", peak / MEMORY_LIMIT_MB, "the limit")


def report(name: str, figure: float, unit: str, ratio: float, reference: str) -> None:
    print(f"{name:42s} {figure:10.3f} {unit:4s} {ratio:8.2f} x {reference}", flush=True)


def main() -> None:
    profile = trace(100_000)
    rough = roughness_profile(profile, cutoff=CUTOFF)
    actions: dict[str, Callable[[], object]] = {
        "whole chain": lambda: whole_chain(profile),
        "plain SciPy": lambda: scipy_chain(profile),
        "filter": lambda: roughness_profile(profile, cutoff=CUTOFF),
        "height parameters": lambda: height_parameters(rough),
        "spectrum": lambda: power_density(rough),
        "moments and McCool": lambda: mccool_asperities(moments(rough)),
        "Gaussian verdict": lambda: normal_probability(rough),
    }
    peer = surfalize_chain(profile)
    if peer is not None:
        actions["surfalize"] = peer
    side_by_side(actions, rounds=2)
    took = side_by_side(actions)
    chain = took["whole chain"]
    if peer is not None:
        speed = took["surfalize"] / chain
        report("surfalize filter + Ra, Rq, Rz, 1e5 points", took["surfalize"], "ms", speed, "the whole chain")
        report("whole chain, 1e5 points", chain, "ms", speed, f"faster than surfalize (goal {GOAL:g})")
    report("same by plain SciPy", took["plain SciPy"], "ms", took["plain SciPy"] / chain, "the whole chain")
    for name in ("filter", "height parameters", "spectrum", "moments and McCool", "Gaussian verdict"):
        report(f"  {name}", took[name], "ms", took[name] / chain, "the whole chain")
    subprocess.run([sys.executable, __file__, "--long"], check=True)


if __name__ == "__main__":
    long_trace() if "--long" in sys.argv else main()
