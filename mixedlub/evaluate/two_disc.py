"""Traction over load, speed, slide-to-roll ratio and temperature from the torque between two discs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field

from mixedlub.evaluate.evaluation import CaseDraft, Evaluated, Evaluation, Panel, case_draft, check_surfaces
from mixedlub.evaluate.outlying import check_repeats
from mixedlub.evaluate.result_columns import TWO_DISC
from mixedlub.evaluate.uncertainty import Errors, combined, interval
from mixedlub.kinds import columns
from mixedlub.kinds.disc import reduced_radius
from mixedlub.laws import film
from mixedlub.laws.contact import (
    line_hertz_half_width,
    line_hertz_pressure,
    point_hertz_half_width,
    point_hertz_pressure,
    reduced_modulus,
)
from mixedlub.recording.set_points import near_values
from mixedlub.schema.findings import report
from mixedlub.schema.result import curve
from mixedlub.schema.section import Flag, Number, Section, key
from mixedlub.schema.system_file import Contact, RigFile
from mixedlub.schema.table import RUN, Column, Table, read_table
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

if TYPE_CHECKING:
    from mixedlub.evaluate.traction_fit import TractionFit

OIL_FILE = "oil.toml"
"""Definition. Oil file with a fitted traction part."""
SOURCE = "Vaishya and Houser 1999, AGMA 99FTMS1, section 3, tables 1 and 3, figures 2 and 3"
Share = Annotated[Number, Field(ge=0.0, lt=1.0)]
Size = Annotated[Number, Field(ge=0.0)]


class Meters(Section):
    torque_sd: Share = key("of the torque meter, relative; common to all readings", 0.005)
    torque_zero_sd_Nm: Size = key("of its zero; common to all readings", 0.01)
    torque_noise_Nm: Annotated[Number, Field(gt=0.0)] = key("of a torque, from reading to reading", 0.02)
    load_sd: Share = key("of the load cell, relative; common to all readings", 0.005)
    load_zero_sd_N: Size = key("of its zero; common to all readings", 0.5)
    torque_disc: Literal["first", "second"] = key(
        "disc on whose shaft the torque is measured",
        "first",
        values={"first": "of speed_1_rpm and the first radius", "second": "of speed_2_rpm and the second radius"},
    )
    drag: Literal["none", "both_signs"] = key(
        "torque that does not come from sliding, as of bearings",
        "none",
        values={
            "none": "not taken off",
            "both_signs": "mean of readings that differ in the sign of sliding alone; taken off both",
        },
    )


class TwoDiscFile(RigFile):
    """Input file: two discs, oil, surfaces and meters of the rig."""

    schema_: Literal["mixedlub-two-disc/1"] = key("format of the file", example="mixedlub-two-disc/1", alias="schema")
    title: str = key("title of the figures", "Two discs", example="Two crowned discs")
    readings: str = key("table of the readings, relative to this file", example="readings.csv")
    contact: Contact = key("the two discs")
    meters: Meters = key("standard deviations of the meters, and what the torque contains", Meters())
    traction_part: Flag = key(
        "fit Eyring stress and limiting stress of the oil over pressure and temperature to the readings, and write "
        "oil.toml with them",
        False,
        example=True,
    )


COLUMNS = (
    RUN,
    columns.LOAD,
    Column("speed_1_rpm", meaning="speed of the first disc, positive where it rolls with the second"),
    Column("speed_2_rpm", meaning="speed of the second disc"),
    Column("friction_torque_Nm", meaning="torque on one disc, positive where the first disc is held back"),
    columns.OIL_TEMPERATURE,
    Column("samples", "whole", at_least=1.0, required=False, meaning="samples that a reading is the mean of"),
    Column("surface_1", "name", required=False, meaning="a surface of the file, for the case"),
    Column("surface_2", "name", required=False, meaning="a surface of the file, for the case"),
)
TEMPERATURE = "oil_temperature_C"
SURFACES = ("surface_1", "surface_2")
CONDITIONS = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio", TEMPERATURE)
"""Conditions of a sweep, varied one at a time."""
LEAST_SWEPT = 3
"""Fewest levels of a condition in a sweep."""
SAME_RATIO = 0.02
"""Largest relative difference between slide-to-roll ratios of opposite sign in a pair."""


def motion(table: Table, radii_mm: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Entrainment speed (m/s) and slide-to-roll ratio, sliding over mean speed."""
    if not np.all(np.isfinite(radii_mm)):
        raise InputError("both discs need a finite radius", where="contact.radius_mm", value=radii_mm)
    first, second = (table[f"speed_{n}_rpm"] * np.pi / 30.0 * r * 1e-3 for n, r in zip((1, 2), radii_mm, strict=True))
    mean = 0.5 * (first + second)
    if np.any(mean <= 0.0):
        row = int(np.argmin(mean))
        place = f"{table.source}, run {table['run'][row]}: speed_1_rpm and speed_2_rpm"
        rule = "mean surface speed of the discs (m/s) must be above 0: they roll on each other"
        raise InputError(rule, where=place, value=float(mean[row]))
    return mean, (first - second) / mean


