"""The history of a condition in words."""

from __future__ import annotations

import re

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.discrepancy.past import Remembered
from mixedlub.diagnosis.labels import amount, words_of
from mixedlub.diagnosis.settings.report import FADED
from mixedlub.schema.past import BEFORE, DIRECTION, MEMORY, SINCE, Past, past_of

SHARE, READINGS = "share", "readings"


def duration(time: float, clock: str) -> str:
    """A duration in the unit of an order.

    >>> duration(40.0, "s"), duration(0.05, "share"), duration(3.0, "readings")
    ('40 s', '5 % of the programme', '3 readings')
    """
    if clock == SHARE:
        return f"{100.0 * time:.2g} % of the programme"
    return f"{time:.3g} readings" if clock == READINGS else amount(float(f"{time:.2g}"), "time_s")


def remembered_words(one: Remembered, sign: float = 0.0) -> str:
    """How a mismatch depends on a history, as a predicate; ``sign``: of its size, 0 if it varies.

    >>> remembered_words(Remembered(Past("load_N", DIRECTION)), -1.0)
    'follows the last change of load: more after a fall than after a rise'
    >>> remembered_words(Remembered(Past("speed_rpm", SINCE, "s"), 13.0))
    'begins at each change of speed and is gone after 39 s'
    >>> remembered_words(Remembered(Past("oil_temperature_C", MEMORY, "s", 300.0), instead=True))
    'follows oil temperature as it was over the last 300 s or so, rather than the present one'
    """
    what, name = one.past.what, words_of(one.past.column)
    if what == DIRECTION:
        order = {1.0: "more after a rise than after a fall", -1.0: "more after a fall than after a rise"}
        return f"follows the last change of {name}: {order.get(sign, 'another after a rise than after a fall')}"
    if what == BEFORE:
        return f"follows the difference between present {name} and that before its last change"
    if what == SINCE:
        return f"begins at each change of {name} and is gone after {duration(FADED * one.decay, one.past.clock)}"
    late = duration(one.past.fading, one.past.clock)
    if one.instead:
        return f"follows {name} as it was over the last {late} or so, rather than the present one"
    return f"follows changes of {name} and fades within {late} or so"


def past_words(d: Diagnosis) -> str:
    """How the most probable discrepancy depends on a history, as a predicate; empty if it does not."""
    best = d.search.discrepancy.best
    if best.past is None:
        return ""
    if best.axes:
        return f"{remembered_words(best.past)}, by a share that varies with present {words_of(best.axes[0])}"
    coefficient = float(d.search.discrepancy.fit.coefficients[-1])
    return remembered_words(best.past, (coefficient > 0.0) - (coefficient < 0.0))


def glossed(expression: str, columns: tuple[str, ...]) -> list[str]:
    """Sentences on the history coordinates in an expression.

    >>> glossed("a*exp(-load_since_s/t)", ("load_N",))
    ['load_since_s is the time since the last change of load, in s.']
    """
    names = dict.fromkeys(re.findall(r"[A-Za-z]\w*", expression))
    found = ((name, past_of(name, columns)) for name in names)
    return [f"{name} is {_meaning(past)}." for name, past in found if past is not None]


def _meaning(past: Past) -> str:
    name = words_of(past.column)
    units = {"s": "in s", SHARE: "as a share of the programme", READINGS: "in readings"}
    return {
        DIRECTION: f"1 after a rise of {name}, -1 after a fall, 0 before any change",
        BEFORE: f"{name} before its last change",
        SINCE: f"the time since the last change of {name}, {units.get(past.clock, '')}",
        MEMORY: f"the mean of {name} over the past, with weights that fade with {duration(past.fading, past.clock)}",
    }[past.what]
