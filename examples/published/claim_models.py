"""Numbers for the claims of four papers: formulas and full solutions, at every end of what the papers do not print."""

from __future__ import annotations

import runpy
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.base_model.balanced import balanced
from mixedlub.case.folder import Case, read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.model import Chain, Model
from mixedlub.chain.slots import MIXTURE
from mixedlub.full_base.box import CONDITIONS, Box, needed, union
from mixedlub.full_base.chain import matter_of, with_full_base
from mixedlub.full_base.emulator import Emulator
from mixedlub.full_base.store import emulator
from mixedlub.full_base.words import FULL_INPUTS
from mixedlub.rig.rig import Rig
from mixedlub.schema import toml_file
from mixedlub.schema.table import Table
from mixedlub.study import Study, read_study
from mixedlub.study.batch import blocks, compute
from mixedlub.study.options import study_chain
from mixedlub.study.schema import Options, StudyFile

HERE = Path(__file__).parent
POINTS: Mapping[str, Any] = runpy.run_path(str(HERE / "points.py"))
Choice = Mapping[str, Any]
NOMINAL: Choice = {
    "pressure viscosity": 1.0,
    "boundary friction": 0.1,
    "cut-off": 2.5,
    "relief": False,
    "slopes": 1.0,
    "viscosity": 1.0,
}
"""Factor on the pressure-viscosity coefficient, boundary friction, short cut-off (µm), 30 µm of tip relief over 6 mm of
elastic teeth, factor on slopes and curvatures, factor on the viscosity of fluid A and its inverse on fluid B."""
OPEN: Mapping[str, tuple[Any, Any]] = {
    "pressure viscosity": (10.0 / 14.2, 15.0 / 14.2),
    "boundary friction": (0.05, 0.1),
    "cut-off": (2.5, 25.0),
    "relief": (False, True),
    "slopes": (0.7, 1.4),
    "viscosity": (0.5, 2.0),
}
"""Ends of what the papers do not print."""
OF_PAPER = {
    "A": ("pressure viscosity", "boundary friction", "cut-off", "relief", "slopes"),
    "B": ("boundary friction", "cut-off", "slopes"),
    "C": ("viscosity", "boundary friction", "slopes"),
    "D": ("boundary friction", "slopes"),
}
"""What is open, by paper: B prints its coefficient, and one pair of teeth carries the load there; C states moments, and
its print has lost the viscosities; D states moments, coefficient and no relief."""
MODELS = ("formulas", "full", "formulas, yielding", "full, yielding")
"""Film and film friction by formulas or full solutions; yielding: flattened waves, with film and asperities that share
the load."""
YIELDING = {"flattening": "waves", "balance": "johnson_greenwood_poon", "mixture": "load_weighted"}
COUNTS = {"high_speed": 128, "nasa": 192, "measured_gear": 128}
"""Cost limit. Solutions of an emulator, a fifth of the usual number."""

# Paper A: helical gears of two geometries


PLACES = 24
"""Cost limit. Points along the path of contact, half as many as in a study."""
OF_SURFACES = ("m0", "m2", "m4", "height_share", "slope_share", "curvature_share", "mean_over_rms")
OF_SURFACES += ("first_waves", "second_waves", "solid_conductivity", "solid_density", "solid_heat_capacity")
"""Inputs that follow from the flanks, and not from teeth, oil and conditions."""


@cache
def _study(name: str, cutoff: float, yielding: bool, relief: bool = False) -> Study:
    """Gears of a file, with both finishes where it has two."""
    file = HERE / f"{name}.toml"
    raw = toml_file.read_toml(file)
    if name.startswith("high_speed"):
        for section in raw["surfaces"].values():
            section["short_cutoff_um"] = cutoff
        if relief:
            raw["gears"]["load_sharing"] = {
                "model": "ldp",
                "tip_relief_um": [30.0, 30.0],
                "relief_length_mm": [6.0, 6.0],
            }
    raw["options"] = {"path_points": PLACES, **(YIELDING if yielding else {})}
    return read_study(file, toml_file.parse(StudyFile, raw, str(file)))


def _of_plan(name: str, choice: Choice, yielding: bool, full: Emulator | None, wanted: str) -> np.ndarray:
    """A result at all conditions of the gears of a file, with moved inputs."""
    plan = _study(name, choice["cut-off"], yielding).plan
    inputs, points = dict(plan.inputs), plan.points
    if choice["relief"]:
        teeth = _study(name, NOMINAL["cut-off"], False, True).plan
        inputs |= {key: value for key, value in teeth.inputs.items() if key not in OF_SURFACES}
        points = teeth.points
    inputs |= {"boundary_friction": choice["boundary friction"]}
    inputs["pressure_viscosity"] = inputs["pressure_viscosity"] * choice["pressure viscosity"]
    inputs |= {key: inputs[key] * choice["slopes"] ** 2 for key in ("m2", "m4")}
    inputs |= {} if full is None else {**FULL_INPUTS, "entering_stress": inputs["eyring_stress"]}
    moved = replace(plan, inputs=inputs, points=points, full=full)
    (block,) = blocks(moved)
    return np.asarray(compute(moved, block)[wanted])