def drag_weights(levels: np.ndarray, ratio: np.ndarray, table: Table, *, wanted: bool) -> np.ndarray:
    """Weights (n, n) from measured to sliding torque; if ``wanted``, minus the mean of pairs of opposite sliding."""
    weights = np.eye(ratio.size)
    if not wanted:
        return weights
    for row in range(ratio.size):
        like = np.flatnonzero(
            (levels == levels[row]).all(axis=1) & (np.abs(ratio + ratio[row]) <= SAME_RATIO * abs(ratio[row]))
        )
        if like.size == 0:
            rule = f"no reading with the opposite slide-to-roll ratio, {-ratio[row]:.4g}, under the same conditions"
            raise InputError(rule, where=f"{table.source}, run {table['run'][row]}", value=float(f"{ratio[row]:.4g}"))
        weights[row, row] -= 0.5
        weights[row, like] -= 0.5 / like.size
    return weights


def traction(file: TwoDiscFile, table: Table, levels: np.ndarray, ratio: np.ndarray) -> tuple[np.ndarray, Errors]:
    """Friction coefficient against the sliding, torque over radius and load, and its errors."""
    meters = file.meters
    radius = file.contact.radius_mm[0 if meters.torque_disc == "first" else 1] * 1e-3
    samples = table["samples"] if "samples" in table else np.ones(len(table))
    sense = np.where(ratio >= 0.0, 1.0, -1.0)
    weights = drag_weights(levels, ratio, table, wanted=meters.drag == "both_signs") * sense[:, None]
    arm = radius * table["load_N"]
    value = weights @ table["friction_torque_Nm"] / arm
    noise = Errors(np.full(len(table), meters.torque_noise_Nm) / np.sqrt(samples)).budget(weights)["readings"] / arm
    zero = meters.torque_zero_sd_Nm * weights.sum(axis=1) / arm
    common = {
        "torque meter": value * meters.torque_sd,
        "zero of the torque": zero,
        "load cell": value * meters.load_sd,
        "zero of the load": value / table["load_N"] * meters.load_zero_sd_N,
    }
    return value, Errors(noise, common)


def hertz(contact: Contact, load: np.ndarray) -> dict[str, np.ndarray]:
    """Largest Hertz pressure and half width along the motion at each load."""
    first, second = contact.youngs_modulus_GPa
    modulus = np.array(reduced_modulus((first * 1e9, second * 1e9), contact.poisson_ratio))
    radius = np.array(reduced_radius(contact.radius_mm, "radius_mm"))
    if contact.geometry == "line":
        assert contact.width_mm is not None
        line = load / (contact.width_mm * 1e-3)
        found = line_hertz_pressure(line, radius, modulus), line_hertz_half_width(line, radius, modulus)
    else:
        across = radius
        if contact.transverse_radius_mm is not None:
            across = np.array(reduced_radius(contact.transverse_radius_mm, "transverse_radius_mm"))
        given = load, radius, across, modulus
        found = point_hertz_pressure(*given), point_hertz_half_width(*given)
    return {"hertz_pressure_MPa": found[0] * 1e-6, "hertz_half_width_um": found[1] * 1e6}


def of_pairs(file: TwoDiscFile, ratio: np.ndarray) -> np.ndarray:
    """Mask of independent readings: of two readings paired by opposite sliding, the positive reading."""
    return ratio > 0.0 if file.meters.drag == "both_signs" else np.ones(ratio.size, dtype=bool)


