"""The rig of the worked example: an independent program that measures gearbox loss, with a loss kept secret.

Nothing here uses the model that is to be diagnosed. The rig is that of `mixedlub.validation`: its own tooth geometry,
film and friction laws, its own form of the hidden loss, 240 points along the path of contact.

    python make_rig.py        writes first_campaign/ and second_campaign/ (what the engineer has)
                              and truth.json (what nobody tells him)
"""

from __future__ import annotations

import csv
import json
from itertools import product
from pathlib import Path

import numpy as np

from mixedlub.validation.case_folder import toml
from mixedlub.validation.planted import NAMED
from mixedlub.validation.rig import Case
from mixedlub.validation.rigs.gears import rig_of

HERE = Path(__file__).resolve().parent
SECRET = {"churning": {"strength": 0.55, "speed_power": 1.9, "viscosity_power": 0.25}}
MISSET = {
    "boundary_friction": -0.9,
    "viscosity": 0.7,
    "pressure_viscosity": -0.4,
    "eyring_stress": 0.8,
    "roughness": 0.5,
}
"""How far the rig's true inputs lie from what the engineer believes, in standard deviations of his."""
NOISE = {"relative": 0.012, "absolute": 0.6}
SPOILT = {17: 14.0}
"""Readings that went wrong: row and error in standard deviations."""

SETTINGS = {
    "schema": "mixedlub-case/1",
    "kind": "gear_pair",
    "boundary_friction": 0.1,
    "description": "Back-to-back rig, spur gears of 91.5 mm centre distance, dip lubrication. The wattmeter sees the "
    "whole test gearbox; its bearings were calibrated out.",
    "gears": {
        "teeth": [16, 24],
        "normal_module_mm": 4.5,
        "pressure_angle_deg": 20.0,
        "helix_angle_deg": 0.0,
        "profile_shift": [0.1817, 0.1715],
        "centre_distance_mm": 91.5,
        "tip_diameter_mm": [82.46, 118.36],
        "face_width_mm": 14.0,
        "youngs_modulus_GPa": [206.0, 206.0],
        "poisson_ratio": [0.3, 0.3],
        "load_sharing": {"model": "rigid"},
    },
    "lubricant": {
        "name": "ISO VG 68 mineral oil",
        "temperature_C": [40.0, 100.0],
        "kinematic_viscosity_mm2_s": [68.0, 8.7],
        "pressure_viscosity_per_GPa": [20.0, 15.0],
        "density_15C_kg_m3": 870.0,
        "density_change_per_K": 7e-4,
        "eyring_stress_MPa": 5.0,
        "thermal_conductivity_W_mK": 0.14,
        "specific_heat_J_kgK": 2000.0,
    },
    "surfaces": {
        "ground": {"m0_um2": 0.137, "m2": 0.0031, "m4_per_um2": 0.0021},
        "superfinished": {"m0_um2": 0.0102, "m2": 0.00062, "m4_per_um2": 0.00068},
    },
    "uncertainty": {
        "boundary_friction": 0.012,
        "viscosity": 0.06,
        "pressure_viscosity": 0.06,
        "eyring_stress": 0.15,
        "roughness": 0.04,
    },
    "recording": {
        "quantity": "power_loss_W",
        "includes": "the whole gearbox less its bearings; the model has only the mesh",
        "noise": NOISE,
    },
}
FIRST = {"torque_Nm": (135.0, 300.0), "speed_rpm": (500.0, 1000.0, 1500.0), "oil_temperature_C": (60.0, 90.0)}
SECOND = {
    "torque_Nm": (40.0, 110.0, 300.0),
    "speed_rpm": (500.0, 1000.0, 1500.0, 2250.0, 3000.0),
    "oil_temperature_C": (60.0, 90.0),
}
WITHHELD = {"torque_Nm": (75.0, 200.0), "speed_rpm": (750.0, 2000.0, 3500.0), "oil_temperature_C": (50.0, 75.0)}
FINISHES = ("ground", "superfinished")


def programme(levels: dict[str, tuple[float, ...]], start: int, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Every condition with every finish once, in random order; both gears of a pair have the same finish."""
    rows = list(product(FINISHES, *levels.values()))
    rows = [rows[i] for i in rng.permutation(len(rows))]
    finish = np.array([row[0] for row in rows], dtype=object)
    return {
        "run": np.arange(start, start + len(rows)),
        "pinion_surface": finish,
        "gear_surface": finish,
        **{name: np.array([row[i + 1] for row in rows]) for i, name in enumerate(levels)},
    }


def measured(columns: dict[str, np.ndarray], *, secret: bool) -> np.ndarray:
    """What the rig would read without noise (W), with or without the hidden loss."""
    rig = rig_of(Case(settings=SETTINGS, columns=columns)).refined
    hidden = [NAMED[name].hide(knobs) for name, knobs in SECRET.items()] if secret else []
    return rig.model(np.array(list(MISSET.values())), hidden)


def write_table(path: Path, columns: dict[str, np.ndarray]) -> None:
    """Columns as CSV."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def write_campaign(
    folder: Path, levels: dict[str, tuple[float, ...]], spoilt: dict[int, float], seed: int
) -> list[int]:
    """A case folder with the readings of one campaign; returns the runs that went wrong."""
    rng = np.random.default_rng(seed)
    folder.mkdir(exist_ok=True)
    (folder / "system.toml").write_text(toml(SETTINGS), encoding="utf-8")
    columns = programme(levels, 1, rng)
    loss = measured(columns, secret=True)
    error = rng.standard_normal(loss.size)
    error[list(spoilt)] = list(spoilt.values())
    noisy = loss + np.hypot(NOISE["relative"] * loss, NOISE["absolute"]) * error
    write_table(folder / "recordings.csv", {**columns, "power_loss_W": np.round(noisy, 3)})
    return [int(columns["run"][row]) for row in spoilt]


def main() -> None:
    """Write both case folders, and the truth beside them."""
    write_campaign(HERE / "first_campaign", FIRST, {}, 1)
    spoilt = write_campaign(HERE / "second_campaign", SECOND, SPOILT, 2)
    kept = programme(WITHHELD, 101, np.random.default_rng(3))
    write_table(HERE / "second_campaign" / "conditions.csv", kept)
    whole, mesh = measured(kept, secret=True), measured(kept, secret=False)
    truth = {
        "concealed": SECRET,
        "misset_in_sd": MISSET,
        "spoilt_runs": spoilt,
        "withheld": {
            str(run): {"loss_W": round(float(w), 3), "concealed_W": round(float(w - m), 3)}
            for run, w, m in zip(kept["run"], whole, mesh, strict=True)
        },
    }
    (HERE / "truth.json").write_text(json.dumps(truth, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
