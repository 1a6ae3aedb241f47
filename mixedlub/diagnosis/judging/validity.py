"""Whether the laws of an answer were used within the range that their sources cover."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mixedlub.diagnosis.fitting.problem import Explanation, Problem, effects_of
from mixedlub.diagnosis.telling.labels import effect_words, number, words_of
from mixedlub.effect import Effect
from mixedlub.quantities import GLOSSARY

SLACK = 1e-6
"""Share of a bound that rounding may go beyond it."""


def beyond_range(problem: Problem, explanation: Explanation, z: np.ndarray) -> list[str]:
    """A sentence for each quantity of a fit that lies outside what one of its effects was made for."""
    record = problem.run(explanation, z).record
    state: dict[str, Any] = dict(record.inputs)
    for made in record.made:
        state.update(made)
    return outside(effects_of(explanation), state, problem.y.size)


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
