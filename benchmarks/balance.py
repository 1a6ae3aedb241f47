"""How fast film and asperities are balanced: one line a benchmark, `name, figure, unit, ratio to its reference`.

The reference is what is asked for, above one: better than asked. The first run of the 378 conditions makes the tables
of the asperities; a million are timed by the command from start to end, tables written.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

from study import altered, line

from mixedlub.study import read_study, run_study

LAWS = {
    "greenwood_williamson": "",
    "greenwood_tripp": "",
    "chang_etsion_bogy": "hardness_GPa = 6.0",
    "zhao_maietta_chang": "hardness_GPa = 6.0",
    "kogut_etsion": "hardness_GPa = 6.0",
    "jackson_green": "hardness_GPa = 6.0",
}
SHIPPED_S, MILLION_S = 0.3, 60.0


def options(asperities: str) -> str:
    """Lines of a study file: a balance with these asperities."""
    return f'balance = "johnson_greenwood_poon"\nasperities = "{asperities}"\n{LAWS[asperities]}'


def shipped(folder: Path, asperities: str) -> None:
    """378 balanced conditions, the first time and again."""
    study = read_study(altered(folder, asperities, averaging=options(asperities)))
    took = []
    for _ in range(5):
        start = time.perf_counter()
        run_study(study)
        took.append(time.perf_counter() - start)
    line(f"378_balanced_{asperities}_first", took[0], "s", SHIPPED_S / took[0])
    line(f"378_balanced_{asperities}_again", min(took), "s", SHIPPED_S / min(took))


def million(folder: Path, asperities: str) -> None:
    """A million balanced conditions through the command."""
    path = altered(
        folder,
        "million",
        torque_Nm="torque_Nm = { from = 10, to = 200, count = 20 }",
        speed_rpm="speed_rpm = { from = 100, to = 3000, count = 477 }",
        oil_temperature_C="oil_temperature_C = { from = 40, to = 100, count = 5 }",
        averaging=f"{options(asperities)}\nface_slices = 1",
    )
    command = [sys.executable, "-m", "mixedlub", "study", str(path), "--no-figures", "--replace"]
    start = time.perf_counter()
    subprocess.run([*command, "--out", str(folder / "million")], check=True, capture_output=True)
    took = time.perf_counter() - start
    line(f"million_balanced_{asperities}", took, "s", MILLION_S / took)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as here:
        for name in LAWS:
            shipped(Path(here), name)
        for name in ("greenwood_williamson", "jackson_green"):
            million(Path(here), name)
