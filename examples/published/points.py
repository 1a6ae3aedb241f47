"""What papers state of gear friction, beside the base model and the model with the oil's own heat.

python examples/published/points.py --out examples/published/points.md
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.model import Model
from mixedlub.effects import find
from mixedlub.schema import toml_file
from mixedlub.schema.table import Table
from mixedlub.study import read_study, run_study
from mixedlub.study.schema import StudyFile

HERE = Path(__file__).parent
HEAT = {e.id: e.law_values() for e in find(("inlet_shear_heating", "film_heating"))}
"""The laws as published: Gupta's factor of the film; Archard's and Blok's rises with Roelands' slope."""
MODELS: tuple[dict[str, dict[str, float]], ...] = ({}, HEAT)
Place = dict[str, Any]
ROUGH, SMOOTH = "ground / ground", "superfinished / superfinished"
AT_100 = {"oil_temperature_C": 1}
CHANGES: tuple[tuple[str, str, tuple[str, Place], tuple[str, Place]], ...] = (
    ("20 to 95 m/s, geometry B, ground", "-28 %", ("b", {"speed_rpm": 0}), ("b", {"speed_rpm": -1})),
    ("ground to superfinished, geometry B", "-30 %", ("b", {}), ("b", {"pairing": SMOOTH})),
    (
        "geometry A to B, 1900 N m, 100 °C, ground",
        "-2 %",
        ("a", AT_100 | {"torque_Nm": 0}),
        ("b", AT_100 | {"torque_Nm": 0}),
    ),
    (
        "1900 to 4000 N m, geometry A, 100 °C, ground",
        "-3 %",
        ("a", AT_100 | {"torque_Nm": 0}),
        ("a", AT_100 | {"torque_Nm": 1}),
    ),
    (
        "oil 80 to 120 °C, geometry A, 1900 N m, ground",
        "+1 %",
        ("a", {"torque_Nm": 0, "oil_temperature_C": 0}),
        ("a", {"torque_Nm": 0, "oil_temperature_C": 2}),
    ),
)
"""What is compared, the change that the paper states, and geometry and place before and after."""
FULL_TORQUE = 71.7
"""Pinion torque called 100 % (N m)."""
SPEEDS = (800.0, 6000.0)
LOADS = (0.78, 1.41)
CALCULATED = (
    ("Hertz pressure (GPa)", "1.41", "hertz_pressure", 1e-9),
    ("half width of the contact (mm)", "0.19", "hertz_half_width", 1e3),
    ("film (µm)", "0.49", "film_thickness", 1e6),
)

Row = tuple[str, str, str, str]


def fast_gears() -> Iterator[Row]:
    """Helical gears up to 95 m/s: relative changes of the mean friction."""
    friction = [{geometry: _friction(geometry, effects) for geometry in "ab"} for effects in MODELS]
    for stated, measured, before, after in CHANGES:
        base, heat = (_percent(_mean(f, after) / _mean(f, before)) for f in friction)
        yield f"A: mean friction, {stated}", measured, base, heat


def _friction(geometry: str, effects: dict[str, dict[str, float]]) -> Any:
    """Mean friction of one pair of gears at all conditions."""
    file = HERE / f"high_speed_gears_{geometry}.toml"
    raw = toml_file.read_toml(file)
    study = read_study(file, toml_file.parse(StudyFile, {**raw, "effects": effects}, str(file)))
    return run_study(study).to_xarray()["mean_friction"]


def _percent(ratio: float) -> str:
    return f"{100.0 * (ratio - 1.0):+.0f} %"


def _mean(friction: dict[str, Any], where: tuple[str, Place]) -> float:
    geometry, place = where
    by_place = {axis: at for axis, at in place.items() if axis != "pairing"}
    return float(friction[geometry].sel(pairing=place.get("pairing", ROUGH)).isel(by_place).mean())


def nasa_rig() -> Iterator[Row]:
    """Spur gears of the NASA gear noise rig: the largest friction while one pair of teeth carries the load."""
    case = read_case(HERE / "nasa_rig", need_recordings=False)
    assert case.system.gears is not None
    pair = case.rig.gears
    single = np.linspace(pair.lowest_single_contact, pair.highest_single_contact, 41) / pair.base_radius[0]
    rows = [(speed, load) for speed in SPEEDS for load in LOADS]
    table = Table(
        {
            "run": np.arange(len(rows) * single.size),
            "torque_Nm": np.repeat([FULL_TORQUE * load for _, load in rows], single.size),
            "speed_rpm": np.repeat([speed for speed, _ in rows], single.size),
            "oil_temperature_C": np.full(len(rows) * single.size, 70.0),
            "pinion_surface": np.full(len(rows) * single.size, "ground"),
            "gear_surface": np.full(len(rows) * single.size, "ground"),
            "roll_angle_deg": np.tile(np.degrees(single), len(rows)),
        }
    )
    forward = Forward(case, table)
    largest = [
        forward.predict(parameters=effects).reshape(len(SPEEDS), len(LOADS), -1).max(axis=-1) for effects in MODELS
    ]

    def row(stated: str, measured: str, form: Callable[[np.ndarray], str]) -> Row:
        return f"B: {stated}", measured, form(largest[0]), form(largest[1])

    yield row("largest friction, 800 rpm", "0.063", lambda mu: f"{mu[0].mean():.3f}")
    yield row("largest friction, 6000 rpm", "0.040", lambda mu: f"{mu[1].mean():.3f}")
    yield row("78 to 141 % torque", "largely none", lambda mu: _percent((mu[:, 1] / mu[:, 0]).mean()))
    for stated, measured, name, factor in CALCULATED:
        told = []
        for effects in MODELS:
            chain = Model(forward.chain, tuple(forward.inputs), (name,), find(sorted(effects)))
            told.append(f"{chain(forward.inputs, effects)[name][-single.size // 2].item() * factor:.3g}")
        yield f"B: {stated}, 141 % torque, 6000 rpm", f"{measured} (calculated)", told[0], told[1]


def page() -> str:
    """The table in its text."""
    rows = "\n".join("| " + " | ".join(row) + " |" for row in (*fast_gears(), *nasa_rig()))
    return (HERE / "text.md").read_text(encoding="utf-8").replace("ROWS", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out/published/points.md"), help="page to write")
    arguments = parser.parse_args()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(page(), encoding="utf-8")
    print(arguments.out)
