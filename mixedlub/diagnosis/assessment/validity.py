"""Use of an answer's laws within the range of their sources."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.case.validity import judge_rows
from mixedlub.chain.effect import Effect
from mixedlub.chain.ranges import findings
from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.labels import effect_words, number
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.settings.assessment import EXACT_EXPONENT
from mixedlub.diagnosis.settings.inference import NINETY
from mixedlub.schema.findings import Finding, finding


def beyond_range(problem: Problem, explanation: Explanation, z: np.ndarray) -> tuple[Finding, ...]:
    """Findings on the effects of a fit that are used outside their valid range."""
    judged = judge_rows(problem.forward, problem.parameters(explanation, z), problem.calibration(z))
    own = [(limit, values) for limit, values in judged.reached if limit.code.partition(":")[2] in explanation.effects]
    return findings(own, problem.y.shape, "readings", lambda code: effect_words(code.partition(":")[2]))


def unpublished(effects: Sequence[Effect], z: np.ndarray, spread: np.ndarray) -> list[Finding]:
    """Findings on parameters outside the published laws of their effect; a doubt if the 90 % interval is outside too.

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
