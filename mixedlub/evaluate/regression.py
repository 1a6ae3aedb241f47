"""Friction law from measured traction by stepwise multiple regression."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd
from scipy.stats import norm

from mixedlub.evaluate.evaluation import BEYOND_VISCOSITY, Curve, Evaluated, Evaluation, Panel, file_name
from mixedlub.evaluate.result_columns import REGRESSION
from mixedlub.evaluate.two_disc import hertz
from mixedlub.friction.condensed import INPUTS, OIL
from mixedlub.kinds import columns
from mixedlub.kinds.disc import reduced_radius
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.build import lubricant
from mixedlub.rig.lubricant import Lubricant as Oil
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.section import Section, Whole, key
from mixedlub.schema.system_file import Contact, RigFile
from mixedlub.schema.table import RUN, Column, Table, read_table
from mixedlub.schema.toml_file import named_file
from mixedlub.solutions.law_file import friction_file
from mixedlub.solutions.least_squares import least_squares
from mixedlub.solutions.regression import Regression, design_of
from mixedlub.solutions.stepwise import (
    FEWEST,
    PER_TERM,
    is_determined,
    measured_regression,
    varied,
)
from profiles.errors import InputError

SOURCE = "H. Xu, PhD thesis, Ohio State University, 2005, chapter 3"
CHOSEN = (
    "the readings chose the terms: the intervals and p-values of terms would hold only had they been named beforehand"
)
BOTH, FIRST, SECOND = "both signs", "first faster", "second faster"
LEAST = 4 * PER_TERM
"""Judgement. Fewest readings of one sign of sliding for a separate law."""


class Choice(Section):
    terms: Literal["bic", "p-value"] = key(
        "how terms are chosen, step by step",
        "bic",
        values={
            "bic": "by the Bayesian information criterion",
            "p-value": "a term enters below 0.05 and leaves above 0.10",
        },
    )
    order: Whole = key("logarithms that a term has as factors, at most", 2, ge=1, le=3)
    signs: Literal["together", "each"] = key(
        "laws of which signs of sliding",
        "each",
        values={
            "together": "one law of both signs",
            "each": "one law of both signs, and one of each sign that has twenty readings",
        },
    )


class RegressionFile(RigFile):
    """Input file: two discs, their oil and measured traction."""

    schema_: Literal["mixedlub-regression/1"] = key(
        "format of the file", example="mixedlub-regression/1", alias="schema"
    )
    title: str = key("title of the figures", "Regression of traction", example="Traction of ATF")
    readings: str = key("table of the readings, relative to this file", example="readings.csv")
    contact: Contact = key("the two discs")
    lubricant: Lubricant = key("the oil, whose viscosity the law reads")
    regression: Choice = key("terms and signs", Choice())


COLUMNS = (
    RUN,
    columns.LOAD,
    columns.ENTRAINMENT_SPEED,
    columns.SLIDE_ROLL_RATIO,
    columns.OIL_TEMPERATURE,
    Column("friction_coefficient", above=0.0, meaning="friction over load, without sign"),
    Column("surface_1", "name", required=False, meaning="of the first disc; each pair of surfaces has laws of its own"),
    Column("surface_2", "name", required=False, meaning="of the second disc"),
)


@dataclass(frozen=True, eq=False)
class Law:
    """Fitted law with the rows of its readings and their pair of surfaces."""

    name: str
    surfaces: str
    sign: str
    rows: np.ndarray
    found: Regression


def inputs_of(file: RegressionFile, table: Table, oil: Oil) -> dict[str, np.ndarray]:
    """Inputs of the law in their units."""
    radius = reduced_radius(file.contact.radius_mm, "radius_mm")
    values = (
        hertz(file.contact, table["load_N"])["hertz_pressure_MPa"] * 1e-3,
        np.abs(table["slide_roll_ratio"]),
        table["entrainment_speed_m_s"],
        oil.viscosity(table["oil_temperature_C"] + ZERO_CELSIUS) * 1e3,
        np.full(len(table), radius * 1e3),
    )
    return {one.name: np.asarray(value) for one, value in zip(INPUTS, values, strict=True)}


def laws_of(file: RegressionFile, table: Table, values: dict[str, np.ndarray]) -> Iterator[Law]:
    """Laws of each pair of surfaces and sign of sliding with enough readings."""
    names = [table[name] if name in table else np.full(len(table), "") for name in ("surface_1", "surface_2")]
    pairs = np.char.add(np.char.add(names[0].astype(str), " / "), names[1].astype(str))
    several = np.unique(pairs)
    for pair in several:
        own, faster = pairs == pair, table["slide_roll_ratio"] > 0.0
        signs = {BOTH: own}
        if file.regression.signs == "each" and (own & faster).any() and (own & ~faster).any():
            signs |= {FIRST: own & faster, SECOND: own & ~faster}
        for sign, rows in signs.items():
            if sign != BOTH and rows.sum() < LEAST:
                continue
            if rows.sum() < FEWEST:
                place = f"{table.source}: readings of {pair}" if len(several) > 1 else table.source
                raise InputError(f"a regression needs {FEWEST} readings or more", where=place, value=int(rows.sum()))
            part = {name: value[rows] for name, value in values.items()}
            friction = table["friction_coefficient"][rows]
            found = measured_regression(part, friction, file.regression.order, file.regression.terms)
            name = sign if len(several) == 1 else f"{pair}, {sign}"
            yield Law(name, pair, sign, np.flatnonzero(rows), found)


def run(file: RegressionFile, path: Path) -> Evaluated:
    """Fit the laws; return terms, residuals and law files."""
    source = named_file(path.parent, file.readings, "readings")
    table = read_table(source, COLUMNS)
    slides = table["slide_roll_ratio"] != 0.0
    if not slides.any():
        raise InputError("no reading has sliding", where=f"{source}: slide_roll_ratio", value=0.0)
    table = table.take(slides)
    with collected() as findings:
        oil = lubricant(file.lubricant, BEYOND_VISCOSITY, path.parent)
        values = inputs_of(file, table, oil)
    laws = list(laws_of(file, table, values))
    notes = [str(one) for one in dict.fromkeys(findings)]
    if not slides.all():
        notes.append(f"readings without sliding are left out: {int((~slides).sum())}")
    notes += [*_constant(values), CHOSEN]
    tables = {
        "terms": pd.concat([_terms(law) for law in laws], ignore_index=True),
        "readings": pd.concat([_readings(law, table) for law in laws], ignore_index=True),
        "fits": pd.DataFrame([_fit(law, table) for law in laws]),
    }
    files = {f"{file_name(law.name)}.toml": _law_text(file, law, oil) for law in laws}
    return Evaluated(file.title, tables, _figures(laws), tuple(map(_line, laws)), tuple(notes), files=files)


def _constant(values: dict[str, np.ndarray]) -> Iterator[str]:
    for one in INPUTS:
        if one.letter not in varied(values):
            value = f"{one.name} is {values[one.name][0]:.4g} {one.written} in every reading"
            yield f"{value}: the law has no term of it, and studies are flagged elsewhere"


def _terms(law: Law) -> pd.DataFrame:
    """Terms of a law with 90 % intervals, which hold only for terms chosen before the fit."""
    from scipy.stats import t

    found = law.found.terms
    freedom = law.found.fit["readings"] - law.found.fit["terms"]
    half = t.isf(0.05, freedom) * found["standard_error"]
    found = found.assign(low90=found["value"] - half, high90=found["value"] + half)
    found = found.assign(p_value=2.0 * t.sf(found["t"].abs(), freedom))
    found.insert(0, "law", law.name)
    return found


def _readings(law: Law, table: Table) -> pd.DataFrame:
    """Readings of a law with fitted value and residual."""
    rows = law.found.table
    rows.insert(0, "law", law.name)
    rows.insert(1, "run", table["run"][law.rows])
    rows.insert(2, "sliding", np.where(table["slide_roll_ratio"][law.rows] > 0.0, FIRST, SECOND))
    return rows


def _fit(law: Law, table: Table) -> dict[str, Any]:
    """Errors and range of a law, and difference between the signs of sliding."""
    first = table["slide_roll_ratio"][law.rows] > 0.0
    row: dict[str, Any] = {"law": law.name, **law.found.fit}
    row |= {end: law.found.coefficients[end] for one in INPUTS for end in one.ends}
    if first.any() and not first.all():
        row |= _signs(law, first.astype(float))
    return row


def _signs(law: Law, first: np.ndarray) -> dict[str, float]:
    """Difference of ln(friction) with the first body faster, fitted together with the terms of the law.

    Empty if the terms determine the sign, for instance if each sign has a separate level of sliding.
    """
    table = law.found.table
    every = design_of({one.name: table[one.column].to_numpy() for one in INPUTS})
    design = every[list(law.found.standard_errors)].assign(first=first)
    if not is_determined(design, "first"):
        return {}
    fit = least_squares(design, np.log(table["friction_coefficient"].to_numpy()))
    return {"first_less_second_of_log": float(fit.coefficients["first"]), "signs_p_value": float(fit.p_values["first"])}


def _law_text(file: RegressionFile, law: Law, oil: Oil) -> str:
    surfaces = "" if law.surfaces == " / " else f" on {law.surfaces}"
    name = file.lubricant.oil or file.lubricant.name or "the oil"
    about = (
        f"Measured friction of {name}{surfaces}; sliding: {law.sign}.\n"
        f"{law.found.fit['readings']} readings. Written by `mixedlub evaluate regression`."
    )
    known = {key: oil.inputs(np.array(one.temperature))[one.quantity] / one.factor for key, one in OIL.items()}
    viscosities = {key: float(known[key]) for key, one in OIL.items() if one.quantity == "viscosity"}
    return friction_file("condensed", name, about, law.found.fit, {**law.found.coefficients, **viscosities})


def _line(law: Law) -> str:
    fit, terms = law.found.fit, law.found.terms["term"].iloc[1:]
    own, left_out = (100.0 * fit[f"{which}rms_of_log"] for which in ("", "left_out_"))
    how = "one by one" if fit["left_out_parts"] == fit["readings"] else f"in {fit['left_out_parts']} parts"
    return (
        f"{law.name}: {fit['readings']} readings, R² {fit['r_squared']:.4f}, rms error {own:.3g} % ({left_out:.3g} % "
        f"of readings left out {how}, with terms chosen anew); terms {', '.join(terms) or 'none'}"
    )


def _figures(laws: list[Law]) -> dict[str, tuple[Panel, ...]]:
    """Residual plots: fitted over measured, residuals over fitted and each input, and normal probability."""
    both = [law for law in laws if law.sign == BOTH]
    drawn: list[tuple[str, str, list[Curve]]] = [
        ("measured friction coefficient (-)", "fitted (-)", []),
        ("fitted friction coefficient (-)", "residual of ln µ (-)", []),
        *(
            (f"{one.name.replace('_', ' ').replace('hertz', 'Hertz')} ({one.written})", "residual of ln µ (-)", [])
            for one in INPUTS
        ),
        ("normal quantile (-)", "standardised residual (-)", []),
    ]
    for group, law in enumerate(both):
        table, label = law.found.table, law.name if len(both) > 1 else ""
        measured, fit = table["friction_coefficient"].to_numpy(), table["fitted"].to_numpy()
        left = table["residual_of_log"].to_numpy()
        ordered = np.sort(table["standardised_residual"].to_numpy())
        quantile = norm.ppf((np.arange(ordered.size) + 0.5) / ordered.size)
        pairs = [(measured, fit), (fit, left), *((table[one.column].to_numpy(), left) for one in INPUTS)]
        for (_, _, curves), (x, y) in zip(drawn, [*pairs, (quantile, ordered)], strict=True):
            curves.append(Curve(x, y, label, marker=True, group=group))
        for place, reach in ((0, np.array([measured.min(), measured.max()])), (-1, quantile[[0, -1]])):
            drawn[place][2].append(Curve(reach, reach, group=group))
    varied = [one for one in drawn if np.ptp(np.concatenate([c.x for c in one[2]])) > 0.0]
    return {"residuals": tuple(Panel(across, up, tuple(curves)) for across, up, curves in varied)}


EVALUATION = Evaluation(
    name="regression",
    about="traction of two discs into a friction law for studies, by stepwise multiple regression",
    source=SOURCE,
    file=RegressionFile,
    columns={"the readings": COLUMNS},
    run=run,
    results=REGRESSION,
    example={
        "schema": "mixedlub-regression/1",
        "title": "Traction of ATF",
        "readings": "readings.csv",
        "contact": {
            "geometry": "point",
            "radius_mm": [25.4, 38.1],
            "transverse_radius_mm": [76.2, 76.2],
        },
        "lubricant": {
            "name": "ATF",
            "temperature_C": [40.0, 100.0],
            "kinematic_viscosity_mm2_s": [34.0, 7.2],
            "density_15C_kg_m3": 850.0,
            "density_change_per_K": 7e-4,
        },
        "regression": {"terms": "bic", "order": 2},
    },
)
