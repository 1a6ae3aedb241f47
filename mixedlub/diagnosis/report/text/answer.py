"""Answer for other programs: `diagnosis.json` and `predictions.csv`."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.case.simulation import conditions_of
from mixedlub.case.validity import judge_rows
from mixedlub.chain.priors import Prior
from mixedlub.diagnosis.assessment.prediction import Refined
from mixedlub.diagnosis.diagnose import TABLE, Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.report.text.location_text import located
from mixedlub.diagnosis.report.text.next_test_text import beyond
from mixedlub.diagnosis.settings.inference import INTERVAL_ENDS, NINETY
from mixedlub.schema.findings import as_records
from mixedlub.schema.table import Table

if TYPE_CHECKING:
    import pandas as pd


def as_json(d: Diagnosis) -> dict[str, Any]:
    """The answer by the schema mixedlub-diagnosis/1."""
    verdict = list(d.posterior.verdict.ids)
    return {
        "schema": "mixedlub-diagnosis/1",
        "case": d.case.name,
        "mismatch": {
            "detected": d.test.detected,
            "p_value": d.test.p_value,
            "level": d.test.level,
            "chi2_before": d.test.chi2_before,
            "rows": d.test.rows,
        },
        "verdict": verdict,
        "probabilities": d.posterior.inclusion(d.search),
        "tied": [list(key.ids) for key in d.posterior.tied],
        "stage": d.posterior.stages(d.search),
        "location": {
            "rows": {
                str(int(run)): float(z) for run, z in zip(d.recorded.table["run"], d.recorded.mismatch_z, strict=True)
            },
            "where": list(d.region.where),
            "text": located(d),
        },
        "effects": effect_records(d),
        "calibration": calibration_record(d),
        "fit": {
            "noise_rms": float(np.sqrt(np.mean(verdict_residual(d)[d.counted] ** 2))),
            "heldout_before": d.heldout.before,
            "heldout_after": d.heldout.after,
            "split": d.heldout.split,
            "folds": d.heldout.folds,
        },
        "law": law_record(d),
        "improved": improved_record(d),
        "outlier_runs": d.outlier_runs,
        "next_tests": [
            {
                "conditions": t.conditions,
                "separates": list(t.separates),
                "expected_bits": t.expected_bits,
                "text": "; ".join((*beyond(t.conditions, d.recorded.table), separating_text(d, t.separates))),
            }
            for t in d.next_tests
        ],
        "warnings": [str(one) for one in d.warnings],
        "findings": as_records(d.warnings),
        **({"hypotheses": [asdict(one) for one in d.hypotheses]} if d.hypotheses else {}),
        **({} if d.check is None else {"check": asdict(d.check)}),
    }


def law_record(d: Diagnosis) -> dict[str, Any] | None:
    """The law found for a mismatch without a name, with its rivals; None without a law that predicts left-out levels
    better than calibration."""
    law = d.law
    if law is None:
        return None
    refined = law.refined[law.explanation]
    index, parameters = law.search.problem.calibration_size, []
    for e in law.search.problem.effects(law.explanation):
        for p in e.parameters:
            if e.id == law.effect.id:
                value, low, high = interval(p.prior, refined.z[index], refined.spread[index])
                parameters.append({"name": p.name, "unit": p.unit, "value": value, "low90": low, "high90": high})
            index += 1
    rivals = [
        {
            **{key: rival.data[key] for key in ("stage", "acts_on", "form", "expression")},
            "log_evidence_behind": rival.behind,
            "heldout_after": rival.heldout,
            "equivalent": rival.equivalent,
        }
        for rival in law.rivals
    ]
    return {
        **{key: law.data[key] for key in ("stage", "acts_on", "form", "expression")},
        "parameters": parameters,
        "range": {name: list(ends) for name, ends in law.ranges.items()},
        "heldout_before": law.heldout.before,
        "heldout_after": law.heldout.after,
        "rivals": rivals,
        "empirical": True,
    }


def improved_record(d: Diagnosis) -> dict[str, Any]:
    """The model in the folder improved, its error on left-out levels, and the errors of its table."""
    record: dict[str, Any] = {"model": d.handed_on, "heldout": d.handed_on_error}
    if d.handed_on == TABLE:
        record |= {"table_rms_error": d.tabulated.rms_error, "table_largest_error": d.tabulated.largest_error}
    return record


def verdict_fit(d: Diagnosis) -> Refined:
    """Refined fit of the verdict, or of the calibrated base model for a discrepancy."""
    key = d.posterior.verdict
    return d.refined[NOTHING if key.is_discrepancy else key]


def verdict_residual(d: Diagnosis) -> np.ndarray:
    """Residuals (recorded - fitted)/sd after the verdict, with the sd of a single reading."""
    discrepancy = d.posterior.verdict.is_discrepancy
    residual = d.search.discrepancy.fit.residual if discrepancy else verdict_fit(d).residual
    return d.search.problem.single_reading_units(residual)


def effect_records(d: Diagnosis) -> list[dict[str, Any]]:
    """The verdict's effects with their fitted parameters."""
    refined = verdict_fit(d)
    spread = refined.spread
    index = d.search.problem.calibration_size
    records = []
    for e in d.search.problem.effects(refined.fit.explanation):
        parameters = []
        for p in e.parameters:
            value, low, high = _value_and_interval(refined, p.prior, index, spread[index])
            parameters.append({"name": p.name, "unit": p.unit, "value": value, "low90": low, "high90": high})
            index += 1
        record = {"id": e.id, "parameters": parameters, "source": e.source, "equation": e.equation}
        laws = [{"law": c.law, "log_odds": c.log_odds} for c in d.contained if c.effect == e.id]
        records.append({**record, "contains": laws} if laws else record)
    return records


