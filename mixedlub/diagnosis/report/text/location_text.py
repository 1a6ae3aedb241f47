"""Location of the mismatch in words."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import number, range_text
from mixedlub.diagnosis.report.text.outlier_text import reading_conditions
from mixedlub.diagnosis.report.text.past_text import past_words
from mixedlub.diagnosis.settings.report import ONE_SIGN, SIGNS_DIFFER

NOWHERE = "Nowhere: the calibrated base model agrees with the readings within their noise."
SPREAD = (
    "These numbers have the calibration that was fitted together with the answer. “Before” in the figures is the base "
    "model fitted alone, which spreads the mismatch over all conditions, so signs there can differ."
)
LEVEL = "Without a named cause, calibration may have absorbed a constant part; location and sign are then not unique."


def where(d: Diagnosis) -> tuple[str, ...]:
    """Location of the mismatch, its largest value, and the reason for different signs in the figures."""
    if d.posterior.verdict == NOTHING:
        return ()
    z = _mismatch(d)
    largest = int(np.argmax(np.abs(z)))
    run, conditions = int(d.recorded.table["run"][largest]), reading_conditions(d, largest)
    sentences: tuple[str, ...] = (located(d), f"Largest at run {run} ({conditions}): {z[largest]:+.1f} sigma.")
    if d.posterior.verdict.is_discrepancy and d.search.problem.calibration_size and not d.region.inside.all():
        sentences = (*sentences, LEVEL)
    opposite = np.sign(d.residuals[0]) != np.sign(z)
    return (*sentences, SPREAD) if opposite.mean() > SIGNS_DIFFER else sentences


def located(d: Diagnosis) -> str:
    """Conditions, direction and size of the difference between the rig and the model without the answer."""
    z, inside = _mismatch(d), d.region.inside
    if not z.any():
        return NOWHERE
    ranges = ", ".join(range_text(cut) for cut in d.region.where)
    opening = f"Above all at {ranges}: there" if ranges else "Everywhere:"
    sign = _direction(z[inside], d.recorded.predicted[inside])
    share = 100.0 * float(np.median(_share(d.missing[1], d.recorded.predicted)[inside]))
    elsewhere = f" Elsewhere {_rms(z[~inside]):.1f} times the noise." if (~inside).any() else ""
    return (
        f"{opening} the rig reads {sign} than the model without this cause, typically by {number(share)} % (rms "
        f"{_rms(z[inside]):.1f} times the noise of a reading).{elsewhere}{_when(d)}"
    )


def _when(d: Diagnosis) -> str:
    """The history on which an unknown depends, as a further sentence."""
    words = past_words(d) if d.posterior.verdict.is_discrepancy else ""
    return f" It {words}." if words else ""


def _mismatch(d: Diagnosis) -> np.ndarray:
    """Mismatch of each reading (sigma); zero for outliers."""
    return np.where(d.counted, d.recorded.mismatch_z, 0.0)


def _direction(z: np.ndarray, predicted: np.ndarray) -> str:
    """Direction of the mismatch: more or less than expected, or more or less in size for negative or mixed signs.

    >>> _direction(np.array([2.0, 3.0]), np.ones(2)), _direction(np.array([2.0, -3.0]), np.array([1.0, -1.0]))
    ('more', 'more in size, either sign,')
    >>> _direction(np.array([-2.0, -3.0]), -np.ones(2))
    'more in size'
    """
    total = max(float(np.sum(np.abs(z))), 1e-300)
    size = float(z @ np.sign(predicted))
    candidates = (
        ((float(z.sum()), ""), (size, " in size, either sign,")) if predicted.max() > 0.0 else ((size, " in size"),)
    )
    for net, words in candidates:
        if abs(net) >= ONE_SIGN * total:
            return f"{'more' if net > 0.0 else 'less'}{words}"
    return "now more and now less"


def _share(lacking: np.ndarray, predicted: np.ndarray) -> np.ndarray:
    """Missing part over the larger reading, with or without it, because either may be near zero.

    >>> _share(np.array([3.0, -0.09]), np.array([4.0, 0.0])).tolist()
    [0.75, 1.0]
    """
    return np.abs(lacking) / np.maximum(np.maximum(np.abs(predicted), np.abs(predicted - lacking)), 1e-300)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
