"""Whether the laws of an answer were used within the range that their sources cover."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Effect
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.labels import effect_words, number, words_of
from mixedlub.diagnosis.problem import Problem, effects_of
from mixedlub.diagnosis.settings.assessment import EXACT_EXPONENT, RANGE_SLACK
from mixedlub.diagnosis.settings.inference import NINETY
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.table import Table


def beyond_range(problem: Problem, explanation: Explanation, z: np.ndarray) -> list[Finding]:
    """A finding for each quantity of a fit that lies outside what one of its effects was made for."""
    run = problem.run(explanation, z)
    effects = (*problem.forward.known.effects, *effects_of(explanation.effects))
    return outside(effects, {**run.inputs, **run.record.state}, problem.y.size)


def known_beyond_range(case: Case, table: Table) -> list[Finding]:
    """The same for the effects that a case names, at the rows of a table."""
    if not case.system.effects:
        return []
    forward = Forward(case, table)
    run = forward.run()
    return outside(forward.known.effects, {**run.inputs, **run.record.state}, len(table))


def unpublished(effects: Sequence[Effect], z: np.ndarray, spread: np.ndarray) -> list[Finding]:
    """A finding for each parameter outside the published laws of its effect; a doubt where its interval is as well.

    ``z`` and ``spread`` are the coordinates of the effects' parameters and their standard deviations.
    """
    found: list[Finding] = []
    every = [(e, p) for e in effects for p in e.parameters]
    for (e, p), at, sd in zip(every, z, spread, strict=True):
        if p.published is None:
            continue
        least, most = p.published
        low, value, high = (p.prior.value(float(at + k * NINETY * sd)) for k in (-1.0, 0.0, 1.0))
        named = (x for x in (law.get(p.name, least) for law in e.special_cases.values()) if not least <= x <= most)
        if least <= value <= most or any(low - EXACT_EXPONENT <= exact <= high + EXACT_EXPONENT for exact in named):
            continue
        cited = f"{number(least)} to {number(most)}"
        fitted = f"{p.meaning} is {number(value)} (90 % {number(low)} to {number(high)})"
        if low > most or high < least:
            text = (
                f"{fitted}, which no published law has ({cited}): take it as a change of that form, not as that cause"
            )
            found.append(finding("parameter_unpublished", text, effect_words(e.id)))
        else:
            text = f"{fitted}; published laws have {cited}, which these readings also allow"
            found.append(finding("parameter_beyond_published", text, effect_words(e.id)))
    return found


def outside(effects: Sequence[Effect], state: Mapping[str, Any], rows: int) -> list[Finding]:
    """The same for quantities by name, shaped (rows or 1, points); those that are not there are not judged."""
    found = []
    for e in effects:
        for name in e.valid.keys() & state.keys():
            low, high = e.valid[name]
            values = np.atleast_2d(np.asarray(state[name], dtype=float))
            off = (values > high + RANGE_SLACK * abs(high)) | (values < low - RANGE_SLACK * abs(low))
            if not off.any():
                continue
            count = int(np.broadcast_to(off.any(axis=1), rows).sum())
            largest, smallest = float(values[off].max()), float(values[off].min())
            reach = f"up to {number(largest)}" if largest > high else f"down to {number(smallest)}"
            unit = GLOSSARY[name].unit.removeprefix("-")
            span = f"{number(low)} to {number(high)} {unit}".rstrip()
            text = (
                f"the law is valid for {words_of(name)} {span}; in {count} of {rows} readings it is {reach}, where the "
                "law is extrapolated"
            )
            found.append(finding("law_extrapolated", text, effect_words(e.id)))
    return found
