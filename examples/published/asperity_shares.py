"""Load shares of asperities at thin films, beside published calculations and measurements of contact resistance.

python examples/published/asperity_shares.py --out examples/published/asperity_shares.md
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np
from scipy.special import erf

from mixedlub.base_model.balanced import balanced
from mixedlub.base_model.chains import LINE
from mixedlub.base_model.flattened import with_flattening
from mixedlub.chain.model import Model
from mixedlub.laws.film import DOWSON_TOYODA, dowson_toyoda
from mixedlub.rig.surface import Surface, paired
from mixedlub.rig.waves import UNDEFORMED, WAVES, WaveRows
from mixedlub.schema import toml_file
from mixedlub.study import read_study
from mixedlub.study.schema import StudyFile

HERE = Path(__file__).parent
RATIOS = np.array([0.3, 0.5, 0.7, 1.0])
"""Film of the whole load over composite roughness."""
PUBLISHED: Mapping[str, Callable[[np.ndarray], np.ndarray]] = {
    "partial films of Patir and Cheng, in Aihara, J. Tribol. 109 (1987) 471, eq. 13": lambda r: np.exp(-1.8 * r**1.2),
    "Zhou and Hoeprich, J. Tribol. 113 (1991) 590, eq. 29, ribs of 0.24 µm": lambda r: np.exp(-1.90 * r**0.99),
    "the same, raceways of 0.16 µm": lambda r: np.exp(-2.32 * r**0.97),
    "contact resistance, ground discs, in Arana and others, Proc. IMechE J 233 (2019) 303, eq. 14": lambda r: (
        1.0 - erf(r)
    ),
}
"""Share of the load that asperities carry. The two pairs of constants of eq. 29 are in Lubricants 11 (2023) 369,
table 4."""
FRICTION: Mapping[str, Callable[[np.ndarray], np.ndarray]] = {
    "Diab and others, in the same paper, table 1": lambda r: 0.25 * (1.0 - erf(r / np.sqrt(2.0))),
    "Doleschel, in the same table, of the mean Ra": lambda r: (1.0 - 0.5 * RQ_OVER_RA * r) ** 2,
}
"""Weights of boundary friction in laws that were fitted to measured friction."""
RQ_OVER_RA = float(np.sqrt(np.pi))
"""Composite Rq of two equal normal surfaces over their mean Ra."""
SURFACES = {
    "0302": "ground, Ra 0.30 µm",
    "0258": "ground, Ra 0.26 µm",
    "0122": "polished, with marks of 0.7 to 2.4 mm, Ra 0.12 µm",
    "0036": "superfinished, Ra 0.04 µm",
}
CONTACT = {
    "radius": 0.01,
    "viscosity": 0.01,
    "pressure_viscosity": 15e-9,
    "reduced_modulus": 226.374e9,
    "eyring_stress": 5e6,
    "boundary_friction": 0.1,
}
PRESSURE = 1e9
MODELS = (
    ("as measured", UNDEFORMED, 2.5, None, PRESSURE),
    ("flattened", WAVES, 2.5, None, PRESSURE),
    ("flattened, 0.6 GPa", WAVES, 2.5, None, 0.6e9),
    ("flattened, 1.5 GPa", WAVES, 2.5, None, 1.5e9),
    ("flattened, cut-off 8 µm", WAVES, 8.0, None, PRESSURE),
    ("flattened, cut-off b/50", WAVES, 2.5, 0.02, PRESSURE),
    ("flattened, cut-off b/10", WAVES, 2.5, 0.1, PRESSURE),
)
"""Name, choice of the waves, short cut-off (µm), short cut-off over the half width b, and largest pressure (Pa)."""


def surfaces(short_cutoff: float) -> Mapping[str, Surface]:
    """The shipped traces at a short cut-off (µm)."""
    file = HERE / "high_speed_gears_b.toml"
    raw = toml_file.read_toml(file)
    filters = {"cutoff_mm": 0.8, "short_cutoff_um": short_cutoff}
    raw["surfaces"] = {name: {"profile": f"shipped:{name}", **filters} for name in SURFACES}
    raw["pairings"] = {"every": list(SURFACES)}
    return read_study(file, toml_file.parse(StudyFile, raw, str(file))).surfaces


def shares(one: Surface, choice: str, cutoff_share: float | None, pressure: float) -> np.ndarray:
    """Load shares of the asperities of two equal surfaces at the film ratios, under a balance of the load."""
    rows = WaveRows()
    inputs = {name: v[:, None] for name, v in (paired([one], [one]) | rows.inputs([one], [one])).items()}
    load = 2.0 * np.pi * CONTACT["radius"] * pressure**2 / CONTACT["reduced_modulus"]
    known = (CONTACT[name] for name in ("viscosity", "pressure_viscosity", "reduced_modulus"))
    at_one = dowson_toyoda(CONTACT["radius"], 1.0, load, *known)
    speed = (RATIOS * np.sqrt(inputs["m0"]) / at_one) ** (1.0 / DOWSON_TOYODA.speed)
    inputs |= {**CONTACT, "line_load": load, "entrainment_speed": speed, "sliding_speed": 0.1 * speed}
    chain = LINE if choice == UNDEFORMED else with_flattening(LINE, rows.tables(choice, cutoff_share))
    found = Model(balanced(chain), tuple(inputs), ("asperity_pressure", "mean_pressure"))(inputs)
    return np.ravel(found["asperity_pressure"] / found["mean_pressure"])


def computed() -> Mapping[tuple[str, str], np.ndarray]:
    """Shares by surface and model."""
    at = {cutoff: surfaces(cutoff) for cutoff in {cutoff for _, _, cutoff, _, _ in MODELS}}
    return {
        (name, model): shares(at[cutoff][name], choice, share, pressure)
        for name in SURFACES
        for model, choice, cutoff, share, pressure in MODELS
    }


def beyond(found: np.ndarray) -> float:
    """Largest factor by which shares leave the range of the published ones."""
    published = np.array([law(RATIOS) for law in PUBLISHED.values()])
    low, high = published.min(axis=0), published.max(axis=0)
    return float(np.max(np.maximum(np.maximum(low / np.maximum(found, 1e-9), found / high), 1.0)))


def rows() -> Iterator[tuple[str, ...]]:
    """Rows of the page."""
    for name, law in (PUBLISHED | FRICTION).items():
        yield "published" if name in PUBLISHED else "fitted to friction", name, *_shown(law(RATIOS)), ""
    for (name, model), found in computed().items():
        factor = beyond(found)
        yield SURFACES[name], model, *_shown(found), "inside" if factor == 1.0 else _factor(factor)


def _shown(values: np.ndarray) -> tuple[str, ...]:
    return tuple(f"{100.0 * value:.0f} %" if value >= 0.0995 else f"{100.0 * value:.1f} %" for value in values)


def _factor(value: float) -> str:
    return f"{value:.1f}" if value < 100.0 else "above 100"


def page() -> str:
    """The table in its text."""
    text = (HERE / "asperity_shares_text.md").read_text(encoding="utf-8")
    return text.replace("ROWS", "\n".join("| " + " | ".join(row) + " |" for row in rows()))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out/published/asperity_shares.md"), help="page to write")
    arguments = parser.parse_args()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(page(), encoding="utf-8")
    print(arguments.out)
