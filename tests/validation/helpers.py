"""What the tests of the validation share: chains of gears and discs, orders of cases, an answer without a diagnosis."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from mixedlub.validation.contact import Calibration, Contact, Inputs, Oil, Solid, press
from mixedlub.validation.contact import start as started
from mixedlub.validation.rig import play
from mixedlub.validation.rigs import discs, gears
from mixedlub.validation.rigs.gears import Gears, path_of_contact
from mixedlub.validation.sample_case import Order

ORDERS = {
    "film, nothing": Order("", "film", "none", (), "clear", outliers=True),
    "film, fringes": Order("", "film", "measurement", ("fringe_step",), "clear"),
    "film, temperature law": Order("", "film", "single", ("viscosity_temperature_law",), "faint"),
    "film, starvation": Order("", "film", "single", ("starvation",), "clear"),
    "history, creep": Order("", "friction_history", "single", ("contact_creep",), "faint"),
    "history, humming": Order("", "friction_history", "unknown", ("humming",), "clear"),
    "history, gain": Order("", "friction_history", "measurement", ("sensor_gain",), "clear"),
    "history, force": Order("", "friction_history", "measurement", ("force_drift",), "clear"),
    "map, stribeck": Order("", "friction_map", "single", ("stribeck",), "clear"),
    "map, presliding": Order("", "friction_map", "single", ("presliding",), "clear"),
    "map, drag": Order("", "friction_map", "single", ("fluid_drag",), "clear"),
    "map, force": Order("", "friction_map", "measurement", ("force_offset",), "clear"),
    "map, two flanks": Order("", "friction_map", "pair", ("stribeck", "direction_dependence"), "clear"),
    "map, creep and rise": Order("", "friction_map", "pair", ("stribeck", "presliding"), "clear"),
    "viscosity, drift": Order("", "viscosity", "single", ("viscosity_drift",), "clear"),
    "viscosity, nothing": Order("", "viscosity", "none", (), "clear"),
    "viscosity, temperature law": Order("", "viscosity", "single", ("viscosity_temperature_law",), "clear"),
    "teeth, heating": Order("", "mesh_friction", "single", ("film_heating",), "clear"),
    "unnamed, nothing": Order("", "film", "none", (), "clear", no_data_sheet=True),
    "unnamed, layer": Order("", "film", "single", ("boundary_film",), "clear", no_data_sheet=True),
    "unnamed, pair": Order("", "film", "pair", ("inlet_shear_heating", "boundary_film"), "clear", no_data_sheet=True),
    "unnamed, drift": Order("", "film", "measurement", ("sensor_drift",), "faint", no_data_sheet=True),
    "unnamed, waves": Order("", "film", "unknown", ("waves",), "clear", outliers=True, no_data_sheet=True),
    "unnamed, temperature law": Order(
        "", "film", "single", ("viscosity_temperature_law",), "clear", no_data_sheet=True
    ),
}
"""Cases of all kinds but gears and discs."""


def run(inputs, calibration=None, acts=()):
    """The chain of gears or of discs with some effects at work."""
    chain = gears.POWER_LOSS if inputs.is_mesh else discs.FRICTION
    return play(chain, started(inputs, calibration or Calibration()), acts)


def readings(inputs, calibration=None, acts=()):
    return run(inputs, calibration, acts).recorded


def reference_points() -> Contact:
    """The 17/26 pair at 100 N m and 1500 rpm, at the pitch point, HPSTC and the end of the path."""
    module = 25.4e-3 / 6
    tips = (0.5 * module * 19, 0.5 * module * 28)
    path = path_of_contact(Gears((17, 26), module, np.radians(22.5), tips, 14e-3))
    x = np.array([path.pitch, path.high_single, path.end])
    pinion = 1500 * np.pi / 30
    inputs = Inputs(
        oil=Oil((40.0, 100.0), (30e-6, 6e-6), (18e-9, 13e-9)),
        solid=Solid(),
        radius=(x * (path.tangent_length - x) / path.tangent_length)[None, :],
        speed_1=(pinion * x)[None, :],
        speed_2=(pinion * 17 / 26 * (path.tangent_length - x))[None, :],
        share_force=np.array([[1.0, 1.0, 0.5]]) * 100 / path.base_radius[0],
        width=14e-3,
        temperature=np.array([60.0]),
        moments=np.array([[(0.321**2 + 0.374**2) * 1e-12, 0.005, 7.2e9]]),
        sequence=np.zeros(1),
        conditions={},
    )
    oil = {"viscosity": np.array([[0.01489]]), "pressure_viscosity": np.array([[14.81e-9]])}
    return press(replace(started(inputs, Calibration()), **oil))


def truth_of(folder):
    return json.loads((folder / "truth.json").read_text())


def drawn(draw, wanted, tries=300):
    """The first rig that fulfils a condition."""
    rng = np.random.default_rng(12)
    return next(rig for rig in (draw(rng) for _ in range(tries)) if wanted(rig))


def change(rig, form, values):
    z = np.zeros(len(rig.names))
    usual = {knob.name: float(np.mean(knob.typical)) for knob in form.knobs}
    return rig.model(z, [form.hide({**usual, **values})]) - rig.model(z, ())


def forms_of(rig, name):
    return [form for form in rig.forms if form.id == name]


def says_none(case: Path, out: Path) -> None:
    """Answers that nothing is missing, and breaks down on tooth contacts."""
    if "mesh_friction" in (case / "system.toml").read_text():
        raise RuntimeError("no gears here")
    runs = np.concatenate([pd.read_csv(case / name)["run"] for name in ("recordings.csv", "conditions.csv")])
    zeros = np.zeros(len(runs))
    columns = {"run": runs, "calibrated": zeros, "predicted": zeros, "low90": zeros - 1, "high90": zeros + 1}
    pd.DataFrame(columns).to_csv(out / "predictions.csv", index=False)
    said = {
        "verdict": ["none"],
        "tied": [["none"], ["sensor_gain"]],
        "probabilities": {"none": 0.8, "sensor_gain": 0.2},
        "mismatch": {"detected": False},
    }
    (out / "diagnosis.json").write_text(json.dumps(said))
