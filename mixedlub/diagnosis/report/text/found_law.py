"""The law found for a mismatch without a name, in words."""

from __future__ import annotations

from typing import Any

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import number, words_of
from mixedlub.diagnosis.report.text.answer import law_record
from mixedlub.diagnosis.report.text.past_text import glossed
from mixedlub.diagnosis.settings.report import MOST_SIMILAR

HOW = {"factor": "a factor on the {}", "add": "an addition to the {}", "replace": "in place of the {}"}


def found_law(d: Diagnosis) -> tuple[str, ...]:
    """Sentences on the law, its parameters, and the laws that cannot be told from it."""
    law = law_record(d)
    if law is None:
        if not d.posterior.verdict.is_discrepancy:
            return ()
        return ("No law acting in the model was found that predicts left-out levels better than calibration.",)
    values = ", ".join(map(_value, law["parameters"]))
    said = [
        f"Law found in the model, empirical: {_how(law)}, {law['expression']}, with {values}. On left-out levels the "
        f"error falls from {law['heldout_before']:.2f} to {law['heldout_after']:.2f} sigma."
    ]
    said += glossed(law["expression"], d.case.kind.numbers)
    alike = [rival for rival in law["rivals"] if rival["equivalent"]]
    if alike:
        others = "; ".join(f"{_how(rival)}, {rival['expression']}" for rival in alike[:MOST_SIMILAR])
        said.append(f"These readings cannot tell it from {others}.")
    return tuple(said)


def _value(p: dict[str, Any]) -> str:
    """A parameter with its unit and interval."""
    unit = "" if p["unit"] == "-" else f" {p['unit']}"
    return f"{p['name']} {number(p['value'])}{unit} (90 % {number(p['low90'])} to {number(p['high90'])})"


def _how(law: dict[str, str]) -> str:
    return HOW[law["form"]].format(words_of(law["acts_on"]))
