"""Case folders in the format of an engineer, with the truth in a separate file, written and read back."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.rig import Case


def plain(values: np.ndarray) -> list[float]:
    """Numbers rounded to the written digits."""
    return [float(f"{value:.9g}") for value in values]


def rows(run: np.ndarray, hidden: np.ndarray, **columns: np.ndarray) -> dict[str, list[Any]]:
    """Rows of a truth: run numbers, withheld flags, and columns of numbers."""
    return {
        "run": [int(number) for number in run],
        "withheld": [bool(flag) for flag in hidden],
        **{name: plain(column) for name, column in columns.items()},
    }


def write(
    place: Path, case: Case, readings: Mapping[str, np.ndarray], hidden: np.ndarray, answer: dict[str, Any]
) -> None:
    """Write the case folder without the withheld readings; ``truth.json`` is written last and marks it complete."""
    import pandas as pd

    place.mkdir(parents=True, exist_ok=True)
    (place / "system.toml").write_text(toml(case.settings), encoding="utf-8")
    frame = pd.DataFrame({**case.columns, **{name: plain(column) for name, column in readings.items()}})
    frame[~hidden].to_csv(place / "recordings.csv", index=False)
    frame[hidden].drop(columns=list(readings)).to_csv(place / "conditions.csv", index=False)
    if case.share is not None:
        names = ["torque_Nm", "roll_angle_deg", "load_share"]
        pd.DataFrame(case.share, columns=names).to_csv(place / "load_share.csv", index=False)
    (place / "truth.json").write_text(json.dumps(answer, indent=1), encoding="utf-8")


def read_columns(file: Path) -> dict[str, np.ndarray]:
    """Columns of a CSV file by name."""
    import pandas as pd

    frame = pd.read_csv(file)
    return {str(name): frame[name].to_numpy(dtype=object if "surface" in str(name) else None) for name in frame}


def read_case(folder: Path, table: str = "recordings.csv") -> Case:
    """Read a case folder with the columns of one table."""
    with open(folder / "system.toml", "rb") as stream:
        settings = tomllib.load(stream)
    share = folder / "load_share.csv"
    rows = np.loadtxt(share, delimiter=",", skiprows=1) if share.exists() else None
    return Case(settings=settings, columns=read_columns(folder / table), share=rows)


def toml(settings: dict[str, Any]) -> str:
    """Settings as TOML: plain values first, then tables; enough for case files."""

    def value(item: Any) -> str:
        if isinstance(item, dict):
            return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in item.items()) + " }"
        if isinstance(item, list):
            return "[" + ", ".join(value(v) for v in item) + "]"
        return "inf" if item == float("inf") else json.dumps(item)

    lines = [f"{key} = {value(item)}" for key, item in settings.items() if not isinstance(item, dict)]
    for key, item in settings.items():
        if key == "surfaces":
            for name, surface in item.items():
                lines += ["", f"[surfaces.{name}]", *(f"{k} = {value(v)}" for k, v in surface.items())]
        elif isinstance(item, dict):
            lines += ["", f"[{key}]", *(f"{k} = {value(v)}" for k, v in item.items())]
    return "\n".join(lines) + "\n"
