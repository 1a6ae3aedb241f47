"""Improved model: the case with the answer as part of its model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.files import TABLES, case_files
from mixedlub.case.folder import Case
from mixedlub.case.missing_part import FILE
from mixedlub.diagnosis.diagnose import EFFECTS, LAW, TABLE, Diagnosis
from mixedlub.diagnosis.discovery.files import FILE as LAW_FILE
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import effect_words
from mixedlub.diagnosis.report.text.answer import verdict_fit

FOLDER = "improved"
FILES = ("system.toml", FILE, str(LAW_FILE), *(f"{name}.csv" for name in TABLES))


def most_probable(d: Diagnosis) -> np.ndarray:
    """Coordinates of the verdict's fit, without the error of form because a law has none."""
    refined = verdict_fit(d)
    return refined.fit.z if refined.bend else refined.z


def improved_case(d: Diagnosis) -> Case:
    """Case that simulates the model with the smallest error on left-out levels.

    Of named effects, parameters and calibration are the most probable values of the verdict alone: no average over
    explanations or change points, and no error of form. A discrepancy is a found law, or a table beside the calibrated
    base model. The recording is kept, because inputs are scaled by it.
    """
    verdict, problem, z = d.posterior.verdict, d.search.problem, d.search.null_fit.z
    fitted: dict[str, dict[str, float]] = {}
    if d.handed_on == EFFECTS or verdict == NOTHING:
        z, known = most_probable(d), problem.forward.catalogue
        fitted = {
            effect: {p.name: values[p.name] for p in known[effect].parameters}
            for effect, values in problem.parameters(verdict, z).items()
        }
    laws = dict(d.given.laws)
    if d.handed_on == LAW and d.law is not None:
        z, own = d.law.refined[d.law.explanation].z, d.law.search.problem
        fitted, laws = own.parameters(d.law.explanation, z), {**laws, d.law.effect.id: d.law.written}
    named = ", ".join(map(effect_words, fitted)) or "calibration alone"
    words = "a table of the missing part" if d.handed_on == TABLE else f"{named}, at the most probable parameters"
    given = d.given.system
    update = {
        "description": f"Improved model of {d.given.name}: {words}. {given.description}".rstrip(),
        "effects": {**given.effects, **fitted},
        "calibration": problem.calibration(z, without=fitted),
    }
    missing = d.given.missing
    if d.handed_on == TABLE:
        missing, update = d.tabulated.missing, {**update, "missing_part": FILE}
    system = given.model_copy(update=update)
    laws = {name: law for name, law in laws.items() if name in system.effects}
    conditions = None if d.wanted is None else d.wanted.table
    return replace(d.given, system=system, conditions=conditions, laws=laws, hypotheses=(), missing=missing)


def improved_files(d: Diagnosis) -> dict[str, str | bytes]:
    """Files of the improved model, by path in the answer."""
    return {f"{FOLDER}/{name}": content for name, content in case_files(improved_case(d)).items()}
