"""How long a map of four million points takes to become its areal parameters and moments.

One line: name, seconds of one processor, unit, ratio to its goal. Run: python benchmarks/height_map.py
"""

from __future__ import annotations

import time

import numpy as np
from scipy.ndimage import gaussian_filter

from profiles.maps import HeightMap
from roughness.maps import map_record, prepared_map

GOAL_S = 5.0
RUNS = 3


def main() -> None:
    noise = np.random.default_rng(0).standard_normal((2048, 2048))
    area = HeightMap(1e-6 * gaussian_filter(noise, (12.0, 4.0)), 0.5e-6, 0.5e-6)
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        map_record(prepared_map(area), area)
        times.append(time.process_time() - start)
    print(f"map of {area.heights.size} points: {min(times):.2f} s, {min(times) / GOAL_S:.2f} of the goal")


if __name__ == "__main__":
    main()
