"""Tables of the evaluation templates: `python -m mixedlub.validation.benches.templates FOLDER` writes them."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from mixedlub.validation.benches import calorimetric, gear_losses, off_line, strain_gauges, traction, two_discs
from mixedlub.validation.benches.tables import as_csv

SEED = 5
"""Seed of the instrument errors of the templates."""


def tables() -> dict[str, str]:
    """Text by path below the folder of the templates."""
    gear = calorimetric.Gear()
    bench = replace(calorimetric.Bench(), sliding=calorimetric.sliding_of_mesh(gear))
    strains = strain_gauges.recorded(replace(strain_gauges.Bench(), turns=20), strain_gauges.Tooth(), SEED)
    slow, _ = off_line.recorded(replace(off_line.Bench(), turns=4), SEED)
    return {
        "calorimetric/readings.csv": as_csv(calorimetric.recorded(bench, gear, SEED)[0]),
        "strain_gauge/calibration.csv": as_csv(strains[0]),
        "strain_gauge/recording.csv": as_csv(strains[1]),
        "two_disc/readings.csv": as_csv(two_discs.recorded(two_discs.Bench(), SEED)[0]),
        "calibration/readings.csv": as_csv(gear_losses.recorded(gear_losses.Bench(), gear, SEED)),
        "regression/readings.csv": as_csv(traction.recorded(traction.Bench(), SEED)),
        **{f"off_line/{name}": as_csv(table) for name, table in slow.items()},
    }


def main(folder: Path) -> None:
    """Write all tables."""
    for name, text in tables().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