def _box(study: Study) -> Box:
    given = study.plan.inputs
    want = [name for name in (*CONDITIONS, "line_load") if name not in given]
    return needed({**given, **Model(study_chain(Options()), tuple(given), want)(given)})


@cache
def _high_speed() -> Emulator:
    """Solutions of both geometries, over the band of the pressure-viscosity coefficient."""
    studies = [_study(f"high_speed_gears_{g}", 2.5, False) for g in "ab"]
    box = {**union(map(_box, studies)), "pressure_viscosity": OPEN["pressure viscosity"]}
    return emulator(matter_of(studies[0].oil, studies[0].plan.inputs), box, COUNTS["high_speed"])[0]


def of_a(choice: Choice, full: bool, yielding: bool) -> list[float]:
    """The claims of paper A: axes oil temperature, torque, speed."""
    solved = _high_speed() if full else None
    found = [_of_plan(f"high_speed_gears_{g}", choice, yielding, solved, "mean_friction") for g in "ab"]
    (a, _, _), (b, _, smooth) = found
    ratios = (
        b[..., -1].mean() / b[..., 0].mean(),
        smooth[..., -1].mean() / smooth[..., 0].mean(),
        smooth.mean() / b.mean(),
        b[1, 0].mean() / a[1, 0].mean(),
        a[1, 1].mean() / a[1, 0].mean(),
        a[2, 0].mean() / a[0, 0].mean(),
    )
    return [100.0 * (float(one) - 1.0) for one in ratios]


# Paper B: friction at roll angles of spur gears


@cache
def _nasa(cutoff: float, yielding: bool) -> Forward:
    case = read_case(HERE / "nasa_rig", need_recordings=False)
    section = case.system.surfaces["ground"].model_copy(update={"short_cutoff_um": cutoff})
    chosen = {"surfaces": {"ground": section}, "flattening": YIELDING["flattening"] if yielding else "none"}
    return Forward(_altered(case, chosen), _single_contact(case))


def _altered(case: Case, changes: Mapping[str, Any]) -> Case:
    system = case.system.model_copy(update=changes)
    return replace(case, system=system, rig=Rig(system, case.folder, case.rig.unread_of_oil))


def _single_contact(case: Case) -> Table:
    """Roll angles of single contact at both speeds and both torques."""
    single = np.degrees(_angles(case))
    rows = list(product(POINTS["SPEEDS"], POINTS["LOADS"]))
    count = len(rows) * single.size
    return Table(
        {
            "run": np.arange(count),
            "torque_Nm": np.repeat([POINTS["FULL_TORQUE"] * load for _, load in rows], single.size),
            "speed_rpm": np.repeat([speed for speed, _ in rows], single.size),
            "oil_temperature_C": np.full(count, 70.0),
            "pinion_surface": np.full(count, "ground"),
            "gear_surface": np.full(count, "ground"),
            "roll_angle_deg": np.tile(single, len(rows)),
        }
    )


def _angles(case: Case) -> np.ndarray:
    pair = case.rig.gears
    return np.linspace(pair.lowest_single_contact, pair.highest_single_contact, 41) / pair.base_radius[0]


@cache
def _of_nasa() -> Emulator:
    forward = _nasa(2.5, False)
    want = [name for name in (*CONDITIONS, "line_load") if name not in forward.inputs]
    box = needed({**forward.inputs, **Model(forward.chain, tuple(forward.inputs), want)(forward.inputs)})
    return emulator(matter_of(forward.case.rig.oil(), forward.inputs), box, COUNTS["nasa"])[0]


def _chain(base: Chain, full: Emulator | None, yielding: bool) -> Chain:
    """Chain of a case with shared load and full solutions."""
    if yielding:
        weighted = MIXTURE.choices[YIELDING["mixture"]].law
        base = balanced(tuple((name, weighted if name == MIXTURE.quantity else law) for name, law in base))
    return base if full is None else with_full_base(base, full)


def _moved(inputs: Mapping[str, Any], choice: Choice) -> dict[str, Any]:
    """Inputs of a case with the choices made."""
    moved = {name: inputs[name] * choice["slopes"] ** 2 for name in ("m2", "m4")}
    own = {"boundary_friction": choice["boundary friction"], "entering_stress": inputs["eyring_stress"]}
    return {**inputs, **moved, **own, **FULL_INPUTS}


