"""Mesh loss of a published gear by every friction law, beside the loss that was measured.

python examples/published/measured_gear.py --out examples/published/measured_gear.md
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from mixedlub.friction import catalogue
from mixedlub.schema import toml_file
from mixedlub.study import read_study, run_study
from mixedlub.study.friction_comparison import checked, mesh_table
from mixedlub.study.schema import StudyFile

HERE = Path(__file__).parent
FILE, COEFFICIENTS = HERE / "measured_gear.toml", HERE / "measured_gear_coefficients.toml"
MEASURED = (170.0, 303.0, 478.0, 619.0, 555.0)
WITHIN = (4.0, 17.0, 21.0, 14.0, 85.0)
"""Loss (W) at the five speeds, and how far it may be off: half the rounding of the errors that the source prints."""
ROLLING = ("Biboulet and Houpert", "Goksem and Hargreaves")

Row = tuple[str, ...]


def measured() -> Row:
    """The row of the measured loss."""
    return ("**measured**", *(f"**{w:.0f} ± {e:.0f}**" for w, e in zip(MEASURED, WITHIN, strict=True)), "")


def by_law() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Mesh loss (W) over speed by law, and where the law is outside its range."""
    study = read_study(FILE)
    table = mesh_table(study, checked(toml_file.read_toml(COEFFICIENTS)))
    return {
        str(law): (rows["mesh_loss_W"].to_numpy(), (rows["validity"] != "valid").to_numpy())
        for law, rows in table.groupby("law", sort=False)
    }


def rolling(law: str) -> np.ndarray:
    """Rolling loss (W) over speed."""
    raw = toml_file.read_toml(FILE)
    file = toml_file.parse(StudyFile, {**raw, "effects": {"rolling_resistance": {"law": law}}}, str(FILE))
    return np.asarray(run_study(read_study(FILE, file))["rolling_loss"]).ravel()


def rows() -> Iterator[Row]:
    """Rows of the table: measured, sliding by law, rolling by law."""
    yield measured()
    for law, (loss, outside) in by_law().items():
        watts = (f"{value:.0f}{'*' if off else ''}" for value, off in zip(loss, outside, strict=True))
        yield catalogue()[law].title, *watts, f"{np.mean(loss / np.array(MEASURED)):.2f}"
    for law in ROLLING:
        loss = rolling(law)
        yield f"rolling: {law}", *(f"{value:.0f}" for value in loss), f"{np.mean(loss / np.array(MEASURED)):.2f}"


def page() -> str:
    """The table in its text."""
    table = "\n".join("| " + " | ".join(row) + " |" for row in rows())
    left = ", ".join(sorted(f"`{name}`" for name in set(catalogue()) - set(by_law())))
    text = (HERE / "measured_gear_text.md").read_text(encoding="utf-8")
    return text.replace("ROWS", table).replace("LEFT_OUT", left)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out/published/measured_gear.md"), help="page to write")
    arguments = parser.parse_args()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(page(), encoding="utf-8")
