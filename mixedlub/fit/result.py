"""Result of a ranking of laws: tables, residual pictures, report, JSON and law files."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from mixedlub.fit.exported import exported
from mixedlub.fit.inference import Fit
from mixedlub.fit.misfit import shares, sizes
from mixedlub.fit.ranking import UNFIT, Ranking
from mixedlub.schema.result import Curve, Panel, Result, ResultColumn, described
from mixedlub.schema.units import split, unit_of, without_unit
from profiles.errors import InputError, nearest

SCHEMA = "mixedlub-fit/1"
PICTURED = 3
"""Most laws in the residual pictures."""
TABLES = {
    "laws": described(
        law="text: name of the law",
        weight="probability if one of these laws is true and all were equally probable before",
        tied="text: yes for the best law and the laws that the readings do not tell from it",
        log_evidence="logarithm of the probability density of the readings, by Laplace's approximation",
        aicc="corrected information criterion of Akaike at the most probable parameters",
        bic="Bayesian information criterion there",
        parameters="number of free parameters",
        rms_percent="root mean square of the residuals of the readings",
        left_out_percent="the same at left-out levels of the conditions; empty for laws far behind",
        misfit_probability="chance of this misfit if the law is true, by the stated noise or by repeats",
        outside_range_percent="readings outside the range of the source",
        misfit="text: clearest trend of the residuals, empty if there is none",
        title="text: the law in words",
        source="text: source of the law",
    ),
    "parameters": described(
        law="text: name of the law",
        parameter="text: name of the parameter",
        value="most probable value, in the unit of the row",
        low90="lower end of the 90 % interval",
        high90="upper end of the 90 % interval",
        unit="text: unit of the row",
        told="text: no if the readings leave the parameter at its prior",
        meaning="text: meaning of the parameter",
    ),
    "readings": described(
        law="text: name of the law",
        reading="number of the reading in the table",
        residual_percent="logarithm of fitted over measured; of readings with either sign, a share of their median",
        standardised="fitted minus measured, over the standard deviation of the reading",
    ),
    "not_judged": described(law="text: name of the law", reason="text: column or reading that is missing"),
}
"""Columns of the result tables; the readings have the columns of the input beside them."""


def result(found: Ranking, title: str, law: str | None = None) -> Result:
    """Result of a ranking; ``law``: the law to export, by default the best."""
    chosen = chosen_fit(found, law)
    lines = tuple(report(found, chosen))
    files: dict[str, str | bytes] = {
        **exported(chosen, found.readings),
        "fit.json": json.dumps(as_json(found, chosen), indent=1, ensure_ascii=False) + "\n",
        "report.txt": "\n".join(lines) + "\n",
    }
    return Result(
        title, tables(found), {"residuals": pictures(found)}, lines, (), files=files, columns=columns_of(found)
    )


def columns_of(found: Ranking) -> dict[str, Sequence[ResultColumn]]:
    """Columns of the tables, with the conditions of the input."""
    own = found.readings
    unit = unit_of(own.column)
    conditions = (
        ResultColumn("", header, "condition, as in the input", given_unit=split(header)[1] or "-")
        for header in own.columns
    )
    measured = ResultColumn("", own.column, "measured", given_unit=unit)
    fitted = ResultColumn("", f"fitted_{own.column}", "by the law", given_unit=unit)
    return {**TABLES, "readings": (*TABLES["readings"], *conditions, measured, fitted)}


def chosen_fit(found: Ranking, law: str | None) -> Fit:
    """Fit of a law by name; the error for an unknown name gives the nearest, for an unjudged law the reason."""
    if law is None:
        return found.best
    by_name = {one.law.name: one for one in found.fits}
    if law in by_name:
        return by_name[law]
    reason = next((one.reason for one in found.unjudged if one.name == law), None)
    rule = f"is not judged: {reason}" if reason else f"no such law; {nearest(law, by_name)}"
    raise InputError(rule, where="law", value=law)


def tables(found: Ranking) -> dict[str, pd.DataFrame]:
    """Tables of the laws, their parameters, the readings, and the laws that are not judged."""
    return {
        "laws": pd.DataFrame(_laws(found)),
        "parameters": pd.DataFrame([row for one in found.fits for row in _parameters(one)]),
        "readings": _readings(found),
        "not_judged": pd.DataFrame([(one.name, one.reason) for one in found.unjudged], columns=["law", "reason"]),
    }


def _laws(found: Ranking) -> Iterator[dict[str, Any]]:
    for one, weight in zip(found.fits, found.weights, strict=True):
        name, trend = one.law.name, found.trends[one.law.name]
        aicc, bic = found.criteria(one)
        yield {
            "law": name,
            "weight": float(weight),
            "tied": "yes" if name in found.tied else "no",
            "log_evidence": one.evidence,
            "aicc": aicc,
            "bic": bic,
            "parameters": len(one.parameters),
            "rms_percent": 100.0 * found.rms(one),
            "left_out_percent": 100.0 * found.left_out.get(name, np.nan),
            "misfit_probability": found.misfit_probability(one),
            "outside_range_percent": 100.0 * found.outside(one),
            "misfit": "" if trend is None else trend.words(_words(found.readings.column)),
            "title": one.law.title,
            "source": one.law.source,
        }


def _parameters(one: Fit) -> Iterator[dict[str, Any]]:
    for p in one.law.parameters:
        yield {
            "law": one.law.name,
            "parameter": p.name,
            "value": one.parameters[p.name],
            "low90": one.low90[p.name],
            "high90": one.high90[p.name],
            "unit": p.unit,
            "told": "no" if p.name in one.undetermined else "yes",
            "meaning": p.meaning,
        }


def _pictured(found: Ranking) -> list[Fit]:
    return list(found.fits[: max(1, min(PICTURED, len(found.fits)))])


def _readings(found: Ranking) -> pd.DataFrame:
    own = found.readings
    parts = []
    for one in _pictured(found):
        columns = {
            "law": one.law.name,
            "reading": np.arange(1, len(own) + 1),
            **own.columns,
            own.column: own.values * own.factor,
            f"fitted_{own.column}": one.fitted * own.factor,
            "residual_percent": 100.0 * shares(one.fitted, own),
            "standardised": one.residuals,
        }
        parts.append(pd.DataFrame(columns))
    return pd.concat(parts, ignore_index=True)


def _words(column: str) -> str:
    return without_unit(column).replace("_", " ")


def _label(header: str) -> str:
    words, unit = split(header)
    return f"{words} ({unit or '-'})"


def pictures(found: Ranking) -> tuple[Panel, ...]:
    """Fitted over measured, and residuals over each condition, of the best laws."""
    own = found.readings
    unit = unit_of(own.column) or "-"
    measured = own.values * own.factor
    ends = np.array([measured.min(), measured.max()])
    drawn = _pictured(found)
    first = [
        Curve(measured, one.fitted * own.factor, one.law.name, marker=True, group=group)
        for group, one in enumerate(drawn)
    ]
    name = _words(own.column)
    panels = [Panel(f"measured {name} ({unit})", f"fitted ({unit})", (*first, Curve(ends, ends)))]
    for header, values in own.varied().items():
        zero = Curve(np.array([values.min(), values.max()]), np.zeros(2))
        curves = [
            Curve(values, 100.0 * shares(one.fitted, own), one.law.name, marker=True, group=group)
            for group, one in enumerate(drawn)
        ]
        panels.append(Panel(_label(header), "fitted less measured (%)", (*curves, zero)))
    return tuple(panels)


def report(found: Ranking, chosen: Fit) -> Iterator[str]:
    """Lines for the user: the answer, the table of laws, parameters, misfits and laws that are not judged."""
    own, best = found.readings, found.best
    yield f"{len(own)} readings of {_words(own.column)}; {_noise(found)}"
    tied = [name for name in found.tied if name != best.law.name]
    yield f"Best law: {best.law.name} ({best.law.title}), weight {found.weights[0]:.2f}"
    if tied:
        yield f"Tied with it: {', '.join(tied)}: these readings do not tell them apart"
    chance = found.misfit_probability(best)
    if chance < UNFIT:
        yield f"No law fits to the noise: the best has this misfit with a chance of {chance:.1g}"
    yield ""
    yield "law                       weight     AICc      BIC  free  rms %  left out %"
    for row in _laws(found):
        out = row["left_out_percent"]
        mark = "*" if row["tied"] == "yes" else " "
        left = f"{out:10.3g}" if np.isfinite(out) else f"{'-':>10}"
        yield (
            f"{mark}{row['law']:<24} {row['weight']:7.2g} {row['aicc']:8.1f} {row['bic']:8.1f} {row['parameters']:5d} "
            f"{row['rms_percent']:6.3g}  {left}"
        )
    yield ""
    yield f"Parameters of {chosen.law.name} (90 % intervals):"
    for row in _parameters(chosen):
        unit = "" if row["unit"] == "-" else f" {row['unit']}"
        told = "" if row["told"] == "yes" else "; the readings do not tell it"
        ends = f"{row['low90']:.4g} to {row['high90']:.4g}"
        yield f"  {row['parameter']} = {row['value']:.4g} ({ends}){unit}, {row['meaning']}{told}"
    misfits = [row for row in _laws(found) if row["misfit"]][:8]
    if misfits:
        yield ""
        yield "Misfits:"
        yield from (f"  {row['law']}: {row['misfit']}" for row in misfits)
    if found.unjudged:
        yield ""
        yield "Not judged:"
        yield from (f"  {one.name}: {one.reason}" for one in found.unjudged)


def _noise(found: Ranking) -> str:
    own = found.readings
    if own.sd is not None:
        return f"stated noise, {100.0 * float(np.median(own.sd / sizes(own))):.2g} % of a reading"
    sd = float(np.median(found.best.sd / sizes(own)))
    return f"noise estimated from the best law, {100.0 * sd:.2g} % of a reading"


def as_json(found: Ranking, chosen: Fit) -> dict[str, Any]:
    """The ranking as a dictionary without infinite numbers."""
    own = found.readings
    laws = []
    for row, one in zip(_laws(found), found.fits, strict=True):
        values = [{key: value for key, value in p.items() if key != "law"} for p in _parameters(one)]
        laws.append({**row, "tied": row["tied"] == "yes", "parameters": values, "equation": one.law.equation})
    return _finite(
        {
            "schema": SCHEMA,
            "file": own.source,
            "quantity": own.column,
            "readings": len(own),
            "noise": "stated" if own.sd is not None else "estimated",
            "best": found.best.law.name,
            "tied": list(found.tied),
            "exported": chosen.law.name,
            "laws": laws,
            "not_judged": [{"law": one.name, "reason": one.reason} for one in found.unjudged],
        }
    )


def _finite(value: Any) -> Any:
    """Values for JSON, with None for numbers that are not finite."""
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value
