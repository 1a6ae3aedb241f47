"""A mark to compare with: what one who knows the generator's own laws makes of the noisy recordings.

Its evidence is a coarse one (chi-square and half a log reading a knob), and so is its view of the unnamed: a tool that
weighs better can do better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mixedlub.validation.baselines import Fitted, recalibrate, write_answer
from mixedlub.validation.build import chosen, rig_of
from mixedlub.validation.deal import COARSE
from mixedlub.validation.explain import Explained, Target, calibrated, explain
from mixedlub.validation.planted import FORMS, NAMED, Concealed
from mixedlub.validation.rig import readings

PRIOR_NATS = {0: np.log(0.45), 1: np.log(0.30 / len(NAMED)), 2: np.log(0.12 / len(NAMED) ** 2)}
UNKNOWN_NATS = np.log(0.08)
LEADERS = 3
Names = tuple[str, ...]


def _evidence(found: Explained, effects: Sequence[Concealed], count: int) -> float:
    """Log posterior up to a constant: chi-square, half a log reading a knob, prior of the structure."""
    knobs = sum(len(effect.knobs) for effect in effects)
    return -0.5 * found.chi_square - 0.5 * knobs * np.log(count) + PRIOR_NATS[len(effects)]


def _target(fitted: Fitted) -> Target:
    case = chosen(fitted.case, fitted.good)
    rows = fitted.good
    return Target(rig_of(case, COARSE), fitted.recorded[rows], fitted.sd[rows], case.nominal, case.priors)


@dataclass(frozen=True)
class Suspect:
    """Some effects in the forms that fit best, their fit and its evidence."""

    forms: tuple[Concealed, ...]
    fit: Explained
    nats: float


def _searched(fitted: Fitted) -> dict[Names, Suspect]:
    """None, each single effect, and pairs with the leaders where none of these fits."""
    target, count = _target(fitted), len(fitted.good)

    def tried(forms: tuple[Concealed, ...], begin: np.ndarray, starts: list[np.ndarray] | None = None) -> Suspect:
        fit = explain(target, forms, begin, starts)
        return Suspect(forms, fit, _evidence(fit, forms, count))

    none = tried((), fitted.z)
    found: dict[Names, Suspect] = {(): none}
    for name, forms in FORMS.items():
        own = [tried((form,), none.fit.calibration) for form in forms if form.occurs_on(fitted.rig)]
        if own:
            found[(name,)] = max(own, key=lambda one: one.nats)
    enough = count + 2.3 * np.sqrt(2 * count)
    if min(one.fit.chi_square for one in found.values()) > enough:
        singles = sorted((key for key in found if key), key=lambda key: -found[key].nats)
        for lead in singles[:LEADERS]:
            for other in singles:
                pair = tuple(sorted({*lead, *other}))
                if len(pair) == 2 and pair not in found:
                    parts = [found[(name,)] for name in pair]
                    begin = np.array([v for part in parts for v in part.fit.knobs[0].values()])
                    both = tuple(part.forms[0] for part in parts)
                    found[pair] = tried(both, found[lead].fit.calibration, [begin])
    return found


def _unknown_nats(count: int) -> float:
    """Evidence of something outside the laws: nothing left, paid for by a smooth map of 12 numbers."""
    return -0.5 * count - 0.5 * 12 * np.log(count) + UNKNOWN_NATS


def oracle(folder: Path, out: Path) -> None:
    """Answers a case with the generator's laws; drops the outliers of the best fit and searches again."""
    fitted = recalibrate(folder)
    for last in (False, True):
        found = _searched(fitted)
        best = max(found.values(), key=lambda one: one.nats)
        hidden = [form.hide(values) for form, values in zip(best.forms, best.fit.knobs)]
        at = calibrated(fitted.case.nominal, fitted.case.priors, best.fit.calibration)
        predicted = readings(fitted.rig, at, hidden)
        left = np.abs(fitted.recorded - predicted[: fitted.seen]) / fitted.sd[: fitted.seen]
        spoiled = left > 4.5
        if last or spoiled.mean() > 0.1 or np.array_equal(spoiled, fitted.spoiled):
            break
        fitted = replace(fitted, spoiled=spoiled)
    nats = {key: one.nats for key, one in found.items()}
    nats[("unknown",)] = _unknown_nats(len(fitted.good))
    top = max(nats.values())
    weights = {key: float(np.exp(value - top)) for key, value in nats.items()}
    total = sum(weights.values())
    probabilities = dict.fromkeys(NAMED, 0.0) | {"none": weights.pop(()) / total}
    for key, weight in weights.items():
        for name in key:
            probabilities[name] = probabilities.get(name, 0.0) + weight / total
    ranked = sorted(nats, key=lambda key: -nats[key])
    near = [key or ("none",) for key in ranked if nats[key] > top - np.log(10)]
    write_answer(fitted, out, probabilities, near, predicted, base=readings(fitted.rig, at))
