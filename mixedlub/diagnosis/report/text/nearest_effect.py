"""Effects of the catalogue nearest to the discrepancy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import explanation_words, number
from mixedlub.diagnosis.report.text.headline import chance, percent
from mixedlub.diagnosis.settings.inference import SIGNIFICANT
from mixedlub.diagnosis.settings.report import NEAREST_SHARE, SECOND_SHARE

SUITS = (
    "its fit alone would do, but the strength or the calibration that it needs is improbable, or it fails on levels "
    "left out."
)


@dataclass(frozen=True)
class Nearest:
    """Nearest effects (empty if weak), explained share, chi-square of ``count`` single readings before and after."""

    explanation: Explanation
    share: float
    before: float
    after: float
    count: int


def nearest(d: Diagnosis) -> Nearest | None:
    """Effects that explain most of the discrepancy; None for a wave, a tie with effects, or no discrepancy."""
    search, tied = d.search, d.posterior.tied
    if DISCREPANCY not in tied or search.discrepancy.best.form == "wave" or any(key.effects for key in tied):
        return None
    counted = d.counted

    def squares(residual: np.ndarray) -> float:
        return float(np.sum(search.problem.single_reading_units(residual[counted]) ** 2))

    chi2 = {key: squares(fit.residual) for key, fit in search.fits.items()}
    reachable = chi2[NOTHING] - squares(search.discrepancy.fit.residual)
    names = [key for key in chi2 if key.effects and chi2[key] < chi2[NOTHING]]
    if reachable <= 0.0 or not names:
        return None
    # A second effect is named only where it explains a good part of the remainder.
    best = min(names, key=lambda key: chi2[key] + SECOND_SHARE * reachable * (len(key.effects) - 1))
    share = min((chi2[NOTHING] - chi2[best]) / reachable, 1.0)
    return Nearest(best if share >= NEAREST_SHARE else NOTHING, share, chi2[NOTHING], chi2[best], int(counted.sum()))


def nearest_name(d: Diagnosis) -> list[str]:
    """Sentence on the nearest effects; empty without them."""
    best = nearest(d)
    if best is None:
        return []
    if best.explanation == NOTHING:
        return ["No effect of the catalogue takes up a half of it."]
    noisy = best.after < best.count + SIGNIFICANT * np.sqrt(2.0 * best.count)
    p = d.posterior.weights.get(best.explanation, 0.0)
    why = SUITS if noisy else "the remaining residuals have another form."
    named = explanation_words(best.explanation.effects)
    return [
        f"Nearest in the catalogue: {named}, with {percent(best.share)} of it taken up "
        f"(chi-square {number(best.before)} to {number(best.after)} for {best.count} readings, of which noise makes "
        f"about {best.count}). It is not the answer (probability {chance(p)}): {why}"
    ]
