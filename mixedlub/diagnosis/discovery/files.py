"""A candidate as the file of a law."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.diagnosis.discovery.screening import ADD, QUANTITIES, REPLACE, Candidate
from mixedlub.diagnosis.settings.discovery import ADDITION_SD, EXPONENT_SD, LOG_FACTOR_SD
from mixedlub.own_laws import law_of_text
from mixedlub.schema.toml_file import to_toml

FILE = Path("law.toml")
"""File of a found law in the case of an improved model."""
SOURCE = "found in the readings of this case: empirical, without a cause"
LETTERS = "acdfgk"
"""Names of amplitudes."""


def law_data(name: str, c: Candidate, sizes: np.ndarray, ranges: Mapping[str, list[float]]) -> dict[str, Any]:
    """The file of a candidate as nested tables; ``sizes``: size of a unit of the target in each reading, in sd."""
    parts, parameters = [], {}
    for i, (term, amplitude) in enumerate(zip(c.terms, c.amplitudes, strict=True)):
        letter = LETTERS[i]
        sd = _amplitude_sd(c, i, sizes)
        null = None if c.target.form == REPLACE else 0.0
        parameters[letter] = _parameter(amplitude, {"normal": [0.0, sd]}, null)
        for own, start in term.start.items():
            kind, first, second = term.priors[own]
            parameters[own] = _parameter(start, {kind: [first, second]}, None, term.units.get(own))
        text = term.text
        for own in term.start:
            text = text.replace(f"<{own}>", own)
        parts.append(letter if text == "1" else f"{letter}*{text}")
    body = "+".join(parts)
    return {
        "id": name,
        "description": "A law found in the readings, empirical.",
        "stage": QUANTITIES[c.target.quantity],
        "acts_on": c.target.quantity,
        "form": c.target.form,
        "expression": body if c.target.form == ADD else _as_factor(c, parts),
        "parameters": parameters,
        "source": SOURCE,
        "range": {name: ends for name, ends in ranges.items() if c.is_bounded_by(name)},
    }


def _amplitude_sd(c: Candidate, place: int, sizes: np.ndarray) -> float:
    """Standard deviation of an amplitude: of an exponent, a log factor or an addition."""
    if c.target.form == ADD:
        typical = float(np.median(np.abs(c.target.column[c.target.column != 0.0])))
        return float(f"{ADDITION_SD / max(typical, 1e-300):.3g}")
    return EXPONENT_SD if c.terms[place].shape in ("power", "threshold") else LOG_FACTOR_SD


def _as_factor(c: Candidate, parts: list[str]) -> str:
    """The factor with the sum of the parts as its logarithm; powers as such, behind the constant of a replacement."""
    factors, rest = [f"{c.target.constant:.4g}"] if c.target.form == REPLACE else [], []
    for i, (term, part) in enumerate(zip(c.terms, parts, strict=True)):
        text = part.partition("*")[2]
        if term.shape in ("power", "threshold"):
            inner = text.removeprefix("log(").removesuffix(")")
            factors.append(f"{inner if inner.startswith(('max(', 'min(')) else f'({inner})'}^{LETTERS[i]}")
        else:
            rest.append(part)
    return "*".join([*factors, *([f"exp({'+'.join(rest)})"] if rest else [])])


def _parameter(value: float, prior: Mapping[str, Any], null: float | None, unit: str | None = None) -> dict[str, Any]:
    found: dict[str, Any] = {"value": float(value), "prior": dict(prior)}
    found = found if unit is None else {"unit": unit, **found}
    return found if null is None else {**found, "null": null}


def as_effect(data: Mapping[str, Any], columns: Collection[str]) -> Effect:
    """The effect of a found law."""
    return law_of_text(to_toml(data), FILE, columns)