def sweeps(table: pd.DataFrame, levels: np.ndarray, independent: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Condition and rows of each sweep: independent readings that differ in this condition only."""
    value = table["friction_coefficient"].to_numpy()
    for number, name in enumerate(CONDITIONS):
        others = np.delete(levels, number, axis=1)
        for group in np.unique(others, axis=0):
            own = np.flatnonzero((others == group).all(axis=1))
            x = table[name].to_numpy()[own]
            usable = own[independent[own] & (value[own] > 0.0) & ((x != 0.0) | (name == TEMPERATURE))]
            if np.unique(levels[usable, number]).size >= LEAST_SWEPT:
                yield name, usable


def sweep_table(table: pd.DataFrame, found: list[tuple[str, np.ndarray]], errors: Errors) -> pd.DataFrame:
    """Exponent of friction over the swept condition, by weighted least squares.

    The exponent is d ln mu / d ln x; for temperature, the change of ln mu per kelvin. Errors common to all readings
    cancel, except errors of zeros.
    """
    value = table["friction_coefficient"].to_numpy()
    rows = []
    for name, own in found:
        x = table[name].to_numpy()[own]
        along = x if name == TEMPERATURE else np.log(np.abs(x))
        design = np.stack([np.ones(own.size), along], axis=1)
        relative = errors.independent[own] / value[own]
        weighted = design / relative[:, None]
        weights = np.linalg.solve(weighted.T @ weighted, weighted.T / relative)[1]
        shared = {label: moved[own] / value[own] for label, moved in errors.common.items()}
        sd = combined(Errors(relative, shared).budget(weights))
        held = {f"at_{other}": table[other].to_numpy()[own].mean() for other in CONDITIONS if other != name}
        row: dict[str, Any] = {"swept": name, "low": x.min(), "high": x.max(), "readings": own.size, **held}
        row |= {column: table[column].to_numpy()[own[0]] for column in SURFACES if column in table}
        slope = interval("exponent", weights @ np.log(value[own]), sd)
        rows.append(row | {k: float(v) for k, v in slope.items()} | {"largest_friction": value[own].max()})
    return pd.DataFrame(rows)


def run(file: TwoDiscFile, path: Path) -> Evaluated:
    """Evaluate traction and contact pressure of every reading, and the exponent of each sweep."""
    table = read_table(named_file(path.parent, file.readings, "readings"), COLUMNS)
    speed, ratio = motion(table, file.contact.radius_mm)
    surfaces = [name for name in SURFACES if name in table]
    conditions = {"load_N": table["load_N"], "entrainment_speed_m_s": speed, "slide_roll_ratio": ratio}
    conditions["oil_temperature_C"] = table["oil_temperature_C"]
    named = [np.unique(table[name], return_inverse=True)[1] for name in surfaces]
    levels = np.stack([*map(near_values, conditions.values()), *named], axis=1)
    pairs = np.delete(levels, CONDITIONS.index("slide_roll_ratio"), axis=1)
    value, errors = traction(file, table, pairs, ratio)
    channel = f"{table.source}, friction_torque_Nm over radius and load"
    check_repeats(value, errors.independent, levels, table["run"], channel)
    found: dict[str, Any] = {"run": table["run"], **{name: table[name] for name in surfaces}, **conditions}
    found |= {"sliding_speed_m_s": ratio * speed, **hertz(file.contact, table["load_N"])}
    found |= interval("friction_coefficient", value, errors.sd(np.eye(value.size)))
    frame = pd.DataFrame(found | {"friction_coefficient_sd_own": errors.independent})
    swept = list(sweeps(frame, levels, of_pairs(file, ratio)))
    tables = {"traction": frame, "sweeps": sweep_table(frame, swept, errors)}
    case = _case(file, path, table, frame, errors)
    notes = list(_notes(file, case))
    figures, lines = _figures(frame, swept, surfaces), tuple(_lines(frame, tables["sweeps"]))
    if not file.traction_part:
        return Evaluated(file.title, tables, figures, lines, tuple(notes), case)
    part = _traction_part(path, case)
    tables["traction_part"] = part.table
    files = {OIL_FILE: part.file}
    return Evaluated(file.title, tables, figures, (*lines, *part.lines), tuple(notes), case, files=files)


def _traction_part(path: Path, case: CaseDraft | None) -> TractionFit:
    """Traction part of the oil from the readings as a case."""
    from mixedlub.case.folder import case_of
    from mixedlub.evaluate.traction_fit import fitted_traction

    if case is None:
        rule = "needs [lubricant], [surfaces.NAME], and surface_1 and surface_2 in the readings"
        raise InputError(rule, where=f"{path}: traction_part")
    made = case_of(case.system, case.columns, name=path.name, folder=path.parent)
    found = fitted_traction(made, path.name)
    for one in found.findings:
        report(one)
    return found


def _notes(file: TwoDiscFile, case: CaseDraft | None) -> Iterator[str]:
    contact = file.contact
    if contact.geometry == "point" and contact.transverse_radius_mm is not None:
        across = reduced_radius(contact.transverse_radius_mm, "transverse_radius_mm")
        found = float(film.ellipticity(reduced_radius(contact.radius_mm, "radius_mm"), across))
        low, high = film.ELLIPTICITY
        if not low <= found <= high:
            yield f"ellipticity {found:.3g}: the film formula of the case holds from {low:g} to {high:g}"
    if file.meters.drag == "none":
        yield "nothing is taken off the torque; readings with both signs of sliding would separate the drag of bearings"
    if case is None:
        yield "no case folder: it needs [lubricant], [surfaces.NAME], and surface_1 and surface_2 in the readings"


def _lines(frame: pd.DataFrame, swept: pd.DataFrame) -> Iterator[str]:
    low, high = frame["friction_coefficient"].min(), frame["friction_coefficient"].max()
    yield f"{len(frame)} readings: friction {low:.4f} to {high:.4f}"
    for row in swept.to_dict("records"):
        unit = "change of ln friction per kelvin" if row["swept"] == TEMPERATURE else "exponent"
        where = f" on {row['surface_1']}" if "surface_1" in row else ""
        yield (
            f"{row['swept']} {row['low']:.4g} to {row['high']:.4g}{where}: {unit} {row['exponent']:.3g} "
            f"(sd {row['exponent_sd']:.2g}), largest friction {row['largest_friction']:.4f}"
        )


def _figures(
    frame: pd.DataFrame, swept: list[tuple[str, np.ndarray]], surfaces: list[str]
) -> dict[str, tuple[Panel, ...]]:
    words = ("load (N)", "entrainment speed (m/s)", "slide-to-roll ratio (-)", "oil temperature (°C)")
    pairs = frame[surfaces].agg(" / ".join, axis=1).to_numpy() if surfaces else np.full(len(frame), "")
    group = {pair: number for number, pair in enumerate(dict.fromkeys(pairs.tolist()))}
    drawn = []
    for name, across in zip(CONDITIONS, words, strict=True):
        curves = []
        for _, own in (one for one in swept if one[0] == name):
            rows = frame.iloc[own].sort_values(name)
            pair = str(pairs[own[0]])
            curves.append(curve(rows, name, "friction_coefficient", pair, marker=True, group=group[pair]))
        if curves:
            drawn.append(Panel(across, "friction coefficient (-)", tuple(curves)))
    return {"traction": tuple(drawn)} if drawn else {}


def _case(file: TwoDiscFile, path: Path, table: Table, frame: pd.DataFrame, errors: Errors) -> CaseDraft | None:
    """Case of two discs from the readings."""
    if file.lubricant is None or not file.surfaces or any(name not in table for name in SURFACES):
        return None
    for name in SURFACES:
        check_surfaces(file.surfaces, table[name], f"{table.source}: {name}")
    recorded = {"run": table["run"], **{name: frame[name].to_numpy() for name in CONDITIONS}}
    recorded |= {name: table[name] for name in SURFACES}
    recorded |= {"setup": np.full(len(table), "rig"), "friction_coefficient": frame["friction_coefficient"].to_numpy()}
    recorded["friction_coefficient_sd"] = errors.independent
    own = of_pairs(file, frame["slide_roll_ratio"].to_numpy())
    recorded = {name: values[own] for name, values in recorded.items()}
    zero = float(np.median(np.abs(errors.common["zero of the torque"])))
    recording = {
        "quantity": "friction_coefficient",
        "includes": "torque of the disc over its radius and load",
        "noise": {
            "setup_relative": float(np.hypot(file.meters.torque_sd, file.meters.load_sd)),
            "setup_absolute": zero,
        },
    }
    return case_draft(path, "disc", ("contact", "lubricant", "surfaces"), recording, recorded)


EVALUATION = Evaluation(
    name="two-disc",
    about="torque between two discs, cylinders or crowned, into traction over load, speed, sliding and temperature",
    source=SOURCE,
    file=TwoDiscFile,
    columns={"the readings": COLUMNS},
    run=run,
    results=TWO_DISC,
    example={
        "schema": "mixedlub-two-disc/1",
        "title": "Two crowned discs",
        "readings": "readings.csv",
        "contact": {
            "geometry": "point",
            "radius_mm": [25.4, 38.1],
            "transverse_radius_mm": [76.2, 76.2],
        },
        "lubricant": {"oil": "atf"},
        "surfaces": {"ground": {"m0_um2": 0.4, "m2": 0.0031, "m4_per_um2": 0.0021}},
        "meters": {"torque_zero_sd_Nm": 0.01, "torque_noise_Nm": 0.02},
    },
)