def calibration_record(d: Diagnosis) -> dict[str, dict[str, float]]:
    """Calibrated inputs under the verdict, with 90 % intervals."""
    if d.posterior.verdict.is_discrepancy:
        discrepancy = d.search.discrepancy
        z, spread = discrepancy.z, np.sqrt(np.diag(discrepancy.covariance))
    else:
        refined = verdict_fit(d)
        z, spread = refined.z, refined.spread
    record = {}
    for i, c in enumerate(d.search.problem.forward.calibrations):
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        record[c.name] = {"value": value, "low90": low, "high90": high}
    return record


def interval(prior: Prior, z: float, spread: float) -> tuple[float, float, float]:
    """Value and 90 % interval of a parameter from its standard-normal coordinate."""
    ends = (prior.value(float(z - NINETY * spread)), prior.value(float(z + NINETY * spread)))
    return prior.value(float(z)), min(ends), max(ends)


def _value_and_interval(refined: Refined, prior: Prior, index: int, spread: float) -> tuple[float, float, float]:
    """Value and 90 % interval of a fitted coordinate; quantiles of the posterior for a change point."""
    for change_point in refined.change_points:
        if change_point.index == index:
            low, high = (prior.value(change_point.at(share)) for share in INTERVAL_ENDS)
            return prior.value(change_point.at(0.5)), low, high
    return interval(prior, refined.z[index], spread)


def separating_text(d: Diagnosis, names: tuple[str, ...]) -> str:
    """Tests of the catalogue that separate the named effects."""
    ids = [part for name in names for part in name.split("+") if part not in NOTHING.ids + DISCREPANCY.ids]
    return "; ".join(dict.fromkeys(f"{e.id}: {e.separated_by}" for e in d.search.problem.effects_of(ids)))


def predictions(d: Diagnosis) -> pd.DataFrame:
    """Predictions of the recorded and requested rows, each run once, with conditions."""
    import pandas as pd

    parts = []
    for p in (d.recorded, d.wanted):
        if p is not None:
            handed = d.handed(p)
            numbers = {name: getattr(handed, name) for name in PREDICTED}
            columns = pd.DataFrame({"run": p.table["run"], **numbers})
            words = pd.Series(_validity(d, p.table), name="validity")
            parts.append(pd.concat([columns, conditions_of(d.case, p.table), words], axis=1))
    return pd.concat(parts, ignore_index=True).drop_duplicates("run", ignore_index=True)


def _validity(d: Diagnosis, table: Table) -> np.ndarray:
    """Validity of the rows of a table under the verdict, or of the base model for a discrepancy."""
    problem, verdict = d.search.problem, d.posterior.verdict
    scale = float(problem.forward.inputs["reading_scale"])
    if verdict.is_discrepancy:
        return judge_rows(Forward(d.case, table, scale)).words
    z = d.refined[verdict].z
    return judge_rows(Forward(d.case, table, scale), problem.parameters(verdict, z), problem.calibration(z)).words


PREDICTED = ("base", "calibrated", "predicted", "low90", "high90", "mismatch_z")
"""Columns of predictions.csv after the run."""
