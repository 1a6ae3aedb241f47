"""A look at the recording before anything is fitted: is it what it says it is."""

from __future__ import annotations

import numpy as np

from mixedlub.case import Case
from mixedlub.diagnosis.noise import is_stated, noise_from_repeats
from mixedlub.forward import Forward
from mixedlub.table import Table
from profiles.errors import InputError

FEWEST = 5
SCARCE = 30
UNIT_SLIPS = {1e3: "thousand", 1e-3: "thousandth", 1e6: "million", 1e-6: "millionth"}


class Doubt(str):
    """A warning that questions the answer as a whole, and so stands above it."""

    __slots__ = ()


def audit(case: Case, rows: Table, y: np.ndarray, forward: Forward) -> list[str]:
    """What the user should know of the recording; an error where it cannot be what it is labelled."""
    notes = []
    where = f"recordings.csv: {case.quantity}"
    if y.size < FEWEST:
        raise InputError(f"needs at least {FEWEST} readings to say anything", where=where, value=y.size)
    if case.kind.logarithmic and np.any(y <= 0):
        bad = float(y[y <= 0][0])
        raise InputError(f"readings of kind {case.kind.name!r} must be above zero", where=where, value=bad)
    base = forward.predict()
    if not np.isfinite(base).all():
        bad = int(rows["run"][~np.isfinite(base)][0])
        raise InputError(
            "the base model has no finite answer for this run's conditions", where=f"{where}, run", value=bad
        )
    whole = np.setdiff1d(rows["rig"], case.kind.part_rigs) if "rig" in rows else np.array([])
    if whole.size > 1:
        known = f"only as {' or '.join(case.kind.part_rigs)}" if case.kind.part_rigs else "for no case of this kind"
        notes.append(
            f"readings of the rigs {', '.join(whole.tolist())} are all compared with the whole base model: a part "
            f"rig is modelled {known}"
        )
    if y.size < SCARCE:
        notes.append(f"only {y.size} readings: expect ties and wide intervals")
    positive = (np.abs(base) > 0) & (np.abs(y) > 0)
    if positive.sum() >= FEWEST:
        ratio = float(np.median(np.abs(y[positive] / base[positive])))
        for slip, word in UNIT_SLIPS.items():
            if 0.7 * slip < ratio < 1.4 * slip:
                notes.append(
                    Doubt(
                        f"readings are about a {word} of what the base model gives: check the unit of {case.quantity}"
                    )
                )
        if np.median(base[positive]) > 0 and np.median(y[positive]) < 0:
            notes.append(Doubt("most readings are negative where the base model is positive: check the sign"))
    stated = case.system.recording.noise
    repeats = noise_from_repeats(case, rows, np.log(y) if case.kind.logarithmic else y)
    if not is_stated(case, rows):
        source = "repeats" if repeats > 0 else "the fit"
        notes.append(f"no noise given: the standard deviation of a reading is estimated from {source}")
    elif repeats > 0 and stated is not None:
        size = np.abs(y) if case.kind.logarithmic else np.ones(y.size)
        typical = float(np.median(np.hypot(stated.relative * np.abs(y), stated.absolute) / size))
        if repeats > 4.0 * typical > 0:
            notes.append(
                Doubt(
                    f"readings at equal conditions contradict each other: they scatter by {repeats:.3g} where the "
                    f"stated noise is {typical:.3g}"
                )
            )
    return notes
