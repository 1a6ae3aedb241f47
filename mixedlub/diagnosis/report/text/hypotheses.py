"""Hypotheses of the user in words and as a table."""

from __future__ import annotations

from mixedlub.diagnosis.assessment.hypotheses import Hypothesis
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import effect_words, enumerated, number
from mixedlub.diagnosis.report.text.headline import chance

UNTESTED = "changes no reading here"
"""Entry of a hypothesis that the readings cannot weigh."""


def hypotheses(d: Diagnosis) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """A sentence on the hypotheses of the user, and their table; empty without any."""
    if not d.hypotheses:
        return (), ()
    head = ("your hypothesis", "probability", "log odds against the answer", "left-out levels", "alone")
    return (_sentence(d),), (head, *(_row(d, one) for one in d.hypotheses))


def _sentence(d: Diagnosis) -> str:
    """Whether the answer names a hypothesis of the user."""
    own = [one.id for one in d.hypotheses]
    named = [effect_words(name) for name in d.posterior.verdict.effects if name in own]
    tied = [effect_words(n) for n in dict.fromkeys(n for key in d.posterior.tied for n in key.effects) if n in own]
    compared = f"calibration alone predicts left-out levels to {number(d.heldout.before)} sigma"
    if named:
        return f"Your {enumerated(named)} {'is' if len(named) == 1 else 'are'} in the answer; {compared}."
    if tied:
        return f"Your {enumerated(tied)} cannot be told from the answer; {compared}."
    return f"None of your laws is in the answer; {compared}."


def _row(d: Diagnosis, one: Hypothesis) -> tuple[str, ...]:
    """Name, probability, log odds against the answer, error on left-out levels, and fitted numbers."""
    if one.log_odds is None or one.heldout is None:
        return effect_words(one.id), chance(one.probability), "-", "-", UNTESTED
    (effect,) = d.search.problem.effects_of((one.id,))
    units = {p.name: p.unit.removeprefix("-") for p in effect.parameters}
    fitted = ", ".join(f"{n} = {number(v)} {units[n]}".rstrip() for n, v in one.parameters.items() if n in units)
    return effect_words(one.id), chance(one.probability), f"{one.log_odds:+.1f}", f"{number(one.heldout)} sigma", fitted
