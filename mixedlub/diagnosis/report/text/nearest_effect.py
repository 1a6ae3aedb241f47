"""Which effects of the catalogue come nearest to a mismatch that has no name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import explanation_words, number
from mixedlub.diagnosis.report.text.headline import chance, percent

WORTH = 0.5
"""Share of an unnamed mismatch from which the effects that take it up are told."""
SUITS = (
    "its fit alone would do, but the strength or the calibration that it needs is improbable, or it fails on levels "
    "left out."
)
SECOND = 0.1
"""Share of a mismatch that a second effect has to take up to be told."""


@dataclass(frozen=True)
class Nearest:
    """Effects, the share of the mismatch that they take up, and the chi-square before and after, of so many readings.

    A chi-square is that of single readings, as that of the test is.

    No effects where none takes up enough of it.
    """

    explanation: Explanation
    taken: float
    before: float
    after: float
    count: int


def nearest(d: Diagnosis) -> Nearest | None:
    """What takes up most of a mismatch that has no name; None where a name is tied or there is nothing to take up."""
    found, tied = d.search, d.posterior.tied
    if DISCREPANCY not in tied or found.discrepancy.best.form == "wave" or any(key.effects for key in tied):
        return None
    good = d.counted

    def squares(residual: np.ndarray) -> float:
        return float(np.sum(found.problem.single_reading_units(residual[good]) ** 2))

    left = {key: squares(fit.residual) for key, fit in found.fits.items()}
    most = left[NOTHING] - squares(found.discrepancy.fit.residual)
    names = [key for key in left if key.effects and left[key] < left[NOTHING]]
    if most <= 0.0 or not names:
        return None
    # One effect is named unless a second takes up a good part of what it leaves.
    best = min(names, key=lambda key: left[key] + SECOND * most * (len(key.effects) - 1))
    taken = min((left[NOTHING] - left[best]) / most, 1.0)
    return Nearest(best if taken >= WORTH else NOTHING, taken, left[NOTHING], left[best], int(good.sum()))


def nearest_name(d: Diagnosis) -> list[str]:
    """The same as a sentence; nothing where some names are tied."""
    best = nearest(d)
    if best is None:
        return []
    if best.explanation == NOTHING:
        return ["No effect of the catalogue takes up a half of it."]
    noisy = best.after < best.count + 2.0 * np.sqrt(2.0 * best.count)
    p = d.posterior.weights.get(best.explanation, 0.0)
    why = SUITS if noisy else "what it leaves has another form."
    named = explanation_words(best.explanation.effects)
    return [
        f"Nearest in the catalogue: {named}, with {percent(best.taken)} of it taken up "
        f"(chi-square {number(best.before)} to {number(best.after)} for {best.count} readings, of which noise makes "
        f"about {best.count}). It is not the answer (probability {chance(p)}): {why}"
    ]