def of_b(choice: Choice, full: bool, yielding: bool) -> list[float]:
    """The claims of paper B."""
    forward = _nasa(choice["cut-off"], yielding)
    inputs = _moved(forward.inputs, choice)
    chain = _chain(forward.chain, _of_nasa() if full else None, yielding)
    found = Model(chain, tuple(inputs), ("friction", "film_thickness"))(inputs)
    shape = (len(POINTS["SPEEDS"]), len(POINTS["LOADS"]), -1)
    mu, film = (np.broadcast_to(found[name], (len(forward.table), 1)).reshape(shape) for name in found)
    largest = mu.max(axis=-1)
    angles = _angles(forward.case)
    away = np.abs(angles - forward.case.rig.gears.pitch_point / forward.case.rig.gears.base_radius[0])
    middle, ends = away <= np.quantile(away, 0.1), away >= np.quantile(away, 0.9)
    return [
        float(largest[0].mean()),
        float(largest[1].mean()),
        100.0 * (float(np.mean(largest[:, 1] / largest[:, 0])) - 1.0),
        float(mu[0][:, middle].mean() / mu[0][:, ends].mean()),
        1e6 * float(film[1, 1, film.shape[-1] // 2]),
    ]


# Paper C: two crowned discs, whose point contacts have no full solutions


@cache
def _discs() -> tuple[Forward, Forward]:
    base, sweeps = POINTS["DISC_BASE"], POINTS["SWEEPS"][:3]
    at = [base, *(base | {name: end} for *_, name, ends in sweeps for end in ends)]
    columns = {name: np.array([one[name] for one in at]) for name in base}
    surfaces = dict.fromkeys(("surface_1", "surface_2"), np.full(len(at), "disc"))
    rows = Table({"run": np.arange(len(at)), **columns, **surfaces})
    cases = (read_case(HERE / "two_discs" / fluid, need_recordings=False) for fluid in ("fluid_a", "fluid_b"))
    first, second = (Forward(case, rows) for case in cases)
    return first, second


def of_c(choice: Choice, full: bool, yielding: bool) -> list[float]:
    """The claims of paper C; NaN for line contacts' models."""
    if full or yielding:
        return [np.nan] * 4
    mu = []
    for forward, way in zip(_discs(), (1.0, -1.0), strict=True):
        inputs = _moved(forward.inputs, choice)
        inputs["viscosity"] = inputs["viscosity"] * choice["viscosity"] ** way
        mu.append(np.ravel(Model(forward.chain, tuple(inputs), ("friction",))(inputs)["friction"]))
    a, b = mu
    return [float(a[0] / b[0]), *(100.0 * float(a[2 + 2 * n] / a[1 + 2 * n] - 1.0) for n in range(3))]


# Paper D: spur gears of measured loss


@cache
def _measured() -> Emulator:
    study = _study("measured_gear", 2.5, False)
    return emulator(matter_of(study.oil, study.plan.inputs), _box(study), COUNTS["measured_gear"])[0]


def of_d(choice: Choice, full: bool, yielding: bool) -> list[float]:
    """The claims of paper D."""
    loss = np.ravel(_of_plan("measured_gear", choice, yielding, _measured() if full else None, "mesh_loss"))
    power = POINTS["INPUT_POWER"]
    found, measured = 100.0 * (1.0 - loss / power), 100.0 * (1.0 - POINTS["MEASURED_LOSS"] / power)
    worst = np.argmax(np.abs(found - measured))
    return [float(found.min()), float((found - measured)[worst])]


OF: Mapping[str, Callable[[Choice, bool, bool], list[float]]] = {"A": of_a, "B": of_b, "C": of_c, "D": of_d}


def computed(claims: Mapping[str, Sequence[str]]) -> Iterator[dict[str, Any]]:
    """A row for each claim and model: value, ends of the band, and largest move by each number that is open alone.

    ``claims``: words of the claims of each paper, in the order of its function.
    """
    for paper, words in claims.items():
        for model in MODELS:
            full, yielding = model.startswith("full"), model.endswith("yielding")

            def at(moved: Choice, of: Any = OF[paper], full: bool = full, yielding: bool = yielding) -> list[float]:
                with np.errstate(all="ignore"):
                    return list(of({**NOMINAL, **moved}, full, yielding))

            value = at({})
            corners = [at(dict(zip(OF_PAPER[paper], one, strict=True))) for one in product(*_ends(paper))]
            alone = {name: [at({name: end}) for end in OPEN[name]] for name in OF_PAPER[paper]}
            for number, claim in enumerate(words):
                each = [value[number], *(one[number] for one in corners)]
                row = {"paper": paper, "claim": claim, "model": model, "value": value[number]}
                row |= {"low": min(each), "high": max(each)}
                for name, ends in alone.items():
                    moves = [one[number] - value[number] for one in ends]
                    row[name] = max(moves, key=abs)
                yield row


def _ends(paper: str) -> list[tuple[Any, Any]]:
    return [OPEN[name] for name in OF_PAPER[paper]]
