"""How well forms can explain noise-free readings of a bench when its calibration may move under its prior."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.explain import STEP, descend, guesses, promising
from mixedlub.validation.rigs.stage import Bench, Form


@dataclass(frozen=True)
class Aim:
    """What is to be explained: noise-free values of the visible readings, and their sd."""

    bench: Bench
    visible: np.ndarray
    values: np.ndarray
    sd: np.ndarray


def slopes(bench: Bench, z: np.ndarray) -> np.ndarray:
    """Change of the base readings (readings by calibrations) with one prior sd of each."""
    at = bench.model(z, ())
    return np.array([(bench.model(z + STEP * e, ()) - at) / STEP for e in np.eye(len(z))]).T


def best(
    aim: Aim, forms: Sequence[Form], z: np.ndarray, knobs: Sequence[dict[str, float]] = ()
) -> tuple[float, np.ndarray]:
    """Least chi-square of some forms, knobs free in their ranges, and the calibration that reaches it.

    ``knobs`` are where the first forms begin; the others begin from several guesses.
    """
    count = len(aim.bench.names)
    every = [knob for form in forms for knob in form.knobs]
    unit = np.array([max(abs(k.typical[1]), 1e-9) if k.name == "strength" else k.high - k.low for k in every])
    low = np.concatenate([np.full(count, -6.0), np.array([k.low for k in every]) / unit])
    high = np.concatenate([np.full(count, 6.0), np.array([k.high for k in every]) / unit])

    def residual(x: np.ndarray) -> np.ndarray:
        values = iter(x[count:] * unit)
        acts = [form.hide({knob.name: float(next(values)) for knob in form.knobs}) for form in forms]
        model = aim.bench.model(x[:count], acts)[aim.visible]
        return np.concatenate([(model - aim.values) / aim.sd, x[:count]])

    known = [value for one in knobs for value in one.values()]
    starts = [np.concatenate([known, guess]) / unit for guess in guesses(forms[len(knobs) :])]
    if len(starts) > 1:
        tangents = np.concatenate([slopes(aim.bench, z)[aim.visible] / aim.sd[:, None], np.eye(count)])
        starts = promising(starts, residual, z, tangents)
    found = min((descend(residual, np.concatenate([z, start]), low, high) for start in starts), key=lambda f: f[1])
    return found[1], found[0][:count]


def nearest(bench: Bench) -> np.ndarray:
    """The calibration with which the model comes nearest to what the rig reads when nothing is missing."""
    start = np.zeros(len(bench.names))
    values = bench.records(start, ())
    return best(Aim(bench, np.arange(len(values)), values, 0.01 * values), (), start)[1]


def rivals(
    aim: Aim, hidden: Sequence[Form], knobs: Sequence[dict[str, float]], z: np.ndarray, rank: int
) -> dict[str, float]:
    """Least chi-square of none, of every single effect but the truth, and of a pair with one of the two changed.

    Each effect is tried in all its forms. Forms more general than the truth, beyond ``rank``, hold it as a
    special case and are no rivals.
    """
    none, begin = best(aim, (), z)
    found = {"none": none}
    truth = {form.id for form in hidden}
    usual = [form for form in aim.bench.forms if form.rank <= rank]

    def tried(name: str, value: float) -> None:
        found[name] = min(value, none, found.get(name, np.inf))

    for form in usual:
        if truth != {form.id}:
            tried(form.id, best(aim, (form,), begin)[0])
    for kept, values in zip(hidden, knobs) if len(hidden) == 2 else ():
        for form in usual:
            if form.id not in truth:
                tried("+".join(sorted((kept.id, form.id))), best(aim, (kept, form), z, (values,))[0])
    return {name: round(value, 4) for name, value in found.items()}
