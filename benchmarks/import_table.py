"""How fast a table becomes a case folder: one line a size, `name, figure, unit, ratio to its reference`.

The table is a friction map in tidy CSV: a header with units, eight columns, half of them taken. The reference is what
is asked for: 300,000 rows in 20 s of one core, fewer rows in proportion. Times are of the processor, so that other
work on the machine does not count; a ratio that falls with the rows shows a step that is not linear.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np

from mixedlub.importers import import_files
from mixedlub.importers.text_table import read_sheet
from profiles.errors import InputError

SECONDS_A_ROW = 20.0 / 300_000
BETWEEN = {"dashes": "-,-,-\n", "words": "x,y,z\n", "nothing": "\n"}
"""Lines that stand after every row of a table."""
SIZES = (20_000, 100_000, 300_000)
HEADER = "Time [s],Motor speed [rpm],Friction torque [Nm],Oil temp [°C],Payload [Nm],Current [A],Vibration [g],Sample"
"""A drive's table: four columns of the case, three channels of no use to it, and what was tested."""


def write_table(path: Path, rows: int) -> None:
    """A friction map of a drive with a Stribeck course, its speed swept up and down again and again."""
    rng = np.random.default_rng(rows)
    time_s = np.arange(rows) * 0.1
    speed = np.round(1500.0 + 1400.0 * np.sin(time_s / 60.0), 2)
    torque = 0.8 + 1.2 * np.exp(-speed / 300.0) + 4e-4 * speed + rng.normal(0.0, 0.01, rows)
    oil, payload = 40.0 + rng.normal(0.0, 0.2, rows), rng.choice((0.0, 5.0, 10.0), rows)
    current, vibration = 0.5 * torque + rng.normal(0.0, 0.02, rows), np.abs(rng.normal(0.0, 0.3, rows))
    columns = zip(time_s, speed, torque, oil, payload, current, vibration, strict=True)
    lines = (f"{t:.1f},{n:.2f},{m:.5f},{o:.2f},{p:.1f},{a:.4f},{g:.4f},A4" for t, n, m, o, p, a, g in columns)
    path.write_text("\n".join((HEADER, *lines)) + "\n", encoding="utf-8")


def between_the_rows(rows: int = 20_000) -> None:
    """Read tables in which another line follows every row, and print a line for each kind of it."""
    for name, line in BETWEEN.items():
        text = "a,b,c\n" + "".join(f"{i},1,2\n{line}" for i in range(rows)) + "1,2,3\n1,2,4\n"
        start = time.process_time()
        with suppress(InputError):
            read_sheet(text, "t.csv")
        seconds = time.process_time() - start
        print(f"read_with_{name}_between, {seconds:.4g}, s, {rows * SECONDS_A_ROW / seconds:.3g}", flush=True)


def main(sizes: Sequence[int]) -> None:
    """Import tables of these sizes and print a line for each."""
    with tempfile.TemporaryDirectory() as here:
        for rows in sizes:
            path = Path(here) / f"table_{rows}.csv"
            write_table(path, rows)
            answers = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
            start = time.process_time()
            import_files([path], Path(here) / f"case_{rows}", **answers)
            seconds = time.process_time() - start
            print(f"import_{rows}_rows, {seconds:.4g}, s, {rows * SECONDS_A_ROW / seconds:.3g}", flush=True)


if __name__ == "__main__":
    main([int(word) for word in sys.argv[1:]] or SIZES)
    between_the_rows()
