"""Answer for other programs: `diagnosis.json` and `predictions.csv`."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.case.simulation import conditions_of
from mixedlub.case.validity import judge_rows
from mixedlub.chain.effect import Parameter
from mixedlub.chain.priors import Prior
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.diagnosis.assessment.campaign import Standing
from mixedlub.diagnosis.assessment.experiment_design import NextTest
from mixedlub.diagnosis.assessment.prediction import Refined
from mixedlub.diagnosis.diagnose import TABLE, Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING
from mixedlub.diagnosis.labels import in_units_of_case
from mixedlub.diagnosis.report.text.location_text import located
from mixedlub.diagnosis.report.text.next_test_text import needed_readings
from mixedlub.diagnosis.settings.inference import INTERVAL_ENDS, NINETY
from mixedlub.diagnosis.settings.report import RPM
from mixedlub.recording.readings import rows_of
from mixedlub.schema.findings import as_records
from mixedlub.schema.table import Table
from mixedlub.schema.units import unit_of

if TYPE_CHECKING:
    import pandas as pd


@in_units_of_case
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
        "next_tests": [{**test_record(d, t), "readings": d.batch.readings} for t in d.batch.tests],
        "next_batch": batch_record(d),
        "tests_beyond": [{**test_record(d, t), "needs": list(t.needs)} for t in d.batch.beyond],
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
            fitted = {"name": p.name, "unit": p.unit, "value": value, "low90": low, "high90": high}
            parameters.append({**fitted, **_absolute(d, p, (value, low, high))})
            index += 1
        record = {"id": e.id, "parameters": parameters, "source": e.source, "equation": e.equation}
        laws = [{"law": c.law, "log_odds": c.log_odds} for c in d.contained if c.effect == e.id]
        records.append({**record, "contains": laws} if laws else record)
    return records


def _absolute(d: Diagnosis, p: Parameter, ends: tuple[float, float, float]) -> dict[str, Any]:
    """A relative parameter in the unit of its reference."""
    if not p.relative_to:
        return {}
    size, unit = whole(d, p.relative_to)
    value, low, high = (end * size for end in ends)
    return {
        "absolute": {
            "unit": unit + p.unit.removeprefix("-").removeprefix("1"),
            "value": value,
            "low90": low,
            "high90": high,
        }
    }


def calibration_record(d: Diagnosis) -> dict[str, dict[str, float]]:
    """Calibrated inputs under the verdict, with 90 % intervals."""
    z, spread = calibrated_at(d)
    record = {}
    for i, c in enumerate(d.search.problem.forward.calibrations):
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        record[c.name] = {"value": value, "low90": low, "high90": high}
    return record


def whole(d: Diagnosis, name: str) -> tuple[float, str]:
    """Value and unit of the calibrated input to which a parameter is relative."""
    forward = d.search.problem.forward
    if name == "reading_scale":
        return float(forward.inputs[name]) * forward.scale, unit_of(d.case.quantity)
    if name == "reference_speed":
        size, turning = float(forward.inputs[name]), "speed_rpm" in forward.table
        return (size * RPM, "rpm") if turning else (size, "m/s")
    for c, z in zip(forward.calibrations, calibrated_at(d)[0], strict=False):
        if name in c.needs:
            moved = c.apply(forward.inputs, c.parameter.prior.value(float(z)))
            return float(moved[name]), c.parameter.unit.removeprefix("-")
    return float(forward.inputs[name]), GLOSSARY[name].unit


def calibrated_at(d: Diagnosis) -> tuple[np.ndarray, np.ndarray]:
    """Standard-normal coordinates of the calibration under the verdict, and their sd."""
    if d.posterior.verdict.is_discrepancy:
        return d.search.discrepancy.z, np.sqrt(np.diag(d.search.discrepancy.covariance))
    refined = verdict_fit(d)
    return refined.z, refined.spread


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


def test_record(d: Diagnosis, test: NextTest) -> dict[str, Any]:
    """One of the next tests."""
    return {
        "conditions": test.conditions,
        "separates": list(test.separates),
        "expected_bits": test.expected_bits,
        "text": separating_text(d, test.separates),
    }


def batch_record(d: Diagnosis) -> dict[str, Any]:
    """The next tests together: their joint information, the rivals, and the readings for a settled answer."""
    batch = d.batch
    return {
        "expected_bits": batch.expected_bits,
        "readings": batch.readings,
        "chance": batch.chance,
        "settled": batch.settled,
        "rivals": [{"explanation": list(key.ids), "probability": weight} for key, weight in batch.rivals],
        "text": needed_readings(batch),
    }


def campaign_record(d: Diagnosis) -> dict[str, Any] | None:
    """The contents of `campaign.json`; None without added readings."""
    campaign = d.campaign
    if campaign is None:
        return None
    return {
        "schema": "mixedlub-campaign/1",
        "case": d.case.name,
        "added_runs": list(campaign.runs),
        "readings": len(rows_of(d.given)),
        "before": _standing_record(campaign.before),
        "after": _standing_record(campaign.after),
        "expected_bits": campaign.expected_bits,
        "realised_bits": campaign.realised_bits,
    }


def _standing_record(standing: Standing) -> dict[str, Any]:
    shares = standing.explanations.items()
    return {
        "verdict": list(standing.verdict),
        "tied": [list(ids) for ids in standing.tied],
        "probabilities": dict(standing.probabilities),
        "explanations": [{"explanation": list(ids), "probability": share} for ids, share in shares],
    }


def separating_text(d: Diagnosis, names: tuple[str, ...]) -> str:
    """Tests of the catalogue that separate the named effects."""
    ids = [part for name in names for part in name.split("+") if part not in NOTHING.ids + DISCREPANCY.ids]
    return "; ".join(dict.fromkeys(f"{e.id}: {e.separated_by}" for e in d.search.problem.effects_of(ids)))


def predictions(d: Diagnosis) -> pd.DataFrame:
    """Predictions of the recorded and requested rows, each run once, with conditions; faulty readings behind others."""
    import pandas as pd

    parts = []
    for p in (d.recorded, d.faulty, d.wanted):
        if p is not None:
            handed = d.handed(p)
            numbers = {name: getattr(handed, name) for name in PREDICTED}
            columns = pd.DataFrame({"run": p.table["run"], **numbers})
            words = pd.Series(_validity(d, p.table), name="validity")
            parts.append(pd.concat([columns, conditions_of(d.case, p.table), words], axis=1))
    return pd.concat(parts, ignore_index=True).drop_duplicates("run", ignore_index=True)


def next_tests_table(d: Diagnosis) -> pd.DataFrame:
    """The batch to fill in: run numbers after all others, conditions, and an empty reading."""
    import pandas as pd

    recorded = rows_of(d.given)
    names = [c.name for c in d.case.kind.columns if c.name in recorded]
    read = [*(c.name for c in d.case.kind.instrument_channels if c.name in recorded), d.case.quantity]
    numbered = [p.table["run"].max() for p in (d.recorded, d.wanted) if p is not None]
    rows = pd.DataFrame([t.conditions for t in d.batch.tests], columns=names)
    rows.insert(0, "run", np.arange(1, len(rows) + 1) + int(max(numbered)))
    return rows.assign(**dict.fromkeys(read, ""))


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
