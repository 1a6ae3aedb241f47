"""Rebuild of the shipped traces from their recipes, bit for bit: ``python -m profiles.traces.build [DIR]``."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path

import numpy as np

from profiles.synthesise import long_waves, reshape_tails, self_affine
from profiles.traces import SHIPPED


def recipes() -> dict[str, dict]:
    """The recipes by name; lengths carry their unit in the key."""
    return tomllib.loads(resources.files("profiles.traces").joinpath("recipes.toml").read_text(encoding="utf-8"))


def texture(recipe: Mapping) -> tuple[np.ndarray, np.ndarray | None]:
    """Heights of the Gaussian self-affine texture of a recipe, and its long waves if only they are bent."""
    spacing = recipe["spacing_um"] * 1e-6
    base = self_affine(
        1e-6,
        hurst=recipe["hurst"],
        rolloff=recipe["rolloff_um"] * 1e-6,
        shortest=recipe["shortest_um"] * 1e-6,
        points=recipe["points"],
        spacing=spacing,
        seed=recipe["seed"],
    ).profile.heights
    bent_above = recipe["bent_above_um"] * 1e-6
    return base, long_waves(base, spacing, bent_above) if bent_above else None


def waves(recipe: Mapping, coefficients: np.ndarray) -> np.ndarray:
    """Sum (m) of the long waves of a recipe: a cosine and a sine coefficient (um) for each period (mm)."""
    position = np.arange(recipe["points"]) * recipe["spacing_um"] * 1e-3
    total = np.zeros(recipe["points"])
    for period, cosine, sine in zip(recipe["wave_periods_mm"], coefficients[::2], coefficients[1::2]):
        angle = 2 * np.pi * position / period
        total += 1e-6 * (cosine * np.cos(angle) + sine * np.sin(angle))
    return total


def envelope(gains: Sequence[float], points: int) -> np.ndarray:
    """Gain along a trace, linear between the middles of equal sampling lengths.

    >>> envelope([1.0, 2.0], 4)
    array([1.  , 1.25, 1.75, 2.  ])
    """
    middles = (np.arange(len(gains)) + 0.5) / len(gains)
    return np.interp((np.arange(points) + 0.5) / points, middles, gains)


def heights(recipe: Mapping) -> np.ndarray:
    """Heights (m) of the trace a recipe describes."""
    base, long = texture(recipe)
    bent = reshape_tails(base, recipe["rms_um"] * 1e-6, recipe["cubic"], recipe["extremes"], long, recipe["knee"])
    return bent * envelope(recipe["gains"], bent.size) + waves(recipe, np.array(recipe["wave_coefficients_um"]))


def text(name: str, recipe: Mapping) -> str:
    """File of a shipped trace: its kind, its recipe, and the heights to 0.1 nm."""
    lines = [
        f"# name: {name}",
        "# kind: synthetic, not a measurement",
        "# stands for: " + recipe["stands_for"],
        f"# table: Ra {recipe['Ra_um']:.3f} um, Rq {recipe['Rq_um']:.3f} um, Rz {recipe['Rz_um']:.3f} um"
        " (after Gaussian 2.5 um and 0.8 mm, means over six sampling lengths)",
        f"# recipe: recipes.toml [{name}], rebuilt by python -m profiles.traces.build",
        f"# spacing: {recipe['spacing_um']} um",
        "# unit: nm",
    ]
    lines += [f"{value:.1f}" for value in np.round(heights(recipe) * 1e9, 1) + 0.0]
    return "\n".join(lines) + "\n"


def main(folder: Path) -> None:
    for name in SHIPPED:
        recipe = recipes()[name]
        folder.joinpath(f"{name}.txt").write_text(text(name, recipe), encoding="utf-8", newline="\n")
        print(folder / f"{name}.txt")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
