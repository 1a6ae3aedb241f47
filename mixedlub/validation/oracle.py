"""Reference diagnosis of the noisy recordings with the generator's laws.

Evidence (chi-square and half a log reading a knob) and model of unknown effects are coarse: a tool may score higher.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mixedlub.validation.baselines import Fitted, recalibrate, write_answer
from mixedlub.validation.planted import FORMS, NAMED
from mixedlub.validation.rig import Form
from mixedlub.validation.rivals import Fit, Target, best

PRIOR_NATS = {0: np.log(0.45), 1: np.log(0.30 / len(NAMED)), 2: np.log(0.12 / len(NAMED) ** 2)}
UNKNOWN_NATS = np.log(0.08)
LEADING_FORMS = 3
Names = tuple[str, ...]


def _evidence(fit: Fit, forms: Sequence[Form], count: int) -> float:
    """Log posterior up to a constant: chi-square, half a log reading a knob, prior of the structure."""
    knobs = sum(len(form.knobs) for form in forms)
    return -0.5 * fit.chi_square - 0.5 * knobs * np.log(count) + PRIOR_NATS[len(forms)]


@dataclass(frozen=True)
class Suspect:
    """Some effects in the forms that fit best, with fit and evidence."""

    forms: tuple[Form, ...]
    fit: Fit
    nats: float


def _searched(fitted: Fitted) -> dict[Names, Suspect]:
    """No effect, single effects, and pairs with the leading effects if no single effect fits."""
    rows = fitted.good
    target, count = Target(fitted.rig, rows, fitted.recorded[rows], fitted.sd[rows]), len(rows)

    def tried(forms: tuple[Form, ...], z: np.ndarray, knobs: Sequence[dict[str, float]] = ()) -> Suspect:
        fit = best(target, forms, z, knobs)
        return Suspect(forms, fit, _evidence(fit, forms, count))

    none = tried((), fitted.z)
    suspects: dict[Names, Suspect] = {(): none}
    for name in FORMS:
        fits = [tried((form,), none.fit.z) for form in fitted.rig.forms if form.id == name]
        if fits:
            suspects[(name,)] = max(fits, key=lambda one: one.nats)
    enough = count + 2.3 * np.sqrt(2 * count)
    if min(one.fit.chi_square for one in suspects.values()) > enough:
        singles = sorted((key for key in suspects if key), key=lambda key: -suspects[key].nats)
        for lead in singles[:LEADING_FORMS]:
            for other in singles:
                pair = tuple(sorted({*lead, *other}))
                if len(pair) == 2 and pair not in suspects:
                    parts = [suspects[(name,)] for name in pair]
                    both = tuple(part.forms[0] for part in parts)
                    suspects[pair] = tried(both, suspects[lead].fit.z, [part.fit.knobs[0] for part in parts])
    return suspects


def _unknown_nats(count: int) -> float:
    """Evidence of an unknown effect: zero residual at the price of a smooth map of 12 numbers."""
    return -0.5 * count - 0.5 * 12 * np.log(count) + UNKNOWN_NATS


def oracle(folder: Path, out: Path) -> None:
    """Answer a case with the generator's laws; drop the outliers of the best fit and search again."""
    fitted = recalibrate(folder)
    for last in (False, True):
        suspects = _searched(fitted)
        top = max(suspects.values(), key=lambda one: one.nats)
        hidden = [form.hide(values) for form, values in zip(top.forms, top.fit.knobs)]
        predicted = fitted.rig.model(top.fit.z, hidden)
        deviation = np.abs(fitted.recorded - predicted[: fitted.n_recorded]) / fitted.sd[: fitted.n_recorded]
        spoiled = deviation > 4.5
        if last or spoiled.mean() > 0.1 or np.array_equal(spoiled, fitted.spoiled):
            break
        fitted = replace(fitted, spoiled=spoiled)
    nats = {key: one.nats for key, one in suspects.items()}
    nats[("unknown",)] = _unknown_nats(len(fitted.good))
    most = max(nats.values())
    weights = {key: float(np.exp(value - most)) for key, value in nats.items()}
    total = sum(weights.values())
    probabilities = dict.fromkeys(NAMED, 0.0) | {"none": weights.pop(()) / total}
    for key, weight in weights.items():
        for name in key:
            probabilities[name] = probabilities.get(name, 0.0) + weight / total
    ranked = sorted(nats, key=lambda key: -nats[key])
    near = [key or ("none",) for key in ranked if nats[key] > most - np.log(10)]
    write_answer(fitted, out, probabilities, near, predicted, base=fitted.rig.model(top.fit.z, ()))
