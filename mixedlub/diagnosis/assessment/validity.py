"""Whether the laws of an answer were used within the range that their sources cover."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.data_checks.audit import Doubt
from mixedlub.diagnosis.inference.map_fit import NINETY
from mixedlub.diagnosis.labels import effect_words, number, words_of
from mixedlub.diagnosis.problem import Explanation, Problem, effects_of

SLACK = 1e-6
"""Share of a bound that rounding may go beyond it."""
EXACTLY = 0.01
"""Of an exponent, how near one of a law at the end of its prior counts as that."""


def beyond_range(problem: Problem, explanation: Explanation, z: np.ndarray) -> list[str]:
    """A sentence for each quantity of a fit that lies outside what one of its effects was made for."""
    record = problem.run(explanation, z).record
    state: dict[str, Any] = dict(record.inputs)
    for made in record.made:
        state.update(made)
    return outside(effects_of(explanation), state, problem.y.size)


def unpublished(effects: Sequence[Effect], z: np.ndarray, spread: np.ndarray) -> list[str]:
    """A sentence for each parameter outside what laws cited for its effect have; a doubt where none of them would do.

    ``z`` and ``spread`` are the coordinates of the effects' parameters and their standard deviations.
    """
    said: list[str] = []
    every = [(e, p) for e in effects for p in e.parameters]
    for (e, p), at, sd in zip(every, z, spread, strict=True):
        if p.published is None:
            continue
        least, most = p.published
        low, value, high = (p.prior.value(float(at + k * NINETY * sd)) for k in (-1.0, 0.0, 1.0))
        named = (x for x in (law.get(p.name, least) for law in e.contains.values()) if not least <= x <= most)
        if least <= value <= most or any(low - EXACTLY <= exact <= high + EXACTLY for exact in named):
            continue
        cited = f"{number(least)} to {number(most)}"
        found = f"{effect_words(e.id)}: {p.meaning} is {number(value)} (90 % {number(low)} to {number(high)})"
        if low > most or high < least:
            form = "read it as a change of that form, not as that cause"
            said.append(Doubt(f"{found}; no law cited for it has that, they have {cited}: {form}"))
        else:
            said.append(f"{found}; the laws cited for it have {cited}, and these readings allow those too")
    return said


def outside(effects: Sequence[Effect], state: Mapping[str, Any], rows: int) -> list[str]:
    """The same for quantities by name, shaped (rows or 1, points); those that are not there are not judged."""
    said = []
    for e in effects:
        for name in e.valid.keys() & state.keys():
            low, high = e.valid[name]
            values = np.atleast_2d(np.asarray(state[name], dtype=float))
            off = (values > high + SLACK * abs(high)) | (values < low - SLACK * abs(low))
            if not off.any():
                continue
            count = int(np.broadcast_to(off.any(axis=1), rows).sum())
            largest, smallest = float(values[off].max()), float(values[off].min())
            reach = f"up to {number(largest)}" if largest > high else f"down to {number(smallest)}"
            unit = GLOSSARY[name].unit
            said.append(
                f"{effect_words(e.id)}: its law is made for {words_of(name)} {number(low)} to {number(high)}"
                f"{'' if unit == '-' else f' {unit}'}; in {count} of {rows} readings that is {reach}, where its size "
                "is an extrapolation"
            )
    return said
