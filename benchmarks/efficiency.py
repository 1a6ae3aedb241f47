"""How long a map of 50 torques by 50 speeds takes with the full elastic load distribution.

One line a figure: name, figure, unit, ratio to its reference. Run: python benchmarks/efficiency.py
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from mixedlub.efficiency import EXAMPLE, read_gearbox
from mixedlub.efficiency.file import EfficiencyFile
from mixedlub.schema.toml_file import parse, read_toml

ALLOWED_S = 5.0
ELASTIC = {"model": "ldp", "tip_relief_um": [10, 10], "relief_length_mm": [1, 1]}
LEVELS = {
    "torque_Nm": {"from": 0, "to": 150, "count": 50},
    "speed_rpm": {"from": 500, "to": 6000, "count": 50},
}


def seconds(path: Path, stages: int) -> float:
    """Time of the map of the first stages of the example gearbox with elastic teeth, read and checked as a file is."""
    raw = read_toml(path) | {"conditions": LEVELS}
    raw["stages"] = dict(list(raw["stages"].items())[:stages])
    for stage in raw["stages"].values():
        stage["gears"]["load_sharing"] = ELASTIC
    start = time.perf_counter()
    gearbox, _ = read_gearbox(path, parse(EfficiencyFile, raw, str(path)))
    gearbox.map()
    return time.perf_counter() - start


def main() -> None:
    """One line for one and for two helical stages."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "efficiency.toml"
        path.write_text(EXAMPLE.read_text(encoding="utf-8"), encoding="utf-8")
        for stages in (1, 2):
            took = seconds(path, stages)
            print(f"efficiency_map_50x50_helical_stages_{stages}, {took:.2f}, s, {ALLOWED_S / took:.2f}")


if __name__ == "__main__":
    main()
