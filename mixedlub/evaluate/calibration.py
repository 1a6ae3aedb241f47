"""Fit of the local friction law of Löpenhaus to measured load-dependent gear loss."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field, field_validator

from mixedlub import friction
from mixedlub.evaluate.evaluation import (
    BEYOND_VISCOSITY,
    Curve,
    Evaluated,
    Evaluation,
    Panel,
    check_surfaces,
    file_name,
)
from mixedlub.evaluate.load_stages import COMMON, OWN
from mixedlub.evaluate.loss_fit import Contacts, Fit, Scatter, calibrated, contacts_of
from mixedlub.evaluate.result_columns import CALIBRATION
from mixedlub.gear import at_roll_angle, local_loss_factor, mesh
from mixedlub.kinds import columns
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import mean_assumed
from mixedlub.schema.findings import collected, report
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.section import Number, key
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears, RigFile
from mixedlub.schema.table import RUN, Column, Table, read_table
from mixedlub.schema.toml_file import named_file
from mixedlub.solutions.law_file import friction_file
from profiles.errors import InputError, nearest

SOURCE = (
    '"Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s", '
    "equation 9, figures 8 and 9"
)
LAW = friction.find("loepenhaus")
BAND = 0.25
"""Relative half width of the band about equal friction in the source."""
FACTOR = "surface_factor"
LOSS_SD, SERIES_SD = "load_dependent_loss_W_sd", "load_dependent_loss_W_sd_series"
Ends = tuple[Number, Number]


class CalibrationFile(RigFile):
    """Input file: gears, oil, surfaces, measured losses and free coefficients."""

    schema_: Literal["mixedlub-calibration/1"] = key(
        "format of the file", example="mixedlub-calibration/1", alias="schema"
    )
    title: str = key("title of the figures", "Calibrated friction", example="High-speed gears B")
    readings: str = key("table of the losses, relative to this file", example="readings.csv")
    coefficients: dict[str, Number] = key(
        "NAME = VALUE: coefficients that are known; `mixedlub friction-laws loepenhaus` says what they are",
        {},
        example={"c3": 0.0, "c4": 0.0, "c5": 0.0, "c6": 1.0},
    )
    bounds: Annotated[dict[str, Ends], Field(min_length=1)] = key(
        "NAME = [LOW, HIGH]: coefficients that the losses determine", example={"c1": [1e-3, 1.0], "c2": [-1.0, 0.5]}
    )
    surface_factor_bounds: dict[str, Ends] = key(
        "SURFACE = [LOW, HIGH]: surfaces with a factor of their own; 1 for the others",
        {},
        example={"superfinished": [0.3, 1.5]},
    )
    calculated_loss_sd: Annotated[Number, Field(ge=0.0, lt=1.0)] = key(
        "of the calculated loss, relative and common to all readings: torque meter and load sharing", 0.0, example=0.02
    )
    gears: Gears = key("the gear pair and its load sharing")
    lubricant: Lubricant = key("the oil, whose viscosity the law reads")
    surfaces: dict[str, SurfaceSection] = key("one table a surface, whose mean roughness the law reads")

    @field_validator("bounds", "surface_factor_bounds")
    @classmethod
    def _rise(cls, bounds: dict[str, Ends]) -> dict[str, Ends]:
        for name, (low, high) in bounds.items():
            if not low < high:
                raise ValueError(f"{name}: the first bound, {low:g}, must be below the second, {high:g}")
        return bounds


COLUMNS = (
    RUN,
    columns.TORQUE,
    columns.SPEED,
    columns.OIL_TEMPERATURE,
    Column("bulk_temperature_C", at_least=-60.0, at_most=400.0, required=False, meaning="of the teeth, for viscosity"),
    Column("load_dependent_loss_W", above=0.0, meaning="of the mesh, without the loss at zero load"),
    Column(
        LOSS_SD, above=0.0, required=False, meaning="its standard deviation, where no column says what readings share"
    ),
    Column(OWN, above=0.0, required=False, meaning="its standard deviation from reading to reading"),
    Column(COMMON, at_least=0.0, at_most=1.0, required=False, meaning="relative; of one error common to all readings"),
    Column("series", "name", required=False, meaning="readings with one load-independent loss, whose error they share"),
    Column(SERIES_SD, above=0.0, required=False, meaning="of that error; without it the readings tell it"),
    Column("pinion_surface", "name", meaning="a surface of the file"),
    Column("gear_surface", "name", meaning="a surface of the file"),
)


def _checked(file: CalibrationFile, table: Table) -> None:
    """Raise an error for missing, unknown or doubly given coefficients and for surfaces without effect on the law."""
    known = [c.name for c in LAW.coefficients if c.name != FACTOR]
    for name in file.bounds:
        if name not in known:
            raise InputError(f"no such coefficient; {nearest(name, known)}", where="bounds", value=name)
        if name in file.coefficients:
            raise InputError("is fixed in coefficients too; leave it out of one of them", where=f"bounds.{name}")
    if FACTOR in file.coefficients:
        raise InputError("belongs in surface_factor_bounds", where=f"coefficients.{FACTOR}")
    ends = dict.fromkeys(file.bounds, 0.0)
    LAW.check_given({**file.coefficients, **ends}, "coefficients", f"mixedlub friction-laws {LAW.name}")
    check_surfaces(file.surfaces, file.surface_factor_bounds, "surface_factor_bounds")
    for name in ("pinion_surface", "gear_surface"):
        check_surfaces(file.surfaces, table[name], f"{table.source}: {name}")
    mixed = (table["pinion_surface"] != table["gear_surface"]) & (
        np.isin(table["pinion_surface"], list(file.surface_factor_bounds))
        | np.isin(table["gear_surface"], list(file.surface_factor_bounds))
    )
    if mixed.any():
        row = int(np.argmax(mixed))
        place = f"{table.source}, run {table['run'][row]}: gear_surface"
        rule = "a surface with a factor must be on both wheels; on the pinion is " + str(table["pinion_surface"][row])
        raise InputError(rule, where=place, value=str(table["gear_surface"][row]))


def _roughness(rig: Rig, table: Table) -> np.ndarray:
    """Mean Ra of both flanks of each reading (m)."""
    surfaces = [rig.surface(name) for name in sorted({*table["pinion_surface"], *table["gear_surface"]})]
    for one in mean_assumed(surfaces):
        report(one)
    ra = {one.name: one.mean_roughness for one in surfaces}
    first, second = (np.array([ra[n] for n in table[f"{side}_surface"]]) for side in ("pinion", "gear"))
    return np.asarray(0.5 * (first + second))


def _scatter(file: CalibrationFile, table: Table) -> Scatter:
    """Errors of the losses from the table; proportional to the loss if the table has none."""
    own = next((name for name in (OWN, LOSS_SD) if name in table), None)
    if SERIES_SD in table and "series" not in table:
        raise InputError("needs the column 'series'", where=table.source, value=SERIES_SD)
    shared = [name for name in (COMMON, "series", SERIES_SD) if name in table]
    if own == LOSS_SD and shared:
        rule = f"needs the column {OWN} in place of {LOSS_SD}, which contains what readings share"
        raise InputError(rule, where=table.source, value=shared[0])
    stated = [name for name in shared if name != "series"]
    stated += ["calculated_loss_sd"] if file.calculated_loss_sd else []
    if own is None and stated:
        raise InputError(f"needs the column {OWN} beside it", where=table.source, value=stated[0])
    common = np.full(len(table), file.calculated_loss_sd)
    common = np.hypot(common, table[COMMON]) if COMMON in table else common
    series, series_sd = (table.columns.get(name) for name in ("series", SERIES_SD))
    return Scatter(table[own or "load_dependent_loss_W"], common, own is not None, series, series_sd)


def run(file: CalibrationFile, path: Path) -> Evaluated:
    """Fit the coefficients; compare calculated with measured friction and write a law for each surface."""
    table = read_table(named_file(path.parent, file.readings, "readings"), COLUMNS)
    _checked(file, table)
    rig = Rig(file, path.parent, BEYOND_VISCOSITY)
    with collected() as findings:
        pair, shared, oil, roughness = rig.gears, rig.sharing, rig.oil(), _roughness(rig, table)
    warm = table["bulk_temperature_C"] if "bulk_temperature_C" in table else table["oil_temperature_C"]
    kelvin = warm + ZERO_CELSIUS
    nu = oil.viscosity(kelvin) / oil.density(kelvin)
    omega, torque = table["speed_rpm"] * np.pi / 30.0, table["torque_Nm"]
    points = mesh(pair, shared)
    contacts = contacts_of(points, torque, omega, nu, roughness)
    fixed = LAW.values(file.coefficients)
    free = {**file.bounds, **{f"{FACTOR}.{name}": ends for name, ends in file.surface_factor_bounds.items()}}
    loss, surfaces = table["load_dependent_loss_W"], table["pinion_surface"]
    fit = calibrated(contacts, loss, _scatter(file, table), fixed, free, surfaces)
    power = torque * omega * local_loss_factor(points, torque)
    readings = _readings(table, fit, power, omega * pair.operating_radius[0])
    tables = {
        "coefficients": _coefficients(file, fit, free, fixed),
        "readings": readings,
        "fit": _quality(readings, fit),
        "correlations": fit.correlations,
    }
    local = _local(rig, file, table, fit, fixed, contacts)
    notes = [str(one) for one in dict.fromkeys(findings)]
    notes += [f"{name} is at a bound: it has no interval, and the others hold for that value" for name in fit.at_bound]
    files = {
        f"friction_{file_name(name)}.toml": _law_text(file, fit, fixed, name, tables["fit"]) for name in file.surfaces
    }
    drawn = {"calculated_over_measured": (_agreement(readings),), "local_friction": (local,)}
    return Evaluated(file.title, tables, drawn, tuple(_lines(tables)), tuple(notes), files=files)


def _coefficients(
    file: CalibrationFile, fit: Fit, free: Mapping[str, Ends], fixed: Mapping[str, float]
) -> pd.DataFrame:
    """Table of coefficients, the free ones first with interval and bounds."""
    rows: list[dict[str, Any]] = []
    for (name, value), sd, half in zip(fit.values.items(), fit.sd, fit.half_width, strict=True):
        low, high = free[name]
        status = "at a bound" if name in fit.at_bound else "free"
        row = {"coefficient": name, "status": status, "value": value, "sd": sd}
        rows.append(row | {"low90": value - half, "high90": value + half, "low_bound": low, "high_bound": high})
    known = {name: value for name, value in fixed.items() if name not in free and name != FACTOR}
    return pd.DataFrame(rows + [{"coefficient": n, "status": "fixed", "value": v} for n, v in known.items()])


def _readings(table: Table, fit: Fit, power: np.ndarray, speed: np.ndarray) -> pd.DataFrame:
    """Table of readings: measured and calculated loss and mean friction."""
    measured, names = table["load_dependent_loss_W"], ("torque_Nm", "speed_rpm", "oil_temperature_C")
    found = {name: table[name] for name in ("run", *names, "pinion_surface", "gear_surface")}
    found |= {"pitch_line_velocity_m_s": speed, "load_dependent_loss_W": measured}
    found |= {"calculated_load_dependent_loss_W": fit.loss, "mean_friction": measured / power}
    found |= {"calculated_mean_friction": fit.loss / power, "calculated_over_measured": fit.loss / measured}
    return pd.DataFrame(found).assign(within_25_percent=np.abs(fit.loss / measured - 1.0) <= BAND)


def _quality(readings: pd.DataFrame, fit: Fit) -> pd.DataFrame:
    """Coefficients of determination of loss and mean friction, band and scatter, in one row."""
    rms = float(np.sqrt(np.mean((readings["calculated_over_measured"] - 1.0) ** 2)))
    row = {
        "readings": len(readings),
        "free_coefficients": len(fit.values),
        "r_squared_of_loss": _determination(readings, "load_dependent_loss_W"),
        "r_squared_of_mean_friction": _determination(readings, "mean_friction"),
        "within_25_percent": float(readings["within_25_percent"].mean()),
        "rms_of_ratio": rms,
        "chi_square": fit.chi_square,
        "degrees_of_freedom": fit.freedom,
    }
    return pd.DataFrame([row])


def _determination(readings: pd.DataFrame, name: str) -> float:
    measured, calculated = readings[name], readings[f"calculated_{name}"]
    return float(1.0 - ((measured - calculated) ** 2).sum() / ((measured - measured.mean()) ** 2).sum())


def _law_text(file: CalibrationFile, fit: Fit, fixed: Mapping[str, float], surface: str, quality: pd.DataFrame) -> str:
    values = {name: value for name, value in fit.values.items() if "." not in name}
    factor = fit.values.get(f"{FACTOR}.{surface}", 1.0)
    oil = file.lubricant.oil or file.lubricant.name or "the oil"
    about = f"Friction of gears with flanks {surface}.\nWritten by `mixedlub evaluate calibration`."
    stated = {str(name): float(value) for name, value in quality.iloc[0].to_dict().items()}
    return friction_file("loepenhaus", oil, about, stated, {**fixed, **values, FACTOR: factor})


def _agreement(readings: pd.DataFrame) -> Panel:
    """Figure 8 of the source: calculated over measured mean friction, with the band of 25 %."""
    ends = np.array([0.0, 1.1 * float(readings[["mean_friction", "calculated_mean_friction"]].to_numpy().max())])
    speeds = readings["pitch_line_velocity_m_s"].round(1)
    measured, calculated = (readings[n].to_numpy() for n in ("mean_friction", "calculated_mean_friction"))
    curves = [
        Curve(measured[speeds == speed], calculated[speeds == speed], f"{speed:g} m/s", marker=True, group=group)
        for group, speed in enumerate(np.unique(speeds))
    ]
    curves += [Curve(ends, ends * factor) for factor in (1.0, 1.0 + BAND, 1.0 - BAND)]
    return Panel("measured mean friction coefficient (-)", "calculated mean friction coefficient (-)", tuple(curves))


PLACES = 121
"""Points of the figure along the path of contact."""


def _local(
    rig: Rig, file: CalibrationFile, table: Table, fit: Fit, fixed: Mapping[str, float], contacts: Contacts
) -> Panel:
    """Figure 9 of the source: local friction along the path of contact at the median torque, by speed."""
    pair = rig.gears
    angle = np.linspace(pair.path_start, pair.path_end, PLACES) / pair.base_radius[0]
    points = at_roll_angle(pair, rig.sharing, angle, slices=1)
    middle = np.sort(table["torque_Nm"])[len(table) // 2]
    rows = np.flatnonzero((table["torque_Nm"] == middle) & (table["pinion_surface"] == table["pinion_surface"][0]))
    _, first = np.unique(table["speed_rpm"][rows], return_index=True)
    rows = rows[first]
    omega = table["speed_rpm"][rows] * np.pi / 30.0
    nu, roughness = (one[rows, 0] for one in (contacts.kinematic_viscosity, contacts.mean_roughness))
    here = contacts_of(points, table["torque_Nm"][rows], omega, nu, roughness)
    values = {name: value for name, value in fit.values.items() if "." not in name}
    factor = np.full(rows.size, fit.values.get(f"{FACTOR}.{table['pinion_surface'][0]}", 1.0))
    found = here.friction({**fixed, **values}, factor)
    speed = omega * pair.operating_radius[0]
    curves = (Curve(np.degrees(angle), y, f"{v:.3g} m/s", group=g) for g, (y, v) in enumerate(zip(found, speed)))
    return Panel("roll angle of the pinion (deg)", f"local friction coefficient at {middle:.4g} N m (-)", tuple(curves))


def _lines(tables: Mapping[str, pd.DataFrame]) -> Iterator[str]:
    fit = tables["fit"].iloc[0]
    yield (
        f"{fit['readings']:.0f} readings: R² {100 * fit['r_squared_of_loss']:.2f} % of the loss, "
        f"{100 * fit['r_squared_of_mean_friction']:.2f} % of mean friction; {100 * fit['within_25_percent']:.3g} % of "
        "them within 25 %"
    )
    for row in tables["coefficients"].to_dict("records"):
        if row["status"] == "free":
            yield f"{row['coefficient']} {row['value']:.4g} (90 %: {row['low90']:.4g} to {row['high90']:.4g})"
        elif row["status"] != "fixed":
            yield f"{row['coefficient']} {row['value']:.4g} (at a bound)"


EVALUATION = Evaluation(
    name="calibration",
    about="load-dependent loss of gears into the coefficients of Löpenhaus' local friction law",
    source=SOURCE,
    file=CalibrationFile,
    columns={"the readings": COLUMNS},
    run=run,
    results=CALIBRATION,
    example={
        "schema": "mixedlub-calibration/1",
        "title": "High-speed gears B",
        "readings": "readings.csv",
        "coefficients": {"c3": 1e-4, "c4": 0.0, "c5": 0.003, "c6": 1.0, "c7": 0.25, "c8": 0.1, "c9": 0.02},
        "bounds": {"c1": [1e-3, 1.0], "c2": [-1.0, 0.5]},
        "surface_factor_bounds": {"superfinished": [0.3, 1.5]},
        "gears": {"preset": "high_speed_b"},
        "lubricant": {
            "temperature_C": [80.0, 120.0],
            "kinematic_viscosity_mm2_s": [7.4, 3.7],
            "density_15C_kg_m3": 1000.0,
            "density_change_per_K": 7e-4,
        },
        "surfaces": {
            "ground": {"m0_um2": 0.16, "m2": 0.0031, "m4_per_um2": 0.0021},
            "superfinished": {"m0_um2": 0.01, "m2": 0.0008, "m4_per_um2": 0.0012},
        },
    },
)
