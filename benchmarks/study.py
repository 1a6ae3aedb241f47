"""How fast studies are: one line a benchmark, `name, figure, unit, ratio to its reference`.

The ratio of the 378 conditions is to the plain loop, timed side by side (above one: faster than it); the others
are to what is asked for (above one: better than asked). Points per core are by processor time, the rest by the clock
on the wall.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from reference.loop import power_losses

from mixedlub.study import batch, read_study, run_study

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SHIPPED = EXAMPLES / "study_21_pairings.toml"


def best(action: Callable[[], object], times: int, clock: Callable[[], float] = time.perf_counter) -> float:
    """Shortest of several runs (s): what the machine can do when nothing else wants it."""
    found = []
    for _ in range(times):
        start = clock()
        action()
        found.append(clock() - start)
    return min(found)


def line(name: str, figure: float, unit: str, ratio: float) -> None:
    """Print one result."""
    print(f"{name}, {figure:.4g}, {unit}, {ratio:.3g}", flush=True)


def altered(folder: Path, name: str, **changes: str) -> Path:
    """The shipped study with some lines replaced by others, each named by what it starts with."""
    lines = SHIPPED.read_text(encoding="utf-8").splitlines()
    for start, text in changes.items():
        lines = [text if row.startswith(f"{start} =") else row for row in lines]
    path = folder / f"{name}.toml"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def shipped_study() -> None:
    """378 conditions, warm, against the plain loop; the two must agree."""
    study = read_study(SHIPPED)
    batched, looped = run_study(study)["power_loss"], power_losses(study)
    assert np.allclose(batched, looped, rtol=1e-12), "the loop and the batch engine disagree"
    fast, slow = best(lambda: run_study(study), 20), best(lambda: power_losses(study), 3)
    line("378_conditions_warm", fast * 1e3, "ms", slow / fast)
    line("378_conditions_plain_loop", slow * 1e3, "ms", 1.0)
    line("378_conditions_against_20_ms", fast * 1e3, "ms", 0.020 / fast)


def grid(folder: Path) -> None:
    """The base chain on 1000 pairings x 10 torques x 10 speeds x 100 places, on one core."""
    flanks = [
        f"{side}{i} = {{ m0_um2 = {0.01 + 0.006 * i:.4f}, m2 = 0.0025, m4_per_um2 = 0.0036 }}"
        for side, count in (("p", 25), ("g", 40))
        for i in range(count)
    ]
    text = SHIPPED.read_text(encoding="utf-8")
    head, tail = text.split("[surfaces]")[0], text.split("[options]")[1]
    pinions, gears = ([f"{side}{i}" for i in range(count)] for side, count in (("p", 25), ("g", 40)))
    conditions = (
        "[conditions]\ntorque_Nm = { from = 20, to = 200, count = 10 }\n"
        "speed_rpm = { from = 300, to = 3000, count = 10 }\noil_temperature_C = [60]\n"
    )
    path = folder / "grid.toml"
    path.write_text(
        f"{head}[surfaces]\n" + "\n".join(flanks) + f"\n[pairings]\npinion = {json.dumps(pinions)}\n"
        f"gear = {json.dumps(gears)}\n{conditions}[options]\npath_points = 100\nface_slices = 1\n{tail}",
        encoding="utf-8",
    )
    plan = read_study(path).plan
    points = float(np.prod(plan.shape)) * plan.points
    core = best(lambda: list(batch.run(plan, threads=1)), 5, time.process_time)
    line("grid_points_per_core", points / core / 1e6, "million points/s", points / core / 50e6)
    alone, both = (best(lambda n=n: list(batch.run(plan, threads=n)), 5) for n in (1, None))
    line("grid_points_one_thread", points / alone / 1e6, "million points/s", points / alone / 50e6)
    line("grid_points_all_threads", points / both / 1e6, "million points/s", alone / both)


def million(folder: Path) -> None:
    """A million conditions through the command, tables written, with its peak memory."""
    path = altered(
        folder,
        "million",
        torque_Nm="torque_Nm = { from = 10, to = 200, count = 20 }",
        speed_rpm="speed_rpm = { from = 100, to = 3000, count = 477 }",
        oil_temperature_C="oil_temperature_C = { from = 40, to = 100, count = 5 }",
        averaging="face_slices = 1",
    )
    code = (
        "import resource, sys, time\nfrom mixedlub.cli import main\nstart = time.perf_counter()\n"
        f"assert main(['study', {str(path)!r}, '--no-figures', '--out', {str(folder / 'million')!r}]) == 0\n"
        "print(time.perf_counter() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    told = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    seconds, kilobytes = (float(word) for word in told.splitlines()[-1].split())
    line("million_conditions", seconds, "s", 10.0 / seconds)
    line("million_conditions_memory", kilobytes / 1024, "MiB", 1024**2 / kilobytes)


def processes(folder: Path) -> None:
    """The command from start to end, and the import."""

    def run(*arguments: str) -> Callable[[], object]:
        return lambda: subprocess.run([sys.executable, *arguments], check=True, capture_output=True)

    command = ("-m", "mixedlub", "study", str(SHIPPED), "--out", str(folder / "shipped"))
    table = best(run(*command, "--no-figures"), 5)
    line("study_command_without_figures", table, "s", 1.5 / table)
    page = best(run(*command), 2)
    line("study_command_with_figures", page, "s", 15.0 / page)
    for package in ("mixedlub", "mixedlub.study"):
        imported = best(run("-c", f"import {package}"), 5)
        line(f"python_and_import_{package}", imported, "s", 0.3 / imported)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as here:
        shipped_study()
        grid(Path(here))
        million(Path(here))
        processes(Path(here))
