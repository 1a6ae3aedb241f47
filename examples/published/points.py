"""What papers state of gear friction, beside the base model and the model with the oil's own heat.

python examples/published/points.py --out examples/published/points.md
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.model import Model
from mixedlub.effects import find
from mixedlub.gear import RigidSharing, at_roll_angle, local_loss_factor, mesh
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.laws import heating
from mixedlub.laws.contact import line_hertz_pressure
from mixedlub.schema import toml_file
from mixedlub.schema.system_file import Gears
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
    (
        "20 to 95 m/s, geometry B, superfinished",
        "falls",
        ("b", {"pairing": SMOOTH, "speed_rpm": 0}),
        ("b", {"pairing": SMOOTH, "speed_rpm": -1}),
    ),
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
BAND = {"coefficient": (10.0, 15.0), "boundary_friction": (0.05, 0.1), "short_cutoff": (2.5, 25.0)}
"""Pressure-viscosity coefficient (1/GPa, at 54 °C), boundary friction and short cut-off (um), which are not printed."""
RELIEVED = (("a", 6.0), ("b", 6.0), ("a", 4.0))
"""Geometries and lengths (mm) of a tip relief of 30 um, which the paper does not print."""
PINION_TORQUES = np.array([100.0, 1357.0, 2857.0])
"""N m; on the wheel 1.4 times as much."""
FULL_TORQUE = 71.7
"""Pinion torque called 100 % (N m)."""
SPEEDS = (800.0, 6000.0)
LOADS = (0.78, 1.41)
CALCULATED = (
    ("Hertz pressure (GPa)", "1.41", "hertz_pressure", 1e-9),
    ("half width of the contact (mm)", "0.19", "hertz_half_width", 1e3),
    ("film (µm)", "0.49", "film_thickness", 1e6),
    ("rise of the film above its walls (K), largest of single contact", "140", "film_rise", 1.0),
)

Row = tuple[str, str, str, str]


def fast_gears() -> Iterator[Row]:
    """Helical gears up to 95 m/s: relative changes of the mean friction."""
    friction = [{geometry: _friction(geometry, effects) for geometry in "ab"} for effects in MODELS]
    for stated, measured, before, after in CHANGES:
        base, heat = (_percent(_mean(f, after) / _mean(f, before)) for f in friction)
        yield f"A: mean friction, {stated}", measured, base, heat


def band() -> Iterator[Row]:
    """The same changes, least and largest over the corners of what the paper does not state."""
    corners = [dict(zip(BAND, values)) for values in product(*BAND.values())]
    friction = [[{g: _friction(g, effects, **one) for g in "ab"} for one in corners] for effects in MODELS]
    for stated, measured, before, after in CHANGES:
        ratios = [[_mean(f, after) / _mean(f, before) for f in each] for each in friction]
        base, heat = (f"{_percent(min(each))} to {_percent(max(each))}" for each in ratios)
        yield f"A: mean friction, {stated}", measured, base, heat


def loss_factors() -> Iterator[Row]:
    """Loss factors of the local load of both geometries over the torque."""
    for geometry, length in RELIEVED:
        elastic = {"model": "ldp", "tip_relief_um": [30.0, 30.0], "relief_length_mm": [length, length]}
        gears = Gears.model_validate({"preset": f"high_speed_{geometry}", "load_sharing": elastic})
        found = local_loss_factor(mesh(gear_pair(gears), sharing(gears.load_sharing, HERE)), PINION_TORQUES)
        place = f"100, 1357 and 2857 N m at the pinion, {length:g} mm of relief"
        text = ", ".join(f"{one:.4f}" for one in found)
        yield f"A: loss factor, geometry {geometry.upper()}, {place}", "grows, then levels; B above A", text, text


def _friction(geometry: str, effects: dict[str, dict[str, float]], **assumed: float) -> Any:
    """Mean friction of one pair of gears at all conditions, with other numbers than assumed in its file."""
    file = HERE / f"high_speed_gears_{geometry}.toml"
    raw = toml_file.read_toml(file)
    if assumed:
        known = {"coefficient_per_GPa": assumed["coefficient"], "temperature_C": 54.0}
        raw["boundary_friction"] = assumed["boundary_friction"]
        raw["lubricant"]["known_pressure_viscosity"] = known
        for section in raw["surfaces"].values():
            section["short_cutoff_um"] = assumed["short_cutoff"]
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
    shape = (len(SPEEDS), len(LOADS), single.size)
    local = [forward.predict(parameters=effects).reshape(shape) for effects in MODELS]

    def row(stated: str, measured: str, form: Callable[[np.ndarray], str]) -> Row:
        return f"B: {stated}", measured, form(local[0]), form(local[1])

    yield row("largest friction, 800 rpm", "0.063", lambda mu: f"{mu[0].max(axis=-1).mean():.3f}")
    yield row("largest friction, 6000 rpm", "0.040", lambda mu: f"{mu[1].max(axis=-1).mean():.3f}")
    yield row("78 to 141 % torque", "largely none", lambda mu: _percent(_of_load(mu.max(axis=-1))))
    away = np.abs(single - pair.pitch_point / pair.base_radius[0])
    ends = [away <= np.quantile(away, 0.1), away >= np.quantile(away, 0.9)]
    yield row(
        "pitch point over the ends of single contact, 800 rpm",
        "above 1",
        lambda mu: f"{mu[0][:, ends[0]].mean() / mu[0][:, ends[1]].mean():.2f}",
    )
    chain = (*forward.chain, ("film_rise", heating.film_rise))
    for stated, measured, name, factor in CALCULATED:
        told = []
        for effects in MODELS:
            model = Model(chain, tuple(forward.inputs), (name,), find(sorted(effects)))
            of_point = np.broadcast_to(model(forward.inputs, effects)[name].ravel(), (len(rows) * single.size,))
            value = of_point[-single.size :].max() if name == "film_rise" else of_point[-single.size // 2]
            told.append(f"{value * factor:.3g}")
        yield f"B: {stated}, 141 % torque, 6000 rpm", f"{measured} (calculated)", told[0], told[1]


def _of_load(largest: np.ndarray) -> float:
    return float((largest[:, 1] / largest[:, 0]).mean())


DISC_BASE = {"load_N": 298.0, "entrainment_speed_m_s": 2.4765, "slide_roll_ratio": 1.08, "oil_temperature_C": 33.0}
"""Baseline of table 3 of the two-disc tests: 67 lb, 97.5 inch/s, 33 degrees."""
SWEEPS = (
    ("inlet 33 to 73 °C", "rises a little", "oil_temperature_C", (33.0, 73.0)),
    ("slide-to-roll ratio 0.6 to 1.2", "falls", "slide_roll_ratio", (0.6, 1.2)),
    ("rolling speed 12 to 150 inch/s", "falls strongly", "entrainment_speed_m_s", (0.3048, 3.81)),
    ("load 11 to 135 lb", "depends strongly", "load_N", (48.9, 600.5)),
)


def two_discs() -> Iterator[Row]:
    """Two crowned discs with transmission fluid (A) and gear oil (B): sweeps about the baseline."""
    at = [DISC_BASE, *(DISC_BASE | {name: end} for *_, name, ends in SWEEPS for end in ends)]
    columns = {name: np.array([one[name] for one in at]) for name in DISC_BASE}
    surfaces = dict.fromkeys(("surface_1", "surface_2"), np.full(len(at), "disc"))
    rows = Table({"run": np.arange(len(at)), **columns, **surfaces})
    found = {
        fluid: Forward(read_case(HERE / "two_discs" / fluid, need_recordings=False), rows)
        for fluid in ("fluid_a", "fluid_b")
    }
    mu = {fluid: [one.predict(parameters=effects) for effects in MODELS] for fluid, one in found.items()}
    told = [f"{a[0] / b[0]:.2f}" for a, b in zip(mu["fluid_a"], mu["fluid_b"])]
    yield "C: friction of fluid A over that of fluid B", "nearly 0.5", told[0], told[1]
    for number, (stated, measured, *_) in enumerate(SWEEPS):
        told = [_percent(a[2 + 2 * number] / a[1 + 2 * number]) for a in mu["fluid_a"]]
        yield f"C: friction of fluid A, {stated}", measured, told[0], told[1]
    one = found["fluid_a"]
    chain = Model(one.chain, tuple(one.inputs), ("hertz_pressure",))
    pressure = f"{chain(one.inputs)['hertz_pressure'].ravel()[0] * 1e-9:.2f}"
    yield "C: Hertz pressure of the baseline (GPa)", "1.77", pressure, pressure


def gears_of_the_two_disc_paper() -> Iterator[Row]:
    """Mesh parameters of the 28-tooth gears at 1200 rpm and 900 inch-lb, which are those of the NASA rig."""
    pair = read_case(HERE / "nasa_rig", need_recordings=False).rig.gears
    speed, torque = 1200.0 * np.pi / 30.0, 900.0 * 0.1129848
    places = np.array([pair.path_start, pair.pitch_point]) / pair.base_radius[0]
    ends = at_roll_angle(pair, RigidSharing(), places)
    line = np.array(torque / pair.base_radius[0] / pair.face_width)
    pressure = line_hertz_pressure(line, ends.radius[-1], np.array(pair.reduced_modulus))
    inch = 39.370079 * speed
    numbers = (
        ("mean rolling speed where contact begins (inch/s)", "75.2", ends.entrainment_per_speed[0] * inch, "{:.1f}"),
        ("sliding speed there (inch/s)", "76.0", abs(ends.sliding_per_speed[0]) * inch, "{:.1f}"),
        ("radius of curvature at the pitch point (inch)", "0.599", 2.0 * ends.radius[-1] * 39.370079, "{:.3f}"),
        ("Hertz pressure at the pitch point (ksi)", "200", pressure / 6.894757e6, "{:.0f}"),
    )
    for stated, paper, value, form in numbers:
        yield f"C: {stated}", f"{paper} (calculated)", form.format(value), form.format(value)


def measured_efficiency() -> Iterator[Row]:
    """Tooth efficiency of the measured 40-tooth gears: the base model, and Xu and Kahraman's regression."""
    file = HERE / "measured_gear.toml"
    raw = toml_file.read_toml(file)
    found = []
    for options in ({}, {"friction": "xu_kahraman"}):
        study = read_study(file, toml_file.parse(StudyFile, {**raw, "options": options}, str(file)))
        loss = run_study(study).to_xarray()["mesh_loss_W"].to_numpy().ravel()
        found.append(100.0 * (1.0 - loss / INPUT_POWER))
    measured = 100.0 * (1.0 - MEASURED_LOSS / INPUT_POWER)
    texts = [f"{one.min():.2f} to {one.max():.2f} %" for one in found]
    yield "D: tooth efficiency of spur gears, 2000 to 10000 rpm", "well over 99 %", *texts
    away = [f"{np.abs(one - measured).max():.2f} points" for one in found]
    yield "D: largest difference to measured efficiency", "within 0.1 points", *away


INPUT_POWER = 413.0 * np.pi / 30.0 * np.array([2000.0, 4000.0, 6000.0, 8000.0, 10000.0])
MEASURED_LOSS = np.array([170.0, 303.0, 478.0, 619.0, 555.0])
"""W; `measured_gear.md` says how it follows from what is printed."""


def every() -> Iterator[Row]:
    """All rows of the first table."""
    for rows in (fast_gears, loss_factors, nasa_rig, two_discs, gears_of_the_two_disc_paper, measured_efficiency):
        yield from rows()


def page() -> str:
    """The table in its text."""
    text = (HERE / "text.md").read_text(encoding="utf-8")
    for word, rows in (("ROWS", every()), ("BAND", band())):
        text = text.replace(word, "\n".join("| " + " | ".join(row) + " |" for row in rows))
    return text


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out/published/points.md"), help="page to write")
    arguments = parser.parse_args()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(page(), encoding="utf-8")
    print(arguments.out)
