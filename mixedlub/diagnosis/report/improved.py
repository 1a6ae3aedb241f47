"""Improved model: the case with the verdict's effects and calibration at their most probable values."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.files import TABLES, case_files
from mixedlub.case.folder import Case
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import effect_words
from mixedlub.diagnosis.report.text.answer import verdict_fit
from mixedlub.effects import known_in

FOLDER = "improved"
FILES = ("system.toml", *(f"{name}.csv" for name in TABLES))


def most_probable(d: Diagnosis) -> np.ndarray:
    """Coordinates of the verdict's fit, without the error of form because a law has none."""
    refined = verdict_fit(d)
    return refined.fit.z if refined.bend else refined.z


def improved_case(d: Diagnosis) -> Case | None:
    """Case that simulates the verdict's fit; None for a discrepancy, which has no law.

    Parameters and calibration are the most probable values of the verdict alone: no average over explanations or change
    points, and no error of form. The recording is kept, because inputs are scaled by it.
    """
    verdict = d.posterior.verdict
    if verdict.is_discrepancy:
        return None
    problem, z, own = d.search.problem, most_probable(d), known_in(d.case.kind.effect_kind)
    fitted = {
        effect: {p.name: values[p.name] for p in own[effect].parameters}
        for effect, values in problem.parameters(verdict, z).items()
    }
    given = d.given.system
    named = ", ".join(map(effect_words, fitted)) or "calibration alone"
    of = f"Improved model of {d.given.name}: {named}, at the most probable parameters."
    system = given.model_copy(
        update={
            "description": f"{of} {given.description}".rstrip(),
            "effects": {**given.effects, **fitted},
            "calibration": problem.calibration(z, without=fitted),
        }
    )
    return replace(d.given, system=system, conditions=None if d.wanted is None else d.wanted.table)


def improved_files(d: Diagnosis) -> dict[str, str | bytes]:
    """Files of the improved model, by path in the answer; empty for a discrepancy."""
    case = improved_case(d)
    return {} if case is None else {f"{FOLDER}/{name}": content for name, content in case_files(case).items()}
